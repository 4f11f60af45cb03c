"""The pace of the shipped soil scenes, and the force on their tools, for doc/performance.md: measure() runs them, part()
makes the table."""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

# A scene, its tool, and the axis of the force that tells most of it.
SCENES = [("blade_in_soil", "blade", 0), ("wheel_in_sand", "wheel", 2), ("rover_wheel_terrain", "wheel", 2)]
HALF = ["grid.min=[0, 0, 0]", "boundaries.y_min=symmetry"] + [
    f"bodies.{body}.shape.box.min={corner}" for body, corner in
    (("cut", "[0, 0, 0]"), ("bed", "[0.42, 0, 0]"), ("lower_step", "[0.42, 0, 0.105]"),
     ("upper_step", "[0.525, 0, 0.175]"))]
LONG = ["method.precision=single", "method.update=usavg", "time.cfl=0.9"]
FAST = ["method.precision=single", "method.update=usf", "time.cfl=0.9"]
# A row's name, its changes to the scene, and the factor of the force that it models.
WAYS = {
    "blade_in_soil": [("double, USAVG, cfl 0.5", ["method.precision=double", "method.update=usavg", "time.cfl=0.5"], 1),
                      ("single, USAVG, cfl 0.5", ["method.precision=single", "method.update=usavg", "time.cfl=0.5"], 1),
                      ("single, USAVG, cfl 0.9", LONG, 1),
                      ("single, USAVG, cfl 0.9, symmetric half", LONG + HALF, 2),
                      ("single, USF, cfl 0.9", FAST, 1),
                      ("single, USF, cfl 0.9, symmetric half", FAST + HALF, 2)],
    "wheel_in_sand": [("double, USAVG, cfl 0.4",
                       ["method.precision=double", "method.update=usavg", "time.cfl=0.4"], 1),
                      ("single, USF, cfl 0.9", FAST, 1)],
    "rover_wheel_terrain": [("single, USF, cfl 0.9; its first second",
                             ["time.end=1", "metrics.speed.rate={from: 0.5, to: 1}"], 1)],
}
SLEEP = {"off": ["sleep=off"], "on": ["sleep={from_start: true}"]}


def run(program, scene, changes, threads):
    with tempfile.TemporaryDirectory() as folder:
        summary = pathlib.Path(folder) / "summary.json"
        command = [str(program), scene, "--threads", str(threads), "--summary", str(summary),
                   "--csv", f"{folder}/tables"]
        for change in changes:
            command += ["--set", change]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"real_time: {' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
        return json.loads(summary.read_text())


def measure(program, quick):
    """Runs in turn, so that a disturbance of the machine affects all a little; medians of three."""
    rows = []
    for scene, body, axis in SCENES:
        for way, changes, factor in WAYS[scene]:
            for sleep in SLEEP:
                for threads in (1, 2):
                    # Nearly all of the terrain sleeps, and nothing in the wheel's short bed, which starts without stress.
                    if sleep == {"rover_wheel_terrain": "off", "wheel_in_sand": "on"}.get(scene):
                        continue
                    own = changes if scene == "rover_wheel_terrain" else changes + SLEEP[sleep]
                    rows.append({"scene": scene, "body": body, "axis": axis, "way": way, "changes": own,
                                 "factor": factor, "sleep": sleep, "threads": threads, "paces": []})
    for turn in range(1 if quick else 3):
        for number, row in enumerate(rows):
            print(f"\rreal time: round {turn + 1}, run {number + 1} of {len(rows)}   ", end="", file=sys.stderr)
            summary = run(program, row["scene"], row["changes"], row["threads"])
            row["paces"].append(summary["real_time_factor"])
            row["impulse"] = row["factor"] * summary["contact_impulse"][row["body"]][row["axis"]]
            row["particles"], row["bytes"] = summary["particles"], summary["peak_memory_bytes"]
    print(file=sys.stderr)
    return rows


def part(rows, table):
    first = {}
    lines = ["## Real time", "",
             "Whole runs of the shipped soil scenes, as a user gets them but without pictures: simulated time over wall "
             "time of stepping, median of three runs in turn. The force is the tool's impulse over the run (of a blade "
             "along x, of wheels what carries them); its difference is that from the first row of the scene. With sleep "
             "soil at rest sleeps from the start. What a scene's own cells are off by is in "
             "[methods.md](methods.md#all-problems) and in `config/force_errors.csv`.", ""]
    by_row = {}
    for row in rows:
        by_row.setdefault((row["scene"], row["way"], row["sleep"]), {})[row["threads"]] = row
    cells = []
    for (scene, way, sleep), runs in by_row.items():
        one, two = (statistics.median(runs[threads]["paces"]) for threads in (1, 2))
        reference = first.setdefault(scene, runs[1]["impulse"])
        off = 100 * (runs[1]["impulse"] / reference - 1)
        cells.append([scene, way, sleep, f"{runs[1]['particles']:,}", f"{one:.2f}", f"{two:.2f}", f"{two / one:.2f}",
                      f"{runs[1]['impulse']:.1f} N s", f"{off:+.1f} %", f"{runs[1]['bytes'] / 2**20:.0f} MB"])
    return lines + table(["scene", "method", "sleep", "particles", "one thread", "two threads", "scaling", "impulse",
                          "difference", "memory"], cells)
