"""A free namespace for a new node, kept from other clients of this machine.

A second node of a name would end the first, and several clients that start at the same time do not see each other at
the master yet. Weak: clients on several machines that start nodes of one name at the same moment.
"""
import errno
import hashlib
import itertools
import os
import socket

import rosgraph

from .errors import MpmError
from .master import UNANSWERED, close, forget_services, master_at, node_answers, nodes_of

DEFAULT_NAMESPACE = "/mpm"


def lock_name(node):
    """A lock on the name of a node at the master of ROS_MASTER_URI: a socket, held until it is closed or this process
    ends. None when another process of this machine has it."""
    key = f"{os.getuid()} {rosgraph.get_master_uri()} {node}"
    name_lock = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        # An address that begins with a zero byte is in no folder and leaves nothing behind (unix(7), abstract).
        name_lock.bind("\0mpm_ros_" + hashlib.sha256(key.encode()).hexdigest())
        return name_lock
    except OSError as error:
        name_lock.close()
        if error.errno == errno.EADDRINUSE:
            return None
        raise MpmError(f"the name {node} cannot be locked on this machine: {error}") from error


def lock_namespace(wished):
    """A namespace without a node at the master that runs, `wished` or the first free one, and the lock on its name."""
    master = master_at("/mpm_ros")
    try:
        return _lock_namespace(master, wished)
    except UNANSWERED as error:
        raise MpmError(f"the master at {master.master_uri} is gone: {error}") from error
    finally:
        close(master)


def _lock_namespace(master, wished):
    known = nodes_of(master)
    more = (f"{DEFAULT_NAMESPACE}_{number}" for number in itertools.count(2))
    for namespace in [wished] if wished else itertools.chain([DEFAULT_NAMESPACE], more):
        node = namespace.rstrip("/") + "/simulator"
        if node in known and node_answers(master, node):
            continue
        name_lock = lock_name(node)
        if name_lock is None:
            continue
        if node in known:
            forget_services(master, node)
        return namespace, name_lock
    raise MpmError(f"a simulator runs below {wished}; name another namespace, or Simulator.connect('{wished}')")
