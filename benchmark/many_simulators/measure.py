#!/usr/bin/env python3
"""Measures mpm_ros.Simulators against their number: steps a second, time of a reset, of the start, and memory.

    source build/devel/setup.bash
    benchmark/many_simulators/measure.py               # the table of doc/python.md, five rounds, some three minutes
    benchmark/many_simulators/measure.py --rounds 1 --numbers 1,2

A step is 20 ms of examples/press.yaml, in which a plate presses foam, the same in all: where scenes differ, a call takes
as long as the slowest. Numbers are measured in turn, and the medians of the rounds count, since other work disturbs all
alike; the least and the most stand beside the steps a second.
"""
import argparse
import os
import statistics
import time

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../examples/press.yaml")
STEPS = 40  # of an episode


def memory_of(process):
    """Its part [kB], in which what several processes share is divided by their number."""
    with open(f"/proc/{process}/smaps_rollup", encoding="ascii") as parts:
        return next(int(line.split()[1]) for line in parts if line.startswith("Pss:"))


def measure(n, seconds):
    """(steps a second, [s] of a reset of all, [s] of the start, [kB] of a simulator)"""
    begin = time.monotonic()
    with mpm_ros.Simulators(SCENE, n) as sims:
        start = time.monotonic() - begin
        sims.step(0.02)
        steps, stepping, resets = 0, 0.0, []
        while stepping < seconds:
            begin = time.monotonic()
            sims.reset()
            between = time.monotonic()
            for _ in range(STEPS):
                sims.step(0.02, velocity={"plate": (0, 0, -0.02)})
            stepping += time.monotonic() - between
            resets.append(between - begin)
            steps += n * STEPS
        memory = sum(memory_of(process) for sim in sims for process in sim.process_ids) / n
    return steps / stepping, statistics.median(resets), start, memory


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=4.0, help="of stepping, of each number in a round")
    parser.add_argument("--numbers", default="1,2,4,8,20", help="of simulators")
    given = parser.parse_args()
    found = {int(number): [] for number in given.numbers.split(",")}
    for _ in range(given.rounds):
        for n, rounds in found.items():
            rounds.append(measure(n, given.seconds))
    print(f"{os.cpu_count()} cores, medians of {given.rounds} rounds\n")
    print("| simulators | steps a second (least to most) | a call | a reset of all | start | memory of each |")
    print("|---|---|---|---|---|---|")
    for n, rounds in found.items():
        rates = [rate for rate, *_ in rounds]
        rate, reset, start, memory = (statistics.median(column) for column in zip(*rounds))
        print(f"| {n} | {rate:.0f} ({min(rates):.0f} to {max(rates):.0f}) | {1e3 * n / rate:.0f} ms | {1e3 * reset:.0f} ms | "
              f"{start:.1f} s | {memory / 1e3:.0f} MB |")


if __name__ == "__main__":
    main()
