#!/usr/bin/python3
"""Removes what a launch file set from the parameter server when the launch ends: a node for launch files.

    <node pkg="mpm_ros" type="remove_parameters.py" name="remove_parameters" args="/use_sim_time /mpm/simulator"/>

A master that roslaunch found running goes on after it, with all parameters: /use_sim_time would let every later node
wait for a clock, and private parameters would hold for a later node of the same name. /use_sim_time stays where some
node still publishes /clock. What an earlier value was is not known: roslaunch has replaced it.
"""
import signal
import sys
import threading
import time

# Before anything that takes its time: a launch may be interrupted at once, and what it set is to go all the same.
ended = threading.Event()
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, lambda *_: ended.set())

from mpm_ros.master import UNANSWERED, master_at, node_answers  # noqa: E402

CLOCK_PATIENCE = 8.0  # [s] for nodes of this launch to end; roslaunch loses patience after 15


def clock_is_published(master):
    """Whether a node that still answers publishes /clock."""
    return any(node_answers(master, node)
               for topic, nodes in master.getSystemState()[0] if topic == "/clock" for node in nodes)


def remove(master, name):
    if name == "/use_sim_time":
        end = time.monotonic() + CLOCK_PATIENCE
        while clock_is_published(master):
            if time.monotonic() > end:
                return
            time.sleep(0.1)
    if master.hasParam(name):
        master.deleteParam(name)


def main():
    names = [word for word in sys.argv[1:] if ":=" not in word]
    ended.wait()
    master = master_at("/remove_parameters")
    try:
        for name in names:
            remove(master, name)
    except UNANSWERED:
        pass  # the master has ended, and its parameters with it
    return 0


if __name__ == "__main__":
    sys.exit(main())
