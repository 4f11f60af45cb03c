"""Pictures of a robot's joints over time: position, velocity and effort of each."""
import matplotlib.pyplot as plt

from plot_series import steps_of_time
from plot_style import BLACK, CYCLE, caption, name_lines, save, zero_line
from plot_tables import file_stem

KINDS = {"m": "positions of sliding joints", "rad": "positions of turning joints", "m/s": "velocities of sliding joints",
         "rad/s": "velocities of turning joints", "N": "efforts of sliding joints", "N m": "efforts of turning joints"}
QUANTITIES = ("position", "velocity", "effort")


def robots_of(table):
    """Names of joints by robot, in the order of the table's columns."""
    robots = {}
    for name in table.names():
        joint, _, quantity = name.rpartition(" ")
        robot, _, joint = joint.partition("/")
        if quantity == "position" and joint:
            robots.setdefault(robot, []).append(joint)
    return robots


def panels_of(table, robot, joints):
    """(unit, quantity, joints) of each panel: joints that slide and those that turn have one of their own."""
    panels = []
    for quantity in QUANTITIES:
        units = [table.units[f"{robot}/{joint} {quantity}"] for joint in joints]
        for unit in dict.fromkeys(units):
            panels.append((unit, quantity, [joint for joint, own in zip(joints, units) if own == unit]))
    return panels


def plot_robots(run, folder):
    """Draws a picture of each robot; targets are dotted over what follows them. None without joints.csv."""
    if run.joints is None:
        return
    for robot, joints in robots_of(run.joints).items():
        plot_robot(run, robot, joints, folder)


def plot_robot(run, robot, joints, folder):
    table, time = run.joints, run.joints["time"]
    colors = {joint: CYCLE[i % len(CYCLE)] for i, joint in enumerate(joints)}
    panels = panels_of(table, robot, joints)
    figure, rows = plt.subplots(len(panels), 1, figsize=(9.5, 1.2 + 2.4 * len(panels)), sharex=True, squeeze=False,
                                constrained_layout=True)
    caption(figure, f"{run.title}: joints of {robot}", run.caption())
    for axes, (unit, quantity, shown) in zip(rows[:, 0], panels):
        means = quantity == "effort"
        entries, targets = [], False
        for joint in shown:
            values = table[f"{robot}/{joint} {quantity}"]
            axes.plot(time, values, color=colors[joint], drawstyle="steps-pre" if means else "default")
            if table.units[f"{robot}/{joint} target"] == unit and not means:
                targets = True  # of a step, so that the first row has none
                axes.plot(time[1:], table[f"{robot}/{joint} target"][1:], color=BLACK, linestyle=(0, (2, 4)), linewidth=1.2)
            entries.append((values[-1], joint, colors[joint]))
        axes.set_ylabel(f"{quantity} [{unit}]")
        title = KINDS[unit][0].upper() + KINDS[unit][1:]
        axes.set_title(title + (": means of the drives over each interval" if means else "; dotted: targets" * targets))
        zero_line(axes)
        axes.margins(y=0.08)
        name_lines(axes, entries)
    steps_of_time(rows[:, 0])
    save(figure, folder, f"joints_{file_stem(robot)}.png")
