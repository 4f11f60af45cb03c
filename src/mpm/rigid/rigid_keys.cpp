#include "mpm/rigid/rigid_keys.hpp"

namespace mpm {

const KeyTable<FreeDefinition>& free_keys() {
  using Free = FreeDefinition;
  static const auto velocity = KeyTable<Twist>("free").rows(
      {number("velocity", &Twist::linear, kVelocity, kAny,
              {"rest", "of the body's origin at the start, in the free directions", "[0, 0, -1]"})});
  static const auto force = KeyTable<Wrench>("free").rows(
      {number("force", &Wrench::force, kForce, kAny,
              {"none", "on the body's origin, world axes, until a wrench is commanded", "[2 N, 0, 0]"})});
  static const auto keys =
      KeyTable<Free>("rigid_bodies.free")
          .rows({number("mass", &Free::mass, kMass, or_unset(0.0, kPositive),
                        {"", "of the body; of a planar scene's whole thickness", "2 kg"}),
                 other<Free>("density", "density > 0", {"", "the mass then follows from the shape's volume", "7800"}),
                 other<Free>(
                     "inertia",
                     "moment of inertia > 0; in solid scenes three principal moments, or six: xx, yy, zz, yz, xz, xy",
                     {"from the shape, as a solid of uniform density; required where `centre` is given and the body "
                      "turns",
                      "about the centre of mass, body axes", "[0.1, 0.1, 0.2]"}),
                 number("centre", &Free::centre, kLength, kAny,
                        {"the shape's; the origin where both mass and inertia are given", "centre of mass, body axes",
                         "[0, 0, 0.02]"}),
                 other<Free>("axes", "list of `x` `y` `z` `rx` `ry` `rz`",
                             {"all that the geometry has",
                              "directions that are free; the others are prescribed. Translations and rotations are "
                              "along the world's axes. A plane has x, z and ry; an axisymmetric scene z; a line x",
                              "[z, ry]"})})
          .part(&Free::velocity, velocity)
          .rows({other<Free>("rotation_rate", "vector, rotation rate; in a plane one number",
                             {"none", "at the start, in the free directions", "[0, 0, 1]"})})
          .part(&Free::wrench, force)
          .rows({other<Free>("torque", "vector, energy; in a plane one number", {"none", "as `force`", "[0, 0, 0.1]"})})
          .one_of("mass", "density")
          .advise({{"center", "write centre"}, {"gravity", "gravity is the scene's"}});
  return keys;
}

const KeyTable<CollideDefinition>& collide_keys() {
  using Collide = CollideDefinition;
  static const auto keys =
      KeyTable<Collide>("rigid_bodies.collide")
          .rows({number("friction", &Collide::friction, kPlain, kNotNegative,
                        {"", "Coulomb friction against other bodies and walls; of two bodies the smaller one", "0.3"}),
                 other<Collide>("except", "list of rigid bodies",
                                {"none", "bodies that it passes through; a link is `robot/link`", "[rover/chassis]"})})
          .advise({{"restitution", "bodies do not rebound; leave it out"}});
  return keys;
}

const KeyTable<MotionLimits>& limit_keys() {
  using Limits = MotionLimits;
  constexpr Range kLimit = or_none(kPositive);
  static const auto keys =
      KeyTable<Limits>("rigid_bodies.limits")
          .rows(
              {number("speed", &Limits::speed, kVelocity, kLimit, {"", "of the body's origin", "0.5"}),
               number("rotation_rate", &Limits::rotation_rate, kAngularRate, kLimit, {"", "of the body", "90 deg/s"}),
               number("acceleration", &Limits::acceleration, kAcceleration, kLimit, {"", "of the body's origin", "2"}),
               number("rotation_acceleration", &Limits::rotation_acceleration, kAngularAcceleration, kLimit,
                      {"", "of the body", "360 deg/s^2"})})
          .advise({{"velocity", "write speed, of the body's origin in any direction"},
                   {"jerk", "limit the acceleration"},
                   {"force", "a rigid body moves as commanded, whatever the force"}});
  return keys;
}

}  // namespace mpm
