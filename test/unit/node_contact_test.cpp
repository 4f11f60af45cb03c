// Contact between materials at one node: normals, detection, areas, laws, interfaces, many materials. Expected values
// come from the formulas, evaluated by hand or written down independently in the test.
#include "mpm/contact/node_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/contact/pair_detection.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace node_contact_test {

using mpm::kPi;

NodeMaterial material(double mass, const Vec3& velocity, double volume = 1.0, const Vec3& gradient = Vec3::Zero()) {
  NodeMaterial m;
  m.mass = mass;
  m.velocity = velocity;
  m.volume = volume;
  m.gradient = gradient;
  return m;
}

NodePair frictional(int a, int b, const Vec3& normal, double coefficient, bool stick = false) {
  NodePair pair;
  pair.a = a;
  pair.b = b;
  pair.normals = {normal, normal};
  pair.friction.coefficient = coefficient;
  pair.friction.stick = stick;
  pair.touching = true;
  return pair;
}

// Method reference 8.1: the gradient g points out of its material, and n from a to b.
TEST(PairNormal, IsTheOneThatTheMethodNames) {
  const NodeMaterial a = material(1, Vec3::Zero(), 3.0, {1, 0, 0});
  const NodeMaterial b = material(1, Vec3::Zero(), 1.0, {0, 0, -2});
  const auto normal = [&](NormalMethod method) { return pair_normals({method, 1.0}, a, b).of_a; };
  EXPECT_EQ(normal(NormalMethod::larger_gradient), Vec3(0, 0, 1));  // b's is longer
  EXPECT_EQ(normal(NormalMethod::larger_volume), Vec3(1, 0, 0));    // a has more volume
  // (3 (1,0,0) - 1 (0,0,-2)) / 4 is along (3, 0, 2)
  EXPECT_LT((normal(NormalMethod::average) - Vec3(3, 0, 2) / std::sqrt(13.0)).norm(), 1e-15);
  const PairNormals own = pair_normals({NormalMethod::own, 1.0}, a, b);
  EXPECT_EQ(own.of_a, Vec3(1, 0, 0));
  EXPECT_EQ(own.of_b, Vec3(0, 0, 1));
}

// Manual, Normals: the normal is that of the rigid side unless the other candidate is longer by more than the bias.
TEST(PairNormal, LeansToTheRigidSide) {
  NodeMaterial a = material(1, Vec3::Zero(), 1.0, {4, 0, 0});
  NodeMaterial b = material(1, Vec3::Zero(), 1.0, {0, 0, -1});
  b.rigid = true;
  const auto normal = [&](NormalMethod method, double bias) { return pair_normals({method, bias}, a, b).of_a; };
  EXPECT_EQ(normal(NormalMethod::larger_gradient, 3.9), Vec3(1, 0, 0));
  EXPECT_EQ(normal(NormalMethod::larger_gradient, 4.1), Vec3(0, 0, 1));
  // The average is (2, 0, 1/2), sqrt(4.25) = 2.06 long.
  EXPECT_GT(normal(NormalMethod::average, 2.0).x(), 0.9);
  EXPECT_EQ(normal(NormalMethod::average, 2.1), Vec3(0, 0, 1));
  EXPECT_EQ(normal(NormalMethod::larger_volume, 100.0), Vec3(1, 0, 0));  // ignores the bias
  std::swap(a, b);
  EXPECT_EQ(normal(NormalMethod::larger_gradient, 4.1), Vec3(0, 0, -1));
}

// Nairn & Guilkey (2015) section 3.3. Two symmetry planes give three images. A gradient that is only round-off after
// mirroring gives no normal.
TEST(PairNormal, MirrorsTakeTheirComponentAndDoubleTheVolume) {
  const GridLayout space(3, Vec3::Constant(0.1), Vec3::Zero(), Vec3::Ones());
  NodeMaterial a = material(1, Vec3::Zero(), 1.5, {3, 2, 1});
  a.start_volume = 1.5;
  mirror(a, space, {true, false, false});
  EXPECT_EQ(a.gradient, Vec3(0, 2, 1));
  EXPECT_EQ(a.start_volume, 3.0);
  EXPECT_EQ(a.volume, 1.5);
  mirror(a, space, {true, true, false});
  EXPECT_EQ(a.gradient, Vec3(0, 0, 1));
  EXPECT_EQ(a.start_volume, 12.0);
  const GridLayout plane(2, Vec3::Constant(0.1), Vec3::Zero(), Vec3::Ones());  // the grid's second axis is z
  NodeMaterial b = material(1, Vec3::Zero(), 1.0, {1e-16, 0, 2});
  mirror(b, plane, {false, true, false});
  EXPECT_EQ(b.gradient, Vec3::Zero());
}

// Two half spaces of particles, two along a cell's edge, that touch at distance d from a node. Method reference 8.2
// gives the distance of their mean positions as 0.750 cells with the surface at the node and 0.857 in mid-cell, and 8.4
// the area as 1 - d/h.
struct HalfSpaces {
  NodeMaterial a, b;
};
HalfSpaces touching_at(double d) {
  HalfSpaces sides;
  const auto add = [](NodeMaterial& side, double x) {
    // uGIMP by quadrature: the mean of the hat function over the particle's half cell.
    double s = 0.0;
    constexpr int kPoints = 2000;
    for (int i = 0; i < kPoints; ++i) {
      s += std::max(0.0, 1.0 - std::abs(x + 0.5 * ((i + 0.5) / kPoints - 0.5))) / kPoints;
    }
    side.mass += s;
    side.volume += 0.5 * s;
    side.place.x() += s * x;
  };
  for (int i = 0; i < 6; ++i) {
    add(sides.a, d - 0.25 - 0.5 * i);
    add(sides.b, d + 0.25 + 0.5 * i);
  }
  sides.a.place /= sides.a.mass;
  sides.b.place /= sides.b.mass;
  return sides;
}

TEST(PairDetection, ReadsTouchingFacesAsTheReferenceDoes) {
  DetectionRule rule;
  rule.position = 0.0;
  for (const auto& [d, apart] : {std::pair{0.0, 0.750}, {0.5, 0.857}, {-0.5, 0.857}}) {
    const HalfSpaces sides = touching_at(d);
    // The numbers of the reference have three digits.
    EXPECT_NEAR(separation(rule, sides.a, sides.b, Vec3::UnitX(), 1.0), apart, 5e-4) << d;
  }
  rule.position = 0.8;
  EXPECT_LT(separation(rule, touching_at(0.0).a, touching_at(0.0).b, Vec3::UnitX(), 1.0), 0.0);
  // Displacements need no correction.
  rule.kind = Detection::displacements;
  NodeMaterial a, b;
  b.place = {0.01, 0, 0.3};
  EXPECT_DOUBLE_EQ(separation(rule, a, b, Vec3::UnitX(), 1.0), 0.01);
}

TEST(PairDetection, AreaOfAPlaneFallsLinearlyWithDistance) {
  for (const double d : {0.0, 0.25, 0.5, 0.75}) {
    const HalfSpaces sides = touching_at(d);
    // The formula is exact for the hat function. uGIMP smooths the volumes over its box, most at d = 0.75 (measured:
    // 0.037).
    EXPECT_NEAR(contact_area(sides.a.volume, sides.b.volume, 1.0), 1.0 - d, 0.04) << d;
    const double far = 0.5 * (1 - d) * (1 - d);
    EXPECT_NEAR(contact_area(1.0 - far, far, 1.0), 1.0 - d, 1e-15);
  }
}

TEST(PairDetection, WidthAlongAnAxisIsItsEdge) {
  const GridLayout layout(3, {0.1, 0.2, 0.4}, Vec3::Zero(), {1.0, 1.0, 1.2});
  EXPECT_NEAR(across_cell(layout, Vec3::UnitX()), 0.1, 1e-16);
  EXPECT_NEAR(across_cell(layout, Vec3::UnitZ()), 0.4, 1e-16);
  const GridLayout cubes(3, {0.1, 0.1, 0.1}, Vec3::Zero(), {1.0, 1.0, 1.0});
  EXPECT_NEAR(across_cell(cubes, Vec3(1, 2, 3).normalized()), 0.1, 1e-15);
}

// Method reference 8.3. The stick impulse has N = -4 (pressed) and T = 3.
TEST(PairLaw, CoulombHoldsSlidesAndLetsGo) {
  const Vec3 normal = Vec3::UnitZ(), stick(3, 0, -4);
  FrictionLaw law;
  EXPECT_EQ(coulomb_impulse(stick, normal, law, 0.0).on_a, Vec3(0, 0, -4));  // smooth
  law.coefficient = 0.5;
  EXPECT_LT((coulomb_impulse(stick, normal, law, 0.0).on_a - Vec3(2, 0, -4)).norm(), 1e-15);
  EXPECT_EQ(coulomb_impulse(stick, normal, law, 0.0).hold, PairHold::normal);
  law.coefficient = 0.76;
  EXPECT_EQ(coulomb_impulse(stick, normal, law, 0.0).on_a, stick);
  law.coefficient = 0.5;
  law.static_coefficient = 0.76;  // not enough to start sliding
  EXPECT_EQ(coulomb_impulse(stick, normal, law, 0.0).on_a, stick);
  law.static_coefficient = 0.74;  // starts, and slides with the sliding friction
  EXPECT_LT((coulomb_impulse(stick, normal, law, 0.0).on_a - Vec3(2, 0, -4)).norm(), 1e-15);
  law.stick = true;
  EXPECT_EQ(coulomb_impulse(stick, normal, law, 0.0).on_a, stick);
  EXPECT_EQ(coulomb_impulse(-stick, normal, law, 0.0).on_a, Vec3::Zero());  // separating: no impulse
}

TEST(PairLaw, AdhesionBearsTensionUpToItsStrengthAndShearBesideFriction) {
  const Vec3 normal = Vec3::UnitZ(), pull(0, 0, 2);
  FrictionLaw law;
  law.coefficient = 0.5;
  EXPECT_EQ(coulomb_impulse(pull, normal, law, 2.001).on_a, pull);
  EXPECT_EQ(coulomb_impulse(pull, normal, law, 1.999).on_a, Vec3::Zero());
  EXPECT_EQ(coulomb_impulse({3, 0, -4}, normal, law, 1.001).on_a, Vec3(3, 0, -4));  // 0.5 x 4 + 1.001 > 3
  EXPECT_LT((coulomb_impulse({3, 0, -4}, normal, law, 0.5).on_a - Vec3(2.5, 0, -4)).norm(), 1e-15);
}

// Heat = mu |N| (2 T - mu |N|) / (2 m_red), method reference 8.3, which equals the loss of kinetic energy of the
// tangential motion.
TEST(NodeContact, FrictionTakesTheKineticEnergyOfSliding) {
  const double mu = 0.5;
  std::vector<NodeMaterial> m = {material(2, {0, 0, 3}), material(6, {4, 0, -1})};
  std::vector<NodePair> pairs = {frictional(0, 1, Vec3::UnitZ(), mu)};
  const auto tangential_energy = [&] {
    return 0.5 * m[0].mass * m[0].velocity.x() * m[0].velocity.x() +
           0.5 * m[1].mass * m[1].velocity.x() * m[1].velocity.x();
  };
  const double before = tangential_energy();
  solve_contact(m, pairs, 1.0);
  const double reduced = 1.5, n = reduced * 4, t = reduced * 4;
  EXPECT_NEAR(pairs[0].friction_energy, mu * n * (2 * t - mu * n) / (2 * reduced), 1e-14);
  EXPECT_NEAR(pairs[0].friction_energy, before - tangential_energy(), 1e-14);
  EXPECT_NEAR(m[0].velocity.z(), m[1].velocity.z(), 1e-15);
}

TEST(NodeContact, RigidMaterialGivesWithoutMoving) {
  std::vector<NodeMaterial> m = {material(2, {0, 0, -3}), material(1, {1, 0, 0})};
  m[1].rigid = true;
  std::vector<NodePair> pairs = {frictional(0, 1, -Vec3::UnitZ(), 0.0, true)};
  solve_contact(m, pairs, 1.0);
  EXPECT_LT((m[0].velocity - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(m[1].velocity, Vec3(1, 0, 0));
  EXPECT_LT((pairs[0].on_a - Vec3(2, 0, 6)).norm(), 1e-14);
}

Vec3 momentum(const std::vector<NodeMaterial>& materials) {
  Vec3 sum = Vec3::Zero();
  for (const NodeMaterial& m : materials) sum += m.momentum();
  return sum;
}

// Three materials in a row that press on each other: the perfectly inelastic impact of all three.
TEST(NodeContact, ThreeInARowShareTheirMomentum) {
  std::vector<NodeMaterial> m = {material(1, {3, 0, 0}), material(2, {0, 0, 0}), material(5, {-1, 0, 0})};
  std::vector<NodePair> pairs = {frictional(0, 1, Vec3::UnitX(), 0.0), frictional(0, 2, Vec3::UnitX(), 0.0),
                                 frictional(1, 2, Vec3::UnitX(), 0.0)};
  const double common = (3.0 - 5.0) / 8.0;
  solve_contact(m, pairs, 1.0);
  for (const NodeMaterial& one : m) EXPECT_NEAR(one.velocity.x(), common, 1e-13);
}

// A material that moves away is not pulled, even if another one pushes it first.
TEST(NodeContact, ThirdThatMovesAwayIsNotPulled) {
  std::vector<NodeMaterial> m = {material(1, {1, 0, 0}), material(1, {0, 0, 0}), material(1, {2, 0, 0})};
  std::vector<NodePair> pairs = {frictional(0, 1, Vec3::UnitX(), 0.0), frictional(1, 2, Vec3::UnitX(), 0.0)};
  solve_contact(m, pairs, 1.0);
  EXPECT_NEAR(m[0].velocity.x(), 0.5, 1e-15);
  EXPECT_NEAR(m[1].velocity.x(), 0.5, 1e-15);
  EXPECT_EQ(m[2].velocity, Vec3(2, 0, 0));
  EXPECT_EQ(pairs[1].hold, PairHold::none);
}

// Random sets of three and four materials: momentum is conserved to round-off, every pair's total impulse lies in its
// friction cone, no pair approaches, a pair slides only at the friction limit, and no energy is created.
TEST(NodeContact, ManyMaterialsKeepEveryLawAndMomentum) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 3 + trial % 2;
    const double mu = 0.1 * (trial % 7);
    std::vector<NodeMaterial> m;
    std::vector<NodePair> pairs;
    std::vector<Vec3> places;
    for (int i = 0; i < count; ++i) {
      m.push_back(material(1.0 + 2.0 * std::abs(unit(random)), {unit(random), unit(random), unit(random)}));
      places.emplace_back(unit(random), unit(random), unit(random));
    }
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        pairs.push_back(frictional(a, b, (places[b] - places[a]).normalized(), mu));
      }
    }
    const Vec3 before = momentum(m);
    double energy = 0.0, after = 0.0;
    for (const NodeMaterial& one : m) energy += 0.5 * one.mass * one.velocity.squaredNorm();
    const int sweeps = solve_contact(m, pairs, 1.0);
    for (const NodeMaterial& one : m) after += 0.5 * one.mass * one.velocity.squaredNorm();
    EXPECT_LT((momentum(m) - before).norm(), 1e-13);  // some hundred additions of numbers of the order of 1
    EXPECT_LE(after, energy * (1.0 + 1e-12));
    EXPECT_LE(sweeps, kMostNodeSweeps);
    for (const NodePair& pair : pairs) {
      const double n = pair.on_a.dot(pair.normals.of_a);
      const Vec3 t = pair.on_a - n * pair.normals.of_a;
      const Vec3 relative = m[pair.b].velocity - m[pair.a].velocity;
      const double opening = relative.dot(pair.normals.of_a);
      EXPECT_LE(n, 0.0);
      EXPECT_LE(t.norm(), -mu * n + 1e-12);
      // Sweeps end when they change nothing, or after kMostNodeSweeps for the slowest combinations.
      EXPECT_GT(opening, -1e-6) << "trial " << trial << " sweeps " << sweeps;
      EXPECT_LT(std::abs(n * opening), 1e-6);
    }
  }
}

TEST(NodeContact, OwnNormalsActOnEachSideAlone) {
  std::vector<NodeMaterial> m = {material(1, {0, 0, 1}), material(1, {0, 0, -1})};
  NodePair pair = frictional(0, 1, Vec3::UnitZ(), 0.0);
  pair.normals.of_b = Vec3(0.6, 0, 0.8);
  pair.opposite = false;
  std::vector<NodePair> pairs = {pair};
  solve_contact(m, pairs, 1.0);
  EXPECT_LT((pairs[0].on_a - Vec3(0, 0, -1)).norm(), 1e-15);           // -1 along z
  EXPECT_LT((pairs[0].on_b - 0.8 * Vec3(0.6, 0, 0.8)).norm(), 1e-15);  // (0, 0, 1) along its own normal
}

TEST(NodeContact, HeldPairsMoveAsOneWithTheirMomentum) {
  std::vector<NodeMaterial> m = {material(1, {1, 0, 4}), material(3, {2, 0, 8})};
  std::vector<NodePair> pairs = {frictional(0, 1, Vec3::UnitZ(), 0.0)};
  pairs[0].keep = PairHold::normal;  // although they separate
  solve_contact(m, pairs, 1.0);
  EXPECT_LT((m[0].velocity - Vec3(1, 0, 7)).norm(), 1e-15);
  EXPECT_LT((m[1].velocity - Vec3(2, 0, 7)).norm(), 1e-15);
  pairs[0].keep = PairHold::both;
  solve_contact(m, pairs, 1.0);
  EXPECT_LT((m[0].velocity - Vec3(1.75, 0, 7)).norm(), 1e-15);
  EXPECT_LT((m[1].velocity - Vec3(1.75, 0, 7)).norm(), 1e-15);
}

// An oscillator that moves as particles do: by the mean of the velocities before and after.
struct Oscillator {
  double opening, velocity;
};
Oscillator step(const InterfaceLaw& law, Oscillator s, double mass, double area, double dt) {
  const PairImpulse impulse =
      interface_impulse(law, {Vec3(s.opening, 0, 0), area, mass}, Vec3(mass * s.velocity, 0, 0), Vec3::UnitX(), dt);
  const double after = s.velocity - impulse.on_a.x() / mass;
  return {s.opening + 0.5 * dt * (s.velocity + after), after};
}

TEST(PairInterface, OscillatesWithItsPeriodAndLosesWhatItsNoteSays) {
  const double mass = 2.0, area = 0.5, stiffness = 400.0, omega = std::sqrt(area * stiffness / mass);
  const InterfaceLaw law{stiffness, stiffness, 0.0};
  const double dt = 0.1 / omega;
  Oscillator s{1.0, 0.0};
  int zeros = 0, step_count = 0, last = 0;
  const auto energy = [&] {
    return 0.5 * area * stiffness * s.opening * s.opening + 0.5 * mass * s.velocity * s.velocity;
  };
  const double start = energy();
  for (; step_count < 629; ++step_count) {  // ten periods
    const Oscillator next = step(law, s, mass, area, dt);
    if (next.opening * s.opening < 0.0) {
      ++zeros;
      last = step_count;
    }
    s = next;
  }
  EXPECT_EQ(zeros, 20);
  // The last of 20 zeros, at 39/4 periods; the method's phase error is (omega dt)^2 / 24 and a step is 1.6 % of a
  // period.
  EXPECT_NEAR(last * dt * omega / (2 * kPi), 9.75, 0.02);
  // The loss is (omega dt)^3 pi / 4 in each of ten periods, to leading order; energy varies by omega dt / 2 in a
  // period.
  EXPECT_NEAR(energy() / start, 1.0 - 10 * 1e-3 * kPi / 4, 0.05);
}

// At any stiffness the opening and dt times the velocity do not grow, in a norm that may rise slightly once.
TEST(PairInterface, IsStableAtAnyStiffness) {
  for (const double k : {1e-3, 1.0, 4.0, 100.0, 1e6, 1e12}) {  // K = (omega dt)^2
    const InterfaceLaw law{k, k, 0.0};
    Oscillator s{1.0, 1.0};
    double most = 0.0;
    for (int n = 0; n < 5000; ++n) {
      s = step(law, s, 1.0, 1.0, 1.0);
      if (n >= 4000) most = std::max(most, std::abs(s.opening));
    }
    // |lambda|^2 = (1 + K/2) / (1 + beta K): resolved oscillations go on; others decay long before 4000 steps.
    const double beta = 0.5 + k / (2 * k + 8);
    const double kept = std::pow((1 + 0.5 * k) / (1 + beta * k), 2000.0);
    EXPECT_LT(most, 1e-12 + 40.0 * kept) << k;  // 40: u = 1 / sqrt(K) of w = 1 at K = 1e-3
  }
}

TEST(PairInterface, PerfectDirectionsStick) {
  const Vec3 stick(3, 0, -4), normal = Vec3::UnitZ();
  const InterfaceState closed{Vec3(0, 0, -1e-6), 1.0, 1.0};
  // Perfect while closed: the interface presses, and does not pull.
  EXPECT_EQ(interface_impulse({10.0, -1.0, 0.0}, closed, stick, normal, 0.1).on_a, Vec3(0, 0, -4));
  EXPECT_EQ(interface_impulse({10.0, -1.0, 0.0}, closed, -stick, normal, 0.1).on_a, Vec3::Zero());
  // Perfect in all directions: the interface sticks in tension and in compression.
  const PairImpulse all = interface_impulse({-1.0, -1.0, -1.0}, closed, -stick, normal, 0.1);
  EXPECT_EQ(all.on_a, -stick);
  EXPECT_EQ(all.hold, PairHold::both);
  EXPECT_EQ(interface_impulse({0.0, 0.0, -1.0}, closed, stick, normal, 0.1).hold, PairHold::tangential);
}

TEST(PairInterface, StoresTheEnergyOfItsOpening) {
  // The impulse is traction times area times dt, for an opening of (0.3, 0, 0.2) m.
  const InterfaceState state{Vec3(0.3, 0, 0.2), 2.0, 1.0};
  const double dt = 1e-3;
  const Vec3 impulse = 2.0 * dt * Vec3(50.0 * 0.3, 0, 100.0 * 0.2);
  EXPECT_NEAR(interface_energy({100.0, -1.0, 50.0}, state, impulse, Vec3::UnitZ(), dt),
              0.5 * 2 * (100 * 0.04 + 50 * 0.09), 1e-14);
  EXPECT_NEAR(interface_energy({100.0, -1.0, 50.0}, state, impulse, -Vec3::UnitZ(), dt), 0.5 * 2 * (50 * 0.09), 1e-14);
}

}  // namespace node_contact_test
}  // namespace mpm
