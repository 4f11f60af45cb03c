#!/usr/bin/python3
"""keep_force_errors.py RUNS TABLE: writes the figures by which `target` chooses, from the runs of scripts/force_figures.

Forces of the suite are over the exact ones. That of blade_in_soil is its impulse on the blade along the direction of the
answer, over the answer: twice that with cells of 17.5 mm less that with 35 mm, in double precision with USAVG at cfl 0.5,
as for an error of first order in the cell. That of wheel_in_sand, whose load is given, is the work of its drive over that
with cells of 10 mm at cfl 0.4; runs that differ by round-off alone differ by 4 % in it, so it tells of grids alone. Cells count across 0.3104 m, the middle one of the blade's extents, and 0.2994 m, the wheel's."""
import csv
import json
import math
import pathlib
import sys

BLADE, WHEEL = 0.3104, 0.2994  # length [m]
FINE, COARSE = ("0.0175", "8", "double", "usavg", "0.5"), ("0.035", "8", "double", "usavg", "0.5")
FINE_WHEEL = ("0.01", "4", "double", "usavg", "0.4")


def suite_rows(runs):
    """Rows of the problems with exact answers."""
    rows = {}
    for name in ("knobs", "grid"):
        with open(runs / name / "tool_force.json", encoding="utf-8") as file:
            found = json.load(file)["rows"]
        for run in found:
            if run["status"] != "ok":
                continue
            said = dict(part.split("=") for part in run["variant"].split(", "))
            along = round(math.sqrt(float(said.get("method.particles_per_cell", 4))))
            key = (run["problem"], 2, f"{run['cells']:g}", along, said.get("method.precision", "double"),
                   said.get("method.update", "usavg"), said.get("time.cfl", "0.5"))
            rows.setdefault(key, (run["over_exact"], 1e9 * run["cpu_seconds"] / run["particles"] / run["steps"]))
    return rows


def summaries(runs, scene):
    """Summaries of a scene's runs by (cell, particles, precision, update, cfl), the coarsest first."""
    found = {}
    for path in sorted(runs.glob(f"{scene},*.json")):
        with open(path, encoding="utf-8") as file:
            found[tuple(path.name[: -len(".json")].split(",")[1:])] = json.load(file)
    return dict(sorted(found.items(), key=lambda item: (-float(item[0][0]), item[0][1:])))


def row_of(scene, axes, length, key, force):
    """A row of the table: key and values."""
    cell, particles, precision, update, cfl = key
    along = round(float(particles) ** (1.0 / axes))
    return (scene, axes, f"{length / float(cell):.4g}", along, precision, update, cfl), (force, None)


def blade_rows(runs):
    """Rows of blade_in_soil."""
    found = summaries(runs, "blade_in_soil")
    impulse = {key: run["contact_impulse"]["blade"] for key, run in found.items()}
    answer = [2.0 * fine - coarse for fine, coarse in zip(impulse[FINE], impulse[COARSE])]
    size = sum(part * part for part in answer)
    return dict(row_of("blade_in_soil", 3, BLADE, key, sum(a * b for a, b in zip(impulse[key], answer)) / size)
                for key in found)


def wheel_rows(runs):
    """Rows of wheel_in_sand."""
    found = summaries(runs, "wheel_in_sand")
    work = {key: run["energy"]["end"]["contact_work"] for key, run in found.items()}
    return dict(row_of("wheel_in_sand", 2, WHEEL, key, work[key] / work[FINE_WHEEL])
                for key in found if key[2:] == ("double", "usavg", "0.5"))


def keep_force_errors(runs, table):
    """Writes the table; returns the number of its runs."""
    runs = pathlib.Path(runs)
    rows = {**suite_rows(runs), **wheel_rows(runs), **blade_rows(runs)}
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("problem", "axes", "cells", "along", "precision", "update", "cfl", "force", "cost"))
        for key, (force, cost) in rows.items():
            writer.writerow((*key, f"{force:.4f}", "" if cost is None else f"{cost:.4g}"))
    return len(rows)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(f"{keep_force_errors(sys.argv[1], sys.argv[2])} runs kept in {sys.argv[2]}")
