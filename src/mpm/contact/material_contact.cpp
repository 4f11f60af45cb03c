#include "mpm/contact/material_contact.hpp"

#include <algorithm>

namespace mpm {
namespace {

constexpr double kNoTraction = 1e-12;

SurveyWants wants_of(const MaterialContactSettings& settings) {
  const bool interface = std::any_of(settings.pairs.begin(), settings.pairs.end(), [](const MaterialPair& pair) {
    return pair.law.kind == ContactLaw::Kind::interface;
  });
  SurveyWants wants;
  wants.start_volume = settings.detection.minimum_volume > 0.0;
  wants.position = interface || settings.detection.kind == Detection::positions;
  wants.displacement = interface || settings.detection.kind == Detection::displacements;
  wants.slope = interface;
  return wants;
}

}  // namespace

MaterialContact::MaterialContact(MaterialContactSettings settings, Fields& fields, VolumeSurvey& survey)
    : settings_(std::move(settings)),
      fields_(fields),
      survey_(survey),
      wants_(wants_of(settings_)),
      rules_(fields.size() * fields.size()),
      volumes_(fields.size(), NodalVolumes(fields.front()->layout.dim(), fields.front()->layout.nodes_per_block())),
      friction_(settings_.pairs.size()),
      last_(settings_.pairs.size()),
      total_(settings_.pairs.size()),
      readers_{{0.0, total_}} {
  account_.name = "contact_normals";
  const std::size_t count = fields.size();
  for (std::size_t i = 0; i < settings_.pairs.size(); ++i) {
    for (const int a : settings_.pairs[i].first) {
      for (const int b : settings_.pairs[i].second) {
        rules_[a * count + b] = {static_cast<int>(i), false};
        rules_[b * count + a] = {static_cast<int>(i), true};
      }
    }
  }
}

template <class FieldOf>
void MaterialContact::load(Pass pass, const BlockNodes& block, const Node& node, double dt, FieldOf&& velocity,
                           Scratch& scratch) const {
  const auto first = block.materials.begin() + node.first_member;
  scratch.materials.assign(first, first + node.groups);
  for (NodeMaterial& material : scratch.materials) material.velocity.setZero();
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    NodeMaterial& material = scratch.materials[member.group];
    const Vec3 own = nodal_vector(velocity(grid), grid.layout, member.ref);
    // A material of one member keeps its velocity to the last bit.
    material.velocity += member.mass == material.mass ? own : Vec3(own * (member.mass / material.mass));
  }
  scratch.pairs.clear();
  for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
    NodePair pair = block.pairs[p].state;
    pair.on_a.setZero();
    pair.on_b.setZero();
    if (pass == Pass::strain && pair.interface != nullptr) {
      // What is too stiff to open within a step moves as one here too; strain would else be taken from a motion that
      // the interface forbids, which gains energy as letting go of pressed nodes does (step/coulomb.hpp).
      // No traction of the opening there is, but the side that the surfaces are on counts.
      pair.opening *= kNoTraction;
      // Little where a step resolves the interface's oscillation (K < 1): K^2 in the place of K.
      const double mass = reduced_mass(scratch.materials[pair.a], scratch.materials[pair.b]);
      const InterfaceLaw& law = *pair.interface;
      pair.area *= pair.area * std::max({law.opened, law.closed, law.tangential, 0.0}) * dt * dt / mass;
    } else if (pass != Pass::update) {
      pair.keep = pair.hold;
      pair.interface = nullptr;
      pair.bond = 0.0;
      if (pass == Pass::filter) pair.touching = false;
    }
    scratch.pairs.push_back(pair);
  }
}

template <class FieldOf>
void MaterialContact::hold(Pass pass, BlockNodes& block, const Node& node, double dt, FieldOf&& velocity,
                           Scratch& scratch) {
  load(pass, block, node, dt, velocity, scratch);
  solve_contact(scratch.materials, scratch.pairs, dt);
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    const Vec3 own = nodal_vector(velocity(grid), grid.layout, member.ref);
    add_nodal_vector(velocity(grid), grid.layout, member.ref, scratch.materials[member.group].velocity - own);
  }
  for (int p = 0; p < node.pairs; ++p) {
    NodePair& pair = block.pairs[node.first_pair + p].state;
    pair.on_a = scratch.pairs[p].on_a;
    pair.on_b = scratch.pairs[p].on_b;
  }
}

template <class FieldOf>
void MaterialContact::hold_nodes(Pass pass, double dt, FieldOf&& velocity) {
  const int count = static_cast<int>(blocks_.size());
#pragma omp parallel num_threads(settings_.threads)
  {
    Scratch scratch;
#pragma omp for schedule(static)
    for (int i = 0; i < count; ++i) {
      for (const Node& node : blocks_[i].nodes) hold(pass, blocks_[i], node, dt, velocity, scratch);
    }
  }
}

void MaterialContact::before_strain(StepContext& context) {
  hold_nodes(Pass::strain, context.dt, [](Grid& grid) -> NodalField& { return grid.velocity; });
}

void MaterialContact::momentum_updated(StepContext& context) {
  const int count = static_cast<int>(blocks_.size());
#pragma omp parallel num_threads(settings_.threads)
  {
    Scratch scratch;
#pragma omp for schedule(static)
    for (int i = 0; i < count; ++i) {
      for (const Node& node : blocks_[i].nodes) update(blocks_[i], node, context.dt, scratch);
    }
  }
  keep_held();
  started_ = true;
  last_.assign(last_.size(), {});
  for (const BlockNodes& block : blocks_) book(block, true, context.dt);
}

void MaterialContact::update(BlockNodes& block, const Node& node, double dt, Scratch& scratch) {
  load(
      Pass::update, block, node, dt, [](Grid& grid) -> NodalField& { return grid.velocity; }, scratch);
  std::vector<Vec3>& start = scratch.velocities;
  std::vector<Vec3>& accelerations = scratch.accelerations;
  std::vector<Vec3>& gathered = scratch.gathered;
  start.clear();
  accelerations.assign(node.groups, Vec3::Zero());
  for (const NodeMaterial& material : scratch.materials) start.push_back(material.velocity);
  gathered.assign(node.groups, Vec3::Zero());
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    const Grid& grid = *fields_[member.field];
    accelerations[member.group] +=
        nodal_vector(grid.force, grid.layout, member.ref) * (member.mass / scratch.materials[member.group].mass);
    gathered[member.group] +=
        nodal_vector(grid.momentum, grid.layout, member.ref) / scratch.materials[member.group].mass;
  }
  for (NodePair& pair : scratch.pairs) {
    pair.start_slip = held_slip(gathered[pair.b] - gathered[pair.a], pair.normals.of_a, pair.hold);
  }
  solve_contact(scratch.materials, scratch.pairs, dt);
  for (int p = 0; p < node.pairs; ++p) block.pairs[node.first_pair + p].state = scratch.pairs[p];
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    const Vec3 change = scratch.materials[member.group].velocity - start[member.group];
    const Vec3 apart = start[member.group] - nodal_vector(grid.velocity, grid.layout, member.ref);
    const Vec3 forced = accelerations[member.group] - nodal_vector(grid.force, grid.layout, member.ref);
    add_nodal_vector(grid.velocity, grid.layout, member.ref, change + apart);
    add_nodal_vector(grid.force, grid.layout, member.ref, change / dt + forced);
  }
}

void MaterialContact::velocity_found(StepContext& context) {
  hold_nodes(Pass::filter, context.dt, [](Grid& grid) -> NodalField& { return grid.increment; });
}

void MaterialContact::increment_found(StepContext& context) {
  hold_nodes(Pass::filter, context.dt, [](Grid& grid) -> NodalField& { return grid.increment; });
  for (const BlockNodes& block : blocks_) book(block, false, context.dt);
}

void MaterialContact::keep_held() {
  held_.clear();
  for (const BlockNodes& block : blocks_) {
    for (const Node& node : block.nodes) {
      const std::size_t first = held_.size();
      for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
        const PairOfNode& pair = block.pairs[p];
        if (pair.state.hold != PairHold::none) held_.push_back({node.id, pair.fields, pair.state.hold});
      }
      std::sort(held_.begin() + static_cast<std::ptrdiff_t>(first), held_.end(),
                [](const Held& a, const Held& b) { return a.fields < b.fields; });
    }
  }
}

MaterialContact::Sums& MaterialContact::Sums::operator+=(const Sums& other) {
  impulse += other.impulse;
  friction += other.friction;
  moment += other.moment;
  pressed += other.pressed;
  friction_energy += other.friction_energy;
  return *this;
}

void MaterialContact::book(const BlockNodes& block, bool updated, double dt) {
  for (const Node& node : block.nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      const NodePair& pair = block.pairs[p].state;
      Sums& sums = last_[block.pairs[p].rule];
      const Vec3 on_second = block.pairs[p].turned ? pair.on_a : pair.on_b;
      const double normal = pair.on_a.dot(pair.normals.of_a);
      const Vec3 side = block.pairs[p].turned ? pair.normals.of_a : pair.normals.of_b;
      sums.impulse += on_second;
      sums.friction += on_second - on_second.dot(side) * side;
      if (!pair.opposite) left_over_ += pair.on_a + pair.on_b;
      if (normal < 0.0) {
        sums.pressed -= normal;
        sums.moment -= normal * node.position;
      }
      if (!updated) continue;
      sums.friction_energy += pair.friction_energy;
      if (settings_.heat != nullptr && !pair.on_a.isZero(0.0)) tell_of_heat(block, node, pair, dt);
      if (pair.interface != nullptr) {
        sums.interface_energy +=
            mpm::interface_energy(*pair.interface, {pair.opening, pair.area, 0.0}, pair.on_a, pair.normals.of_a, dt);
      }
      if (pair.on_a.isZero(0.0)) continue;
      ++sums.nodes;
      if (normal < 0.0) sums.area += pair.area;
    }
  }
}

void MaterialContact::tell_of_heat(const BlockNodes& block, const Node& node, const NodePair& pair, double dt) {
  const auto member_of = [&](int group) {
    int m = node.first_member;
    while (block.members[m].group != group) ++m;
    return block.members[m].field;
  };
  const double area = pair.on_a.dot(pair.normals.of_a) < 0.0 ? pair.area : 0.0;
  settings_.heat->meet(*fields_[member_of(pair.a)], *fields_[member_of(pair.b)], node.id, area, pair.friction_energy,
                       dt);
}

void MaterialContact::grid_advanced(StepContext&) {
  for (std::size_t i = 0; i < last_.size(); ++i) total_[i] += last_[i];
  if (settings_.normals.method == NormalMethod::own) account_.add(left_over_);
  left_over_.setZero();
}

void MaterialContact::accounts(std::vector<ImpulseAccount>& list) const {
  if (settings_.normals.method == NormalMethod::own) list.push_back(account_);
}

int MaterialContact::add_reader(double now) {
  readers_.push_back({now, total_});
  return static_cast<int>(readers_.size()) - 1;
}

void MaterialContact::read_pairs(double now, std::vector<PairReport>& reports, int reader) {
  const bool about_axis = axisymmetric(settings_.geometry);
  const auto whole = [about_axis](const Vec3& sum) { return about_axis ? Vec3(0.0, 0.0, sum.z()) : sum; };
  Reader& own = readers_[reader];
  const double interval = now - own.time;
  for (std::size_t i = 0; i < settings_.pairs.size(); ++i) {
    const Sums &seen = own.seen[i], &total = total_[i];
    const double pressed = total.pressed - seen.pressed;
    PairReport report;
    report.name = settings_.pairs[i].name;
    report.interval = interval;
    if (interval > 0.0) {
      report.force = whole((total.impulse - seen.impulse) / interval);
      report.friction = whole((total.friction - seen.friction) / interval);
      report.pressing = pressed / interval;
    }
    if (pressed > 0.0) report.centre = whole((total.moment - seen.moment) / pressed);
    report.area = last_[i].area;
    report.nodes = last_[i].nodes;
    report.impulse = whole(total.impulse);
    report.friction_energy = total.friction_energy;
    report.interface_energy = last_[i].interface_energy;
    reports.push_back(report);
  }
  own = {now, total_};
}

void MaterialContact::energies(EnergyReport& report) const {
  report.leave_open();  // motion that a pair holds up is not counted
  for (std::size_t i = 0; i < total_.size(); ++i) {
    report.add("pair_friction", NamedEnergy::Kind::dissipated, total_[i].friction_energy);
    report.add("interface", NamedEnergy::Kind::stored, last_[i].interface_energy);  // as the last step began
  }
}

void MaterialContact::serialise_sums(StateArchive& archive, std::vector<Sums>& sums) {
  archive.column("impulse", sums, &Sums::impulse);
  archive.column("friction", sums, &Sums::friction);
  archive.column("moment", sums, &Sums::moment);
  archive.column("pressed", sums, &Sums::pressed);
  archive.column("area", sums, &Sums::area);
  archive.column("friction_energy", sums, &Sums::friction_energy);
  archive.column("interface_energy", sums, &Sums::interface_energy);
  archive.column("nodes", sums, &Sums::nodes);
}

void MaterialContact::serialise(StateArchive& archive) {
  archive.value("started", started_);
  archive.rows("held", held_);
  archive.column("held/node", held_, &Held::node);
  archive.column("held/fields", held_, &Held::fields);
  archive.column("held/hold", held_, &Held::hold);
  const std::pair<const char*, std::vector<Sums>*> all[] = {{"last", &last_}, {"total", &total_}};
  for (const auto& [name, sums] : all) {
    const StateArchive::Group group(archive, name);
    serialise_sums(archive, *sums);
  }
  for (std::size_t r = 0; r < readers_.size(); ++r) {
    const StateArchive::Group group(archive, "reader_" + std::to_string(r));
    archive.value("time", readers_[r].time);
    serialise_sums(archive, readers_[r].seen);
  }
  account_.serialise(archive);
  archive.value("left_over", left_over_);
}

}  // namespace mpm
