#include "mpm/implicit/tool_rows.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/loop/loop.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr double kApart = 0.5;               ///< cells between points
constexpr double kClearance = 0.6;           ///< cells from a convex edge
constexpr double kShort = 1.5, kLong = 6.0;  ///< cells of travel (pressure_to_resolve())
constexpr double kPresent = 0.2;             ///< part of the soil's density, from which on a point is in contact

constexpr double kAnswers = 1e-6;  ///< part of a row's largest answer to an impulse, that along its normal at the least

constexpr int kSweepsBetween = 40;       ///< most sweeps over the meeting of tools in each pass over their rows
constexpr double kEnoughBetween = 1e-5;  ///< change of velocity over the largest one, at which they end

constexpr int kRoomForHeld = 4;  ///< parts of a point's impulse that walls take, of all points in the mean

template <class T>
Vec3 vector_of(const T (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

template <class T>
double magnitude(const T (&v)[3]) {
  return std::sqrt(static_cast<double>(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
}

}  // namespace

template <class T>
ToolRows<T>::ToolRows(std::vector<RigidBody*> bodies, std::vector<ContactLaw> laws, const SoilGrid& grid,
                      const ToolRowSettings& settings)
    : bodies_(std::move(bodies)),
      laws_(std::move(laws)),
      grid_(grid),
      settings_(settings),
      free_(bodies_, settings.gravity, settings.meeting) {
  const double cell = grid.grid().layout.smallest_cell();
  for (const RigidBody* body : bodies_) {
    samples_.push_back(sample_surface(body->surface(), settings.geometry, {kApart * cell, kClearance * cell}));
    ledgers_.emplace_back(*body, axisymmetric(settings.geometry));
    kept_.push_back(
        {std::vector<double>(3 * samples_.back().size(), 0.0), std::vector<double>(samples_.back().size(), 0.0)});
  }
  std::size_t points = 0;
  for (const auto& samples : samples_) points += samples.size();
  // So that no step allocates when a tool meets more soil.
  rows_.reserve(points);
  places_.reserve(points);
  found_.resize(points);
  found_places_.resize(points);
  touches_.resize(points);
  travels_.assign(bodies_.size(), Vec3::Zero());
  held_.reserve(kRoomForHeld * points);
}

template <class T>
double ToolRows<T>::across(const Vec3& at) const {
  return axisymmetric(settings_.geometry) ? kTurn * at.x() : settings_.across;
}

template <class T>
bool ToolRows<T>::find_soil(const Vec3& at, const std::vector<Node>& nodes, Row& row, Place& place) const {
  const GridLayout& layout = grid_.grid().layout;
  const int dim = layout.dim(), corners = 1 << dim;
  std::array<int, 3> cell{}, local{};
  double part[3] = {}, volume = across(at);
  for (int k = 0; k < dim; ++k) {
    const double in_cells = layout.in_cells(k, at[layout.axis(k)]);
    cell[k] = static_cast<int>(std::floor(in_cells));
    part[k] = in_cells - cell[k];
    volume *= layout.cell(k);
  }
  if (!grid_.find(cell, place.block, local)) return false;
  // Nodes without material do not count: what is left of the weights sums to one.
  double carrying = 0.0, mass = 0.0;
  for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
    row.node[e] = e < corners ? grid_.corner(place.block, local, e) : grid_.no_node(place.block);
    const double im = static_cast<double>(nodes[row.node[e]].inverse_mass);
    double& weight = place.weight[e] = 0.0;
    if (!(im > 0.0)) continue;
    weight = 1.0;
    for (int k = 0; k < dim; ++k) weight *= (e >> k & 1) != 0 ? part[k] : 1.0 - part[k];
    carrying += weight;
    mass += weight / im;
  }
  for (double& weight : place.weight) weight /= carrying;
  return mass > kPresent * settings_.least_density * volume;
}

template <class T>
Vec3 ToolRows<T>::bind_nodes(const std::vector<Node>& nodes, Row& row, Place& place) const {
  const GridLayout& layout = grid_.grid().layout;
  Vec3 own = Vec3::Zero();
  place.prescribed.setZero();
  for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
    const Node& node = nodes[row.node[e]];
    const double weight = place.weight[e];
    std::fill_n(row.weight[e], 4, T(0));
    for (int k = 0; k < layout.dim(); ++k) {
      const int a = layout.axis(k);
      if (grid_.holder(row.node[e], a) != SoilGrid::kFree) {
        place.prescribed[a] += weight * static_cast<double>(node.v[a]);
      } else {
        row.weight[e][a] = static_cast<T>(weight);
        own[a] += weight * weight * static_cast<double>(node.inverse_mass);
      }
    }
  }
  return own;
}

template <class T>
Vec3 ToolRows<T>::first_impulse(int body, int sample, const Vec3& normal, const FrictionLaw& law, double own,
                                double dt) const {
  const Kept& kept = kept_[body];
  const double ratio = std::min(1.0, kept.own[sample] / own);
  const Vec3 force(kept.force[3 * sample], kept.force[3 * sample + 1], kept.force[3 * sample + 2]);
  const Vec3 impulse = ratio * ratio * dt * force;
  const double along_normal = impulse.dot(normal);
  if (!(along_normal > 0.0)) return Vec3::Zero();
  return !law.stick && law.coefficient == 0.0 ? Vec3(along_normal * normal) : impulse;
}

template <class T>
bool ToolRows<T>::make(int body, int sample, const std::vector<Node>& nodes, const FrictionLaw& law, double dt,
                       Row& row, Place& place) const {
  const SurfaceSample& point = samples_[body][sample];
  const RigidBody& of = *bodies_[body];
  place.body = body;
  place.sample = sample;
  place.at = of.pose().position + of.pose().orientation * point.place;
  place.area = point.area * across(place.at);
  if (!find_soil(place.at, nodes, row, place)) return false;
  const Vec3 own = bind_nodes(nodes, row, place), normal = of.pose().orientation * point.normal;
  const DynamicMotion* motion = of.dynamic_motion();
  const Mat3 compliance = motion != nullptr ? motion->compliance_at(place.at) : Mat3(Mat3::Zero());
  const double most = own.maxCoeff() + compliance.cwiseAbs().rowwise().sum().maxCoeff();
  // Leaves out points where nothing that is free along the normal answers: an impulse would grow without end.
  if (!(normal.cwiseAbs2().dot(own) + normal.dot(compliance * normal) > kAnswers * most)) return false;
  row.own = static_cast<T>(most);
  place.own = own.maxCoeff();
  row.friction = law.stick ? T(-1) : static_cast<T>(law.coefficient);
  const Vec3 velocity = motion != nullptr ? motion->velocity_at(place.at) : of.velocity_at(place.at);
  const Vec3 begins = first_impulse(body, sample, normal, law, most, dt);
  for (int a = 0; a < 3; ++a) {
    row.normal[a] = static_cast<T>(normal[a]);
    row.velocity[a] = static_cast<T>(velocity[a] - place.prescribed[a]);
    row.impulse[a] = static_cast<T>(begins[a]);
  }
  return true;
}

template <class T>
void ToolRows<T>::find(std::vector<Node>& nodes, double start, double dt) {
  const int blocks = grid_.grid().blocks.size();
  free_.find_meetings(dt);
  free_.predict(dt);
  meeting_ = free_.begin_meeting();
  std::size_t first = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const FrictionLaw law = laws_[b].in_step(start, dt, [&] { return "'" + bodies_[b]->name() + "'"; });
    for_all("implicit: contact with tools", settings_.threads, static_cast<int>(samples_[b].size()), [&](int s) {
      touches_[first + s] =
          make(static_cast<int>(b), s, nodes, law, dt, found_[first + s], found_places_[first + s]) ? 1 : 0;
    });
    first += samples_[b].size();
  }
  // By block, and those of free bodies, which share their bodies' velocities, at the end.
  const auto is_free = [&](const Place& place) { return free_.motion(place.body) != nullptr; };
  begin_.assign(blocks + 1, 0);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (touches_[i] == 0) continue;
    ++touching;
    if (!is_free(found_places_[i])) ++begin_[found_places_[i].block + 1];
  }
  for (int b = 0; b < blocks; ++b) begin_[b + 1] += begin_[b];
  next_.assign(begin_.begin(), begin_.end());
  int next_free = begin_[blocks];
  rows_.resize(touching);
  places_.resize(touching);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (touches_[i] == 0) continue;
    const int at = is_free(found_places_[i]) ? next_free++ : next_[found_places_[i].block]++;
    rows_[at] = found_[i];
    places_[at] = found_places_[i];
  }
  held_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (DynamicMotion* motion = free_.motion(places_[i].body)) motion->push(-vector_of(row.impulse), places_[i].at);
    for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
      Node& node = nodes[row.node[e]];
      for (int a = 0; a < 3; ++a) {
        node.v[a] += node.inverse_mass * row.weight[e][a] * row.impulse[a];
        const std::uint8_t holder = grid_.holder(row.node[e], a);
        if (holder == SoilGrid::kFree || places_[i].weight[e] == 0.0) continue;
        held_.push_back({static_cast<int>(i), row.node[e], holder, static_cast<std::uint8_t>(a), places_[i].weight[e]});
      }
    }
  }
  look_at_loads(dt);
}

template <class T>
void ToolRows<T>::free_nodes(std::vector<int>& numbers) const {
  numbers.clear();
  for (std::size_t i = begin_.back(); i < rows_.size(); ++i) {
    numbers.insert(numbers.end(), std::begin(rows_[i].node), std::end(rows_[i].node));
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

template <class T>
void ToolRows<T>::meet_free(const mpm_kernel::SweepTable<T>& table, std::vector<Node>& nodes) {
  constexpr int kPasses = 2;  // as of the others
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = begin_.back(); i < rows_.size(); ++i) {
      Row& row = rows_[i];
      DynamicMotion& motion = *free_.motion(places_[i].body);
      const Vec3 velocity = motion.velocity_at(places_[i].at) - places_[i].prescribed;
      const Vec3 before = vector_of(row.impulse);
      for (int a = 0; a < 3; ++a) row.velocity[a] = static_cast<T>(velocity[a]);
      table.touch(row, nodes.data());
      motion.push(before - vector_of(row.impulse), places_[i].at);
    }
    if (meeting_ != nullptr) meet_each_other();
  }
}

template <class T>
void ToolRows<T>::meet_each_other() {
  meeting_->begin_sweeps();
  for (int sweep = 0; sweep < kSweepsBetween; ++sweep) {
    const SweepProgress progress = meeting_->sweep(ContactPass::step, sweep % 2 != 0);
    if (progress.largest <= kEnoughBetween * progress.scale || sweep + 1 == kSweepsBetween) break;
    meeting_->go_on(meeting_->change());
  }
}

template <class T>
void ToolRows<T>::extrapolate_free(double factor) {
  for (std::size_t i = begin_.back(); i < rows_.size(); ++i) {
    Row& row = rows_[i];
    const Vec3 was = vector_of(row.impulse);
    const Vec3 more = factor != 0.0 ? Vec3(factor * (was - vector_of(row.before))) : Vec3(Vec3::Zero());
    for (int a = 0; a < 3; ++a) {
      row.before[a] = row.impulse[a];
      row.impulse[a] += static_cast<T>(more[a]);
    }
    free_.motion(places_[i].body)->push(was - vector_of(row.impulse), places_[i].at);
  }
}

template <class T>
bool ToolRows<T>::settle() {
  if (!free_.settle()) return false;
  free_.same_meeting();
  for (std::size_t i = begin_.back(); i < rows_.size(); ++i) {
    const Mat3 compliance = free_.motion(places_[i].body)->compliance_at(places_[i].at);
    rows_[i].own = static_cast<T>(places_[i].own + compliance.cwiseAbs().rowwise().sum().maxCoeff());
  }
  return true;
}

template <class T>
double ToolRows<T>::pressed() const {
  double sum = 0.0;
  for (const Row& row : rows_) sum += magnitude(row.impulse);
  return sum;
}

template <class T>
void ToolRows<T>::look_at_loads(double dt) {
  loads_.assign(bodies_.size(), {});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double impulse = magnitude(rows_[i].impulse);
    if (!(impulse > 0.0)) continue;
    Load& load = loads_[places_[i].body];
    load.impulse += impulse;
    load.area += places_[i].area;
    load.velocity += impulse * (vector_of(rows_[i].velocity) + places_[i].prescribed);
  }
  const double cell = grid_.grid().layout.smallest_cell();
  pressure_ = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Load& load = loads_[b];
    Vec3& travel = travels_[b];
    if (!(load.impulse > 0.0)) {
      travel.setZero();
      continue;
    }
    travel += dt / load.impulse * load.velocity;
    travel *= std::min(1.0, kLong * cell / std::max(travel.norm(), cell));
    const double part = std::min(1.0, kShort * cell / std::max(travel.norm(), cell));
    pressure_ = std::max(pressure_, part * load.impulse / (load.area * dt));
  }
}

template <class T>
void ToolRows<T>::add_to_held(HeldImpulses& held) const {
  for (const HeldPart& part : held_) {
    const double impulse = static_cast<double>(rows_[part.row].impulse[part.axis]);
    held.add(part.node, part.axis, part.holder, part.weight * impulse);
  }
}

template <class T>
void ToolRows<T>::Kept::clear() {
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(own.begin(), own.end(), 0.0);
}

template <class T>
void ToolRows<T>::forget(const RigidBody& body) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b] == &body) kept_[b].clear();
  }
}

template <class T>
void ToolRows<T>::finish(const std::vector<Node>& nodes, double dt) {
  for (Kept& kept : kept_) kept.clear();
  std::vector<int>& touched = next_;
  touched.assign(bodies_.size(), 0);
  areas_.assign(bodies_.size(), 0.0);
  press_.assign(bodies_.size(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const Place& place = places_[i];
    const RigidBody& body = *bodies_[place.body];
    const Vec3 impulse = vector_of(row.impulse), normal = vector_of(row.normal);
    // Mean of the step for a free body, with which its own energy changes.
    const DynamicMotion* motion = free_.motion(place.body);
    const Vec3 velocity =
        motion != nullptr ? motion->mean_velocity_at(place.at) : Vec3(vector_of(row.velocity) + place.prescribed);
    Vec3 slip = place.prescribed - velocity;
    for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
      for (int a = 0; a < 3; ++a) {
        slip[a] += static_cast<double>(row.weight[e][a]) * static_cast<double>(nodes[row.node[e]].v[a]);
      }
    }
    ContactLedger& ledger = ledgers_[place.body];
    ledger.give({impulse, normal, place.at - body.pose().position, velocity, slip});
    // Loss that rows leave undone along the normal.
    ledger.add_loss({0.0, -impulse.dot(normal) * slip.dot(normal)});
    free_.take(place.body, impulse, place.at, normal, Vec3::Zero());
    Kept& kept = kept_[place.body];
    for (int a = 0; a < 3; ++a) kept.force[3 * place.sample + a] = impulse[a] / dt;
    kept.own[place.sample] = static_cast<double>(row.own);
    if (impulse.squaredNorm() > 0.0) {
      ++touched[place.body];
      areas_[place.body] += place.area;
      press_[place.body] += impulse.norm();
    }
  }
  most_ = {};
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ledgers_[b].end_step(dt, touched[b], areas_[b]);
    const double mean = areas_[b] > 0.0 ? press_[b] / (areas_[b] * dt) : 0.0;
    if (mean > most_.mean) most_ = {mean, static_cast<std::int32_t>(b)};
  }
  if (meeting_ != nullptr) free_.take_meetings(true);
  free_.finish();
}

template <class T>
void ToolRows<T>::serialise(StateArchive& archive) {
  archive.value("pressure", most_.mean);
  archive.value("pressed", most_.body);
  free_.serialise(archive);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const StateArchive::Group group(archive, "body_" + std::to_string(b));
    ledgers_[b].serialise(archive);
    archive.list("forces", kept_[b].force);
    archive.list("own", kept_[b].own);
    archive.value("travel", travels_[b]);
  }
}

template class ToolRows<double>;
template class ToolRows<float>;

}  // namespace mpm
