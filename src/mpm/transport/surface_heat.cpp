#include "mpm/transport/surface_heat.hpp"

#include <fmt/core.h>

#include <utility>

#include "mpm/step/coulomb.hpp"
#include "mpm/step/domain_faces.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {
namespace {

constexpr std::size_t kTouches = 1024;  ///< for which there is room at the start; more make their own
constexpr std::size_t kSharesOfATouch = 8;

}  // namespace

SurfaceHeat::SurfaceHeat(const Fields& fields, const std::vector<RigidBody>& bodies, std::vector<double> effusivities,
                         std::vector<ToolHeat> tools, std::vector<double> pairs, const Communicator* ranks)
    : fields_(fields),
      bodies_(bodies),
      effusivities_(std::move(effusivities)),
      tools_(std::move(tools)),
      pairs_(std::move(pairs)),
      ranks_(ranks) {
  friction_.name = "friction";
  conducted_.name = "tools";
  touches_.reserve(kTouches);
  shares_.reserve(kTouches * kSharesOfATouch);
  meetings_.reserve(kTouches);
  for (ToolHeat& tool : tools_) {
    if (tool.definition.capacity > 0.0) tool.temperature = tool.definition.temperature(0.0);
  }
}

double SurfaceHeat::tool_temperature(int tool, double time) const {
  const ToolHeat& of = tools_[tool];
  if (of.definition.capacity > 0.0) return of.temperature;
  try {
    return of.definition.temperature(time);
  } catch (const FunctionError& error) {
    throw TransportError(fmt::format("temperature of rigid body '{}': {}", of.definition.body, error.what()));
  }
}

int SurfaceHeat::field_of(const Grid& grid) const {
  int field = 0;
  while (fields_[field].get() != &grid) ++field;
  return field;
}

int SurfaceHeat::tool_of(const RigidBody* body) const {
  if (body == nullptr) return -1;
  const auto tool = static_cast<int>(body - bodies_.data());
  return tools_[tool].definition.conductance > 0.0 ? tool : -1;
}

NodeRef SurfaceHeat::find(int field, std::uint64_t node) const {
  const Grid& grid = *fields_[field];
  const NodeRef ref{grid.blocks.find(HeldNodes::block_key(node)), HeldNodes::node(node)};
  return ref.block >= 0 && grid.carries(ref.block, ref.node) ? ref : NodeRef{-1, 0};
}

void SurfaceHeat::touch(const RigidBody& tool, const Grid& grid, const Vec3& place, double area, double friction,
                        double dt) {
  const int heated = tool_of(&tool);
  if (heated < 0 && friction == 0.0) return;
  PlacedDomain::Vector at{};
  for (int k = 0; k < grid.layout.dim(); ++k) at[k] = place[grid.layout.axis(k)];
  const NodeShares found = node_shares(grid, at);
  const int first = static_cast<int>(shares_.size());
  for (int i = 0; i < found.count; ++i) {
    shares_.push_back({HeldNodes::id(grid.blocks.key(found.node[i].block), found.node[i].node), found.share[i]});
  }
  touches_.push_back({heated, field_of(grid), first, found.count, area, friction, dt, true});
}

void SurfaceHeat::rub(const RigidBody* tool, const Grid& grid, std::uint64_t node, double friction, double dt) {
  if (friction == 0.0) return;
  touches_.push_back(
      {tool_of(tool), field_of(grid), static_cast<int>(shares_.size()), 1, 0.0, friction, dt, tool != nullptr});
  shares_.push_back({node, 1.0});
}

void SurfaceHeat::meet(const Grid& one, const Grid& other, std::uint64_t node, double area, double friction,
                       double dt) {
  meetings_.push_back({field_of(one), field_of(other), node, area, friction, dt});
}

void SurfaceHeat::give(const Touch& touch, std::vector<NodalQuantity>& nodes, double start, double dt) {
  NodalQuantity& of = nodes[touch.field];
  double there = 0.0, whole = 0.0;
  for (int i = touch.first; i < touch.first + touch.count; ++i) {
    const NodeRef ref = find(touch.field, shares_[i].node);
    if (ref.block < 0) continue;
    whole += shares_[i].share;
    there += shares_[i].share * of.value.at(ref.block, 0, ref.node);
  }
  const bool keeps = ranks_ == nullptr || touch.by_tool;  // what all ranks keep and give alike
  if (!(whole > 0.0)) {
    if (keeps) kept_ += touch.friction;
    return;
  }
  double conducted = 0.0, warms = touch.friction + (keeps ? std::exchange(kept_, 0.0) : 0.0);
  if (touch.tool >= 0) {
    ToolHeat& tool = tools_[touch.tool];
    const double friction = warms;
    warms *= tool.definition.friction_part;
    conducted =
        tool.definition.conductance * touch.area * (tool_temperature(touch.tool, start) - there / whole) * touch.dt;
    tool.to_material += conducted;
    tool.from_friction += friction - warms;
    if (tool.definition.capacity > 0.0) tool.temperature += (friction - warms - conducted) / tool.definition.capacity;
  }
  if (counts(touch)) {
    rubbed_ += warms;
    given_ += conducted;
  }
  for (int i = touch.first; i < touch.first + touch.count; ++i) {
    const NodeRef ref = find(touch.field, shares_[i].node);
    if (ref.block >= 0) of.source.at(ref.block, 0, ref.node) += shares_[i].share / whole * (conducted + warms) / dt;
  }
}

void SurfaceHeat::give(const Meeting& meeting, std::vector<NodalQuantity>& nodes, double dt) {
  const NodeRef one = find(meeting.field, meeting.node), other = find(meeting.other_field, meeting.node);
  const bool keeps = ranks_ == nullptr;
  if (one.block < 0 || other.block < 0) {
    if (keeps) kept_ += meeting.friction;
    return;
  }
  NodalQuantity &a = nodes[meeting.field], &b = nodes[meeting.other_field];
  const double difference = b.value.at(other.block, 0, other.node) - a.value.at(one.block, 0, one.node);
  const double conductance = pairs_[meeting.field * fields_.size() + meeting.other_field];
  const double heat = conductance * meeting.area * difference * meeting.dt / dt;
  const double sum = effusivities_[meeting.field] + effusivities_[meeting.other_field];
  const double part = sum > 0.0 ? effusivities_[meeting.field] / sum : 0.5;
  const double friction = (meeting.friction + (keeps ? std::exchange(kept_, 0.0) : 0.0)) / dt;
  if (counts(meeting.field, one)) rubbed_ += friction * dt;
  a.source.at(one.block, 0, one.node) += heat + part * friction;
  b.source.at(other.block, 0, other.node) += (1.0 - part) * friction - heat;
}

void SurfaceHeat::give(std::vector<NodalQuantity>& nodes, double start, double dt) {
  rubbed_ = given_ = 0.0;
  for (const Touch& touch : touches_) give(touch, nodes, start, dt);
  for (const Meeting& meeting : meetings_) give(meeting, nodes, dt);
  friction_.add(rubbed_);
  conducted_.add(given_);
  shares_.clear();
  touches_.clear();
  meetings_.clear();
}

bool SurfaceHeat::counts(const Touch& touch) const {
  if (ranks_ == nullptr) return true;
  if (touch.by_tool) return ranks_->first();
  const NodeRef node = find(touch.field, shares_[touch.first].node);
  return node.block >= 0 && counts(touch.field, node);
}

double SurfaceHeat::waiting() const {
  double sum = ranks_ == nullptr || ranks_->first() ? kept_ : 0.0;
  for (const Touch& touch : touches_) sum += counts(touch) ? touch.friction : 0.0;
  for (const Meeting& meeting : meetings_) {
    const NodeRef node = find(meeting.field, meeting.node);
    if (ranks_ == nullptr || (node.block >= 0 && counts(meeting.field, node))) sum += meeting.friction;
  }
  return sum;
}

void SurfaceHeat::accounts(std::vector<ContentAccount>& list) const {
  list.push_back(friction_);
  list.push_back(conducted_);
}

void SurfaceHeat::serialise(StateArchive& archive) {
  archive.value("kept", kept_);
  archive.sum("friction", friction_.given);
  archive.sum("friction_exchanged", friction_.exchanged);
  archive.sum("conducted", conducted_.given);
  archive.sum("conducted_exchanged", conducted_.exchanged);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const StateArchive::Group group(archive, "tool_" + std::to_string(i));
    archive.value("temperature", tools_[i].temperature);
    archive.value("to_material", tools_[i].to_material);
    archive.value("from_friction", tools_[i].from_friction);
  }
  archive.rows("shares", shares_);
  archive.column("shares/node", shares_, &Share::node);
  archive.column("shares/share", shares_, &Share::share);
  archive.rows("touches", touches_);
  archive.column("touches/tool", touches_, &Touch::tool);
  archive.column("touches/field", touches_, &Touch::field);
  archive.column("touches/first", touches_, &Touch::first);
  archive.column("touches/count", touches_, &Touch::count);
  archive.column("touches/area", touches_, &Touch::area);
  archive.column("touches/friction", touches_, &Touch::friction);
  archive.column("touches/dt", touches_, &Touch::dt);
  archive.column("touches/by_tool", touches_, &Touch::by_tool);
  if (archive.merging() && !touches_.empty()) {
    throw TransportError(
        "heat of friction waits in this checkpoint for places that several ranks know: only as many ranks as have "
        "written "
        "it can take it on");
  }
}

}  // namespace mpm
