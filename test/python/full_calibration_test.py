#!/usr/bin/env python3
"""examples/calibrate.py finds the parameters of a run to 2 %, from the corners of the ranges in which it looks and from its own
sample. With --full alone: 100 s."""
import os
import tempfile
import unittest

from calibration_test import calibrate, measure, values_in


class CalibrationFromAnywhere(unittest.TestCase):
    def check(self, angle, modulus, starts):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "measured.bag")
            measure(bag, angle, modulus)
            for start in starts:
                with self.subTest(start=start):
                    done = calibrate(bag, *start)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    found = values_in(done.stdout)
                    self.assertLess(abs(found["friction_angle"] / angle - 1), 0.02, done.stdout)
                    self.assertLess(abs(found["young"] / modulus - 1), 0.02, done.stdout)

    def test_sand_of_31_degrees_from_all_corners(self):
        self.check(31, 1.1, [[], *(["--start", angle, modulus] for angle in ("20.1", "44.9") for modulus in ("0.31", "2.9"))])

    def test_firm_sand_that_is_soft(self):
        self.check(40, 0.5, [[], ["--start", "25", "2"]])


if __name__ == "__main__":
    unittest.main()
