"""Several runs on one plot; each run has one colour in all pictures."""
import matplotlib.pyplot as plt
import numpy as np

from plot_series import draw_residual, draw_steps, energies_of, frame_residual, steps_of_time
from plot_style import CYCLE, RED, caption, name_lines, save, zero_line
from plot_tables import file_stem


def labels_of(runs):
    """Label of each run: the scene if all scenes differ, the file if they are the same, else scene and file."""
    scenes = [run.title for run in runs]
    if len(set(scenes)) == len(runs):
        return scenes
    return [run.label if len(set(scenes)) == 1 else f"{run.label} ({run.title})" for run in runs]


class Compared:
    """Runs with their labels and colours."""

    def __init__(self, runs):
        self.runs = runs
        self.labels = labels_of(runs)
        self.colors = [CYCLE[i % len(CYCLE)] for i in range(len(runs))]
        self.styles = ["-", "--", "-.", ":"]

    def caption(self):
        return "\n".join(f"{label}:  {run.caption()}" for run, label in zip(self.runs, self.labels))

    def draw(self, axes, values_of, runs=None, log=False, means=False):
        """Draws one line for each run; values_of(run) returns (times, values); `means`: of the intervals that end at
        the times, as steps."""
        entries = []
        for i, (run, label, color) in enumerate(zip(self.runs, self.labels, self.colors)):
            if runs is not None and run not in runs:
                continue
            time, values = values_of(run)
            if log:
                draw_residual(axes, time, values, color)
            else:
                axes.plot(time, values, color=color, linestyle=self.styles[i // len(CYCLE) % 4],
                          drawstyle="steps-pre" if means else "default")
            entries.append((values[-1], label, color))
        return entries


def plot_comparison(runs, folder):
    compared = Compared(runs)
    bodies = list(dict.fromkeys(body for run in runs for body in run.bodies))
    for body in bodies:
        compare_contact(compared, body, folder)
    compare_energies(compared, folder)
    compare_numbers(compared, folder)


def compare_contact(compared, body, folder):
    runs = [run for run in compared.runs if body in run.bodies]

    def force(axis):
        return lambda run: (run.forces["time"], run.forces[f"{body} f{axis}"])

    def impulse(axis):
        return lambda run: (run.forces["time"], run.forces[f"{body} impulse {axis}"])

    def size(run):
        return run.forces["time"], np.linalg.norm(run.forces.vector(body + " f"), axis=1)

    largest = max(size(run)[1].max() for run in runs)
    axes_that_act = [axis for axis in "xyz"
                     if max(np.abs(force(axis)(run)[1]).max() for run in runs) > 1e-6 * max(largest, 1e-300)]
    wanted = [("Size of the force on the body, mean over each interval", "|F| [N]", size)]
    for axis in axes_that_act if len(axes_that_act) > 1 else []:
        wanted.append((f"Force along {axis}", f"F{axis} [N]", force(axis)))
    for axis in axes_that_act:
        wanted.append((f"Impulse along {axis}: the force summed over time", f"J{axis} [N s]", impulse(axis)))
    figure, panels = plt.subplots(len(wanted), 1, figsize=(9.5, 1.4 + 2.2 * len(wanted)), sharex=True, squeeze=False,
                                  constrained_layout=True)
    panels = panels[:, 0]
    without = [label for run, label in zip(compared.runs, compared.labels) if run not in runs]
    note = f" (not in {', '.join(without)})" if without else ""
    caption(figure, f"What the material does to {body}{note}", compared.caption())
    for panel, (title, unit, values_of) in zip(panels, wanted):
        entries = compared.draw(panel, values_of, runs, means=unit.endswith("[N]"))
        zero_line(panel)
        panel.set_title(title)
        panel.set_ylabel(unit)
        panel.margins(y=0.1)
        name_lines(panel, entries)
    for run, color in zip(compared.runs, compared.colors):
        if run in runs:
            time, values = size(run)
            at = int(np.argmax(values))
            panels[0].plot(time[at], values[at], "o", color=color, markersize=6, zorder=5)
            panels[0].annotate(f"{values[at]:.4g} N", (time[at], values[at]), xytext=(0, 5), ha="center", va="bottom",
                               textcoords="offset points", color=color, fontsize=9)
    panels[0].margins(y=0.2)
    steps_of_time(panels)
    save(figure, folder, f"compare_contact_{file_stem(body)}.png")


def compare_energies(compared, folder):
    kinds = []
    for index in range(len(energies_of(compared.runs[0].state))):
        name = energies_of(compared.runs[0].state)[index][0].replace("\n", " ")
        if any(np.any(energies_of(run.state)[index][1]) for run in compared.runs):
            kinds.append((index, name))
    rows = -(-len(kinds) // 2)
    figure, panels = plt.subplots(max(rows, 1), 2, figsize=(12, 1.4 + 2.6 * max(rows, 1)), sharex=True, squeeze=False,
                                  constrained_layout=True)
    caption(figure, "Energies of the material", compared.caption())
    for panel, (index, name) in zip(panels.ravel(), kinds):
        entries = compared.draw(panel, lambda run, i=index: (run.state["time"], energies_of(run.state)[i][1]))
        zero_line(panel)
        panel.set_title(name[0].upper() + name[1:] + (" energy" if " " not in name else ""))
        panel.set_ylabel("energy [J]")
        panel.margins(x=0.01, y=0.1)
        name_lines(panel, entries)
    for spare in panels.ravel()[len(kinds):]:
        spare.set_visible(False)
    for column in range(2):
        shown = [panel for panel in panels[:, column] if panel.get_visible()]
        if shown:
            shown[-1].set_xlabel("simulated time [s]")
            shown[-1].tick_params(labelbottom=True)
    save(figure, folder, "compare_energies.png")


def compare_numbers(compared, folder):
    figure, (residual, step, volume) = plt.subplots(3, 1, figsize=(9.5, 8), sharex=True, constrained_layout=True)
    caption(figure, "Account of the momentum, time step, volume", compared.caption())
    entries = compared.draw(residual, lambda run: (run.state["time"], run.state["momentum error"]), log=True)
    limit = max(run.audit_limit for run in compared.runs)
    frame_residual(residual, max(run.state["momentum error"].max() for run in compared.runs), limit)
    name_lines(residual, [(max(value, 1e-18), name, color) for value, name, color in entries]
               + [(limit, "limit", RED)])
    entries = [(draw_steps(step, run.state, color), label, color)
               for run, label, color in zip(compared.runs, compared.labels, compared.colors)]
    step.set_ylim(0, 1.15e6 * max(run.state["dt"].max() for run in compared.runs))
    step.set_ylabel("time step [µs]")
    step.set_title("Length of a time step")
    name_lines(step, entries)
    entries = compared.draw(volume, lambda run: (run.state["time"], run.state["min j"]))
    volume.margins(y=0.1)
    volume.set_ylabel("det F [1]")
    volume.set_title("Smallest volume of a particle over its volume at the start (must stay above 0)")
    name_lines(volume, entries)
    steps_of_time((residual, step, volume))
    save(figure, folder, "compare_audit.png")
