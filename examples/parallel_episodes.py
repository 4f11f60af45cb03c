#!/usr/bin/python3
"""Episodes of PressEnv (press_env.py) in several simulators at once, each in a process of its own.

    rosrun mpm_ros parallel_episodes.py --episodes 16 --simulators 2
    rosrun mpm_ros parallel_episodes.py --episodes 16 --simulators 2 --compare    # with one simulator, too

An episode's seed is --seed and its number, so its result does not depend on which simulator ran it. Ends with 0 when all
episodes came to their end and, with --compare, were the same to the bit in one simulator and in several.
"""
import argparse
import multiprocessing
import queue
import sys
import time

from episodes import policy
from press_env import PressEnv


def episode_of(env, seed):
    """Total reward and number of steps."""
    observation, _ = env.reset(seed=seed)
    total, steps, over = 0.0, 0, False
    while not over:
        observation, reward, terminated, truncated, _ = env.step(policy(observation))
        total, steps, over = total + reward, steps + 1, terminated or truncated
    return total, steps


def work(seeds, results, record):
    """A process with a simulator, and a master of its own: two simulators at one master would both publish /clock and /tf.
    Announces itself with None, then answers until the seed None comes."""
    with PressEnv(own_master=True, **({"record": record} if record else {})) as env:
        results.put(None)
        for seed in iter(seeds.get, None):
            results.put((seed, *episode_of(env, seed)))


def answer(results, processes):
    """The next answer of a worker. Raises RuntimeError where one has ended instead."""
    while True:
        try:
            return results.get(timeout=1.0)
        except queue.Empty:
            if any(process.exitcode for process in processes):
                raise RuntimeError("a simulator ended before its episodes did") from None


def run(simulators, seeds, record=None):
    """Results by seed, and steps a second from when all simulators were ready."""
    # A process that is spawned has no connections, locks or threads of this one, as a fork would.
    context = multiprocessing.get_context("spawn")
    waiting, results = context.Queue(), context.Queue()
    processes = [context.Process(target=work, daemon=True, args=(waiting, results, record if number == 0 else None))
                 for number in range(simulators)]
    for process in processes:
        process.start()
    for _ in processes:
        answer(results, processes)
    begin = time.monotonic()
    for seed in seeds:
        waiting.put(seed)
    found = {seed: (total, steps) for seed, total, steps in (answer(results, processes) for _ in seeds)}
    seconds = time.monotonic() - begin
    for _ in processes:
        waiting.put(None)
    for process in processes:
        process.join()
    return found, sum(steps for _, steps in found.values()) / seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=16)
    parser.add_argument("--simulators", type=int, default=2, help="no more than the machine has cores to spare")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--record", metavar="FILE.bag", help="recording of the first simulator; a bag an episode")
    parser.add_argument("--compare", action="store_true", help="run the same episodes in one simulator, too")
    arguments = parser.parse_args()
    seeds = [arguments.seed + episode for episode in range(arguments.episodes)]
    found, rate = run(arguments.simulators, seeds, arguments.record)
    for seed in seeds:
        print(f"seed {seed}: reward {found[seed][0]:.4f} in {found[seed][1]} steps")
    print(f"{arguments.simulators} simulator{'s' if arguments.simulators > 1 else ''}: {rate:.0f} steps a second")
    if not arguments.compare:
        return 0
    alone, slower = run(1, seeds)
    print(f"1 simulator: {slower:.0f} steps a second; {arguments.simulators} are {rate / slower:.2f} times as fast")
    print("the same episodes to the bit" if alone == found else "the episodes differ")
    return 0 if alone == found else 1


if __name__ == "__main__":
    sys.exit(main())
