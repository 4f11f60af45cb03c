#!/usr/bin/env python3
"""What a node or a launch file writes to the parameter server does not hold for a later run, and none of it holds in
silence. 7 s."""
import re
import signal
import unittest

from support import Started, eventually, program, running_master, source_file

SCENE = source_file("test/data/press.yaml")


def private_parameters(master):
    return [name for name in master.getParamNames() if name.startswith("/simulator/")]


def step_service(master):
    return any(name.endswith("/step") for name, _ in master.getSystemState()[2])


def controller_publishes(master):
    return any("/mpm/force_controller" in nodes for _, nodes in master.getSystemState()[0])


def remover_waits(output):
    """Whether the node remove_parameters of a launch, by what roslaunch printed, catches the signals that end it."""
    started = re.search(r"process\[remove_parameters-1\]: started with pid \[(\d+)\]", output)
    if not started:
        return False
    with open(f"/proc/{started.group(1)}/status", encoding="utf-8") as status:
        caught = int(re.search(r"SigCgt:\s*(\w+)", status.read()).group(1), 16)
    return bool(caught >> (signal.SIGTERM - 1) & 1)


class Parameters(unittest.TestCase):
    def start(self, *arguments):
        return Started(program("simulator"), *arguments)

    def test_the_command_line_of_an_earlier_run_does_not_hold(self):
        with running_master() as master:
            for number, code in ((signal.SIGINT, 0), (signal.SIGKILL, -signal.SIGKILL)):
                with self.start(f"_scene:={SCENE}", "_pacing:=lockstep", "_threads:=1") as simulator:
                    self.assertTrue(eventually(lambda: step_service(master)), simulator.output())
                    self.assertTrue(eventually(lambda: not private_parameters(master)), simulator.output())
                    self.assertEqual(simulator.end(number), code)
                    self.assertIn(f"from the command line: ~pacing = lockstep, ~scene = {SCENE}, ~threads = 1",
                                  simulator.output())
            with self.start("_pacing:=fast") as simulator:
                self.assertEqual(simulator.process.wait(40), 2)
            # In real time the 0.2 s of the scene go by, in lockstep it would wait for `step`.
            with self.start(f"_scene:={SCENE}") as simulator:
                self.assertEqual(simulator.process.wait(40), 0, simulator.output())
                self.assertNotIn("pacing", simulator.output().split("from the command line")[1].split("\n")[0])
            self.assertEqual(private_parameters(master), [])

    def test_a_controllers_command_line_does_not_hold_either(self):
        with running_master() as master, Started(program("force_controller"), "_target:=-1") as controller:
            self.assertEqual(controller.process.wait(40), 2)
            self.assertIn("~target is -1", controller.output())
            self.assertEqual([name for name in master.getParamNames() if "force_controller" in name], [])

    def test_what_is_on_the_server_already_is_said(self):
        with running_master() as master:
            master.setParam("/simulator/pacing", "lockstep")
            with self.start(f"_scene:={SCENE}", "_threads:=1") as simulator:
                self.assertTrue(eventually(lambda: "parameter server: ~pacing = lockstep (set by rosparam, or left"
                                           in simulator.output()), simulator.output())
                self.assertIn("WARN", simulator.output())
                self.assertIn("rosparam delete /simulator", simulator.output())
                # What somebody else set stays.
                self.assertTrue(eventually(lambda: private_parameters(master) == ["/simulator/pacing"]))


class Launches(unittest.TestCase):
    def launch(self, name, *arguments):
        return Started("roslaunch", "mpm_ros", name, *arguments)

    def test_a_launch_leaves_nothing_and_takes_nothing_from_an_earlier_run(self):
        with running_master() as master:
            master.setParam("/mpm/simulator/record_required", False)  # left there
            before = set(master.getParamNames()) - {"/mpm/simulator/record_required"}
            changes = "set:=['time.end=1000', 'grid.cell=0.02']"
            with self.launch("force_control.launch", "duration:=1000", changes) as launch:
                # The last that roslaunch starts: interrupted while it starts something, it ends with 1.
                self.assertTrue(eventually(lambda: controller_publishes(master) and step_service(master)), launch.output())
                self.assertTrue(eventually(lambda: remover_waits(launch.output())), launch.output())
                self.assertTrue(master.getParam("/use_sim_time"))
                self.assertFalse(master.hasParam("/mpm/simulator/record_required"))
                self.assertEqual(launch.end(), 0)
                after = set(master.getParamNames()) - before
                # roslaunch's own
                after = {name for name in after
                         if not name.startswith(("/roslaunch/", "/run_id", "/rosdistro", "/rosversion"))}
                self.assertEqual(after, set(), launch.output())


if __name__ == "__main__":
    unittest.main()
