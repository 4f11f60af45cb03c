#!/usr/bin/env python3
"""Robots in the node: commands of joints and bases by steps and on topics, where they begin and are set, what is
published and recorded, bags run again, launch files. 35 s. Skipped in a build without robots."""
import os
import subprocess
import tempfile
import threading
import unittest

import mpm_ros
import numpy as np
import rosbag
import rospkg
import rospy
from mpm_ros.srv import SetState, Step
from sensor_msgs.msg import JointState
from support import program, run, running_master, source_file
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

SCENE = source_file("test/data/robots/gantry.yaml")  # sync periods of 2 ms
WEIGHT = 4 * 9.81  # [N] of what the slide `down` carries


def simulator(**parameters):
    try:
        return mpm_ros.Simulator(SCENE, threads=1, **parameters)
    except mpm_ros.MpmError as error:
        if "this build has no robots" in str(error):
            raise unittest.SkipTest("this build has no robots")
        raise


class Robots(unittest.TestCase):
    def test_joints_do_what_steps_say(self):
        with simulator() as sim:
            obs = sim.step(count=1)
            gantry = obs.robots["gantry"]
            self.assertEqual(gantry.joints, ["along", "down", "turn"])
            # Held at rest above the clay: downwards is positive, so the drive holds with minus the weight.
            np.testing.assert_allclose(gantry.effort[1], -WEIGHT, rtol=1e-6)
            obs = sim.step(0.02, joints={"gantry": {"along": 0.004, "down": 0.1}})
            gantry = obs.robots["gantry"]
            np.testing.assert_allclose(gantry.position[0], 0.004, rtol=1e-9)
            # 200 N and the weight of 4 kg take 1.7 ms to reach 0.1 m/s, in which half of the way is lost.
            np.testing.assert_allclose(gantry.position[1], 0.002 - 0.1 ** 2 / (2 * (200 + WEIGHT) / 4), atol=3e-5)
            np.testing.assert_allclose(gantry.velocity[1], 0.1, rtol=1e-9)
            np.testing.assert_allclose(obs["gantry/plate"].position, [0.004, 0, 0.04 - gantry.position[1]], atol=1e-9)
            obs = sim.step(0.4)  # against the clay, until the drive gives way
            self.assertAlmostEqual(obs.robots["gantry"].effort[1], 200, delta=60)
            self.assertGreater(obs["gantry/plate"].force[2], 100)

    def test_what_cannot_be_done_is_refused_and_changes_nothing(self):
        with simulator() as sim:
            for joints, reason in [({"gantry": {"alng": 0.1}}, "along"), ({"gantri": {"along": 0.1}}, "gantry"),
                                   ({"gantry": {"along": 3.0}}, "limits"), ({"gantry": {"along": "far"}}, "number"),
                                   ({"gantry": {"along": float("nan")}}, "nan")]:
                with self.subTest(joints=joints), self.assertRaisesRegex(mpm_ros.MpmError, reason):
                    sim.step(count=1, joints=joints)
            obs = sim.step(count=1)
            np.testing.assert_array_equal(obs.robots["gantry"].position, [0, 0, obs.robots["gantry"].position[2]])

    def test_a_recording_runs_again_to_the_same_hash(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "run.bag")
            with simulator(record=bag) as sim:
                sim.step(0.05, joints={"gantry": {"down": 0.4}})
                sim.step(0.05, joints={"gantry": {"down": -0.1, "turn": 0.1}})
            with rosbag.Bag(bag) as recorded:
                counts = {topic.rsplit("mpm/", 1)[-1]: info.message_count
                          for topic, info in recorded.get_type_and_topic_info().topics.items()}
                states = [message for _, message, _ in recorded.read_messages(topics=["/mpm/robots/gantry/joint_states"])]
                frames = [message for _, message, _ in recorded.read_messages(topics=["/tf"])][-1].transforms
                wrenches = [message for _, message, _ in
                            recorded.read_messages(topics=["/mpm/robots/gantry/sensors/turn/wrench"])]
            self.assertEqual(counts["joint_commands"], 2)
            self.assertEqual(counts["robots/gantry/joint_states"], 51)
            self.assertEqual(counts["robots/gantry/links/plate/wrench"], counts["contact_forces"])
            self.assertEqual(states[-1].name, ["along", "down", "turn"])
            base = [frame for frame in frames if frame.child_frame_id == "base"][0]  # whence robot_state_publisher goes on
            self.assertEqual((base.header.frame_id, base.transform.translation.z), ("world", 0.04))
            self.assertAlmostEqual(states[1].velocity[1], (200 + WEIGHT) / 4 * 0.002)  # with all that the drive has
            # The wrist carries the plate of 1 kg: while the slide speeds up, and at its steady speed above the clay.
            self.assertAlmostEqual(wrenches[1].wrench.force.z, 9.81 - (200 + WEIGHT) / 4, delta=1e-6)
            self.assertAlmostEqual(wrenches[8].wrench.force.z, 9.81, delta=1e-6)
            again = run(program("run_scene"), "--from-bag", bag)
            self.assertIn("equal to the recorded one", again)

    def test_a_moving_base_takes_commands_by_the_robots_name(self):
        moving = {"robots.gantry.base.kind": "moving", "robots.gantry.base.limits": {"speed": 0.5}}
        with simulator(set=moving) as sim:
            obs = sim.step(0.02, velocity={"gantry": (0.1, 0, 0, 0, 0, 0)})
            np.testing.assert_allclose(obs.robots["gantry"].base_position, [0.002, 0, 0.04], atol=1e-15)
            np.testing.assert_allclose(obs["gantry/plate"].position[0], 0.002, atol=1e-15)
            obs = sim.step(0.02, velocity={"gantry": (5.0, 0, 0)})  # within the limit
            np.testing.assert_allclose(obs.robots["gantry"].base_velocity, [0.5, 0, 0], atol=1e-15)
            obs = sim.step(0.1, pose={"gantry": (0, 0, 0.05, 0, 0, 0, 1)})
            np.testing.assert_allclose(obs.robots["gantry"].base_position, [0, 0, 0.05], atol=1e-12)
            with self.assertRaisesRegex(mpm_ros.MpmError, "gantry"):
                sim.step(count=1, velocity={"gantri": (0.1, 0, 0)})

    def test_robots_begin_elsewhere(self):
        with simulator() as sim:
            obs = sim.reset(joints={"gantry": {"along": 0.05, "turn": 0.2}},
                            base={"gantry": (0, 0.01, 0.06, 0, 0, 0, 1)})
            np.testing.assert_allclose(obs.robots["gantry"].position, [0.05, 0, 0.2], atol=1e-15)
            np.testing.assert_allclose(obs["gantry/plate"].position, [0.05, 0.01, 0.06], atol=1e-15)
            obs = sim.step(0.02)
            # A rigid drive holds where the joint begins; that with stiffness sags by nothing, as the plate is balanced.
            np.testing.assert_allclose(obs.robots["gantry"].position[[0, 2]], [0.05, 0.2], atol=1e-9)
            for joints, reason in [({"gantry": {"alng": 0.1}}, "along"), ({"gantri": {}}, "gantry"),
                                   ({"gantry": {"along": 3.0}}, "limits from -1 to 1")]:
                with self.subTest(joints=joints), self.assertRaisesRegex(mpm_ros.MpmError, reason):
                    sim.reset(joints=joints)
            self.assertEqual(sim.reset().robots["gantry"].position[0], 0)

    def test_states_that_are_set_are_recorded_and_set_again(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, "run.bag")
            with simulator(record=bag) as sim:
                sim.reset(joints={"gantry": {"along": 0.02}})
                sim.step(0.1, joints={"gantry": {"down": 0.4}})  # onto the clay
                sim.set_state("gantry", joints={"along": -0.05, "down": -0.1}, joint_velocities={"down": 0.1},
                              pose=(0.01, 0, 0.05, 0, 0, 0, 1))
                with self.assertRaisesRegex(mpm_ros.MpmError, "more than half a cell"):
                    sim.set_state("gantry", joints={"down": 0.2})
                with self.assertRaisesRegex(mpm_ros.MpmError, "gantry"):
                    sim.set_state("gantri", joints={"down": 0.2})
                obs = sim.step(count=1)
                np.testing.assert_allclose(obs.robots["gantry"].position[0], -0.05, atol=1e-15)
                np.testing.assert_allclose(obs["gantry/plate"].position[0], -0.04, atol=1e-12)
                np.testing.assert_array_equal(obs["gantry/plate"].force, 0)
                sim.step(0.05)
                sim.set_state("gantry", joints={"along": 0.1})  # after the last step
            second = bag.replace(".bag", "_2.bag")
            with rosbag.Bag(second) as recorded:
                self.assertEqual(recorded.get_message_count("/mpm/states_set"), 2)
            again = run(program("run_scene"), "--from-bag", second)
            self.assertIn("equal to the recorded one", again)

    def test_states_are_set_in_the_world_frame(self):
        with running_master():
            with simulator() as sim:
                rospy.wait_for_service(sim.namespace + "/set_state", 10)
                put = rospy.ServiceProxy(sim.namespace + "/set_state", SetState)
                answer = put(model_name="gantry", joint_names=["along"], joint_positions=[0.1], reference_frame="map")
                self.assertFalse(answer.success)
                self.assertIn("'map'", answer.status_message)

    def test_topics_command_joints(self):
        with running_master():
            with simulator() as sim:
                rospy.init_node("robots_test", disable_signals=True)
                name = sim.namespace + "/robots/gantry/"
                command = rospy.Publisher(name + "joint_command", JointState, queue_size=10, latch=True)
                path = rospy.Publisher(name + "joint_trajectory", JointTrajectory, queue_size=10, latch=True)
                heard = threading.Event()
                rospy.Subscriber(name + "joint_states", JointState, lambda _: heard.set())
                while not command.get_num_connections() or not path.get_num_connections():
                    rospy.sleep(0.01)
                command.publish(JointState(name=["down"], velocity=[-0.1]))
                points = [JointTrajectoryPoint(positions=[0.01], velocities=[0.0],
                                               time_from_start=rospy.Duration(0.1)),
                          JointTrajectoryPoint(positions=[0.0], velocities=[0.0],
                                               time_from_start=rospy.Duration(0.2))]
                path.publish(JointTrajectory(joint_names=["along"], points=points))
                step = rospy.ServiceProxy(sim.namespace + "/step", Step)
                answer = step(count=50, after_received=2)
                self.assertTrue(answer.success, answer.message)
                np.testing.assert_allclose(answer.robots[0].position[0], 0.01, atol=1e-9)
                np.testing.assert_allclose(answer.robots[0].position[1], -0.01, atol=2e-4)  # 2 ms of speeding up
                answer = step(count=50)
                np.testing.assert_allclose(answer.robots[0].position[0], 0, atol=1e-9)
                self.assertTrue(heard.wait(10))
                # Refused: the last good command stays.
                command.publish(JointState(name=["down"], velocity=[]))
                answer = step(count=5, after_received=3)
                np.testing.assert_allclose(answer.robots[0].velocity[1], -0.1)


class Launches(unittest.TestCase):
    def test_examples_start_simulator_robot_and_rviz(self):
        for path in ("excavator/excavator", "leg/leg", "rover/rover", "wheel_test_rig/rig"):
            with self.subTest(path=path):
                nodes = run("roslaunch", "--nodes", source_file(f"examples/{path}.launch"), "rviz:=true").split()
                self.assertEqual(set(nodes), {"/mpm/simulator", "/robot_state_publisher", "/mpm/watch", "/remove_parameters"})

    @unittest.skipUnless("robot_state_publisher" in rospkg.RosPack().list(),
                         "ros-robot-state-publisher is not installed; scripts/install_packages test does so")
    def test_a_launch_ends_with_its_scene(self):
        with simulator():
            pass  # skipped in a build without robots
        with running_master():
            done = subprocess.run(["roslaunch", source_file("examples/leg/leg.launch"), "pacing:=free",
                                   "set:=[time.end=0.02, grid.cell=0.04]"], capture_output=True, text=True, check=False,
                                  timeout=150)
        said = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, said)
        self.assertIn("process has finished cleanly", said)


if __name__ == "__main__":
    unittest.main()
