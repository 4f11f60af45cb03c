#!/usr/bin/python3
"""Slip, drawbar pull, torque and sinkage of the runs of wheel_rig_sweep.yaml.

    rosrun mpm_ros run_scene --sweep wheel_rig_sweep.yaml --out rig
    rosrun mpm_ros wheel_rig_table.py rig

Pull and height are metrics of the scene; the torque is read from each run's bag.
"""
import argparse
import sys

import mpm_ros

RADIUS, ROTATION_RATE = 0.15, 2.0  # [m], [rad/s], as in wheel_rig.yaml
SPEED = "rigid_bodies.wheel.motion.velocity.0"
STEADY_FROM = 1.0  # [s]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="of the sweep")
    arguments = parser.parse_args()
    try:
        runs = [run for run in mpm_ros.Sweep(arguments.folder).runs if run.state == "done"]
        print("slip [%]   pull [N]   torque of the motor [N m]   sinkage [mm]")
        for run in sorted(runs, key=lambda run: -float(run.parameters[SPEED])):
            with run.recording() as recording:
                table = recording.contact_forces("wheel")
            torque = -table["torque"][table["time"] > STEADY_FROM, 1].mean()  # of the motor, against that of the sand
            slip = 1 - float(run.parameters[SPEED]) / (RADIUS * ROTATION_RATE)
            print(f"{100 * slip:8.0f}   {run.metrics['drawbar_pull']:8.1f}   {torque:25.2f}   "
                  f"{1000 * (RADIUS - run.metrics['height_of_hub']):12.1f}")
    except mpm_ros.MpmError as error:
        print(f"wheel_rig_table.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
