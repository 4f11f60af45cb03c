#!/usr/bin/python3
"""Joint torques that the soil on a robot's tool causes: J^T w, with the wrench w on a link and the Jacobian J from tf.

Parameters   ~link: the link that feels the wrench; ~robot_description: the URDF, by default that of the root namespace
Subscribed   wrench (geometry_msgs/WrenchStamped): about the link's origin, in the link's axes
Published    joint_torques (sensor_msgs/JointState): `effort` [N m], [N] for prismatic joints, at the stamp of the wrench

A wrench comes before the robot's tf of its time: robot_state_publisher can publish that only when the joints have been read.
So wrenches wait in a queue until tf has come as far, which is what tf2_ros::MessageFilter does in C++.
"""
import collections
import xml.etree.ElementTree

import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import WrenchStamped
from sensor_msgs.msg import JointState

REPORT_PERIOD = 0.1  # [s] between two lines on the terminal
WAITING = 1000  # wrenches that wait for tf at most; then the oldest is dropped

# Of one degree of freedom. axis: unit vector in the axes of `child`, the link's frame that turns with it
Joint = collections.namedtuple("Joint", ["name", "kind", "child", "axis"])


def chain_to(link, description):
    """The movable joints from the root to a link of a URDF, and the root's name. Raises ValueError without such a link."""
    robot = xml.etree.ElementTree.fromstring(description)
    above = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}
    if link not in {element.get("name") for element in robot.findall("link")}:
        raise ValueError(f"the URDF has no link '{link}'")
    chain = []
    while link in above:
        joint = above[link]
        if joint.get("type") in ("revolute", "continuous", "prismatic"):
            written = joint.find("axis")
            axis = np.array([1.0, 0, 0] if written is None else written.get("xyz").split(), float)
            chain.insert(0, Joint(joint.get("name"), joint.get("type"), link, axis / np.linalg.norm(axis)))
        link = joint.find("parent").get("link")
    return chain, link


def rotated(quaternion, vector):
    """A vector turned by a quaternion x, y, z, w."""
    u, w = np.array(quaternion[:3]), quaternion[3]
    return vector + 2 * np.cross(u, np.cross(u, vector) + w * vector)


def joint_torque(joint, position, orientation, force, torque):
    """A component of J^T w. `position`, `orientation`: of the joint's child frame in the link's frame, in which `force` and
    `torque` (about the link's origin) are given too."""
    axis = rotated(orientation, joint.axis)
    if joint.kind == "prismatic":
        return float(axis @ force)
    return float(axis @ (torque - np.cross(position, force)))  # from the joint to the link's origin: -position


class JointTorques:
    def __init__(self):
        self.link = rospy.get_param("~link")
        self.chain, self.root = chain_to(self.link, rospy.get_param("~robot_description",
                                                                    rospy.get_param("/robot_description")))
        self.buffer = tf2_ros.Buffer()
        self.listener = tf2_ros.TransformListener(self.buffer)
        self.waiting = collections.deque(maxlen=WAITING)
        self.publisher = rospy.Publisher("joint_torques", JointState, queue_size=100)
        self.subscriber = rospy.Subscriber("wrench", WrenchStamped, self.waiting.append, queue_size=100)
        self.reported = rospy.Time(0)

    def run(self):
        while not rospy.is_shutdown():
            self.work_off()
            rospy.rostime.wallsleep(0.01)

    def work_off(self):
        """Evaluates the wrenches whose time tf has reached."""
        while self.waiting:
            try:
                newest = self.buffer.get_latest_common_time(self.link, self.root)
            except tf2_ros.TransformException:
                return  # the robot is not there yet
            if newest < self.waiting[0].header.stamp:
                return  # the robot's tf of that time comes later
            try:
                self.evaluate(self.waiting.popleft())
            except tf2_ros.TransformException:
                pass  # from before the first transform: nobody knows where the arm was

    def evaluate(self, message):
        w = message.wrench
        force, torque = np.array([w.force.x, w.force.y, w.force.z]), np.array([w.torque.x, w.torque.y, w.torque.z])
        result = JointState(header=message.header, name=[joint.name for joint in self.chain])
        for joint in self.chain:
            place = self.buffer.lookup_transform(self.link, joint.child, message.header.stamp).transform
            t, r = place.translation, place.rotation
            result.effort.append(joint_torque(joint, np.array([t.x, t.y, t.z]), (r.x, r.y, r.z, r.w), force, torque))
        self.publisher.publish(result)
        if message.header.stamp - self.reported >= rospy.Duration(REPORT_PERIOD):
            self.reported = message.header.stamp
            values = ", ".join(f"{name} {effort:.2f}" for name, effort in zip(result.name, result.effort))
            print(f"t = {message.header.stamp.to_sec():.2f} s: force {np.linalg.norm(force):.1f} N; joint torques [N m]: "
                  f"{values}", flush=True)


if __name__ == "__main__":
    rospy.init_node("arm_torques")
    JointTorques().run()
