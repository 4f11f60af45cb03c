#include "mpm/crack/crack_contact.hpp"

#include <algorithm>

#include "mpm/contact/pair_detection.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {
namespace {

constexpr int kMembers = DividedNode::kFields;
/// Faces that lie on each other to round-off touch [cells].
constexpr double kTouch = 1e-12;

/// True if what lies across this crack acts on what does not; a tool's number is no crack's.
bool meets(const std::vector<Crack>& cracks, const AcrossCrack& across) {
  if (across.crack < 0 || across.crack >= static_cast<int>(cracks.size())) return false;
  const Crack& crack = cracks[across.crack];
  return crack.felt && !crack.definition.faces.ignored;
}

/// On which side of a crack the material of field 3 lies.
bool both_above(const DividedNode& node, int crack) {
  return node.both[0].crack == crack ? node.both[0].above : node.both[1].above;
}

}  // namespace

CrackContact::CrackContact(const std::vector<Crack>& cracks, const CrackFields& chosen, Fields& fields,
                           std::unique_ptr<SidePlaces> sides, VolumeSurvey& volumes, GeometryKind geometry, int threads,
                           HeatSink* heat)
    : cracks_(cracks),
      chosen_(chosen),
      fields_(fields),
      sides_(std::move(sides)),
      survey_(volumes),
      geometry_(geometry),
      heat_(heat),
      nodes_(fields, threads),
      volumes_(fields.size(), NodalVolumes(fields.front()->layout.dim(), fields.front()->layout.nodes_per_block())),
      marks_(fields.size()),
      any_(fields.size()),
      friction_(cracks.size()),
      friction_energy_(cracks.size(), 0.0),
      interface_energy_(cracks.size(), 0.0) {
  nodes_.blocks.resize(1);
}

void CrackContact::momentum_gathered(StepContext& context) {
  ContactNodes::Block& found = nodes_.blocks.front();
  found.clear();
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const CrackDefinition& crack = cracks_[c].definition;
    friction_[c] = crack.faces.law.in_step(context.start, context.dt, [&] { return "crack '" + crack.name + "'"; });
  }
  for (const DividedNode& node : chosen_.nodes()) add_node(node);
  // Pairs whose sides draw apart are left out unless their law acts on what is apart.
  looked_at_.assign(found.pairs.size(), 0);
  apart_.resize(found.pairs.size());
  for (const ContactNodes::Node& node : found.nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      const NodePair& state = found.pairs[p].state;
      const bool acts_apart = cracks_[found.pairs[p].rule].definition.faces.law.kind == ContactLaw::Kind::interface ||
                              state.friction.adhesion > 0.0 || state.hold != PairHold::none;
      looked_at_[p] = acts_apart || closing(node, state) <= 0.0 ? 1 : 0;
    }
  }
  sides_->begin_step();
  look_at_wanted(looked_at_, context.dt);
}

// Speed at which the faces draw apart; below 0 they approach [m/s].
double CrackContact::closing(const ContactNodes::Node& node, const NodePair& pair) const {
  const GridLayout& layout = fields_.front()->layout;
  const ContactNodes::Member* members = nodes_.blocks.front().members.data() + node.first_member;
  const ContactNodes::Member &above = members[pair.a], &below = members[pair.b];
  const Vec3 apart = nodal_vector(fields_[below.field]->velocity, layout, below.ref) -
                     nodal_vector(fields_[above.field]->velocity, layout, above.ref);
  return apart.dot(pair.normals.of_a);
}

void CrackContact::look_at_wanted(const std::vector<std::uint8_t>& wanted, double dt) {
  if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) return;
  survey(wanted);
  for (const ContactNodes::Node& node : nodes_.blocks.front().nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      if (wanted[p] != 0) look_at(node, p, dt);
    }
  }
}

// Finds the pairs that touch with the velocities of the step's end but not with those of its start.
void CrackContact::look_again(double dt) {
  ContactNodes::Block& found = nodes_.blocks.front();
  const double reach = kTouch * fields_.front()->layout.smallest_cell();
  late_.assign(found.pairs.size(), 0);
  for (const ContactNodes::Node& node : found.nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      NodePair& state = found.pairs[p].state;
      if (state.touching || state.interface != nullptr) continue;
      const double speed = closing(node, state);
      if (!(speed < 0.0)) continue;
      late_[p] = looked_at_[p] != 0 ? 0 : 1;
      if (late_[p] == 0) state.touching = apart_[p] + dt * speed <= reach;
    }
  }
  sides_->begin_step();  // strains may have changed since the first look
  look_at_wanted(late_, dt);
}

// Surveys what laws ask for, on the blocks of the nodes of these pairs.
void CrackContact::survey(const std::vector<std::uint8_t>& wanted) {
  const ContactNodes::Block& found = nodes_.blocks.front();
  for (std::size_t f = 0; f < fields_.size(); ++f) marks_[f].assign(fields_[f]->blocks.size(), 0);
  std::fill(any_.begin(), any_.end(), 0);
  bool displacements = false, places = false, areas = heat_ != nullptr;
  for (const ContactNodes::Node& node : found.nodes) {
    const auto first = wanted.begin() + node.first_pair;
    if (std::find(first, first + node.pairs, 1) == first + node.pairs) continue;
    for (int m = node.first_member; m < node.first_member + node.members; ++m) {
      const ContactNodes::Member& member = found.members[m];
      marks_[member.field][member.ref.block] = any_[member.field] = 1;
    }
  }
  for (std::size_t p = 0; p < found.pairs.size(); ++p) {
    if (wanted[p] == 0) continue;
    const ContactNodes::PairOfNode& pair = found.pairs[p];
    const CrackFaces& faces = cracks_[pair.rule].definition.faces;
    const bool interface = faces.law.kind == ContactLaw::Kind::interface;
    const bool by_position = !interface && faces.detection == CrackFaces::Detection::positions;
    (by_position ? places : displacements) = true;
    areas = areas || interface || friction_[pair.rule].adhesion > 0.0;
  }
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    if (any_[f] == 0) continue;
    sides_->survey(static_cast<int>(f), marks_[f], displacements, places);
    if (areas) survey_.survey(static_cast<int>(f), marks_[f], {}, volumes_[f]);
  }
}

void CrackContact::look_at(const ContactNodes::Node& node, int number, double dt) {
  ContactNodes::Block& found = nodes_.blocks.front();
  ContactNodes::PairOfNode& pair = found.pairs[number];
  const GridLayout& layout = fields_.front()->layout;
  const CrackFaces& faces = cracks_[pair.rule].definition.faces;
  NodePair& state = pair.state;
  const ContactNodes::Member &above = found.members[node.first_member + state.a],
                             &below = found.members[node.first_member + state.b];
  const Vec3& across = state.normals.of_a;
  const double cell = across_cell(layout, across);
  const Vec2 place(node.position.x(), node.position.z());
  const auto world = [](const Vec2& vector) { return Vec3(vector[0], 0.0, vector[1]); };
  const auto opening = [&] {
    return world(sides_->displacement(below.field, below.ref, place, below.mass) -
                 sides_->displacement(above.field, above.ref, place, above.mass));
  };
  const bool interface = faces.law.kind == ContactLaw::Kind::interface;
  if (interface || state.friction.adhesion > 0.0 || heat_ != nullptr) {
    const auto volume = [&](const ContactNodes::Member& of) {
      return volumes_[of.field].volume.at(of.ref.block, 0, of.ref.node);
    };
    state.area = contact_area(volume(above), volume(below), cell) * around_axis(geometry_, layout, node.position);
  }
  if (interface) {
    state.interface = &faces.law.interface;
    state.opening = opening();
    return;
  }
  double apart = 0.0;
  if (faces.detection == CrackFaces::Detection::positions) {
    const Vec2 between =
        sides_->place(below.field, below.ref, below.mass) - sides_->place(above.field, above.ref, above.mass);
    apart = world(between).dot(across) - faces.position * cell;
  } else {
    apart = opening().dot(across);
  }
  apart_[number] = apart;
  state.touching = apart + dt * closing(node, state) <= kTouch * cell;
  if (state.hold != PairHold::none || !started_) state.bond = state.friction.adhesion * state.area * dt;
}

void CrackContact::add_node(const DividedNode& divided) {
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
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    found.materials[m] = {};
    found.materials[m].mass = found.members[m].mass;
  }
  found.nodes.push_back(node);  // for add_pair()
  const std::array<AcrossCrack, 2>& single = divided.single;
  const auto add = [&](int of, int own, int across, bool across_is_above) {
    if (group[own] < 0 || group[across] < 0 || !meets(cracks_, single[of])) return;
    const int above = across_is_above ? across : own, below = across_is_above ? own : across;
    add_pair(single[of].crack, group[above], group[below], divided.normal[of], identity(divided, above, below));
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

// By what lies in its fields: which of 1 and 2 holds the material across which crack depends on the order in which it
// is found, and may change when particles are sorted.
int CrackContact::identity(const DividedNode& node, int above, int below) const {
  const auto label = [&](int field) {
    if (field == 0 || field == 3) return field;
    const int crack = node.single[field - 1].crack;
    return crack < 2 ? 1 + crack : 2 + crack;
  };
  const int fields = static_cast<int>(fields_.size());
  const int cracks = static_cast<int>(cracks_.size()) + chosen_.cuts().count();
  const int labels = cracks > 2 ? std::max(fields, cracks + 2) : fields;
  return (node.first + label(above)) * labels + node.first + label(below);
}

void CrackContact::add_pair(int crack, int above, int below, const Vec2& normal, int identity) {
  ContactNodes::Block& found = nodes_.blocks.front();
  const ContactNodes::Node& node = found.nodes.back();
  const double length = normal.norm();
  if (!(length > 0.0)) return;
  ContactNodes::PairOfNode pair{};
  pair.rule = crack;
  pair.fields = identity;
  NodePair& state = pair.state;
  state.a = above;
  state.b = below;
  state.normals.of_a = state.normals.of_b = Vec3(normal[0], 0.0, normal[1]) / length;
  state.friction = friction_[crack];
  state.hold = nodes_.held(node.id, pair.fields);
  found.pairs.push_back(pair);
}

void CrackContact::momentum_updated(StepContext& context) {
  look_again(context.dt);
  nodes_.update(context.dt);
  started_ = true;
  if (heat_ != nullptr) tell_of_heat(context.dt);
  std::fill(interface_energy_.begin(), interface_energy_.end(), 0.0);
  for (const ContactNodes::PairOfNode& pair : nodes_.blocks.front().pairs) {
    const NodePair& state = pair.state;
    friction_energy_[pair.rule] += state.friction_energy;
    if (state.interface == nullptr) continue;
    interface_energy_[pair.rule] += mpm::interface_energy(*state.interface, {state.opening, state.area, 0.0},
                                                          state.on_a, state.normals.of_a, context.dt);
  }
}

// Faces conduct where they press on each other; the material of both sides meets there.
void CrackContact::tell_of_heat(double dt) const {
  const ContactNodes::Block& found = nodes_.blocks.front();
  for (const ContactNodes::Node& node : found.nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      const NodePair& state = found.pairs[p].state;
      if (state.on_a.isZero(0.0)) continue;
      const ContactNodes::Member &above = found.members[node.first_member + state.a],
                                 &below = found.members[node.first_member + state.b];
      const Grid& grid = *fields_[above.field];
      const double area = state.on_a.dot(state.normals.of_a) < 0.0 ? state.area : 0.0;
      heat_->meet(grid, *fields_[below.field], HeldNodes::id(grid.blocks.key(above.ref.block), above.ref.node), area,
                  state.friction_energy, dt);
    }
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
