#!/usr/bin/env python3
"""Examples with robots (doc/robots.md): the load of an excavator's bucket, a wheel's drawbar pull over its slip. With --full
alone: 5 min. Skipped in a build without robots."""
import glob
import importlib.util
import json
import os
import subprocess
import tempfile
import unittest

import mpm_ros
import numpy as np
from support import program, source_file

DIG = source_file("examples/excavator/dig.yaml")
GRAVITY = 9.81  # [m/s^2]
MASS = 1600 * 1.2 * 0.8 * 0.24 / 28800  # [kg] of a particle of the ground


class Excavator(unittest.TestCase):
    def test_the_load_is_that_of_the_particles_and_of_the_force(self):
        with tempfile.TemporaryDirectory() as folder:
            summary = os.path.join(folder, "summary.json")
            run = subprocess.run([program("run_scene"), DIG, "--csv", folder, "--summary", summary], text=True,
                                 capture_output=True, check=False)
            if "this build has no robots" in run.stderr:
                self.skipTest("this build has no robots")
            self.assertEqual(run.returncode, 0, run.stderr)
            forces = np.genfromtxt(os.path.join(folder, "contact_forces.csv"), delimiter=",", names=True)
            particles = np.loadtxt(sorted(glob.glob(os.path.join(folder, "particles_0*.csv")))[-1], delimiter=",",
                                   skiprows=1)
            with open(summary, encoding="utf-8") as file:
                load = json.load(file)["metrics"]["load"]
        lifted = np.count_nonzero(particles[:, 3] > 0.25) * MASS  # the ground is 0.25 m below
        self.assertGreater(lifted, 5)
        self.assertAlmostEqual(load / lifted, 1, delta=0.03)
        self.assertAlmostEqual(-forces["excavatorbucket_fz_N"][-1] / (lifted * GRAVITY), 1, delta=0.03)


class WheelTestRig(unittest.TestCase):
    def test_drawbar_pull_and_sinkage_grow_with_slip(self):
        spec = importlib.util.spec_from_file_location("rig", source_file("examples/wheel_test_rig/rig.py"))
        rig = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(rig)
        try:
            with mpm_ros.Simulator(rig.SCENE) as sim:
                low, middle, high = (rig.steady(sim, slip, 0.04) for slip in (0.0, 0.3, 0.6))
        except mpm_ros.MpmError as error:
            if "this build has no robots" in str(error):
                self.skipTest("this build has no robots")
            raise
        for _, _, lift, _ in (low, middle, high):
            self.assertAlmostEqual(lift / rig.LOAD, 1, delta=0.05)  # it neither sinks nor rises any more
        self.assertGreater(middle[0], low[0])
        # A plateau: the second half of the slip gives less than the first.
        self.assertLess(abs(high[0] - middle[0]), middle[0] - low[0])
        self.assertGreater(middle[3], low[3])
        self.assertGreater(high[3], middle[3])


if __name__ == "__main__":
    unittest.main()
