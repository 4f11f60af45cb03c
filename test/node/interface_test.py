#!/usr/bin/env python3
"""Holds a running simulator against interface.yaml: every topic and service of the table is there with its type, its
definition (MD5 sum) and its rate in simulated time, and nothing is there that the table does not have."""
import collections
import os
import subprocess
import sys
import time
import unittest

import roslib.message
import roslib.packages
import rosgraph
import rospy
import rosservice
import rostest
import yaml

NAMESPACE = "/mpm"
NODE = NAMESPACE + "/simulator"
HERE = os.path.dirname(os.path.realpath(__file__))
STEPS = 4  # taken one after the other, so that no step publishes more clouds than the node keeps for a slow subscriber
DURATION = 0.5  # [s] simulated, in each
COMMANDS = 3
PATIENCE = 20.0  # [s] by the wall's clock


def eventually(ask):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if ask():
            return True
        time.sleep(0.02)
    return ask()


def full_name(name):
    if name.startswith("~"):
        return f"{NODE}/{name[1:]}"
    return name if name.startswith("/") else f"{NAMESPACE}/{name}"


def expand(rows, bodies):
    """Rows with full names, and one for each body."""
    for row in rows:
        for body in bodies if "<body>" in row["name"] else [""]:
            yield dict(row, name=full_name(row["name"].replace("<body>", body)))


class Interface(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(HERE, "interface.yaml"), encoding="utf-8") as file:
            cls.table = yaml.safe_load(file)
        cls.topics = list(expand(cls.table["topics"], cls.table["bodies"]))
        cls.services = list(expand(cls.table["services"], cls.table["bodies"]))
        rospy.init_node("interface_test")
        # Only now: a rospy node that follows /clock takes one of its messages at a time and drops what comes beside it.
        rospy.set_param("/use_sim_time", True)
        program = roslib.packages.find_node("mpm_ros", "simulator")[0]
        parameters = dict(cls.table["parameters"], pacing="lockstep", threads=1)
        parameters["scene"] = os.path.join(HERE, "../..", cls.table["scene"])
        rospy.set_param(NODE, parameters)
        cls.simulator = subprocess.Popen([program, f"__ns:={NAMESPACE}"])
        cls.master = rosgraph.Master(rospy.get_name())
        assert eventually(lambda: full_name("step") in dict(cls.master.getSystemState()[2])), "no service step"
        # What it advertises last; whether it is there at all a test tells.
        eventually(lambda: "/diagnostics" in dict(cls.master.getSystemState()[0]))

    @classmethod
    def tearDownClass(cls):
        cls.simulator.terminate()
        cls.simulator.wait()

    def names_of_node(self, kind):
        """Names in the master's list (0: published, 1: subscribed, 2: services) that are the simulator's."""
        return {name for name, nodes in self.master.getSystemState()[kind] if NODE in nodes}

    def test_1_nothing_is_there_that_the_table_does_not_have_and_nothing_is_missing(self):
        for kind, direction in enumerate(["out", "in"]):
            expected = {row["name"] for row in self.topics if row["direction"] == direction}
            self.assertEqual(self.names_of_node(kind), expected, direction)
        self.assertEqual(self.names_of_node(2), {row["name"] for row in self.services})

    def test_2_topics_have_their_types(self):
        types = dict(self.master.getTopicTypes())
        for row in self.topics:
            self.assertEqual(types[row["name"]], row["type"], row["name"])

    def test_3_services_have_their_types(self):
        for row in self.services:
            headers = rosservice.get_service_headers(row["name"], rosservice.get_service_uri(row["name"]))
            self.assertEqual(headers["type"], row["type"], row["name"])
            self.assertEqual(headers["md5sum"], roslib.message.get_service_class(row["type"])._md5sum, row["name"])

    def test_4_commands_are_heard_with_their_types(self):
        for row in self.topics:
            if row["direction"] != "in":
                continue
            # A publisher of another definition would be turned away in the handshake.
            publisher = rospy.Publisher(row["name"], roslib.message.get_message_class(row["type"]), queue_size=1)
            heard = eventually(lambda p=publisher: NODE in [link[1] for link in p.impl.get_stats_info()])
            publisher.unregister()
            self.assertTrue(heard, row["name"])

    def test_5_messages_come_at_their_rates_with_their_definitions(self):
        rows = {row["name"]: row for row in self.topics if row["direction"] == "out" and row["rate"] != "log"}
        heard = collections.defaultdict(list)

        def hear(message, name):
            header = message._connection_header
            if header["callerid"] == NODE:
                heard[name].append(header)

        subscribers = [rospy.Subscriber(name, rospy.AnyMsg, hear, callback_args=name) for name in rows]
        self.assertTrue(eventually(lambda: all(s.get_num_connections() > 0 for s in subscribers)))
        latched = [name for name, row in rows.items() if row.get("latched")]
        self.assertTrue(eventually(lambda: all(heard[name] for name in latched)),
                        f"not latched: {[name for name in latched if not heard[name]]}")

        before = {name: len(messages) for name, messages in heard.items()}
        step = roslib.message.get_service_class("mpm_ros/Step")
        command = roslib.message.get_message_class("mpm_ros/Command")
        take = rospy.ServiceProxy(full_name("step"), step)
        put = rospy.ServiceProxy(full_name("set_state"), roslib.message.get_service_class("mpm_ros/SetState"))

        def expected(steps):
            numbers = {"start": 0, "command": COMMANDS * steps, "set": steps}
            return {name: numbers[row["rate"]] if row["rate"] in numbers
                    else round(DURATION * steps * self.table["parameters"][row["rate"]])
                    for name, row in rows.items() if row["rate"] != "wall"}

        def counts():
            return {name: len(heard[name]) - before.get(name, 0) for name in expected(0)}

        for steps in range(1, STEPS + 1):
            request = step._request_class(duration=DURATION)
            request.commands = [command(body=self.table["bodies"][1], kind=command.VELOCITY) for _ in range(COMMANDS)]
            answer = take(request)
            self.assertTrue(answer.success, answer.message)
            first = answer.bodies.bodies[0]
            state = put(model_name=first.name, pose=first.pose)
            self.assertTrue(state.success, state.status_message)
            eventually(lambda n=steps: all(counts()[name] >= number for name, number in expected(n).items()))
        time.sleep(0.3)  # for more than expected
        self.assertEqual(counts(), expected(STEPS))
        for name, row in rows.items():
            if row["rate"] == "wall":
                self.assertTrue(eventually(lambda n=name: heard[n]), name)
            header = heard[name][0]
            self.assertEqual(header["type"], row["type"], name)
            self.assertEqual(header["md5sum"], roslib.message.get_message_class(row["type"])._md5sum, name)
            self.assertEqual(header.get("latching", "0") == "1", row.get("latched", False), name)


if __name__ == "__main__":
    rostest.rosrun("mpm_ros", "interface", Interface, sys.argv)
