#!/usr/bin/python3
"""Plays a bag of a run, and shows it in RViz with a view that fits it.

    roslaunch mpm_ros replay.launch bag:=run.bag
    rosrun mpm_ros replay.py run.bag [--rate 0.3] [--loop] [--field speed] [--view FILE.rviz] [--no-rviz]

All parts of a split recording are played. RViz gets the namespace that the bag's topics have. /use_sim_time is true
as long as the bag is played, and then as it was before. Exit codes: 0 done, 1 the machine (the master is gone, a
program is missing, rosbag failed), 2 bad input.
"""
import argparse
import os
import signal
import subprocess
import sys
import time

import mpm_ros
import rosgraph
import roslib.packages
from mpm_ros.master import master_at, master_runs

TOPIC_PATIENCE = 20.0  # [s] for rosbag to read its index


def arguments():
    parser = argparse.ArgumentParser(prog="replay.py", description="Plays a bag of a run into RViz.")
    parser.add_argument("bag", help="of the simulator or of run_scene; with its later parts")
    parser.add_argument("--rate", type=float, default=0.3, help="simulated over wall time (%(default)s)")
    parser.add_argument("--loop", action="store_true", help="begin again at the end")
    parser.add_argument("--field", default="", help="particle field for the colours; default: speed, or p")
    parser.add_argument("--view", default="", help="RViz configuration into which the view is written")
    parser.add_argument("--no-rviz", action="store_true", help="only play")
    # roslaunch appends its own.
    return parser.parse_args([word for word in sys.argv[1:] if ":=" not in word])


def find_bag(path):
    """roslaunch runs nodes in ~/.ros; the folder in which the user typed a relative path is in PWD."""
    path = os.path.expanduser(path)
    typed = os.path.join(os.environ.get("PWD", ""), path)
    return typed if not os.path.exists(path) and os.path.exists(typed) else path


def wait_for_topic(master, topic, player):
    end = time.monotonic() + TOPIC_PATIENCE
    while topic not in (name for name, _ in master.getPublishedTopics("")):
        if player.poll() is not None or time.monotonic() > end:
            raise mpm_ros.MpmError(f"rosbag does not play {topic}")
        time.sleep(0.05)


def play(options, recording, master):
    """Until the bag ends, or a signal raises KeyboardInterrupt. Returns 0, or 1 when rosbag failed."""
    children = []
    try:
        words = ["rosbag", "play", "--clock", "--rate", str(options.rate)] + ["--loop"] * options.loop
        children.append(subprocess.Popen(words + recording.parts))
        if not options.no_rviz:
            wait_for_topic(master, recording.namespace + "/run_info", children[0])
            watch = (roslib.packages.find_node("mpm_ros", "watch") or ["watch"])[0]
            # In a launch file this process has a name, which is not that of RViz.
            words = [watch] + [options.view] * bool(options.view) + ["__ns:=" + (recording.namespace or "/")]
            children.append(subprocess.Popen(words + [f"_field:={options.field}"] * bool(options.field)))
        return 0 if children[0].wait() == 0 else 1
    finally:
        for child in children:
            if child.poll() is None:
                child.send_signal(signal.SIGINT)
        for child in children:
            try:
                child.wait(5)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()


def run(options):
    if not master_runs():
        raise mpm_ros.MpmError(f"no master answers at {rosgraph.get_master_uri()}; start roscore, or use "
                               "roslaunch mpm_ros replay.launch bag:=FILE.bag")
    with mpm_ros.Recording(find_bag(options.bag)) as recording:
        master = master_at("/mpm_ros_replay")
        name = "/use_sim_time"
        before = master.getParam(name) if master.hasParam(name) else None
        master.setParam(name, True)
        try:
            return play(options, recording, master)
        finally:
            if before is None:
                master.deleteParam(name)
            else:
                master.setParam(name, before)


def interrupt(*_):
    raise KeyboardInterrupt


def main():
    options = arguments()
    signal.signal(signal.SIGTERM, interrupt)
    signal.signal(signal.SIGHUP, interrupt)
    try:
        return run(options)
    except mpm_ros.MpmError as error:
        print(f"replay.py: {error}", file=sys.stderr)
        return 2
    except FileNotFoundError as error:
        print(f"replay.py: the program {error.filename} is not found; scripts/install_packages demo installs what "
              "belongs to ROS, and the workspace's setup.bash finds what was built", file=sys.stderr)
        return 1
    except (ConnectionError, TimeoutError, rosgraph.MasterException) as error:
        print(f"replay.py: the master is gone: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"replay.py: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 0


if __name__ == "__main__":
    sys.exit(main())
