#!/usr/bin/python3
"""keep_force_errors.py RUNS TABLE: writes the figures by which `target` chooses, from the runs of scripts/force_figures.

Forces of the suite are over the exact ones, or, where only bounds or an estimate are known, over that of 12 cells. Those
of the folders named places are means over five places of tool and ground within a cell. What is kept is further from 1
than that, since a robot's tool lies anywhere and is like none of the problems: by two standard deviations over the
places, and then by a quarter (test/verification/target_promises_test.cpp has tools that the table does not know). Runs with another precision, update or step are told by
their change of the force that the same run has with double precision, USAVG and cfl 0.5. Of implicit steps, whose base
is the step of 5 ms, the length over sqrt(cell / gravity) stands in place of cfl.

That of blade_in_soil is its impulse on the blade along the direction of the answer, over the answer: twice that with
cells of 17.5 mm less that with 35 mm, in double precision with USAVG at cfl 0.5, as for an error of first order in the
cell. Its cells count across the depth to which it reaches, 0.095 m.

There are no figures for wheels: what resists a wheel that sinks by a few millimetres still grows by half with cells of a
third of its sinkage, and no answer is known."""
import csv
import json
import math
import pathlib
import sys

BLADE = 0.095  # depth in the ground [m]
SUITE = 0.2  # length that cells of the suite's problems count across [m]
GRAVITY = 9.81  # [m/s^2]
BASE_STEP = "0.005"  # of implicit steps [s]
FINEST = "12"  # cells of the suite
OF_OTHERS = 1.25  # errors of other tools over those of the problems, two standard deviations of places included
KINDS = {"blade": "blade", "strip": "plate", "disc": "plate"}  # use, by the first word of a name
FINE, COARSE = ("0.0175", "8", "double", "usavg", "0.5"), ("0.035", "8", "double", "usavg", "0.5")


def falls(step, cell):
    """A length of implicit steps [s] over sqrt(cell / gravity), as the table has it."""
    return f"{float(step) * math.sqrt(GRAVITY / cell):.4g}"


def found_in(folder):
    """Runs of the suite in a folder by (problem, cells, along, precision, update, cfl)."""
    with open(folder / "tool_force.json", encoding="utf-8") as file:
        read = json.load(file)
    known = {problem["name"]: problem["known"] for problem in read["problems"]}
    found = {}
    for run in read["rows"]:
        if run["status"] != "ok":
            continue
        said = dict(part.split("=") for part in run["variant"].split(", ") if part)
        if run["update"] == "implicit":
            said["method.update"] = "implicit"
            said["time.cfl"] = falls(said.get("time.step", BASE_STEP), SUITE / run["cells"])
        along = round(math.sqrt(float(said.get("method.particles_per_cell", 4))))
        key = (run["problem"], f"{run['cells']:g}", along, said.get("method.precision", "double"),
               said.get("method.update", "usavg"), said.get("time.cfl", "0.5"))
        found[key] = {**run, "exact": known[run["problem"]] == "exact"}
    return found


def cost_of(run):
    """Processor time of a particle's step [ns]."""
    return 1e9 * run["cpu_seconds"] / run["particles"] / run["steps"] / run.get("places", 1)


def suite_rows(runs):
    """Rows of the problems of the suite."""
    finest = found_in(runs / "finest")
    usual = ("double", "usavg", "0.5")
    rows = {}

    def keep(key, force, run):
        problem, cells, *method = key
        use = KINDS[problem.split("_")[0]]
        rows[(problem, use, "clay" if "clay" in problem else "sand", 2, cells, *method)] = (force, cost_of(run))

    def answer(run):
        return 1.0 if run["exact"] else finest[(run["problem"], FINEST, 2, *usual)]["over_exact"]

    forces = {}
    for key, run in {**found_in(runs / "places"), **found_in(runs / "places9"), **found_in(runs / "implicit_places"),
                     **finest}.items():
        off = run["over_exact"] / answer(run) - 1.0
        force = 1.0 + math.copysign(OF_OTHERS * (abs(off) + 2.0 * (run.get("spread") or 0.0)), off)
        forces[key] = force
        if run["exact"] or key[1] != FINEST:  # what is compared with itself tells nothing
            keep(key, force, run)
    for knobs in (found_in(runs / "knobs"), found_in(runs / "implicit_knobs")):
        for key, run in knobs.items():
            base = (*key[:3], *usual)
            if run["update"] == "implicit":
                base = (*key[:3], "double", "implicit", falls(BASE_STEP, SUITE / run["cells"]))
            keep(key, forces[base] * run["over_exact"] / knobs[base]["over_exact"], run)
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
    if update == "implicit":
        cfl = falls(cfl, float(cell))
    along = round(float(particles) ** (1.0 / axes))
    use = KINDS[scene.split("_")[0]]
    return (scene, use, "sand", axes, f"{length / float(cell):.4g}", along, precision, update, cfl), (force, None)


def blade_rows(runs):
    """Rows of blade_in_soil."""
    found = summaries(runs, "blade_in_soil")
    impulse = {key: run["contact_impulse"]["blade"] for key, run in found.items()}
    answer = [2.0 * fine - coarse for fine, coarse in zip(impulse[FINE], impulse[COARSE])]
    size = sum(part * part for part in answer)
    return dict(row_of("blade_in_soil", 3, BLADE, key, sum(a * b for a, b in zip(impulse[key], answer)) / size)
                for key in found)


def keep_force_errors(runs, table):
    """Writes the table; returns the number of its runs."""
    runs = pathlib.Path(runs)
    rows = {**suite_rows(runs), **blade_rows(runs)}
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("problem", "use", "ground", "axes", "cells", "along", "precision", "update", "cfl", "force", "cost"))
        for key, (force, cost) in rows.items():
            writer.writerow((*key, f"{force:.4f}", "" if cost is None else f"{cost:.4g}"))
    return len(rows)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(f"{keep_force_errors(sys.argv[1], sys.argv[2])} runs kept in {sys.argv[2]}")
