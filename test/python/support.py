"""What several tests of the Python package use."""
import contextlib
import os
import signal
import socket
import subprocess
import tempfile
import time

import rosgraph
import roslib.packages

SOURCE = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "../.."))
PATIENCE = 30.0  # [s] by the wall's clock


def source_file(path):
    return os.path.join(SOURCE, path)


def program(name):
    return roslib.packages.find_node("mpm_ros", name)[0]


def run(*command):
    """Runs a program, which has to succeed. Returns its output."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def eventually(ask, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if ask():
            return True
        time.sleep(0.02)
    return ask()


@contextlib.contextmanager
def running_master():
    """A master that is not the client's own, at ROS_MASTER_URI."""
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    before = os.environ["ROS_MASTER_URI"]
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}/"
    with tempfile.TemporaryFile() as log:
        process = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=log, stderr=log)
        try:
            assert eventually(rosgraph.is_master_online), "no master"
            yield rosgraph.Master("/mpm_ros_test")
        finally:
            process.terminate()
            process.wait()
            os.environ["ROS_MASTER_URI"] = before


def processes_with(text):
    """Ids of the processes whose command line contains `text`."""
    found = []
    for entry in os.listdir("/proc"):
        with contextlib.suppress(OSError, ValueError):
            with open(f"/proc/{int(entry)}/cmdline", encoding="utf-8", errors="replace") as file:
                if text in file.read().replace("\0", " "):
                    found.append(int(entry))
    return found


class Interrupted(Exception):
    """Raised by a timer, as Ctrl-C raises KeyboardInterrupt."""


@contextlib.contextmanager
def interrupted_after(seconds):
    """The block is interrupted after this many seconds of wall time, and has to be."""
    def interrupt(*_):
        raise Interrupted

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, seconds)
        yield
        raise AssertionError(f"it took less than {seconds} s")
    except Interrupted:
        pass
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


class Started:
    """A program with its output, ended with the block."""

    def __init__(self, *command):
        self._log = tempfile.TemporaryFile(mode="w+")
        environment = dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
                           ROSCONSOLE_FORMAT="[${severity}] ${message}")
        self.process = subprocess.Popen(command, stdout=self._log, stderr=subprocess.STDOUT, env=environment)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self._log.close()

    def output(self):
        self._log.seek(0)
        return self._log.read()

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        return self.process.wait(40)
