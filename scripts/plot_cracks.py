"""Pictures of explicit cracks: their lines over the particles, what their tips feel over time, and the way they went."""
import csv
import os

import matplotlib.pyplot as plt
import numpy as np

from plot_style import BLACK, BLUE, CYCLE, GREY, RED, SEQUENTIAL, caption, name_lines, save, zero_line
from plot_tables import TableError, file_stem

TIME = "simulated time [s]"
KNOWN = "the contour is complete"  # state of a tip whose J was found


def _columns(path):
    """The columns of a table of a run with cracks, each a list of texts."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = csv.reader(file)
            names = [name.partition(" [")[0] for name in next(rows)]
            return dict(zip(names, zip(*rows)))
    except (OSError, StopIteration, UnicodeDecodeError, csv.Error) as error:
        raise TableError(f"{path}: cannot be read; give a folder that bag_report --csv wrote") from error


def _numbers(columns, names, path):
    try:
        return np.column_stack([np.array(columns[name], dtype=float) for name in names])
    except (KeyError, ValueError) as error:
        raise TableError(f"{path}: no numbers of '{', '.join(names)}'; write the folder again") from error


class Chain:
    """A crack at one time: its points and those of its faces, x and z in rows [m]."""

    def __init__(self, rows):
        self.line, self.above, self.below = rows[:, 0:2], rows[:, 2:4], rows[:, 4:6]

    def length(self):
        """[m], along the middles between the faces."""
        middles = 0.5 * (self.above + self.below)
        return float(np.linalg.norm(np.diff(middles, axis=0), axis=1).sum())


class Tip:
    """A tip over time; J and K are NaN where they are not known."""

    def __init__(self, rows, known):
        self.time, self.places, self.grown = rows[:, 0], rows[:, 1:3], rows[:, 6]
        self.j, self.k_one, self.k_two = (np.where(known, rows[:, i], np.nan) for i in (3, 4, 5))


class Cracks:
    """The tables crack_points.csv and crack_tips.csv of a folder; empty for a run without cracks."""

    def __init__(self, folder):
        self.chains = {}  # name: [(time [s], Chain)]
        self.tips = {}  # (name, "start" or "end"): Tip
        path = os.path.join(folder, "crack_points.csv")
        if not os.path.exists(path):
            return
        columns = _columns(path)
        wanted = ["time", "x", "z", "above x", "above z", "below x", "below z"]
        rows, names = _numbers(columns, wanted, path), np.array(columns["crack"])
        for name in dict.fromkeys(columns["crack"]):
            own = rows[names == name]
            times, first = np.unique(own[:, 0], return_index=True)
            self.chains[name] = [(time, Chain(part[:, 1:])) for time, part in zip(times, np.split(own, first[1:]))]
        self._read_tips(os.path.join(folder, "crack_tips.csv"))

    def _read_tips(self, path):
        columns = _columns(path)
        if "crack" not in columns:
            return  # no crack has a tip
        rows = _numbers(columns, ["time", "x", "z", "j", "k_one", "k_two", "grown"], path)
        keys, known = list(zip(columns["crack"], columns["end"])), np.array(columns["state"]) == KNOWN
        for key in dict.fromkeys(keys):
            own = np.array([other == key for other in keys])
            self.tips[key] = Tip(rows[own], known[own])

    def __bool__(self):
        return bool(self.chains)

    def label(self, name, end):
        """How a tip is called where there may be several cracks."""
        return end if len(self.chains) == 1 else f"{name}, {end}"

    def draw(self, panel, time):
        """Draws the faces of each crack at the message nearest to a time [s], the gap between them, and the tips."""
        for chains in self.chains.values():
            chain = min(chains, key=lambda entry: abs(entry[0] - time))[1]
            panel.fill(*np.concatenate([chain.above, chain.below[::-1]]).T, facecolor="white", linewidth=0, zorder=2.5)
            for face in (chain.above, chain.below):
                panel.plot(*face.T, color=BLACK, linewidth=1.4, zorder=2.6)
        for tip in self.tips.values():
            place = tip.places[int(np.argmin(np.abs(tip.time - time)))]
            panel.plot(*place, "o", markersize=5, markerfacecolor="white", markeredgecolor=BLACK, markeredgewidth=1.4,
                       zorder=2.7)


def _draw_tips(panel, cracks, values):
    entries = []
    for i, ((name, end), tip) in enumerate(cracks.tips.items()):
        line, color = values(tip), CYCLE[i % len(CYCLE)]
        if np.isfinite(line).any():
            panel.plot(tip.time, line, color=color)
            entries.append((line[np.isfinite(line)][-1], cracks.label(name, end), color))
    zero_line(panel)
    panel.margins(x=0.01, y=0.08)
    name_lines(panel, entries)


def _found(cracks, values):
    return any(np.any(np.isfinite(values(tip)) & (values(tip) != 0)) for tip in cracks.tips.values())


def plot_tips(run, cracks, folder):
    """J, K_I and K_II of each tip, and the length of each crack, over time."""
    quantities = [("energy release rate J", "J [J/m²]", lambda tip: tip.j),
                  ("stress intensity of opening", "$K_I$ [Pa m$^{1/2}$]", lambda tip: tip.k_one),
                  ("stress intensity of shear", "$K_{II}$ [Pa m$^{1/2}$]", lambda tip: tip.k_two)]
    shown = [quantity for quantity in quantities if _found(cracks, quantity[2])]
    figure, panels = plt.subplots(len(shown) + 1, 1, figsize=(9.5, 1.2 + 2.4 * (len(shown) + 1)), sharex=True,
                                  squeeze=False, constrained_layout=True)
    caption(figure, f"{run.title}: cracks", run.caption())
    for panel, (title, unit, values) in zip(panels[:, 0], shown):
        panel.set_title(title[0].upper() + title[1:] + " of each tip")
        panel.set_ylabel(unit)
        _draw_tips(panel, cracks, values)
    last = panels[-1, 0]
    entries = []
    for i, (name, chains) in enumerate(cracks.chains.items()):
        lengths = [chain.length() for _, chain in chains]
        last.plot([time for time, _ in chains], lengths, color=CYCLE[i % len(CYCLE)])
        entries.append((lengths[-1], name, CYCLE[i % len(CYCLE)]))
    last.set_title("Length of each crack")
    last.set_ylabel("length [m]")
    last.set_xlabel(TIME)
    last.set_ylim(0, 1.1 * max(value for line in last.lines for value in line.get_ydata()))
    last.margins(x=0.01)
    name_lines(last, entries)
    save(figure, folder, "cracks.png")


def plot_paths(run, cracks, folder):
    """The way of each crack that grew: its points at the start and at the end, and the places of its tips between, by
    their times."""
    for name, chains in cracks.chains.items():
        tips = [tip for (crack, _), tip in cracks.tips.items() if crack == name and np.any(np.diff(tip.grown) > 0)]
        if not tips:
            continue
        start, end = chains[0][1], chains[-1][1]
        figure, panel = plt.subplots(figsize=(8.5, 6), constrained_layout=True)
        caption(figure, f"{run.title}: path of {name}", run.caption())
        panel.plot(*end.line.T, color=BLUE, linewidth=1.6, label=f"at {chains[-1][0]:.4g} s")
        panel.plot(*start.line.T, color=GREY, linewidth=5, alpha=0.5, label=f"at {chains[0][0]:.4g} s")
        grown = [np.concatenate([[False], np.diff(tip.grown) > 0]) for tip in tips]
        times = np.concatenate([tip.time[grew] for tip, grew in zip(tips, grown)])
        low, high = times.min(), times.max()
        for tip, grew in zip(tips, grown):
            dots = panel.scatter(*tip.places[grew].T, c=tip.time[grew], vmin=low, vmax=high, cmap=SEQUENTIAL, s=26,
                                 edgecolors=BLACK, linewidths=0.5, zorder=3)
        panel.plot(*np.array([tip.places[-1] for tip in tips]).T, "x", color=RED, markersize=9, label="tips at the end",
                   zorder=4)
        bar = figure.colorbar(dots, ax=panel, shrink=0.8)
        bar.set_label("time at which the tip came there [s]")
        bar.outline.set_visible(False)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_xlabel("x [m]")
        panel.set_ylabel("z [m]")
        panel.legend(loc="best")
        save(figure, folder, f"crack_path_{file_stem(name)}.png")


def plot_cracks(run, cracks, folder):
    """Draws nothing for a run without cracks."""
    if cracks:
        plot_tips(run, cracks, folder)
        plot_paths(run, cracks, folder)
