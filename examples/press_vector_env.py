"""n environments of press_env.py in one, in the shape of Gymnasium's vector environments: one call steps all of them, in
n simulators at the same time, and an episode that ends is followed by the next one at once.

Gymnasium is not needed. Results are as those of a gymnasium.vector.VectorEnv with AutoresetMode.SAME_STEP: rows of
`observations` are those after the reset where an episode has ended, and `infos` keeps its last ones.

    envs = PressVectorEnv(20)
    observations, infos = envs.reset(seed=1)
    observations, rewards, terminations, truncations, infos = envs.step(envs.action_space.sample())
"""
import numpy as np
from press_env import SCENE, Box, PressEnv

import mpm_ros


class PressVectorEnv:
    """Actions (n, 1), observations (n, 3) and rewards (n,) are those of PressEnv, and so are episodes: that of index i after
    reset(seed=s) is to the bit that of a PressEnv after reset(seed=s + i), and so are those that follow it.

    infos  of episodes that begin "young" [Pa] and "target" [N], of those that go on "time" [s]; of those that have ended
           "final_obs" and "final_info", with "failure" where the physics or the simulator's process failed. "_young" and
           so on say which rows count.
    parameters: of mpm_ros.Simulators
    """

    metadata = {"render_modes": [], "autoreset_mode": "SameStep"}
    render_mode = None

    def __init__(self, n, periods=50, **parameters):
        self.num_envs = n
        self.periods = periods
        self.single_action_space, self.single_observation_space = PressEnv.spaces()
        self.action_space, self.observation_space = (
            Box(np.tile(space.low, (n, 1)), np.tile(space.high, (n, 1))) for space in PressEnv.spaces())
        self._simulators = mpm_ros.Simulators(SCENE, n, **parameters)
        self._randoms = [np.random.default_rng() for _ in range(n)]
        self._targets, self._left = np.ones(n), np.zeros(n, int)

    def reset(self, *, seed=None, options=None):
        """All episodes anew. `seed`: a number, to which the index is added, or n of them; `options`: as of PressEnv."""
        if seed is not None:
            seeds = seed + np.arange(self.num_envs) if np.ndim(seed) == 0 else seed
            self._randoms = [np.random.default_rng(int(number)) for number in seeds]
            self.action_space.random = np.random.default_rng(int(seeds[0]))
        return self._begin(np.ones(self.num_envs, bool), options)

    def step(self, actions):
        """Raises ValueError where an action is no number."""
        actions = np.clip(np.asarray(actions, float).reshape(self.num_envs), -1.0, 1.0)
        if not np.all(np.isfinite(actions)):
            raise ValueError("an action is not a number")
        speeds = np.zeros((self.num_envs, 3))
        speeds[:, 2] = actions * PressEnv.SPEED
        answer = self._simulators.step(PressEnv.PERIOD, velocity={"plate": speeds})
        observations = self._observe(answer, actions)
        observations[answer.failed] = 0.0
        self._left -= 1
        rewards = -np.minimum(1.0, np.abs(observations[:, 0].astype(float) - 1.0))
        terminations = (observations[:, 1] > PressEnv.LIMIT) | answer.failed
        truncations = ((self._left == 0) | answer.ended) & ~answer.failed
        ended = terminations | truncations
        infos = _infos(time=(answer.time, ~ended))
        if ended.any():
            failures = np.array([str(answer.failures.get(index, "")) for index in range(self.num_envs)], object)
            final = _infos(time=(answer.time, ended & ~answer.failed), failure=(failures, answer.failed))
            rows = np.full(self.num_envs, None)
            for index in np.flatnonzero(ended):
                rows[index] = observations[index].copy()
            begun, more = self._begin(ended)
            observations[ended] = begun[ended]
            infos.update(_infos(final_obs=(rows, ended), final_info=(final, ended)), **more)
        return observations, rewards, terminations, truncations, infos

    def close(self):
        self._simulators.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _begin(self, which, options=None):
        """Begins episodes of the environments `which` (n,). Observations of all, and infos of these."""
        young = np.zeros(self.num_envs)
        for index in np.flatnonzero(which):
            drawn = PressEnv.draw(self._randoms[index], options)
            young[index], self._targets[index] = drawn["young"], drawn["target"]
        self._left[which] = self.periods
        answer = self._simulators.reset(which, {"materials.foam.young": young[which]})
        infos = _infos(young=(young, which), target=(np.where(which, self._targets, 0.0), which))
        return self._observe(answer, np.zeros(self.num_envs)), infos

    def _observe(self, answer, actions):
        plate = answer["plate"]
        depths = (PressEnv.SURFACE - plate.position[:, 2]) / PressEnv.THICKNESS
        return np.stack([plate.force[:, 2] / self._targets, depths, actions], axis=1).astype(np.float32)


def _infos(**values):
    """Each with the rows that count, as Gymnasium has them."""
    return {key: part for name, (value, rows) in values.items() for key, part in ((name, value), ("_" + name, rows))}
