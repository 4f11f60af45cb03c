"""Serialised ROS messages as objects whose arrays are views of the received bytes.

genpy, the generator of the message classes, copies every array and makes an object of each vector. Here the class
serves as the description alone (`__slots__`, `_slot_types`), so a changed message needs no change here. Serialisation
is that of ROS 1: fields one after the other, little-endian, without padding; lengths of strings and arrays as uint32
before them.
"""
import struct

import numpy as np
from roslib.message import get_message_class

_NUMBERS = {"bool": "?", "int8": "b", "byte": "b", "uint8": "B", "char": "B", "int16": "h", "uint16": "H", "int32": "i",
            "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}
_LENGTH = struct.Struct("<I")
_TIMES = {"time": struct.Struct("<II"), "duration": struct.Struct("<ii")}


class Message:
    """A decoded message: its fields are attributes."""

    def __repr__(self):
        return f"Message({', '.join(f'{name}={value!r}' for name, value in vars(self).items())})"


def decode(message_class, buffer):
    """`buffer`, a whole serialised message of the genpy class `message_class`, as a Message.

    Numbers become numbers, text str, times int [ns]. Arrays of numbers, and messages of nothing but one kind of number
    (Vector3: 3 float64, Pose: 7, Twist and Wrench: 6), become NumPy views of `buffer`; an array of such messages is a
    view of shape (n, 3) and so on. Other arrays become lists. Raises ValueError when the bytes are not such a message.
    """
    try:
        _classes.setdefault(message_class._type, message_class)
        decoded, end = _reader(message_class._type)(buffer, 0)
    except (struct.error, UnicodeDecodeError) as error:
        raise ValueError(f"{len(buffer)} bytes are not a {message_class._type}: {error}") from error
    if end != len(buffer):
        raise ValueError(f"{len(buffer)} bytes are not a {message_class._type}, which ends after {end}")
    return decoded


_readers = {}
_classes = {}  # by name; answers of services cannot be looked up


def _reader(kind):
    """The function (buffer, offset) -> (value, offset behind it) for a type of the message language."""
    if kind not in _readers:
        _readers[kind] = _make_reader(kind)
    return _readers[kind]


def _make_reader(kind):
    base, is_array, length = _parse_type(kind)
    if is_array:
        return _array_reader(base, length)
    if kind in _NUMBERS:
        return _number_reader(struct.Struct("<" + _NUMBERS[kind]))
    if kind in _TIMES:
        return _time_reader(_TIMES[kind])
    if kind == "string":
        return _read_text
    dtype = _dtype(kind)
    return _message_reader(kind) if dtype is None else _vector_reader(dtype)


def _parse_type(kind):
    """("float64", True, 3) of "float64[3]"; the length of "float64[]" is None."""
    if not kind.endswith("]"):
        return kind, False, None
    base, _, length = kind[:-1].rpartition("[")
    return base, True, int(length) if length else None


def _message_class(kind):
    if kind not in _classes:
        _classes[kind] = get_message_class("std_msgs/Header" if kind == "Header" else kind)
    return _classes[kind]


def _dtype(kind):
    """NumPy's type of what has one kind of number and always the same length, else None."""
    if kind in _NUMBERS:
        return np.dtype("<" + _NUMBERS[kind])
    if kind in _TIMES or kind in ("string", "Header", "std_msgs/Header"):
        return None
    base, count = None, 0
    for slot in _message_class(kind)._slot_types:
        element, is_array, length = _parse_type(slot)
        if is_array and length is None:
            return None
        dtype = _dtype(element)
        if dtype is None:
            return None
        number, numbers = dtype.base, int(np.prod(dtype.shape)) * (length if is_array else 1)
        if base not in (None, number):
            return None
        base, count = number, count + numbers
    return np.dtype((base, (count,))) if count else None


def _number_reader(layout):
    def read(buffer, offset):
        return layout.unpack_from(buffer, offset)[0], offset + layout.size
    return read


def _time_reader(layout):
    def read(buffer, offset):
        seconds, nanoseconds = layout.unpack_from(buffer, offset)
        return seconds * 1000000000 + nanoseconds, offset + layout.size
    return read


def _read_length(buffer, offset):
    return _LENGTH.unpack_from(buffer, offset)[0], offset + _LENGTH.size


def _read_text(buffer, offset):
    length, offset = _read_length(buffer, offset)
    if offset + length > len(buffer):
        raise struct.error("a text ends behind them")
    return str(memoryview(buffer)[offset:offset + length], "utf-8"), offset + length


def _viewer(dtype):
    """The function (buffer, offset, count) -> (view of `count` elements, offset behind it)."""
    base, shape, size = dtype.base, dtype.shape, dtype.itemsize
    numbers = size // base.itemsize  # frombuffer takes no type with a shape of its own

    def view(buffer, offset, count):
        end = offset + count * size
        if end > len(buffer):
            raise struct.error("an array ends behind them")
        flat = np.frombuffer(buffer, base, count * numbers, offset)
        return flat.reshape((count,) + shape) if shape else flat, end
    return view


def _vector_reader(dtype):
    base, size = dtype.base, dtype.itemsize
    numbers = size // base.itemsize

    def read(buffer, offset):
        if offset + size > len(buffer):
            raise struct.error("a vector ends behind them")
        return np.frombuffer(buffer, base, numbers, offset), offset + size
    return read


def _array_reader(base, length):
    dtype = _dtype(base)
    view = None if dtype is None else _viewer(dtype)
    read_element = _reader(base) if dtype is None else None

    def read(buffer, offset):
        count = length
        if count is None:
            count, offset = _read_length(buffer, offset)
        if view is not None:
            return view(buffer, offset, count)
        values = []
        for _ in range(count):
            value, offset = read_element(buffer, offset)
            values.append(value)
        return values, offset
    return read


def _message_reader(kind):
    message_class = _message_class(kind)
    fields = [(name, _reader(slot)) for name, slot in zip(message_class.__slots__, message_class._slot_types)]

    def read(buffer, offset):
        message = Message()
        for name, read_field in fields:
            value, offset = read_field(buffer, offset)
            setattr(message, name, value)
        return message, offset
    return read
