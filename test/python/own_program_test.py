#!/usr/bin/env python3
"""examples/own_program is built against this package as a user builds it, and presses foam as far as theory says. 20 s."""
import os
import re
import subprocess
import tempfile
import unittest

from support import run, source_file

FOLDER = source_file("examples/own_program")


class OwnProgram(unittest.TestCase):
    def test_it_is_built_and_presses_as_far_as_theory_says(self):
        with tempfile.TemporaryDirectory() as build:
            run("cmake", "-S", FOLDER, "-B", build, "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
            run("cmake", "--build", build)
            program = os.path.join(build, "devel/lib/mpm_own_program/press_foam")
            lines = run(program, os.path.join(FOLDER, "foam.yaml")).splitlines()
            bad = subprocess.run([program, "nowhere.yaml"], capture_output=True, text=True, check=False)
        rows = [[float(cell) for cell in line.split()] for line in lines[2:-1]]
        self.assertEqual([row[0] for row in rows], [k / 10 for k in range(1, 16)])
        _, force, speed, way, stress = rows[-1]
        # The controller has settled: its force is the wanted one. Everything else follows from it. A = 0.02 m^2.
        self.assertAlmostEqual(force, 20.0, delta=0.01)
        self.assertAlmostEqual(speed, 0.0, delta=0.01)
        self.assertAlmostEqual(stress, -20.0 / 0.02, delta=1.0)
        # M = 1e5 Pa * 0.8 / (1.2 * 0.6); with the rate of stress that of strain, F / A = M ln(H / (H - d)): d = 0.896 mm.
        self.assertAlmostEqual(way, -0.896, delta=0.005)
        # A loop of the first order: it does not press harder on its way.
        self.assertLess(max(row[1] for row in rows), 20.01)
        self.assertLess(float(re.search(r"closes to (\S+)$", lines[-1]).group(1)), 1e-10)
        self.assertEqual(bad.returncode, 2)
        self.assertIn("nowhere.yaml", bad.stderr)


if __name__ == "__main__":
    unittest.main()
