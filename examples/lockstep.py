#!/usr/bin/python3
"""A force controller in lockstep: a plate is pressed into foam until it feels 20 N. Starts its own simulator.

    rosrun mpm_ros lockstep.py

The plate moves down at gain * (target - force), within a limit (admittance control). Ends with 0 when the force has
settled within 2 % of the target.
"""
import os
import sys

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "press.yaml")
PERIOD = 0.01  # [s]
TARGET = 20.0  # [N]
GAIN = 1e-3  # [m/s/N]
LIMIT = 0.1  # [m/s]


def main():
    force = 0.0
    with mpm_ros.Simulator(SCENE, threads=1, particle_period=0.1) as sim:
        for period in range(200):
            speed = max(-LIMIT, min(LIMIT, GAIN * (TARGET - force)))
            obs = sim.step(PERIOD, velocity={"plate": (0, 0, -speed)})
            force = obs["plate"].force[2]
            if period % 20 == 19:
                print(f"t = {obs.time:.2f} s: {force:6.2f} N at {obs['plate'].position[2] * 1e3:.2f} mm, "
                      f"most stress {-obs.particles['szz'].min() * 1e-3:.2f} kPa")
    settled = abs(force - TARGET) < 0.02 * TARGET
    print("settled" if settled else "not settled")
    return 0 if settled else 1


if __name__ == "__main__":
    sys.exit(main())
