"""A slice through the particles and the tools: both axes to the same scale."""
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator

from plot_style import BLUE, STEEL
from plot_tables import reach_of


def cut(vertices, faces, axis, at):
    """The intersection of a surface with a plane across an axis, as pairs of points."""
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
    """Closed polygons made of segments with common ends."""
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


def area(polygons):
    """The area that polygons enclose, less that of those within one of them, and so on, as a path; None without any."""
    outlines = [Path(polygon, closed=True) for polygon in polygons]
    turned = []
    for i, polygon in enumerate(polygons):
        around = sum(other.contains_point(polygon[0]) for k, other in enumerate(outlines) if k != i)
        x, y = polygon[:, 0], polygon[:, 1]
        left = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) > 0
        turned.append(Path(polygon if left == (around % 2 == 0) else polygon[::-1], closed=True))
    return Path.make_compound_path(*turned) if turned else None


def solids(vertices, faces):
    """A surface as its closed parts, (vertices, faces) each. A part that is turned inside out is a hollow in the others,
    and goes with all of them as one."""
    owner = np.arange(len(vertices))
    while True:  # every corner gets the least number among the corners of its faces
        least = owner[faces].min(axis=1)
        before = owner.copy()
        for corner in range(3):
            np.minimum.at(owner, faces[:, corner], least)
        if np.array_equal(owner, before):
            break
    labels = owner[faces[:, 0]]
    parts = [(vertices, faces[labels == label]) for label in np.unique(labels)]
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    hollow = any(volume[labels == label].sum() < 0 for label in np.unique(labels))
    return [(vertices, faces)] if hollow or len(parts) > 50 else parts


def slice_axis(run, body):
    """The horizontal axis along which the body moves least: 0 for x, 1 for y."""
    if body is None:
        return 1
    travel = np.ptp(run.poses.vector(body + " "), axis=0)
    return 0 if travel[0] < 0.2 * travel[1] else 1


class Section:
    """A slice through the tool with the largest force, or through the middle. All its pictures show the same part of
    the plane."""

    kind = "section"

    def __init__(self, run, box, gap, times):
        self.run, self.gap = run, gap
        strongest = run.strongest()
        self.tool = strongest[0] if strongest else (run.bodies[0] if run.bodies else None)
        self.flat = np.ptp(box[:, 1]) == 0
        self.axis = 1 if self.flat else slice_axis(run, self.tool)
        self.shown = [1 - self.axis, 2]
        self.middle = 0.5 * (box[0] + box[1])[self.axis]
        self.parts = {body: solids(*surface) for body, surface in run.outlines().items()}
        low, high = reach_of(run, box, times, gap)
        low, high = low[self.shown], high[self.shown]
        # The arrow of the largest force is a quarter of the picture long.
        self.arrow = 0.25 * (high - low).max() / np.linalg.norm(strongest[2]) if strongest else 0.0
        for time in times if self.tool else []:
            tip = run.pressed_at(self.tool, time)[self.shown] + self.arrow * run.force_at(self.tool, time)[self.shown]
            low, high = np.minimum(low, tip - gap), np.maximum(high, tip + gap)
        self.low, self.high = low, high
        self.aspect = float((high - low)[0] / (high - low)[1])
        self.room = 1.1 if self.tool else 0.9
        where = f"slice through {self.tool}" if self.tool else f"slice at the middle of {'xyz'[self.axis]}"
        self.where = "the whole plane" if self.flat else where

    def draw(self, panel, time, positions, colors):
        run, gap, shown, axis = self.run, self.gap, self.shown, self.axis
        at = run.pose_at(self.tool, time)[0][axis] if self.tool and not self.flat else self.middle
        near = np.abs(positions[:, axis] - at) <= 0.75 * gap
        if not near.any():
            near[:] = True
        points = positions[near][:, shown]
        width = np.full(len(points), 1.42 * gap)
        panel.add_collection(EllipseCollection(width, width, np.zeros(len(points)), units="xy", offsets=points,
                                               offset_transform=panel.transData, facecolors=colors[near],
                                               edgecolors="#88888866", linewidths=0.25))
        for body, parts in self.parts.items():
            position, rotation = run.pose_at(body, time)
            for vertices, faces in parts:
                segments = [(a[shown], b[shown]) for a, b in cut(position + vertices @ rotation.T, faces, axis, at)]
                # Half of a line lies beneath the filled parts: none is left inside parts that overlap.
                panel.add_collection(LineCollection(segments, colors="black", linewidths=2.6, zorder=3))
                path = area(list(loops(segments)))
                if path:
                    panel.add_patch(PathPatch(path, facecolor=STEEL, linewidth=0, zorder=4))
        if self.tool:
            self._draw_force(panel, time)
        panel.set_xlim(self.low[0], self.high[0])
        panel.set_ylim(self.low[1], self.high[1])
        panel.set_aspect("equal")
        panel.grid(False)
        panel.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))  # labels of neighbours do not meet
        panel.set_xlabel(f"{'xyz'[shown[0]]} [m]")
        panel.set_ylabel("z [m]")

    def force_text(self, time):
        if not self.tool:
            return ""
        return f"arrow: force on {self.tool}, {np.linalg.norm(self.run.force_at(self.tool, time)):.4g} N"

    def _draw_force(self, panel, time):
        """Draws the path of the tool's origin, and the force on it as an arrow from the centre of pressure."""
        path = self.run.poses.vector(self.tool + " ")[:, self.shown]
        if np.any(np.ptp(path, axis=0) > 0):
            panel.plot(path[:, 0], path[:, 1], color="black", linewidth=0.8, linestyle=":", zorder=5)
        begin = self.run.pressed_at(self.tool, time)[self.shown]
        arrow = self.arrow * self.run.force_at(self.tool, time)[self.shown]
        if np.any(arrow != 0):
            panel.annotate("", begin + arrow, begin, zorder=6, annotation_clip=False,
                           arrowprops={"arrowstyle": "-|>,head_width=0.25,head_length=0.5", "color": BLUE,
                                       "linewidth": 2, "shrinkA": 0, "shrinkB": 0})
