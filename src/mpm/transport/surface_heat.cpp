#include "mpm/transport/surface_heat.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/ranks/of_all.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/domain_faces.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {
namespace {

constexpr std::size_t kTouches = 1024;  ///< for which there is room at the start; more make their own
constexpr std::size_t kSharesOfATouch = 8;

/// Exchange in a time of so many time constants, over what the difference at its start would exchange.
double part_exchanged(double constants) { return constants > 1e-12 ? -std::expm1(-constants) / constants : 1.0; }

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
  tool_loads_.assign(tools_.size(), 0.0);
  const auto conducts = [](const ToolHeat& tool) { return tool.definition.conductance > 0.0; };
  if (std::any_of(tools_.begin(), tools_.end(), conducts) ||
      std::any_of(pairs_.begin(), pairs_.end(), [](double conductance) { return conductance > 0.0; })) {
    loads_.assign(fields.size(), NodalField(1, fields.front()->layout.nodes_per_block()));
  }
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

void SurfaceHeat::touch(const RigidBody& tool, const MaterialNodes& material, const Vec3& place, double area,
                        double friction, double dt) {
  const int heated = tool_of(&tool);
  if (heated < 0 && friction == 0.0) return;
  const GridLayout& layout = material.grid().layout;
  PlacedDomain::Vector at{};
  for (int k = 0; k < layout.dim(); ++k) at[k] = place[layout.axis(k)];
  const NodeShares found = node_shares(material, at);
  const int first = static_cast<int>(shares_.size());
  for (int i = 0; i < found.count; ++i) {
    const std::uint64_t block = fields_[found.field[i]]->blocks.key(found.node[i].block);
    shares_.push_back({found.field[i], HeldNodes::id(block, found.node[i].node), found.share[i]});
  }
  touches_.push_back({heated, first, found.count, area, friction, dt, true});
}

void SurfaceHeat::rub(const RigidBody* tool, const Grid& grid, std::uint64_t node, double friction, double dt) {
  if (friction == 0.0) return;
  touches_.push_back({tool_of(tool), static_cast<int>(shares_.size()), 1, 0.0, friction, dt, tool != nullptr});
  shares_.push_back({field_of(grid), node, 1.0});
}

void SurfaceHeat::meet(const Grid& one, const Grid& other, std::uint64_t node, double area, double friction,
                       double dt) {
  meetings_.push_back({field_of(one), field_of(other), node, area, friction, dt});
}

double SurfaceHeat::whole_of(const Touch& touch) const {
  double whole = 0.0;
  for (int i = touch.first; i < touch.first + touch.count; ++i) {
    if (find(shares_[i]).block >= 0) whole += shares_[i].share;
  }
  return whole;
}

void SurfaceHeat::load() {
  for (std::size_t f = 0; f < loads_.size(); ++f) loads_[f].resize(fields_[f]->blocks.size());
  std::fill(tool_loads_.begin(), tool_loads_.end(), 0.0);
  const auto each = [&](auto&& visit) {
    for (const Touch& touch : touches_) {
      if (touch.tool < 0) continue;
      const double whole = whole_of(touch);
      if (!(whole > 0.0)) continue;
      const ToolHeat& tool = tools_[touch.tool];
      const double all = tool.definition.conductance * touch.area * touch.dt / whole;
      for (int i = touch.first; i < touch.first + touch.count; ++i) {
        const NodeRef ref = find(shares_[i]);
        if (ref.block >= 0) visit(shares_[i].field, ref, all * shares_[i].share, touch.tool);
      }
    }
    for (const Meeting& meeting : meetings_) {
      const NodeRef one = find(meeting.field, meeting.node), other = find(meeting.other_field, meeting.node);
      const double conductance = pairs_[meeting.field * fields_.size() + meeting.other_field];
      if (one.block < 0 || other.block < 0 || !(conductance > 0.0)) continue;
      const double all = conductance * meeting.area * meeting.dt;
      visit(meeting.field, one, all, -1);
      visit(meeting.other_field, other, all, -1);
    }
  };
  each([&](int field, const NodeRef& ref, double, int) { loads_[field].at(ref.block, 0, ref.node) = 0.0; });
  each([&](int field, const NodeRef& ref, double own, int tool) {
    loads_[field].at(ref.block, 0, ref.node) += own;
    if (tool >= 0) tool_loads_[tool] += own;
  });
}

double SurfaceHeat::constants(const std::vector<NodalQuantity>& nodes, int field, const NodeRef& ref) const {
  if (loads_.empty()) return 0.0;  // nothing conducts
  const double capacity = nodes[field].capacity.at(ref.block, 0, ref.node);
  return capacity > 0.0 ? loads_[field].at(ref.block, 0, ref.node) / capacity : 0.0;
}

void SurfaceHeat::give(const Touch& touch, std::vector<NodalQuantity>& nodes, double start, double dt) {
  const double whole = whole_of(touch);
  const bool keeps = ranks_ == nullptr || touch.by_tool;  // true for what all ranks keep and give alike
  if (!(whole > 0.0)) {
    if (keeps) kept_ += touch.friction;
    return;
  }
  double warms = touch.friction + (keeps ? std::exchange(kept_, 0.0) : 0.0);
  const double friction = warms;
  double full = 0.0, temperature = 0.0, tool_constants = 0.0;
  if (touch.tool >= 0) {
    const ToolHeat& tool = tools_[touch.tool];
    warms *= tool.definition.friction_part;
    full = tool.definition.conductance * touch.area * touch.dt / whole;
    temperature = tool_temperature(touch.tool, start);
    if (tool.definition.capacity > 0.0) tool_constants = tool_loads_[touch.tool] / tool.definition.capacity;
  }
  double conducted = 0.0;
  for (int i = touch.first; i < touch.first + touch.count; ++i) {
    const NodeRef ref = find(shares_[i]);
    if (ref.block < 0) continue;
    NodalQuantity& of = nodes[shares_[i].field];
    double heat = 0.0;
    if (touch.tool >= 0) {
      heat = full * shares_[i].share * part_exchanged(constants(nodes, shares_[i].field, ref) + tool_constants) *
             (temperature - of.value.at(ref.block, 0, ref.node));
      conducted += heat;
    }
    of.source.at(ref.block, 0, ref.node) += (heat + shares_[i].share / whole * warms) / dt;
  }
  if (touch.tool >= 0) {
    ToolHeat& tool = tools_[touch.tool];
    tool.to_material += conducted;
    tool.from_friction += friction - warms;
    if (tool.definition.capacity > 0.0) tool.temperature += (friction - warms - conducted) / tool.definition.capacity;
  }
  if (counts(touch)) {
    rubbed_ += warms;
    given_ += conducted;
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
  double heat = 0.0;
  if (conductance > 0.0) {
    const double both = constants(nodes, meeting.field, one) + constants(nodes, meeting.other_field, other);
    heat = conductance * meeting.area * difference * part_exchanged(both) * meeting.dt / dt;
  }
  const double sum = effusivities_[meeting.field] + effusivities_[meeting.other_field];
  const double part = sum > 0.0 ? effusivities_[meeting.field] / sum : 0.5;
  const double friction = (meeting.friction + (keeps ? std::exchange(kept_, 0.0) : 0.0)) / dt;
  if (counts(meeting.field, one)) rubbed_ += friction * dt;
  a.source.at(one.block, 0, one.node) += heat + part * friction;
  b.source.at(other.block, 0, other.node) += (1.0 - part) * friction - heat;
}

void SurfaceHeat::give(std::vector<NodalQuantity>& nodes, double start, double dt) {
  rubbed_ = given_ = 0.0;
  if (!loads_.empty()) load();
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
  const Share& one = shares_[touch.first];
  const NodeRef node = find(one);
  return node.block >= 0 && counts(one.field, node);
}

double SurfaceHeat::waiting() const {
  double sum = is_first(ranks_) ? kept_ : 0.0;
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
  archive.column("shares/field", shares_, &Share::field);
  archive.column("shares/node", shares_, &Share::node);
  archive.column("shares/share", shares_, &Share::share);
  archive.rows("touches", touches_);
  archive.column("touches/tool", touches_, &Touch::tool);
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
