"""n objects of one kind as one object, whose numbers are NumPy arrays with a row for each."""
import numbers
from collections.abc import Mapping

import numpy as np

from .errors import MpmError


class Stacked:
    """Attributes and entries of n objects, stacked when they are asked for: `stacked.force` is (n, 3) where each has a
    `force` of shape (3,), `stacked["speed"]` the same of entries. Truth values and numbers become arrays (n,); objects and
    dicts are Stacked again; text and lists become lists of n. `stacked[2]` is the third object.

    A row without an object, None, is NaN; zero where the numbers are whole, False for a truth value.
    """

    def __init__(self, items, like=None):
        """`like`: an object to tell the shapes where no row has one."""
        self._items = tuple(items)
        self._like = next((item for item in self._items if item is not None), like)

    def __len__(self):
        return len(self._items)

    def __getitem__(self, key):
        if isinstance(key, numbers.Integral):
            return self._items[key]
        return self._stack(key, lambda item: item[key])

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        stacked = self._stack(name, lambda item: getattr(item, name))
        self.__dict__[name] = stacked  # found without this function from now on
        return stacked

    def __dir__(self):
        return {*super().__dir__(), *(name for name in dir(self._like) if not name.startswith("_"))}

    def keys(self):
        """Keys of dicts."""
        return self._like.keys()

    def _stack(self, name, part):
        if self._like is None:
            raise MpmError(f"there is no '{name}': no row has anything")
        values = [None if item is None else part(item) for item in self._items]
        like = next((value for value in values if value is not None), None)
        return _stacked(name, values, part(self._like) if like is None else like)


def _stacked(name, values, like):
    if like is None:
        return None
    if isinstance(like, (bool, np.bool_)):
        return np.array([bool(value) for value in values])
    if isinstance(like, (numbers.Number, np.ndarray)):
        return _rows(name, values, np.asarray(like))
    if isinstance(like, (str, list, tuple)):
        return values
    return Stacked(values, like)


def _rows(name, values, like):
    if any(value is None for value in values):
        empty = np.zeros_like(like)
        if like.dtype.kind == "f":
            empty[...] = np.nan
        values = [empty if value is None else value for value in values]
    shapes = {np.shape(value) for value in values}
    if len(shapes) > 1:
        raise MpmError(f"'{name}' cannot be stacked: its shapes are {', '.join(map(str, sorted(shapes)))}; take the rows "
                       "one by one")
    return np.array(values)


def row_of(value, place, count, what):
    """What `value` has for one of `count` rows: entry `place` of an array, or of a list of dicts or None; of a dict, what
    its values have, arrays alone having rows; anything else, tuples and lists of numbers with it, is the same in all."""
    each = isinstance(value, list) and value and all(part is None or isinstance(part, Mapping) for part in value)
    return _entry(value, place, count, what) if each else _part_of(value, place, count, what)


def _part_of(value, place, count, what):
    if isinstance(value, Mapping):
        return {key: _part_of(part, place, count, f"{what} of '{key}'") for key, part in value.items()}
    return _entry(value, place, count, what) if getattr(value, "ndim", 0) > 0 else value


def _entry(rows, place, count, what):
    if len(rows) != count:
        raise MpmError(f"{what} has {len(rows)} rows; it must have one for each of the {count} simulators. What is the "
                       "same in all is written as a tuple or a number")
    return rows[place]
