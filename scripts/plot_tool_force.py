#!/usr/bin/python3
"""plot_tool_force.py DIR [OUT]: draws error of force against processor time and against real-time factor,
OUT/tool_force_<problem>.png for each problem, from DIR/tool_force.json, which `work_precision --suite tool_force` writes.
OUT is DIR when it is left out.

Colour: where contact acts, and whether volume changes are averaged; line: transfer. A line joins the numbers of cells. The
marks of runs that failed stand at the top."""
import argparse
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
# Its modules lie beside it, also when it runs through the wrapper of the devel space.
sys.dont_write_bytecode = True  # leaves no files among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402
import plot_style  # noqa: E402
from plot_style import BLACK, BLUE, CYCLE, ORANGE, RED, SKY  # noqa: E402

TABLE = "tool_force.json"
DEFAULTS = "tool_force_defaults.json"  # every problem with the method left to its defaults
COLOURS = {("points", False): BLUE, ("points", True): SKY, ("nodes", False): RED, ("nodes", True): ORANGE}
LINES = [("-", "o"), ("--", "s"), (":", "^"), ("-.", "D")]
COSTS = {"cpu_seconds": "processor time of one thread [s]", "real_time_factor": "simulated time over processor time"}
LEAST, MOST = 1e-3, 3.0  # errors beyond are drawn on the border


class TableError(Exception):
    """The table is missing or has another layout; the message is one line."""


def read(folder, name=TABLE):
    """The table, {problems, rows}; each row with `label` and `error` as a number or None."""
    path = os.path.join(folder, name)
    try:
        with open(path, encoding="utf-8") as file:
            table = json.load(file)
        for row in table["rows"]:
            row["label"] = label(row)
    except (OSError, ValueError, KeyError) as error:
        raise TableError(f"{path}: missing or not a table of tool_force ({error}); run work_precision --suite tool_force"
                         ) from error
    return table


def label(row):
    """What was varied, in words: "points, flip0.99, averaged"."""
    known = ("contact.method", "method.average_dilatation", "method.transfer")
    other = [part for part in row["variant"].split(", ") if part and not part.startswith(known) and "=" in part]
    words = [row["contact"], row["transfer"]] + (["averaged"] if row["average_dilatation"] else []) + other
    return ", ".join(words)


def looks(rows):
    """{label: (colour, line, mark)}."""
    transfers = list(dict.fromkeys(row["transfer"] for row in rows))
    found, others = {}, 0
    for row in rows:
        if row["label"] in found:
            continue
        plain = label({**row, "variant": ""}) == row["label"]
        colour = COLOURS[row["contact"], row["average_dilatation"]]
        if not plain:
            colour = CYCLE[others % len(CYCLE)]
            others += 1
        found[row["label"]] = (colour, *LINES[transfers.index(row["transfer"]) % len(LINES)])
    return found


def draw(problem, rows, path):
    figure, panels = plt.subplots(1, 2, figsize=(11, 3.9), sharey=True, constrained_layout=True)
    look = looks(rows)
    for axes, (cost, name) in zip(panels, COSTS.items()):
        for one, (colour, line, mark) in look.items():
            runs = sorted((row for row in rows if row["label"] == one and row[cost]), key=lambda row: row["cells"])
            good = [row for row in runs if row["status"] == "ok" and row["error"] is not None]
            axes.plot([row[cost] for row in good], [min(max(row["error"], LEAST), MOST) for row in good], color=colour,
                      linestyle=line, marker=mark, markersize=4, linewidth=1.2,
                      markerfacecolor=colour if line == "-" else "white")
            failed = [row for row in runs if row["status"] == "failed"]
            axes.plot([row[cost] for row in failed], [MOST] * len(failed), color=colour, linestyle="", marker="x")
        axes.set(xscale="log", yscale="log", xlabel=name, ylim=(0.8 * LEAST, 1.2 * MOST))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g} %"))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.axhline(0.05, color=BLACK, linewidth=0.8, linestyle=(0, (1, 2)))
    panels[0].set_ylabel("error of the force")
    handles = [Line2D([], [], color=colour, linestyle=line, marker=mark, markersize=4, linewidth=1.2,
                      markerfacecolor=colour if line == "-" else "white", label=one)
               for one, (colour, line, mark) in look.items()]
    panels[1].legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=8)
    cells = ", ".join(f"{value:g}" for value in sorted({row["cells"] for row in rows}))
    plot_style.caption(figure, problem["title"],
                       f"Cells: {cells}. Dotted: 5 %. Errors below 0.1 % and above 300 % are drawn on the border.")
    figure.savefig(path)
    plt.close(figure)


def draw_all(folder, out):
    """Draws every problem that has rows; their names."""
    table = read(folder)
    plot_style.style()
    names = []
    for problem in table["problems"]:
        rows = [row for row in table["rows"] if row["problem"] == problem["name"] and row["status"] != "refused"]
        if rows:
            draw(problem, rows, os.path.join(out, f"tool_force_{problem['name']}.png"))
            names.append(problem["name"])
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("out", nargs="?")
    arguments = parser.parse_args()
    try:
        for name in draw_all(arguments.folder, arguments.out or arguments.folder):
            print(f"tool_force_{name}.png")
    except (TableError, OSError) as error:
        print(f"plot_tool_force.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
