"""Particles and tools seen from the side and above, on a ground with a grid, as RViz shows them."""
import numpy as np
from matplotlib.ticker import MaxNLocator

from plot_render import Camera, Canvas
from plot_style import STEEL
from plot_tables import reach_of

WIDTH = 1100  # pixels of a picture
LARGEST = 20  # largest radius of a particle in pixels: more is slow, and shows nothing more


def in_front(positions, gap, towards):
    """Whether a particle is visible: it is hidden if all three neighbouring places towards the viewer are occupied."""
    cells = np.floor((positions - positions.min(axis=0)) / gap + 0.5).astype(np.int64) + 1
    sizes = cells.max(axis=0) + 2
    strides = np.array([1, sizes[0], sizes[0] * sizes[1]])
    keys = cells @ strides
    taken = np.unique(keys)
    hidden = np.ones(len(keys), bool)
    for axis in range(3):
        neighbour = keys + int(np.sign(towards[axis])) * strides[axis]
        place = np.minimum(np.searchsorted(taken, neighbour), len(taken) - 1)
        hidden &= taken[place] == neighbour
    return ~hidden


class View:
    kind = "view"
    room = 0.5

    def __init__(self, run, box, gap, times, width=WIDTH):
        self.run, self.gap = run, gap
        self.outlines = run.outlines()
        strongest = run.strongest()
        forward = 1.0
        if strongest:
            travel = run.poses[strongest[0] + " x"]
            forward = -1.0 if travel[-1] < travel[0] else 1.0
        self.camera = Camera([0.62 * forward, -0.78, 0.52])
        self.box = np.array(reach_of(run, box, times, gap))
        corners = [[self.box[i][0], self.box[j][1], self.box[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        flat = self.camera.project(corners)[:, :2]
        margin = 0.1 * np.ptp(flat[:, 0])
        self.extent = (flat[:, 0].min() - margin, flat[:, 0].max() + margin,
                       flat[:, 1].min() - margin, flat[:, 1].max() + 0.1 * margin)
        self.aspect = float((self.extent[1] - self.extent[0]) / (self.extent[3] - self.extent[2]))
        self.width = int(min(width, max(0.5 * width, LARGEST * (self.extent[1] - self.extent[0]) / (0.62 * gap))))
        self.ticks = [self._ticks(axis) for axis in range(3)]

    def _ticks(self, axis):
        low, high = self.box[:, axis]
        longest = np.ptp(self.box, axis=0).max()
        count = max(4, round(6 * (high - low) / longest))
        ticks = MaxNLocator(count, steps=[1, 2, 5, 10]).tick_values(low, high)
        return ticks[(ticks >= low - 1e-9 * longest) & (ticks <= high + 1e-9 * longest)]

    def draw(self, panel, time, positions, colors):
        canvas = Canvas(self.camera, self.extent, self.width)
        self._draw_ground(canvas)
        seen = in_front(positions, self.gap, self.camera.towards)
        canvas.spheres(positions[seen], 0.62 * self.gap, colors[seen, :3])
        for body, (vertices, faces) in self.outlines.items():
            position, rotation = self.run.pose_at(body, time)
            canvas.triangles(position + vertices @ rotation.T, faces, STEEL)
        panel.imshow(canvas.picture(), extent=self.extent, interpolation="antialiased", zorder=1)
        self._draw_scales(panel)
        panel.set_xlim(self.extent[:2])
        panel.set_ylim(self.extent[2:])
        panel.set_aspect("equal")
        panel.axis("off")

    def force_text(self, _time):
        return ""

    def _draw_ground(self, canvas):
        (x0, y0, z), (x1, y1, _) = self.box
        z -= 0.02 * self.gap  # below the objects that stand on the ground
        for x in self.ticks[0]:
            canvas.line([x, y0, z], [x, y1, z], 0.85)
        for y in self.ticks[1]:
            canvas.line([x0, y, z], [x1, y, z], 0.85)
        for begin, end in (([x0, y0], [x1, y0]), ([x1, y0], [x1, y1]), ([x1, y1], [x0, y1]), ([x0, y1], [x0, y0])):
            canvas.line([*begin, z], [*end, z], 0.6)

    def _draw_scales(self, panel):
        """Draws scales along the near lower edges and the left upright edge of the box, with ticks in metres."""
        camera, box = self.camera, self.box
        near = [1 if camera.towards[i] > 0 else 0 for i in (0, 1)]
        flat_corners = camera.project([[box[i][0], box[j][1], box[0][2]] for i in (0, 1) for j in (0, 1)])
        left = int(np.argmin(flat_corners[:, 0]))
        low = box[0][2]
        starts = {0: (None, box[near[1]][1], low), 1: (box[near[0]][0], None, low),
                  2: (box[left // 2][0], box[left % 2][1], None)}
        middle = camera.project([0.5 * (box[0] + box[1])])[0, 0]
        for axis, start in starts.items():
            line = camera.project([[v if v is not None else box[end][axis] for v in start] for end in (0, 1)])[:, :2]
            upright = axis == 2
            leftwards = upright or line[:, 0].mean() < middle
            if upright:
                panel.plot(line[:, 0], line[:, 1], color="#777777", linewidth=0.8, zorder=2)
            style = {"textcoords": "offset points", "color": "#444444", "va": "center" if upright else "top",
                     "ha": "right" if leftwards else "left"}
            for tick in self.ticks[axis]:
                point = camera.project([[v if v is not None else tick for v in start]])[0, :2]
                panel.plot(*point, marker="_" if upright else "|", color="#777777", markersize=5, zorder=2)
                panel.annotate(f"{tick:g}".replace("-", "−"), point, xytext=(-6 if leftwards else 6, 0 if upright else -2),
                               fontsize=8, **style)
            beside = (-30, 0) if upright else ((-14, -15) if leftwards else (14, -15))
            panel.annotate(f"{'xyz'[axis]} [m]", line.mean(axis=0), xytext=beside, fontsize=9, **style)
