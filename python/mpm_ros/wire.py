"""Services and topics over TCPROS, without a node of one's own.

rospy makes a process one node, of one master, which cannot begin again once it was shut down, and it copies every
message several times. A client of many simulators, one after the other or side by side, can use neither. A TCPROS
connection (wiki.ros.org/ROS/TCPROS) begins with a header each way; then come messages, each behind its length [byte]
as uint32, and in an answer behind a byte that says whether the call succeeded. A topic is read without registration
at the master: its publisher is asked where it sends from. Weak: a publisher that comes later is not found; a lockstep
client knows its node.
"""
import io
import select
import socket
import struct
import time
from urllib.parse import urlparse

import numpy as np
import rosgraph
from rosgraph.network import ROSHandshakeException, decode_ros_handshake_header, write_ros_handshake_header

from .decoding import decode
from .errors import MpmError
from .master import UNANSWERED, proxy

_HANDSHAKE = 10.0  # [s] longest wait for a connection and its header
_SILENCE = 20.0  # [s] longest wait for the rest of a message
_LATCHED = 5.0  # [s] longest wait for a latched message on one connection
_CONNECTIONS = 4  # on which a latched message is waited for, one after another
# An answer may take as long as a step does. A machine that has vanished is noticed after 30 s + 3 * 10 s of silence.
_KEEPALIVE = {socket.TCP_KEEPIDLE: 30, socket.TCP_KEEPINTVL: 10, socket.TCP_KEEPCNT: 3}
_LENGTH = struct.Struct("<I")

# What a lost or refused connection raises, before it is known why.
LOST = (ROSHandshakeException, *UNANSWERED)


class _Silent(MpmError):
    """No message has begun to come in time."""


def _receive(connection, size):
    """The next `size` bytes, in memory of their own that views may keep."""
    buffer = np.empty(size, np.uint8)
    rest = memoryview(buffer)
    while rest.nbytes > 0:
        count = connection.recv_into(rest)
        if count == 0:
            raise ConnectionResetError("the connection was closed")
        rest = rest[count:]
    return buffer


def _receive_message(connection):
    return _receive(connection, _LENGTH.unpack(_receive(connection, _LENGTH.size))[0])


def _decoded(message_class, buffer):
    try:
        return decode(message_class, buffer)
    except ValueError as error:
        raise MpmError(f"the node has sent what cannot be read: {error}") from error


def _open(host, port, header):
    """A connection after its handshake."""
    connection = socket.create_connection((host, port), timeout=_HANDSHAKE)
    try:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        for option, value in _KEEPALIVE.items():
            connection.setsockopt(socket.IPPROTO_TCP, option, value)
        write_ros_handshake_header(connection, header)
        answer = _receive_message(connection).tobytes()
        fields = decode_ros_handshake_header(_LENGTH.pack(len(answer)) + answer)
        if "error" in fields:
            raise ROSHandshakeException(fields["error"])
        connection.settimeout(None)
        return connection
    except BaseException:
        connection.close()
        raise


class ServiceClient:
    """One connection to a service, kept. `uri`: rosrpc://host:port, from the master.

    closed  whether close() was called, or a call was interrupted: what is left of its answer on the connection would
            be taken for the answer to the next request
    """

    def __init__(self, name, service_class, uri, caller):
        self._class = service_class
        self.request_fields = service_class._request_class.__slots__
        address = urlparse(uri)
        self._connection = _open(address.hostname, address.port, {
            "callerid": caller, "service": name, "md5sum": service_class._md5sum, "persistent": "1"})
        self.closed = False

    def fileno(self):
        return self._connection.fileno()

    def calling(self, **fields):
        """Sends a request with these fields, yields itself, and returns the decoded answer (calls.py). Raises one of LOST
        when the node is gone."""
        request = io.BytesIO()
        self._class._request_class(**fields).serialize(request)
        try:
            self._connection.sendall(_LENGTH.pack(request.tell()) + request.getvalue())
            yield self
            succeeded = _receive(self._connection, 1)[0]
            answer = _receive_message(self._connection)
        except BaseException:
            self.close()
            raise
        if not succeeded:
            raise MpmError(answer.tobytes().decode(errors="replace"))
        return _decoded(self._class._response_class, answer)

    def close(self):
        self.closed = True
        self._connection.close()


class TopicReader:
    """Messages of one publisher of a topic. `node`: its name at the master. Closed when a message was interrupted, as
    ServiceClient."""

    def __init__(self, name, message_class, node, master, caller):
        self._name = name
        self._class = message_class
        with proxy(master.lookupNode(node)) as slave:
            code, reason, protocol = slave.requestTopic(caller, name, [["TCPROS"]])
        if code != 1 or not protocol:
            raise MpmError(f"{node} does not publish {name}: {reason}")
        self._connection = _open(protocol[1], protocol[2], {
            "callerid": caller, "topic": name, "md5sum": message_class._md5sum, "type": message_class._type,
            "tcp_nodelay": "1"})
        self._connection.settimeout(_SILENCE)
        self._poll = select.poll()  # select() takes no file descriptor above 1023
        self._poll.register(self._connection, select.POLLIN)
        self.closed = False

    def receive(self, timeout):
        """The next message, decoded. Raises MpmError when none has begun to come after `timeout` [s] of wall time."""
        if not self._poll.poll(1e3 * timeout):
            raise _Silent(f"no message on {self._name} in {timeout:g} s")
        try:
            message = _receive_message(self._connection)
        except BaseException:
            self.close()
            raise
        return _decoded(self._class, message)

    def close(self):
        self.closed = True
        self._connection.close()


def latched(name, message_class, node, master, caller):
    """The last message of a latched topic: sent to whoever connects, so it is never an earlier one. Under load a node
    has been seen to send nothing on a new connection; then it is asked on another one. Raises MpmError when none comes
    on the last of them."""
    for left in reversed(range(_CONNECTIONS)):
        reader = TopicReader(name, message_class, node, master, caller)
        try:
            return reader.receive(_LATCHED)
        except _Silent:
            if left == 0:
                raise
        finally:
            reader.close()


def wait_for_service(master, name, keep_waiting):
    """The address of a service, as soon as the master knows it. `keep_waiting()` is asked between; it raises to give
    up."""
    while True:
        try:
            return master.lookupService(name)
        except rosgraph.MasterError:
            keep_waiting()
            time.sleep(0.01)
