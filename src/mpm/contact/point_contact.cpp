#include "mpm/contact/point_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/step/point_weights.hpp"

namespace mpm {
namespace {

constexpr double kTouching = 1e-2;   ///< cells: a point this near counts to the area
constexpr double kWeakening = 1e-3;  ///< cells of sliding over which friction falls from that at rest
constexpr double kAtRest = 1e-6;     ///< cells: what slides by less in a step is at rest, and what is this near adheres
constexpr double kPushOut = 2e-4;    ///< cells a step at most that a point inside a body is moved out
constexpr double kPushOutPart = 0.1;  ///< of its depth
constexpr int kMostSweeps = 40;
constexpr int kMostSweepsFree = 400;     ///< with a body that is free
constexpr double kToleranceFree = 1e-5;  ///< the same as kTolerance
constexpr double kTolerance = 1e-3;      ///< change of velocity in a sweep over the largest one, at which sweeps end

std::uint64_t id_of(std::uint32_t particle, int body) { return (static_cast<std::uint64_t>(particle) << 16) + body; }

}  // namespace

PointContact::PointContact(std::vector<const RigidBody*> bodies, const std::vector<ParticleSet>& sets, Fields& fields,
                           std::vector<ContactLaw> laws, const PointContactSettings& settings)
    : bodies_(std::move(bodies)),
      sets_(sets),
      fields_(fields),
      settings_(settings),
      laws_(std::move(laws)),
      laws_now_(laws_.size()) {
  for (const RigidBody* body : bodies_) ledgers_.emplace_back(*body, axisymmetric(settings.geometry));
  any_free_ = std::any_of(settings_.free.begin(), settings_.free.end(), [](const RigidBody* body) { return body; });
}

void PointContact::momentum_gathered(StepContext& context) {
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const FrictionLaw law = laws_now_[i] = laws_[i].at(context.start + 0.5 * context.dt);
    if (!(law.coefficient >= 0.0 && law.at_rest() >= law.coefficient && law.adhesion >= 0.0)) {
      throw FunctionError("contact of '" + bodies_[i / sets_.size()]->name() + "' with '" +
                          sets_[i % sets_.size()].name +
                          "': friction or adhesion is negative, or friction at rest less than that of sliding");
    }
  }
  push_out_ = kPushOut * context.layout().smallest_cell();
  touching_ = kTouching * context.layout().smallest_cell();
  at_rest_ = kAtRest * context.layout().smallest_cell();
  weakening_ = kWeakening * context.layout().smallest_cell();
  find_points(context);
  connect(context);
  // What friction takes is counted with the slip of the step's start and end: in between forces push held points that
  // do not slide.
  load(&Grid::velocity);
  for (Point& point : points_) point.approach = velocity_at(point) - point.velocity;
}

void PointContact::connect(const StepContext& context) {
  const int per_block = context.layout().nodes_per_block();
  slot_.resize(fields_.size());
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    slot_[f].resize(static_cast<std::size_t>(fields_[f]->blocks.size()) * per_block, -1);
  }
  nodes_.clear();
  points_.clear();
  parts_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (Point& point : of_block_[i]) {
      const Grid& grid = *fields_[point.field];
      const PointWeights weights(grid, settings_.shape, point.place);
      if (weights.count == 0) continue;
      point.first = static_cast<int>(parts_.size());
      for (int n = 0; n < weights.count; ++n) {
        const NodeRef ref = weights.node[n];
        int& slot = slot_[point.field][static_cast<std::size_t>(ref.block) * per_block + ref.node];
        if (slot < 0) {
          slot = static_cast<int>(nodes_.size());
          nodes_.push_back({point.field, ref, 1.0 / grid.mass.at(ref.block, 0, ref.node)});
        }
        const double lifted = weights.weight[n] * nodes_[slot].inverse_mass;
        parts_.push_back({slot, weights.weight[n], lifted});
        point.compliance += weights.weight[n] * lifted;
      }
      point.end = static_cast<int>(parts_.size());
      recall(point, context.dt);
      points_.push_back(point);
    }
  }
  for (const Node& node : nodes_) {
    slot_[node.field][static_cast<std::size_t>(node.ref.block) * per_block + node.ref.node] = -1;
  }
  velocity_.resize(nodes_.size());
  loaded_.resize(nodes_.size());
}

void PointContact::recall(Point& point, double dt) const {
  const std::uint64_t id = id_of(point.particle, point.body);
  const auto memory = std::lower_bound(memory_.begin(), memory_.end(), id,
                                       [](const Memory& entry, std::uint64_t wanted) { return entry.id < wanted; });
  const bool seen = memory != memory_.end() && memory->id == id;
  // What comes under a surface from beside it, or starts there, keeps the overlap that it came with.
  point.overlap = std::min(std::max(seen ? memory->overlap : point.gap, point.gap), 0.0);
  point.gap -= point.overlap;
  const bool held = seen && memory->hold != Hold::free;
  point.adheres = held || point.gap <= at_rest_;
  if (!held) return;
  point.hold = memory->hold;
  point.slid = memory->slid;
  point.impulse = memory->force * dt;
  if (laws_now_[point.law].adhesion > 0.0) return;
  // The normal may have turned: what begins the sweeps pulls nowhere.
  point.impulse += std::max(-point.impulse.dot(point.normal), 0.0) * point.normal;
}

void PointContact::load(Member from) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Grid& grid = *fields_[nodes_[n].field];
    const Vec3 v = nodal_vector(grid.*from, grid.layout, nodes_[n].ref);
    loaded_[n] = velocity_[n] = {v.x(), v.y(), v.z()};
  }
}

void PointContact::store(Member to, double factor) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Grid& grid = *fields_[nodes_[n].field];
    Vec3 change;
    for (int k = 0; k < 3; ++k) change[k] = factor * (velocity_[n][k] - loaded_[n][k]);
    add_nodal_vector(grid.*to, grid.layout, nodes_[n].ref, change);
  }
}

Vec3 PointContact::velocity_at(const Point& point) const {
  Vec3 v = Vec3::Zero();
  for (int i = point.first; i < point.end; ++i) {
    const std::array<double, 3>& node = velocity_[parts_[i].node];
    for (int k = 0; k < 3; ++k) v[k] += parts_[i].weight * node[k];
  }
  return v;
}

template <bool Free>
void PointContact::push(const Point& point, const Vec3& impulse) {
  if constexpr (Free) {
    if (FreeMotion* free = free_motion(point.body)) free->push(-impulse, point.place);
  }
  for (int i = point.first; i < point.end; ++i) {
    for (int k = 0; k < 3; ++k) velocity_[parts_[i].node][k] += parts_[i].lifted * impulse[k];
  }
}

double PointContact::allowed(const Point& point, double dt) const {
  return point.gap > 0.0 ? -point.gap / dt : std::min(-kPushOutPart * point.gap, push_out_) / dt;
}

template <PointContact::Pass Kind, bool Free>
double PointContact::relax(Point& point, double dt) {
  constexpr bool kDecides = Kind == Pass::step;
  const bool bound = !kDecides && point.hold != Hold::free;
  if (Kind != Pass::step && Kind != Pass::strain && !bound) return 0.0;
  Vec3 slip = velocity_at(point);
  double compliance = point.compliance, compliance_along = point.compliance;
  const FreeMotion* free = nullptr;
  if constexpr (Free) {
    free = free_motion(point.body);
    compliance = point.with_body[0];
    compliance_along = point.with_body[1];
  }
  if (free != nullptr) {
    slip -= free->velocity_at(point.place);
  } else if (Kind != Pass::increment) {
    slip -= point.velocity;
  }
  const double approach = slip.dot(point.normal), pressed = point.impulse.dot(point.normal);
  const double wanted = bound ? 0.0 : allowed(point, dt);
  double normal = pressed + (wanted - approach) / compliance;
  Vec3 along = point.impulse - pressed * point.normal;
  const Vec3 sticking = along - (slip - approach * point.normal) / compliance_along;
  if (bound) {
    if (point.hold == Hold::stick) along = sticking;
  } else {
    const FrictionLaw& law = laws_now_[point.law];
    const double adhesion = point.adheres ? law.adhesion * point.area * dt : 0.0;
    normal = std::max(normal, -adhesion);
    along = sticking;
    const double weakened = std::min(point.slid / weakening_, 1.0);
    const double friction = law.at_rest() + weakened * (law.coefficient - law.at_rest());
    const double length = along.norm(), most = friction * std::max(normal, 0.0) + adhesion;
    Hold hold = normal > -adhesion ? Hold::stick : Hold::free;
    if (hold == Hold::free) {
      along.setZero();
    } else if (!law.stick && length > most) {
      along *= most / length;
      hold = Hold::slide;
    }
    if (kDecides) point.hold = hold;
  }
  const Vec3 impulse = normal * point.normal + along, change = impulse - point.impulse;
  point.impulse = impulse;
  push<Free>(point, change);
  return change.norm() * compliance;
}

template <PointContact::Pass Kind, bool Free>
void PointContact::solve(double dt) {
  ConjugateSweeps<Point> conjugate(sweeps_);
  for (int sweep = 0; sweep < (Free ? kMostSweepsFree : kMostSweeps); ++sweep) {
    if constexpr (Free) conjugate.begin(points_);
    double largest = 0.0, scale = 0.0;
    const auto visit = [&](Point& point) {
      largest = std::max(largest, relax<Kind, Free>(point, dt));
      scale = std::max(scale, point.impulse.norm() * (Free ? point.with_body[0] : point.compliance));
    };
    if (sweep % 2 == 0) {
      for (Point& point : points_) visit(point);
    } else {
      for (auto point = points_.rbegin(); point != points_.rend(); ++point) visit(*point);
    }
    if (largest <= (Free ? kToleranceFree : kTolerance) * scale) break;
    if constexpr (Free) {
      if (sweep + 1 < kMostSweepsFree) {
        conjugate.go_on(points_, [&](Point& point, const Vec3& change) {
          point.impulse += change;
          push<true>(point, change);
        });
      }
    }
  }
}

void PointContact::before_strain(StepContext& context) {
  if (points_.empty()) return;
  load(&Grid::velocity);
  kept_.clear();
  for (Point& point : points_) {
    kept_.push_back(point.impulse);
    point.impulse.setZero();
  }
  solve<Pass::strain, false>(context.dt);
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].impulse = kept_[i];
  store(&Grid::velocity);
}

void PointContact::momentum_updated(StepContext& context) {
  memory_.clear();
  if (any_free_) {
    predict_free(context.dt);
    decide<true>(context);
    finish_free();
  } else if (!points_.empty()) {
    decide<false>(context);
  }
}

template <bool Free>
void PointContact::decide(StepContext& context) {
  load(&Grid::velocity);
  for (const Point& point : points_) push<Free>(point, point.impulse);
  solve<Pass::step, Free>(context.dt);
  store(&Grid::velocity);
  store(&Grid::force, 1.0 / context.dt);
  for (Point& point : points_) {
    Vec3 moves = point.velocity;
    if constexpr (Free) {
      if (const FreeMotion* free = free_motion(point.body)) {
        // What an impulse does to the body is counted with the mean velocity, as what it does to the material.
        moves = free->velocity_at(point.place);
        point.velocity = free->mean_velocity_at(point.place);
      }
    }
    const Vec3 slip = velocity_at(point) - moves;
    give(point, 0.5 * (point.approach + slip));
    if constexpr (Free) take_free(point, 0.5 * (point.approach + slip));
    point.velocity = moves;
    // What has come to rest has friction at rest again.
    const double slid = (slip - slip.dot(point.normal) * point.normal).norm() * context.dt;
    point.slid = slid < at_rest_ ? 0.0 : point.slid + slid;
    memory_.push_back(
        {id_of(point.particle, point.body), point.impulse / context.dt, point.slid, point.overlap, point.hold});
  }
  std::sort(memory_.begin(), memory_.end(), [](const Memory& a, const Memory& b) { return a.id < b.id; });
}

void PointContact::velocity_found(StepContext& context) {
  if (points_.empty()) return;
  load(&Grid::increment);
  for (Point& point : points_) point.impulse.setZero();
  solve<Pass::held, false>(context.dt);
  store(&Grid::increment);
}

void PointContact::increment_found(StepContext& context) {
  if (points_.empty()) return;
  load(&Grid::increment);
  for (Point& point : points_) point.impulse.setZero();
  if (any_free_) {
    solve_increment_free(context.dt);
  } else {
    solve<Pass::increment, false>(context.dt);
  }
  store(&Grid::increment);
  for (const Point& point : points_) give(point, Vec3::Zero());
}

void PointContact::solve_increment_free(double dt) {
  for (RigidBody* body : settings_.free) {
    if (body != nullptr) body->free_motion()->begin_increment();
  }
  solve<Pass::increment, true>(dt);
  for (RigidBody* body : settings_.free) {
    if (body != nullptr) body->free_motion()->end_increment();
  }
  for (Point& point : points_) {
    take_free(point, Vec3::Zero());
    if (const FreeMotion* free = free_motion(point.body)) point.velocity = free->velocity_at(point.place);
  }
  finish_free();
}

void PointContact::give(const Point& point, const Vec3& mean_slip) {
  const Vec3 arm = point.place - bodies_[point.body]->pose().position;
  ledgers_[point.body].give({point.impulse, point.normal, arm, point.velocity, mean_slip});
}

void PointContact::predict_free(double dt) {
  for (RigidBody* body : settings_.free) {
    if (body != nullptr) body->free_motion()->predict(body->pose(), body->twist(), settings_.gravity, dt);
  }
  taken_.assign(bodies_.size(), {});
  for (Point& point : points_) {
    point.with_body[0] = point.with_body[1] = point.compliance;
    const FreeMotion* free = free_motion(point.body);
    if (free == nullptr) continue;
    const Mat3 lift = free->compliance_at(point.place);
    const double across = point.normal.dot(lift * point.normal);
    point.with_body[0] += across;
    point.with_body[1] += lift.trace() - across;  // the sum of the two principal values
  }
}

void PointContact::take_free(const Point& point, const Vec3& mean_slip) {
  const FreeMotion* free = free_motion(point.body);
  if (free == nullptr) return;
  Taken& taken = taken_[point.body];
  taken.impulse.linear -= point.impulse;
  taken.impulse.angular -= (point.place - free->centre()).cross(point.impulse);
  taken.loss -= point.impulse.dot(point.normal) * mean_slip.dot(point.normal);
}

void PointContact::finish_free() {
  for (std::size_t b = 0; b < settings_.free.size(); ++b) {
    RigidBody* body = settings_.free[b];
    if (body == nullptr) continue;
    body->free_motion()->finish(taken_[b].impulse, taken_[b].loss);
    body->set_twist(body->free_motion()->twist(body->pose()));
    taken_[b] = {};
  }
}

void PointContact::grid_advanced(StepContext& context) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    int held = 0;
    double area = 0.0;
    for (const Point& point : points_) {
      if (point.body != static_cast<int>(b)) continue;
      if (point.hold != Hold::free) ++held;
      if (point.hold != Hold::free || point.gap <= touching_) area += point.area;
    }
    ledgers_[b].end_step(context.dt, held, area);
  }
}

void PointContact::accounts(std::vector<ImpulseAccount>& list) const {
  for (const ContactLedger& ledger : ledgers_) list.push_back(ledger.account());
}

void PointContact::energies(EnergyReport& report) const {
  for (const ContactLedger& ledger : ledgers_) ledger.energies(report);
}

ContactLedger* PointContact::ledger_of(const RigidBody& body) {
  const auto own = [&](const ContactLedger& ledger) { return &ledger.body() == &body; };
  const auto found = std::find_if(ledgers_.begin(), ledgers_.end(), own);
  return found == ledgers_.end() ? nullptr : &*found;
}

void PointContact::keep(StateArchive& archive) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const StateArchive::Group group(archive, "body_" + std::to_string(b));
    ledgers_[b].keep(archive);
  }
  archive.rows("points", memory_);
  archive.column("points/id", memory_, &Memory::id);
  archive.column("points/force", memory_, &Memory::force);
  archive.column("points/slid", memory_, &Memory::slid);
  archive.column("points/overlap", memory_, &Memory::overlap);
  archive.column("points/hold", memory_, &Memory::hold);
}

}  // namespace mpm
