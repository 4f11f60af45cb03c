"""What the user of a Simulator asks for, checked, as the node takes it."""
import json
import math
import operator
import os
from collections.abc import Mapping

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench

from .errors import MpmError

_MOST_PERIODS = 2 ** 32 - 1  # of one step: mpm_ros/Step's count


def path_of(path, what):
    """`path` as str."""
    try:
        return os.fsdecode(path)
    except TypeError as error:
        raise MpmError(f"{what} is {path!r}; it must be a path") from error


def _positive(value, what):
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not 0.0 < number < math.inf:
        raise MpmError(f"{what} is {value}; it must be a number above zero [s]")
    return number


def _json(value, what):
    """Numbers and arrays of NumPy become those of JSON."""
    try:
        return json.dumps(value, default=lambda other: other.tolist())
    except (AttributeError, TypeError, ValueError) as error:
        raise MpmError(f"{what} is {value!r}; it must be text, a number, a list or a dict") from error


def node_parameters(scene, changes, particle_period, particle_fields, others):
    """The node's parameters, of Python's own types."""
    if others.get("pacing", "lockstep") != "lockstep":
        raise MpmError(f"pacing is {others['pacing']}; a Simulator is stepped, in lockstep")
    parameters = dict(others, scene=path_of(scene, "scene"), pacing="lockstep", set=changes_of(changes))
    if particle_period is not None:
        parameters.update(particle_rate=1.0 / _positive(particle_period, "particle_period"), particle_first=0.0)
    if particle_fields is not None:
        parameters["particle_fields"] = list(particle_fields)
    return {name: json.loads(_json(value, name)) for name, value in parameters.items()}


def changes_of(changes):
    """["key=value", …] of what the user gave as a dict or as such a list."""
    if isinstance(changes, Mapping):
        return [f"{key}={value if isinstance(value, str) else _json(value, key)}" for key, value in changes.items()]
    changes = [changes] if isinstance(changes, str) else changes or []
    if not isinstance(changes, (list, tuple)) or not all(isinstance(change, str) for change in changes):
        raise MpmError(f"set is {changes!r}; it must be a dict, or a list of 'key=value'")
    return list(changes)


def advance(duration, count):
    """Fields of mpm_ros/Step that say how far."""
    if duration is not None and count is not None:
        raise MpmError(f"duration is {duration} and count is {count}; give one of them")
    if duration is not None:
        return {"duration": _positive(duration, "duration")}
    if count is None:
        return {"count": 1}
    try:
        number = operator.index(count)
    except TypeError:
        number = 0
    if not 1 <= number <= _MOST_PERIODS:
        raise MpmError(f"count is {count}; it must be a whole number from 1 to {_MOST_PERIODS}")
    return {"count": number}


def _numbers_of(body, values, lengths, what):
    try:
        numbers = np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise MpmError(f"{what} of '{body}' is {values!r}; it must be numbers") from error
    if numbers.ndim != 1 or len(numbers) not in lengths:
        raise MpmError(f"{what} of '{body}' has the shape {numbers.shape}; it must have "
                       f"{' or '.join(map(str, lengths))} numbers")
    return [float(number) for number in numbers] + [0.0] * (lengths[-1] - len(numbers))


def _of_bodies(commands, what, lengths):
    """(body, its numbers) of each command."""
    if commands is None:
        commands = {}
    if not isinstance(commands, Mapping) or not all(isinstance(body, str) for body in commands):
        raise MpmError(f"{what} is {commands!r}; it must be a dict: name of a rigid body to numbers")
    return [(body, _numbers_of(body, values, lengths, what)) for body, values in commands.items()]


def joint_commands_of(joints):
    """Messages mpm_ros/JointCommand of the dict of robots, each a dict of joints, that `Simulator.step` takes."""
    from .msg import JointCommand
    return [JointCommand(robot=robot, joints=list(values), values=_values_of(robot, values))
            for robot, values in _of_robots(joints).items() if values]


def _of_robots(joints):
    """A dict of robots, each a dict of joints."""
    if joints is None:
        return {}
    if not isinstance(joints, Mapping) or not all(isinstance(of, Mapping) for of in joints.values()):
        raise MpmError('joints is a dict of robots, each a dict of joints, such as {"digger": {"boom": 0.2}}')
    return joints


def _values_of(robot, values):
    """A number for each joint of a dict."""
    for joint, value in values.items():
        if np.ndim(value) != 0 or not isinstance(value, (int, float, np.number)):
            raise MpmError(f"joints: '{joint}' of '{robot}' is {value!r}; it must be a number")
    return [float(value) for value in values.values()]


def _pose_of(numbers):
    return Pose(Point(*numbers[:3]), Quaternion(*numbers[3:]))


def starts_of(joints, base):
    """Messages mpm_ros/StateSet of the robots that `Simulator.reset` names."""
    from .msg import StateSet
    poses = dict(_of_bodies(base, "base", (7,)))
    joints = _of_robots(joints)
    starts = []
    for robot in dict.fromkeys([*joints, *poses]):
        values = joints.get(robot, {})
        start = StateSet(model_name=robot, joint_names=list(values), joint_positions=_values_of(robot, values))
        if robot in poses:
            start.pose = _pose_of(poses[robot])
        starts.append(start)
    return starts


def state_of(name, pose, velocity, joints, joint_velocities):
    """Fields of mpm_ros/SetState of what `Simulator.set_state` takes."""
    joints, rates = joints or {}, joint_velocities or {}
    if not isinstance(joints, Mapping) or not isinstance(rates, Mapping):
        raise MpmError('joints and joint_velocities are dicts of joints, such as {"boom": 0.2}')
    if not set(rates) <= set(joints):
        raise MpmError(f"joint_velocities names {', '.join(sorted(set(rates) - set(joints)))}, which joints does not; "
                       "give positions too")
    if velocity is not None and pose is None:
        raise MpmError("velocity is set with a pose; give the present one where it is to stay")
    fields = {"model_name": name, "joint_names": list(joints), "joint_positions": _values_of(name, joints),
              "joint_velocities": _values_of(name, {joint: rates.get(joint, 0.0) for joint in joints})}
    if pose is not None:
        fields["pose"] = _pose_of(_numbers_of(name, pose, (7,), "pose"))
    if velocity is not None:
        numbers = _numbers_of(name, velocity, (3, 6), "velocity")
        fields["twist"] = Twist(Vector3(*numbers[:3]), Vector3(*numbers[3:]))
    return fields


def commands_of(velocity, pose, wrench, velocity_body=None):
    """Messages mpm_ros/Command of the dicts that `Simulator.step` takes."""
    from .msg import Command
    commands = []
    for body, numbers in _of_bodies(velocity_body, "velocity_body", (3, 6)):
        command = Command(body=body, kind=Command.VELOCITY, twist=Twist(Vector3(*numbers[:3]), Vector3(*numbers[3:])))
        command.header.frame_id = body
        commands.append(command)
    for body, numbers in _of_bodies(velocity, "velocity", (3, 6)):
        commands.append(Command(body=body, kind=Command.VELOCITY,
                                twist=Twist(Vector3(*numbers[:3]), Vector3(*numbers[3:]))))
    for body, numbers in _of_bodies(pose, "pose", (7,)):
        commands.append(Command(body=body, kind=Command.POSE, pose=_pose_of(numbers)))
    for body, numbers in _of_bodies(wrench, "wrench", (3, 6)):
        commands.append(Command(body=body, kind=Command.WRENCH,
                                wrench=Wrench(Vector3(*numbers[:3]), Vector3(*numbers[3:]))))
    return commands
