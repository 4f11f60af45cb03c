#!/usr/bin/python3
"""Counts the instructions a particle-step of plain scenes and compares them with recorded figures.

Two runs of a scene under callgrind differ only in the number of steps. The difference of their instructions, over
particles and steps, therefore leaves out the start and the end of a run. The kernels are those of the plain path on one
thread, so that the figure depends on the compiler, not on the machine. A feature that a scene does not name must not
change the figure (doc/architecture.md: what is not named adds no pass, no field and no branch). A change of the kernels
does change it; record it anew then.

  check_work.py RUN_SCENE COMPILER WORK.yaml [--record]

Exit code 77 (skipped) when the figures were recorded with another compiler, or there is no valgrind."""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import yaml

SKIPPED = 77
SHORT, LONG = 0.02, 0.06  # ends of the runs [s]


def count(program, scene, settings, end):
    """(instructions, particle-steps) of a run until `end`."""
    with tempfile.TemporaryDirectory() as folder:
        summary, costs = pathlib.Path(folder) / "summary.json", pathlib.Path(folder) / "callgrind"
        changes = [word for setting in settings for word in ("--set", setting)]
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={costs}", program, scene, "--isa", "plain",
             "--threads", "1", "--end", str(end), "--summary", summary, *changes],
            # Without a home a run of a second or more does not keep its cost, which would count as steps.
            env={**os.environ, "OMP_WAIT_POLICY": "passive", "HOME": "", "XDG_CACHE_HOME": ""}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, check=False)
        if run.returncode != 0:
            sys.exit(f"{scene}: exit code {run.returncode}\n{run.stdout}")
        found = json.loads(summary.read_text())
        totals = [line for line in costs.read_text().splitlines() if line.startswith(("summary:", "totals:"))]
        return int(totals[-1].split()[1]), found["particles"] * found["steps"]


def instructions_a_particle_step(program, scene, settings):
    short, long = (count(program, scene, settings, end) for end in (SHORT, LONG))
    return (long[0] - short[0]) / (long[1] - short[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("compiler", help="name and version")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--record", action="store_true", help="write the figures instead of comparing them")
    options = parser.parse_args()
    work = yaml.safe_load(options.work.read_text())
    if shutil.which("valgrind") is None:
        print("there is no valgrind")
        sys.exit(SKIPPED)
    if not options.record and work["compiler"] != options.compiler:
        print(f"recorded with {work['compiler']}, this is {options.compiler}")
        sys.exit(SKIPPED)

    failed = False
    for case in work["cases"]:
        found = instructions_a_particle_step(options.program, options.work.parent / case["scene"],
                                             case.get("settings", []))
        expected = case["instructions"]
        change = found / expected - 1.0
        print(f"{case['name']}: {found:.1f} instructions a particle-step, recorded {expected:.1f} ({change:+.2%})")
        failed = failed or abs(change) > work["tolerance"]
        case["instructions"] = round(found, 1)
    if options.record:
        head = "".join(line for line in options.work.read_text().splitlines(True) if line.startswith("#"))
        work["compiler"] = options.compiler
        options.work.write_text(head + yaml.safe_dump(work, sort_keys=False, width=120))
    elif failed:
        sys.exit("the work of a plain scene has changed. If the kernels were meant to change, record it: "
                 "check_work.py … --record; if a feature was added, the scene pays for what it does not name")


if __name__ == "__main__":
    main()
