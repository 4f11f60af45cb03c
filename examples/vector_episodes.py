#!/usr/bin/python3
"""Episodes of PressVectorEnv (press_vector_env.py): all environments are stepped by one call, and each begins its next
episode by itself.

    rosrun mpm_ros vector_episodes.py --environments 20 --episodes 50

Ends with 0 when each environment had its episodes, and none failed.
"""
import argparse
import sys
import time

import numpy as np
from press_vector_env import PressVectorEnv


def policy(observations):
    """That of episodes.py, of all rows: down while the force is below the target, up above it."""
    return 0.5 * (observations[:, :1] - 1.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--environments", type=int, default=4)
    parser.add_argument("--episodes", type=int, default=5, help="of each environment")
    parser.add_argument("--periods", type=int, default=50, help="steps of an episode")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    n = options.environments
    done, failures, steps = np.zeros(n, int), 0, 0
    running, totals = np.zeros(n), [[] for _ in range(n)]
    with PressVectorEnv(n, options.periods) as envs:
        observations, _ = envs.reset(seed=options.seed)
        begin = time.monotonic()
        while done.min() < options.episodes:
            observations, rewards, terminations, truncations, infos = envs.step(policy(observations))
            steps += n
            running += rewards
            for index in np.flatnonzero(terminations | truncations):
                totals[index].append(running[index])
                done[index] += 1
                running[index] = 0.0
                if infos["final_info"]["_failure"][index]:
                    failures += 1
                    print(f"environment {index}, episode {done[index]}: {infos['final_info']['failure'][index]}")
        seconds = time.monotonic() - begin
    for index, rewards in enumerate(totals):
        print(f"environment {index}: {len(rewards)} episodes, reward {np.mean(rewards):.2f} in the mean")
    print(f"{done.sum()} episodes, {failures} failed, {steps / seconds:.0f} steps a second")
    return 0 if failures == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
