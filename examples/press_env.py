"""An environment for learning, in the shape of Gymnasium's: a plate has to press foam of unknown stiffness to a
force.

Gymnasium is not needed. What wants a gymnasium.Env proper wraps it: the methods and their results are the same, and the
spaces have Gymnasium's `low`, `high`, `shape`, `dtype` and `sample()`.

    env = PressEnv()
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
"""
import os

import numpy as np

import mpm_ros

SCENE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "press.yaml")


class Box:
    """Numbers between bounds, as gymnasium.spaces.Box."""

    dtype = np.dtype(np.float32)

    def __init__(self, low, high):
        self.low, self.high = np.array(low, self.dtype), np.array(high, self.dtype)
        self.shape = self.low.shape
        self.random = np.random.default_rng()

    def sample(self):
        return self.random.uniform(self.low, self.high).astype(self.dtype)

    def contains(self, values):
        values = np.asarray(values)
        return values.shape == self.shape and bool(np.all((values >= self.low) & (values <= self.high)))


class PressEnv:
    """Action: speed of the plate upwards over SPEED, (1,). Observation: (3,): force over the target, depth of the
    plate below the foam's surface over its thickness, last action. Reward of a step: minus the error of force over
    the target, at most 1. An episode is truncated after `periods` steps, or at the scene's end; it terminates when
    the plate has gone LIMIT deep, or the physics fail.

    parameters: of mpm_ros.Simulator, such as record="episode.bag"
    """

    metadata = {"render_modes": []}
    render_mode = None
    PERIOD = 0.02  # [s] of a step
    SPEED = 0.2  # [m/s]
    SURFACE, THICKNESS, LIMIT = 0.07, 0.06, 0.5  # [m] of the plate's origin at touch, [m], part of the thickness

    def __init__(self, periods=50, **parameters):
        self.action_space, self.observation_space = self.spaces()
        self.periods = periods
        self._simulator = mpm_ros.Simulator(SCENE, threads=1, **parameters)
        self._random = np.random.default_rng()

    @staticmethod
    def spaces():
        """Of actions and of observations."""
        return Box([-1.0], [1.0]), Box([-10.0, -1.0, -1.0], [100.0, 1.0, 1.0])

    @staticmethod
    def draw(random, options=None):
        """What an episode has of its own: "young" [Pa] and "target" [N]; `options` says some of it."""
        return {"young": random.uniform(10e3, 40e3), "target": random.uniform(5.0, 20.0), **(options or {})}

    def reset(self, *, seed=None, options=None):
        """A new block of foam of 10 to 40 kPa, and a target of 5 to 20 N; `options`: {"young": Pa, "target": N}."""
        if seed is not None:
            self._random = np.random.default_rng(seed)
            self.action_space.random = np.random.default_rng(seed)
        drawn = self.draw(self._random, options)
        self._target = drawn["target"]
        answer = self._simulator.reset({"materials.foam.young": drawn["young"]})
        self._left = self.periods
        return self._observe(answer, 0.0), drawn

    def step(self, action):
        """Raises ValueError for an action that is no number, and MpmError when the simulator is gone."""
        action = float(np.clip(action, -1.0, 1.0)[0])
        if not np.isfinite(action):
            raise ValueError("the action is not a number")
        try:
            answer = self._simulator.step(self.PERIOD, velocity={"plate": (0, 0, action * self.SPEED)})
        except mpm_ros.MpmError as error:
            if error.exit_code is not None:
                raise
            self._simulator.solver_state()  # raises when the simulator does not answer
            # The physics failed: the reset that follows begins again.
            return np.zeros(3, np.float32), -1.0, True, False, {"failure": str(error)}
        observation = self._observe(answer, action)
        self._left -= 1
        reward = -min(1.0, abs(float(observation[0]) - 1.0))
        truncated = self._left == 0 or answer.ended
        return observation, reward, bool(observation[1] > self.LIMIT), truncated, {"time": answer.time}

    def close(self):
        self._simulator.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _observe(self, answer, action):
        plate = answer["plate"]
        depth = (self.SURFACE - plate.position[2]) / self.THICKNESS
        return np.array([plate.force[2] / self._target, depth, action], np.float32)
