#!/usr/bin/env python3
"""Examples with robots (doc/robot_examples.md): the load of an excavator's bucket, a wheel's drawbar pull over its slip, a rover's
slip over the slope, hops of a leg. With --full alone: 8 min. Skipped in a build without robots."""
import contextlib
import glob
import importlib.util
import json
import math
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


def example(path):
    """The program of an example, as a module."""
    spec = importlib.util.spec_from_file_location(os.path.basename(path)[:-3], source_file("examples/" + path))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@contextlib.contextmanager
def simulator(scene):
    """Skips the test in a build without robots."""
    try:
        with mpm_ros.Simulator(scene) as sim:
            yield sim
    except mpm_ros.MpmError as error:
        if "this build has no robots" in str(error):
            raise unittest.SkipTest("this build has no robots") from error
        raise


class WheelTestRig(unittest.TestCase):
    def test_drawbar_pull_and_sinkage_grow_with_slip(self):
        rig = example("wheel_test_rig/rig.py")
        with simulator(rig.SCENE) as sim:
            low, middle, high = (rig.steady(sim, slip, 0.04) for slip in (0.0, 0.3, 0.6))
        for _, _, lift, _ in (low, middle, high):
            self.assertAlmostEqual(lift / rig.LOAD, 1, delta=0.05)  # it neither sinks nor rises any more
        self.assertGreater(middle[0], low[0])
        # A plateau: the second half of the slip gives less than the first.
        self.assertLess(abs(high[0] - middle[0]), middle[0] - low[0])
        self.assertGreater(middle[3], low[3])
        self.assertGreater(high[3], middle[3])


class Rover(unittest.TestCase):
    def test_slip_and_sinkage_grow_with_the_slope(self):
        slope = example("rover/slope.py")
        with simulator(slope.SCENE) as sim:
            level, steep = (slope.climb(sim, math.radians(degrees)) for degrees in (0, 15))
        # Steady travel: the sand holds the rover against its weight along the slope. Half a percent of the weight is a change of
        # speed of 0.1 m/s in the 2 s of the mean, of 0.24 m/s.
        self.assertAlmostEqual(level[4], 0, delta=0.005)
        self.assertAlmostEqual(steep[4], math.sin(math.radians(15)), delta=0.005)
        self.assertGreater(level[0], -0.01)  # a driven wheel that is not pushed runs no faster than it rolls
        self.assertGreater(steep[0], level[0])
        self.assertGreater(steep[2], level[2])
        # Behind, where the weight shifts to, it sinks more.
        self.assertGreater(steep[2], steep[1])
        self.assertGreater(steep[3], level[3])


class Leg(unittest.TestCase):
    def test_in_the_air_it_is_a_stone_and_on_the_sand_its_weight(self):
        leg = example("leg/hop.py")
        weight = sum(leg.MASSES.values()) * leg.GRAVITY
        with simulator(leg.SCENE) as sim:
            standing = leg.State(sim.step(leg.REST))
            states = leg.hop(sim)
        self.assertAlmostEqual(standing.force / weight, 1, delta=0.05)
        off, on, top = leg.flight(states)
        self.assertGreater(off.speed, 1)
        # The speed is that of half a step beside the height, 0.25 ms: at 1.2 m/s 0.3 mm at the top, and 0.7 mm after 0.3 s.
        self.assertAlmostEqual(top.height - off.height, off.speed ** 2 / (2 * leg.GRAVITY), delta=1e-3)
        self.assertAlmostEqual(on.height - off.height, off.speed * (on.time - off.time)
                               - leg.GRAVITY * (on.time - off.time) ** 2 / 2, delta=2e-3)
        # From rest to rest the sand gives the leg as much momentum as its weight takes.
        self.assertAlmostEqual(leg.impulse(states) / (weight * leg.PERIOD), 1, delta=0.01)
        self.assertLess(abs(states[-1].speed), 0.02)
        self.assertLess(states[-1].foot, standing.foot)  # the landing has pressed it deeper


if __name__ == "__main__":
    unittest.main()
