#!/usr/bin/env python3
"""The lockstep client against nodes that it starts, with a master of its own and at one that runs. 40 s."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import mpm_ros
import numpy as np
import rosgraph
from support import eventually, interrupted_after, processes_with, program, running_master, source_file

PRESS = source_file("test/data/press.yaml")  # sync periods of 2 ms; the plate hangs 5 mm above the strip
SYNC = 0.002  # [s]


def press(**parameters):
    parameters.setdefault("threads", 1)
    return mpm_ros.Simulator(PRESS, **parameters)


class Stepping(unittest.TestCase):
    def test_a_body_moves_as_commanded_and_feels_what_it_touches(self):
        with press() as sim:
            self.assertEqual(sim.info.scene, "press")
            obs = sim.step(0.01, velocity={"plate": (0, 0, -0.4), "rod": (0.1, 0, 0, 0, 2.0, 0)})
            self.assertAlmostEqual(obs.time, 0.01, delta=1e-12)
            np.testing.assert_allclose(obs["plate"].position, [0.1, 0, 0.065 - 0.4 * 0.01], atol=1e-12)
            np.testing.assert_allclose(obs["rod"].position, [0.17 + 0.1 * 0.01, 0, 0.1], atol=1e-12)
            np.testing.assert_allclose(obs["rod"].rotation_rate, [0, 2.0, 0], atol=1e-12)
            np.testing.assert_array_equal(obs["plate"].force, [0, 0, 0])  # 1 mm above the strip
            obs = sim.step(count=5)  # the command goes on
            self.assertAlmostEqual(obs.time, 0.02, delta=1e-12)
            self.assertAlmostEqual(obs["plate"].position[2], 0.065 - 0.4 * 0.02, delta=1e-12)
            self.assertGreater(obs["plate"].force[2], 0.0)
            self.assertGreaterEqual(obs["plate"].peak_force[2], obs["plate"].force[2])
            self.assertFalse(obs.ended)
            self.assertAlmostEqual(sim.step(velocity={"plate": (0, 0, 0)}).time, 0.02 + SYNC, delta=1e-12)
            turned = 2.0 * (0.02 + SYNC)  # [rad] about y: where its own x is
            obs = sim.step(velocity_body={"rod": (0.1, 0, 0)})
            np.testing.assert_allclose(obs["rod"].velocity, [0.1 * np.cos(turned), 0, -0.1 * np.sin(turned)], atol=1e-12)
            self.assertTrue(sim.step(1.0).ended)  # at 0.2 s
            with self.assertRaisesRegex(mpm_ros.MpmError, "call reset"):
                sim.step()
            with self.assertRaisesRegex(KeyError, "there are plate, rod"):
                obs["blade"]

    def test_a_pose_is_reached_at_the_end_of_the_step(self):
        with press() as sim:
            obs = sim.step(0.02, pose={"rod": (0.16, 0, 0.09, 0, 0, 0, 1)})
            np.testing.assert_allclose(obs["rod"].position, [0.16, 0, 0.09], atol=1e-12)

    def test_a_reset_and_a_checkpoint_repeat_the_run_to_the_bit(self):
        with press() as sim, tempfile.TemporaryDirectory() as folder:
            def go_on():
                return [sim.step(0.01).bodies["plate"].force.copy() for _ in range(4)]

            sim.step(0.02, velocity={"plate": (0, 0, -0.4)})
            path = sim.save_checkpoint(os.path.join(folder, "run.h5"))
            first = go_on()
            self.assertGreater(first[0][2], 0.0)
            self.assertEqual(sim.load_checkpoint(path), 0.02)
            np.testing.assert_array_equal(go_on(), first)
            sim.reset()
            self.assertEqual(sim.step(0.02, velocity={"plate": (0, 0, -0.4)}).time, 0.02)
            np.testing.assert_array_equal(go_on(), first)
            self.assertAlmostEqual(sim.solver_state().time, 0.06, delta=1e-12)

    def test_a_reset_changes_the_scene(self):
        with press() as sim:
            for changes, height in [({"rigid_bodies.plate.pose.position": [0.1, 0.08]}, 0.08),
                                    (None, 0.08),  # as it is now
                                    ({}, 0.065)]:  # as it began
                obs = sim.reset(changes)
                self.assertEqual((obs.time, obs["plate"].position[2]), (0.0, height))
                self.assertEqual(sim.step()["plate"].position[2], height)
            with self.assertRaisesRegex(mpm_ros.MpmError, "cel"):
                sim.reset({"grid.cel": 0.02})
            self.assertEqual(sim.step().time, 2 * SYNC)

    def test_bad_input_is_refused_with_a_sentence(self):
        with press() as sim:
            for arguments, sentence in [({"velocity": {"blade": (0, 0, 1)}}, "blade"),
                                        ({"velocity": {"plate": (0, 0)}}, "velocity of 'plate' has the shape"),
                                        ({"velocity": {"plate": (0, 0, float("nan"))}}, "plate"),
                                        ({"pose": {"plate": (0, 0, 1)}}, "must have 7 numbers"),
                                        ({"velocity": {"plate": "fast"}}, "velocity of 'plate' is 'fast'"),
                                        ({"velocity": {"plate": (0, 0, "1 m/s")}}, "it must be numbers"),
                                        ({"velocity": [("plate", (0, 0, 1))]}, "it must be a dict"),
                                        ({"duration": -1.0}, "duration is -1"),
                                        ({"duration": 0.0}, "duration is 0.0; it must be a number above zero"),
                                        ({"duration": float("inf")}, "duration is inf"),
                                        ({"duration": "1 s"}, "duration is 1 s"),
                                        ({"count": -1}, "count is -1; it must be a whole number"),
                                        ({"count": 0}, "count is 0"),
                                        ({"count": 2.5}, "count is 2.5"),
                                        ({"count": 2 ** 32}, "count is 4294967296"),
                                        ({"duration": 0.01, "count": 5}, "give one of them")]:
                with self.assertRaisesRegex(mpm_ros.MpmError, sentence):
                    sim.step(**arguments)
            self.assertEqual(sim.step(count=np.int64(1)).time, SYNC)  # it goes on
            with self.assertRaisesRegex(mpm_ros.MpmError, "path is 7"):
                sim.save_checkpoint(7)
            with self.assertRaisesRegex(mpm_ros.MpmError, "it must be a dict, or a list of 'key=value'"):
                sim.reset([7])
        with self.assertRaisesRegex(mpm_ros.MpmError, "closed"):
            sim.step()
        with self.assertRaisesRegex(mpm_ros.MpmError, "in lockstep"):
            press(pacing="free")
        for parameters, sentence in [({"threads": object()}, "threads is <object"), ({"set": 7}, "set is 7"),
                                     ({"particle_period": "1 s"}, "particle_period is 1 s")]:
            with self.assertRaisesRegex(mpm_ros.MpmError, sentence):
                press(**parameters)


class Interruptions(unittest.TestCase):
    def test_the_next_call_has_its_own_answer(self):
        # 2000 sync periods take some 0.5 s, their interruption comes long before.
        with press(set={"time.end": 1000, "time.sync": SYNC}, particle_period=SYNC) as sim:
            sim.step()
            with interrupted_after(0.05):
                sim.step(count=2000)
            for count in (2002, 2003):  # the node has completed the interrupted step
                obs = sim.step(count=1)
                self.assertAlmostEqual(obs.time, count * SYNC, delta=1e-9)
                self.assertAlmostEqual(obs.particles.time, obs.time, delta=1e-9)
            with interrupted_after(0.05):
                sim.step(count=2000)
            obs = sim.reset()
            self.assertEqual((obs.time, obs.particles.time), (0.0, 0.0))
            self.assertEqual(sim.step().time, SYNC)


class ParticleClouds(unittest.TestCase):
    def test_each_step_has_its_own_snapshot(self):
        with press(particle_period=SYNC, particle_fields=["speed"]) as sim:
            for count in (1, 1, 3, 40):
                obs = sim.step(count=count)
                self.assertAlmostEqual(obs.particles.time, obs.time, delta=1e-9)
                self.assertEqual(len(obs.particles), 160)
                self.assertEqual(obs.particles.fields, ("x", "y", "z", "id", "speed"))
            # 20 by 8 of 5 mm: the first centres lie 2.5 mm inside the strip's corner.
            np.testing.assert_allclose(obs.particles.positions.min(axis=0), [0.0525, 0, 0.0025], atol=1e-6)
            kept = obs.particles
            sim.step()
            self.assertLess(kept.time, sim.step().particles.time)  # the old one is as it was

    def test_snapshots_come_at_their_period(self):
        with press(particle_period=0.01) as sim, tempfile.TemporaryDirectory() as folder:
            self.assertIsNone(sim.step(0.008).particles)
            self.assertAlmostEqual(sim.step(0.004).particles.time, 0.01)
            path = sim.save_checkpoint(os.path.join(folder, "run.h5"))
            self.assertAlmostEqual(sim.step(0.012).particles.time, 0.02)
            self.assertEqual(sim.reset().particles.time, 0.0)
            self.assertEqual(sim.step(0.008).particles.time, 0.0)
            self.assertAlmostEqual(sim.step(0.004).particles.time, 0.01)
            sim.load_checkpoint(path)
            self.assertAlmostEqual(sim.step(0.002).particles.time, 0.012)  # that of the checkpoint
            self.assertAlmostEqual(sim.step(0.008).particles.time, 0.02)
        with self.assertRaisesRegex(mpm_ros.MpmError, "whole number of sync periods"):
            press(particle_period=0.003)


    def test_snapshots_of_a_failed_run_are_not_those_after_the_reset(self):
        # The block flies at 2 m/s from [0.05, 0.09] through the snapshot at 0.02 s, and out at 0.2 m.
        with running_master() as master:
            master.setParam("/use_sim_time", True)
            scene = source_file("test/data/leaves_domain.yaml")
            for reset_time in ("zero", "continue"):
                with mpm_ros.Simulator(scene, threads=1, checkpoint_on_failure=False, particle_period=0.02,
                                       reset_time=reset_time) as sim:
                    for _ in range(2):
                        with self.assertRaisesRegex(mpm_ros.MpmError, "outside the domain"):
                            sim.step(1.0)
                        obs = sim.reset()
                        self.assertEqual(obs.particles.time, 0.0)
                        self.assertLess(obs.particles.positions[:, 0].max(), 0.09)
                        obs = sim.step(0.02)
                        self.assertAlmostEqual(obs.particles.time, 0.02, delta=1e-9)
                        self.assertAlmostEqual(obs.particles.positions[:, 0].min(), 0.0525 + 0.04, delta=1e-3)


class Failures(unittest.TestCase):
    def test_a_scene_that_is_not_there_is_the_nodes_own_sentence(self):
        with self.assertRaisesRegex(mpm_ros.MpmError, "no_such_scene: no shipped scene of that name") as raised:
            mpm_ros.Simulator("no_such_scene")
        self.assertEqual(raised.exception.exit_code, 2)
        with self.assertRaisesRegex(mpm_ros.MpmError, "cel"):
            press(set={"grid.cel": 0.01})

    def test_changes_reach_the_scene(self):
        with press(set={"time.end": 0.004, "rigid_bodies.plate.pose.position": [0.1, 0.07]}) as sim:
            obs = sim.step(1.0)
            self.assertAlmostEqual(obs.time, 0.004, delta=1e-12)
            self.assertAlmostEqual(obs["plate"].position[2], 0.07, delta=1e-12)

    def test_failed_physics_are_an_exception(self):
        scene = source_file("test/data/leaves_domain.yaml")
        with mpm_ros.Simulator(scene, threads=1, checkpoint_on_failure=False) as sim:
            for _ in range(3):
                with self.assertRaisesRegex(mpm_ros.MpmError, "a particle is outside the domain"):
                    sim.step(1.0)
                self.assertEqual(sim.reset().time, 0.0)  # and the node goes on

    def test_a_node_that_is_killed_is_an_exception(self):
        namespace = f"/killed_{os.getpid()}"
        with press(namespace=namespace) as sim:
            sim.step()
            for process in processes_with(f"{program('simulator')} __ns:={namespace}"):
                os.kill(process, signal.SIGKILL)
            with self.assertRaisesRegex(mpm_ros.MpmError, "the simulator was killed by signal 9") as raised:
                sim.step()
            self.assertEqual(raised.exception.exit_code, 128 + 9)
            self.assertEqual(processes_with(namespace), [])


class Endings(unittest.TestCase):
    """After each, neither a node nor a master is left."""

    def expect_nothing_left(self, namespace, master_uri):
        self.assertTrue(eventually(lambda: not processes_with(namespace)), processes_with(namespace))
        # The process that has the master waits for the node.
        self.assertTrue(eventually(lambda: not rosgraph.is_master_online(master_uri)))

    def test_the_end_of_the_block_closes_the_bag(self):
        namespace = f"/closing_{os.getpid()}"
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "run.bag")
            with press(namespace=namespace, record=bag) as sim:
                uri = sim.master_uri
                self.assertTrue(rosgraph.is_master_online(uri))
                sim.step(0.02, velocity={"plate": (0, 0, -0.4)})
            self.assertEqual(processes_with(namespace), [])  # at once
            self.expect_nothing_left(namespace, uri)
            with mpm_ros.Recording(bag) as run:
                self.assertEqual(run.namespace, namespace)
                self.assertAlmostEqual(run.motion("plate")["position"][-1, 2], 0.065 - 0.4 * 0.02, delta=1e-12)

    def test_an_exception_in_the_block(self):
        namespace = f"/throwing_{os.getpid()}"
        with self.assertRaises(ZeroDivisionError):
            with press(namespace=namespace) as sim:
                uri = sim.master_uri
                sim.step(velocity={"plate": (0, 0, 1 / 0)})
        self.expect_nothing_left(namespace, uri)

    def test_a_fork_leaves_the_node_to_the_program(self):
        namespace = f"/forking_{os.getpid()}"
        with press(namespace=namespace) as sim:
            uri = sim.master_uri
            fork = os.fork()
            if fork == 0:
                sim.close()
                time.sleep(60.0)
                os._exit(0)
            self.addCleanup(os.waitpid, fork, 0)
            self.addCleanup(os.kill, fork, signal.SIGKILL)
            self.assertEqual(sim.step().time, SYNC)
        self.expect_nothing_left(f"__ns:={namespace}", uri)

    def test_a_program_that_is_killed_takes_the_node_from_its_fork(self):
        namespace = f"/orphaned_{os.getpid()}"
        other, uri = self.start_other(namespace, "import os, time\n    fork = os.fork()\n    if fork == 0: time.sleep(60)\n"
                                                 "    print(fork, flush=True)")
        fork = int(other.stdout.readline())
        self.addCleanup(os.kill, fork, signal.SIGKILL)
        other.kill()
        other.wait()
        self.expect_nothing_left(f"__ns:={namespace}", uri)

    def test_a_pipe_that_another_process_holds_does_not_keep_the_node(self):
        namespace = f"/held_{os.getpid()}"
        with press(namespace=namespace) as sim:
            uri = sim.master_uri
            held = os.dup(sim._process._process.stdin.fileno())
            self.addCleanup(os.close, held)
        self.expect_nothing_left(f"__ns:={namespace}", uri)

    def start_other(self, namespace, then="pass"):
        """A program that steps for ever; its output is the address of its master, and then nothing."""
        text = (f"import mpm_ros\n"
                f"changes = {{'time.end': 1e6}}\n"
                f"with mpm_ros.Simulator({PRESS!r}, threads=1, namespace={namespace!r}, set=changes) as sim:\n"
                f"    print(sim.master_uri, flush=True)\n"
                f"    {then}\n"
                f"    while True: sim.step(0.02)\n")
        other = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True)
        self.addCleanup(other.stderr.close)
        self.addCleanup(other.stdout.close)
        return other, other.stdout.readline().strip()

    def test_signals_to_the_client(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            namespace = f"/signal_{number}_{os.getpid()}"
            other, uri = self.start_other(namespace)
            self.assertTrue(rosgraph.is_master_online(uri))
            other.send_signal(number)
            self.assertNotEqual(other.wait(), 0)
            if number == signal.SIGINT:
                self.assertIn("KeyboardInterrupt", other.stderr.read())
            self.expect_nothing_left(namespace, uri)


class RunningMaster(unittest.TestCase):
    def test_two_simulators_share_a_master_that_runs_and_leave_it_clean(self):
        with running_master() as master:
            before = master.getParamNames()
            with press() as first, press() as second:
                self.assertEqual((first.master_uri, second.master_uri), (os.environ["ROS_MASTER_URI"],) * 2)
                self.assertEqual((first.namespace, second.namespace), ("/mpm", "/mpm_2"))
                self.assertEqual(master.getParam("/mpm_2/simulator/pacing"), "lockstep")
                first.step(0.01)
                self.assertEqual(second.step(0.02).time, 0.02)
                with self.assertRaisesRegex(mpm_ros.MpmError, "a simulator runs below /mpm;"):
                    press(namespace="mpm")
                with mpm_ros.Simulator.connect("/mpm") as again:
                    self.assertAlmostEqual(again.step(0.01).time, 0.02, delta=1e-12)
                self.assertAlmostEqual(first.step(0.01).time, 0.03, delta=1e-12)  # connect() did not end it
            self.assertTrue(rosgraph.is_master_online())
            self.assertEqual(master.getParamNames(), before)
            with self.assertRaisesRegex(mpm_ros.MpmError, "no simulator runs below /mpm"):
                mpm_ros.Simulator.connect("/mpm")

    def test_a_node_that_was_killed_does_not_keep_its_namespace(self):
        with running_master() as master:
            for _ in range(2):
                node = subprocess.Popen([program("simulator"), "__ns:=/left", f"_scene:={PRESS}", "_pacing:=lockstep",
                                         "_threads:=1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.assertTrue(eventually(lambda: "/left/step" in [name for name, _ in master.getSystemState()[2]]))
                with self.assertRaisesRegex(mpm_ros.MpmError, "a simulator runs below /left;"):
                    press(namespace="/left")
                node.kill()
                node.wait()
                self.assertIn("/left/step", [name for name, _ in master.getSystemState()[2]])
                with press(namespace="/left") as sim:
                    self.assertEqual(sim.step().time, SYNC)

    def test_simulators_that_start_at_the_same_time_do_not_end_each_other(self):
        text = (f"import mpm_ros\nwith mpm_ros.Simulator({PRESS!r}, threads=1) as sim:\n"
                "    print(sim.namespace)\n    sim.step(0.1)\n")
        with running_master():
            others = [subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True) for _ in range(4)]
            names = {other.communicate()[0].strip() for other in others}
            self.assertEqual([other.returncode for other in others], [0] * 4)
            self.assertEqual(len(names - {""}), 4)

    def test_a_node_outlives_its_master_with_its_exit_code(self):
        with running_master():
            sim = press()
            sim.step()
        sim.close()
        self.assertEqual(sim._process.exit_code, 0)

    def test_connecting_without_a_master_says_so_at_once(self):
        with self.assertRaisesRegex(mpm_ros.MpmError, "no master answers"):
            mpm_ros.Simulator.connect("/mpm")


if __name__ == "__main__":
    unittest.main()
