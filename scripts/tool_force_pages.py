"""The chapter of doc/methods.md on forces of soil on tools, from the table of `work_precision --suite tool_force`."""
import json
import math
import textwrap

import plot_tool_force as plots

AT = 8.0  # cells at which lift, ripple, scatter and cost stand in the tables


def keep(runs, doc):
    """Copies the tables, without curves, a row a line."""
    for name in (plots.TABLE, plots.DEFAULTS):
        keep_table(name, runs, doc)


def keep_table(name, runs, doc):
    table = plots.read(runs, name)
    for row in table["rows"]:
        row.pop("curve", None)
        row.pop("label")
    lines = ["{", ' "problems": [']
    lines += [",\n".join("  " + json.dumps(problem, ensure_ascii=False) for problem in table["problems"]), " ],"]
    lines += [' "rows": [', ",\n".join("  " + json.dumps(row, ensure_ascii=False) for row in table["rows"]), " ]", "}"]
    (doc / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


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


def defaults_lines(table):
    """One row a problem."""
    cells = sorted({row["cells"] for row in table["rows"]})
    lines = ["| problem | known | " + " | ".join(f"{value:g}" for value in cells) + " |", "|---|---|" + "---|" * len(cells)]
    for problem in table["problems"]:
        own = {row["cells"]: row for row in table["rows"] if row["problem"] == problem["name"]}
        if own:
            lines.append(f"| {problem['title']} | {problem['known']} | " +
                         " | ".join(between(own.get(value)) for value in cells) + " |")
    return lines + [""]


def between(row):
    """The force, in bold letters where it is exact or between its bounds to 5 %."""
    text = force(row)
    return f"**{text}**" if row and row["status"] == "ok" and row["error"] is not None and row["error"] <= 0.05 else text


def chapter(folder):
    table = plots.read(folder)
    lines = ["### All problems", "",
             wrapped("Force, or what else is measured, over the exact one or the upper bound, with the method left to its "
                     "defaults. Bold: within 5 %, or between the bounds."), ""]
    lines += defaults_lines(plots.read(folder, plots.DEFAULTS))
    for problem in table["problems"]:
        rows = [row for row in table["rows"] if row["problem"] == problem["name"]]
        if rows:
            lines += problem_lines(problem, rows)
    bad = [row for row in table["rows"] if row["status"] != "ok"]
    if bad:
        lines += ["Runs that failed or were refused:", ""]
        lines += [f"- `{row['problem']}`, {row['cells']:g} cells, {row['label']}: {row['message']}" for row in bad] + [""]
    return "\n".join(lines).rstrip()
