"""The chapter of doc/methods.md on forces of soil on tools, from the table of `work_precision --suite tool_force`."""
import json
import math
import textwrap

import plot_tool_force as plots

AT = 8.0  # cells at which lift, ripple, scatter and cost stand in the tables


def keep(runs, doc):
    """Copies the table, without curves, a row a line."""
    table = plots.read(runs)
    for row in table["rows"]:
        row.pop("curve", None)
        row.pop("label")
    lines = ["{", ' "problems": [']
    lines += [",\n".join("  " + json.dumps(problem, ensure_ascii=False) for problem in table["problems"]), " ],"]
    lines += [' "rows": [', ",\n".join("  " + json.dumps(row, ensure_ascii=False) for row in table["rows"]), " ]", "}"]
    (doc / plots.TABLE).write_text("\n".join(lines) + "\n", encoding="utf-8")


def number(value, digits):
    return "-" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def short(value):
    return "-" if value is None else f"{value:.2g}"


def force(row):
    if row is None:
        return ""
    return row["status"] if row["status"] != "ok" else number(row["over_exact"], 2)


def wrapped(text):
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False)


def problem_lines(problem, rows):
    cells = sorted({row["cells"] for row in rows})
    head = [f"{value:g}" for value in cells] + ["lift", "ripple", "scatter", "unloaded", "energy", "s", "real time"]
    lines = [f"### {problem['title']}", "", wrapped(f"`{problem['name']}`. {problem['text']}"), "",
             wrapped(f"*{problem['known'].capitalize()}:* {problem['answer']}. Mean from {100 * problem['from']:g} to "
                     f"{100 * problem['to']:g} % of travel."), "",
             f"![{problem['title']}](methods/tool_force_{problem['name']}.png)", "",
             "| method, cells | " + " | ".join(head) + " |", "|---|" + "---|" * len(head)]
    for one in dict.fromkeys(row["label"] for row in rows):
        own = {row["cells"]: row for row in rows if row["label"] == one}
        at = own.get(AT if AT in own else max(own))
        lines.append(f"| {one} | " + " | ".join(
            [force(own.get(value)) for value in cells] + [number(at.get(key), 2) for key in
                                                          ("lift", "ripple", "scatter", "unloaded", "imbalance")] +
            [short(at["cpu_seconds"]), short(at["real_time_factor"])]) + " |")
    return lines + [""]


def chapter(folder):
    table = plots.read(folder)
    lines = []
    for problem in table["problems"]:
        rows = [row for row in table["rows"] if row["problem"] == problem["name"]]
        if rows:
            lines += problem_lines(problem, rows)
    bad = [row for row in table["rows"] if row["status"] != "ok"]
    if bad:
        lines += ["Runs that failed or were refused:", ""]
        lines += [f"- `{row['problem']}`, {row['cells']:g} cells, {row['label']}: {row['message']}" for row in bad] + [""]
    return "\n".join(lines).rstrip()
