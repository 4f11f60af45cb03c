#!/usr/bin/env python3
"""Hops of a leg on sand: for each the speed of the centre of mass at take-off, its rise against that of a stone thrown up with this
speed, the time in the air, and how deep the foot stands afterwards. doc/robot_examples.md."""
import argparse
import math
import os

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "leg.yaml")
GRAVITY = 9.81  # [m/s^2]
PERIOD = 0.8  # [s] of a hop
REST = 0.3  # [s] after which the leg stretches
LINK = 0.2  # [m] from hip to knee, and from knee to the middle of the foot
FOOT = 0.05  # [m] radius
HIP = 2 * LINK * math.cos(math.radians(50)) + FOOT  # [m] height of the hip at the start
STEP = 0.005  # [s] between two states
MASSES = {"body": 2.0, "thigh": 0.4, "shank": 0.3}  # [kg]


class State:
    """Time [s], height [m] and speed upwards [m/s] of the centre of mass, height of the foot's lowest point [m], mean force of
    the sand upwards since the state before [N]."""

    def __init__(self, obs):
        leg = obs.robots["leg"]
        joint = {name: k for k, name in enumerate(leg.joints)}
        (body, hip, knee), (rate, hip_rate, knee_rate) = ([of[joint[name]] for name in ("guide", "hip", "knee")]
                                                          for of in (leg.position, leg.velocity))
        lean, lean_rate = hip + knee, hip_rate + knee_rate  # of the shank
        thigh, shank, mass = MASSES["thigh"], MASSES["shank"], sum(MASSES.values())
        self.time = obs.time
        self.force = obs["leg/shank"].force[2]
        self.foot = HIP + body - LINK * (math.cos(hip) + math.cos(lean)) - FOOT
        # Centres of mass: of the thigh in its middle, of the shank 0.15 m below the knee.
        self.height = HIP + body - ((0.1 * thigh + LINK * shank) * math.cos(hip) + 0.15 * shank * math.cos(lean)) / mass
        self.speed = rate + ((0.1 * thigh + LINK * shank) * math.sin(hip) * hip_rate +
                             0.15 * shank * math.sin(lean) * lean_rate) / mass


def hop(sim):
    """States of the next period, STEP apart."""
    return [State(sim.step(STEP)) for _ in range(round(PERIOD / STEP))]


def impulse(states):
    """Of the sand on the leg upwards [N s]."""
    return sum(state.force for state in states) * STEP


def flight(states):
    """Of the longest time in the air: its first and its last state, and the highest one."""
    runs, run = [[]], []
    for state in states:
        run = run + [state] if abs(state.force) < 1e-9 else []
        runs.append(run)
    longest = max(runs, key=len)
    return longest[0], longest[-1], max(longest, key=lambda state: state.height)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hops", type=int, default=3)
    options = parser.parse_args()
    weight = sum(MASSES.values()) * GRAVITY
    print("| hop | speed [m/s] | rise [mm] | of a stone [mm] | in the air [s] | foot in the sand before [mm] | after [mm] | "
          "impulse / (weight period) |\n|---|---|---|---|---|---|---|---|")
    with mpm_ros.Simulator(SCENE) as sim:
        sunk = -State(sim.step(REST)).foot
        for number in range(1, options.hops + 1):
            states = hop(sim)
            off, on, top = flight(states)
            print(f"| {number} | {off.speed:.3f} | {1000 * (top.height - off.height):.1f} | "
                  f"{1000 * off.speed ** 2 / (2 * GRAVITY):.1f} | {on.time - off.time:.3f} | {1000 * sunk:.1f} | "
                  f"{-1000 * states[-1].foot:.1f} | {impulse(states) / (weight * PERIOD):.3f} |", flush=True)
            sunk = -states[-1].foot


if __name__ == "__main__":
    main()
