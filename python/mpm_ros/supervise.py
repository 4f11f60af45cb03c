"""Runs a simulator node, and a master where it needs one, for as long as standard input is open.

The client (process.py) holds the other end of the pipe, so the node and the master end with it however it ends: at
the end of a `with` block, by an exception, by Ctrl-C, even by SIGKILL. SIGINT, SIGTERM and SIGHUP end them too: a
process that the client has forked keeps the pipe open. The first line on standard output is `master URI`; what follows
is the node's own output. The exit code is the node's, or 128 + n when signal n killed it.

    python3 -m mpm_ros.supervise '{"program": …, "namespace": "/mpm", "parameters": {…}, "own_master": true}'
"""
import json
import os
import signal
import subprocess
import sys
import threading

from .master import UNANSWERED, master_at

_PATIENCE = 20.0  # [s] for the node to close its bag, before it is killed


def start_master():
    """A master on a free port of this machine. Returns it with its address."""
    from rosmaster.master import Master  # not needed where a master runs
    os.environ.pop("ROS_IP", None)
    os.environ["ROS_HOSTNAME"] = "localhost"
    master = Master(port=0)
    master.start()
    os.environ["ROS_MASTER_URI"] = master.uri
    return master


def run(task):
    node = None
    wanted = threading.Event()
    told = threading.Lock()

    def end(*_):
        wanted.set()
        if node is not None and node.poll() is None and told.acquire(blocking=False):
            node.send_signal(signal.SIGINT)
            threading.Timer(_PATIENCE, node.kill).start()

    def wait_for_client():
        sys.stdin.buffer.read()
        end()

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, end)
    own_master = start_master() if task["own_master"] else None
    name = task["namespace"].rstrip("/") + "/simulator"
    master = master_at("/mpm_ros_supervise")
    if master.hasParam(name):
        master.deleteParam(name)  # what an earlier run left there
    master.setParam(name, task["parameters"])
    print("master", os.environ["ROS_MASTER_URI"], flush=True)
    environment = dict(os.environ, ROSCONSOLE_FORMAT="[${severity}] ${message}", ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
    node = subprocess.Popen([task["program"], "__ns:=" + task["namespace"], "__name:=simulator"],
                            stdin=subprocess.DEVNULL, stderr=subprocess.STDOUT, env=environment)
    if wanted.is_set():
        end()  # a signal that came before there was a node
    threading.Thread(target=wait_for_client, daemon=True).start()
    exit_code = node.wait()
    try:
        if own_master is None:
            master.deleteParam(name)
        else:
            own_master.stop()
    except UNANSWERED:
        pass  # the master has ended, and its parameters with it
    finally:
        sys.stdout.flush()
        # Without waiting for the timer, or for threads of the master.
        os._exit(exit_code if exit_code >= 0 else 128 - exit_code)


if __name__ == "__main__":
    run(json.loads(sys.argv[1]))
