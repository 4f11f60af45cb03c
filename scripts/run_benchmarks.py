#!/usr/bin/python3
"""run_benchmarks.py BUILD RESULTS.json [--quick] [--full]: runs the whole scenes, the kernel benchmarks, the roofline
and the count of instructions with the programs below BUILD, and writes the results for make_performance.py."""

import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))
import real_time  # noqa: E402: its folder comes first

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The runs: a name for the table, the scene, the changes to it, and its end [s]; whether to run it for each instruction
# set and precision. A case's steps are some 150 (of a million particles some 80), enough to fly across two cells.
CASES = [
    ("3D block, USF", "speed_block_3d", ["method.update=usf"], "0.02", True),
    ("3D block, USF, irregular", "speed_block_3d_irregular", ["method.update=usf"], "0.02", True),
    ("3D block, USF, 1,000,000 particles", "speed_block_3d_million", ["method.update=usf", "time.sync=0.01"], "0.01",
     False),
    ("3D block, USAVG", "speed_block_3d", ["method.update=usavg"], "0.02", False),
    ("3D soil, USAVG", "speed_soil_3d", ["method.update=usavg"], "0.04", False),
    ("3D block with a tool, USF", "speed_tool_3d", ["method.update=usf"], "0.02", False),
    ("the same without the tool", "speed_tool_3d", ["method.update=usf", "rigid_bodies=[]"], "0.02", False),
    ("plane strain block, USF", "speed_block_2d", ["method.update=usf"], "0.02", False),
    ("plane strain block, USAVG", "speed_block_2d", ["method.update=usavg"], "0.02", False),
]
# The block of speed_block_3d_million in other sizes: its upper corner [m], 8,000,000 particles a cubic metre.
SIZES = {50_000: "[0.2, 0.25, 0.125]", 500_000: "[0.5, 0.5, 0.25]", 1_000_000: "[0.5, 0.5, 0.5]"}
FULL_SIZES = {10_000_000: "[1.0, 1.25, 1.0]"}
ENVIRONMENT = dict(os.environ, OMP_WAIT_POLICY="passive")


def output_of(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, env=ENVIRONMENT, check=False)
    if done.returncode != 0:
        raise SystemExit(f"run_benchmarks: {' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def works(*command):
    command = [str(part) for part in command]
    return subprocess.run(command, capture_output=True, env=ENVIRONMENT, check=False).returncode == 0


def describe_machine(build):
    cpu = json.loads(output_of("lscpu", "-J"))
    fields = {}

    def gather(entries):
        for entry in entries:
            fields.setdefault(entry["field"].rstrip(":"), entry["data"])
            gather(entry.get("children", []))

    gather(cpu["lscpu"])
    cache = (build / "CMakeCache.txt").read_text()
    compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.+)$", cache, re.M).group(1)
    memory = int(re.search(r"MemTotal:\s+(\d+)", pathlib.Path("/proc/meminfo").read_text()).group(1))
    changed = output_of("git", "-C", ROOT, "status", "--porcelain", "--untracked-files=no").strip()
    return {
        "processor": "{} (family {}, model {})".format(*(fields.get(f) for f in ("Model name", "CPU family", "Model"))),
        "cores": os.cpu_count(),
        "caches": ", ".join(f"{name.split()[0]} {fields[name]}" for name in ("L1d cache", "L2 cache", "L3 cache")
                            if name in fields),
        "memory": f"{memory / 2**20:.0f} GiB",
        "system": f"{platform.freedesktop_os_release()['PRETTY_NAME']}, Linux {platform.release()}",
        "compiler": output_of(compiler, "--version").splitlines()[0],
        "build": re.search(r"^CMAKE_BUILD_TYPE:\w+=(.*)$", cache, re.M).group(1),
        "version": output_of("git", "-C", ROOT, "describe", "--always").strip() + (" and changes" if changed else ""),
        "date": datetime.date.today().isoformat(),
        "load": os.getloadavg()[0],
    }


class Scenes:
    """Runs of scenes; the constructor finds out what this machine and build support."""

    def __init__(self, programs):
        self.run_scene = programs / "run_scene"
        self.program = programs / "whole_scene"
        self.isas = [isa for isa in ("avx512", "avx2", "plain")
                     if works(self.run_scene, "speed_block_2d", "--isa", isa, "--explain")]
        self.precisions = ["double", "single"]

    def run(self, scene, changes, end, threads, isa, prefix=()):
        command = [*prefix, self.program, scene, "--threads", threads, "--isa", isa, "--set", f"time.end={end}"]
        for change in changes:
            command += ["--set", change]
        return json.loads(output_of(*command))


def measure_scenes(scenes, quick):
    runs = []
    for name, scene, changes, end, all_kinds in CASES:
        if quick and scene.endswith("_million"):
            continue
        kinds = [(isa, precision) for isa in (scenes.isas[:1] if quick else scenes.isas)
                 for precision in scenes.precisions]
        for isa, precision in kinds if all_kinds else kinds[:2]:
            for threads in (1, 2):
                runs.append({"name": name, "scene": scene, "changes": changes + [f"method.precision={precision}"],
                             "end": end, "threads": threads, "isa": isa, "rates": [], "processor_rates": []})
    # Interleaved, so that a disturbance of the machine affects all runs a little.
    rounds = 1 if quick else 5
    for turn in range(rounds):
        for number, run in enumerate(runs):
            if turn >= 3 and (run["isa"] == "plain" or run["scene"].endswith("_million")):
                continue  # they take long
            print(f"\rscenes: round {turn + 1} of {rounds}, run {number + 1} of {len(runs)} ", end="", file=sys.stderr)
            summary = scenes.run(run["scene"], run["changes"], run["end"], run["threads"], run["isa"])
            work = summary["particles"] * summary["steps"]
            run["rates"].append(work / summary["wall_seconds"])
            run["processor_rates"].append(work / summary["processor_seconds"])
            run["summary"] = {key: summary[key] for key in ("particles", "steps", "method", "peak_memory_bytes",
                                                            "state_hash")}
    print(file=sys.stderr)
    return runs


def measure_sizes(scenes, quick, full):
    """Processor time of a particle-step on one thread, by the number of particles; medians of three, interleaved."""
    sizes = dict(list(SIZES.items())[:1]) if quick else {**SIZES, **(FULL_SIZES if full else {})}
    found = {count: {"particles": count, "ns": [], "load_seconds": []} for count in sizes}
    for _ in range(1 if quick else 3):
        for count, corner in sizes.items():
            print(f"\rsizes: {count:,} particles   ", end="", file=sys.stderr)
            changes = ["method.update=usf", f"bodies.block.shape.box.max={corner}", "time.sync=0.005",
                       "grid.max=[1.2, 1.5, 1.2]"]
            summary = scenes.run("speed_block_3d_million", changes, "0.005", 1, scenes.isas[0])
            if summary["particles"] != count:
                raise SystemExit(f"run_benchmarks: {summary['particles']} particles in place of {count}")
            work = summary["particles"] * summary["steps"]
            found[count]["ns"].append(1e9 * summary["processor_seconds"] / work)
            found[count]["load_seconds"].append(summary["load_seconds"])
            found[count]["bytes"] = summary["peak_memory_bytes"] / count
    print(file=sys.stderr)
    return list(found.values())


def measure_output(scenes, quick):
    """Cost of the report of a run (audit, energies), of tables and of bags: processor seconds, medians of some runs."""
    period, end = 0.001, 0.005 if quick else 0.02
    reports = [scenes.run("speed_block_3d", [f"time.sync={sync}"], max(end, sync), 1, scenes.isas[0])
               for sync in (period, 0.005, 0.02) for _ in range(1 if quick else 3)]
    found = {"reports": [{"steps_between": one["steps"] / one["reports"],
                          "part": one["report_processor_seconds"] / one["processor_seconds"]} for one in reports]}
    with tempfile.TemporaryDirectory() as folder:
        kinds = {"nothing": [], "csv": ["--csv", f"{folder}/tables"], "bag": ["--bag", f"{folder}/run.bag"]}
        seconds = {kind: [] for kind in kinds}
        for _ in range(1 if quick else 3):
            for kind, more in kinds.items():
                before = os.times()
                summary = pathlib.Path(folder) / "summary.json"
                output_of(scenes.run_scene, "speed_block_3d", "--end", end, "--threads", 1, "--set",
                          f"time.sync={period}", "--set", f"output.period={period}", "--summary", summary, *more)
                after = os.times()
                seconds[kind].append(after.children_user + after.children_system - before.children_user -
                                     before.children_system)
                for made in pathlib.Path(folder).glob("run*.bag"):
                    made.unlink()
    found["output"] = {"period": period, "end": end, "seconds": seconds}
    return found


def function_costs(path):
    """Instructions by function of a callgrind output file, without those of the functions called."""
    names, costs, current, skip = {}, {}, None, False
    for line in path.read_text().splitlines():
        if line.startswith("fn="):
            key, _, name = line[3:].partition(" ")
            if name:
                names[key] = name
            current = names[key]
        elif line.startswith("cfn="):
            key, _, name = line[4:].partition(" ")
            if name:
                names[key] = name
        elif line.startswith("calls="):
            skip = True  # the next line is the cost of the called function
        elif line[:1] in set("0123456789+-*"):
            if not skip and current is not None:
                costs[current] = costs.get(current, 0) + int(line.split()[-1])
            skip = False
    return costs


def count_instructions(scenes, quick):
    """Instructions a particle-step: the difference of two runs of 8,000 particles that differ only in length.
    valgrind knows no AVX-512, so the kernels are those that such a processor would get, or AVX2."""
    isa = "avx2" if "avx2" in scenes.isas else "plain"
    found = []
    for name, scene, update in (("3D block, USF", "speed_block_3d", "usf"),
                                ("3D block, USAVG", "speed_block_3d", "usavg"),
                                ("plane strain block, USF", "speed_block_2d", "usf")):
        period = 0.002 if quick else 0.005
        changes = ["grid.cell=0.02", f"time.sync={period}", f"method.update={update}"]
        totals = []
        for end in (period, 2 * period):
            print(f"\rinstructions: {name}, {end} s   ", end="", file=sys.stderr)
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "callgrind"
                summary = scenes.run(scene, changes, end, 1, isa,
                                     ("valgrind", "--tool=callgrind", f"--callgrind-out-file={file}"))
                totals.append((summary["steps"] * summary["particles"], function_costs(file), summary))
        more = totals[1][0] - totals[0][0]
        costs = {function: (cost - totals[0][1].get(function, 0)) / more for function, cost in totals[1][1].items()}
        found.append({"name": name, "particles": totals[1][2]["particles"], "isa": totals[1][2]["method"]["isa"],
                      "total": sum(costs.values()),
                      "functions": sorted(((f, c) for f, c in costs.items() if c >= 1.0), key=lambda pair: -pair[1])})
    print(file=sys.stderr)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--full", action="store_true", help="10,000,000 particles as well")
    options = parser.parse_args()
    programs = options.build / "devel" / "lib" / "mpm_ros"
    results = {"machine": describe_machine(options.build), "quick": options.quick}
    if results["machine"]["load"] > 0.5:
        print(f"warning: the machine is busy (load {results['machine']['load']:.1f}); figures will be too low",
              file=sys.stderr)
    scenes = Scenes(programs)
    results["real_time"] = real_time.measure(scenes.run_scene, options.quick)
    results["scenes"] = measure_scenes(scenes, options.quick)
    results["sizes"] = measure_sizes(scenes, options.quick, options.full)
    results["output"] = measure_output(scenes, options.quick)
    print("roofline", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "roofline.json"
        output_of(programs / "roofline", "--json", file, "--seconds", 0.05 if options.quick else 0.2)
        results["roofline"] = json.loads(file.read_text())
    print("kernels", file=sys.stderr)
    kernels = output_of(programs / "kernels", "--benchmark_format=json",
                        f"--benchmark_min_time={0.01 if options.quick else 0.05}",
                        f"--benchmark_repetitions={1 if options.quick else 3}")
    results["kernels"] = json.loads(kernels)["benchmarks"]
    results["instructions"] = count_instructions(scenes, options.quick)
    options.results.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
