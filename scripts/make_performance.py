#!/usr/bin/python3
"""make_performance.py RESULTS.json DOC: writes DOC/performance.md and DOC/images/performance/scenes.png from what
run_benchmarks.py found, between the hand-written parts benchmark/head.md and benchmark/tail.md."""

import json
import pathlib
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend comes first
from matplotlib.ticker import NullLocator  # noqa: E402
from plot_style import CYCLE, GREY, style  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Million particle-steps a second of the field's codes on one core: elastic, uGIMP, USF, double, 64,000 particles.
FIELD = {3: 0.8, 2: 1.8}
LIKE_FIELD = ("3D block, USF", "plane strain block, USF")  # the cases that may be compared with them
LARGE = 1_000_000  # particles, from which on the rest of a process hardly counts in its memory


def table(head, rows):
    rule = "|" + "---|" * len(head)
    return ["| " + " | ".join(head) + " |", rule] + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def million(rates):
    """The median, and how far the others are from it."""
    middle = statistics.median(rates)
    spread = max(max(rates) / middle - 1, 1 - min(rates) / middle)
    return f"{1e-6 * middle:.2f}" + (f" ± {100 * spread:.0f} %" if len(rates) > 1 else "")


def dimension(run):
    return 3 if run["summary"]["method"]["geometry"] == "solid" else 2


def pairs(runs):
    """Runs with one and with two threads, together."""
    found = {}
    for run in runs:
        method = run["summary"]["method"]
        found.setdefault((run["name"], method["precision"], method["isa"]), {})[run["threads"]] = run
    return found


def machine_part(results):
    machine = results["machine"]
    lines = ["## Machine", ""]
    lines += table(["", ""], [
        ["processor", f"{machine['processor']}, {machine['cores']} cores"], ["caches", machine["caches"]],
        ["memory", machine["memory"]], ["system", machine["system"]],
        ["compiler", f"{machine['compiler']}, {machine['build']}"], ["version", machine["version"]],
        ["date", machine["date"]], ["load before", f"{machine['load']:.2f}"],
    ])
    if results["quick"]:
        lines += ["**A quick run, once each: no figures to quote.**", ""]
    return lines + results["notes"] + [""] * bool(results["notes"])


def scenes_part(runs):
    rounds = len(runs[0]["rates"])
    lines = ["## Whole scenes", "",
             "Million particle-steps a second, all of a step: kernels, sorting, step control, contact, walls. "
             f"Median of {rounds} runs, taken in turns, and the farthest of them from it. The last columns: how many "
             "times one thread is what the field's codes reach where it is the same problem, two threads over one, and "
             "the process's memory where it is large.", "",
             "![Whole scenes](images/performance/scenes.png)", ""]
    rows = []
    like_field = [(name, "double") for name in LIKE_FIELD]
    for (name, precision, isa), run in pairs(runs).items():
        one, two = run[1], run[2]
        rate, both = statistics.median(one["rates"]), statistics.median(two["rates"])
        hashes = "" if one["summary"]["state_hash"] == two["summary"]["state_hash"] else " **other bits**"
        against = f"{1e-6 * rate / FIELD[dimension(one)]:.1f}" if (name, precision) in like_field else ""
        particles, memory = (one["summary"][key] for key in ("particles", "peak_memory_bytes"))
        rows.append([name, precision, isa, f"{particles:,}", million(one["rates"]),
                     million(two["rates"]), against, f"{both / rate:.2f}{hashes}",
                     f"{memory / particles:.0f} B" if particles >= LARGE else ""])
    lines += table(["scene", "precision", "instruction set", "particles", "one thread", "two threads", "of the field's",
                    "scaling", "a particle"], rows)
    medians = {key: statistics.median(run[1]["rates"]) for key, run in pairs(runs).items()}
    costs = []
    for (name, precision, isa), rate in medians.items():
        without = medians.get(("the same without the tool", precision, isa))
        if name == "3D block with a tool, USF" and without:
            costs.append(f"{100 * (1 - rate / without):.1f} % ({precision}, {isa})")
    if costs:
        lines += ["The tool costs " + ", ".join(costs) + " of one thread's rate.", ""]
    lines += ["| scene | command |", "|---|---|"]
    for run in runs:
        command = f"run_scene {run['scene']} --end {run['end']} " + " ".join(f"--set {c}" for c in run["changes"][:-1])
        row = f"| {run['name']} | `{command} --threads 1 --summary out.json` |"
        if row not in lines:
            lines.append(row)
    return lines + [""]


def draw_scenes(runs, path):
    style()
    figure, panels = plt.subplots(2, 1, figsize=(8.5, 6.5), layout="constrained", sharex=True,
                                  gridspec_kw={"height_ratios": [5, 2]})
    isas = list(dict.fromkeys(run["summary"]["method"]["isa"] for run in runs))
    for axes, dim in zip(panels, (3, 2)):
        chosen = {key: run for key, run in pairs(runs).items() if dimension(run[1]) == dim}
        labels = list(dict.fromkeys((name, precision) for name, precision, _ in chosen))
        for (name, precision, isa), run in chosen.items():
            place, colour = labels.index((name, precision)), CYCLE[isas.index(isa)]
            one, two = (1e-6 * statistics.median(run[t]["rates"]) for t in (1, 2))
            axes.plot([one, two], [place, place], color=colour, lw=1)
            axes.plot(one, place, "o", color=colour, ms=6)
            axes.plot(two, place, "o", color=colour, mfc="white", ms=6)
        axes.axvline(FIELD[dim], color=GREY, ls="--", lw=1)
        axes.text(FIELD[dim], -0.75, f" {FIELD[dim]}, the field's codes on one core (elastic, USF, double)",
                  color="#555555", fontsize=8, va="center")
        axes.set_yticks(range(len(labels)), [f"{name}, {precision}" for name, precision in labels])
        axes.set_ylim(len(labels) - 0.5, -1.2)
        axes.set_title("Three dimensions" if dim == 3 else "Plane strain")
        axes.set_xscale("log")
        axes.set_xticks([0.5, 1, 2, 5, 10, 20, 50, 100, 200])
        axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.xaxis.set_minor_locator(NullLocator())
    for isa in isas:
        panels[0].plot([], [], "o", color=CYCLE[isas.index(isa)], label=isa)
    panels[0].plot([], [], "o", color=GREY, label="one thread")
    panels[0].plot([], [], "o", color=GREY, mfc="white", label="two threads")
    panels[1].legend(*panels[0].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, -0.32), ncol=5)
    panels[1].set_xlabel("million particle-steps a second")
    rates = [1e-6 * statistics.median(run["rates"]) for run in runs]
    panels[0].set_xlim(min(0.4, 0.8 * min(rates)), max(10.0, 1.3 * max(rates)))
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def roofline_part(roofline):
    lines = ["## What the machine can do, and a step's share", "",
             "Measured by `roofline` in one run: the best of five tries of independent multiply-adds in registers, and "
             "of the triad a = b + s c (24 bytes a number) in arrays that fit the first cache, the second, and none.",
             ""]
    columns = ("double", "single", "triad_l1", "triad_l2", "triad_memory")
    lines += table(
        ["instruction set", "threads", "double, G multiply-adds/s", "single", "triad L1, GB/s", "L2", "memory"],
        [[row["isa"], str(row["threads"])] + [f"{1e-9 * row[key]:.1f}" for key in columns]
         for row in roofline["machine"]])
    lines += ["Counted work (`benchmark/roofline/counted_work.hpp` derives it) and its share of these limits, of the "
              "widest instruction set, in double precision:", ""]
    lines += table(["scene", "update", "threads", "million particle-steps/s", "multiply-adds a particle",
                    "of the multiply-adds", "bytes a particle", "of memory's bandwidth"],
                   [[row["scene"], row["update"], str(row["threads"]), f"{1e-6 * row['particle_steps_per_second']:.2f}",
                     f"{row['multiply_adds']:.0f}", f"{100 * row['of_arithmetic']:.0f} %", f"{row['bytes']:.0f}",
                     f"{100 * row['of_bandwidth']:.0f} %"] for row in roofline["steps"]])
    lines += ["By kernel:", ""]
    rows = []
    for step in roofline["steps"]:
        if step["threads"] == 1:
            rows += [[f"{step['scene']}, {step['update']}", kernel["kernel"], f"{kernel['multiply_adds']:.0f}",
                      f"{kernel['bytes']:.0f}"] for kernel in step["kernels"]]
    return lines + table(["step", "kernel", "multiply-adds a particle", "bytes a particle"], rows)


def kernels_part(benchmarks):
    lines = ["## Kernels by themselves", "", "Nanoseconds a particle (of a whole step: a particle-step); median.", ""]
    medians = [row for row in benchmarks if row.get("aggregate_name") == "median"] or benchmarks
    rows = []
    for row in medians:
        name = row["run_name"].replace("/real_time", "").replace("/iterations:4", "")
        rows.append([f"`{name}`", f"{1e9 / row['items_per_second']:.1f}"])
    return lines + table(["benchmark", "ns"], sorted(rows))


def short(function):
    """A C++ function without its arguments."""
    name = function.replace("(anonymous namespace)::", "").replace("|", "")
    return (name.split("(")[0] or name)[:110]


def instructions_part(counts):
    lines = ["## Instructions", "",
             "Instructions a particle-step on one thread, counted by callgrind, which knows no AVX-512: a longer run "
             "less a shorter one, of a small version of the scene. Step control, once in a sync period, weighs more "
             "here than in a long period.", ""]
    for count in counts:
        lines += [f"{count['name']}, {count['particles']:,} particles, {count['isa']}: **{count['total']:.0f}**", ""]
        costs = {}
        for function, cost in count["functions"]:
            costs[short(function)] = costs.get(short(function), 0) + cost
        shown = sorted(((f, c) for f, c in costs.items() if c >= 0.01 * count["total"]), key=lambda pair: -pair[1])
        lines += table(["function", "instructions", "part"],
                       [[f"`{function}`", f"{cost:.0f}", f"{100 * cost / count['total']:.0f} %"]
                        for function, cost in shown])
    return lines


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: make_performance.py RESULTS.json DOC")
    results, doc = json.loads(pathlib.Path(sys.argv[1]).read_text()), pathlib.Path(sys.argv[2])
    pictures = doc / "images" / "performance"
    pictures.mkdir(parents=True, exist_ok=True)
    draw_scenes(results["scenes"], pictures / "scenes.png")
    lines = [(ROOT / "benchmark" / "head.md").read_text().rstrip(), ""]
    lines += machine_part(results) + scenes_part(results["scenes"]) + roofline_part(results["roofline"])
    lines += kernels_part(results["kernels"]) + instructions_part(results["instructions"])
    lines += [(ROOT / "benchmark" / "tail.md").read_text().rstrip(), ""]
    (doc / "performance.md").write_text("\n".join(lines).rstrip() + "\n")
    print(doc / "performance.md")


if __name__ == "__main__":
    main()
