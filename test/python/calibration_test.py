#!/usr/bin/env python3
"""examples/calibrate.py finds the parameters of a run from its force. 20 s; from more starts with --full alone."""
import os
import re
import subprocess
import tempfile
import unittest

from support import program, run, source_file


def calibrate(*words):
    return subprocess.run([source_file("examples/calibrate.py"), *words], capture_output=True, text=True, check=False, timeout=200)


def measure(bag, angle, modulus):
    """Records a run of the plate in sand of this angle of friction [degrees] and modulus [MPa]."""
    run(program("run_scene"), source_file("examples/plate_load.yaml"), "--bag", bag, "--set",
        f"materials.sand.friction_angle={angle} deg", "--set", f"materials.sand.young={modulus} MPa")


def values_in(printed):
    """Values that were found, by the last word of their keys."""
    found = re.findall(r"^materials\.sand\.(\S+) = (\S+) ", printed, re.MULTILINE)
    return {name: float(value) for name, value in found}


class Calibration(unittest.TestCase):
    def test_it_finds_the_parameters_of_a_run_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "measured.bag")
            measure(bag, 34, 0.8)
            done = calibrate(bag, "--out", os.path.join(folder, "runs"))
            self.assertEqual(done.returncode, 0, done.stderr)
            steps = [float(off) for off in re.findall(r"off by (\S+) % of its largest", done.stdout)]
            again = calibrate(bag, "--out", os.path.join(folder, "runs"))
            # The runs are there: the same numbers, without one of them made.
            self.assertEqual(again.stdout, done.stdout)
        found = values_in(done.stdout)
        self.assertEqual(set(found), {"friction_angle", "young"})
        # Flowing sand answers a change of its constants in jumps, which bound the search: 0.3 % at the most where it was tried.
        self.assertLess(abs(found["friction_angle"] / 34 - 1), 0.01, done.stdout)
        self.assertLess(abs(found["young"] / 0.8 - 1), 0.01, done.stdout)
        # It came from afar: the best of the sample was further off than the end by ten times and more.
        self.assertGreater(steps[0], 10 * min(steps), done.stdout)
        self.assertGreater(steps[0], 1.0, done.stdout)

    def test_it_begins_where_it_is_told_and_finds_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "measured.bag")
            measure(bag, 31, 1.1)
            done = calibrate(bag, "--start", "22", "0.4")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout.splitlines()[0], r"^  22 deg, 0\.4 MPa: ")
        found = values_in(done.stdout)
        self.assertLess(abs(found["friction_angle"] / 31 - 1), 0.02, done.stdout)
        self.assertLess(abs(found["young"] / 1.1 - 1), 0.02, done.stdout)
        outside = calibrate(bag, "--start", "50", "0.4")
        self.assertEqual(outside.returncode, 2)
        self.assertIn("materials.sand.friction_angle is 50 deg; write one between 20 and 45", outside.stderr)

    def test_a_bag_that_is_not_there_is_told_in_a_sentence(self):
        done = calibrate("none.bag")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("none.bag", done.stderr)


if __name__ == "__main__":
    unittest.main()
