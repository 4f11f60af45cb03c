"""Many simulators of one scene, stepped at the same time. doc/python.md shows the use."""
import numbers

import numpy as np

from .calls import in_threads, side_by_side
from .errors import MpmError
from .process import find_program
from .requests import changes_of
from .simulator import Simulator
from .stacking import Stacked, row_of


class Observations(Stacked):
    """What n simulators answered last, as one Observation whose numbers have a row for each: `time` (n,),
    `obs["blade"].force` (n, 3), and so on for whatever an Observation has (stacking.py). `obs[2]` is the Observation of
    the third. Rows of those that failed are NaN, zero or False.

    failures  dict: index to MpmError, of the simulators whose physics failed or whose process has ended; until they are
              reset
    failed    (n,) whether there is such a failure
    """

    def __init__(self, observations, failures, like):
        super().__init__(observations, like)
        self.failures = dict(failures)
        self.failed = np.array([place in self.failures for place in range(len(self))])

    def __getitem__(self, key):
        if isinstance(key, numbers.Integral) and key % len(self) in self.failures:
            raise self.failures[key % len(self)]
        return super().__getitem__(key)


class Simulators:
    """n simulators of one scene, each a node in a process of its own, stepped by one call.

        with Simulators("blade_in_soil", 4, values={"materials.sand.young": np.array([1e6, 2e6, 3e6, 4e6])}) as sims:
            obs = sims.step(0.01, velocity={"blade": (0.2, 0, 0)})
            print(obs["blade"].force)  # (4, 3)
            obs = sims.reset(2, {"materials.sand.young": 5e6})

    scene, set  as of a Simulator, for all of them
    n           how many
    values      changes to the scene of each, over `set`: a list of n dicts; or one dict, in which an array has a row for
                each and anything else is the same in all
    parameters  others of a Simulator and its node, in which "{index}" stands for the simulator's: record="run_{index}.bag".
                Defaults: own_master=True, so that none hears another's topics; with several, threads=1 and
                checkpoint_on_failure=False

    `len(sims)` is n, `sims[2]` the Simulator of that index, for checkpoints and solver_state. Raises MpmError when any of
    them does not start; then none is left.
    """

    def __init__(self, scene, n, *, values=None, set=None, own_master=True, **parameters):
        if not isinstance(n, numbers.Integral) or n < 1:
            raise MpmError(f"n is {n!r}; it must be a whole number above zero")
        if n > 1:
            parameters = {"threads": 1, "checkpoint_on_failure": False, **parameters}
        common = changes_of(set)
        changes = [common + changes_of(row_of(values, index, n, "values")) for index in range(n)]

        def make(index):
            own = {name: value.replace("{index}", str(index)) if isinstance(value, str) else value
                   for name, value in parameters.items()}
            return Simulator(scene, set=changes[index], own_master=own_master, **own)

        self._make = make
        self._simulators = {}
        self._changes = [None] * n  # of the last reset
        self._observations = [None] * n
        self._like = None  # any observation, for the shapes of rows that are not there
        self._failures = {}
        self._closed = False
        try:
            find_program("simulator")  # raises for all of them
            _raise_first(in_threads(self._start, range(n)), "was not started")
        except BaseException:
            self.close()
            raise

    def __len__(self):
        return len(self._observations)

    def __getitem__(self, index):
        return self._simulators[range(len(self))[index]]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends all nodes and masters; bags are closed. A second call does nothing."""
        self._closed = True
        in_threads(lambda index: self._simulators[index].close(), list(self._simulators))

    def step(self, duration=None, *, which=None, **commands):
        """Advances all, or those that `which` names, at the same time. Arguments are those of Simulator.step; an array in
        them has a row for each that is stepped, as a list of dicts has an entry, and anything else, tuples with it, is
        the same for all: velocity={"plate": speeds} with speeds of shape (n, 3), velocity={"plate": (0, 0, -0.1)}.

        which  index, list of indices, or array of n truth values

        Returns the Observations of all; those that are not stepped keep their row. A simulator whose physics fail or
        whose process ends is in its `failures`, and is not asked again before a reset; the others go on. Raises MpmError,
        after the others have been stepped, when a command is refused or a run has ended."""
        chosen = self._chosen(which)
        calls = {}
        for place, index in enumerate(chosen):
            own = {name: row_of(value, place, len(chosen), name) for name, value in commands.items()}
            if index not in self._failures:
                calls[index] = Simulator.step.begin(
                    self._simulators[index], row_of(duration, place, len(chosen), "duration"), **own)
        found, errors = side_by_side(calls)
        refused = self._keep(found, errors)
        _raise_first(refused, "was not stepped")
        return self._observed()

    def reset(self, which=None, values=None):
        """Begins the scene again in all, or in those that `which` names as in `step`, at the same time; a process that has
        ended is started again. `values`: changes to the scene of each, as in Simulator.reset: a list of dicts, one for
        each that is reset; or one dict, in which an array has a row for each; None: those of its last reset.

        Returns the Observations of all. Raises MpmError, after the others have been reset, when one is refused."""
        chosen = self._chosen(which)
        changes = {}
        for place, index in enumerate(chosen):
            own = row_of(values, place, len(chosen), "values")
            changes[index] = self._changes[index] if own is None else own
        errors = in_threads(self._start, [index for index in chosen if self._simulators[index].closed])
        found, refused = side_by_side({index: Simulator.reset.begin(self._simulators[index], changes[index])
                                       for index in chosen if index not in errors})
        for index in found:
            self._changes[index] = changes[index]
            self._failures.pop(index, None)
        self._keep(found, refused)
        _raise_first({**errors, **refused}, "was not reset")
        return self._observed()

    def _start(self, index):
        self._simulators[index] = self._make(index)

    def _chosen(self, which):
        """Indices."""
        if self._closed:
            raise MpmError("these simulators are closed")
        n = len(self)
        if which is None:
            return list(range(n))
        places = np.atleast_1d(np.asarray(which))
        if places.dtype == bool and places.shape == (n,):
            return np.flatnonzero(places).tolist()
        if places.size == 0:
            return []
        if (places.ndim != 1 or places.dtype.kind not in "iu" or len(np.unique(places)) < len(places)
                or places.min() < 0 or places.max() >= n):
            raise MpmError(f"which is {which!r}; it must be an index from 0 to {n - 1}, a list of different ones, or an "
                           f"array of {n} truth values")
        return places.tolist()

    def _keep(self, found, errors):
        """Keeps what was answered. Returns the errors of simulators that go on nevertheless."""
        for index, observation in found.items():
            self._observations[index] = self._like = observation
        refused = {}
        for index, error in errors.items():
            if self._has_failed(index):
                self._observations[index], self._failures[index] = None, error
            else:
                refused[index] = error
        return refused

    def _has_failed(self, index):
        try:
            return self._simulators[index].closed or self._simulators[index].solver_state().failed
        except MpmError:
            return True  # it ends just now

    def _observed(self):
        return Observations(self._observations, self._failures, self._like)


def _raise_first(errors, what):
    if errors:
        index, error = min(errors.items(), key=lambda entry: entry[0])
        more = f"; nor were {', '.join(map(str, sorted(errors)[1:]))}" if len(errors) > 1 else ""
        raise MpmError(f"simulator {index} {what}: {error}{more}", error.exit_code) from error
