#!/usr/bin/python3
"""Finds a sand's angle of friction and Young's modulus from the recorded force on a plate that was pressed into it.

    rosrun mpm_ros run_scene plate_load.yaml --bag measured.bag --set materials.sand.friction_angle="34 deg"
    rosrun mpm_ros calibrate.py measured.bag

First a sample of the ranges below is run, then SciPy's least_squares goes on from the best of it. Runs are made by the sweep
runner, those of a point and its neighbours at once. The result has its standard error, by the scatter of the force about the
curve that was found: that of the measurement and of what the model lacks.
"""
import argparse
import os
import sys
import tempfile

import mpm_ros
import numpy as np
from scipy.optimize import least_squares

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "plate_load.yaml")
BODY = "plate"
# Key of the scene, unit, range in which it is looked for.
PARAMETERS = [("materials.sand.friction_angle", "deg", 20.0, 45.0), ("materials.sand.young", "MPa", 0.3, 3.0)]
SAMPLE = 16
STEP = 0.02  # of a parameter, to each side, for the slopes: a smaller one meets the grains' scatter


def force_of(recording):
    """Time [s] and upward force [N]. For a bag from a machine: recording.table(topic), or plain rosbag."""
    table = recording.contact_forces(BODY)
    return table["time"], table["force"][:, 2]


class Fit:
    """Misfit of the force, and its slopes, over the logarithms of the parameters."""

    def __init__(self, measured, folder, jobs):
        self.time, self.force = measured
        self.scale = np.abs(self.force).max()
        self.folder, self.jobs, self.sweeps = folder, jobs, 0
        self._at, self._misfit, self._slopes = None, None, None

    def run(self, **plan):
        self.sweeps += 1
        plan.update(scene=SCENE, record=["bag"])
        sweep = mpm_ros.run_sweep(plan, os.path.join(self.folder, f"{self.sweeps:03}"), jobs=self.jobs)
        for run in sweep.runs:
            if run.state != "done":
                raise mpm_ros.MpmError(f"run {run.folder} {run.state}: {run.reason}")
        return sweep.runs

    def misfit_of(self, run):
        with run.recording() as recording:
            time, force = force_of(recording)
        return (np.interp(self.time, time, force) - self.force) / self.scale

    def sample(self):
        """The best of a sample of the ranges."""
        drawn = {path: {"log_uniform": {"from": f"{low} {unit}", "to": f"{high} {unit}"}}
                 for path, unit, low, high in PARAMETERS}
        runs = self.run(parameters=drawn, draws={"count": SAMPLE, "seed": 1})
        best = min(runs, key=lambda run: np.sum(self.misfit_of(run) ** 2))
        return np.log([float(best.parameters[path].split()[0]) for path, *_ in PARAMETERS])

    def _evaluate(self, x):
        if self._at is not None and np.array_equal(x, self._at):
            return
        points = [x] + [x + side * STEP * unit for unit in np.eye(len(x)) for side in (-1, 1)]
        runs = self.run(runs=[{path: f"{np.exp(value):.9g} {unit}" for (path, unit, *_), value in zip(PARAMETERS, point)}
                              for point in points])
        misfits = [self.misfit_of(run) for run in runs]
        self._at, self._misfit = np.array(x), misfits[0]
        self._slopes = np.stack([(misfits[2 * i + 2] - misfits[2 * i + 1]) / (2 * STEP) for i in range(len(x))], axis=1)
        values = ", ".join(f"{np.exp(value):.4g} {unit}" for (_, unit, *_), value in zip(PARAMETERS, x))
        print(f"  {values}: force off by {100 * np.sqrt(np.mean(self._misfit ** 2)):.3g} % of its largest", flush=True)

    def misfit(self, x):
        self._evaluate(x)
        return self._misfit

    def slopes(self, x):
        self._evaluate(x)
        return self._slopes


def calibrate(measured, folder, jobs=None, start=None):
    """`measured`: time [s] and force [N]; `start`: values to begin from, or None for the best of a sample. Returns values and
    standard errors. Values are in the units of PARAMETERS."""
    fit = Fit(measured, folder, jobs)
    low, high = np.log([[low, high] for *_, low, high in PARAMETERS]).T
    # Runs with the same force as far as doubles go would need no tolerance; a thousandth is far below 2 %.
    begin = fit.sample() if start is None else np.log(start)
    found = least_squares(fit.misfit, begin, fit.slopes, bounds=(low, high), xtol=1e-4, ftol=1e-4, x_scale="jac")
    scatter = 2 * found.cost / (len(found.fun) - len(found.x))
    errors = np.sqrt(np.diag(scatter * np.linalg.inv(found.jac.T @ found.jac)))
    values = np.exp(found.x)
    return values, values * errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", help="recording of the force")
    parser.add_argument("--out", help="folder for the runs; left out, they are removed at the end")
    parser.add_argument("--jobs", type=int, help="runs at once; left out, as many as the machine carries")
    parser.add_argument("--noise", type=float, default=0.0, metavar="PART",
                        help="add noise to the force, of this part of its largest, to see what becomes of the result")
    parser.add_argument("--start", type=float, nargs=len(PARAMETERS), metavar=tuple(unit for _, unit, *_ in PARAMETERS),
                        help="values to begin from; left out, the best of a sample")
    arguments = parser.parse_args()
    for value, (path, unit, low, high) in zip(arguments.start or (), PARAMETERS):
        if not low < value < high:
            parser.error(f"--start: {path} is {value:g} {unit}; write one between {low:g} and {high:g}")
    try:
        with mpm_ros.Recording(arguments.bag) as recording:
            time, force = force_of(recording)
        noise = arguments.noise * np.abs(force).max() * np.random.default_rng(1).standard_normal(len(force))
        with tempfile.TemporaryDirectory() as own:
            values, errors = calibrate((time, force + noise), arguments.out or own, arguments.jobs, arguments.start)
    except mpm_ros.MpmError as error:
        print(f"calibrate.py: {error}", file=sys.stderr)
        return 1
    for (path, unit, *_), value, error in zip(PARAMETERS, values, errors):
        print(f"{path} = {value:.5g} {unit}, standard error {error:.2g} {unit} ({100 * error / value:.2g} %)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
