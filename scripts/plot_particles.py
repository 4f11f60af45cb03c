"""Pictures of the particles: slices through the tool, and views from the side."""
import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator

from plot_render import Camera, Canvas
from plot_series import BLUE, save
from plot_tables import Table, TableError, file_stem

# From light to dark: what is at rest stays light, so that its shape can be seen.
SEQUENTIAL = ListedColormap(plt.get_cmap("magma_r")(np.linspace(0.1, 0.92, 256)), "light_to_dark")
STEEL = (0.62, 0.68, 0.75)
FIELDS = {
    "speed": "speed",
    "ep": "equivalent plastic strain",
    "p": "pressure",
    "mises": "von Mises stress",
    "j": "volume ratio det F",
    "density": "density",
    "vx": "velocity along x",
    "vy": "velocity along y",
    "vz": "velocity along z",
}
POSITION = ("x", "y", "z", "id")


class Snapshot:
    def __init__(self, time, path, label):
        self.time = time
        self.label = label
        self.table = Table(path)
        self.positions = np.column_stack([self.table[axis] for axis in "xyz"])


def choose(run):
    """The first, the middle and the last snapshot, and the one nearest to the largest force; else four evenly spread."""
    times = np.array([time for time, _ in run.snapshots])
    begin, end = times[0], times[-1]
    strongest = run.strongest()
    if strongest:
        near = "" if np.abs(times - strongest[1]).min() < 1e-9 else "near the "
        wanted = [(begin, " (start)"), (end, " (end)"), (strongest[1], f" ({near}largest force)"),
                  (0.5 * (begin + end), " (middle)")]
    else:
        wanted = [(begin, " (start)"), (end, " (end)"), ((2 * begin + end) / 3, ""), ((begin + 2 * end) / 3, "")]
    chosen = {}
    for time, label in wanted:
        chosen.setdefault(int(np.argmin(np.abs(times - time))), label)
    return [Snapshot(*run.snapshots[i], label) for i, label in sorted(chosen.items())]


def spacing(positions):
    """Median distance of a particle to its nearest neighbour [m]."""
    sample = positions[np.linspace(0, len(positions) - 1, min(200, len(positions))).astype(int)]
    nearest = []
    for point in sample:
        squares = np.sum((positions - point) ** 2, axis=1)
        squares[squares == 0] = np.inf
        nearest.append(squares.min())
    return float(np.sqrt(np.median(nearest)))


class Coloring:
    """Colours of a field, the same for all snapshots."""

    def __init__(self, snapshots, field):
        values = np.concatenate([snapshot.table[field] for snapshot in snapshots])
        low, high = np.percentile(values, [0.5, 99.5])
        if low < 0 < high and min(-low, high) > 0.1 * max(-low, high):
            high = max(-low, high)
            low, name = -high, "RdBu_r"
        else:
            low, name = (0.0 if 0 <= low < 0.3 * high else low), SEQUENTIAL
        if high <= low:
            high = low + max(abs(low), 1.0) * 1e-3
        self.map = plt.cm.ScalarMappable(plt.Normalize(low, high), name)
        unit = snapshots[0].table.units[field]
        self.label = FIELDS.get(field, field) + ("" if unit in ("", "1") else f" [{unit}]")

    def bar(self, figure, axes):
        bar = figure.colorbar(self.map, ax=axes, shrink=0.8, aspect=30, pad=0.01, extend="both", extendfrac=0.02)
        bar.set_label(self.label)
        bar.outline.set_visible(False)


def panels(count, aspect, height):
    """A figure of equal panels whose content has the given width over height; `height` [in] for a panel's labels."""
    columns = 1 if aspect > 4 else (count if aspect < 0.65 else min(2, count))
    rows = -(-count // columns)
    wide = 10.6 / columns - 0.7  # less the colour bar, and a panel's own labels
    figure, axes = plt.subplots(rows, columns, figsize=(12.0, rows * (wide / aspect + height) + 0.4), squeeze=False,
                                constrained_layout=True)
    for spare in axes.ravel()[count:]:
        spare.set_visible(False)
    return figure, axes.ravel()[:count]


def fields_of(run, wanted):
    """The field that is wanted, else those that tell most of what was recorded."""
    if not run.snapshots:
        return []
    known = [name for name in Table(run.snapshots[0][1]).names() if name not in POSITION]
    if wanted and wanted not in known:
        raise TableError(f"no particle field '{wanted}' was recorded; there are: {', '.join(known)}")
    return [wanted] if wanted else [name for name in ("speed", "ep", "mises", "p") if name in known][:2] or known[:1]


def plot_particles(run, folder, title, fields):
    if not fields:
        return
    snapshots = choose(run)
    gap = spacing(snapshots[0].positions)
    flat = all(np.ptp(snapshot.positions[:, 1]) == 0 for snapshot in snapshots)
    for name in fields:
        coloring = Coloring(snapshots, name)
        plot_section(run, snapshots, name, coloring, gap, folder, title)
        if not flat:
            plot_view(run, snapshots, name, coloring, gap, folder, title)


# --- slices ----------------------------------------------------------------------------------------------------------


def cut(vertices, faces, axis, at):
    """Where a surface meets a plane across an axis: pairs of points."""
    height = vertices[:, axis] - at
    height = np.where(height == 0, 1e-12, height)  # a corner on the plane belongs to one side
    segments = []
    for face in faces:
        side = height[face] > 0
        if side.all() or not side.any():
            continue
        ends = []
        for i in range(3):
            a, b = face[i], face[(i + 1) % 3]
            if (height[a] > 0) != (height[b] > 0):
                low, high = min(a, b), max(a, b)  # the same point for both faces of an edge
                share = height[low] / (height[low] - height[high])
                ends.append(vertices[low] + share * (vertices[high] - vertices[low]))
        segments.append(ends)
    return segments


def loops(segments):
    """Closed polygons from segments whose ends agree."""
    ways = {}
    for begin, end in segments:
        ways.setdefault(tuple(begin), []).append(tuple(end))
        ways.setdefault(tuple(end), []).append(tuple(begin))
    while ways:
        start, nexts = next(iter(ways.items()))
        polygon = [start]
        here = start
        while ways.get(here):
            step = ways[here].pop()
            ways[step].remove(here)
            if not ways[here]:
                del ways[here]
            polygon.append(step)
            here = step
        ways.pop(here, None)
        if len(polygon) > 3:
            yield np.array(polygon)


def slice_axis(run, body):
    """The level axis that the body moves along least: 0 for x, 1 for y."""
    if body is None:
        return 1
    travel = np.ptp(run.poses.vector(body + " "), axis=0)
    return 0 if travel[0] < 0.2 * travel[1] else 1


def plot_section(run, snapshots, field, coloring, gap, folder, title):
    strongest = run.strongest()
    tool = strongest[0] if strongest else (run.bodies[0] if run.bodies else None)
    axis = slice_axis(run, tool)
    level = 1 - axis
    shown = [level, 2]
    outlines = run.outlines()
    every = np.concatenate([snapshot.positions for snapshot in snapshots])
    low, high = every.min(axis=0)[shown] - gap, every.max(axis=0)[shown] + gap
    for body, (vertices, _) in outlines.items():
        for snapshot in snapshots:
            position, rotation = run.pose_at(body, snapshot.time)
            moved = (position + vertices @ rotation.T)[:, shown]
            reach = 1.5 * (every.max(axis=0) - every.min(axis=0))[shown]  # a plate without end is cut off
            low = np.minimum(low, np.maximum(moved.min(axis=0) - gap, low - 0.5 * reach))
            high = np.maximum(high, np.minimum(moved.max(axis=0) + gap, high + 0.5 * reach))
    # The largest force is a quarter of the picture long.
    arrow = 0.25 * (high - low).max() / np.linalg.norm(strongest[2]) if strongest else 0.0
    for snapshot in snapshots if tool else []:
        tip = run.pose_at(tool, snapshot.time)[0][shown] + arrow * run.force_at(tool, snapshot.time)[shown]
        low, high = np.minimum(low, tip - gap), np.maximum(high, tip + gap)
    size = high - low
    figure, axes = panels(len(snapshots), size[0] / size[1], 1.3 if tool else 1.05)
    names = "xyz"
    for i, (snapshot, panel) in enumerate(zip(snapshots, axes)):
        at = run.pose_at(tool, snapshot.time)[0][axis] if tool else float(np.median(snapshot.positions[:, axis]))
        near = np.abs(snapshot.positions[:, axis] - at) <= 0.75 * gap
        if not near.any():
            near[:] = True
        points = snapshot.positions[near][:, shown]
        colors = coloring.map.to_rgba(snapshot.table[field][near])
        width = np.full(len(points), 1.42 * gap)
        panel.add_collection(EllipseCollection(width, width, np.zeros(len(points)), units="xy", offsets=points,
                                               offset_transform=panel.transData, facecolors=colors, linewidths=0))
        for body, (vertices, faces) in outlines.items():
            position, rotation = run.pose_at(body, snapshot.time)
            segments = [(a[shown], b[shown]) for a, b in cut(position + vertices @ rotation.T, faces, axis, at)]
            paths = [Path(polygon, closed=True) for polygon in loops(segments)]
            if paths:
                panel.add_patch(PathPatch(Path.make_compound_path(*paths), facecolor=STEEL, linewidth=0, zorder=3))
            panel.add_collection(LineCollection(segments, colors="black", linewidths=1.3, zorder=4))
        if tool:
            draw_force(run, tool, snapshot.time, panel, shown, arrow)
        panel.set_xlim(low[0], high[0])
        panel.set_ylim(low[1], high[1])
        panel.set_aspect("equal")
        panel.grid(False)
        size_of_force = f"\n|F| on {tool} = {np.linalg.norm(run.force_at(tool, snapshot.time)):.3g} N" if tool else ""
        panel.set_title(f"{snapshot.time:.3g} s{snapshot.label}{size_of_force}")
        panel.set_xlabel(f"{names[level]} [m]")
        if i % 2 == 0:
            panel.set_ylabel("z [m]")
    where = f"slice through {tool}" if tool else f"slice at the middle of {names[axis]}"
    figure.suptitle(f"{title}: {coloring.label.partition(' [')[0]}, {where}", fontweight="bold")
    coloring.bar(figure, axes)
    save(figure, folder, f"section_{file_stem(field)}.png")


def draw_force(run, tool, time, panel, shown, metres_a_newton):
    """The path of the tool's origin, and an arrow for the force on it."""
    path = run.poses.vector(tool + " ")[:, shown]
    panel.plot(path[:, 0], path[:, 1], color="black", linewidth=0.8, linestyle=":", zorder=5)
    begin, arrow = run.pose_at(tool, time)[0][shown], metres_a_newton * run.force_at(tool, time)[shown]
    if np.any(arrow != 0):
        panel.annotate("", begin + arrow, begin, zorder=6, annotation_clip=False,
                       arrowprops={"arrowstyle": "-|>,head_width=0.25,head_length=0.5", "color": BLUE, "linewidth": 2,
                                   "shrinkA": 0, "shrinkB": 0})


# --- views -----------------------------------------------------------------------------------------------------------


def plot_view(run, snapshots, field, coloring, gap, folder, title):
    outlines = run.outlines()
    strongest = run.strongest()
    forward = 1.0
    if strongest:
        travel = run.poses[strongest[0] + " x"]
        forward = -1.0 if travel[-1] < travel[0] else 1.0
    camera = Camera([0.62 * forward, -0.78, 0.52])
    every = np.concatenate([snapshot.positions for snapshot in snapshots])
    box = np.array([every.min(axis=0) - 0.5 * gap, every.max(axis=0) + 0.5 * gap])
    corners = [np.array([[box[i][0], box[j][1], box[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])]
    for body, (vertices, _) in outlines.items():
        for snapshot in snapshots:
            position, rotation = run.pose_at(body, snapshot.time)
            corners.append(position + vertices @ rotation.T)
    flat = camera.project(np.concatenate(corners))[:, :2]
    margin = 0.12 * np.ptp(flat[:, 0])
    extent = (flat[:, 0].min() - margin, flat[:, 0].max() + margin, flat[:, 1].min() - margin, flat[:, 1].max() + 0.2 * margin)
    figure, axes = panels(len(snapshots), (extent[1] - extent[0]) / (extent[3] - extent[2]), 0.5)
    for snapshot, panel in zip(snapshots, axes):
        canvas = Canvas(camera, extent, 1100)
        canvas.spheres(snapshot.positions, 0.62 * gap, coloring.map.to_rgba(snapshot.table[field])[:, :3])
        for body, (vertices, faces) in outlines.items():
            position, rotation = run.pose_at(body, snapshot.time)
            canvas.triangles(position + vertices @ rotation.T, faces, STEEL)
        panel.imshow(canvas.picture(), extent=extent, interpolation="antialiased", zorder=1)
        draw_scales(panel, camera, box)
        panel.set_title(f"{snapshot.time:.3g} s{snapshot.label}")
        panel.set_aspect("equal")
        panel.axis("off")
    figure.suptitle(f"{title}: {coloring.label.partition(' [')[0]}", fontweight="bold")
    coloring.bar(figure, axes)
    save(figure, folder, f"view_{file_stem(field)}.png")


def draw_scales(panel, camera, box):
    """Scales along the near lower edges and the left upright edge of a box, with ticks in metres."""
    near = [1 if camera.towards[i] > 0 else 0 for i in (0, 1)]
    low = [box[0][0], box[0][1], box[0][2]]
    flat_corners = camera.project([[box[i][0], box[j][1], box[0][2]] for i in (0, 1) for j in (0, 1)])
    left = int(np.argmin(flat_corners[:, 0]))
    starts = {0: (None, box[near[1]][1], low[2]), 1: (box[near[0]][0], None, low[2]),
              2: (box[left // 2][0], box[left % 2][1], None)}
    for axis, start in starts.items():
        ticks = MaxNLocator(5 if axis == 0 else 3, steps=[1, 2, 5, 10]).tick_values(box[0][axis], box[1][axis])
        ticks = ticks[(ticks >= box[0][axis]) & (ticks <= box[1][axis])]
        if axis == 1:  # the corner belongs to x
            ticks = ticks[np.abs(ticks - box[near[1]][1]) > 0.05 * (box[1][1] - box[0][1])]
        line = [[v if v is not None else box[end][axis] for v in start] for end in (0, 1)]
        ends = camera.project(line)[:, :2]
        panel.plot(ends[:, 0], ends[:, 1], color="#555555", linewidth=1, zorder=2)
        upright = axis == 2
        style = {"textcoords": "offset points", "color": "#444444", "ha": "right" if upright else "center",
                 "va": "center" if upright else "top"}
        for tick in ticks:
            point = camera.project([[v if v is not None else tick for v in start]])[0, :2]
            panel.plot(*point, marker="_" if upright else "|", color="#555555", markersize=6, zorder=2)
            panel.annotate(f"{tick:g}", point, xytext=(-5, 0) if upright else (0, -4), fontsize=8, **style)
        beside = [(-12, -15), (16, -12), (-24, 0)][axis]
        panel.annotate(f"{'xyz'[axis]} [m]", ends.mean(axis=0), xytext=beside, fontsize=9, **style)
