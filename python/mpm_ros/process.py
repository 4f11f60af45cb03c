"""A simulator node in a process of its own, as the client starts it: see supervise.py."""
import json
import logging
import os
import re
import subprocess
import sys
import threading
import weakref

from .errors import MpmError

_LOG = logging.getLogger("mpm_ros")
_LEVELS = {"DEBUG": logging.DEBUG, "INFO": logging.INFO, "WARN": logging.WARNING, "ERROR": logging.ERROR,
           "FATAL": logging.CRITICAL}
_LINE = re.compile(r"\[ *(DEBUG|INFO|WARN|ERROR|FATAL)\] (.*)")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_SIGNALLED = 128  # and a signal's number: exit code of what it killed
_LAST = 20  # last lines of output, for a node that ends without a sentence of its own


def find_program(name):
    """Path of a program of the package."""
    from roslib.packages import find_node
    try:
        found = find_node("mpm_ros", name)
    except Exception as error:  # rospkg's own, when the package is not on its path
        raise MpmError(f"the package mpm_ros is not found ({error}); source the workspace's setup.bash") from error
    if not found:
        raise MpmError(f"the program {name} is not found; build the package and source the workspace's setup.bash")
    return found[0]


_owned = weakref.WeakSet()


def _leave_to_parent():
    for process in _owned:
        process.leave()


os.register_at_fork(after_in_child=_leave_to_parent)


class NodeProcess:
    """A node and, with `own_master`, a master. What the node logs goes to Python's log `mpm_ros`. `name_lock`:
    closed at the end (names.py)."""

    def __init__(self, program, namespace, parameters, own_master, name_lock=None):
        self.sentence = ""  # the node's last one of severity FATAL
        self.exit_code = None
        self._name_lock = name_lock
        self._left = False
        self._last_lines = []
        task = {"program": program, "namespace": namespace, "parameters": parameters, "own_master": own_master}
        # In a session of its own, so that Ctrl-C reaches the client alone, which then ends the node.
        try:
            self._process = subprocess.Popen([sys.executable, "-m", "mpm_ros.supervise", json.dumps(task)],
                                             stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                             text=True, errors="replace", start_new_session=True)
        except OSError as error:
            raise MpmError(f"no simulator was started: {error}") from error
        _owned.add(self)
        self._listener = threading.Thread(target=self._listen, daemon=True)
        try:
            self.master_uri = self._read_master_uri()
            self._listener.start()
        except BaseException:
            self.end()
            raise

    def _read_master_uri(self):
        lines = []
        for line in self._process.stdout:
            if line.startswith("master "):
                return line.split()[1]
            lines.append(line)
        raise MpmError(f"no simulator was started: {''.join(lines[-1:]).strip() or 'python3 ended at once'}")

    def _listen(self):
        level = logging.INFO
        for line in self._process.stdout:
            line = _COLOUR.sub("", line.rstrip("\n"))
            self._last_lines = (self._last_lines + [line])[-_LAST:]
            match = _LINE.match(line)
            if match:
                level, line = _LEVELS[match[1]], match[2]
                if level == logging.CRITICAL:
                    # The client raises it: it is no news for the log.
                    self.sentence, level = line, logging.INFO
            _LOG.log(level, "%s", line)

    def runs(self):
        return self._process.poll() is None

    def ids(self):
        """Ids of the processes, as far as they run: supervise.py and the node."""
        if not self.runs():
            return []
        own = self._process.pid
        try:
            with open(f"/proc/{own}/task/{own}/children", encoding="ascii") as children:
                return [own, *map(int, children.read().split())]
        except FileNotFoundError:
            return []

    def failure(self, doing):
        """Why the node is gone, as an exception. Waits until its output is complete."""
        self.end()
        killed = self.exit_code is not None and self.exit_code > _SIGNALLED
        sentence = self.sentence
        if killed or not sentence:  # of a node that was killed, the sentence is that of an earlier failure
            how = f"was killed by signal {self.exit_code - _SIGNALLED}" if killed else f"ended with {self.exit_code}"
            sentence = f"the simulator {how} while {doing}"
            if self._last_lines:
                sentence += "; its last line: " + self._last_lines[-1]
        return MpmError(sentence, self.exit_code)

    def leave(self):
        """In a fork of this process: the node stays the parent's, and ends with it."""
        self._left = True
        self._process.stdin.close()
        if self._name_lock is not None:
            self._name_lock.close()

    def end(self):
        """Ends the node in order, and the master: the bag is closed when this returns. Returns the exit code; None in a
        fork."""
        if self.exit_code is None and not self._left:
            self._process.stdin.close()
            self._process.terminate()  # a fork that Python does not know of may hold the pipe too
            if self._listener.ident is not None:
                self._listener.join()
            exit_code = self._process.wait()
            self.exit_code = exit_code if exit_code >= 0 else _SIGNALLED - exit_code
            self._process.stdout.close()
            if self._name_lock is not None:
                self._name_lock.close()
        return self.exit_code
