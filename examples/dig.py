#!/usr/bin/python3
"""A bucket digs along poses: it enters the sand, fills, curls and lifts. Starts its own simulator, in lockstep.

    rosrun mpm_ros dig.py --record dig.bag

Prints the force of the sand on the bucket on the way, and at the end how much sand it moved and carries. Ends with 0 when
the force on the bucket, at rest in the air, is the weight of the sand in it within a tenth.
"""
import argparse
import math
import os
import sys

import mpm_ros
import numpy as np

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "bucket.yaml")
PERIOD = 0.02  # [s] between two poses
GRAVITY = 9.81  # [m/s2]
MOVED = 0.02  # [m], a cell of the scene's grid
IN_THE_AIR = 0.2  # [m]: higher than any heap on the ground

# Time [s], x and z [m] of the bucket's origin, pitch [deg], nose down positive: the poses of a digging cycle.
PATH = np.array([
    (0.0, 0.10, 0.18, 45.0),
    (0.6, 0.19, 0.09, 45.0),  # enters along its floor: the edge is 70 mm deep
    (1.8, 0.50, -0.02, 5.0),  # fills
    (2.6, 0.60, 0.02, -35.0),  # curls back
    (3.4, 0.60, 0.34, -35.0),  # lifts
    (4.0, 0.60, 0.34, -35.0),  # holds
])


def pose_at(time):
    """Position [m] and quaternion x, y, z, w. Between two poses of PATH the bucket sets out and arrives at rest."""
    leg = min(int(np.searchsorted(PATH[:, 0], time, side="right")), len(PATH) - 1)
    begin, end = PATH[leg - 1], PATH[leg]
    part = min(1.0, (time - begin[0]) / (end[0] - begin[0]))
    _, x, z, pitch = begin + (end - begin) * (0.5 - 0.5 * math.cos(math.pi * part))
    half = math.radians(pitch) / 2
    return (x, 0, z, 0, math.sin(half), 0, math.cos(half))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", metavar="FILE.bag", help="recording of the run, for bag_report")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="change to the scene")
    arguments = parser.parse_args()
    recording = {"record": arguments.record} if arguments.record else {}
    held = []  # upward force of the sand while the bucket holds still
    with mpm_ros.Simulator(SCENE, set=arguments.set, threads=1, particle_period=0.1,
                           particle_fields=["mass", "displacement"], **recording) as sim:
        periods = round(PATH[-1, 0] / PERIOD)
        for period in range(1, periods + 1):
            obs = sim.step(PERIOD, pose={"bucket": pose_at(period * PERIOD)})
            bucket = obs["bucket"]
            if obs.time > PATH[-1, 0] - 0.3:
                held.append(bucket.force[2])
            if period % 10 == 0:
                print(f"t = {obs.time:.1f} s: bucket at x {bucket.position[0]:.2f}, z {bucket.position[2]:5.2f} m, force "
                      f"{bucket.force[0]:6.0f} {bucket.force[2]:6.0f} N, torque {bucket.torque[1]:6.1f} N m")
        sand = obs.particles
        carried = sand["mass"][sand["z"] > IN_THE_AIR].sum()
        moved = sand["mass"][sand["displacement"] > MOVED].sum()
        work = sim.solver_state().contact_work
    weighed = -np.mean(held) / GRAVITY
    print(f"moved by more than 20 mm: {moved:.1f} kg; in the bucket: {carried:.2f} kg; by the force on it at rest: "
          f"{weighed:.2f} kg")
    print(f"work of the bucket on the sand: {work:.0f} J")
    return 0 if abs(weighed - carried) < 0.1 * carried else 1


if __name__ == "__main__":
    sys.exit(main())
