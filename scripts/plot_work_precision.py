#!/usr/bin/python3
"""plot_work_precision.py DIR [OUT]: draws error against cost, OUT/<suite>.png for each suite, from the table
DIR/work_precision.csv that the program work_precision writes. OUT is DIR when it is left out.

The upper panels show shape functions (colour) and updates (line), all with FLIP. The lower panels show transfers
(colour) with USAVG, by shape function (line). Lines join the grids at the usual time step and number of particles; small
marks are other time steps and numbers on one of the grids. The grey band is the front of all methods together: no
cheaper method is as accurate."""
import argparse
import csv
import math
import os
import sys

import matplotlib

matplotlib.use("Agg")
# Its modules lie beside it, also when it runs through the wrapper of the devel space.
sys.dont_write_bytecode = True  # leaves no files among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402
import plot_style  # noqa: E402
from plot_style import BLACK, BLUE, GREEN, ORANGE, PINK, RED, SKY  # noqa: E402

SHAPES = {"dirac": "#888888", "ugimp": BLUE, "ugimp_stretch": SKY, "cpdi": RED, "qcpdi": ORANGE, "bspline2": GREEN,
          "bspline3": PINK}
UPDATES = {"usavg": ("-", "o"), "usf": ("--", "s"), "usl": (":", "^")}
# One colour for each family, darker with the order.
TRANSFERS = {"flip": BLACK, "flip0.99": "#888888", "pic": SKY, "xpic2": "#F5B041", "xpic3": "#B9770E",
             "fmpm2": "#7DCEA0", "fmpm3": "#229954", "fmpm5": "#0B5345", "apic": PINK}
TRANSFER_SHAPES = {"ugimp": ("-", "o"), "cpdi": ("--", "s"), "bspline2": (":", "D")}
COSTS = {"cpu_seconds": "processor time of one thread [s]", "work": "counted work [visits of a node by a particle]"}
USUAL_CFL = 0.5
SOME = 3.0  # larger errors are not drawn: nothing is right there
NUMBERS = ("cells", "ppc", "cfl", "steps", "particles", "error", "cpu_seconds", "relative_cost", "cost", "work")


class TableError(Exception):
    """A table is missing or has another layout; the message is one line."""


def read_rows(folder):
    """Rows of work_precision.csv as dictionaries, numbers as numbers, NaN where a cell is empty."""
    path = os.path.join(folder, "work_precision.csv")
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise TableError(f"{path}: {error.strerror}; run work_precision first") from error
    try:
        for row in rows:
            for key in NUMBERS:
                row[key] = float(row[key]) if row[key] else math.nan
    except (KeyError, ValueError) as error:
        raise TableError(f"{path}: not a table of work_precision ({error})") from error
    if not rows:
        raise TableError(f"{path}: no run in it")
    return rows


def read_texts(folder):
    """The texts of suites.csv for each suite: {name: {title, geometry, problem, exact, measure}}."""
    path = os.path.join(folder, "suites.csv")
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return {row["suite"]: row for row in csv.DictReader(file)}
    except (OSError, KeyError) as error:
        raise TableError(f"{path}: missing or not a table of work_precision; run it again") from error


def usual_particles(row):
    return row["ppc"] == {"line": 2, "solid": 8}.get(row["geometry"], 4)


def front(points):
    """The points (cost, error) whose error no cheaper point reaches."""
    best = []
    for cost, error in sorted(points):
        if not best or error < best[-1][1]:
            best.append((cost, error))
    return best


def draw_methods(axes, rows, cost, look):
    """Draws the rows; `look` returns (colour, line, mark) of a row, or None for a row that is not drawn here."""
    methods = {}
    for row in rows:
        if row["status"] == "ok" and look(row):
            methods.setdefault(row["method"], []).append(row)
    for runs in methods.values():
        colour, line, mark = look(runs[0])
        usual = sorted((r for r in runs if r["cfl"] == USUAL_CFL and usual_particles(r)), key=lambda r: r["cells"])
        hollow = line != "-"
        axes.plot([r[cost] for r in usual], [r["error"] for r in usual], linestyle=line, marker=mark, color=colour,
                  markersize=4.5, markerfacecolor="white" if hollow else colour, linewidth=1.3, zorder=3)
        others = [r for r in runs if r not in usual]
        axes.plot([r[cost] for r in others], [r["error"] for r in others], linestyle="", marker=mark, color=colour,
                  markersize=2.5, alpha=0.55, zorder=2)


def percent(value, _):
    return f"{100 * value:g} %"


def shape_look(row):
    if row["transfer"] != "flip" or row["precision"] != "double":
        return None
    return (SHAPES[row["shape"]], *UPDATES[row["update"]])


def transfer_look(row):
    if row["update"] != "usavg" or row["shape"] not in TRANSFER_SHAPES or row["precision"] != "double":
        return None
    return (TRANSFERS[row["transfer"]], *TRANSFER_SHAPES[row["shape"]])


def legend(axes, rows, look, colours, lines, titles):
    drawn = [row for row in rows if row["status"] == "ok" and look(row)]
    seen_colours = {look(row)[0] for row in drawn}
    seen_lines = {look(row)[1] for row in drawn}
    handles = [Line2D([], [], linestyle="", label=titles[0])]
    handles += [Line2D([], [], color=c, linewidth=2.5, label=name) for name, c in colours.items() if c in seen_colours]
    handles += [Line2D([], [], linestyle="", label=""), Line2D([], [], linestyle="", label=titles[1])]
    handles += [Line2D([], [], color=BLACK, linestyle=line, marker=mark, markersize=4.5,
                       markerfacecolor="white" if line != "-" else BLACK, linewidth=1.3, label=name)
                for name, (line, mark) in lines.items() if line in seen_lines]
    found = axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.02), handlelength=2.6, fontsize=9)
    for text in found.get_texts():
        if text.get_text() in titles:
            text.set_fontweight("bold")


def not_drawn(rows):
    """A sentence about the runs that failed or were refused."""
    parts = []
    for status in ("failed", "refused"):
        methods = {}
        for row in rows:
            if row["status"] == status:
                methods[row["method"]] = methods.get(row["method"], 0) + 1
        if methods and status == "failed":
            parts.append("Failed: " + ", ".join(f"{name} ({count})" for name, count in methods.items()) + ".")
        elif methods:
            parts.append(f"Refused: {len(methods)} methods, see the table.")
    return " ".join(parts)


def good(rows):
    """The rows that can be drawn."""
    return [row for row in rows if row["status"] == "ok" and row["error"] > 0]


def draw_suite(title, rows, path):
    drawn = good(rows)
    if not drawn:
        return False
    figure, panels = plt.subplots(2, 2, figsize=(11.5, 9.2), layout="constrained", sharey=True, sharex="col")
    for column, (cost, label) in enumerate(COSTS.items()):
        best = front([(row[cost], row["error"]) for row in drawn if row[cost] > 0])
        for axes, look in zip(panels[:, column], (shape_look, transfer_look)):
            axes.plot(*zip(*best), color="#dddddd", linewidth=7, solid_capstyle="round", solid_joinstyle="round",
                      zorder=1)
            draw_methods(axes, rows, cost, look)
            axes.set_xscale("log")
            axes.set_yscale("log")
        panels[1, column].set_xlabel(label)
    errors = [row["error"] for row in drawn]
    panels[0, 0].set_ylim(0.6 * min(errors), 1.6 * min(SOME, max(errors)))
    for axes in panels[:, 0]:
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 3)))
        axes.yaxis.set_major_formatter(FuncFormatter(percent))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set_ylabel("error")
    panels[0, 0].set_title("Shape functions and updates, with FLIP")
    panels[1, 0].set_title("Transfers, with USAVG")
    legend(panels[0, 1], rows, shape_look, SHAPES, UPDATES, ("Shape function", "Update"))
    legend(panels[1, 1], rows, transfer_look, TRANSFERS, TRANSFER_SHAPES, ("Transfer", "Shape function"))
    plot_style.caption(figure, title, f"Error: {rows[0]['error_measure']}. Small marks: other time steps and particles "
                       f"a cell on one grid. Grey band: front of all methods. {not_drawn(rows)}")
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)
    return True


def draw_all(folder, out):
    plot_style.style()
    os.makedirs(out, exist_ok=True)
    rows, texts = read_rows(folder), read_texts(folder)
    drawn = []
    for suite in dict.fromkeys(row["suite"] for row in rows):
        own = [row for row in rows if row["suite"] == suite]
        if draw_suite(texts[suite]["title"], own, os.path.join(out, suite + ".png")):
            drawn.append(suite)
    return drawn


def main():
    parser = argparse.ArgumentParser(description="Charts of error against cost.")
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("out", metavar="OUT", nargs="?")
    options = parser.parse_args()
    try:
        drawn = draw_all(options.folder, options.out or options.folder)
    except (TableError, OSError) as error:
        print(f"plot_work_precision.py: {error}", file=sys.stderr)
        return 2
    print(f"{len(drawn)} charts: {options.out or options.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
