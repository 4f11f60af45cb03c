#!/usr/bin/python3
"""make_performance.py RESULTS.json DOC: writes DOC/performance.md and DOC/images/performance/scenes.png from the
results of run_benchmarks.py, after the hand-written introduction benchmark/head.md."""

import json
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402: the backend comes first
from matplotlib.ticker import NullLocator  # noqa: E402
import real_time  # noqa: E402
from plot_style import CYCLE, GREY, style  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Million particle-steps a second of other MPM codes on one core: elastic, uGIMP, USF, double, 64,000 particles.
FIELD = {3: 0.8, 2: 1.8}
LIKE_FIELD = ("3D block, USF", "plane strain block, USF")  # the cases that may be compared with FIELD
# Multiply-adds a second of one core of the machine on which the targets were set, from the speed of a prototype.
REFERENCE_PEAK = {"avx512": 68e9, "avx2": 34e9}
# Targets on that kind of machine: million particle-steps a second on one core and on two.
TARGETS = [
    ("3D block, USF", "double", "avx512", 15, 28),
    ("3D block, USF, 1,000,000 particles", "double", "avx512", 15, 28),
    ("3D block, USF, irregular", "double", "avx512", 13, 24),
    ("3D block, USF", "single", "avx512", 25, 46),
    ("3D block, USAVG", "double", "avx512", 10, 19),
    ("3D block, USF", "double", "avx2", 10, 19),
    ("3D soil, USAVG", "double", "avx512", 8, 15),
    ("plane strain block, USF", "double", "avx512", 30, 56),
]
LARGE = 1_000_000  # number of particles above which the rest of a process hardly counts in its memory


def table(head, rows):
    rule = "|" + "---|" * len(head)
    return ["| " + " | ".join(head) + " |", rule] + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def million(rates):
    """The median in millions, and the largest deviation of the others from it."""
    middle = statistics.median(rates)
    spread = max(max(rates) / middle - 1, 1 - min(rates) / middle)
    return f"{1e-6 * middle:.2f}" + (f" ± {100 * spread:.0f} %" if len(rates) > 1 else "")


def dimension(run):
    return 3 if run["summary"]["method"]["geometry"] == "solid" else 2


def pairs(runs):
    """Runs by (name, precision, instruction set), each with its runs by number of threads."""
    found = {}
    for run in runs:
        method = run["summary"]["method"]
        found.setdefault((run["name"], method["precision"], method["isa"]), {})[run["threads"]] = run
    return found


def rate_of(run):
    """Particle-steps a second; with one thread by its processor time, which other processes disturb less."""
    return statistics.median(run["processor_rates" if run["threads"] == 1 else "rates"])


def limits(roofline, isa, threads):
    """The row of this instruction set and number of threads, or None."""
    return next((row for row in roofline["machine"] if row["isa"] == isa and row["threads"] == threads), None)


def counted_step(roofline, method):
    """Multiply-adds of a particle-step of an elastic block."""
    counted = roofline["counted"][method["geometry"]]
    return sum(counted["kernels"][name]["multiply_adds"] for name in counted["steps"][method["update"]])


def arithmetic_share(roofline, run):
    """Part of the multiply-adds that this instruction set can do, in per cent; empty where the law is not counted."""
    method = run["summary"]["method"]
    limit = limits(roofline, method["isa"], run["threads"])
    if limit is None or "soil" in run["name"]:
        return ""
    return f"{100 * rate_of(run) * counted_step(roofline, method) / limit[method['precision']]:.0f} %"


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
    return lines


def scenes_part(runs, roofline):
    lines = ["## Whole scenes", "",
             "Million particle-steps a second for whole steps: kernels, sorting, step control, contact, walls. "
             f"Each figure is the median of {len(runs[0]['rates'])} runs "
             f"({min(len(run['rates']) for run in runs)} with a million particles and with the plain kernels), "
             "taken in turns, with the largest deviation of a run from it. One thread is timed by its processor time "
             "and by the wall clock, two threads by the wall clock. The share is that of the counted multiply-adds "
             "(next chapter) in the measured limit of this instruction set, precision and number of threads; "
             "contact and the law of soil are not counted. The next columns are the rate of one thread over that of "
             "other MPM codes, where the problem is the same; two threads over one by the wall clock; and the "
             "process's memory where it is large.", "",
             "![Whole scenes](images/performance/scenes.png)", ""]
    rows = []
    like_field = [(name, "double") for name in LIKE_FIELD]
    for (name, precision, isa), run in pairs(runs).items():
        one, two = run[1], run[2]
        scaling = statistics.median(two["rates"]) / statistics.median(one["rates"])
        hashes = "" if one["summary"]["state_hash"] == two["summary"]["state_hash"] else " **other bits**"
        against = f"{1e-6 * rate_of(one) / FIELD[dimension(one)]:.1f}" if (name, precision) in like_field else ""
        particles, memory = (one["summary"][key] for key in ("particles", "peak_memory_bytes"))
        rows.append([name, precision, isa, f"{particles:,}", million(one["processor_rates"]), million(one["rates"]),
                     million(two["rates"]), arithmetic_share(roofline, one), arithmetic_share(roofline, two), against,
                     f"{scaling:.2f}{hashes}", f"{memory / particles:.0f} B" if particles >= LARGE else ""])
    lines += table(["scene", "precision", "instruction set", "particles", "one thread", "by the wall clock",
                    "two threads", "share of one", "of two", "over other codes", "scaling", "memory a particle"], rows)
    medians = {key: rate_of(run[1]) for key, run in pairs(runs).items()}
    costs = []
    for (name, precision, isa), rate in medians.items():
        without = medians.get(("the same without the tool", precision, isa))
        if name == "3D block with a tool, USF" and without:
            costs.append(f"{100 * (1 - rate / without):.1f} % ({precision}, {isa})")
    if costs:
        lines += ["The tool costs " + ", ".join(costs) + " of one thread's rate.", ""]
    lines += ["| scene | command |", "|---|---|"]
    for run in runs:
        changes = [f"time.end={run['end']}"] + run["changes"][:-1]
        command = f"whole_scene {run['scene']} " + " ".join(f"--set {change}" for change in changes)
        row = f"| {run['name']} | `{command} --threads 1` |"
        if row not in lines:
            lines.append(row)
    return lines + [""]


def targets_part(runs, roofline):
    lines = ["### Targets and what was reached", "",
             "Million particle-steps a second on one core and on two. The targets were set on a machine of which one "
             f"core does {1e-9 * REFERENCE_PEAK['avx512']:.0f} G multiply-adds a second with AVX-512 and "
             f"{1e-9 * REFERENCE_PEAK['avx2']:.0f} with AVX2, in double precision. A core of this machine, measured in "
             "the same run as the scenes, does "
             + " and ".join(f"{1e-9 * row['double']:.1f} with {row['isa']}" for row in roofline["machine"]
                            if row["threads"] == 1 and row["isa"] in REFERENCE_PEAK)
             + ". The last two columns therefore give shares of one core's limit: that of the target on its machine, "
             "and the reached one on this machine.", ""]
    rows, found = [], pairs(runs)
    for name, precision, isa, one, two in TARGETS:
        run = found.get((name, precision, isa))
        if run is None:
            continue
        method = run[1]["summary"]["method"]
        wide = 2 if precision == "single" else 1  # twice as many numbers in a register
        asked = 1e6 * one * counted_step(roofline, method) / (wide * REFERENCE_PEAK[isa])
        counted = "soil" not in name
        rows.append([name, precision, isa, f"{one} / {two}",
                     f"{1e-6 * rate_of(run[1]):.1f} / {1e-6 * rate_of(run[2]):.1f}",
                     f"{rate_of(run[1]) / (1e6 * one):.2f} / {rate_of(run[2]) / (1e6 * two):.2f}",
                     f"{100 * asked:.0f} %" if counted else "", arithmetic_share(roofline, run[1])])
    return lines + table(["scene", "precision", "instruction set", "target", "reached", "reached over target",
                          "target's share of its machine's limit", "reached share of this machine's"], rows)


def sizes_part(sizes):
    lines = ["### By the number of particles", "",
             "The block of speed_block_3d_million in other sizes, USF, double, one thread, the widest instruction set. "
             f"Columns: processor time of a particle-step, median of {len(sizes[0]['ns'])}; the process's memory, "
             "which with few particles is mostly the program; and the time to load the scene.", ""]
    first = statistics.median(sizes[0]["ns"])
    rows = []
    for size in sizes:
        ns = statistics.median(size["ns"])
        rows.append([f"{size['particles']:,}", f"{ns:.1f}", f"{100 * (ns / first - 1):+.0f} %", f"{size['bytes']:.0f}",
                     f"{statistics.median(size['load_seconds']):.2f}"])
    return lines + table(["particles", "ns a particle-step", "against the first", "bytes a particle", "load, s"], rows)


def output_part(found):
    lines = ["### Output and audit", "",
             "The report of a run (momentum audit, energies, smallest J) is made at those sync points where output "
             "needs it. Its share of the processor time of stepping, one thread, 64,000 particles:", ""]
    by_steps = {}
    for one in found["reports"]:
        by_steps.setdefault(round(one["steps_between"]), []).append(one["part"])
    lines += table(["steps between two reports", "share of the report"],
                   [[str(steps), f"{100 * statistics.median(parts):.2f} %"] for steps, parts in by_steps.items()])
    output = found["output"]
    median = {kind: statistics.median(seconds) for kind, seconds in output["seconds"].items()}
    lines += [f"Output of everything each {1e3 * output['period']:g} ms, for {1e3 * float(output['end']):g} ms: "
              "processor seconds of the whole process, loading included.", ""]
    return lines + table(["output", "s", "more than without"],
                         [[kind, f"{value:.2f}", f"{100 * (value / median['nothing'] - 1):+.0f} %"]
                          for kind, value in median.items()])


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
            one, two = (1e-6 * rate_of(run[t]) for t in (1, 2))
            axes.plot([one, two], [place, place], color=colour, lw=1)
            axes.plot(one, place, "o", color=colour, ms=6)
            axes.plot(two, place, "o", color=colour, mfc="white", ms=6)
        axes.axvline(FIELD[dim], color=GREY, ls="--", lw=1)
        axes.text(FIELD[dim], -0.75, f" {FIELD[dim]}, other MPM codes on one core (elastic, USF, double)",
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
    rates = [1e-6 * rate_of(run) for run in runs]
    panels[0].set_xlim(min(0.4, 0.8 * min(rates)), max(10.0, 1.3 * max(rates)))
    figure.savefig(path, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)


def roofline_part(roofline):
    lines = ["## Limits of the machine, and a step's share", "",
             "`roofline` measures these in one run: the best of five tries of independent multiply-adds in registers, "
             "and of the triad a = b + s c (24 bytes a number) in arrays that fit the first cache, the second, and "
             "neither. One thread is timed by its processor time, two by the wall clock, as for the scenes.",
             ""]
    columns = ("double", "single", "triad_l1", "triad_l2", "triad_memory")
    lines += table(
        ["instruction set", "threads", "double, G multiply-adds/s", "single", "triad L1, GB/s", "L2", "memory"],
        [[row["isa"], str(row["threads"])] + [f"{1e-9 * row[key]:.1f}" for key in columns]
         for row in roofline["machine"]])
    lines += ["Counted work (derived in `benchmark/roofline/counted_work.hpp`) and its share of these limits, for the "
              "widest instruction set, in double precision:", ""]
    lines += table(["scene", "update", "threads", "million particle-steps/s", "multiply-adds a particle",
                    "of the multiply-adds", "bytes a particle", "of memory's bandwidth"],
                   [[row["scene"], row["update"], str(row["threads"]), f"{1e-6 * row['particle_steps_per_second']:.2f}",
                     f"{row['multiply_adds']:.0f}", f"{100 * row['of_arithmetic']:.0f} %", f"{row['bytes']:.0f}",
                     f"{100 * row['of_bandwidth']:.0f} %"] for row in roofline["steps"]])
    return lines


def medians_of(benchmarks):
    """Nanoseconds for each item, by name."""
    rows = [row for row in benchmarks if row.get("aggregate_name") == "median"] or benchmarks
    return {row["run_name"]: 1e9 / row["items_per_second"] for row in rows if "items_per_second" in row}


def profile_part(benchmarks, roofline):
    """The table of single kernels, and their sum over a step."""
    times = medians_of(benchmarks)
    lines = ["## Profile of a step by stage", "",
             "Each kernel by itself on one thread, 64,000 particles, processor time. Columns: nanoseconds a particle "
             "on a lattice and on irregular positions; the multiply-adds and bytes counted for the kernel; and, on the "
             "lattice, its share of the measured limit of the same instruction set and precision. The sum is a step "
             "without sorting, step control and the clearing of nodes. USAVG uses `move_and_regather` instead of "
             "`move`, and `nodal_velocity` and `strain` once more.", ""]
    places = {}
    for name in times:
        if name.startswith("kernel/"):
            _, kernel, geometry, precision, isa, _ = name.split("/")
            places.setdefault((geometry, isa, precision), {})[kernel] = None
    for (geometry, isa, precision), kernels in places.items():
        counted, limit = roofline["counted"][geometry], limits(roofline, isa, 1)

        def row(label, names):
            ns = [sum(times[f"kernel/{name}/{geometry}/{precision}/{isa}/{at}"] for name in names)
                  for at in ("lattice", "irregular")]
            adds = sum(counted["kernels"][name]["multiply_adds"] for name in names)
            size = sum(counted["kernels"][name]["bytes"][precision] for name in names)
            return [label, f"{ns[0]:.1f}", f"{ns[1]:.1f}", f"{adds:.0f}", f"{size:.0f}",
                    f"{100 * adds / (1e-9 * ns[0]) / limit[precision]:.0f} %",
                    f"{100 * size / (1e-9 * ns[0]) / limit['triad_memory']:.0f} %"]

        rows = [row(f"`{kernel}`", [kernel]) for kernel in kernels]
        rows += [row(f"**{update.upper()} step**", counted["steps"][update]) for update in ("usf", "usavg")]
        lines += [f"### {geometry.replace('_', ' ')}, {precision}, {isa}", ""]
        lines += table(["kernel", "ns, lattice", "ns, irregular", "multiply-adds", "bytes", "of the multiply-adds",
                        "of memory's bandwidth"], rows)
    return lines


def laws_part(benchmarks):
    """The table of the pass that computes strain and stress, by law."""
    times = {tuple(name.split("/")[1:]): ns for name, ns in medians_of(benchmarks).items()
             if name.startswith("strain_with_law/")}
    columns = list(dict.fromkeys((isa, precision) for _, _, precision, isa in times))
    lines = ["### Strain and stress, by law", "",
             "The kernel `strain` without force with each law, nanoseconds a particle on the lattice, one thread; soil "
             "and metal yield everywhere. It includes the velocity gradient, which is common to all laws.", ""]
    rows = [[f"`{law}`"] + [f"{times[law, 'solid', precision, isa]:.1f}" for isa, precision in columns]
            for law in dict.fromkeys(key[0] for key in times)]
    return lines + table(["law"] + [f"{isa}, {precision}" for isa, precision in columns], rows)


def others_part(benchmarks):
    lines = ["### Sorting, and steps of small scenes", "",
             "Nanoseconds a particle (for steps: a particle-step), by the wall clock; median.", ""]
    rows = [[f"`{name.replace('/real_time', '').replace('/iterations:4', '')}`", f"{ns:.1f}"]
            for name, ns in medians_of(benchmarks).items() if not name.startswith(("kernel/", "strain_with_law/"))]
    return lines + table(["benchmark", "ns"], sorted(rows))


def short(function):
    """A C++ function without its arguments."""
    name = function.replace("(anonymous namespace)::", "").replace("|", "")
    return (name.split("(")[0] or name)[:110]


def instructions_part(counts):
    lines = ["## Instructions", "",
             "Instructions a particle-step on one thread, counted by callgrind, which does not support AVX-512: the "
             "difference of a longer and a shorter run of a small version of the scene. Step control, once in a sync "
             "period, weighs more in these short periods than in long ones.", ""]
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
    roofline, kernels = results["roofline"], results["kernels"]
    lines += machine_part(results) + real_time.part(results["real_time"], table)
    lines += scenes_part(results["scenes"], roofline)
    lines += targets_part(results["scenes"], roofline) + sizes_part(results["sizes"]) + output_part(results["output"])
    lines += roofline_part(roofline) + profile_part(kernels, roofline) + laws_part(kernels) + others_part(kernels)
    lines += instructions_part(results["instructions"])
    (doc / "performance.md").write_text("\n".join(lines).rstrip() + "\n")
    print(doc / "performance.md")


if __name__ == "__main__":
    main()
