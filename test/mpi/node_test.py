#!/usr/bin/env python3
"""The node over two ranks of MPI, with a master of its own: what it answers in lockstep is what the node of one process
answers, and all ranks end together. 25 s."""
import contextlib
import os
import signal
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "../python"))
import mpm_ros  # noqa: E402
from support import Started, eventually, processes_with, program, running_master, source_file  # noqa: E402

PRESS = source_file("test/data/press.yaml")  # sync periods of 2 ms; the plate hangs 5 mm above the strip
# Not a number where the second rank has material, from 10 ms on.
LOAD = "loads=[{body_force: {acceleration: ['x > 0.14 && t > 0.01 ? log(0 - 1) : 0', 0]}}]"


def node(ranks, *parameters, scene=PRESS):
    command = [program("simulator"), "__ns:=/mpm", f"_scene:={scene}", "_threads:=1", *parameters]
    return Started(*(["mpirun", "-n", str(ranks)] if ranks > 1 else []), *command)


@contextlib.contextmanager
def lockstep(ranks, *parameters, scene=PRESS):
    """A node, and its client."""
    with running_master(), node(ranks, "_pacing:=lockstep", *parameters, scene=scene) as started:
        connected = []

        def connect():
            with contextlib.suppress(mpm_ros.MpmError):
                connected.append(mpm_ros.Simulator.connect())
            return connected

        assert eventually(connect), started.output()
        with connected[0] as sim:
            yield started, sim


def session(sim, folder):
    """What a session of commands is answered: poses and forces of bodies."""
    seen = [sim.step(0.03, velocity={"plate": (0, 0, -0.4), "rod": (0.1, 0, 0.1)})]
    sim.set_state("rod", pose=(0.02, 0, 0.1, 0, 0, 0, 1))
    seen.append(sim.step(0.01))
    path = sim.save_checkpoint(os.path.join(folder, "run.h5"))
    seen.append(sim.step(0.01, velocity={"plate": (0, 0, -0.1)}))
    sim.load_checkpoint(path)
    seen.append(sim.step(0.01))
    seen.append(sim.reset({"rigid_bodies.plate.pose.position": [0.1, 0.062]}))
    seen.append(sim.step(0.02, velocity={"plate": (0, 0, -0.4)}))
    return [(obs["plate"].position, obs["rod"].position, obs["plate"].force) for obs in seen]


class OverRanks(unittest.TestCase):
    def test_the_answers_are_those_of_one_process(self):
        answers, bags = {}, {}
        for ranks in (1, 2):
            with tempfile.TemporaryDirectory() as folder:
                with lockstep(ranks, f"_record:={folder}/run.bag") as (started, sim):
                    answers[ranks] = session(sim, folder)
                    code = started.end(signal.SIGTERM)
                    self.assertIn("the bag is closed", started.output())
                    if ranks == 1:
                        self.assertEqual(code, 0)
                    else:
                        self.assertIn("2 ranks of 1 thread", started.output())
                self.assertTrue(eventually(lambda: not processes_with("__ns:=/mpm"), 10.0))
                bags[ranks] = sorted(os.listdir(folder))
        self.assertEqual(bags[1], bags[2])
        self.assertFalse([name for name in bags[2] if name.endswith(".active")])
        # Sums in another order over some 200 steps; the bound is for a hundred.
        largest = max(np.abs(force).max() for _, _, force in answers[1])
        self.assertGreater(largest, 1.0)
        for alone, over in zip(answers[1], answers[2]):
            np.testing.assert_array_equal(over[0], alone[0])
            np.testing.assert_array_equal(over[1], alone[1])
            np.testing.assert_allclose(over[2], alone[2], rtol=0.0, atol=2e-10 * largest)

    def test_a_node_that_waits_takes_no_processor(self):
        def seconds():
            ticks = 0
            for pid in processes_with("simulator __ns:=/mpm"):
                with open(f"/proc/{pid}/stat", encoding="ascii") as file:
                    ticks += sum(int(word) for word in file.read().rsplit(")", 1)[1].split()[11:13])
            return ticks / os.sysconf("SC_CLK_TCK")

        with lockstep(2) as (_, sim):
            sim.step()
            before = seconds()
            self.assertFalse(eventually(lambda: False, 3.0))
            self.assertLess(seconds() - before, 1.0)  # one rank that waits as MPI does takes 3 s

    def test_a_run_ends_by_itself(self):
        with running_master(), node(2, "_pacing:=free", "_set:=time.end=4 ms") as started:
            self.assertEqual(started.process.wait(40), 0, started.output())
            self.assertIn("the run has reached its end", started.output())

    def test_bad_input_is_told_once(self):
        with running_master(), node(2, "_set:=grid.cell=-1") as started:
            self.assertEqual(started.process.wait(40), 2, started.output())
            self.assertEqual(started.output().count("'-1' is not greater than 0"), 1, started.output())

    def test_an_error_of_one_rank_ends_all_with_one_sentence(self):
        with tempfile.TemporaryDirectory() as folder, running_master():
            with node(2, "_pacing:=free", f"_set:=[\"{LOAD}\"]", f"_record:={folder}/run.bag") as started:
                self.assertEqual(started.process.wait(40), 3, started.output())
                self.assertEqual(started.output().count("body force on 'strip'"), 1, started.output())
            self.assertTrue(eventually(lambda: not processes_with("__ns:=/mpm"), 10.0))
            self.assertEqual(os.listdir(folder), ["run.bag"])  # closed


if __name__ == "__main__":
    unittest.main()
