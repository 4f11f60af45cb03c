#!/usr/bin/env python3
"""The examples run by themselves, as a user starts them. 25 s."""
import os
import signal
import subprocess
import sys
import unittest

import mpm_ros
from support import processes_with, program, source_file


class Examples(unittest.TestCase):
    def expect(self, text, *command):
        done = subprocess.run([source_file("examples/" + command[0]), *command[1:]], capture_output=True, text=True,
                              check=False, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(text, done.stdout)

    def test_the_controller_settles(self):
        self.expect("settled\n", "lockstep.py")

    def test_an_episode_ends_with_the_physics_and_not_with_the_simulator(self):
        sys.path.insert(0, source_file("examples"))
        from press_env import PressEnv
        namespace = f"/episodes_{os.getpid()}"
        # A block that is thrown out of a domain without walls, 0.04 m from its side.
        thrown = {"boundaries": {}, "bodies.block.initial.velocity": [5, 0]}
        with PressEnv(namespace=namespace, set=thrown, checkpoint_on_failure=False) as env:
            for _ in range(2):
                env.reset(seed=1)
                with self.assertRaisesRegex(ValueError, "not a number"):
                    env.step([float("nan")])
                _, _, terminated, _, info = env.step([0.0])
                self.assertTrue(terminated)
                self.assertIn("outside the domain", info["failure"])
            for process in processes_with(f"{program('simulator')} __ns:={namespace}"):
                os.kill(process, signal.SIGKILL)
            with self.assertRaisesRegex(mpm_ros.MpmError, "killed by signal 9"):
                env.step([0.0])

    def test_episodes_run_in_one_simulator(self):
        self.expect("20 episodes, 0 failed", "episodes.py", "--episodes", "20")


if __name__ == "__main__":
    unittest.main()
