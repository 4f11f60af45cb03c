#include "mpm/boundary/condition.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kUnit = 1e-9;          ///< largest error of a unit vector's length
constexpr double kSameOrAcross = 1e-9;  ///< largest error of the cosine of directions that are the same or orthogonal
constexpr double kOnSurface = 1e-6;     ///< part of a cell: a node so far outside the region is on its surface

bool moves(const RigidBodyDefinition& region) {
  const auto moving = [](const Function& f) { return !f.is_zero(); };
  return std::any_of(region.velocity.begin(), region.velocity.end(), moving) ||
         std::any_of(region.rotation_rate.begin(), region.rotation_rate.end(), moving);
}

double along(const NodalField& field, const GridLayout& layout, NodeRef ref, const Vec3& direction) {
  return nodal_vector(field, layout, ref).dot(direction);
}

}  // namespace

VelocityConditions::VelocityConditions(const std::vector<ConditionDefinition>& definitions, std::vector<HeldFace> faces,
                                       const GridLayout& layout, int field)
    : field_(field), layout_(layout), faces_(std::move(faces)) {
  for (const ConditionDefinition& definition : definitions) {
    Condition condition{
        RigidBody(definition.region), definition.direction, definition.velocity, definition.where, {}, Vec3::Zero()};
    condition.account.name = "condition/" + condition.region.name();
    double squared = 0.0;
    for (int k = 0; k < layout.dim(); ++k) squared += std::pow(condition.direction[layout.axis(k)], 2);
    if (!(std::abs(squared - 1.0) < kUnit)) {
      throw ConditionError(
          fmt::format("{}: its direction has the length {:.6g} along the grid's axes; give it length 1",
                      title(condition), std::sqrt(squared)));
    }
    moving_ = moving_ || moves(definition.region);
    conditions_.push_back(std::move(condition));
  }
}

std::string VelocityConditions::title(const Condition& condition) const {
  const std::string name = fmt::format("condition '{}'", condition.region.name());
  return condition.where.empty() ? name : condition.where + ": " + name;
}

void VelocityConditions::check_walls(const Condition& condition, const std::array<int, 3>& node,
                                     const GridLayout& layout) const {
  for (const HeldFace& face : faces_) {
    const int axis = face.face / 2;
    if (face.face % 2 == 0 ? node[axis] > 0 : node[axis] < layout.last_node(axis)) continue;
    const double cosine = std::abs(condition.direction[layout.axis(axis)]);
    if (cosine < kSameOrAcross || std::abs(cosine - 1.0) < kSameOrAcross) continue;
    throw ConditionError(
        fmt::format("{}: its direction is neither along nor across the normal of the slip wall {}, whose nodes it "
                    "holds too; let the region end before the wall, or make the wall none",
                    title(condition), face.name));
  }
}

void VelocityConditions::join(const Found* begin, const Found* end, const std::array<int, 3>& block) {
  const GridLayout& layout = layout_;
  const std::size_t first_held = held_.size();
  const Vec3 position = layout.node_position(block, begin->ref.node);
  for (const Found* found = begin; found != end; ++found) {
    const Condition& condition = conditions_[found->condition];
    check_walls(condition, layout.node(block, begin->ref.node), layout);
    bool same = false;
    for (std::size_t h = first_held; h < held_.size(); ++h) {
      const double cosine = condition.direction.dot(held_[h].direction);
      same = same || std::abs(std::abs(cosine) - 1.0) < kSameOrAcross;
      if (std::abs(cosine) < kSameOrAcross || std::abs(std::abs(cosine) - 1.0) < kSameOrAcross) continue;
      throw ConditionError(
          fmt::format("{}: at the node ({:.6g}, {:.6g}, {:.6g}) m its direction is neither along nor across that of "
                      "condition '{}'; conditions on one node must be orthogonal, or along one direction, where they "
                      "add: turn one, or keep their regions apart",
                      title(condition), position.x(), position.y(), position.z(),
                      conditions_[parts_[held_[h].first].condition].region.name()));
    }
    if (same) continue;
    Held held{begin->ref, position, condition.direction, static_cast<int>(parts_.size()), 0, 0.0, 0.0};
    for (const Found* other = found; other != end; ++other) {
      const double cosine = conditions_[other->condition].direction.dot(condition.direction);
      if (std::abs(std::abs(cosine) - 1.0) >= kSameOrAcross) continue;
      parts_.push_back({other->condition, cosine > 0.0 ? 1.0 : -1.0});
      ++held.count;
    }
    held_.push_back(held);
  }
}

void VelocityConditions::find_nodes(const Grid& grid) {
  generation_ = grid.blocks.generation();
  find_in(grid.blocks.size(), [&](int b) -> const std::array<int, 3>& { return grid.blocks.block(b); });
}

void VelocityConditions::find_nodes(const std::vector<std::array<int, 3>>& blocks) {
  generation_ = 0;  // those of no grid of the host
  listed_ = blocks;
  find_in(static_cast<int>(blocks.size()), [&](int b) -> const std::array<int, 3>& { return blocks[b]; });
}

template <class BlockAt>
void VelocityConditions::find_in(int blocks, BlockAt&& block_at) {
  const GridLayout& layout = layout_;
  const double band = kOnSurface * layout.smallest_cell();
  found_.clear();
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const RigidBody& region = conditions_[c].region;
    const Box bounds = region.world_bounds().grown(band);
    for (int b = 0; b < blocks; ++b) {
      const std::array<int, 3>& block = block_at(b);
      const Box nodes{layout.node_position(block, 0), layout.node_position(block, layout.nodes_per_block() - 1)};
      if (!nodes.intersects(bounds)) continue;
      for (int n = 0; n < layout.nodes_per_block(); ++n) {
        SurfacePoint point;
        if (!region.surface().within(region.pose().to_body(layout.node_position(block, n)), band, point)) continue;
        found_.push_back({{b, n}, static_cast<int>(c)});
      }
    }
  }
  std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
    return a.ref.block != b.ref.block ? a.ref.block < b.ref.block : a.ref.node < b.ref.node;
  });
  held_.clear();
  parts_.clear();
  for (std::size_t i = 0, end = 0; i < found_.size(); i = end) {
    while (end < found_.size() && found_[end].ref.block == found_[i].ref.block &&
           found_[end].ref.node == found_[i].ref.node) {
      ++end;
    }
    join(&found_[i], found_.data() + end, block_at(found_[i].ref.block));
  }
}

double VelocityConditions::value(const Held& held, double time) const {
  double sum = 0.0;
  for (int i = held.first; i < held.first + held.count; ++i) {
    sum += parts_[i].sign * velocity_of(conditions_[parts_[i].condition], time, held.position);
  }
  return sum;
}

double VelocityConditions::velocity_of(const Condition& condition, double time, const Vec3& position) const {
  if (!condition.velocity) return condition.region.velocity_at(position).dot(condition.direction);
  try {
    return (*condition.velocity)(time, position);
  } catch (const FunctionError& error) {
    throw ConditionError(fmt::format("{}: {}", title(condition), error.what()));
  }
}

bool VelocityConditions::stirs(const RestingBlock& block, const RestTimes& times) {
  if (block.field != field_) return false;
  const auto moves = [&](const Condition& condition) { return moves_tile(condition, block, times); };
  return std::any_of(conditions_.begin(), conditions_.end(), moves);
}

bool VelocityConditions::moves_tile(const Condition& condition, const RestingBlock& block,
                                    const RestTimes& times) const {
  if (condition.velocity && condition.velocity->is_zero()) return false;
  const RigidBody& region = condition.region;
  const double margin = BlockForces::kMargin * layout_.largest_cell();
  const Box nodes{layout_.node_position(block.block, 0),
                  layout_.node_position(block.block, layout_.nodes_per_block() - 1)};
  if (moves(region.definition())) return region.world_bounds().intersects(nodes.grown(kBlockEdge * margin));
  if (!condition.velocity || !region.world_bounds().intersects(nodes.grown(margin))) return false;
  const auto moved = [&](const Vec3& position) {
    return velocity_of(condition, times.now, position) != 0.0 || velocity_of(condition, times.ahead, position) != 0.0;
  };
  if (!condition.velocity->uses_place() && !moved(nodes.center())) return false;
  const double band = kOnSurface * layout_.smallest_cell();
  bool any = false;
  each_tile_node(layout_.dim(), [&](int, int beside, int node) {
    if (any) return;
    const Vec3 position = layout_.node_position(neighbour_of(block.block, beside, layout_.dim()), node);
    SurfacePoint point;
    any = region.surface().within(region.pose().to_body(position), band, point) && moved(position);
  });
  return any;
}

bool VelocityConditions::holds(int field, const Grid& grid, NodeRef node) const {
  if (field != field_) return false;
  if (generation_ != grid.blocks.generation()) {
    const std::array<int, 3>& block = grid.blocks.block(node.block);
    const auto found = std::lower_bound(listed_.begin(), listed_.end(), block);
    if (found == listed_.end() || *found != block) return false;
    node.block = static_cast<int>(found - listed_.begin());
  }
  const auto before = [](const Held& held, const NodeRef& ref) {
    return held.ref.block != ref.block ? held.ref.block < ref.block : held.ref.node < ref.node;
  };
  const auto at = std::lower_bound(held_.begin(), held_.end(), node, before);
  return at != held_.end() && at->ref == node;
}

double VelocityConditions::largest_speed(double time) const {
  double largest = 0.0;
  for (const Held& held : held_) largest = std::max(largest, std::abs(value(held, time)));
  return largest;
}

void VelocityConditions::limit_step(const PeriodAhead& period, StepLimit& limit) const {
  StepLimit own;
  own.by = this;
  for (const double part : {0.0, 0.5, 1.0}) {
    own.speed = std::max(own.speed, largest_speed(period.start + part * period.length));
  }
  own.dt = period.reach() / own.speed;
  if (own.speed > 0.0) limit.tighten(own);
}

std::string VelocityConditions::limit_text(const StepLimit& limit) const {
  return fmt::format("speed of 'boundaries.conditions' ({:.4g} m/s)", limit.speed);
}

void VelocityConditions::begin_step(double start, double dt) {
  for (Condition& condition : conditions_) {
    try {
      condition.region.begin_step(start, dt);
    } catch (const FunctionError& error) {
      throw ConditionError(fmt::format("{}: its region's motion: {}", title(condition), error.what()));
    }
  }
}

void VelocityConditions::find_velocities(double start, double dt) {
  for (Held& held : held_) {
    held.start = value(held, start);
    held.end = value(held, start + dt);
  }
}

bool VelocityConditions::changing() const {
  const auto changes = [](const Condition& condition) { return condition.velocity && condition.velocity->uses_time(); };
  return moving_ || std::any_of(conditions_.begin(), conditions_.end(), changes);
}

void VelocityConditions::count(int condition, double impulse, double exchanged) {
  Condition& one = conditions_.at(static_cast<std::size_t>(condition));
  one.account.impulse += impulse * one.direction;
  one.account.exchanged += exchanged;
}

void VelocityConditions::momentum_gathered(FieldContext& context) {
  begin_step(context.start, context.dt);
  if (moving_ || generation_ != context.grid.blocks.generation()) find_nodes(context.grid);
  find_velocities(context.start, context.dt);
  ended_ = false;
  if (!context.works_at_end) return;
  std::vector<Grid::Prescribed>& list = context.grid.prescribed;
  list.clear();
  for (const Held& held : held_) {
    int axis = 0;
    held.direction.cwiseAbs().maxCoeff(&axis);
    list.push_back({held.ref, axis});
  }
}

void VelocityConditions::before_strain(FieldContext& context) {
  Grid& grid = context.grid;
  for (const Held& held : held_) {
    const double change =
        (ended_ ? held.end : held.start) - along(grid.velocity, grid.layout, held.ref, held.direction);
    add_nodal_vector(grid.velocity, grid.layout, held.ref, change * held.direction);
  }
}

void VelocityConditions::momentum_updated(FieldContext& context) {
  Grid& grid = context.grid;
  ended_ = true;
  for (const Held& held : held_) {
    const double velocity = context.works_at_end ? held.end : 0.5 * (held.start + held.end);
    if (!grid.carries(held.ref.block, held.ref.node)) continue;
    const Vec3 change = (held.end - along(grid.velocity, grid.layout, held.ref, held.direction)) * held.direction;
    add_nodal_vector(grid.velocity, grid.layout, held.ref, change);
    add_nodal_vector(grid.force, grid.layout, held.ref, change / context.dt);
    if (grid.counts(held.ref.block)) give(held, grid.mass.at(held.ref.block, 0, held.ref.node) * change, velocity);
  }
}

void VelocityConditions::velocity_found(FieldContext& context) {
  NodalField& velocity = context.grid.increment;
  const GridLayout& layout = context.grid.layout;
  for (const Held& held : held_) {
    const double change = held.end - along(velocity, layout, held.ref, held.direction);
    add_nodal_vector(velocity, layout, held.ref, change * held.direction);
  }
}

void VelocityConditions::increment_found(FieldContext& context) {
  Grid& grid = context.grid;
  NodalField& increment = grid.increment;
  for (const Held& held : held_) {
    if (!grid.carries(held.ref.block, held.ref.node)) continue;
    const Vec3 change = -along(increment, grid.layout, held.ref, held.direction) * held.direction;
    add_nodal_vector(increment, grid.layout, held.ref, change);
    if (!grid.counts(held.ref.block)) continue;
    give(held, grid.mass.at(held.ref.block, 0, held.ref.node) * change, 0.5 * (held.start + held.end));
  }
}

void VelocityConditions::give(const Held& held, const Vec3& impulse, double velocity) {
  for (int i = held.first; i < held.first + held.count; ++i) {
    conditions_[parts_[i].condition].given += impulse / held.count;
  }
  work_ += velocity * impulse.dot(held.direction);
}

void VelocityConditions::grid_advanced(FieldContext& context) {
  for (Condition& condition : conditions_) {
    condition.account.add(condition.given);
    condition.given = Vec3::Zero();
  }
  end_step(context.dt);
}

void VelocityConditions::end_step(double dt) {
  for (Condition& condition : conditions_) condition.region.end_step(dt);
}

void VelocityConditions::accounts(std::vector<ImpulseAccount>& list) const {
  for (const Condition& condition : conditions_) list.push_back(condition.account);
}

// The nodes last found and their velocities give the next period's largest speed.
void VelocityConditions::serialise(StateArchive& archive) {
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    const StateArchive::Group group(archive, "condition_" + std::to_string(c));
    conditions_[c].region.serialise(archive);
    conditions_[c].account.serialise(archive);
    archive.sum("given", conditions_[c].given);
  }
  archive.rows("held", held_);
  archive.column("held/block", held_, [](Held& held) -> int& { return held.ref.block; });
  archive.column("held/node", held_, [](Held& held) -> int& { return held.ref.node; });
  archive.column("held/position", held_, &Held::position);
  archive.column("held/direction", held_, &Held::direction);
  archive.column("held/first", held_, &Held::first);
  archive.column("held/count", held_, &Held::count);
  archive.column("held/start", held_, &Held::start);
  archive.column("held/end", held_, &Held::end);
  if (archive.merging()) {  // parts follow each other, held by held
    int first = 0;
    for (Held& held : held_) {
      held.first = first;
      first += held.count;
    }
  }
  archive.rows("parts", parts_);
  archive.column("parts/condition", parts_, &Part::condition);
  archive.column("parts/sign", parts_, &Part::sign);
  archive.value("ended", ended_);
  archive.generation("sorts_since", generation_);
  archive.sum("work", work_);
}

}  // namespace mpm
