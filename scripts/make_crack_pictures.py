#!/usr/bin/python3
"""Draws doc/images/cracks/*.png, the pictures of doc/cracks.md: runs each shipped scene with a crack (half a minute in all)
and draws its particles, displaced by as much as lets the crack be seen, beside what the scene is about.

    make_crack_pictures.py RUN_SCENE [SCENE...]      RUN_SCENE: the program; without names all scenes
"""
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
sys.dont_write_bytecode = True  # leaves no files among the sources
HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, HERE)
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.patches import Polygon  # noqa: E402

import plot_cracks  # noqa: E402
import plot_style  # noqa: E402
import plot_tables  # noqa: E402
from plot_particles import Coloring, Snapshot, spacing  # noqa: E402

FOLDER = os.path.join(HERE, "../doc/images/cracks")
MM = 1e3
ARM, YOUNG, POISSON, J_IC = 6.5e-3, 2.5e9, 0.33, 200.0  # of double_cantilever
GROWING = ["cracks.growth.criterion=release_rate", "boundaries.conditions.upper.velocity=t<4e-3?0.25:0",
           "boundaries.conditions.lower.velocity=t<4e-3?-0.25:0"]


def reference(panel, value, text):
    panel.axhline(value, color=plot_style.RED, linestyle="--", linewidth=1.2)
    panel.annotate(text, (1, value), xycoords=("axes fraction", "data"), xytext=(-2, 4), textcoords="offset points",
                   ha="right", color=plot_style.RED, fontsize=9)


def over_time(panel, title, unit):
    panel.set_title(title)
    panel.set_xlabel("time [ms]")
    panel.set_ylabel(unit)
    panel.set_ylim(bottom=0)
    panel.margins(x=0.01)


def beam(panel, run, cracks):
    chains = cracks.chains["cut"]
    time = np.array([time for time, _ in chains])
    apart = 0.25 * np.minimum(time, 4e-3)  # of each arm [m]
    exact = (0.75 * YOUNG / (1 - POISSON**2) * ARM**3 * apart**2 / J_IC) ** 0.25 - 0.6728 * ARM
    panel.plot(1e3 * time, MM * np.maximum(exact, 20.1e-3), "--", color=plot_style.RED, label="beam formula")
    panel.plot(1e3 * time, [MM * chain.line[-1, 0] for _, chain in chains], color=plot_style.BLUE, label="tip")
    panel.legend(loc="lower right")
    over_time(panel, "Place of the tip", "x [mm]")


def tension(panel, run, cracks):
    tip = cracks.tips["notch", "end"]
    panel.plot(1e3 * tip.time, 1e-6 * tip.k_one, color=plot_style.BLUE)
    reference(panel, 5.11, "handbook 5.11")
    over_time(panel, "Stress intensity", "$K_I$ [MPa m$^{1/2}$]")


def penny(panel, run, cracks):
    tip = cracks.tips["crack", "end"]
    panel.plot(1e3 * tip.time, tip.j, color=plot_style.BLUE)
    reference(panel, 6.455, "exact 6.455")
    over_time(panel, "Energy release rate", "J [J/m²]")


def kink(panel, run, cracks):
    tip = cracks.tips["crack", "end"]
    for values, name, color in ((tip.k_one, "$K_I$", plot_style.BLUE), (tip.k_two, "$K_{II}$", plot_style.ORANGE)):
        panel.plot(1e3 * tip.time, 1e-6 * values, color=color, label=name)
    panel.legend(loc="upper left")
    over_time(panel, "Right tip", "[MPa m$^{1/2}$]")


def wedge(panel, run, cracks):
    time, force = run.forces["time"], run.forces["wedge fz"]
    panel.plot(1e3 * time, force, color=plot_style.BLUE, linewidth=1)
    over_time(panel, "Force (blue), crack (orange)", "force on the wedge [N]")
    other = panel.twinx()
    chains = cracks.chains["split"]
    other.plot([1e3 * time for time, _ in chains], [MM * chain.length() for _, chain in chains],
               color=plot_style.ORANGE)
    other.set_ylabel("length of the crack [mm]")
    other.set_ylim(bottom=0)
    other.grid(False)


#  scene: (changes, field, how much displacements are magnified, span of x and of z that is shown [mm], what is beside)
SCENES = {
    "double_cantilever": (GROWING, "szz", 1, (-1, 71), (-8, 9), beam),
    "edge_crack": ([], "szz", 200, (-3, 23), (-14, 15), tension),
    "inclined_crack": ([], "szz", 400, (-45, 45), (-34, 34), kink),
    "penny_crack": ([], "szz", 1000, (-1, 23), (-14, 15), penny),
    "wedge_block": ([], "sxx", 1, (-36, 38), (0, 127), wedge),
}


def magnified(places, positions, moved, factor):
    """Places next to particles, moved on as the nearest of these are in the picture."""
    nearest = [int(np.argmin(np.sum((positions - place) ** 2, axis=1))) for place in places]
    return places + (factor - 1) * moved[nearest]


def draw_body(panel, run, cracks, field, factor, span):
    first, last = Snapshot(*run.snapshots[0], ""), Snapshot(*run.snapshots[-1], "")
    order_first, order_last = np.argsort(first.table["id"]), np.argsort(last.table["id"])
    start, positions = first.positions[order_first][:, [0, 2]], last.positions[order_last][:, [0, 2]]
    moved, values = positions - start, 1e-6 * last.table[field][order_last]
    gap = spacing(first.positions)
    drawn = MM * (positions + (factor - 1) * moved)
    inside = np.all((drawn > np.array([s[0] for s in span]) - 2) & (drawn < np.array([s[1] for s in span]) + 2), axis=1)
    low, high = np.percentile(values[inside], [1, 99])
    coloring = Coloring(field, "MPa", low, high)
    size = np.full(inside.sum(), 1.45 * MM * gap)
    panel.add_collection(EllipseCollection(size, size, np.zeros(len(size)), units="xy", offsets=drawn[inside],
                                           offset_transform=panel.transData, linewidths=0,
                                           facecolors=coloring.map.to_rgba(values[inside])))
    for name, chains in cracks.chains.items():
        chain = chains[-1][1]
        way = np.gradient(chain.line, axis=0)
        left = np.column_stack([-way[:, 1], way[:, 0]]) / np.linalg.norm(way, axis=1)[:, None]
        faces = [MM * magnified(face + side * gap * left, positions, moved, factor) - MM * side * gap * left
                 for face, side in ((chain.above, 1), (chain.below, -1))]
        for row, end in ((0, "start"), (-1, "end")):
            if (name, end) in cracks.tips:  # the faces meet there
                faces[0][row] = faces[1][row] = 0.5 * (faces[0][row] + faces[1][row])
                panel.plot(*faces[0][row], "o", markersize=5, markerfacecolor="white",
                           markeredgecolor="black", zorder=4)
        panel.add_patch(Polygon(np.concatenate([faces[0], faces[1][::-1]]), facecolor="white", linewidth=0, zorder=2))
        for face in faces:
            panel.plot(*face.T, color="black", linewidth=1.3, zorder=3)
    for body, (vertices, _) in run.outlines().items():
        place, rotation = run.pose_at(body, last.time)
        corners = MM * np.unique(np.round((place + vertices @ rotation.T)[:, [0, 2]], 9), axis=0)
        middle = corners.mean(axis=0)
        turn = np.argsort(np.arctan2(*(corners - middle).T[::-1]))  # a wedge is convex
        panel.add_patch(Polygon(corners[turn], facecolor=plot_style.STEEL, edgecolor="black", zorder=5))
    panel.set_xlim(span[0])
    panel.set_ylim(span[1])
    panel.set_aspect("equal")
    panel.grid(False)
    panel.set_xlabel("x [mm]" if "penny" not in run.title else "r [mm]")
    panel.set_ylabel("z [mm]")
    times = f", displacements × {factor}" if factor != 1 else ""
    panel.set_title(f"t = {1e3 * last.time:.3g} ms{times}")
    return coloring


def picture(name, folder):
    _, field, factor, x_span, z_span, beside = SCENES[name]
    run, cracks = plot_tables.Run(folder, name), plot_cracks.Cracks(folder)
    aspect = (x_span[1] - x_span[0]) / (z_span[1] - z_span[0])
    if aspect > 2:
        figure, panels = plt.subplots(2, 1, figsize=(7.5, 5.2), height_ratios=[1.15, 1], constrained_layout=True)
    else:
        figure, panels = plt.subplots(1, 2, figsize=(8.5, 3.7), width_ratios=[max(0.8, aspect), 1],
                                      constrained_layout=True)
    coloring = draw_body(panels[0], run, cracks, field, factor, (x_span, z_span))
    coloring.label = {"szz": "vertical stress [MPa]", "sxx": "horizontal stress [MPa]"}[field]
    coloring.bar(figure, panels[0], shrink=0.9, aspect=25, pad=0.02)
    beside(panels[1], run, cracks)
    figure.savefig(os.path.join(FOLDER, name + ".png"), dpi=85, metadata={"Software": None})
    plt.close(figure)


def main():
    if len(sys.argv) < 2 or set(sys.argv[2:]) - set(SCENES):
        print(__doc__, file=sys.stderr)
        return 2
    plot_style.style()
    os.makedirs(FOLDER, exist_ok=True)
    for name in sys.argv[2:] or SCENES:
        with tempfile.TemporaryDirectory() as folder:
            changes = [part for change in SCENES[name][0] for part in ("--set", change)]
            subprocess.run([sys.argv[1], os.path.join(HERE, f"../config/scenes/{name}.yaml"), "--csv", folder, *changes],
                           check=True, stdout=subprocess.DEVNULL)
            picture(name, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
