#!/usr/bin/env python3
"""The pictures of bag_report (scripts/plot_*.py): tools in a slice, the field that is drawn, the line at the bottom."""
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../scripts"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import plot_particles  # noqa: E402
import plot_section  # noqa: E402
import plot_style  # noqa: E402


def box(low, high, outward=True):
    """Corners and triangles of a box; their normals point outwards, or inwards."""
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])], float)
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                      [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return corners, faces if outward else faces[:, ::-1]


def both(a, b):
    return np.vstack([a[0], b[0]]), np.vstack([a[1], b[1] + len(a[0])])


def in_slice(surface, point):
    """True if a part of the surface, cut at y = 0.5, is filled at a point (x, z)."""
    for vertices, faces in plot_section.solids(*surface):
        segments = [(a[[0, 2]], b[[0, 2]]) for a, b in plot_section.cut(vertices, faces, 1, 0.5)]
        path = plot_section.area(list(plot_section.loops(segments)))
        # As matplotlib fills: where the outlines around a point do not cancel.
        turns = sum(int(np.sign(signed(ring))) for ring in path.to_polygons() if inside(ring, point))
        if turns != 0:
            return True
    return False


def signed(ring):
    return np.sum(ring[:-1, 0] * ring[1:, 1] - ring[1:, 0] * ring[:-1, 1])


def inside(ring, point):
    return matplotlib.path.Path(ring).contains_point(point)


class Slices(unittest.TestCase):
    def test_boxes_that_overlap_leave_no_hole(self):
        surface = both(box((0, 0, 0), (1, 1, 1)), box((0.5, -0.1, 0.5), (2, 1.1, 2)))
        for point, filled in (((0.25, 0.25), True), ((0.75, 0.75), True), ((1.5, 1.5), True), ((1.5, 0.25), False)):
            self.assertEqual(in_slice(surface, point), filled, point)

    def test_a_hollow_stays_one(self):
        surface = both(box((0, 0, 0), (1, 1, 1)), box((0.2, 0.2, 0.2), (0.8, 0.8, 0.8), outward=False))
        self.assertTrue(in_slice(surface, (0.1, 0.5)))
        self.assertFalse(in_slice(surface, (0.5, 0.5)))


class Fields(unittest.TestCase):
    def drawn(self, fields, wanted=""):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "particles_0000.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write(",".join(["id [1]", "x [m]", "y [m]", "z [m]"] + fields) + "\n")
                file.write(",".join(["0"] * (4 + len(fields))) + "\n")
            run = type("Run", (), {"snapshots": [(0.0, path)]})
            return plot_particles.fields_of(run, wanted)

    def test_what_is_transported_comes_first_where_the_scene_names_it_first(self):
        self.assertEqual(self.drawn(["temperature", "ep", "mises", "speed"]), ["temperature", "speed"])
        self.assertEqual(self.drawn(["mises", "ep", "temperature"]), ["ep", "mises"])
        self.assertEqual(self.drawn(["vz"]), ["vz"])
        self.assertEqual(self.drawn(["temperature", "ep"], "ep"), ["ep"])


class Captions(unittest.TestCase):
    def test_short_parts_of_the_line_below_are_not_torn(self):
        figure = plt.figure(figsize=(3, 2))
        plot_style.caption(figure, "title", "a scene  ·  plane strain, ugimp, usavg  ·  mpm_ros 0.1.0  ·  run.bag")
        lines = figure._supxlabel.get_text().replace("\u00a0", " ").splitlines()
        plt.close(figure)
        self.assertGreater(len(lines), 1)
        for part in ("a scene", "plane strain, ugimp, usavg", "mpm_ros 0.1.0", "run.bag"):
            self.assertTrue(any(part in line for line in lines), lines)


if __name__ == "__main__":
    unittest.main()
