#include "mpm/contact/point_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/contact/particle_reach.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm/step/point_weights.hpp"

namespace mpm {
namespace {

constexpr double kWatched = 0.1;   ///< cells: a point this near is held if it comes nearer in this step
constexpr double kPushOut = 2e-4;  ///< cells a step at most that a point inside a body is moved out
constexpr int kMostSweeps = 40;
constexpr double kTolerance = 1e-3;  ///< change of velocity in a sweep over the largest one, at which sweeps end

std::uint64_t id_of(std::uint32_t particle, int body) { return (static_cast<std::uint64_t>(particle) << 16) + body; }

}  // namespace

PointContact::PointContact(const std::vector<RigidBody>& bodies, const std::vector<ParticleSet>& sets,
                           const PointContactSettings& settings)
    : bodies_(bodies), sets_(sets), settings_(settings) {
  for (const RigidBody& body : bodies) ledgers_.emplace_back(body, axisymmetric(settings.geometry));
}

const PointContact::Memory* PointContact::find(std::uint64_t id) const {
  const auto it = std::lower_bound(memory_.begin(), memory_.end(), id,
                                   [](const Memory& memory, std::uint64_t wanted) { return memory.id < wanted; });
  return it != memory_.end() && it->id == id ? &*it : nullptr;
}

template <class Geometry>
void PointContact::find_points(const StepContext& context) {
  const Grid& grid = context.grid;
  const GridLayout& layout = grid.layout;
  const double cell = layout.smallest_cell();
  // A block's particles have not left it by more than a node; they are a box deeper than their centre.
  Vec3 half_block = Vec3::Zero();
  double most_reach = 0.0;
  for (int k = 0; k < layout.dim(); ++k) {
    half_block[layout.axis(k)] = (0.5 * (kBlockEdge - 1) + 1.5) * layout.cell(k);
    for (const ParticleSet& set : sets_) most_reach = std::max(most_reach, 3.0 * set.half[k] * layout.cell(k));
  }
  const double band = most_reach + 2.0 * kWatched * cell;
  near_.clear();
  for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
    const int block = grid.blocks.owner_block(owner);
    const Vec3 middle = 0.5 * (layout.node_position(grid.blocks.block(block), 0) +
                               layout.node_position(grid.blocks.block(block), layout.nodes_per_block() - 1));
    for (const RigidBody& body : bodies_) {
      SurfacePoint point;
      if (!body.surface().within(body.pose().to_body(middle), half_block.norm() + band, point)) continue;
      near_.push_back(owner);
      break;
    }
  }
  while (of_owner_.size() < near_.size()) of_owner_.emplace_back();
  const int count = static_cast<int>(near_.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(settings_.threads)
  for (int i = 0; i < count; ++i) {
    of_owner_[i].clear();
    for (const ParticleSet& set : sets_) {
      const int first = static_cast<int>(set.group[set.group_begin[near_[i]]]);
      const int end = static_cast<int>(set.group[set.group_begin[near_[i] + 1]]);
      for (int p = first; p < end; ++p) {
        Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
        for (int k = 0; k < layout.dim(); ++k) {
          centre[layout.axis(k)] = set.x[k][p];
          velocity[layout.axis(k)] = set.v[k][p];
        }
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
          const RigidBody& body = bodies_[b];
          SurfacePoint surface;
          if (!body.surface().within(body.pose().to_body(centre), band, surface)) continue;
          Point point;
          point.normal = body.pose().orientation * surface.normal;
          const double reach = particle_reach<Geometry>(set, layout, p, point.normal);
          point.gap = surface.distance - reach;
          point.place = centre - reach * point.normal;
          point.velocity = body.velocity_at(point.place);
          const double closing = -(velocity - point.velocity).dot(point.normal) * context.dt;
          if (point.gap > kWatched * cell + 2.0 * closing) continue;
          point.body = static_cast<int>(b);
          point.particle = set.id[p];
          double volume = determinant(Geometry::load_matrix(set.f, p)) * settings_.across;
          for (int k = 0; k < layout.dim(); ++k) volume *= 2.0 * set.half[k] * layout.cell(k);
          if (axisymmetric(settings_.geometry)) volume *= kTurn * centre.x();
          point.area = volume / (2.0 * reach);
          point.law = body.friction();
          of_owner_[i].push_back(point);
        }
      }
    }
  }
}

void PointContact::momentum_gathered(StepContext& context) {
  with_geometry(settings_.geometry, [&](auto kind) { find_points<decltype(kind)>(context); });
  connect(context);
}

void PointContact::connect(const StepContext& context) {
  const Grid& grid = context.grid;
  const int per_block = grid.layout.nodes_per_block();
  slot_.resize(static_cast<std::size_t>(grid.blocks.size()) * per_block, -1);
  nodes_.clear();
  points_.clear();
  parts_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (Point& point : of_owner_[i]) {
      const PointWeights weights(grid, settings_.shape, point.place);
      if (weights.count == 0) continue;
      point.first = static_cast<int>(parts_.size());
      point.compliance = 0.0;
      for (int n = 0; n < weights.count; ++n) {
        const NodeRef ref = weights.node[n];
        int& slot = slot_[static_cast<std::size_t>(ref.block) * per_block + ref.node];
        if (slot < 0) {
          slot = static_cast<int>(nodes_.size());
          nodes_.push_back({ref, 1.0 / grid.mass.at(ref.block, 0, ref.node)});
        }
        const double lifted = weights.weight[n] * nodes_[slot].inverse_mass;
        parts_.push_back({slot, weights.weight[n], lifted});
        point.compliance += weights.weight[n] * lifted;
      }
      point.end = static_cast<int>(parts_.size());
      const Memory* memory = find(id_of(point.particle, point.body));
      point.hold = memory != nullptr ? memory->hold : Hold::free;
      point.impulse = memory != nullptr ? Vec3(memory->force * context.dt) : Vec3::Zero();
      points_.push_back(point);
    }
  }
  for (const Node& node : nodes_) slot_[static_cast<std::size_t>(node.ref.block) * per_block + node.ref.node] = -1;
  velocity_.resize(nodes_.size());
  loaded_.resize(nodes_.size());
}

void PointContact::load(const NodalField& field, const GridLayout& layout) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Vec3 v = nodal_vector(field, layout, nodes_[n].ref);
    loaded_[n] = velocity_[n] = {v.x(), v.y(), v.z()};
  }
}

void PointContact::store(NodalField& field, const GridLayout& layout, double factor) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Vec3 change;
    for (int k = 0; k < 3; ++k) change[k] = factor * (velocity_[n][k] - loaded_[n][k]);
    add_nodal_vector(field, layout, nodes_[n].ref, change);
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

void PointContact::push(const Point& point, const Vec3& impulse) {
  for (int i = point.first; i < point.end; ++i) {
    for (int k = 0; k < 3; ++k) velocity_[parts_[i].node][k] += parts_[i].lifted * impulse[k];
  }
}

// step: unilateral, with friction. strain: the same where a point was free; what was held keeps to the surface. held:
// only that, of a velocity that is relative already or is not.
template <PointContact::Pass Kind>
double PointContact::relax(Point& point, double dt) {
  if (Kind == Pass::held && point.hold == Hold::free) return 0.0;
  const Vec3 surface = Kind == Pass::held && dt == 0.0 ? Vec3(Vec3::Zero()) : point.velocity;
  const Vec3 slip = velocity_at(point) - surface;
  const bool bound = Kind != Pass::step && point.hold != Hold::free;
  const double allowed = bound ? 0.0 : -std::max(point.gap, 0.0) / dt;
  const double approach = slip.dot(point.normal);
  const double pressed = point.impulse.dot(point.normal);
  Vec3 along = point.impulse - pressed * point.normal;
  double normal = pressed + (allowed - approach) / point.compliance;
  if (!bound) normal = std::max(normal, 0.0);
  const Vec3 sliding = slip - approach * point.normal;
  if (bound) {
    if (point.hold == Hold::stick) along -= sliding / point.compliance;
  } else {
    along -= sliding / point.compliance;
    const double limit = point.law.coefficient * normal, length = along.norm();
    if (normal <= 0.0) {
      along.setZero();
      point.hold = Kind == Pass::step ? Hold::free : point.hold;
    } else if (!point.law.stick && length > limit) {
      along *= limit / length;
      if (Kind == Pass::step) point.hold = Hold::slide;
    } else if (Kind == Pass::step) {
      point.hold = Hold::stick;
    }
  }
  const Vec3 impulse = normal * point.normal + along, change = impulse - point.impulse;
  point.impulse = impulse;
  push(point, change);
  return change.norm() * point.compliance;
}

template <PointContact::Pass Kind>
void PointContact::solve(double dt, bool) {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double largest = 0.0, scale = 0.0;
    const auto visit = [&](Point& point) {
      largest = std::max(largest, relax<Kind>(point, dt));
      scale = std::max(scale, point.impulse.norm() * point.compliance);
    };
    if (sweep % 2 == 0) {
      for (Point& point : points_) visit(point);
    } else {
      for (auto point = points_.rbegin(); point != points_.rend(); ++point) visit(*point);
    }
    if (largest <= kTolerance * scale) break;
  }
}

void PointContact::before_strain(StepContext& context) {
  if (points_.empty()) return;
  Grid& grid = context.grid;
  load(grid.velocity, grid.layout);
  std::vector<Vec3>& kept = kept_;
  kept.clear();
  for (Point& point : points_) {
    kept.push_back(point.impulse);
    point.impulse.setZero();
  }
  solve<Pass::strain>(context.dt, false);
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].impulse = kept[i];
  store(grid.velocity, grid.layout);
}

void PointContact::momentum_updated(StepContext& context) {
  memory_.clear();
  if (points_.empty()) return;
  Grid& grid = context.grid;
  load(grid.velocity, grid.layout);
  for (Point& point : points_) point.approach = velocity_at(point) - point.velocity;
  for (Point& point : points_) {
    // As the body has turned since the step before, the force turns with the normal.
    const double normal = std::max(point.impulse.dot(point.normal), 0.0);
    point.impulse = point.hold == Hold::free
                        ? Vec3(Vec3::Zero())
                        : Vec3(point.impulse + (normal - point.impulse.dot(point.normal)) * point.normal);
    push(point, point.impulse);
  }
  solve<Pass::step>(context.dt, false);
  store(grid.velocity, grid.layout);
  store(grid.force, grid.layout, 1.0 / context.dt);
  for (Point& point : points_) {
    if (point.hold == Hold::free) continue;
    const Vec3 after = velocity_at(point) - point.velocity;
    ledgers_[point.body].give({point.impulse, point.normal, point.place - bodies_[point.body].pose().position,
                               point.velocity, 0.5 * (point.approach + after)});
    memory_.push_back({id_of(point.particle, point.body), point.impulse / context.dt, point.hold});
  }
  std::sort(memory_.begin(), memory_.end(), [](const Memory& a, const Memory& b) { return a.id < b.id; });
}

void PointContact::velocity_found(StepContext& context, NodalField& velocity) {
  if (points_.empty()) return;
  load(velocity, context.grid.layout);
  for (Point& point : points_) point.impulse.setZero();
  solve<Pass::held>(context.dt, false);
  store(velocity, context.grid.layout);
}

void PointContact::increment_found(StepContext& context, NodalField& increment) {
  if (points_.empty()) return;
  load(increment, context.grid.layout);
  for (Point& point : points_) point.impulse.setZero();
  solve<Pass::held>(0.0, true);
  store(increment, context.grid.layout);
  for (const Point& point : points_) {
    if (point.hold == Hold::free) continue;
    ledgers_[point.body].give(
        {point.impulse, point.normal, point.place - bodies_[point.body].pose().position, point.velocity});
  }
}

void PointContact::grid_advanced(StepContext& context) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    int held = 0;
    double area = 0.0;
    for (const Point& point : points_) {
      if (point.body != static_cast<int>(b) || point.hold == Hold::free) continue;
      ++held;
      area += point.area;
    }
    ledgers_[b].end_step(context.dt, held, area);
  }
}

void PointContact::accounts(std::vector<ImpulseAccount>& list) const {
  for (const ContactLedger& ledger : ledgers_) list.push_back(ledger.account());
}

}  // namespace mpm
