"""Calls of the master and of nodes (XML-RPC) that do not wait for ever for one that is gone or stopped."""
import http.client
from xmlrpc import client as xmlrpc

import rosgraph

from .errors import MpmError

PATIENCE = 5.0  # [s] for one answer

# What a call raises that gets no answer, or a refusal.
UNANSWERED = (OSError, xmlrpc.Error, http.client.HTTPException, rosgraph.MasterException)


class _Transport(xmlrpc.Transport):
    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = PATIENCE
        return connection


def proxy(uri):
    """A server of XML-RPC at `uri`. Its calls raise TimeoutError, an OSError, where no answer comes."""
    return xmlrpc.ServerProxy(uri, transport=_Transport())


def master_at(caller, uri=None):
    """The master at `uri`, by default that of ROS_MASTER_URI, as rosgraph.Master."""
    try:
        master = rosgraph.Master(caller, master_uri=uri)
    except ValueError as error:
        raise MpmError(f"ROS_MASTER_URI is '{rosgraph.get_master_uri()}': {error}") from error
    master.handle = proxy(master.master_uri)
    return master


def close(master):
    """Closes the connection to the master."""
    master.handle("close")()


def master_runs():
    """Whether a master answers at ROS_MASTER_URI."""
    master = master_at("/mpm_ros")
    try:
        master.getPid()
        return True
    except UNANSWERED:
        return False
    finally:
        close(master)


def nodes_of(master):
    """Names of the nodes that the master knows, with those that were killed and never took their leave."""
    return {node for kind in master.getSystemState() for _, nodes in kind for node in nodes}


def node_answers(master, node):
    """Whether a node that the master knows is there."""
    try:
        with proxy(master.lookupNode(node)) as slave:
            slave.getPid(master.caller_id)
        return True
    except UNANSWERED:
        return False


def forget_services(master, node):
    """Takes the services of a node that was killed off the master's list, so that those of its successor are found."""
    for service, nodes in master.getSystemState()[2]:
        if node in nodes:
            master.handle.unregisterService(node, service, master.lookupService(service))
