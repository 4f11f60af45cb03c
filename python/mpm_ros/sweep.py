"""Sweeps: many runs of one scene with other values, by `run_scene --sweep`. doc/sweeps.md describes plans and folders."""
import json
import os
import subprocess
import tempfile

from .errors import MpmError
from .process import find_program
from .recording import Recording

_SOME_FAILED = 3


class SweepRun:
    """A run of a sweep: `number`, `folder`, `state` (done, failed, stopped, open), `reason`, `parameters` (path: value
    as text), `metrics` (name: number, None without a value), `state_hash`, `wall_seconds`."""

    def __init__(self, number, folder):
        self.number, self.folder = number, folder
        self.state, self.reason, self.state_hash, self.wall_seconds = "open", "", "", 0.0
        self.parameters, self.metrics = {}, {}
        path = os.path.join(folder, "result.json")
        try:
            with open(path, encoding="utf-8") as file:
                result = json.load(file)
            for name in ("state", "reason", "state_hash", "wall_seconds", "parameters", "metrics"):
                setattr(self, name, result[name])
        except FileNotFoundError:
            pass
        except (OSError, ValueError, KeyError) as error:
            raise MpmError(f"{path} is no result of a run ({error}); remove it, and the run is made again") from error

    def recording(self):
        """The run's bag, where the plan says `record: [bag]`."""
        return Recording(os.path.join(self.folder, "run.bag"))


class Sweep:
    """The folder of a sweep: `runs`, a list of SweepRun in the order of their numbers."""

    def __init__(self, folder):
        self.folder = folder
        try:
            names = [name for name in os.listdir(os.path.join(folder, "runs")) if name.isdigit()]
        except OSError as error:
            raise MpmError(f"{folder} is not the folder of a sweep: {error}") from error
        self.runs = [SweepRun(int(name), os.path.join(folder, "runs", name)) for name in sorted(names, key=int)]


def run_sweep(plan, folder, jobs=None, threads=1, isa=None):
    """Runs a plan in a folder, which is made, and returns its Sweep when all runs are made, failed ones too. What has a
    result there is not run again.

    `plan`: path of a plan, or a plan as a dict, whose scene is a shipped name or a path from the working folder.
    `jobs`: runs at once; None: as many as the machine carries. MpmError: a bad plan, a full disk.
    """
    with tempfile.TemporaryDirectory() as own:
        if not isinstance(plan, (str, os.PathLike)):
            plan = dict(plan)
            if os.path.isfile(plan.get("scene", "")):
                plan["scene"] = os.path.abspath(plan["scene"])
            text, plan = json.dumps(plan), os.path.join(own, "plan.yaml")
            with open(plan, "w", encoding="utf-8") as file:
                file.write(text)
        command = [find_program("run_scene"), "--sweep", os.fspath(plan), "--out", os.fspath(folder), "--threads",
                   str(threads)]
        command += [] if jobs is None else ["--jobs", str(jobs)]
        command += [] if isa is None else ["--isa", isa]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, _SOME_FAILED):
        lines = [line for line in done.stderr.splitlines() if line.startswith("run_scene: ")]
        sentence = lines[-1][len("run_scene: "):] if lines else f"the sweep ended with {done.returncode}"
        raise MpmError(sentence, done.returncode)
    return Sweep(os.fspath(folder))
