#!/usr/bin/env python3
"""Many simulators for long: 20 environments by 50 episodes, and the memory of every process over 1,000 resets. Only
scripts/test --full runs it. 4 minutes on two cores."""
import os
import unittest

import mpm_ros
import numpy as np
from support import run, source_file

N, WARM, RESETS = 4, 1000, 1000


def memory_of(process):
    """Resident [kB]."""
    with open(f"/proc/{process}/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS:"))


class Long(unittest.TestCase):
    def test_twenty_environments_by_fifty_episodes(self):
        output = run(source_file("examples/vector_episodes.py"), "--environments", "20", "--episodes", "50", "--periods",
                     "20")
        print(output.splitlines()[-1])
        episodes, failed = (int(word) for word in output.splitlines()[-1].split()[0:3:2])
        self.assertGreaterEqual(episodes, 20 * 50)
        self.assertEqual(failed, 0)

    def test_memory_of_every_process_stays_flat(self):
        """A node takes its last memory before the thousandth reset, from which on it keeps within 0.2 % over 7,000 resets: a
        leak of 0.4 kB a reset is above the bound."""
        with mpm_ros.Simulators(source_file("test/data/press.yaml"), N, particle_period=0.002) as sims:
            processes = {f"simulator {index}, {name}": process for index, sim in enumerate(sims)
                         for name, process in zip(("master", "node"), sim.process_ids)}
            processes["this program"] = os.getpid()
            self.assertEqual(len(processes), 2 * N + 1)
            warm = {}
            for number in range(1, WARM + RESETS + 1):
                sims.reset(values={"materials.0.young": 5e4 + 100.0 * (number % 1000 + np.arange(N))})
                obs = sims.step(0.01, velocity={"plate": (0, 0, -0.4)})
                self.assertEqual(obs.failures, {})
                if number == WARM:
                    warm = {name: memory_of(process) for name, process in processes.items()}
            for name, process in processes.items():
                now = memory_of(process)
                print(f"{name}: {warm[name]} kB after {WARM} resets, {now} kB after {RESETS} more")
                with self.subTest(name):
                    self.assertLess(abs(now - warm[name]), 0.01 * warm[name])


if __name__ == "__main__":
    unittest.main()
