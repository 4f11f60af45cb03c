#!/usr/bin/python3
"""count_cases.py CTEST.xml RESULTS: prints how many cases passed and failed. A CTest test that left a report of GoogleTest in
the folder RESULTS counts with its cases, any other as one; skipped ones count neither way. Ends with 1 where nothing ran."""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def gtest_cases(report):
    """(name, seconds, passed) of each case that ran, by GoogleTest's report."""
    for case in ElementTree.parse(report).getroot().iter("testcase"):
        if case.get("status") == "run" and case.find("skipped") is None:
            name = f"{case.get('classname')}.{case.get('name')}"
            yield name, float(case.get("time")), case.find("failure") is None


def ctest_tests(report):
    """(name, seconds, passed) of each CTest test that ran."""
    for case in ElementTree.parse(report).getroot().iter("testcase"):
        if case.get("status") in ("run", "fail"):
            yield case.get("name"), float(case.get("time")), case.get("status") == "run"


def count(report, results):
    passed = failed = 0
    for name, _, well in ctest_tests(report):
        cases = Path(results) / f"{name}.xml"
        good = bad = 0
        if cases.is_file():
            outcomes = [case[2] for case in gtest_cases(cases)]
            good, bad = outcomes.count(True), outcomes.count(False)
        else:
            good = int(well)
        if not well and bad == 0:
            bad = 1  # it crashed, or was stopped
        passed += good
        failed += bad
    return passed, failed


def main():
    report, results = sys.argv[1:]
    try:
        passed, failed = count(report, results)
    except (OSError, ElementTree.ParseError) as error:
        raise SystemExit(f"count_cases: {error}")
    if passed + failed == 0:
        raise SystemExit("count_cases: no test ran")
    print(passed, failed)


if __name__ == "__main__":
    main()
