#!/usr/bin/env python3
"""The examples run by themselves, as a user starts them. 20 s."""
import subprocess
import unittest

from support import source_file


class Examples(unittest.TestCase):
    def expect(self, text, *command):
        done = subprocess.run([source_file("examples/" + command[0]), *command[1:]], capture_output=True, text=True,
                              check=False, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(text, done.stdout)

    def test_the_controller_settles(self):
        self.expect("settled\n", "lockstep.py")

    def test_episodes_run_in_one_simulator(self):
        self.expect("20 episodes, 0 failed", "episodes.py", "--episodes", "20")


if __name__ == "__main__":
    unittest.main()
