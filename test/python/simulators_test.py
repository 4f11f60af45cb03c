#!/usr/bin/env python3
"""Many simulators stepped by one call, against single ones and when some of them fail. 20 s."""
import os
import signal
import tempfile
import unittest
from types import SimpleNamespace

import mpm_ros
import numpy as np
from mpm_ros.stacking import Stacked, row_of
from support import interrupted_after, processes_with, program, source_file

PRESS = source_file("test/data/press.yaml")  # sync periods of 2 ms; the plate hangs 5 mm above the strip
LEAVES = source_file("test/data/leaves_domain.yaml")  # a block at 2 m/s, outside the domain after 0.055 s
SYNC = 0.002  # [s]
YOUNG = "materials.0.young"


class Stacking(unittest.TestCase):
    def test_numbers_get_a_row_for_each(self):
        first, second = (SimpleNamespace(time=time, ended=time > 1, count=3 * time, name=f"number {time}",
                                         robots={"digger": SimpleNamespace(position=np.array([time, 0.5]))})
                         for time in (1, 2))
        stacked = Stacked([first, second])
        np.testing.assert_array_equal(stacked.time, [1, 2])
        np.testing.assert_array_equal(stacked.ended, [False, True])
        np.testing.assert_array_equal(stacked.robots["digger"].position, [[1, 0.5], [2, 0.5]])
        self.assertEqual(stacked.name, ["number 1", "number 2"])
        self.assertEqual(list(stacked.robots.keys()), ["digger"])
        self.assertIs(stacked[1], second)
        with self.assertRaises(AttributeError):
            stacked.velocity

    def test_rows_without_an_object_are_no_numbers(self):
        one = SimpleNamespace(time=1.0, ended=True, count=7, body=SimpleNamespace(force=np.array([1.0, 2.0])))
        for stacked, rows in [(Stacked([None, one]), [1]), (Stacked([None, None], like=one), [])]:
            missing = [row for row in (0, 1) if row not in rows]
            self.assertTrue(np.all(np.isnan(stacked.time[missing])))
            self.assertEqual(stacked.body.force.shape, (2, 2))
            self.assertTrue(np.all(np.isnan(stacked.body.force[missing])))
            self.assertEqual(stacked.ended.tolist(), [row in rows for row in (0, 1)])
            self.assertEqual(stacked.count.tolist(), [7 if row in rows else 0 for row in (0, 1)])
        with self.assertRaisesRegex(mpm_ros.MpmError, "no row has anything"):
            Stacked([None]).time

    def test_what_differs_in_shape_is_refused(self):
        stacked = Stacked([{"x": np.zeros(3)}, {"x": np.zeros(4)}])
        with self.assertRaisesRegex(mpm_ros.MpmError, r"'x' cannot be stacked: its shapes are \(3,\), \(4,\)"):
            stacked["x"]

    def test_arrays_have_rows_and_tuples_are_for_all(self):
        speeds = np.array([[0, 0, 1.0], [0, 0, 2.0], [0, 0, 3.0]])
        commands = {"plate": speeds, "rod": (1, 0, 0), "digger": {"boom": np.array([0.1, 0.2, 0.3]), "arm": 4}}
        found = row_of(commands, 1, 3, "velocity")
        np.testing.assert_array_equal(found["plate"], [0, 0, 2.0])
        self.assertEqual((found["rod"], found["digger"]), ((1, 0, 0), {"boom": 0.2, "arm": 4}))
        self.assertEqual(row_of([{"a": 1}, None, {"a": 3}], 2, 3, "values"), {"a": 3})
        self.assertIsNone(row_of([{"a": 1}, None, {"a": 3}], 1, 3, "values"))
        scene = {"materials": [{"name": "foam"}], "grid.max": [0.2, 0.12]}  # lists that are values of keys
        self.assertEqual(row_of(scene, 1, 3, "values"), scene)
        with self.assertRaisesRegex(mpm_ros.MpmError, "velocity of 'plate' has 3 rows; .* each of the 2 simulators"):
            row_of(commands, 1, 2, "velocity")


def numbers_of(obs):
    """All that an observation, or observations of several, say of the plate."""
    plate = obs["plate"]
    return [obs.time, obs.ended, *(getattr(plate, name) for name in (
        "position", "orientation", "velocity", "rotation_rate", "force", "torque", "peak_force", "peak_torque", "impulse"))]


class Together(unittest.TestCase):
    def expect_rows(self, together, alone):
        for row, obs in enumerate(alone):
            for found, expected in zip(numbers_of(together), numbers_of(obs)):
                np.testing.assert_array_equal(found[row], expected)

    def test_each_does_to_the_bit_what_it_does_alone(self):
        young = [4e5, 6e5, 8e5]
        speeds = np.array([[0, 0, -0.3], [0, 0, -0.4], [0.1, 0, -0.5]])

        def episode(sim, row):
            return [sim.step(0.01, velocity={"plate": speeds[row]}), *(sim.step(count=2) for _ in range(4))]

        expected, hashes = [], []
        for row in range(3):
            with mpm_ros.Simulator(PRESS, threads=1, state_hash=True, set={YOUNG: young[row]}) as sim:
                first = episode(sim, row)
                hashes.append(sim.solver_state().state_hash)
                sim.reset({YOUNG: 2 * young[row]})
                expected.append((first, episode(sim, row)))
        self.assertEqual(len(set(hashes)), 3)
        with mpm_ros.Simulators(PRESS, 3, state_hash=True, values={YOUNG: np.array(young)}) as sims:
            self.assertEqual(len({sim.master_uri for sim in sims}), 3)
            found = episode(sims, slice(None))
            for step in range(5):
                self.expect_rows(found[step], [expected[row][0][step] for row in range(3)])
            self.assertGreater(found[-1]["plate"].force[:, 2].min(), 0.0)
            self.assertEqual([sim.solver_state().state_hash for sim in sims], hashes)
            # A reset of the middle one leaves the others where they are.
            obs = sims.reset(1, {YOUNG: 2 * young[1]})
            np.testing.assert_array_equal(obs.time, [found[-1].time[0], 0.0, found[-1].time[2]])
            self.assertEqual([sims[row].solver_state().state_hash for row in (0, 2)], [hashes[0], hashes[2]])
            for step in range(5):
                moved = {"velocity": {"plate": speeds[[1]]}, "duration": 0.01} if step == 0 else {"count": 2}
                obs = sims.step(which=np.array([False, True, False]), **moved)
                self.expect_rows(obs, [found[-1][0], expected[1][1][step], found[-1][2]])
            self.assertEqual(sims[0].solver_state().state_hash, hashes[0])
            obs = sims.reset([2, 0], [{YOUNG: 2 * young[2]}, {YOUNG: 2 * young[0]}])
            obs = sims.step(0.01, which=[2, 0], velocity={"plate": speeds[[2, 0]]})
            self.expect_rows(obs, [expected[0][1][0], expected[1][1][-1], expected[2][1][0]])
            # What is the same for all; a reset without values keeps the last ones.
            sims.reset()
            obs = sims.step(0.01, velocity={"plate": (0, 0, -0.4)})
            np.testing.assert_allclose(obs["plate"].position, [[0.1, 0, 0.065 - 0.4 * 0.01]] * 3, atol=1e-12)

    def test_particles_and_parameters_of_each(self):
        with tempfile.TemporaryDirectory() as folder:
            with mpm_ros.Simulators(PRESS, 2, particle_period=SYNC, particle_fields=["speed"],
                                    record=os.path.join(folder, "run_{index}.bag")) as sims:
                obs = sims.step(count=3)
                np.testing.assert_allclose(obs.particles.time, [3 * SYNC] * 2)
                self.assertEqual((obs.particles["speed"].shape, obs.particles.positions.shape), ((2, 160), (2, 160, 3)))
            self.assertEqual(sorted(os.listdir(folder)), ["run_0.bag", "run_1.bag"])

    def test_an_interrupted_step_is_completed_by_all(self):
        # 8000 sync periods take some 2 s in each. Their interruption comes long before, and long after both have been asked,
        # on a busy machine too.
        with mpm_ros.Simulators(PRESS, 2, set={"time.end": 1000, "time.sync": SYNC}) as sims:
            sims.step()
            with interrupted_after(0.5):
                sims.step(count=8000)
            np.testing.assert_allclose(sims.step().time, [8002 * SYNC] * 2)


class Failing(unittest.TestCase):
    def test_failed_physics_of_one_leave_the_others(self):
        still = {"bodies.0.initial.velocity": [0, 0]}
        with mpm_ros.Simulators(LEAVES, 3, values=[still, None, still], set={"time.end": 1}) as sims:
            obs = sims.step(0.04)
            self.assertEqual(obs.failures, {})
            for _ in range(2):  # a step that follows says it again
                obs = sims.step(0.04)
                self.assertEqual((list(obs.failures), obs.failed.tolist()), ([1], [False, True, False]))
                self.assertIn("outside the domain", str(obs.failures[1]))
                self.assertTrue(np.isnan(obs.time[1]))
                with self.assertRaisesRegex(mpm_ros.MpmError, "outside the domain"):
                    obs[1]
            np.testing.assert_allclose(obs.time[[0, 2]], 0.12)
            obs = sims.reset(1, still)
            self.assertEqual(obs.failures, {})
            np.testing.assert_allclose(sims.step(0.08).time, [0.2, 0.08, 0.2])
            # All at the same time: there are rows still.
            sims.reset(values={"bodies.0.initial.velocity": [2, 0]})
            obs = sims.step(0.08)
            self.assertEqual((sorted(obs.failures), obs.time.shape), ([0, 1, 2], (3,)))

    def test_a_process_that_is_killed_begins_again_with_a_reset(self):
        namespace = f"/killed_{os.getpid()}_"
        higher = {"rigid_bodies.plate.pose.position": [0.1, 0.07]}
        with mpm_ros.Simulators(PRESS, 3, namespace=namespace + "{index}") as sims:
            sims.reset(values=higher)
            for process in processes_with(f"{program('simulator')} __ns:={namespace}2"):
                os.kill(process, signal.SIGKILL)
            obs = sims.step(0.01)
            self.assertEqual(list(obs.failures), [2])
            self.assertIn("killed by signal 9", str(obs.failures[2]))
            self.assertEqual(obs.failures[2].exit_code, 128 + 9)
            np.testing.assert_allclose(obs.time[:2], 0.01)
            self.assertEqual(list(sims.step(0.01).failures), [2])
            obs = sims.reset([2])
            self.assertEqual(obs.failures, {})
            np.testing.assert_allclose(obs.time, [0.02, 0.02, 0.0])
            self.assertEqual(obs["plate"].position[2, 2], 0.07)  # the values of its last reset
            np.testing.assert_allclose(sims.step(0.01).time, [0.03, 0.03, 0.01])
            self.assertEqual(len(sims[2].process_ids), 2)
        self.assertEqual(processes_with(namespace), [])

    def test_bad_input_is_refused_with_a_sentence(self):
        with mpm_ros.Simulators(PRESS, 2) as sims:
            with self.assertRaisesRegex(mpm_ros.MpmError, "no row has anything"):
                sims.step(which=[]).time
            sims.reset()
            for arguments, sentence in [({"velocity": {"plate": np.zeros((3, 3))}}, "'plate' has 3 rows"),
                                        ({"velocity": {"plate": np.zeros((2, 2))}}, "simulator 0: velocity of 'plate' has"),
                                        ({"duration": np.array([0.01, -1.0])}, "simulator 1: duration is -1"),
                                        ({"which": 2}, "which is 2; it must be an index from 0 to 1"),
                                        ({"which": [0, 0]}, r"which is \[0, 0\]"),
                                        ({"which": [0.5]}, r"which is \[0.5\]")]:
                with self.assertRaisesRegex(mpm_ros.MpmError, sentence):
                    sims.step(**arguments)
            np.testing.assert_array_equal(sims.step(which=[]).time, [0, 0])  # nothing was sent
            with self.assertRaisesRegex(mpm_ros.MpmError, "simulator 1 was not stepped: .*blade"):
                sims.step(0.01, velocity=[None, {"blade": (0, 0, 1)}])
            np.testing.assert_allclose(sims.step(0.01).time, [0.02, 0.01])
            with self.assertRaisesRegex(mpm_ros.MpmError, "simulator 0 was not reset: .*cel.*; nor were 1"):
                sims.reset(values={"grid.cel": 0.02})
            np.testing.assert_allclose(sims.step(0.01).time, [0.03, 0.02])  # as they were
            sims.step(1.0, which=0)
            with self.assertRaisesRegex(mpm_ros.MpmError, "simulator 0 was not stepped: .*call reset"):
                sims.step()
        with self.assertRaisesRegex(mpm_ros.MpmError, "these simulators are closed"):
            sims.step()
        sims.close()
        for n in (0, 2.5):
            with self.assertRaisesRegex(mpm_ros.MpmError, f"n is {n}; it must be a whole number"):
                mpm_ros.Simulators(PRESS, n)

    def test_they_end_where_nothing_refers_to_them(self):
        namespace = f"/dropped_{os.getpid()}_"
        sims = mpm_ros.Simulators(PRESS, 2, namespace=namespace + "{index}")
        obs = sims.step()
        del sims
        self.assertEqual(processes_with(namespace), [])
        np.testing.assert_allclose(obs.time, [SYNC] * 2)

    def test_none_is_left_where_one_does_not_start(self):
        namespace = f"/starting_{os.getpid()}_"
        with self.assertRaisesRegex(mpm_ros.MpmError, "simulator 1 was not started: .*cel") as raised:
            mpm_ros.Simulators(PRESS, 3, values=[{}, {"grid.cel": 0.01}, {}], namespace=namespace + "{index}")
        self.assertEqual(raised.exception.exit_code, 2)
        self.assertEqual(processes_with(namespace), [])


if __name__ == "__main__":
    unittest.main()
