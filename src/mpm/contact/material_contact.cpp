#include "mpm/contact/material_contact.hpp"

#include <algorithm>

namespace mpm {
namespace {

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
      surveyed_(fields.size(), 0.0),
      nodes_(fields, settings_.threads),
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

void MaterialContact::before_strain(StepContext& context) { nodes_.strain(context.dt); }

void MaterialContact::momentum_updated(StepContext& context) {
  nodes_.update(context.dt);
  started_ = true;
  last_.assign(last_.size(), {});
  for (const BlockNodes& block : nodes_.blocks) book(block, true, context.dt);
}

void MaterialContact::velocity_found(StepContext& context) { nodes_.filter(context.dt); }

void MaterialContact::increment_found(StepContext& context) {
  nodes_.filter(context.dt);
  for (const BlockNodes& block : nodes_.blocks) book(block, false, context.dt);
}

MaterialContact::Sums& MaterialContact::Sums::operator+=(const Sums& other) {
  impulse += other.impulse;
  friction += other.friction;
  moment += other.moment;
  pressed += other.pressed;
  friction_energy += other.friction_energy;
  return *this;
}

bool MaterialContact::counts(const BlockNodes& block) const {
  if (block.members.empty()) return false;
  const Member& any = block.members.front();
  return fields_[any.field]->counts(any.ref.block);
}

void MaterialContact::book(const BlockNodes& block, bool updated, double dt) {
  const bool counted = counts(block);
  for (const Node& node : block.nodes) {
    for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
      const NodePair& pair = block.pairs[p].state;
      if (updated && settings_.heat != nullptr && !pair.on_a.isZero(0.0)) tell_of_heat(block, node, pair, dt);
      if (!counted) continue;
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

MaterialContact::Sums MaterialContact::since(const Sums& seen, std::size_t pair) const {
  Sums sums = total_[pair];
  sums.impulse -= seen.impulse;
  sums.friction -= seen.friction;
  sums.moment -= seen.moment;
  sums.pressed -= seen.pressed;
  sums.area = last_[pair].area;
  sums.interface_energy = last_[pair].interface_energy;
  sums.nodes = last_[pair].nodes;
  return sums;
}

void MaterialContact::add_up(std::vector<Sums>& sums) const {
  if (settings_.ranks == nullptr) return;
  std::vector<double> numbers;
  for (const Sums& one : sums) {
    for (const Vec3& vector : {one.impulse, one.friction, one.moment}) {
      numbers.insert(numbers.end(), vector.data(), vector.data() + 3);
    }
    for (const double number : {one.pressed, one.area, one.friction_energy, one.interface_energy}) {
      numbers.push_back(number);
    }
    numbers.push_back(one.nodes);
  }
  settings_.ranks->sum(numbers.data(), static_cast<int>(numbers.size()));
  const double* next = numbers.data();
  for (Sums& one : sums) {
    for (Vec3* vector : {&one.impulse, &one.friction, &one.moment}) {
      *vector = {next[0], next[1], next[2]};
      next += 3;
    }
    for (double* number : {&one.pressed, &one.area, &one.friction_energy, &one.interface_energy}) *number = *next++;
    one.nodes = static_cast<int>(*next++);
  }
}

void MaterialContact::read_pairs(double now, std::vector<PairReport>& reports, int reader) {
  const bool about_axis = axisymmetric(settings_.geometry);
  const auto whole = [about_axis](const Vec3& sum) { return about_axis ? Vec3(0.0, 0.0, sum.z()) : sum; };
  Reader& own = readers_[reader];
  const double interval = now - own.time;
  std::vector<Sums> sums;
  for (std::size_t i = 0; i < settings_.pairs.size(); ++i) {
    sums.push_back(since(own.seen[i], i));
    sums.push_back(since({}, i));
  }
  add_up(sums);
  for (std::size_t i = 0; i < settings_.pairs.size(); ++i) {
    const Sums &since_seen = sums[2 * i], &all = sums[2 * i + 1];
    PairReport report;
    report.name = settings_.pairs[i].name;
    report.interval = interval;
    if (interval > 0.0) {
      report.force = whole(since_seen.impulse / interval);
      report.friction = whole(since_seen.friction / interval);
      report.pressing = since_seen.pressed / interval;
    }
    if (since_seen.pressed > 0.0) report.centre = whole(since_seen.moment / since_seen.pressed);
    report.area = all.area;
    report.nodes = all.nodes;
    report.impulse = whole(all.impulse);
    report.friction_energy = all.friction_energy;
    report.interface_energy = all.interface_energy;
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
  archive.sum_column("impulse", sums, &Sums::impulse);
  archive.sum_column("friction", sums, &Sums::friction);
  archive.sum_column("moment", sums, &Sums::moment);
  archive.sum_column("pressed", sums, &Sums::pressed);
  archive.sum_column("area", sums, &Sums::area);
  archive.sum_column("friction_energy", sums, &Sums::friction_energy);
  archive.sum_column("interface_energy", sums, &Sums::interface_energy);
  archive.sum_column("nodes", sums, &Sums::nodes);
}

void MaterialContact::serialise(StateArchive& archive) {
  archive.value("started", started_);
  nodes_.serialise(archive);
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
  archive.sum("left_over", left_over_);
}

}  // namespace mpm
