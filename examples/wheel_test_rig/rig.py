#!/usr/bin/env python3
"""Drawbar pull, torque and sinkage of a wheel over its slip: a table, and with --plot F.png the picture that
terramechanics draws. doc/howto_wheel_rig.md."""
import argparse
import os

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "rig.yaml")
LOAD = 12 * 9.81  # [N] of hub and wheel


def steady(sim, slip, cell):
    """Means of the last second: drawbar pull [N], torque [N m], force of the sand upwards [N], sinkage at the end [m]."""
    sim.reset({"constants.slip": slip, "grid.cell": cell})
    sim.step(1.5)
    obs = sim.step(1.0)
    rig = obs.robots["rig"]
    joint = {name: k for k, name in enumerate(rig.joints)}
    # The carriage's drive holds the wheel back by as much as the sand pulls it.
    return (-rig.effort[joint["along"]], rig.effort[joint["axle"]], obs["rig/wheel"].force[2],
            rig.position[joint["sinkage"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--slips", type=float, nargs="+", default=[0.0, 0.1, 0.2, 0.3, 0.5, 0.7])
    parser.add_argument("--cell", type=float, default=0.04, help="[m]")
    parser.add_argument("--plot", help="picture to write")
    options = parser.parse_args()
    rows = []
    print(f"cells of {options.cell:g} m, load {LOAD:.1f} N\n")
    print("| slip | drawbar pull / load | torque / (load radius) | sinkage [mm] | upwards / load |\n|---|---|---|---|---|")
    with mpm_ros.Simulator(SCENE) as sim:
        for slip in options.slips:
            pull, torque, lift, sinkage = steady(sim, slip, options.cell)
            rows.append((slip, pull / LOAD, torque / (LOAD * 0.15), sinkage))
            print(f"| {slip:.2f} | {pull / LOAD:.3f} | {torque / (LOAD * 0.15):.3f} | {1000 * sinkage:.1f} | {lift / LOAD:.3f} |",
                  flush=True)
    if options.plot:
        plot(rows, options.plot)


def plot(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    slip, pull, torque, sinkage = zip(*rows)
    figure, axes = pyplot.subplots(figsize=(6, 4))
    axes.plot(slip, pull, "o-", label="drawbar pull / load")
    axes.plot(slip, torque, "s-", label="torque / (load × radius)")
    axes.set(xlabel="slip", xlim=(0, 1))
    axes.axhline(0, color="grey", linewidth=0.5)
    deep = axes.twinx()
    deep.plot(slip, [1000 * z for z in sinkage], "^--", color="tab:green", label="sinkage [mm]")
    deep.set_ylabel("sinkage [mm]")
    lines = axes.get_lines()[:2] + deep.get_lines()
    axes.legend(lines, [line.get_label() for line in lines], loc="center right")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
