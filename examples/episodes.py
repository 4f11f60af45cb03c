#!/usr/bin/python3
"""Episodes of PressEnv (press_env.py) in one simulator, with a proportional controller in place of a policy.

    rosrun mpm_ros episodes.py --episodes 20

Ends with 0 when every episode came to its end without a failure of the physics.
"""
import argparse
import sys
import time

import numpy as np
from press_env import PressEnv


def policy(observation):
    """Down while the force is below the target, up above it."""
    return np.array([0.5 * (observation[0] - 1.0)])


def main():
    parser = argparse.ArgumentParser(description="Runs episodes of the environment PressEnv.")
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    failures = 0
    begin = time.monotonic()
    with PressEnv() as env:
        for episode in range(options.episodes):
            observation, info = env.reset(seed=options.seed + episode)
            total, over = 0.0, False
            while not over:
                observation, reward, terminated, truncated, last = env.step(policy(observation))
                total += reward
                over = terminated or truncated
            failures += "failure" in last
            print(f"episode {episode + 1}: {info['young'] * 1e-3:.1f} kPa, reward {total:.2f}, "
                  f"force {observation[0] * info['target']:.2f} N for {info['target']:.2f} N"
                  + (f", failed: {last['failure']}" if "failure" in last else ""))
    print(f"{options.episodes} episodes, {failures} failed, {time.monotonic() - begin:.1f} s")
    return 0 if failures == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
