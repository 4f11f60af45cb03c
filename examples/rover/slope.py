#!/usr/bin/env python3
"""Slip and sinkage of a rover over the slope that it climbs: a table, and with --plot F.png a picture. doc/robot_examples.md."""
import argparse
import math
import os

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "slope.yaml")
WHEELS = ["front_left", "front_right", "rear_left", "rear_right"]
RADIUS = 0.12  # [m] of a wheel
RATE = 2.0  # [rad/s] of the wheels
WEIGHT = 20 * 9.81  # [N]


def climb(sim, slope, begin=2.0, end=4.0):
    """Means between two times [s], on a slope [rad]: slip, sinkage of the front and of the rear wheels [m], torque of all
    wheels over weight times radius, force of the sand against the way over the weight (sine of the slope where it travels
    steadily)."""
    sim.reset({"constants.slope": slope, "constants.rate": RATE})
    start = sim.step(begin)["rover/chassis"].position[0]
    sinkages, torque, push, count = {wheel: 0.0 for wheel in WHEELS}, 0.0, 0.0, 20
    for _ in range(count):
        obs = sim.step((end - begin) / count)
        rover = obs.robots["rover"]
        effort = dict(zip(rover.joints, rover.effort))
        for wheel in WHEELS:
            body = obs["rover/" + wheel]
            sinkages[wheel] += (RADIUS - body.position[2]) / count
            torque += effort["drive_" + wheel] / count
            push += body.force[0] / count
    way = obs["rover/chassis"].position[0] - start
    return (1 - way / (RATE * RADIUS * (end - begin)), (sinkages["front_left"] + sinkages["front_right"]) / 2,
            (sinkages["rear_left"] + sinkages["rear_right"]) / 2, torque / (WEIGHT * RADIUS), push / WEIGHT)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--slopes", type=float, nargs="+", default=[0, 5, 10, 15], help="[deg]")
    parser.add_argument("--plot", help="picture to write")
    options = parser.parse_args()
    rows = []
    print("| slope [deg] | slip | sinkage in front [mm] | behind [mm] | torque / (weight radius) | push / weight |")
    print("|---|---|---|---|---|---|")
    with mpm_ros.Simulator(SCENE) as sim:
        for slope in options.slopes:
            slip, front, rear, torque, push = climb(sim, math.radians(slope))
            rows.append((slope, slip, front, rear))
            print(f"| {slope:g} | {slip:.3f} | {1000 * front:.1f} | {1000 * rear:.1f} | {torque:.3f} | {push:.3f} |", flush=True)
    if options.plot:
        plot(rows, options.plot)


def plot(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    slope, slip, front, rear = zip(*rows)
    figure, axes = pyplot.subplots(figsize=(6, 4))
    axes.plot(slope, slip, "o-", label="slip")
    axes.set(xlabel="slope [°]", ylabel="slip")
    deep = axes.twinx()
    deep.plot(slope, [1000 * z for z in front], "^--", color="tab:green", label="sinkage of the front wheels [mm]")
    deep.plot(slope, [1000 * z for z in rear], "v--", color="tab:olive", label="of the rear wheels [mm]")
    deep.set_ylabel("sinkage [mm]")
    lines = axes.get_lines() + deep.get_lines()
    axes.legend(lines, [line.get_label() for line in lines], loc="upper left")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
