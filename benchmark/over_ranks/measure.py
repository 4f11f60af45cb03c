#!/usr/bin/env python3
"""Measures one scene over ranks against threads of one process: time, messages, bytes and memory.

    scripts/build --mpi
    source build_mpi/devel/setup.bash
    benchmark/over_ranks/measure.py                # the tables of scaling in doc/ranks.md, three rounds
    benchmark/over_ranks/measure.py --rounds 1 --strong 2 --weak ""

Strong: speed_block_3d_million, a million particles in all. Weak: bars of the same cross-section, 250,000 particles a
rank. Runs of a table are made in turn, and the median of the rounds counts, since other work disturbs all alike.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1")
SCENE = "speed_block_3d_million"


def run(ranks, threads, settings):
    """The summary of one run; threads of each rank."""
    with tempfile.TemporaryDirectory() as folder:
        summary = os.path.join(folder, "summary.json")
        command = ["rosrun", "mpm_ros", "run_scene", SCENE, "--threads", str(threads), "--summary", summary]
        for setting in settings:
            command += ["--set", setting]
        if ranks > 1:
            command = ["mpirun", "-n", str(ranks)] + command
        done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()}")
        with open(summary) as file:
            return json.load(file)


def bar(ranks):
    """A bar of 50 by 50 cells, and 25 cells long for each rank."""
    length = 0.25 * ranks
    return [f"grid.max=[{length + 0.4}, 0.9, 0.9]", "bodies.block.shape.box.max=[%g, 0.5, 0.5]" % length]


def measure(cases, rounds):
    """[(label, ranks, threads, settings)] -> [(label, ranks, [summary])]"""
    found = [(label, ranks, []) for label, ranks, _, _ in cases]
    for _ in range(rounds):
        for (_, ranks, threads, settings), (_, _, summaries) in zip(cases, found):
            summaries.append(run(ranks, threads, settings))
    return found


def table(found):
    """Markdown: times are medians; what is counted is the same in every round."""
    print("| | time a step | particle steps a second | messages a step and rank | bytes a step and rank | "
          "peak memory of the fullest rank |")
    print("|---|---|---|---|---|---|")
    for label, ranks, summaries in found:
        one = summaries[0]
        wall = statistics.median(summary["wall_seconds"] for summary in summaries)
        sent = one.get("communication", {"messages": 0, "bytes": 0})
        per = one["steps"] * ranks
        print(f"| {label} | {1e3 * wall / one['steps']:.1f} ms | {one['particles'] * one['steps'] / wall / 1e6:.1f} million | "
              f"{sent['messages'] / per:.1f} | {sent['bytes'] / per / 1e6:.2f} MB | "
              f"{one['peak_memory_bytes'] / 1e6:.0f} MB |")


def numbers(text):
    return [int(number) for number in text.split(",") if number]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--end", default="0.02", help="simulated seconds of a run (default 0.02: 155 steps)")
    parser.add_argument("--strong", default="1,2", help="numbers of ranks (default 1,2)")
    parser.add_argument("--weak", default="1,2", help="numbers of ranks (default 1,2)")
    given = parser.parse_args()
    settings = [f"time.end={given.end}"]
    strong, weak = numbers(given.strong), numbers(given.weak)
    if strong:
        cases = [(f"{n} thread{'s' * (n > 1)}", 1, n, settings) for n in strong if n <= (os.cpu_count() or 1)]
        cases += [(f"{n} ranks", n, 1, settings) for n in strong if n > 1]
        table(measure(cases, given.rounds))
        print()
    if weak:
        table(measure([(f"{n} rank{'s' * (n > 1)}", n, 1, settings + bar(n)) for n in weak], given.rounds))


if __name__ == "__main__":
    main()
