#!/usr/bin/python3
"""Publishes the joints of arm.urdf in place of a robot: the blade is lowered into the sand, drawn to the base with a swing,
and lifted. Ends when it has done so.

Published: joint_states (sensor_msgs/JointState), 50 a second by ROS time, stamped with the present as a robot's encoders are.
"""
import math

import numpy as np
import rospy
from sensor_msgs.msg import JointState

JOINTS = ["swing", "shoulder", "elbow", "wrist"]
UPPER_ARM, FOREARM, SHOULDER_HEIGHT = 0.4, 0.35, 0.35  # [m], as in arm.urdf
RATE = 50  # [Hz]

# Time [s]; radius and height [m] of the wrist, swing [rad].
PATH = np.array([
    (0.0, 0.60, 0.30, 0.0),
    (0.3, 0.60, 0.30, 0.0),
    (1.0, 0.60, 0.22, 0.0),  # lowers: the blade is 60 mm deep
    (2.0, 0.42, 0.22, 0.2),  # draws it through the sand
    (2.5, 0.42, 0.32, 0.2),  # lifts
])


def joints_at(time):
    """Angles [rad] of JOINTS; the blade stays upright. Between two points of PATH the arm sets out and arrives at rest."""
    leg = min(int(np.searchsorted(PATH[:, 0], time, side="right")), len(PATH) - 1)
    begin, end = PATH[leg - 1], PATH[leg]
    part = min(1.0, (time - begin[0]) / (end[0] - begin[0]))
    _, radius, height, swing = begin + (end - begin) * (0.5 - 0.5 * math.cos(math.pi * part))
    down = SHOULDER_HEIGHT - height
    reach = math.hypot(radius, down)
    elbow = math.acos((reach ** 2 - UPPER_ARM ** 2 - FOREARM ** 2) / (2 * UPPER_ARM * FOREARM))
    shoulder = math.atan2(down, radius) - math.atan2(FOREARM * math.sin(elbow), UPPER_ARM + FOREARM * math.cos(elbow))
    return [swing, shoulder, elbow, -shoulder - elbow]


def main():
    rospy.init_node("arm_joints")
    publisher = rospy.Publisher("joint_states", JointState, queue_size=100)
    while publisher.get_num_connections() == 0 and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.05)
    begin, rate, time = rospy.Time.now(), rospy.Rate(RATE), 0.0
    while time < PATH[-1, 0] and not rospy.is_shutdown():
        now = rospy.Time.now()
        time = (now - begin).to_sec()
        message = JointState(name=JOINTS, position=joints_at(time))
        message.header.stamp = now
        publisher.publish(message)
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:  # Ctrl-C
        pass
