#!/usr/bin/python3
"""check_comments.py FOLDER...: checks that comments of C++ sources begin with a noun or a verb, by the words that begin neither.
Only the first word of a comment counts, whatever its further lines begin with. Names each fault and what to write instead;
ends with 1 where there is any."""

import re
import sys
from pathlib import Path

INSTEAD = {
    "of": "'Length of ...', 'Sum of ...', whatever it is",
    "what": "'Result of ...', 'Returns ...', whatever it is",
    "whether": "'True if ...'",
    "who": "'Owner of ...'",
    "whose": "'Owner of ...'",
    "when": "'Time at which ...'",
    "where": "'Place where ...'",
    "which": "'Choice of ...' or 'Number of ...'",
    "how": "'Way in which ...' or 'Number of ...'",
    "why": "'Reason why ...'",
}
FIRST = re.compile(r"//+[<!]?\s*({})\b".format("|".join(INSTEAD)), re.IGNORECASE)
# A string, a character or the begin of a comment, whichever comes first.
TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'|//')


def comment_column(line):
    """Returns the column where the line's comment begins; -1 without one."""
    return next((token.start() for token in TOKEN.finditer(line) if token[0] == "//"), -1)


def faults(path):
    """Yields (line number, word) of each comment that begins with one of these words."""
    above = -1
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        column = comment_column(line)
        goes_on = column == above and not line[:column].strip()
        found = FIRST.match(line, column) if column >= 0 and not goes_on else None
        if found:
            yield number, found[1]
        above = column


count = 0
for folder in sys.argv[1:]:
    for path in sorted(Path(folder).rglob("*.[hc]pp")):
        for number, word in faults(path):
            print(f"{path}:{number}: a comment begins with a noun or a verb, not with '{word}'; write {INSTEAD[word.lower()]}")
            count += 1
sys.exit(1 if count else 0)
