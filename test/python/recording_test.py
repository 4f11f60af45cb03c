#!/usr/bin/env python3
"""The reader of bags against the tables of bag_report, which is another program in another language."""
import csv
import os
import tempfile
import unittest

import genpy
import mpm_ros
import numpy as np
import rosbag
from mpm_ros.msg import RunInfo
from support import program, run, source_file

# The plate presses the strip by 5 mm and holds; the bag has forces every 2 ms.
CHANGES = ["--set", "rigid_bodies.plate.motion={velocity: [0, \"t < 0.05 ? -0.2 : 0\"]}"]


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.whole, cls.split = cls.path("whole.bag"), cls.path("split.bag")
        scene = source_file("test/data/press.yaml")
        run(program("run_scene"), scene, "--bag", cls.whole, *CHANGES)
        run(program("run_scene"), scene, "--bag", cls.split, "--bag-split", "0.05 s", "--bag-compression", "lz4",
            *CHANGES)
        run(program("bag_report"), cls.whole, "--csv", cls.path("csv"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def column(self, table, name):
        """A column of a table of bag_report."""
        with open(self.path(f"csv/{table}.csv"), encoding="utf-8", newline="") as file:
            return np.array([float(row[name]) for row in csv.DictReader(file)])

    def bag_of(self, name, topics):
        """A bag with a RunInfo on each of these topics."""
        with rosbag.Bag(self.path(name), "w") as bag:
            for topic in topics:
                bag.write(topic, RunInfo(scene="some"), genpy.Time(1))
        return self.path(name)

    def test_forces_and_motion_are_those_of_the_report(self):
        with mpm_ros.Recording(self.whole) as recording:
            self.assertEqual((recording.namespace, recording.bodies), ("/mpm", ["plate", "rod"]))
            table = recording.contact_forces("plate")
            self.assertEqual(len(table["time"]), 101)  # 0.2 s by 2 ms, and the start
            np.testing.assert_allclose(table["time"], self.column("contact_forces", "time [s]"), atol=1e-9)
            self.assertGreater(table["force"][:, 2].max(), 1.0)
            for place, axis in enumerate("xyz"):
                for name, short, unit in [("force", "f", "N"), ("torque", "t", "N m"), ("peak_force", "peak f", "N"),
                                          ("impulse", "impulse ", "N s")]:
                    expected = self.column("contact_forces", f"plate {short}{axis} [{unit}]")
                    np.testing.assert_allclose(table[name][:, place], expected, rtol=1e-6, atol=1e-9, err_msg=name)
            # 0.065 m, and 0.2 m/s for 0.05 s
            np.testing.assert_allclose(recording.motion("plate")["position"][-1], [0.1, 0, 0.055], atol=1e-12)

    def test_energies_are_those_of_the_report(self):
        with mpm_ros.Recording(self.whole) as recording:
            table = recording.solver_state()
            for name, column in [("time", "time [s]"), ("energy_kinetic", "energy kinetic [J]"),
                                 ("energy_elastic", "energy elastic [J]"), ("min_j", "min j [1]")]:
                np.testing.assert_allclose(table[name], self.column("solver_state", column), rtol=1e-6, atol=1e-9,
                                           err_msg=name)

    def test_a_split_recording_is_read_as_the_whole_one(self):
        with mpm_ros.Recording(self.whole) as whole, mpm_ros.Recording(self.split) as split:
            self.assertGreaterEqual(len(split.parts), 3)
            for table in (lambda r: r.contact_forces("rod"), lambda r: r.motion("plate")):
                expected, found = table(whole), table(split)
                self.assertEqual(list(found), list(expected))
                for name, values in expected.items():
                    np.testing.assert_array_equal(found[name], values, err_msg=name)
            snapshots = list(zip(whole.particles(), split.particles()))
            self.assertEqual([first.time for first, _ in snapshots], [i / 50 for i in range(11)])
            for first, second in snapshots:
                self.assertEqual(len(first), 160)
                np.testing.assert_array_equal(first.array, second.array)

    def test_a_table_becomes_a_data_frame(self):
        with mpm_ros.Recording(self.whole) as recording:
            table = recording.contact_forces("plate")
            frame = table.to_pandas()
            self.assertEqual(frame.index.name, "time")
            np.testing.assert_array_equal(frame["force_z"].to_numpy(), table["force"][:, 2])
            np.testing.assert_array_equal(frame["nodes"].to_numpy(), table["nodes"])
            self.assertIn("orientation_3", recording.motion("plate").to_pandas().columns)

    def test_a_run_in_the_root_namespace_is_found(self):
        with mpm_ros.Recording(self.bag_of("root.bag", ["/run_info"])) as recording:
            self.assertEqual((recording.namespace, recording.topics), ("", ["run_info"]))

    def test_what_cannot_be_read_is_refused_with_a_sentence(self):
        def expect(sentence, *arguments):
            with self.assertRaisesRegex(mpm_ros.MpmError, sentence):
                mpm_ros.Recording(*arguments)

        expect("nowhere.bag cannot be read", self.path("nowhere.bag"))
        expect("several runs; name one of the namespaces /a, /b",
               self.bag_of("two.bag", ["/a/run_info", "/b/run_info"]))
        with mpm_ros.Recording(self.path("two.bag"), "/b") as recording:
            self.assertEqual(recording.info.scene, "some")
        expect("no topic run_info", self.bag_of("none.bag", []))
        os.rename(self.bag_of("other.bag", ["/mpm/run_info"]), self.path("whole_part0002.bag"))
        expect("part of another recording", self.whole)
        os.remove(self.path("whole_part0002.bag"))
        with open(self.whole, "rb") as file, open(self.path("cut.bag"), "wb") as cut:
            head = bytearray(file.read(100000))
            at = head.index(b"index_pos=") + len(b"index_pos=")
            head[at:at + 8] = bytes(8)  # as a bag has it until it is closed
            cut.write(head)
        expect("rosbag reindex", self.path("cut.bag"))
        with open(self.split, "rb") as file:
            lz4 = bytearray(file.read())
        at = lz4.index(b"compression=lz4") + 100  # in the first chunk
        lz4[at:at + 100] = bytes(100)
        with open(self.path("damaged.bag"), "wb") as file:
            file.write(lz4)
        expect("damaged.bag is damaged", self.path("damaged.bag"))
        with mpm_ros.Recording(self.whole) as recording:
            with self.assertRaisesRegex(mpm_ros.MpmError, "there are plate, rod"):
                recording.contact_forces("blade")
            with self.assertRaisesRegex(mpm_ros.MpmError, "no topic nothing"):
                recording.messages("nothing")
        with self.assertRaisesRegex(mpm_ros.MpmError, "whole.bag is closed"):
            recording.solver_state()


if __name__ == "__main__":
    unittest.main()
