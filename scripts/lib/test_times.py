#!/usr/bin/python3
"""test_times.py ROOT TIMES [NAME=CTEST.xml...]: prints how long the stages of scripts/test took (TIMES: lines of name, tab,
microseconds), the labels of CTest in each report, and the 20 slowest cases beside what the head of their file says
that it costs."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import count_cases  # noqa: E402: the folder comes first

SLOWEST = 20
NOTABLE = 1.0  # seconds: shorter stages count in the sum alone


def said_cost(root, test):
    """Cost that the file of the CTest test "label.file" states, or nothing."""
    label, _, name = test.partition(".")
    for path in (root / "test" / label / f"{name}_test.cpp", root / "test" / label / f"{name}_node_test.cpp",
                 root / "test" / label / f"{name}_test.py"):
        if path.is_file():
            found = re.search(r"Costs?: ([0-9.]+) s", path.read_text(errors="replace"))
            if found:
                return f"{found[1]} s"
    return ""


def main():
    root, times, runs = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:]
    stages = [(name, 1e-6 * float(taken)) for name, taken in (line.split("\t") for line in times.read_text().splitlines())]
    labels, cases = {}, []
    for run in runs:
        name, tests = run.split("=", 1)
        for test, seconds, _ in count_cases.ctest_tests(tests):
            label = f"{name} {test.partition('.')[0]}"
            labels[label] = labels.get(label, 0.0) + seconds
            cost = said_cost(root, test)
            report = Path(tests).parent / "test_results" / f"{test}.xml"
            if report.is_file():
                cases += [(taken, f"{name} {test}: {case}", cost) for case, taken, _ in count_cases.gtest_cases(report)]
            else:
                cases.append((seconds, f"{name} {test}", cost))
    print("\nSeconds, by the wall clock:")
    for name, seconds in stages:
        if seconds >= NOTABLE:
            print(f"  {seconds:7.1f}  {name}")
    print(f"  {sum(seconds for _, seconds in stages):7.1f}  together")
    if labels:
        print("Of the runs, summed over tests that ran beside each other:")
        for label, seconds in sorted(labels.items(), key=lambda row: -row[1]):
            print(f"  {seconds:7.1f}  {label}")
        print(f"The {SLOWEST} slowest cases (of files that were not run again: when they last were), and the cost that their files state:")
        for seconds, name, cost in sorted(cases, reverse=True)[:SLOWEST]:
            print(f"  {seconds:7.1f}  {name}" + (f"  (file: {cost})" if cost else ""))


if __name__ == "__main__":
    main()
