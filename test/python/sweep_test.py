#!/usr/bin/env python3
"""Sweeps of many small runs: killed and started again, shared by several processes, on a full disk, reported, from
Python. 15 s."""
import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import unittest

import mpm_ros
from support import eventually, processes_with, program, source_file

# 160 particles and some 60 steps, in half of which the plate presses them: a run takes some 15 ms.
PLAN = """
scene: {scene}
set:
  time.end: 0.02
  rigid_bodies.plate.motion: {{velocity: [0, -0.5]}}
  metrics: {{stress: {{mean: szz, of: strip}}}}
draws: {{count: 50, seed: 1}}
parameters:
  materials.foam.young: {{grid: {{from: 0.1 MPa, to: 0.4 MPa, count: 4}}}}
  materials.foam.poisson: {{uniform: {{from: 0.1, to: 0.4}}}}
"""
RUNS = 200


class Sweeps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.study = self.path("study")
        self.plan = self.write("plan.yaml", PLAN.format(scene=source_file("test/data/press.yaml")))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def command(self, *words):
        return [program("run_scene"), "--sweep", *words]

    def sweep(self, *words, code=0, **options):
        done = subprocess.run(self.command(*words), capture_output=True, text=True, check=False, timeout=120, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def results(self):
        """Of every run that has one: what tells whether it was written again."""
        found = {}
        for run in os.listdir(os.path.join(self.study, "runs")):
            path = os.path.join(self.study, "runs", run, "result.json")
            if os.path.exists(path):
                with open(path, encoding="utf-8") as file:
                    found[run] = (os.stat(path).st_ino, os.stat(path).st_mtime_ns, json.load(file)["state_hash"])
        return found

    def table(self):
        with open(os.path.join(self.study, "sweep.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def begun(self, count, *words):
        """A sweep that has made `count` runs."""
        process = subprocess.Popen(self.command(*words), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        runs = os.path.join(self.study, "runs")
        self.assertTrue(eventually(lambda: os.path.isdir(runs) and len(self.results()) >= count))
        return process

    def test_a_sweep_that_is_killed_goes_on_and_makes_no_run_twice(self):
        process = self.begun(RUNS // 4, self.plan, "--out", self.study)
        process.kill()
        process.wait()
        # Its runs end with it, and none is half written.
        self.assertTrue(eventually(lambda: not processes_with(self.study + "/runs")))
        killed = self.results()
        self.assertLess(len(killed), RUNS)

        process = self.begun(RUNS // 2, self.study)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(20), 1)
        self.assertEqual(processes_with(self.study + "/runs"), [])
        interrupted = self.results()
        self.assertLess(len(interrupted), RUNS)
        self.assertEqual(len(self.table()), RUNS)
        self.assertEqual(sum(row["state"] == "done" for row in self.table()), len(interrupted))

        self.assertIn(f"{RUNS} runs: {RUNS} done;", self.sweep(self.plan, "--out", self.study))
        results = self.results()
        self.assertEqual(len(results), RUNS)
        for run, before in {**killed, **interrupted}.items():
            self.assertEqual(results[run], before)  # the same file: it was not made again
        rows = self.table()
        self.assertEqual([row["run"] for row in rows], [str(run) for run in range(1, RUNS + 1)])
        self.assertEqual({row["state"] for row in rows}, {"done"})
        # Each has its own parameters, and they act.
        self.assertEqual(len({(row["materials.foam.young [MPa]"], row["materials.foam.poisson"]) for row in rows}), RUNS)
        self.assertEqual(len({row["stress"] for row in rows}), RUNS)
        self.assertTrue(all(float(row["stress"]) < -100.0 for row in rows))  # [Pa], pressed

        # Once more: nothing is left to do, and nothing is written.
        self.sweep(self.study)
        self.assertEqual(self.results(), results)
        # And a run of it alone is the one of its scene.
        summary = self.path("alone.json")
        subprocess.run([program("run_scene"), os.path.join(self.study, "runs/0117/scene.yaml"), "--summary", summary],
                       check=True, capture_output=True)
        with open(summary, encoding="utf-8") as file:
            self.assertEqual(json.load(file)["state_hash"], results["0117"][2])

    def test_processes_share_a_study_and_single_runs_are_made_in_any_order(self):
        self.sweep(self.plan, "--out", self.study, "--jobs", "0")
        self.assertEqual(self.results(), {})
        # As GNU parallel and Slurm do.
        self.assertIn("run 17 done", self.sweep(self.study, "--only", "17"))
        first = self.results()
        self.assertEqual(list(first), ["0017"])
        self.assertIn("run 17 done", self.sweep(self.plan, "--out", self.study, "--only", "17"))
        self.assertEqual(self.results(), first)
        sweeps = [subprocess.Popen(self.command(self.study, "--jobs", "1"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL) for _ in range(3)]
        for process in sweeps:
            process.wait(60)
        self.assertEqual(len(self.results()), RUNS)
        self.assertEqual(self.results()["0017"], first["0017"])
        # Each run's log begins once, with its command, and has one summary.
        for run in os.listdir(os.path.join(self.study, "runs")):
            with open(os.path.join(self.study, "runs", run, "log.txt"), encoding="utf-8") as file:
                log = file.read()
            self.assertEqual((log.count("$ "), log.count("state hash")), (1, 1), log)
        self.assertIn("no study", self.sweep(self.plan, "--out", self.path("other"), "--only", "1", code=2))
        self.assertIn("has 200 runs", self.sweep(self.study, "--only", "201", code=2))

    def test_a_run_that_fails_is_recorded_with_its_reason_and_the_others_go_on(self):
        # Thrown upwards, the second block leaves the grid without walls after 0.08 m at 8 m/s.
        plan = self.write("throw.yaml", f"""
scene: {source_file("test/data/press.yaml")}
set: {{time.end: 0.02, rigid_bodies: [], contact: {{}}, boundaries: {{}}}}
parameters: {{bodies.strip.initial.velocity: {{values: [[0, 0], [0, 8], [0, 0.1]]}}}}
""")
        out = self.sweep(plan, "--out", self.study, code=3)
        self.assertIn("3 runs: 2 done, 1 failed;", out)
        rows = self.table()
        self.assertEqual([row["state"] for row in rows], ["done", "failed", "done"])
        self.assertIn("outside the domain", rows[1]["reason"])
        self.assertEqual(rows[1]["bodies.strip.initial.velocity"], "[0, 8]")
        failed = self.results()["0002"]
        self.assertIn("1 failed", self.sweep(self.study, code=3))
        self.assertEqual(self.results()["0002"], failed)  # it would fail again
        self.assertIn("run 2 failed: ", self.sweep(self.study, "--only", "2", code=3))
        # Without its result it is made again.
        os.remove(os.path.join(self.study, "runs/0002/result.json"))
        self.sweep(self.study, code=3)
        self.assertNotEqual(self.results()["0002"][:2], failed[:2])

    def test_a_run_that_crashes_or_is_killed_takes_no_other_with_it(self):
        # Runs of more than a second, so that they can be met.
        plan = self.write("long.yaml", f"""
scene: {source_file("test/data/press.yaml")}
set: {{time.end: 30}}
parameters: {{materials.foam.poisson: {{values: [0.1, 0.2, 0.3, 0.4]}}}}
""")
        process = subprocess.Popen(self.command(plan, "--out", self.study, "--jobs", "4"), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        for run, number in [("0001", signal.SIGSEGV), ("0002", signal.SIGTERM), ("0003", signal.SIGKILL)]:
            scene = os.path.join(self.study, "runs", run, "scene.yaml")
            self.assertTrue(eventually(lambda path=scene: processes_with(path)))
            os.kill(processes_with(scene)[0], number)
        self.assertEqual(process.wait(60), 1)
        rows = self.table()
        self.assertEqual([row["state"] for row in rows], ["failed", "stopped", "stopped", "done"])
        self.assertIn("crashed by signal 11", rows[0]["reason"])
        self.assertRegex(rows[1]["reason"], "was stopped at t = |ended by signal 15")  # as soon as it catches signals
        self.assertIn("ended by signal 9", rows[2]["reason"])
        # What was stopped is made, what crashed is not.
        self.assertIn("4 runs: 3 done, 1 failed;", self.sweep(self.study, code=3))

    def test_what_is_wrong_is_found_before_the_first_run(self):
        def refused(change, *sentence):
            with open(self.plan, encoding="utf-8") as file:
                text = change(file.read())
            out = self.sweep(self.write("bad.yaml", text), "--out", self.study, code=2)
            for part in sentence:
                self.assertIn(part, out)
            self.assertEqual(out.count("\n"), 1, out)
            self.assertFalse(os.path.exists(self.study))

        refused(lambda text: text.replace("foam.young", "foam.yuong"), "bad.yaml:9: run 1", "did you mean 'young'?")
        refused(lambda text: text.replace("to: 0.4}", "to: 0.7}"), "materials.foam.poisson: ", "bad.yaml:10: run ")
        refused(lambda text: text + "  grid.cell: {values: [0.01, -1]}\n", "bad.yaml:11: run 2, grid.cell = -1: ")
        refused(lambda text: text.replace("time.end: 0.02", "output.particle_fields: [none]\n  time.end: 1"),
                "bad.yaml:4: run 1, output.particle_fields = [none]: ", "no particle field 'none'")
        self.assertIn("--set: not with --sweep", self.sweep(self.plan, "--set", "grid.cell=1", code=2))

    def test_a_study_stays_that_of_its_plan(self):
        small = "scene: {}\nset: {{time.end: 0.01}}\nparameters: {{materials.foam.young: {{values: [{}]}}}}\n"
        scene = source_file("test/data/press.yaml")
        plan = self.write("small.yaml", small.format(scene, "0.1 MPa, 0.2 MPa"))
        self.sweep(plan, "--out", self.study)
        first = self.results()
        self.write("small.yaml", small.format(scene, "0.1 MPa, 0.3 MPa"))
        self.assertIn("another scene", self.sweep(plan, "--out", self.study, code=2))
        self.write("small.yaml", small.format(scene, "0.1 MPa"))
        self.assertIn("has 2 runs, the plan 1", self.sweep(plan, "--out", self.study, code=2))
        # More of them are an addition.
        self.write("small.yaml", small.format(scene, "0.1 MPa, 0.2 MPa, 0.3 MPa"))
        self.sweep(plan, "--out", self.study)
        self.assertEqual(len(self.results()), 3)
        self.assertEqual({run: self.results()[run] for run in first}, first)
        # A folder that holds something else is left as it is, even if that is a plan.
        self.write("plan.yaml", "mine")
        self.assertIn("no study", self.sweep(plan, "--out", self.folder, code=2))
        with open(self.path("plan.yaml"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")

    def test_a_full_disk_ends_a_sweep_in_a_sentence_and_it_goes_on_when_there_is_room(self):
        # A bag takes some 20 kB for each 10 ms of simulated time beside 300 kB at its start: the fourth is too large.
        plan = self.write("long.yaml", f"""
scene: {source_file("test/data/press.yaml")}
set: {{output.period: 2 ms}}
parameters: {{time.end: {{values: [0.01, 0.02, 0.03, 0.5, 0.04]}}}}
record: [bag]
""")

        def small_disk():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))

        out = self.sweep(plan, "--out", self.study, "--jobs", "1", code=1, preexec_fn=small_disk)
        self.assertIn("run_scene: run 4: ", out)
        self.assertIn("3 of 5 runs have a result, which stays; the same command goes on", out)
        before = self.results()
        self.assertEqual(sorted(before), ["0001", "0002", "0003"])
        self.assertIn("5 runs: 5 done;", self.sweep(plan, "--out", self.study, "--jobs", "1"))
        self.assertEqual({run: self.results()[run] for run in before}, before)

    def test_bag_report_reads_a_sweep(self):
        self.write("few.yaml", """
scene: press.yaml
set: {time.end: 0.02, rigid_bodies.plate.motion: {velocity: [0, -0.5]}, metrics: {stress: {mean: szz}}}
parameters:
  materials.foam.young: {values: [0.1 MPa, 0.4 MPa, 0.2 MPa]}
  method.update: {values: [usf, usl]}
""")
        shutil.copy(source_file("test/data/press.yaml"), self.folder)
        self.sweep(self.path("few.yaml"), "--out", self.study)

        def report(*words, code=0):
            done = subprocess.run([program("bag_report"), self.study, *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            return done.stdout + done.stderr

        out = report("--csv", self.path("tables"), "--plots", self.path("plots"), "--check")
        self.assertIn("6 runs, 6 done", out)
        with open(self.path("tables/sweep.csv"), encoding="utf-8") as file, \
                open(os.path.join(self.study, "sweep.csv"), encoding="utf-8") as kept:
            self.assertEqual(file.read(), kept.read())
        with open(self.path("plots/sweep.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        found = json.loads(report("--json", "-"))
        self.assertEqual([row["run"] for row in found["table"]], [1, 2, 3, 4, 5, 6])
        self.assertEqual(found["table"][2]["materials.foam.young [MPa]"], 0.4)
        self.assertEqual(found["table"][3]["method.update"], "usl")
        stresses = [row["stress"] for row in found["table"]]
        stress = found["metrics"]["stress"]
        self.assertEqual((stress["min"], stress["max"]), (min(stresses), max(stresses)))
        self.assertAlmostEqual(stress["mean"] / (sum(stresses) / 6), 1, 12)
        # Stiffer foam carries more: compression is negative, and updates change it by less than the modulus does. Six
        # values, in pairs of equal modulus, are in order: their ranks' correlation is sqrt(32 / 35).
        self.assertAlmostEqual(stress["correlation"]["materials.foam.young [MPa]"], -(32 / 35) ** 0.5, 12)
        self.assertIsNone(stress["correlation"]["method.update"])
        self.assertIn("is a sweep", report("--animate", self.path("a.gif"), code=2))
        os.remove(os.path.join(self.study, "runs/0003/result.json"))
        self.assertIn("5 done, 1 open", report("--check", code=3))

    def test_python_runs_a_plan_and_reads_its_runs(self):
        plan = {"scene": source_file("test/data/press.yaml"), "record": ["bag"],
                "set": {"time.end": 0.02, "rigid_bodies.plate.motion": {"velocity": [0, -0.5]},
                        "metrics": {"stress": {"mean": "szz"}}},
                "parameters": {"materials.foam.young": {"values": ["0.1 MPa", "0.4 MPa"]}}}
        sweep = mpm_ros.run_sweep(plan, self.study, jobs=2)
        self.assertEqual([(run.number, run.state, run.parameters) for run in sweep.runs],
                         [(1, "done", {"materials.foam.young": "0.1 MPa"}), (2, "done", {"materials.foam.young": "0.4 MPa"})])
        self.assertLess(sweep.runs[1].metrics["stress"], sweep.runs[0].metrics["stress"])
        with sweep.runs[1].recording() as recording:
            self.assertGreater(recording.contact_forces("plate")["force"][-1, 2], 0.0)
        self.assertEqual([run.state_hash for run in mpm_ros.Sweep(self.study).runs],
                         [run.state_hash for run in sweep.runs])
        plan["parameters"] = {"materials.foam.poisson": {"values": [0.6]}}
        with self.assertRaisesRegex(mpm_ros.MpmError, "poisson: '0.6' is not below 0.5") as raised:
            mpm_ros.run_sweep(plan, self.path("other"))
        self.assertEqual(raised.exception.exit_code, 2)
        with self.assertRaisesRegex(mpm_ros.MpmError, "not the folder of a sweep"):
            mpm_ros.Sweep(self.path("none"))


LIMIT = 700_000  # [bytes] of any file on the small disk

if __name__ == "__main__":
    unittest.main()
