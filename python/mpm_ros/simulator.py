"""A simulator stepped in lockstep: a controller in a loop of its own. doc/python.md shows the use, doc/loop.md has the
contract of `step`."""
import contextlib
import itertools
import os
import weakref

import rosgraph

from . import wire
from .calls import whole
from .errors import MpmError
from .master import close, master_at, master_runs
from .names import DEFAULT_NAMESPACE, lock_namespace
from .observation import Observation
from .particles import Particles
from .process import NodeProcess, find_program
from .requests import advance, changes_of, commands_of, joint_commands_of, node_parameters, path_of, \
    starts_of, state_of

_CLOUD_PATIENCE = 20.0  # [s] wall time for a message that the node has handed to its connection
_numbers = itertools.count(1)


class Simulator:
    """A simulator node, stepped by this object.

        with Simulator("blade_in_soil", threads=1) as sim:
            obs = sim.step(0.01, velocity={"blade": (0.2, 0, 0)})
            print(obs["blade"].force)

    `Simulator(scene)` starts a node in a process of its own: below `namespace`, or the first free one of /mpm, /mpm_2,
    and so on; at the master of ROS_MASTER_URI, or where none answers with a master of its own on a free port. Both end
    at the end of the block, and with this process however that ends. `Simulator.connect(namespace)` takes over a node
    that runs.

    scene            a shipped scene's name, or a path
    set              changes to the scene: {"time.end": 5, "materials.sand.young": "2 MPa"}, or ["time.end=5"]
    particle_period  [s] simulated, whole sync periods: Observation.particles. None: no particles are sent
    particle_fields  names of particle fields beside x, y, z and id. None: the scene's
    namespace        of the node
    own_master       True: a master of its own in any case; False: that of ROS_MASTER_URI; None: as above
    parameters       any other parameter of the node (config/simulator.yaml): threads=1, record="run.bag"

    The node's warnings go to Python's log `mpm_ros`. Whatever fails raises MpmError with the node's own sentence. Not
    for several threads at once. Several simulators in one process, or one after the other, are independent.
    """

    def __init__(self, scene, *, set=None, particle_period=None, particle_fields=None, namespace=None, own_master=None,
                 **parameters):
        parameters = node_parameters(scene, set, particle_period, particle_fields, parameters)
        if own_master is None:
            own_master = not master_runs()
        elif not own_master and not master_runs():
            raise MpmError(f"no master answers at {rosgraph.get_master_uri()}; start roscore")
        namespace = None if namespace is None else "/" + namespace.strip("/")
        name_lock = None
        if own_master:
            namespace = namespace or DEFAULT_NAMESPACE
        else:
            namespace, name_lock = lock_namespace(namespace)
        self._process = NodeProcess(find_program("simulator"), namespace, parameters, own_master, name_lock)
        self._connect(namespace, self._process.master_uri, particle_period)

    @classmethod
    def connect(cls, namespace=DEFAULT_NAMESPACE, particle_period=None):
        """The simulator that runs below `namespace` with `_pacing:=lockstep`, at the master of ROS_MASTER_URI. It
        goes on when the block ends. `particle_period` [s]: of the clouds that it publishes (its ~particle_rate)."""
        if not master_runs():
            raise MpmError(f"no master answers at {rosgraph.get_master_uri()}; start roscore and a simulator")
        self = cls.__new__(cls)
        self._process = None
        self._connect(namespace, rosgraph.get_master_uri(), particle_period)
        return self

    def _connect(self, namespace, master_uri, particle_period):
        self.namespace = "/" + namespace.strip("/")
        self.master_uri = master_uri
        self._caller = f"/mpm_ros_client_{os.getpid()}_{next(_numbers)}"
        self._master = master_at(self._caller, master_uri)
        self._connections = {}
        self._changes = []  # of the last reset
        self._clouds = None
        self._particles = None
        self._interrupted = False
        self._closer = weakref.finalize(self, _close, self._process, self._connections, self._master)
        try:
            self._service("step")
            self.info = self._latched("run_info")
            if particle_period is not None:
                self._follow_particles(particle_period)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the node that this object started, and its master; bags are closed. A second call does nothing."""
        self._closer()

    @property
    def closed(self):
        """Whether `close` was called, or the node is gone."""
        return not self._closer.alive

    @property
    def process_ids(self):
        """Ids of the processes that this object started and that run: the one that watches over the node and holds its
        master, and the node."""
        return [] if self._process is None else self._process.ids()

    # --- what the node does -------------------------------------------------------------------------------------------

    @whole
    def step(self, duration=None, *, count=None, velocity=None, pose=None, wrench=None, velocity_body=None,
             joints=None):
        """Advances by `duration` [s], rounded up to whole sync periods, or by `count` of them; by one when neither is
        given. Commands take effect at its start; each is a dict of bodies:

        velocity       (3,) [m/s] of the body's origin, or (6,) with its rotation rate [rad/s]; world axes
        velocity_body  the same in the axes of the body itself, which turn with it
        pose           (7,) position [m] and quaternion x, y, z, w, to be reached at the end of the step
        wrench         (3,) [N] on a free body, or (6,) with the torque [N m] about its origin; world axes
        joints         a dict of robots, each a dict of joints: {"digger": {"boom": 0.2}}, a velocity [m/s, rad/s], a
                       position [m, rad], which a rigid drive reaches at the end of the step, or an effort [N, N m], by
                       the joint's drive

        Returns an Observation. Raises MpmError when a command is refused, the run has ended, or the physics fail."""
        request = dict(advance(duration, count), commands=commands_of(velocity, pose, wrench, velocity_body),
                       joint_commands=joint_commands_of(joints))
        with self._whole():
            answer = yield from self._call("step", **request)
            return Observation(answer, self._particles_at(answer.stamp))

    @whole
    def reset(self, set=None, *, joints=None, base=None):
        """Begins the scene again and returns the Observation at time zero. Also after a failure of the physics.

        set     changes to the scene, as in Simulator() and over those given there, for this run and the next ones; None:
                those of the last call
        joints  positions with which robots begin, over the scene and `set`: {"digger": {"boom": 0.2}} [m] or [rad];
                for this run alone
        base    poses with which bases of robots begin: {"digger": (7,)} position [m] and quaternion x, y, z, w; the same
        """
        changes = self._changes if set is None else changes_of(set)
        with self._whole():
            answer = yield from self._call("reset_with", set=changes, start=starts_of(joints, base))
            self._changes = changes
            self._begin_run(answer.stamp)
            return Observation(answer, self._particles_at(answer.stamp))

    @whole
    def set_state(self, name, *, pose=None, velocity=None, joints=None, joint_velocities=None):
        """Sets the state of a rigid body or a robot between two steps, in place of what the run has come to.

        name              of the body or the robot
        pose              (7,) position [m] and quaternion x, y, z, w of the body, or of the robot's base; None: as it is
        velocity          (3,) [m/s] of that origin, or (6,) with the rotation rate [rad/s]; world axes; of a free body or
                          base, and with a pose; None: at rest
        joints            positions of a robot's joints by name [m] or [rad]
        joint_velocities  the same of some of these joints [m/s] or [rad/s]; others are at rest

        Raises MpmError when it cannot be there, as where material lies in it by more than half a cell; then nothing is
        changed."""
        yield from self._call("set_state", **state_of(name, pose, velocity, joints, joint_velocities))

    @whole
    def save_checkpoint(self, path):
        """Saves the run, to the bit. Returns the file's absolute path. A relative path starts from the node's folder,
        which is the present one for a node that this object started."""
        answer = yield from self._call("save_checkpoint", path=path_of(path, "path"))
        return answer.path

    @whole
    def load_checkpoint(self, path):
        """Goes on from a checkpoint of the same scene. Returns its simulated time [s]."""
        with self._whole():
            answer = yield from self._call("load_checkpoint", path=path_of(path, "path"))
            self._begin_run(answer.stamp)
            return answer.time

    def solver_state(self):
        """Steps, energies, audit of momentum and so on, as in mpm_ros/SolverState, at the last sync point."""
        return self._latched("solver_state")

    # --- connections --------------------------------------------------------------------------------------------------

    def _name(self, relative):
        return self.namespace.rstrip("/") + "/" + relative

    def _alive(self):
        """Raises MpmError when the node cannot answer any more."""
        if self._process is None:
            raise MpmError(f"no simulator runs below {self.namespace}; start one with _pacing:=lockstep")
        if not self._process.runs():
            raise self._process.failure("it started")

    def _service(self, name):
        if self.closed:
            raise MpmError("this simulator is closed")
        if name not in self._connections or self._connections[name].closed:
            with self._failures("it was connected to"):
                uri = wire.wait_for_service(self._master, self._name(name), self._alive)
                self._connections[name] = wire.ServiceClient(self._name(name), _service_class(name), uri, self._caller)
        return self._connections[name]

    @contextlib.contextmanager
    def _whole(self):
        """For a call of several parts: where it is interrupted, by Ctrl-C for example, the next one asks for the state
        of things anew."""
        try:
            yield
        except MpmError:
            raise
        except BaseException:
            self._interrupted = True
            raise

    def _call(self, name, **fields):
        yield None
        interrupted = self._interrupted
        if interrupted and self._clouds is not None:
            self._follow_particles(self._particle_period)
        service = self._service(name)
        with self._failures(f"it was asked to {name.replace('_', ' ')}"):
            answer = yield from service.calling(**fields)
        if interrupted:
            # The node has answered, so the call that was interrupted is done.
            self.info = self._latched("run_info")
            self._interrupted = False
        if not answer.success:
            raise MpmError(answer.status_message if name == "set_state" else answer.message)
        return answer

    def _failures(self, doing):
        return _Failures(self, doing)

    def _topic(self, name):
        return self._name(name), _message_class(name), self._name("simulator"), self._master, self._caller

    def _reader(self, name):
        with self._failures(f"{name} was asked for"):
            return wire.TopicReader(*self._topic(name))

    def _latched(self, name):
        with self._failures(f"{name} was waited for"):
            return wire.latched(*self._topic(name))

    # --- particles ----------------------------------------------------------------------------------------------------

    def _check_particle_period(self):
        period, sync = self._particle_period, self.info.sync_period
        periods = round(period / sync)
        if periods < 1 or abs(periods * sync - period) > 1e-9 + 1e-6 * period:
            raise MpmError(f"particle_period is {period:g} s; it must be a whole number of sync periods of {sync:g} s "
                           "(time.sync of the scene)")
        self._cloud_period = periods * round(sync * 1e9)

    def _follow_particles(self, period):
        self._particle_period = period
        self._check_particle_period()
        if self._clouds is not None:
            self._clouds.close()
        self._particles = None
        self._clouds = self._connections["particles"] = self._reader("particles")
        # The node's one thread for connections has accepted the first before it answers the second. What was published
        # before, such as the snapshot of time zero, does not come.
        self._clouds_after = self._latched("solver_state").header.stamp
        self._first_cloud = None

    def _begin_run(self, stamp):
        """After a reset or a load: the node has published a snapshot of the state at `stamp`. What comes before it is
        of the run before; its stamps may be later (~reset_time "zero")."""
        self.info = self._latched("run_info")
        if self._clouds is not None:
            self._check_particle_period()  # another scene may have another sync period
        self._particles = None
        self._clouds_after = None
        self._first_cloud = stamp

    def _particles_at(self, stamp):
        """The last snapshot up to `stamp`, which may come after the answer to the step."""
        if self._clouds is None:
            return None
        due = stamp - (stamp - self.info.start) % self._cloud_period
        if self._clouds_after is not None and due <= self._clouds_after:
            return None
        while self._first_cloud is not None:
            cloud = self._receive_cloud()
            if cloud.header.stamp == self._first_cloud:
                self._particles, self._first_cloud = Particles(cloud, self.info.start), None
        while self._particles is None or self._particles.stamp < due:
            self._particles = Particles(self._receive_cloud(), self.info.start)
        return self._particles

    def _receive_cloud(self):
        with self._failures("its particles were waited for"):
            return self._clouds.receive(_CLOUD_PATIENCE)


class _Failures:
    """Turns a lost connection into the node's own sentence."""

    def __init__(self, simulator, doing):
        self._simulator = simulator
        self._doing = doing

    def __enter__(self):
        return self

    def __exit__(self, kind, error, _):
        if not isinstance(error, wire.LOST):
            return
        process = self._simulator._process
        self._simulator._closer()
        if process is not None:
            raise process.failure(self._doing) from error
        raise MpmError(f"the simulator below {self._simulator.namespace} is gone: {error}") from error


def _close(process, connections, master):
    for connection in connections.values():
        connection.close()
    close(master)
    if process is not None:
        process.end()


def _service_class(name):
    from std_srvs.srv import Trigger
    from . import srv
    return {"step": srv.Step, "reset": Trigger, "reset_with": srv.Reset, "set_state": srv.SetState,
            "save_checkpoint": srv.Checkpoint, "load_checkpoint": srv.Checkpoint}[name]


def _message_class(name):
    from sensor_msgs.msg import PointCloud2
    from . import msg
    return {"run_info": msg.RunInfo, "solver_state": msg.SolverState, "particles": PointCloud2}[name]
