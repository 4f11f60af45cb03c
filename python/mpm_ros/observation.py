"""What a step of a Simulator answers: bodies, robots, particles."""


class Body:
    """A rigid body after a step. Arrays are views of the node's answer; world axes, torques about the body's origin.

    name
    position, orientation    (3,) [m], (4,) unit quaternion x, y, z, w
    velocity, rotation_rate  (3,) [m/s] of the origin, (3,) [rad/s]
    force, torque            (3,) [N], (3,) [N m]: of the material on the body, mean of the step
    peak_force, peak_torque  (3,) in that step of the solver with the largest force
    impulse                  (3,) [N s] since the run's start
    state, contact           all fields, as in mpm_ros/BodyState and mpm_ros/ContactForce
    """

    def __init__(self, state, contact):
        self.name = state.name
        self.position, self.orientation = state.pose[:3], state.pose[3:]
        self.velocity, self.rotation_rate = state.twist[:3], state.twist[3:]
        self.force, self.torque = contact.wrench[:3], contact.wrench[3:]
        self.peak_force, self.peak_torque = contact.peak[:3], contact.peak[3:]
        self.impulse = contact.impulse
        self.state = state
        self.contact = contact


class Robot:
    """A robot after a step; arrays have a value for each of `joints`.

    name, joints             of the robot, and of all its joints that move
    position, velocity       (n,) [m] or [rad], [m/s] or [rad/s]
    effort                   (n,) [N] or [N m] of the drives, mean of the step
    base_position, base_orientation  (3,) [m], (4,) unit quaternion x, y, z, w
    base_velocity, base_rotation_rate  (3,) [m/s], (3,) [rad/s]; world axes
    """

    def __init__(self, state):
        self.name, self.joints = state.name, state.joints
        self.position, self.velocity, self.effort = state.position, state.velocity, state.effort
        self.base_position, self.base_orientation = state.base[:3], state.base[3:]
        self.base_velocity, self.base_rotation_rate = state.base_twist[:3], state.base_twist[3:]


class Observation:
    """What a step answers.

    time       [s] simulated since the run's start
    stamp      [ns] of the state reached
    ended      whether the scene's end is reached; `reset` begins again
    bodies     dict: name to Body; a robot's link is <robot>/<link>
    robots     dict: name to Robot
    pairs      list: contacts between deformable bodies, as in mpm_ros/ContactPair
    particles  Particles: the last snapshot up to `time`, at multiples of `particle_period`. None without that, and
               before the first that comes: that of time zero is sent before anybody listens, except after a reset
    """

    def __init__(self, answer, particles):
        self.time = answer.time
        self.stamp = answer.stamp
        self.ended = "the run has ended" in answer.message
        contacts = {contact.name: contact for contact in answer.contact_forces.bodies}
        self.bodies = {state.name: Body(state, contacts[state.name]) for state in answer.bodies.bodies}
        self.robots = {state.name: Robot(state) for state in answer.robots}
        self.pairs = answer.contact_forces.pairs
        self.particles = particles

    def __getitem__(self, body):
        """The body of that name."""
        if body not in self.bodies:
            raise KeyError(f"there is no rigid body '{body}'; there are {', '.join(self.bodies) or 'none'}")
        return self.bodies[body]
