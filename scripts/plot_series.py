"""Pictures over time: contact and motion of a body, energies, the momentum audit."""
import os

import matplotlib.pyplot as plt
import numpy as np

from plot_tables import file_stem

# Okabe and Ito's colours, which people with any colour vision tell apart.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PINK = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
)
AXES = {"x": BLUE, "y": ORANGE, "z": GREEN}
AUDIT_LIMIT = 1e-10


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
        }
    )


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name))
    plt.close(figure)


def phases(time, velocity):
    """Spans of one way of moving: (begin, end, "+x"); the direction is the largest component of the velocity."""
    speed = np.abs(velocity)
    if len(time) < 3 or speed.max() == 0:
        return []
    way = np.where(speed.max(axis=1) < 0.05 * speed.max(), -1, 2 * np.argmax(speed, axis=1))
    way = way + np.where((way >= 0) & (np.take_along_axis(velocity, speed.argmax(axis=1)[:, None], 1)[:, 0] < 0), 1, 0)
    names = {-1: "at rest", 0: "moves +x", 1: "moves −x", 2: "moves +y", 3: "moves −y", 4: "up", 5: "down"}
    edges = np.concatenate([[0], np.flatnonzero(np.diff(way)) + 1, [len(way) - 1]])
    spans = []
    for begin, end in zip(edges[:-1], edges[1:]):
        label = names[int(way[begin])]
        if time[end] - time[begin] < 0.02 * (time[-1] - time[0]) and spans:
            spans[-1][1] = time[end]  # too short to be a phase of its own
        elif spans and spans[-1][2] == label:
            spans[-1][1] = time[end]
        else:
            spans.append([time[begin], time[end], label])
    return spans


def shade(axes, spans, labelled):
    if len(spans) < 2:
        return
    total = spans[-1][1] - spans[0][0]
    for i, (begin, end, label) in enumerate(spans):
        axes.axvspan(begin, end, color="#f1f1f1" if i % 2 else "#fafafa", linewidth=0, zorder=0)
        if labelled and end - begin > 0.05 * total:
            axes.text(0.5 * (begin + end), 1.01, label, transform=axes.get_xaxis_transform(), ha="center", va="bottom",
                      fontsize=8.5, color="#666666")


def mark_peak(axes, time, size, unit):
    at = int(np.argmax(size))
    if size[at] <= 0:
        return
    axes.plot(time[at], size[at], "o", color=RED, markersize=6, zorder=5)
    left = time[at] > 0.6 * time[-1] + 0.4 * time[0]
    axes.annotate(f"peak {size[at]:.4g} {unit} at {time[at]:.3g} s", (time[at], size[at]), xytext=(-9 if left else 9, 3),
                  textcoords="offset points", ha="right" if left else "left", va="bottom", color=RED, fontsize=9)


def draw_vector(axes, time, vector, size_name=None):
    """Components that are not zero (or round-off) throughout, and the size in black."""
    if size_name:
        axes.plot(time, np.linalg.norm(vector, axis=1), color=BLACK, linewidth=2.0, label=size_name)
    for i, (axis, color) in enumerate(AXES.items()):
        if np.any(np.abs(vector[:, i]) > 1e-9 * max(np.abs(vector).max(), 1e-300)):
            axes.plot(time, vector[:, i], color=color, label=axis)
    axes.axhline(0, color="#999999", linewidth=0.8, zorder=1)


def legend(axes):
    if not axes.get_legend_handles_labels()[0]:
        return
    axes.legend(loc="center left", bbox_to_anchor=(1.005, 0.5), handlelength=1.4)


def plot_contact(run, body, folder, title):
    time = run.forces["time"]
    force, torque = run.forces.vector(body + " f"), run.forces.vector(body + " t")
    peak = np.linalg.norm(run.forces.vector(body + " peak f"), axis=1)
    if np.abs(torque).max() < 1e-9 * np.abs(force).max():
        torque[:] = 0.0  # round-off of forces in balance
    velocity = run.poses.vector(body + " v")
    spans = phases(run.poses["time"], velocity)

    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(9, 8), sharex=True, height_ratios=[1.5, 1.2, 1],
                                                 constrained_layout=True)
    figure.suptitle(f"{title}: contact of {body} and its motion", fontweight="bold")
    top.fill_between(time, peak, color="#d9d9d9", linewidth=0, label="largest\nof a step", zorder=1)
    draw_vector(top, time, force, "|F|")
    mark_peak(top, time, np.linalg.norm(force, axis=1), "N")
    top.set_ylabel("force [N]")
    top.set_title("Force of the material on the body (mean over each interval, world axes)", pad=18)
    # One step's spike must not flatten the rest.
    largest, low = np.linalg.norm(force, axis=1).max(), min(0, force.min())
    if largest > 0:
        top.set_ylim(1.1 * low - 0.02 * largest, 1.18 * min(max(peak.max(), largest), 2 * largest))
    draw_vector(middle, time, torque, "|T|")
    if np.any(torque):
        middle.margins(y=0.15)
    else:
        middle.set_ylim(-1, 1)
    mark_peak(middle, time, np.linalg.norm(torque, axis=1), "N m")
    middle.set_ylabel("torque [N m]")
    middle.set_title("Torque about the body's origin")
    draw_vector(bottom, run.poses["time"], velocity)
    bottom.set_ylabel("velocity [m/s]")
    bottom.set_title("Velocity of the body's origin")
    bottom.set_xlabel("simulated time [s]")
    for i, axes in enumerate((top, middle, bottom)):
        shade(axes, spans, labelled=i == 0)
        legend(axes)
        axes.margins(x=0.01)
    save(figure, folder, f"contact_{file_stem(body)}.png")


def plot_energies(run, folder, title):
    state = run.state
    time = state["time"]
    kinetic, elastic, plastic = (state["energy " + kind] for kind in ("kinetic", "elastic", "plastic"))
    potential = state["energy potential"] - state["energy potential"][0]
    work = state["contact work"]
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(9, 7), sharex=True, height_ratios=[1.5, 1],
                                         constrained_layout=True)
    figure.suptitle(f"{title}: energies of the material", fontweight="bold")
    top.plot(time, work, color=BLACK, linewidth=2.0, label="work done by\nthe bodies")
    if plastic.any():
        top.plot(time, plastic, color=RED, label="dissipated by\nplastic flow")
    if potential.any():
        top.plot(time, potential, color=GREEN, label="potential")
    top.plot(time, kinetic, color=BLUE, label="kinetic")
    top.plot(time, elastic, color=ORANGE, label="elastic")
    rest = work - plastic - potential - (kinetic - kinetic[0]) - (elastic - elastic[0])
    top.plot(time, rest, color="#888888", linestyle="--", label="not in these:\nfriction, walls,\ndamping")
    top.set_title("Where the work of the bodies goes (potential energy since the start)")
    bottom.plot(time, kinetic, color=BLUE, label="kinetic")
    bottom.plot(time, elastic, color=ORANGE, label="elastic")
    bottom.set_title("Kinetic and elastic energy alone")
    bottom.set_xlabel("simulated time [s]")
    for axes in (top, bottom):
        axes.set_ylabel("energy [J]")
        axes.axhline(0, color="#999999", linewidth=0.8, zorder=1)
        legend(axes)
        axes.margins(x=0.01)
    save(figure, folder, "energies.png")


def plot_audit(run, folder, title):
    state = run.state
    time, error = state["time"], state["momentum error"]
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(9, 7), sharex=True, constrained_layout=True)
    figure.suptitle(f"{title}: audit of the momentum", fontweight="bold")
    smallest = 1e-18  # a residual of exactly zero has no logarithm
    top.semilogy(time, np.maximum(error, smallest), color=BLUE, label="residual")
    top.axhline(AUDIT_LIMIT, color=RED, linestyle="--", label="limit")
    top.set_ylim(smallest / 2, max(1e-9, 10 * error.max()))
    top.set_ylabel("residual / momentum exchanged")
    top.set_title("Change of momentum less all impulses, over the momentum exchanged")
    colors = [GREEN, BLUE, ORANGE, RED, PINK, SKY, YELLOW]
    names = [name[len("impulse "):-2] for name in state.names() if name.startswith("impulse ") and name.endswith(" x")]
    impulses = {name: state.vector(f"impulse {name} ") for name in names}
    sizes = {name: np.abs(impulse).max() for name, impulse in impulses.items()}
    largest = max(impulses, key=sizes.get, default=None)
    axis = int(np.argmax(np.abs(impulses[largest]).max(axis=0))) if largest else 2
    acting = [name for name in names if np.abs(impulses[name][:, axis]).max() > 1e-9 * sizes[largest]]
    for i, name in enumerate(acting):
        bottom.plot(time, impulses[name][:, axis], color=colors[i % len(colors)],
                    linestyle="-" if i < len(colors) else "--", label=name)
    momentum = state["momentum " + "xyz"[axis]]
    bottom.plot(time, momentum - momentum[0], color=BLACK, linewidth=2.0, label="change of\nmomentum")
    bottom.set_ylabel("impulse [N s]")
    bottom.set_title(f"Impulses on the material since the start along {'xyz'[axis]}, by source")
    bottom.set_xlabel("simulated time [s]")
    for axes in (top, bottom):
        legend(axes)
        axes.margins(x=0.01)
    save(figure, folder, "audit.png")
