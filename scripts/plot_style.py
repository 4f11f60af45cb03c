"""The style of all pictures: colours, captions, names beside the lines."""
import os
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

# Okabe and Ito's colours, which can be distinguished with any colour vision.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PINK = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
)
CYCLE = [BLUE, ORANGE, GREEN, RED, PINK, SKY, BLACK, YELLOW]  # of sources and of runs
AXES = {"x": BLUE, "y": ORANGE, "z": GREEN}
GREY = "#888888"
# From light to dark, with evenly falling lightness: material at rest stays light, so that its shape can be seen.
SEQUENTIAL = ListedColormap(plt.get_cmap("magma_r")(np.linspace(0.1, 0.92, 256)), "light_to_dark")
DIVERGING = "RdBu_r"
STEEL = (0.62, 0.68, 0.75)


def style():
    plt.rcParams.update(
        {
            "font.size": 10,
            "axes.titlesize": 11,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#e4e4e4",
            "grid.linewidth": 0.7,
            "axes.axisbelow": True,
            "legend.frameon": False,
            "lines.linewidth": 1.6,
            "figure.dpi": 150,
            "savefig.facecolor": "white",
            "figure.constrained_layout.h_pad": 0.08,
            "figure.constrained_layout.w_pad": 0.14,  # names beside lines and axes do not touch the edge
        }
    )


def caption(figure, title, text):
    """Writes the run's name and the subject above the picture, and how the run was made below."""
    figure.suptitle(title, fontweight="bold", fontsize=13, x=0.012, ha="left", linespacing=0.5)
    # A line ends with a dot, and does not begin with one; short parts stay in one.
    parts = [part.replace(" ", "\u00a0") if len(part) < 40 else part for part in text.split("  ·  ")]
    text = "\u00a0\u00a0·  ".join(parts)
    lines = [part for line in text.splitlines() for part in textwrap.wrap(line, int(15.5 * figure.get_figwidth()))]
    figure.supxlabel("\n".join(lines), fontsize=8, color="#666666", x=0.012, ha="left")


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name))
    plt.close(figure)


def name_lines(axes, entries):
    """Writes names beside the right ends of lines, in their colours and without overlap, and joins a name that had to
    move to the end of its line; each entry is (value at the end, name, colour)."""
    entries = [entry for entry in entries if np.isfinite(entry[0])]
    if not entries:
        return
    height = axes.get_figure().get_figheight() * axes.get_position().height * 72  # points
    low, high = axes.get_ylim()
    if axes.get_yscale() == "log":
        low, high = np.log10(low), np.log10(high)
    places = []
    for value, name, color in entries:
        value = np.log10(max(value, 1e-300)) if axes.get_yscale() == "log" else value
        places.append([np.clip((value - low) / (high - low), 0, 1), name, color])
    places.sort(key=lambda place: place[0])
    needed = [12 * (name.count("\n") + 1) / height for _, name, _ in places]
    centers = [place[0] for place in places]
    for _ in range(200):  # pushed apart until none overlap
        for i in range(len(centers) - 1):
            overlap = 0.5 * (needed[i] + needed[i + 1]) - (centers[i + 1] - centers[i])
            if overlap > 1e-4:
                centers[i] -= 0.5 * overlap
                centers[i + 1] += 0.5 * overlap
        centers[0] = max(centers[0], 0.0)
        centers[-1] = min(centers[-1], 1.0)
    moved = any(abs(center - place[0]) > 4 / height for center, place in zip(centers, places))
    beside = 1.035 if moved else 1.012
    for center, (end, name, color) in zip(centers, places):
        axes.text(beside, center, name, transform=axes.transAxes, color=color, ha="left", va="center", fontsize=9.5,
                  linespacing=1.05)
        if moved:
            axes.plot([1.003, beside - 0.006], [end, center], transform=axes.transAxes, color=color, linewidth=0.7,
                      clip_on=False, scalex=False, scaley=False)


def with_jumps(time, values):
    """The points of a line through samples (rows of `values`) at which a component jumps as it does where a motion is
    given piecewise: upright at the start of the interval that shows it first, since a sample tells of the interval
    before it. Slopes between others stay."""
    change = np.abs(np.diff(values, axis=0))
    if len(change) < 3:
        return time, values
    beside = np.maximum(np.pad(change, ((1, 0), (0, 0)))[:-1], np.pad(change, ((0, 1), (0, 0)))[1:])
    jumps = np.flatnonzero(np.any((change > 0.1 * np.ptp(values, axis=0)) & (change > 4 * beside), axis=1))
    return np.insert(time, jumps + 1, time[jumps]), np.insert(values, jumps + 1, values[jumps + 1], axis=0)


def zero_line(axes):
    axes.axhline(0, color="#999999", linewidth=0.8, zorder=1)


def mark_peak(axes, time, size, unit, color=RED):
    at = int(np.argmax(size))
    if size[at] <= 0:
        return
    axes.plot(time[at], size[at], "o", color=color, markersize=6, zorder=5)
    left = time[at] > 0.6 * time[-1] + 0.4 * time[0]
    axes.annotate(f"peak {size[at]:.4g} {unit} at {time[at]:.4g} s", (time[at], size[at]),
                  xytext=(-9 if left else 9, 4), textcoords="offset points", ha="right" if left else "left",
                  va="bottom", color=color, fontsize=9)
