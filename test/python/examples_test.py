#!/usr/bin/env python3
"""The examples run by themselves, as a user starts them; those of the how-to pages on coarse grids. 45 s."""
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

import mpm_ros
import numpy as np
import rospkg
from support import processes_with, program, run, source_file


class Examples(unittest.TestCase):
    def expect(self, text, *command):
        done = subprocess.run([source_file("examples/" + command[0]), *command[1:]], capture_output=True, text=True,
                              check=False, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(text, done.stdout)
        return done.stdout

    def test_the_controller_settles(self):
        self.expect("settled\n", "lockstep.py")

    def test_an_episode_ends_with_the_physics_and_not_with_the_simulator(self):
        sys.path.insert(0, source_file("examples"))
        from press_env import PressEnv
        namespace = f"/episodes_{os.getpid()}"
        # A block that is thrown out of a domain without walls, 0.04 m from its side.
        thrown = {"boundaries": {}, "bodies.block.initial.velocity": [5, 0]}
        with PressEnv(namespace=namespace, set=thrown, checkpoint_on_failure=False) as env:
            for _ in range(2):
                env.reset(seed=1)
                with self.assertRaisesRegex(ValueError, "not a number"):
                    env.step([float("nan")])
                _, _, terminated, _, info = env.step([0.0])
                self.assertTrue(terminated)
                self.assertIn("outside the domain", info["failure"])
            for process in processes_with(f"{program('simulator')} __ns:={namespace}"):
                os.kill(process, signal.SIGKILL)
            with self.assertRaisesRegex(mpm_ros.MpmError, "killed by signal 9"):
                env.step([0.0])

    def test_episodes_run_in_one_simulator(self):
        self.expect("20 episodes, 0 failed", "episodes.py", "--episodes", "20")

    def test_parallel_episodes_are_those_of_one_simulator(self):
        self.expect("the same episodes to the bit", "parallel_episodes.py", "--episodes", "2", "--simulators", "2",
                    "--compare")

    def test_environments_of_a_vector_are_single_ones(self):
        sys.path.insert(0, source_file("examples"))
        from press_env import PressEnv
        from press_vector_env import PressVectorEnv
        from vector_episodes import policy
        periods, steps = 4, 10  # two episodes and a half
        with PressVectorEnv(2, periods) as envs:
            made = [envs.reset(seed=7)[0]] + [None] * steps
            self.assertEqual((made[0].shape, envs.action_space.sample().shape), ((2, 3), (2, 1)))
            rewards, infos = np.zeros((steps, 2)), []
            for step in range(steps):
                made[step + 1], rewards[step], terminations, truncations, info = envs.step(policy(made[step]))
                infos.append(info)
                self.assertFalse(terminations.any())
                self.assertEqual(truncations.tolist(), [(step + 1) % periods == 0] * 2)
        for index in range(2):
            with PressEnv(periods) as env:
                observation, drawn = env.reset(seed=7 + index)
                for step in range(steps):
                    np.testing.assert_array_equal(made[step][index], observation)
                    observation, reward, _, truncated, last = env.step(policy(observation[None])[0])
                    self.assertEqual(rewards[step, index], reward)
                    if truncated:
                        info = infos[step]
                        np.testing.assert_array_equal(info["final_obs"][index], observation)
                        self.assertEqual(info["final_info"]["time"][index], last["time"])
                        observation, drawn = env.reset()
                        self.assertEqual((info["young"][index], info["target"][index]), (drawn["young"], drawn["target"]))

    def test_an_episode_of_a_vector_ends_with_its_simulator_and_the_next_begins(self):
        sys.path.insert(0, source_file("examples"))
        from press_vector_env import PressVectorEnv
        namespace = f"/vector_{os.getpid()}_"
        with PressVectorEnv(2, namespace=namespace + "{index}") as envs:
            envs.reset(seed=1)
            for process in processes_with(f"{program('simulator')} __ns:={namespace}1"):
                os.kill(process, signal.SIGKILL)
            observations, rewards, terminations, truncations, infos = envs.step(np.zeros((2, 1)))
            self.assertEqual((terminations.tolist(), truncations.tolist()), ([False, True], [False, False]))
            self.assertEqual(rewards[1], -1.0)
            self.assertIn("killed by signal 9", infos["final_info"]["failure"][1])
            self.assertEqual((infos["_final_obs"].tolist(), infos["_young"].tolist()), ([False, True], [False, True]))
            self.assertAlmostEqual(observations[1, 1], (0.07 - 0.075) / 0.06, delta=1e-6)  # it hangs 5 mm above the block
            self.assertFalse(envs.step(np.zeros((2, 1)))[2].any())
            with self.assertRaisesRegex(ValueError, "not a number"):
                envs.step(np.full((2, 1), np.nan))

    def test_episodes_run_in_a_vector(self):
        self.expect("6 episodes, 0 failed", "vector_episodes.py", "--environments", "3", "--episodes", "2", "--periods",
                    "10")

    def test_a_bucket_weighs_the_sand_that_it_carries(self):
        # Exits with 0 only where weight and mass agree within a tenth.
        self.expect("in the bucket", "dig.py", "--set", "grid.cell=0.04")

    def test_a_wheel_rig_bears_its_load_and_pulls_more_the_more_it_slips(self):
        with tempfile.TemporaryDirectory() as folder:
            run(program("run_scene"), "--sweep", source_file("examples/wheel_rig_sweep.yaml"), "--jobs", "0", "--out",
                os.path.join(folder, "shipped"))
            rig = os.path.join(folder, "rig")
            # 60 and 0 % of slip; the load is 40 kg.
            sweep = mpm_ros.run_sweep({"scene": source_file("examples/wheel_rig.yaml"), "set": {"grid.cell": 0.04},
                                       "parameters": {"rigid_bodies.wheel.motion.velocity.0": {"values": [0.12, 0.3]}},
                                       "record": ["bag"]}, rig)
            for made in sweep.runs:
                self.assertAlmostEqual(made.metrics["load"] / (40 * 9.81), 1, delta=0.02)
            rows = self.expect("slip", "wheel_rig_table.py", rig).splitlines()[1:]
        (slip, pull, torque, sinkage), (more, pull_more, torque_more, sinkage_more) = [
            [float(word) for word in row.split()] for row in rows]
        self.assertEqual((slip, more), (0, 60))
        self.assertGreater(pull_more, pull)
        self.assertGreater(torque_more, torque)
        self.assertGreater(sinkage_more, sinkage)

    def test_joint_torques_do_the_work_of_the_wrench(self):
        # Virtual work: a joint that turns by dq moves the link's origin by dq axis x r and turns the link by dq axis.
        sys.path.insert(0, source_file("examples/arm"))
        from arm_torques import Joint, chain_to, joint_torque, rotated
        with open(source_file("examples/arm/arm.urdf"), encoding="utf-8") as file:
            chain, root = chain_to("scoop", file.read())
        self.assertEqual(([joint.name for joint in chain], root), (["swing", "shoulder", "elbow", "wrist"], "world"))
        place, turn = np.array([0.3, -0.2, 0.5]), np.array([0.5, -0.5, 0.5, 0.5])
        force, torque = np.array([3.0, -4.0, 5.0]), np.array([0.2, 0.7, -0.4])
        axis = rotated(turn, np.array([0.0, 0.0, 1.0]))
        np.testing.assert_allclose(axis, [0, -1, 0], atol=1e-15)  # a third of a turn about (1, -1, 1)
        work = force @ np.cross(axis, -place) + torque @ axis
        found = joint_torque(Joint("a", "revolute", "b", np.array([0.0, 0.0, 1.0])), place, turn, force, torque)
        self.assertAlmostEqual(found, work, delta=1e-12)
        found = joint_torque(Joint("a", "prismatic", "b", np.array([0.0, 0.0, 1.0])), place, turn, force, torque)
        self.assertAlmostEqual(found, force @ axis, delta=1e-12)

    @unittest.skipUnless("robot_state_publisher" in rospkg.RosPack().list(),
                         "ros-robot-state-publisher is not installed; scripts/install_packages test does so")
    def test_an_arm_feels_the_sand_in_its_joints(self):
        with socket.socket() as free:
            free.bind(("localhost", 0))
            port = free.getsockname()[1]
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "arm.bag")
            done = subprocess.run(["roslaunch", "-p", str(port), source_file("examples/arm/arm.launch"), f"record:={bag}",
                                   "set:=[time.end=1.6]"], capture_output=True, text=True, check=False, timeout=150,
                                  env=dict(os.environ, ROS_MASTER_URI=f"http://localhost:{port}/"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with mpm_ros.Recording(bag) as recording:
                contact, motion = recording.contact_forces("scoop"), recording.motion("scoop")
        lines = re.findall(r"t = ([0-9.]+) s: force ([0-9.]+) N; .*swing (\S+), shoulder (\S+),", done.stdout)
        self.assertTrue(lines, done.stdout)  # few where arm_torques, a program of its own, started late
        pressed = 0
        for time, force, swing, _ in ([float(word) for word in line] for line in lines):
            row = np.argmin(np.abs(contact["time"] - time))
            self.assertAlmostEqual(np.linalg.norm(contact["force"][row]), force, delta=0.06)
            # About the swing, which is the world's z axis. The arm is ahead of the simulated blade by some 20 ms.
            moment = contact["torque"][row] + np.cross(motion["position"][row], contact["force"][row])
            self.assertAlmostEqual(swing, moment[2], delta=0.02 + 0.03 * force)
            pressed += force > 10
        self.assertGreater(pressed, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
