#!/usr/bin/env python3
"""`watch` and `replay` find the run's namespace, and say at once when there is none. In place of RViz stands a
program that keeps its configuration and its command line. 40 s."""
import os
import re
import stat
import subprocess
import tempfile
import time
import unittest

import mpm_ros
import rosbag
import yaml
from support import PATIENCE, Started, eventually, program, running_master, source_file

SCENE = source_file("test/data/press.yaml")
AT_ONCE = 10.0  # [s]


class Pictures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.environ.update, {name: os.environ[name] for name in ("PATH", "ROS_HOME")})
        rviz = self.path("rviz")
        with open(rviz, "w", encoding="utf-8") as file:
            file.write(f'#!/bin/sh\necho "$@" > "{self.path("words")}"\ncp "$2" "{self.path("shown.part")}"\nmv "{self.path("shown.part")}" '
                       f'"{self.path("shown")}"\nexec sleep 60\n')
        os.chmod(rviz, stat.S_IRWXU)
        os.environ["PATH"] = self.folder.name + ":" + os.environ["PATH"]
        os.environ["ROS_HOME"] = self.path("home")

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def bag_in(self, namespace):
        bag = self.path("run.bag")
        with mpm_ros.Simulator(SCENE, threads=1, namespace=namespace, own_master=True, record=bag) as sim:
            sim.step(0.1)
        return bag

    def topics_shown(self, program_with_output):
        """With "~" for the name of `watch`, which colours the particles and publishes them anew."""
        self.assertTrue(eventually(lambda: os.path.exists(self.path("shown"))), program_with_output.output())
        with open(self.path("shown"), encoding="utf-8") as file:
            displays = yaml.safe_load(file)["Visualization Manager"]["Displays"]
        os.remove(self.path("shown"))
        topics = {display[key] for display in displays for key in ("Topic", "Marker Topic") if key in display}
        return {re.sub(r"watch(_\w+)?/", "~", topic) for topic in topics}

    def test_a_bag_is_shown_from_its_own_namespace_and_the_clock_is_given_back(self):
        for namespace in ("", "/mpm", "/some/robot"):
            bag = self.bag_in(namespace)
            with rosbag.Bag(bag) as recorded:
                self.assertIn(namespace + "/run_info", recorded.get_type_and_topic_info().topics)
            with running_master() as master:
                # As typed: roslaunch runs nodes in another folder.
                with Started("roslaunch", "mpm_ros", "replay.launch", "bag:=" + os.path.relpath(bag)) as launch:
                    self.assertEqual(self.topics_shown(launch), {namespace + "/" + leaf for leaf in
                                                                ("~particles", "~colour_bar", "markers",
                                                                 "force_markers", "crack_markers")})
                    self.assertIs(master.getParam("/use_sim_time"), True)
                    launch.end()
                    self.assertFalse(master.hasParam("/use_sim_time"), launch.output())

    def test_launch_files_show_their_run_in_colours(self):
        for name, driven in (("blade_in_soil", True), ("cone_penetrometer", True), ("wheel_in_sand", False)):
            words = [name + ".launch", "scene:=" + SCENE, "rviz:=true", "field:=p", "set:=[time.end=60]"] + ["driver:=false"] * driven
            with running_master(), Started("roslaunch", "mpm_ros", *words) as launch:
                self.assertEqual(self.topics_shown(launch), {"/mpm/" + leaf for leaf in
                                                             ("~particles", "~colour_bar", "markers",
                                                              "force_markers", "crack_markers")})
                with open(self.path("words"), encoding="utf-8") as file:
                    # A node of the same name as `watch` would end it, and with it RViz.
                    self.assertIn("__name:=watch_rviz", file.read())
                launch.end()

    def test_watch_waits_for_a_run_that_stands_still_and_says_so(self):
        with running_master(), mpm_ros.Simulator(SCENE, threads=1, namespace="/still", particle_period=0.01) as still:
            with Started(program("watch")) as watch:
                self.assertTrue(eventually(lambda: "for `step`" in watch.output(), AT_ONCE), watch.output())
                still.step(0.02)
                self.assertIn("/still/markers", self.topics_shown(watch))

    def test_a_clock_that_was_set_before_stays(self):
        bag = self.bag_in("/mpm")
        with running_master() as master:
            master.setParam("/use_sim_time", True)
            done = subprocess.run([program("replay.py"), bag, "--rate", "10", "--no-rviz"], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIs(master.getParam("/use_sim_time"), True)

    def test_watch_finds_the_simulator_that_runs(self):
        with running_master(), mpm_ros.Simulator(SCENE, threads=1, namespace="/left", particle_period=0.01) as left:
            with Started(program("watch")) as watch:
                end = time.monotonic() + PATIENCE
                while not os.path.exists(self.path("shown")) and time.monotonic() < end:
                    if left.step(count=2).ended:  # particles for watch
                        left.reset()
                    time.sleep(0.05)
                self.assertIn("/left/markers", self.topics_shown(watch))
            with Started(program("teleop"), "nobody") as teleop:
                self.assertEqual(teleop.process.wait(AT_ONCE), 2)
                self.assertIn("there is no rigid body 'nobody'", teleop.output())
            with mpm_ros.Simulator(SCENE, threads=1, namespace="/right"), Started(program("watch")) as watch:
                self.assertEqual(watch.process.wait(AT_ONCE), 2)
                self.assertIn("which run? Name its namespace, __ns:=: /left, /right", watch.output())

    def test_nothing_that_runs_is_said_at_once(self):
        with Started(program("watch")) as watch:
            self.assertEqual(watch.process.wait(AT_ONCE), 2)
            self.assertIn("no master answers at", watch.output())
        with running_master():
            with Started(program("watch")) as watch:
                self.assertEqual(watch.process.wait(AT_ONCE), 2)
                self.assertIn("nothing runs", watch.output())
            with Started(program("watch"), "__ns:=/mpm") as watch:
                self.assertTrue(eventually(lambda: "no run below /mpm yet" in watch.output(), AT_ONCE), watch.output())

    def test_what_cannot_be_played_is_said_at_once(self):
        def expect(sentence, bag):
            done = subprocess.run([program("replay.py"), bag], capture_output=True, text=True, check=False,
                                  timeout=AT_ONCE)
            self.assertEqual(done.returncode, 2)
            self.assertIn(sentence, done.stderr)

        expect("no master answers", self.path("nowhere.bag"))
        with running_master():
            expect("nowhere.bag cannot be read", self.path("nowhere.bag"))
            rosbag.Bag(self.path("empty.bag"), "w").close()
            expect("no topic run_info", self.path("empty.bag"))

    def test_a_program_that_is_missing_is_named(self):
        bag = self.bag_in("/mpm")
        with running_master():
            done = subprocess.run([program("replay.py"), bag], capture_output=True, text=True, check=False,
                                  timeout=AT_ONCE, env=dict(os.environ, PATH=self.folder.name))
            self.assertEqual(done.returncode, 1)
            self.assertIn("the program rosbag is not found", done.stderr)


if __name__ == "__main__":
    unittest.main()
