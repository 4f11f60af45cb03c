#!/usr/bin/env python3
"""Drawbar pull, torque and sinkage of a wheel over its slip: a table, and with --plot F.png the picture that
terramechanics draws. doc/howto_wheel_rig.md."""
import argparse
import os

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "rig.yaml")
LOAD = 12 * 9.81  # [N] of hub and wheel
RADIUS = 0.15  # [m]


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
    parser.add_argument("--cell", type=float, nargs="+", default=[0.04], help="[m]; several: a table for each")
    parser.add_argument("--plot", help="picture to write")
    options = parser.parse_args()
    tables = {}
    with mpm_ros.Simulator(SCENE) as sim:
        for cell in options.cell:
            tables[cell] = []
            print(f"cells of {1000 * cell:.4g} mm, load {LOAD:.1f} N\n")
            print("| slip | drawbar pull / load | torque / (load radius) | sinkage [mm] | upwards / load |\n"
                  "|---|---|---|---|---|")
            for slip in options.slips:
                pull, torque, lift, sinkage = steady(sim, slip, cell)
                tables[cell].append((slip, pull / LOAD, torque / (LOAD * RADIUS), sinkage))
                print(f"| {slip:.2f} | {pull / LOAD:.3f} | {torque / (LOAD * RADIUS):.3f} | {1000 * sinkage:.1f} | "
                      f"{lift / LOAD:.3f} |", flush=True)
            print()
    if options.plot:
        plot(tables, options.plot)


def plot(tables, path):
    """`tables`: of each cell [m] rows of slip, drawbar pull / load, torque / (load radius), sinkage [m]."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (forces, deep) = pyplot.subplots(1, 2, figsize=(9, 4))
    for number, (cell, rows) in enumerate(tables.items()):
        slip, pull, torque, sinkage = zip(*rows)
        style = {"color": f"C{number}"}
        forces.plot(slip, pull, "o-", label="drawbar pull / load", **style)
        forces.plot(slip, torque, "s--", label="torque / (load × radius)", **style)
        deep.plot(slip, [1000 * z for z in sinkage], "^-", label=f"cells of {1000 * cell:.3g} mm", **style)
    forces.axhline(0, color="grey", linewidth=0.5)
    forces.set(xlabel="slip", xlim=(0, 1))
    deep.set(xlabel="slip", xlim=(0, 1), ylabel="sinkage [mm]", ylim=(0, None))
    forces.legend(handles=forces.get_lines()[:2], loc="center right", bbox_to_anchor=(1, 0.68))  # colours are those of the sinkage
    deep.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    main()
