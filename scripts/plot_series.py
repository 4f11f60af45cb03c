"""Pictures over time: contact and motion of a body, energies, the momentum audit and the numbers of the solver."""
import matplotlib.pyplot as plt
import numpy as np

from plot_style import (AXES, BLACK, BLUE, CYCLE, GREEN, GREY, ORANGE, PINK, RED, SKY, YELLOW, caption, mark_peak, name_lines,
                        save, with_jumps, zero_line)
from plot_tables import file_stem

TIME = "simulated time [s]"


def phases(time, velocity):
    """Spans of motion in one direction: (begin, end, "+x"), by the largest component of the velocity."""
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


def draw_vector(axes, time, vector, size_name=None, means=False):
    """Draws the components that are not zero (or round-off) throughout, and the magnitude in black; `means`: of the
    intervals that end at the times, as steps. Returns entries for name_lines()."""
    style = "steps-pre" if means else "default"
    entries = []
    if size_name:
        size = np.linalg.norm(vector, axis=1)
        axes.plot(time, size, color=BLACK, linewidth=2.6, drawstyle=style)
        entries.append((size[-1], size_name, BLACK))
    for i, (axis, color) in enumerate(AXES.items()):
        if np.any(np.abs(vector[:, i]) > 1e-9 * max(np.abs(vector).max(), 1e-300)):
            axes.plot(time, vector[:, i], color=color, drawstyle=style)
            entries.append((vector[-1, i], axis, color))
    zero_line(axes)
    return entries


def steps_of_time(axes):
    axes[-1].set_xlabel(TIME)
    for panel in axes:
        panel.margins(x=0.01)


def plot_contact(run, body, folder):
    time = run.forces["time"]
    force, torque = run.forces.vector(body + " f"), run.forces.vector(body + " t")
    impulse = run.forces.vector(body + " impulse ")
    peak = np.linalg.norm(run.forces.vector(body + " peak f"), axis=1)
    # A torque that is only round-off of balanced forces is left out, compared with the forces at the body's own arm.
    turns = np.abs(torque).max() > 1e-9 * np.abs(force).max()
    velocity = run.poses.vector(body + " v")
    moves = np.any(velocity)
    spans = phases(run.poses["time"], velocity)

    ratios = [1.6, 1.0] + ([1.0] if turns else []) + ([0.8] if moves else [])
    figure, panels = plt.subplots(len(ratios), 1, figsize=(9.5, 1.2 + 1.9 * sum(ratios)), sharex=True,
                                  height_ratios=ratios, constrained_layout=True)
    caption(figure, f"{run.title}: what the material does to {body}", run.caption())
    top, below = panels[0], list(panels[1:])
    top.fill_between(time, peak, color="#d9d9d9", linewidth=0, zorder=1, step="pre")
    entries = draw_vector(top, time, force, "|F|", means=True)
    # One step's spike must not flatten the rest.
    largest, low = np.linalg.norm(force, axis=1).max(), min(0, force.min())
    if largest > 0:
        top.set_ylim(1.1 * low - 0.02 * largest, 1.22 * min(max(peak.max(), largest), 2 * largest))
    else:
        top.set_ylim(-1, 1)
        top.text(0.5, 0.7, "never touched", transform=top.transAxes, ha="center", color=GREY)
    mark_peak(top, time, np.linalg.norm(force, axis=1), "N")
    top.set_ylabel("force [N]")
    top.set_title("Force on the body, world axes: mean over each interval; grey: largest single step",
                  pad=18 if len(spans) > 1 else 6)
    name_lines(top, entries)

    panel = below.pop(0)
    draw_vector(panel, time, impulse)
    panel.margins(y=0.12)
    names = [(impulse[-1, i], f"{axis}: {impulse[-1, i]:.4g} N s".replace("-", "−"), color)
             for i, (axis, color) in enumerate(AXES.items())
             if np.any(np.abs(impulse[:, i]) > 1e-9 * max(np.abs(impulse).max(), 1e-300))]
    panel.set_ylabel("impulse [N s]")
    panel.set_title("Impulse: the force summed over time")
    name_lines(panel, names)
    if turns:
        panel = below.pop(0)
        entries = draw_vector(panel, time, torque, "|T|", means=True)
        panel.margins(y=0.2)
        mark_peak(panel, time, np.linalg.norm(torque, axis=1), "N m")
        panel.set_ylabel("torque [N m]")
        panel.set_title("Torque about the body's origin, world axes")
        name_lines(panel, entries)
    if moves:
        panel = below.pop(0)
        entries = draw_vector(panel, *with_jumps(run.poses["time"], velocity))
        panel.set_ylabel("velocity [m/s]")
        panel.set_title("Velocity of the body's origin")
        name_lines(panel, entries)
    for i, axes in enumerate(panels):
        shade(axes, spans, labelled=i == 0)
    steps_of_time(panels)
    save(figure, folder, f"contact_{file_stem(body)}.png")


def energies_of(state):
    """(name, values [J], colour): potential energy is that since the start; `rest` is what remains of the work."""
    kinetic, elastic, plastic = (state["energy " + kind] for kind in ("kinetic", "elastic", "plastic"))
    potential = state["energy potential"] - state["energy potential"][0]
    work = state["contact work"]
    loads = state["load work"]
    friction = state["energy friction"] + state["energy pair friction"]
    interface = state["energy interface"]
    rest = work + loads - plastic - friction - interface - potential - (kinetic - kinetic[0]) - (elastic - elastic[0])
    return [("work done by\nthe bodies", work, BLACK), ("work done by\nloads", loads, PINK),
            ("potential", potential, GREEN), ("kinetic", kinetic, BLUE), ("elastic", elastic, ORANGE),
            ("lost to plastic\nor viscous flow", plastic, RED),
            ("lost to friction", friction, SKY), ("in interfaces", interface, YELLOW),
            ("lost elsewhere:\nwalls, damping", rest, GREY)]


def plot_energies(run, folder):
    state = run.state
    time = state["time"]
    every = [entry for entry in energies_of(state) if np.any(entry[1])]
    stored = [entry for entry in every if entry[0] in ("kinetic", "elastic")]
    figure, panels = plt.subplots(2, 1, figsize=(9.5, 7), sharex=True, height_ratios=[1.6, 1], constrained_layout=True)
    caption(figure, f"{run.title}: energies of the material", run.caption())
    for panel, entries in zip(panels, (every, stored)):
        for name, values, color in entries:
            panel.plot(time, values, color=color, linewidth=2.6 if color == BLACK else 1.6,
                       linestyle="--" if color == GREY else "-")
        panel.set_ylabel("energy [J]")
        zero_line(panel)
        panel.margins(y=0.08)
        name_lines(panel, [(values[-1], name, color) for name, values, color in entries])
    panels[0].set_title("Where the work of the bodies and of gravity goes (potential energy since the start)")
    panels[1].set_title("Kinetic and elastic energy alone")
    steps_of_time(panels)
    save(figure, folder, "energies.png")


def plot_global(run, folder):
    """Draws the global quantities that the scene asks for, a panel for each unit; returns without a picture if there
    are none."""
    table = run.global_quantities
    names = [name for name in table.names() if name != "time"] if table else []
    if not names:
        return
    units = list(dict.fromkeys(table.units[name] for name in names))
    figure, panels = plt.subplots(len(units), 1, figsize=(9.5, 1.2 + 2.6 * len(units)), sharex=True, squeeze=False,
                                  constrained_layout=True)
    caption(figure, f"{run.title}: global quantities", run.caption())
    for panel, unit in zip(panels[:, 0], units):
        entries = []
        for i, name in enumerate(name for name in names if table.units[name] == unit):
            panel.plot(table["time"], table[name], color=CYCLE[i % len(CYCLE)])
            entries.append((table[name][-1], name, CYCLE[i % len(CYCLE)]))
        panel.set_ylabel(f"[{unit}]")
        zero_line(panel)
        panel.margins(y=0.08)
        name_lines(panel, entries)
    steps_of_time(panels[:, 0])
    save(figure, folder, "global_quantities.png")


def impulses_of(state):
    """The axis with most momentum exchanged, and (name, impulse along it [N s], colour) of each source that acts."""
    names = [name[len("impulse "):-2] for name in state.names() if name.startswith("impulse ") and name.endswith(" x")]
    impulses = {name: state.vector(f"impulse {name} ") for name in names}
    sizes = {name: np.abs(impulse).max() for name, impulse in impulses.items()}
    largest = max(impulses, key=sizes.get, default=None)
    axis = int(np.argmax(np.abs(impulses[largest]).max(axis=0))) if largest else 2
    acting = [name for name in names if np.abs(impulses[name][:, axis]).max() > 1e-9 * sizes[largest]]
    return axis, [(name, impulses[name][:, axis], CYCLE[i % 6]) for i, name in enumerate(acting)]


def draw_residual(axes, time, error, color):
    smallest = 1e-18  # a residual of exactly zero has no logarithm
    axes.semilogy(time, np.maximum(error, smallest), color=color)


def frame_residual(axes, largest, limit):
    axes.axhline(limit, color=RED, linestyle="--", linewidth=1.2)
    axes.set_ylim(1e-18, 10 * max(limit, largest))
    axes.set_yticks(10.0 ** np.arange(-18, np.log10(axes.get_ylim()[1]) + 0.1, 4))
    axes.set_ylabel("residual [1]")
    axes.set_title("Audit: change of momentum less all impulses, over the momentum exchanged")


def draw_steps(axes, state, color):
    """Draws the time step over time, from the first step on: all steps of an interval are as long."""
    made = state["dt"] > 0
    axes.plot(state["time"][made], 1e6 * state["dt"][made], color=color, drawstyle="steps-pre")
    return state["dt"][-1] * 1e6


def plot_audit(run, folder):
    state = run.state
    time, error = state["time"], state["momentum error"]
    figure, panels = plt.subplots(4, 1, figsize=(9.5, 10), sharex=True, height_ratios=[1.5, 1, 0.8, 0.8],
                                  constrained_layout=True)
    caption(figure, f"{run.title}: account of the momentum, time step, volume", run.caption())
    momentum, residual, step, volume = panels
    axis, sources = impulses_of(state)
    for name, impulse, color in sources:
        momentum.plot(time, impulse, color=color)
    change = state["momentum " + "xyz"[axis]] - state["momentum " + "xyz"[axis]][0]
    momentum.plot(time, change, color=BLACK, linewidth=2.6)
    zero_line(momentum)
    momentum.set_ylabel("impulse [N s]")
    momentum.set_title(f"Impulses on the material since the start along {'xyz'[axis]}, by source")
    name_lines(momentum, [(impulse[-1], name, color) for name, impulse, color in sources]
               + [(change[-1], "change of\nmomentum", BLACK)])
    draw_residual(residual, time, error, BLUE)
    frame_residual(residual, error.max(), run.audit_limit)
    name_lines(residual, [(max(error[-1], 1e-18), f"worst {error.max():.1e}", BLUE), (run.audit_limit, "limit", RED)])
    draw_steps(step, state, BLUE)
    step.set_ylim(0, 1.15e6 * state["dt"].max())
    step.set_ylabel("time step [µs]")
    step.set_title("Length of a time step")
    volume.plot(time, state["min j"], color=BLUE)
    low, high = min(state["min j"].min(), 0.99), max(state["min j"].max(), 1.0)
    volume.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    volume.set_ylabel("det F [1]")
    volume.set_title("Smallest volume of a particle over its volume at the start (must stay above 0)")
    name_lines(volume, [(state["min j"][-1], f"least {state['min j'].min():.4g}\nend {state['min j'][-1]:.4g}", BLUE)])
    steps_of_time(panels)
    save(figure, folder, "audit.png")
