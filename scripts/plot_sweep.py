#!/usr/bin/python3
"""plot_sweep.py SWEEP.csv PARAMETERS METRICS OUT: draws the metrics of a sweep against its parameters, OUT/sweep.png, from
the table that run_scene and bag_report write. PARAMETERS and METRICS: how many columns of the table they are.

A row for each metric and a column for each parameter; values that are words stand side by side."""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
# Its modules lie beside it, also when it runs through the wrapper of the devel space.
sys.dont_write_bytecode = True  # leaves no files among the sources
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import matplotlib.pyplot as plt  # noqa: E402
import plot_style  # noqa: E402

MOST = 6  # rows and columns of panels


def numbers(values):
    """Values as numbers; words, each in the order of its first use, as 0, 1, …, with the words as the second result."""
    try:
        return [float(value) for value in values], None
    except ValueError:
        words = list(dict.fromkeys(values))
        return [words.index(value) for value in values], words


def main():
    table, parameters, metrics, out = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    header, done = rows[0], [row for row in rows[1:] if row[-2] == "done"]
    across, down = range(1, 1 + min(parameters, MOST)), range(1 + parameters, 1 + parameters + min(metrics, MOST))
    plot_style.style()
    figure, panels = plt.subplots(len(down), len(across), squeeze=False, sharex="col", sharey="row",
                                  figsize=(1.5 + 3.2 * len(across), 1.6 + 2.4 * len(down)), layout="constrained")
    for line, metric in zip(panels, down):
        for axes, parameter in zip(line, across):
            chosen = [row for row in done if row[metric]]
            x, words = numbers([row[parameter] for row in chosen])
            axes.scatter(x, [float(row[metric]) for row in chosen], s=14, color=plot_style.BLUE, alpha=0.6, linewidths=0)
            if words:
                axes.set_xticks(range(len(words)), [word[:24] for word in words], rotation=20, ha="right")
        line[0].set_ylabel(header[metric])
    for axes, parameter in zip(panels[-1], across):
        axes.set_xlabel(header[parameter])
    left = "" if len(done) == len(rows) - 1 else f"; {len(rows) - 1 - len(done)} runs did not come to their end"
    more = f"; the first {MOST} parameters and metrics" if max(parameters, metrics) > MOST else ""
    plot_style.caption(figure, "Metrics against parameters", f"{len(done)} runs{left}{more}")
    os.makedirs(out, exist_ok=True)
    plot_style.save(figure, out, "sweep.png")


if __name__ == "__main__":
    main()
