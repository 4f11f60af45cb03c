#!/usr/bin/python3
"""plot_steps.py DIR OUT: draws the error of the force on blades in soil against the real-time factor, with explicit and with
implicit steps, as the picture OUT, from DIR/tool_force.json. It is written by

    work_precision --suite tool_force --places --cells 3,4,6,8 --out DIR --no-charts --problem blade_flat \\
        --problem blade_chisel --problem blade_rough --problem blade_flat_0 \\
        --vary "method={update: usavg}|{update: implicit}"

The error is that of the mean over five places of tool and ground within a cell and the standard deviation over them, as
the root of the sum of their squares; where only bounds are known, that of the mean is its distance from them."""
import math
import os
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
sys.dont_write_bytecode = True  # leaves no files among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402
import plot_style  # noqa: E402
from plot_style import BLUE, RED  # noqa: E402
from plot_tool_force import TableError, read  # noqa: E402

KINDS = {"usavg": ("explicit", RED), "implicit": ("implicit", BLUE)}


def error_of(row):
    """Of the force, relative, of any place."""
    return math.hypot(row["error"], row["spread"] or 0.0)


def draw(table, path):
    """One panel a problem, one line for each kind of step."""
    problems = [one for one in table["problems"] if any(row["problem"] == one["name"] for row in table["rows"])]
    figure, panels = plt.subplots(1, len(problems), figsize=(3.4 * len(problems), 3.8), sharey=True, squeeze=False,
                                  constrained_layout=True)
    for axes, problem in zip(panels[0], problems):
        for update, (name, colour) in KINDS.items():
            rows = sorted((row for row in table["rows"] if row["problem"] == problem["name"] and row["status"] == "ok"
                           and row["update"] == update), key=lambda row: row["cells"])
            axes.plot([row["real_time_factor"] for row in rows], [error_of(row) for row in rows], marker="o",
                      color=colour, label=name)
            for row in rows:
                axes.annotate(f"{row['cells']:g}", (row["real_time_factor"], error_of(row)), xytext=(4, 4),
                              textcoords="offset points", fontsize=8, color=colour)
        axes.set(xscale="log", yscale="log", title=textwrap.fill(problem["title"], 26), xlabel="simulated time over processor time")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g} %"))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panels[0][0].set_ylabel("error of the force, any place")
    panels[0][-1].legend(fontsize=8)
    plot_style.caption(figure, "The force on a blade against pace", "numbers: cells over the depth  ·  one thread  ·  "
                       "mean and deviation over five places within a cell")
    figure.savefig(path)


def main():
    """Reads the table, draws the picture."""
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        table = read(sys.argv[1])
    except TableError as error:
        sys.exit(str(error))
    plot_style.style()
    draw(table, sys.argv[2])


if __name__ == "__main__":
    main()
