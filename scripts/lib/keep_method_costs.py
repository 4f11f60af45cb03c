#!/usr/bin/python3
"""keep_method_costs.py RUNS TABLE: writes the figures by which `method: auto` chooses, from RUNS/work_precision.csv.

It keeps the runs in double precision that ended well and, for each method and problem, those whose error no cheaper run
reaches, to four digits, which is finer than costs are measured."""
import csv
import math
import pathlib
import sys


def keep_method_costs(runs, table):
    """Writes the table; returns the number of its runs."""
    with open(pathlib.Path(runs) / "work_precision.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "ok" and row["precision"] == "double"]
    points = {}  # in the order of the study
    for row in rows:
        error, cost = float(row["error"] or "nan"), float(row["cost"] or "nan")
        if 0.0 < error < math.inf and 0.0 < cost < math.inf:
            points.setdefault((row["suite"], row["method"]), []).append((cost, error))
    kept = []
    for (suite, method), found in points.items():
        least = math.inf
        for cost, error in sorted(found):
            if error < least:
                kept.append((suite, method, f"{error:.4g}", f"{cost:.4g}"))
                least = error
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("suite", "method", "error", "cost"))
        writer.writerows(kept)
    return len(kept)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(f"{keep_method_costs(sys.argv[1], sys.argv[2])} runs kept in {sys.argv[2]}")
