#include "mpm/crack/crack_contact.hpp"

#include <algorithm>

#include "mpm/contact/pair_detection.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {
namespace {

constexpr int kMembers = DividedNode::kFields;

Vec3 mean_of(const NodalField& sums, const GridLayout& layout, const ContactNodes::Member& member) {
  return nodal_vector(sums, layout, member.ref) / member.mass;
}

/// Whether the faces of a crack act on each other.
bool meets(const Crack& crack) { return crack.felt && !crack.definition.faces.ignored; }

/// On which side of a crack the material of field 3 lies.
bool both_above(const DividedNode& node, int crack) {
  return node.both[0].crack == crack ? node.both[0].above : node.both[1].above;
}

}  // namespace

CrackContact::CrackContact(const std::vector<Crack>& cracks, const CrackFields& chosen, Fields& fields,
                           VolumeSurvey& survey, GeometryKind geometry, int threads)
    : cracks_(cracks),
      chosen_(chosen),
      fields_(fields),
      survey_(survey),
      geometry_(geometry),
      nodes_(fields, threads),
      volumes_(fields.size(), NodalVolumes(fields.front()->layout.dim(), fields.front()->layout.nodes_per_block())),
      marks_(fields.size()),
      friction_(cracks.size()),
      friction_energy_(cracks.size(), 0.0),
      interface_energy_(cracks.size(), 0.0) {
  wants_.position = wants_.displacement = wants_.slope = true;
  nodes_.blocks.resize(1);
}

void CrackContact::momentum_gathered(StepContext& context) {
  ContactNodes::Block& found = nodes_.blocks.front();
  found.clear();
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const CrackDefinition& crack = cracks_[c].definition;
    friction_[c] = crack.faces.law.in_step(context.start, context.dt, [&] { return "crack '" + crack.name + "'"; });
  }
  if (chosen_.nodes().empty()) return;
  survey_nodes();
  for (const DividedNode& node : chosen_.nodes()) add_node(node, context.dt);
}

void CrackContact::survey_nodes() {
  for (std::size_t f = 0; f < fields_.size(); ++f) marks_[f].assign(fields_[f]->blocks.size(), 0);
  std::vector<bool> any(fields_.size(), false);
  for (const DividedNode& node : chosen_.nodes()) {
    for (int f = 0; f < kMembers; ++f) {
      if (node.ref[f].block < 0) continue;
      marks_[node.first + f][node.ref[f].block] = 1;
      any[node.first + f] = true;
    }
  }
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    if (any[f]) survey_.survey(static_cast<int>(f), marks_[f], wants_, volumes_[f]);
  }
}

NodeMaterial CrackContact::material_at(const ContactNodes::Member& member, const Vec3& position) const {
  const NodalVolumes& volumes = volumes_[member.field];
  const GridLayout& layout = fields_.front()->layout;
  NodeMaterial material;
  material.mass = member.mass;
  material.velocity = nodal_vector(fields_[member.field]->velocity, layout, member.ref);
  material.volume = volumes.volume.at(member.ref.block, 0, member.ref.node);
  material.place = mean_of(volumes.position, layout, member);
  material.displacement = mean_of(volumes.displacement, layout, member);
  const Vec3 to_node = position - material.place;
  for (int c = 0; c < layout.dim(); ++c) {
    material.displacement[layout.axis(c)] += mean_of(volumes.slope[c], layout, member).dot(to_node);
  }
  return material;
}

void CrackContact::add_node(const DividedNode& divided, double dt) {
  ContactNodes::Block& found = nodes_.blocks.front();
  const GridLayout& layout = fields_.front()->layout;
  ContactNodes::Node node{};
  node.first_member = static_cast<int>(found.members.size());
  std::array<int, kMembers> group{};
  for (int f = 0; f < kMembers; ++f) {
    const NodeRef ref = divided.ref[f];
    group[f] = -1;
    if (ref.block < 0) continue;
    const Grid& grid = *fields_[divided.first + f];
    if (!grid.carries(ref.block, ref.node)) continue;
    group[f] = node.members++;
    found.members.push_back({divided.first + f, ref, grid.mass.at(ref.block, 0, ref.node), group[f]});
  }
  node.groups = node.members;
  node.id = static_cast<std::uint64_t>(divided.first) * layout.keys() * 64 +
            HeldNodes::id(fields_[divided.first]->blocks.key(divided.ref[0].block), divided.ref[0].node);
  node.position = Vec3(divided.place[0], 0.0, divided.place[1]);
  node.first_pair = static_cast<int>(found.pairs.size());
  found.materials.resize(found.members.size());
  for (int m = 0; m < node.members; ++m) {
    found.materials[node.first_member + m] = material_at(found.members[node.first_member + m], node.position);
  }
  found.nodes.push_back(node);  // for add_pair()
  const std::array<AcrossCrack, 2>& single = divided.single;
  const auto add = [&](int of, int own, int across, bool across_is_above) {
    if (group[own] < 0 || group[across] < 0 || single[of].crack < 0 || !meets(cracks_[single[of].crack])) return;
    const int above = across_is_above ? across : own, below = across_is_above ? own : across;
    add_pair(single[of].crack, group[above], group[below], divided.normal[of], dt);
  };
  for (int of = 0; of < 2; ++of) {
    add(of, 0, 1 + of, single[of].above);
    const bool in_both = divided.both[0].crack == single[of].crack || divided.both[1].crack == single[of].crack;
    if (in_both) add(of, 2 - of, 3, both_above(divided, single[of].crack));
  }
  ContactNodes::Node& added = found.nodes.back();
  added.pairs = static_cast<int>(found.pairs.size()) - added.first_pair;
  if (added.pairs == 0) {
    found.nodes.pop_back();
    found.members.resize(node.first_member);
    found.materials.resize(node.first_member);
    return;
  }
}

void CrackContact::add_pair(int crack, int above, int below, const Vec2& normal, double dt) {
  ContactNodes::Block& found = nodes_.blocks.front();
  const GridLayout& layout = fields_.front()->layout;
  const ContactNodes::Node& node = found.nodes.back();
  const NodeMaterial &a = found.materials[node.first_member + above], &b = found.materials[node.first_member + below];
  const double length = normal.norm();
  if (!(length > 0.0)) return;
  const CrackFaces& faces = cracks_[crack].definition.faces;
  ContactNodes::PairOfNode pair{};
  pair.rule = crack;
  pair.fields = found.members[node.first_member + above].field * static_cast<int>(fields_.size()) +
                found.members[node.first_member + below].field;
  NodePair& state = pair.state;
  state.a = above;
  state.b = below;
  state.normals.of_a = state.normals.of_b = Vec3(normal[0], 0.0, normal[1]) / length;
  state.friction = friction_[crack];
  state.hold = nodes_.held(node.id, pair.fields);
  const Vec3& across = state.normals.of_a;
  const double cell = across_cell(layout, across);
  state.area = contact_area(a.volume, b.volume, cell) * around_axis(geometry_, layout, node.position);
  if (faces.law.kind == ContactLaw::Kind::interface) {
    state.interface = &faces.law.interface;
    state.opening = b.displacement - a.displacement;
  } else {
    const bool by_position = faces.detection == CrackFaces::Detection::positions;
    const double apart = by_position ? (b.place - a.place).dot(across) - faces.position * cell
                                     : (b.displacement - a.displacement).dot(across);
    state.touching = apart + dt * (b.velocity - a.velocity).dot(across) < 0.0;
    if (state.hold != PairHold::none || !started_) state.bond = state.friction.adhesion * state.area * dt;
  }
  found.pairs.push_back(pair);
}

void CrackContact::momentum_updated(StepContext& context) {
  nodes_.update(context.dt);
  started_ = true;
  std::fill(interface_energy_.begin(), interface_energy_.end(), 0.0);
  for (const ContactNodes::PairOfNode& pair : nodes_.blocks.front().pairs) {
    const NodePair& state = pair.state;
    friction_energy_[pair.rule] += state.friction_energy;
    if (state.interface == nullptr) continue;
    interface_energy_[pair.rule] += mpm::interface_energy(*state.interface, {state.opening, state.area, 0.0},
                                                          state.on_a, state.normals.of_a, context.dt);
  }
}

void CrackContact::energies(EnergyReport& report) const {
  report.leave_open();  // motion that faces hold up is not counted
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    report.add("crack_friction", NamedEnergy::Kind::dissipated, friction_energy_[c]);
    report.add("crack_interface", NamedEnergy::Kind::stored, interface_energy_[c]);
  }
}

void CrackContact::serialise(StateArchive& archive) {
  archive.value("started", started_);
  nodes_.serialise(archive);
  archive.list("friction_energy", friction_energy_);
  archive.list("interface_energy", interface_energy_);
}

}  // namespace mpm
