#!/usr/bin/env python3
"""The pictures of cracks (scripts/plot_cracks.py) from small tables whose values are known."""
import math
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
import plot_cracks  # noqa: E402
import plot_tables  # noqa: E402

POINTS = "time [s],crack,point,x [m],z [m],above x [m],above z [m],below x [m],below z [m]\n"
TIPS = "time [s],crack,end,x [m],z [m],j [J/m^2],k_one [Pa m^0.5],k_two [Pa m^0.5],grown [m],state\n"
FOUND = "the contour is complete"


class Run:
    title = "fixture"

    def caption(self):
        return "three points"


class CrackPictures(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)
        self.folder = self.holder.name

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def write_crack(self, grows=True, state=FOUND):
        """A straight crack from (0, 1) to (3, 1), open by 0.2 at its mouth; at 2 s it has kinked by (4, 3)."""
        at = "{},cut,{},{},{},{},{},{},{}\n"
        points = at.format(0, 0, 0, 1, 0, 1.1, 0, 0.9) + at.format(0, 1, 3, 1, 3, 1, 3, 1)
        points += at.format(2, 0, 0, 1, 0, 1.1, 0, 0.9) + at.format(2, 1, 3, 1, 3, 1, 3, 1)
        tips = "0,cut,end,3,1,0,0,0,0,not looked at yet\n"
        if grows:
            points += at.format(2, 2, 7, 4, 7, 4, 7, 4)
            tips += f"2,cut,end,7,4,60,2e5,-1e4,5,{state}\n"
        else:
            tips += f"2,cut,end,3,1,60,2e5,-1e4,0,{state}\n"
        self.write("crack_points.csv", POINTS + points)
        self.write("crack_tips.csv", TIPS + tips)

    def pictures(self):
        cracks = plot_cracks.Cracks(self.folder)
        plot_cracks.plot_cracks(Run(), cracks, self.folder)
        return sorted(file for file in os.listdir(self.folder) if file.endswith(".png"))

    def test_a_run_without_cracks_has_no_picture_of_them(self):
        self.assertFalse(plot_cracks.Cracks(self.folder))
        self.assertEqual(self.pictures(), [])

    def test_chains_and_tips_are_read(self):
        self.write_crack()
        cracks = plot_cracks.Cracks(self.folder)
        self.assertEqual([time for time, _ in cracks.chains["cut"]], [0, 2])
        # 3 m straight on, then 4 m to the right and 3 m up, which are 5 m.
        self.assertAlmostEqual(cracks.chains["cut"][0][1].length(), 3, places=12)
        self.assertAlmostEqual(cracks.chains["cut"][1][1].length(), 8, places=12)
        tip = cracks.tips["cut", "end"]
        self.assertTrue(math.isnan(tip.j[0]))  # not looked at: no J, in place of one of 0
        self.assertEqual(tip.j[1], 60)
        self.assertEqual(tip.k_one[1], 2e5)
        self.assertEqual(tip.k_two[1], -1e4)

    def test_the_path_is_drawn_of_what_grew_only(self):
        self.write_crack(grows=False)
        self.assertEqual(self.pictures(), ["cracks.png"])
        self.write_crack(grows=True)
        self.assertEqual(self.pictures(), ["crack_path_cut.png", "cracks.png"])

    def test_a_crack_whose_tip_never_had_a_j_is_drawn_all_the_same(self):
        self.write_crack(state="the contour leaves the bodies")
        self.assertEqual(self.pictures(), ["crack_path_cut.png", "cracks.png"])

    def test_the_chain_of_the_time_is_drawn_over_the_particles(self):
        self.write_crack()
        cracks = plot_cracks.Cracks(self.folder)
        for time, points, place in ((0.9, 2, (3, 1)), (1.1, 3, (7, 4))):  # nearest to 0 s, and to 2 s
            figure, panel = plt.subplots()
            cracks.draw(panel, time)
            above, below, tip = panel.lines
            self.assertEqual([len(above.get_xdata()), len(below.get_xdata())], [points, points])
            self.assertEqual([above.get_ydata()[0], below.get_ydata()[0]], [1.1, 0.9])
            self.assertEqual((tip.get_xdata()[0], tip.get_ydata()[0]), place)
            plt.close(figure)

    def test_a_table_of_another_layout_is_refused(self):
        self.write_crack()
        self.write("crack_tips.csv", "time [s],crack,end,state\n0,cut,end,none\n")
        with self.assertRaisesRegex(plot_tables.TableError, "crack_tips.csv: no numbers of"):
            plot_cracks.Cracks(self.folder)


if __name__ == "__main__":
    unittest.main()
