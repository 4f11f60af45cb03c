#!/usr/bin/env python3
"""Decoded messages hold what genpy wrote, as views of the bytes."""
import io
import unittest

import genpy
import numpy as np
from mpm_ros.decoding import decode
from mpm_ros.msg import BodyState, Command, ContactForce, NamedValue, SceneFile
from mpm_ros.particles import Particles
from mpm_ros.srv import StepResponse
from sensor_msgs import point_cloud2
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header


def serialised(message):
    """As received: in memory of its own."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return np.frombuffer(bytearray(buffer.getvalue()), np.uint8)


def some_answer():
    answer = StepResponse(success=True, message="grüß dich", stamp=genpy.Time(7, 5), time=0.25, received=2 ** 40)
    answer.contact_forces.header.frame_id = "world"
    for name, force in [("plate", 1.5), ("rod", -2.5)]:
        contact = ContactForce(name=name, nodes=3)
        contact.wrench.force.x, contact.wrench.torque.z = force, 2 * force
        contact.values = [NamedValue(name="lift", unit="N", value=[1.0, 2.0, force])]
        answer.contact_forces.bodies.append(contact)
        body = BodyState(name=name, drive=1)
        body.pose.position.y, body.pose.orientation.w, body.twist.angular.z = force, 1.0, 4.0
        answer.bodies.bodies.append(body)
    return answer


class Decoding(unittest.TestCase):
    def test_an_answer_holds_what_was_written(self):
        decoded = decode(StepResponse, serialised(some_answer()))
        self.assertEqual((decoded.success, decoded.message, decoded.stamp), (True, "grüß dich", 7000000005))
        self.assertEqual((decoded.time, decoded.received), (0.25, 2 ** 40))
        self.assertEqual(decoded.contact_forces.header.frame_id, "world")
        plate, rod = decoded.contact_forces.bodies
        self.assertEqual((plate.name, rod.name, rod.nodes), ("plate", "rod", 3))
        np.testing.assert_array_equal(rod.wrench, [-2.5, 0, 0, 0, 0, -5])
        np.testing.assert_array_equal(plate.values[0].value, [1, 2, 1.5])
        body = decoded.bodies.bodies[1]
        np.testing.assert_array_equal(body.pose, [0, -2.5, 0, 0, 0, 0, 1])
        np.testing.assert_array_equal(body.twist, [0, 0, 0, 0, 0, 4])
        self.assertEqual(body.drive, 1)

    def test_arrays_are_views_of_the_bytes(self):
        buffer = serialised(some_answer())
        decoded = decode(StepResponse, buffer)
        for array in (decoded.contact_forces.bodies[0].wrench, decoded.contact_forces.bodies[0].values[0].value,
                      decoded.bodies.bodies[1].pose):
            self.assertTrue(np.shares_memory(array, buffer))

    def test_every_message_of_the_package_is_decoded(self):
        # The fields of an empty message are those that genpy gives it.
        import mpm_ros.msg
        classes = [value for value in vars(mpm_ros.msg).values() if isinstance(value, type)]
        self.assertIn(Command, classes)
        for message_class in classes:
            decoded = decode(message_class, serialised(message_class()))
            self.assertEqual(list(vars(decoded)), message_class.__slots__)

    def test_bytes_that_are_cut_or_too_many_are_refused(self):
        whole = serialised(some_answer())
        for length in range(0, len(whole), 7):
            with self.assertRaisesRegex(ValueError, "StepResponse"):
                decode(StepResponse, whole[:length])
        with self.assertRaisesRegex(ValueError, "ends after"):
            decode(SceneFile, np.append(serialised(SceneFile(path="a", hash="b")), np.uint8(0)))


class Clouds(unittest.TestCase):
    def test_columns_are_views_of_the_message_with_the_values_written(self):
        names = ["x", "y", "z", "id", "speed"]
        kinds = [PointField.FLOAT32] * 3 + [PointField.UINT32, PointField.FLOAT32]
        fields = [PointField(name, 4 * i, kind, 1) for i, (name, kind) in enumerate(zip(names, kinds))]
        points = [(0.5 * i, 1.0, -2.0 * i, 4000000000 + i, 0.25 * i) for i in range(100)]
        header = Header(stamp=genpy.Time(10, 500000000), frame_id="a frame's name")
        buffer = serialised(point_cloud2.create_cloud(header, fields, points))
        particles = Particles(decode(PointCloud2, buffer), start=10000000000)
        self.assertEqual((len(particles), particles.time, particles.fields), (100, 0.5, tuple(names)))
        np.testing.assert_array_equal(particles["speed"], 0.25 * np.arange(100))
        np.testing.assert_array_equal(particles["id"], 4000000000 + np.arange(100))
        np.testing.assert_array_equal(particles.positions, [point[:3] for point in points])
        for array in (particles.array, particles["speed"], particles.positions):
            self.assertTrue(np.shares_memory(array, buffer))
        with self.assertRaisesRegex(KeyError, "there are x, y, z, id, speed"):
            particles["sxx"]


if __name__ == "__main__":
    unittest.main()
