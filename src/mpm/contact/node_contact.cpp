#include "mpm/contact/node_contact.hpp"

#include <algorithm>

namespace mpm {
namespace {

// Part of the largest velocity difference that round-off leaves.
constexpr double kSettled = 1e-15;

PairImpulse law_of(const NodePair& pair, const Vec3& stick, const Vec3& normal, double mass, double dt) {
  if (pair.keep != PairHold::none) return {kept_part(stick, normal, pair.keep), pair.keep};
  if (pair.interface != nullptr) {
    return interface_impulse(*pair.interface, {pair.opening, pair.area, mass}, stick, normal, dt);
  }
  if (!pair.touching) return {};
  return coulomb_impulse(stick, normal, pair.friction, pair.bond);
}

void push(NodeMaterial& material, const Vec3& impulse) {
  if (!material.rigid) material.velocity += impulse / material.mass;
}

// Returns the change of relative velocity that it made [m/s].
double act(std::vector<NodeMaterial>& materials, NodePair& pair, double dt) {
  NodeMaterial &a = materials[pair.a], &b = materials[pair.b];
  if (pair.normals.of_a.isZero(0.0)) return 0.0;
  const double mass = reduced_mass(a, b);
  const Vec3 stick = pair.on_a + mass * (b.velocity - a.velocity);
  const PairImpulse impulse = law_of(pair, stick, pair.normals.of_a, mass, dt);
  const Vec3 more = impulse.on_a - pair.on_a;
  pair.hold = impulse.hold;
  pair.on_a = impulse.on_a;
  push(a, more);
  if (pair.opposite) {
    pair.on_b = -impulse.on_a;
    push(b, -more);
  } else {
    const Vec3 on_b = -law_of(pair, stick, pair.normals.of_b, mass, dt).on_a;
    push(b, on_b - pair.on_b);
    pair.on_b = on_b;
  }
  return more.norm() / mass;
}

void find_friction(const std::vector<Vec3>& before, const std::vector<NodeMaterial>& materials, NodePair& pair) {
  pair.friction_energy = 0.0;
  if (pair.hold != PairHold::normal || pair.interface != nullptr || pair.keep != PairHold::none) return;
  const Vec3 tangential = pair.on_a - pair.on_a.dot(pair.normals.of_a) * pair.normals.of_a;
  const Vec3 start = pair.start_slip.value_or(before[pair.b] - before[pair.a]);
  pair.friction_energy = 0.5 * tangential.dot(start + materials[pair.b].velocity - materials[pair.a].velocity);
}

}  // namespace

int solve_contact(std::vector<NodeMaterial>& materials, std::vector<NodePair>& pairs, double dt) {
  std::vector<Vec3> before;
  before.reserve(materials.size());
  double scale = 0.0;
  for (const NodeMaterial& material : materials) {
    before.push_back(material.velocity);
    scale = std::max(scale, (material.velocity - materials.front().velocity).norm());
  }
  // One pair has said all in one go; normals that differ leave a relative velocity that no second go can mend.
  const bool once =
      pairs.size() == 1 || std::any_of(pairs.begin(), pairs.end(), [](const NodePair& pair) { return !pair.opposite; });
  int sweeps = 0;
  for (double change = 1.0; change > kSettled * scale && sweeps < kMostNodeSweeps; ++sweeps) {
    change = 0.0;
    for (NodePair& pair : pairs) change = std::max(change, act(materials, pair, dt));
    scale = std::max(scale, change);
    if (once) change = 0.0;
  }
  for (NodePair& pair : pairs) find_friction(before, materials, pair);
  return sweeps;
}

}  // namespace mpm
