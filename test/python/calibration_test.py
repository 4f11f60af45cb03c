#!/usr/bin/env python3
"""examples/calibrate.py finds the parameters of a run from its force. 10 s."""
import os
import re
import subprocess
import tempfile
import unittest

from support import program, run, source_file


class Calibration(unittest.TestCase):
    def calibrate(self, *words):
        return subprocess.run([source_file("examples/calibrate.py"), *words], capture_output=True, text=True, check=False,
                              timeout=200)

    def test_it_finds_the_parameters_of_a_run_of_its_own(self):
        expected = {"materials.sand.friction_angle": 34.0, "materials.sand.young": 0.8}
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "measured.bag")
            run(program("run_scene"), source_file("examples/plate_load.yaml"), "--bag", bag,
                "--set", "materials.sand.friction_angle=34 deg", "--set", "materials.sand.young=0.8 MPa")
            done = self.calibrate(bag, "--out", os.path.join(folder, "runs"))
            self.assertEqual(done.returncode, 0, done.stderr)
            steps = [float(off) for off in re.findall(r"off by (\S+) % of its largest", done.stdout)]
            again = self.calibrate(bag, "--out", os.path.join(folder, "runs"))
            # The runs are there: the same numbers, without one of them made.
            self.assertEqual(again.stdout, done.stdout)
        found = dict(re.findall(r"^(\S+) = (\S+) ", done.stdout, re.MULTILINE))
        self.assertEqual(set(found), set(expected))
        # Sand that flows answers a change of its constants in jumps of half a per cent of the force, which bound the search.
        for name, value in expected.items():
            self.assertLess(abs(float(found[name]) / value - 1), 0.03, done.stdout)
        # It came from afar: the best of the sample was further off than the end by ten times and more.
        self.assertGreater(steps[0], 10 * min(steps), done.stdout)
        self.assertGreater(steps[0], 1.0, done.stdout)

    def test_a_bag_that_is_not_there_is_told_in_a_sentence(self):
        done = self.calibrate("none.bag")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("none.bag", done.stderr)


if __name__ == "__main__":
    unittest.main()
