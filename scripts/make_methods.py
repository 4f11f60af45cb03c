#!/usr/bin/python3
"""make_methods.py RUNS DOC [PAGES]: writes DOC/methods.md, DOC/methods/*.png and copies of the tables from RUNS, the
folder that work_precision filled, and from PAGES, the folder where the stability tests left their pages. Without PAGES the
last chapter, which is made from them, stays as it is. RUNS may be DOC/methods.

    make_methods.py --check DOC     fails unless the page, without its last chapter, agrees with the tables beside it

Both fail when the tables lack runs: on each suite every method that suites.csv lists there needs a row, of whatever
status, for every grid at the usual time step and number of particles.

The text is benchmark/work_precision/methods.md. Expressions in {{ }} there are computed from the tables:

    {{ percent(error("square_large", "ugimp/usavg/flip", 32)) }}   a number of a row
    {{ check(error(...) < 0.5 * error(...)) }}                     prints nothing; the page is not made unless it holds
    {{ charts() }} {{ summary() }} {{ refused() }} {{ tool_force() }} {{ stability() }}

A missing row, or a check that does not hold, ends this script with an error that names the line of the text, so that no
claim outlives its figures. In the chapter "What the charts say" every point needs a check."""
import csv
import importlib
import math
import pathlib
import re
import shutil
import sys
import textwrap

sys.dont_write_bytecode = True  # nothing is left among the sources
import plot_tool_force  # noqa: E402
import plot_work_precision as plots  # noqa: E402
import tool_force_pages  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEMPLATE = ROOT / "benchmark" / "work_precision" / "methods.md"
TABLES = ("work_precision.csv", "summary.csv", "suites.csv")
CLAIMS = "## What the charts say"
LAST = "## Where methods stop working"  # made from the pages of the stability tests, which are not kept

# The column `methods` of suites.csv says which methods are run on a suite: all, or those of main_methods() in
# src/mpm/choice/method_choice.cpp. The functions test a method's row for it.
RUN_THERE = {
    "all": lambda row: True,
    "main": lambda row: row["shape"] == "ugimp" or (row["update"], row["transfer"]) == ("usavg", "flip"),
}


class ClaimError(Exception):
    """A claim of the text that the tables contradict; its message is one line."""


class Study:
    """The tables of a study, and the functions that the text may call."""

    def __init__(self, runs, doc=None, pages=None):
        self.rows, self.texts = plots.read_rows(runs), plots.read_texts(runs)
        with open(runs / "summary.csv", newline="", encoding="utf-8") as file:
            self.lines = list(csv.DictReader(file))
        self.runs, self.doc, self.pages = runs, doc, pages
        self.drawn = [suite for suite in dict.fromkeys(row["suite"] for row in self.rows)
                      if plots.good([row for row in self.rows if row["suite"] == suite])]

    def check_complete(self):
        """Raises ClaimError for a study that was cut short, or put together from parts."""
        methods = {row["method"]: row for row in self.rows}
        lacking = []
        for suite, text in self.texts.items():
            rows = [row for row in self.rows
                    if row["suite"] == suite and row["cfl"] == plots.USUAL_CFL and plots.usual_particles(row)]
            run = {(row["method"], row["cells"]) for row in rows}
            if text.get("methods") not in RUN_THERE:
                raise ClaimError(f"suites.csv: {suite} was not run with all methods, or the main; run scripts/methods")
            expected = [label for label, row in methods.items() if RUN_THERE[text["methods"]](row)]
            missing = [(label, cells) for label in expected for cells in sorted({row["cells"] for row in rows})
                       if (label, cells) not in run]
            if not rows:
                lacking.append(f"{suite}: all")
            elif missing:
                lacking.append(f"{suite}: {len(missing)}, as {missing[0][0]} with {missing[0][1]:g} cells")
        if lacking:
            raise ClaimError(f"work_precision.csv lacks runs ({'; '.join(lacking)}); run scripts/methods")

    def run(self, suite, method, cells, cfl=plots.USUAL_CFL, ppc=None):
        """The row of one run; without `ppc`, that with the usual number of particles."""
        found = [row for row in self.rows
                 if (row["suite"], row["method"], row["cells"], row["cfl"]) == (suite, method, cells, cfl)
                 and (row["ppc"] == ppc if ppc else plots.usual_particles(row))]
        if len(found) != 1:
            raise ClaimError(f"{len(found)} runs of {method} on {suite}, {cells} cells, Courant {cfl}")
        return found[0]

    def number(self, column, *which, **more):
        row = self.run(*which, **more)
        if row["status"] != "ok" or math.isnan(row[column]):
            raise ClaimError(f"{row['method']} on {row['suite']}, {row['cells']:g} cells: {row['status']}, "
                             f"{row['message'] or 'no ' + column}")
        return row[column]

    def error(self, *which, **more):
        return self.number("error", *which, **more)

    def relative_cost(self, *which, **more):
        return self.number("relative_cost", *which, **more)

    def status(self, *which, **more):
        return self.run(*which, **more)["status"]

    def order(self, suite, method, coarse, fine):
        """Order of convergence of the error between two grids."""
        return math.log(self.error(suite, method, coarse) / self.error(suite, method, fine)) / math.log(fine / coarse)

    def worst(self, suite):
        """The row of the largest error among all runs that ended well."""
        good = plots.good([row for row in self.rows if row["suite"] == suite])
        if not good:
            raise ClaimError(f"no run on {suite} ended well")
        return max(good, key=lambda row: row["error"])

    def best(self, suite, target, by="work"):
        """Label of the method that is cheapest for an error."""
        for line in self.lines:
            if (line["suite"], line["by"]) == (suite, by) and float(line["target_error"]) == target:
                return line["method"]
        raise ClaimError(f"the summary has no line for {suite}, {target}")

    def main_suites(self):
        """A sentence that names the problems on which only the main methods are run."""
        names = [f"`{suite}`" for suite, text in self.texts.items() if text["methods"] == "main"]
        if not names:
            return "Every one of them is run on every problem."
        return textwrap.fill(f"On {', '.join(names)} a run is long, and only uGIMP's combinations and those of USAVG "
                             "and FLIP are run.", 120, break_on_hyphens=False)

    def charts(self):
        parts = []
        for suite in self.drawn:
            text = self.texts[suite]
            parts += [f"### {text['title']}", "", f"`{suite}`, {text['geometry'].replace('_', ' ')}. {text['problem']}",
                      "", f"*Exact:* {text['exact']}. *Error:* {text['measure']}.", "",
                      f"![{text['title']}](methods/{suite}.png)", ""]
        return "\n".join(parts).rstrip()

    def summary(self):
        """Tables of the cheapest method, by relative cost and by counted work: a row a suite, a column an error."""
        targets = list(dict.fromkeys(line["target_error"] for line in self.lines))
        parts = []
        for by, head in (("cost", "By processor time, relative to uGIMP/USF on the same grid"),
                         ("work", "By counted work")):
            parts += [f"**{head}**", "",
                      "| problem | " + " | ".join(f"{100 * float(target):g} %" for target in targets) + " |",
                      "|---|" + "---|" * len(targets)]
            for suite in dict.fromkeys(line["suite"] for line in self.lines):
                own = {line["target_error"]: line for line in self.lines
                       if line["suite"] == suite and line["by"] == by}
                parts.append(f"| {suite} | " + " | ".join(self.cell(own[target]) for target in targets) + " |")
            parts.append("")
        return "\n".join(parts).rstrip()

    @staticmethod
    def cell(line):
        if not line["method"]:
            return "none"
        text = f"{line['method']}, {float(line['value']):.2g}"
        if line["ugimp_usf_value"]:
            return f"{text} ({float(line['value']) / float(line['ugimp_usf_value']):.2f})"
        return text + " (-)"

    def refused(self):
        reasons = {}
        for row in self.rows:
            if row["status"] == "refused":
                reasons.setdefault((row["method"], row["message"]), set()).add(row["suite"])
        if not reasons:
            return "None was refused."
        every = {row["suite"] for row in self.rows}
        lines = ["| method | on | why |", "|---|---|---|"]
        for (method, message), suites in reasons.items():
            on = "all" if suites == every else ", ".join(s for s in self.texts if s in suites)
            lines.append(f"| {method} | {on} | {message.replace('|', chr(92) + '|')} |")
        return "\n".join(lines)

    def failures(self):
        counts = {}
        for row in self.rows:
            if row["status"] == "failed":
                counts.setdefault((row["suite"], row["method"]), []).append(f"{row['cells']:g}")
        if not counts:
            return "No run failed."
        lines = ["| problem | method | grids |", "|---|---|---|"]
        lines += [f"| {suite} | {method} | {', '.join(dict.fromkeys(cells))} |"
                  for (suite, method), cells in counts.items()]
        return "\n".join(lines)

    def tool_force(self):
        """Tables and pictures of the forces on tools."""
        return tool_force_pages.chapter(self.runs)

    def stability(self):
        """The chapters that stability_pages.py makes from the pages of the stability tests, if there are any."""
        if self.pages is None or not any(self.pages.glob("*.json")):
            return "The stability tests have left no page; run `scripts/methods` to make them."
        pages = importlib.import_module("stability_pages")
        pictures = self.doc / "methods" / "stability"
        pictures.mkdir(parents=True, exist_ok=True)
        return pages.sections(self.pages, pictures, link="methods/stability").rstrip()

    def names(self):
        """The names that the text may use."""
        return {"error": self.error, "relative_cost": self.relative_cost, "status": self.status, "order": self.order,
                "best": self.best, "worst": self.worst, "charts": self.charts, "summary": self.summary,
                "refused": self.refused, "failures": self.failures, "main_suites": self.main_suites,
                "stability": self.stability, "tool_force": self.tool_force,
                "tool_force_cells": lambda: f"{tool_force_pages.AT:g}", "runs": lambda: len(self.rows),
                "percent": lambda value: digits(100 * value) + " %", "times": digits,
                "plain": lambda value: f"{value:g}", "check": check, "min": min, "max": max, "abs": abs}


def digits(value):
    """A number with two significant digits."""
    return f"{value:#.2g}".rstrip(".")


def check(holds):
    if not holds:
        raise ClaimError("the claim does not hold")
    return ""


def fill(text, names, first_line=1):
    """The text with every {{ expression }} replaced by its value."""
    def value(match):
        line = first_line + text.count("\n", 0, match.start())
        try:
            # The text is a file of this project, and sees only these names.
            return str(eval(match.group(1).strip(), {"__builtins__": {}}, names))  # pylint: disable=eval-used
        except (ClaimError, NameError, SyntaxError, TypeError) as error:
            raise ClaimError(f"{TEMPLATE.name}:{line}: {match.group(1).strip()}: {error}") from error

    return re.sub(r"\{\{(.+?)\}\}", value, text, flags=re.DOTALL)


def wrap_points(text):
    """Wraps the points of the chapter of claims, whose lines are uneven once their expressions are replaced."""
    head, rest = text.split(CLAIMS + "\n", 1)
    chapter, tail = rest.split("\n## ", 1)
    wrapped = ["" if not point.strip() else textwrap.fill(
        "- " + " ".join(point.split()), 118, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
        for point in re.split(r"^- ", chapter, flags=re.MULTILINE)]
    return head + CLAIMS + "\n\n" + "\n".join(wrapped).strip() + "\n\n## " + tail


def points(text):
    """Each point of the chapter of claims, with its line."""
    inside, found = False, []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("## "):
            inside = line == CLAIMS
        elif inside and line.startswith("- "):
            found.append([number, line])
        elif inside and found and line.startswith("  "):
            found[-1][1] += "\n" + line
    return found


def check_points(text):
    found = points(text)
    if not found:
        raise ClaimError(f"{TEMPLATE.name}: no points below '{CLAIMS}'")
    for number, point in found:
        if "check(" not in point:
            raise ClaimError(f"{TEMPLATE.name}:{number}: a point without a check")


def make(runs, doc, pages):
    text = TEMPLATE.read_text(encoding="utf-8")
    check_points(text)
    study = Study(runs, doc, pages)
    study.check_complete()
    filled = wrap_points(fill(text, study.names()))
    page, pictures = doc / "methods.md", doc / "methods"
    if pages is None and page.exists():
        filled = filled.split(LAST)[0] + LAST + page.read_text(encoding="utf-8").split(LAST, 1)[1]
    pictures.mkdir(parents=True, exist_ok=True)
    for old in pictures.glob("*.png"):
        old.unlink()
    plots.draw_all(runs, pictures)
    plot_tool_force.draw_all(runs, pictures)
    tool_force_pages.keep(runs, pictures)
    for table in TABLES:
        if runs.resolve() != pictures.resolve():
            shutil.copyfile(runs / table, pictures / table)
    (doc / "methods.md").write_text(filled.rstrip() + "\n", encoding="utf-8")
    print(f"{len(study.drawn)} charts, {len(study.rows)} runs: {doc / 'methods.md'}")


def compare(doc):
    text = TEMPLATE.read_text(encoding="utf-8")
    check_points(text)
    study = Study(doc / "methods")
    study.check_complete()
    made = wrap_points(fill(text.split(LAST)[0], study.names())).rstrip()
    kept = (doc / "methods.md").read_text(encoding="utf-8").split(LAST)[0].rstrip()
    for number, (one, other) in enumerate(zip(made.splitlines() + [""], kept.splitlines() + [""]), 1):
        if one != other:
            raise ClaimError(f"{doc / 'methods.md'}:{number}: '{other}' in place of '{one}'; run scripts/methods")


def main():
    words = sys.argv[1:]
    try:
        if len(words) == 2 and words[0] == "--check":
            compare(pathlib.Path(words[1]))
        elif len(words) in (2, 3) and not words[0].startswith("-"):
            make(pathlib.Path(words[0]), pathlib.Path(words[1]), pathlib.Path(words[2]) if words[2:] else None)
        else:
            raise SystemExit("usage: make_methods.py RUNS DOC [PAGES] | --check DOC")
    except (ClaimError, plots.TableError, plot_tool_force.TableError, OSError) as error:
        print(f"make_methods.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
