"""Bags of runs as NumPy arrays, whole or in parts (doc/recording.md); pandas where it is installed.

rosbag reads the file; messages are decoded as views of what it read (decoding.py). Tables of all topics but particles
fit into memory; particles come one snapshot at a time. Weak: a bag that was not closed is refused, where bag_report
reads a copy.
"""
import os

import numpy as np
import rosbag
from roslib.message import get_message_class

from .decoding import Message, decode
from .errors import MpmError
from .particles import Particles, simulated_time


class Table(dict):
    """Columns over time, by name: arrays (n,), or (n, k) where a row has several numbers. "time" is simulated [s]."""

    def to_pandas(self):
        """A DataFrame with the index `time`; a column (n, 3) becomes three, NAME_x, NAME_y, NAME_z, others NAME_0, …"""
        import pandas
        columns = {}
        for name, values in self.items():
            if values.ndim == 1:
                columns[name] = values
                continue
            ends = "xyz" if values.shape[1] == 3 else range(values.shape[1])
            columns.update({f"{name}_{end}": values[:, place] for place, end in enumerate(ends)})
        return pandas.DataFrame(columns).set_index("time")


class Recording:
    """A run as it was recorded: `Recording("run.bag")` reads run_part0002.bag and so on with it.

        run = mpm_ros.Recording("run.bag")
        force = run.contact_forces("blade")["force"]         # (n, 3) [N]
        frame = run.contact_forces("blade").to_pandas()
        for particles in run.particles(): print(particles.time, particles["speed"].max())

    info       as in mpm_ros/RunInfo: scene, scene_text, isa, sync_period [s], version, …
    namespace  of the topics: "/mpm", or "" for the root
    parts      paths of its files
    topics     names below the namespace
    bodies     names of the rigid bodies

    `namespace` has to be given only where a bag holds several runs. Raises MpmError.
    """

    def __init__(self, path, namespace=None):
        self.parts = _parts(os.fspath(path))
        self._bags = []
        self._closed = False
        try:
            self._open(namespace)
        except BaseException:
            self.close()
            raise

    def _open(self, namespace):
        for part in self.parts:
            self._bags.append(_open_bag(part))
        self.namespace = namespace_of(self._bags[0], self.parts[0]) if namespace is None else namespace.rstrip("/")
        begin = self.namespace + "/"
        topics = {topic for bag, part in zip(self._bags, self.parts) for topic in _topics_of(bag, part)}
        self.topics = sorted(topic[len(begin):] for topic in topics if topic.startswith(begin))
        infos = [next(self._messages("run_info", [bag]), None) for bag in self._bags]
        self.info = infos[0]
        for part, info in zip(self.parts, infos):
            if info is None:
                raise MpmError(f"{part} has no {begin}run_info: it is not a bag of a run below '{begin}'")
            if info.start != self.info.start or info.scene_text != self.info.scene_text:
                raise MpmError(f"{part} is part of another recording than {self.parts[0]}; move one of them elsewhere")
        first = next(self._messages("bodies"), None)
        self.bodies = [body.name for body in first.bodies] if first is not None else []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._closed = True
        for bag in self._bags:
            bag.close()

    def messages(self, topic):
        """The messages of a topic below the namespace, decoded, in the order of time."""
        if self._closed:
            raise MpmError(f"the recording {self.parts[0]} is closed")
        if topic not in self.topics:
            raise MpmError(f"{self.parts[0]} has no topic {topic} below '{self.namespace}/'; there are "
                           f"{', '.join(self.topics)}")
        return self._messages(topic)

    def _messages(self, topic, bags=None):
        for bag in self._bags if bags is None else bags:
            entries = _reading(bag.filename, bag.read_messages, f"{self.namespace}/{topic}", raw=True)
            while True:
                entry = _reading(bag.filename, next, entries, None)
                if entry is None:
                    break
                kind, data, md5sum = entry.message[:3]
                message_class = _reading(bag.filename, get_message_class, kind)
                if message_class is None:
                    raise MpmError(f"{bag.filename}: the message {kind} of {topic} is not installed")
                if message_class._md5sum != md5sum:
                    raise MpmError(f"{bag.filename}: {topic} was recorded by another version of {kind}; read it there")
                yield _reading(bag.filename, decode, message_class, data)

    def _time(self, message):
        return simulated_time(message.header.stamp, self.info.start)

    def table(self, topic, choose=lambda message: message):
        """The numbers of a topic over time. `choose` takes the part of each message that becomes a row."""
        rows, times = [], []
        for message in self.messages(topic):
            rows.append(_numbers(choose(message)))
            times.append(self._time(message))
        table = Table(time=np.array(times))
        try:
            for name in rows[0] if rows else []:
                table[name] = np.array([row[name] for row in rows])
        except (KeyError, ValueError) as error:
            raise MpmError(f"the messages of {topic} make no table: their numbers differ in name or count") from error
        return table

    def contact_forces(self, body):
        """Action of the material on a rigid body: the fields of mpm_ros/ContactForce, with `force`, `torque`,
        `peak_force` and `peak_torque` (n, 3) in place of its wrenches."""
        self._check_body(body)
        table = self.table("contact_forces", lambda message: _named(message.bodies, body))
        return _split(table, {"wrench": ("force", "torque"), "peak": ("peak_force", "peak_torque")})

    def motion(self, body):
        """Pose and twist of a rigid body: `position`, `orientation` (n, 4; x, y, z, w), `velocity`, `rotation_rate`."""
        self._check_body(body)
        table = self.table("bodies", lambda message: _named(message.bodies, body))
        return _split(table, {"pose": ("position", "orientation"), "twist": ("velocity", "rotation_rate")})

    def solver_state(self):
        """Energies, audit, time step and so on: the numbers of mpm_ros/SolverState. Its own `time` counts from the
        run's start too, and is this table's."""
        return self.table("solver_state")

    def global_quantities(self):
        """The quantities of output.global, by name."""
        messages = list(self.messages("global_quantities"))
        table = Table(time=np.array([self._time(message) for message in messages]))
        for place, name in enumerate(messages[0].names if messages else []):
            table[name] = np.array([message.values[place] for message in messages])
        return table

    def particles(self):
        """The snapshots, one after the other, as Particles."""
        for message in self.messages("particles"):
            yield Particles(message, self.info.start)

    def _check_body(self, body):
        if body not in self.bodies:
            raise MpmError(f"there is no rigid body '{body}' in {self.parts[0]}; there are {', '.join(self.bodies)}")


def namespace_of(bag, path):
    """Namespace of the run in an open rosbag.Bag, "" for the root: that of its mpm_ros/RunInfo."""
    found = [topic[:-len("/run_info")] for topic, info in _topics_of(bag, path).items()
             if info.msg_type == "mpm_ros/RunInfo" and topic.endswith("/run_info")]
    if not found:
        raise MpmError(f"{path} is not the bag of a run: it has no topic run_info (mpm_ros/RunInfo)")
    if len(found) > 1:
        raise MpmError(f"{path} holds several runs; name one of the namespaces {', '.join(sorted(found))}")
    return found[0]


def _topics_of(bag, path):
    return _reading(path, bag.get_type_and_topic_info).topics


def _open_bag(path):
    try:
        return rosbag.Bag(path)
    except rosbag.ROSBagUnindexedException:
        raise MpmError(f"{path} was not closed; `rosbag reindex {path}` makes its index") from None
    except Exception as error:  # as in _reading
        raise MpmError(f"{path} cannot be read as a bag: {error}") from error


def _reading(path, read, *arguments, **options):
    """What `read` returns; whatever a damaged bag makes it raise becomes MpmError."""
    try:
        return read(*arguments, **options)
    except Exception as error:  # rosbag lets through what the libraries below it raise, of many kinds
        raise MpmError(f"{path} is damaged: {error}; `rosbag reindex {path}` may save what is whole") from error


def _parts(path):
    """`path` and the parts of a split recording after it."""
    parts = [path]
    stem, extension = os.path.splitext(path)
    while os.path.isfile(f"{stem}_part{len(parts) + 1:04d}{extension}"):
        parts.append(f"{stem}_part{len(parts) + 1:04d}{extension}")
    return parts


def _named(entries, name):
    for entry in entries:
        if entry.name == name:
            return entry
    raise MpmError(f"a message has no rigid body '{name}'; it has {', '.join(entry.name for entry in entries)}")


def _numbers(message):
    """Fields of a message that are numbers or arrays of a fixed length, and its array `values` (mpm_ros/NamedValue)
    by name."""
    row = {}
    for name, value in vars(message).items():
        if isinstance(value, (bool, int, float, np.ndarray)):
            row[name] = value
        elif name == "values" and value and isinstance(value[0], Message):
            row.update({entry.name: entry.value[0] if len(entry.value) == 1 else entry.value for entry in value})
    row.pop("time", None)
    return row


def _split(table, names):
    """Columns of two vectors as two columns: the first three numbers, and the rest."""
    result = Table()
    for name, values in table.items():
        if name in names:
            first, second = names[name]
            result[first], result[second] = values[:, :3], values[:, 3:]
        else:
            result[name] = values
    return result
