#!/usr/bin/env python3
"""Connections over TCPROS against a node that sends halves of messages, or nothing. 4 s."""
import contextlib
import io
import socket
import struct
import threading
import time
import unittest
from unittest import mock
from xmlrpc.server import SimpleXMLRPCServer

import mpm_ros
from mpm_ros import master, wire
from mpm_ros.msg import SceneFile
from rosgraph.network import write_ros_handshake_header
from support import interrupted_after


def serialised(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return struct.pack("<I", buffer.tell()) + buffer.getvalue()


class Publisher:
    """A node with one topic. What it sends, the test writes to `connection`. It is the master that knows it, too."""

    caller_id = "/test"

    def __init__(self):
        self._listening = socket.create_server(("localhost", 0))
        self._slave = SimpleXMLRPCServer(("localhost", 0), logRequests=False)
        self._slave.register_function(self._request_topic, "requestTopic")
        self._slave.register_function(lambda caller: (1, "", 7), "getPid")
        threading.Thread(target=self._slave.serve_forever, daemon=True).start()
        self.connection = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._slave.shutdown()
        self._slave.server_close()
        self._listening.close()
        if self.connection is not None:
            self.connection.close()

    def lookupNode(self, _):
        return f"http://localhost:{self._slave.server_address[1]}"

    def _request_topic(self, *_):
        return 1, "", ["TCPROS", "localhost", self._listening.getsockname()[1]]

    def _accept(self):
        self.connection, _ = self._listening.accept()
        length = struct.unpack("<I", self.connection.recv(4, socket.MSG_WAITALL))[0]
        self.connection.recv(length, socket.MSG_WAITALL)
        write_ros_handshake_header(self.connection, {"type": SceneFile._type, "md5sum": SceneFile._md5sum})

    def accept_silently_and_then_send(self, message):
        """On the first connection nothing comes, on the second this message."""
        self._accept()
        with self.connection:
            self._accept()
            self.connection.sendall(message)

    def reader(self):
        accepting = threading.Thread(target=self._accept)
        accepting.start()
        reader = wire.TopicReader("/some", SceneFile, "/node", self, "/test")
        accepting.join()
        return reader


@contextlib.contextmanager
def silent_server():
    """The address of a machine that takes connections and answers nothing."""
    with socket.create_server(("localhost", 0)) as listening:
        yield f"http://localhost:{listening.getsockname()[1]}"


class Reading(unittest.TestCase):
    def test_a_message_that_was_interrupted_closes_the_connection(self):
        whole = serialised(SceneFile(path="some/path", hash="12"))
        with Publisher() as publisher, contextlib.closing(publisher.reader()) as reader:
            publisher.connection.sendall(whole)
            self.assertEqual(reader.receive(5.0).path, "some/path")
            with interrupted_after(0.1):  # between two messages
                reader.receive(5.0)
            with self.assertRaisesRegex(mpm_ros.MpmError, "no message on /some in 0.1 s"):
                reader.receive(0.1)
            self.assertFalse(reader.closed)
            publisher.connection.sendall(whole[:10])
            with interrupted_after(0.1):
                reader.receive(5.0)
            self.assertTrue(reader.closed)

    def test_a_latched_message_that_stays_away_is_asked_for_on_another_connection(self):
        topic = ("/some", SceneFile, "/node")
        with mock.patch.object(wire, "_LATCHED", 0.2), Publisher() as publisher:
            sending = threading.Thread(target=publisher.accept_silently_and_then_send,
                                       args=[serialised(SceneFile(path="some/path"))])
            sending.start()
            self.assertEqual(wire.latched(*topic, publisher, "/test").path, "some/path")
            sending.join()
        with mock.patch.multiple(wire, _LATCHED=0.2, _CONNECTIONS=1), Publisher() as publisher:
            threading.Thread(target=publisher._accept).start()
            with self.assertRaisesRegex(mpm_ros.MpmError, "no message on /some in 0.2 s"):
                wire.latched(*topic, publisher, "/test")

    def test_a_message_whose_rest_stays_away_is_a_lost_connection(self):
        with mock.patch.object(wire, "_SILENCE", 0.2), Publisher() as publisher:
            with contextlib.closing(publisher.reader()) as reader:
                publisher.connection.sendall(serialised(SceneFile(path="some/path"))[:10])
                with self.assertRaises(wire.LOST):
                    reader.receive(5.0)
                self.assertTrue(reader.closed)

    def test_bytes_that_are_no_message_are_refused_with_a_sentence(self):
        with Publisher() as publisher, contextlib.closing(publisher.reader()) as reader:
            publisher.connection.sendall(struct.pack("<I", 3) + b"abc")
            with self.assertRaisesRegex(mpm_ros.MpmError, "3 bytes are not a mpm_ros/SceneFile"):
                reader.receive(5.0)


class Limits(unittest.TestCase):
    def test_a_master_or_a_node_that_answers_nothing_is_not_waited_for(self):
        with mock.patch.object(master, "PATIENCE", 0.2), silent_server() as uri:
            begin = time.monotonic()
            with mock.patch.dict("os.environ", ROS_MASTER_URI=uri):
                self.assertFalse(master.master_runs())
            with Publisher() as publisher:
                self.assertTrue(master.node_answers(publisher, "/node"))
                with mock.patch.object(publisher, "lookupNode", lambda _: uri):
                    self.assertFalse(master.node_answers(publisher, "/node"))
            self.assertLess(time.monotonic() - begin, 5.0)

    def test_connections_notice_a_machine_that_has_vanished(self):
        with Publisher() as publisher, contextlib.closing(publisher.reader()) as reader:
            self.assertEqual(reader._connection.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE), 1)
            self.assertLessEqual(reader._connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE), 60)


if __name__ == "__main__":
    unittest.main()
