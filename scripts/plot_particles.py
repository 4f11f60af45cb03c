"""Pictures of the particles at a few times: slices through the tool, and views from the side."""
import textwrap

import matplotlib.pyplot as plt
import numpy as np

from plot_section import Section
from plot_style import DIVERGING, SEQUENTIAL, caption, save
from plot_tables import Table, TableError, file_stem
from plot_view import View

FIELDS = {
    "speed": "speed",
    "ep": "equivalent plastic strain",
    "p": "pressure",
    "mises": "von Mises stress",
    "j": "volume ratio det F",
    "density": "density",
    "temperature": "temperature",
    "concentration": "concentration",
    "pore_pressure": "pore pressure",
    "vx": "velocity along x",
    "vy": "velocity along y",
    "vz": "velocity along z",
}
POSITION = ("x", "y", "z", "id")
TRANSPORTED = ("temperature", "concentration", "pore_pressure")


class Snapshot:
    def __init__(self, time, path, label):
        self.time = time
        self.label = label
        self.table = Table(path)
        self.positions = np.column_stack([self.table[axis] for axis in "xyz"])


def choose(run):
    """The first, the middle and the last snapshot, and the one nearest to the largest force; without a force, four
    evenly spread ones."""
    times = np.array([time for time, _ in run.snapshots])
    begin, end = times[0], times[-1]
    strongest = run.strongest()
    if strongest:
        near = "" if np.abs(times - strongest[1]).min() < 1e-9 else "near the "
        wanted = [(begin, ", start"), (end, ", end"), (strongest[1], f", {near}largest force"),
                  (0.5 * (begin + end), ", middle")]
    else:
        wanted = [(begin, ", start"), (end, ", end"), ((2 * begin + end) / 3, ""), ((begin + 2 * end) / 3, "")]
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
    gap = float(np.sqrt(np.median(nearest)))
    return gap if np.isfinite(gap) else 1e-3  # a single particle has no neighbour


class Coloring:
    """Colours of a field between two values, the same for all times."""

    def __init__(self, name, unit, low, high):
        if low < 0 < high and min(-low, high) > 0.1 * max(-low, high):
            high = max(-low, high)
            low, colors = -high, DIVERGING
        else:
            low, colors = (0.0 if 0 <= low < 0.3 * high else low), SEQUENTIAL
        if high <= low:
            high = low + max(abs(low), 1.0) * 1e-3
        self.map = plt.cm.ScalarMappable(plt.Normalize(low, high), colors)
        self.name = FIELDS.get(name, name)
        self.label = self.name + ("" if unit in ("", "1") else f" [{unit}]")

    def bar(self, figure, axes, **options):
        bar = figure.colorbar(self.map, ax=axes, extend="both", extendfrac=0.02, **options)
        bar.set_label(self.label)
        bar.outline.set_visible(False)


def coloring_of(snapshots, field):
    low, high = np.percentile(np.concatenate([snapshot.table[field] for snapshot in snapshots]), [0.5, 99.5])
    return Coloring(field, snapshots[0].table.units[field], low, high)


def panels(count, aspect, room):
    """A figure of equal panels whose content has the given width over height; `room` [in] is for a panel's labels."""
    if aspect > 4:
        columns = 1
    elif aspect < 0.65:
        columns = count
    else:
        columns = min(2, count)
    rows = -(-count // columns)
    wide = min(10.6 / columns - 0.7, 6.0 * aspect)  # without the colour bar and the panels' labels
    size = (columns * (wide + 0.7) + 1.4, rows * (wide / aspect + room) + 0.9)
    figure, axes = plt.subplots(rows, columns, figsize=(max(size[0], 7.0), size[1]), squeeze=False,
                                constrained_layout=True)
    for spare in axes.ravel()[count:]:
        spare.set_visible(False)
    return figure, axes.ravel()[:count]


def fields_of(run, wanted):
    """The requested field; without a request, the most informative of those that were recorded."""
    if not run.snapshots:
        return []
    known = [name for name in Table(run.snapshots[0][1]).names() if name not in POSITION]
    if wanted and wanted not in known:
        raise TableError(f"no particle field '{wanted}' was recorded; there are: {', '.join(known)}")
    if wanted:
        return [wanted]
    # A quantity that is transported tells most, where the scene names it before all else.
    telling = [name for name in known[:1] if name in TRANSPORTED] + ["speed", "ep", "mises", "p"]
    return [name for name in telling if name in known][:2] or known[:1]


def plot_particles(run, folder, fields, cracks):
    if not fields:
        return
    snapshots = choose(run)
    gap = spacing(snapshots[0].positions)
    every = np.concatenate([snapshot.positions for snapshot in snapshots])
    box = np.array([every.min(axis=0), every.max(axis=0)])
    times = [snapshot.time for snapshot in snapshots]
    for name in fields:
        coloring = coloring_of(snapshots, name)
        section = Section(run, box, gap, times)
        draw_all(section, snapshots, name, coloring, folder, f"{run.title}: {coloring.name}, {section.where}",
                 cracks)
        if np.ptp(box[:, 1]) > 0:
            view = View(run, box, gap, times)
            draw_all(view, snapshots, name, coloring, folder, f"{run.title}: {coloring.name}")


def draw_all(scene, snapshots, field, coloring, folder, title, cracks=None):
    figure, axes = panels(len(snapshots), scene.aspect, scene.room)
    columns = axes[0].get_subplotspec().get_gridspec().ncols
    caption(figure, title + "\n", scene.run.caption())  # a line between it and the panels' own titles
    letters = int(72 * (figure.get_figwidth() - 1.6) / columns / 7.5)  # that a panel's title has room for
    for i, (snapshot, panel) in enumerate(zip(snapshots, axes)):
        scene.draw(panel, snapshot.time, snapshot.positions, coloring.map.to_rgba(snapshot.table[field]))
        if cracks:
            cracks.draw(panel, snapshot.time)
        force = scene.force_text(snapshot.time)
        parts = [f"t = {snapshot.time:.4g} s{snapshot.label}"] + ([force] if force else [])
        panel.set_title("\n".join(line for part in parts for line in textwrap.wrap(part, letters)))
        if i % columns:
            panel.set_ylabel("")
    coloring.bar(figure, axes, shrink=0.8, aspect=30, pad=0.02)
    save(figure, folder, f"{scene.kind}_{file_stem(field)}.png")
