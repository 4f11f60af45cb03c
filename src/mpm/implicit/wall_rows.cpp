#include "mpm/implicit/wall_rows.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr std::array<const char*, 6> kNames = {"wall/x_min", "wall/x_max", "wall/y_min",
                                               "wall/y_max", "wall/z_min", "wall/z_max"};

}  // namespace

template <class T>
WallRows<T>::WallRows(const std::array<WallDefinition, 6>& walls, const SoilGrid& grid) : walls_(walls), grid_(grid) {
  for (int w = 0; w < 6; ++w) accounts_[w].name = kNames[w];
}

template <class T>
std::uint64_t WallRows<T>::id_of(const SoilGrid::WallNode& node) const {
  const int per_block = grid_.grid().layout.nodes_per_block();
  const std::uint64_t local = static_cast<std::uint64_t>(node.node - node.block * per_block);
  return (grid_.grid().blocks.key(node.block) * static_cast<std::uint64_t>(per_block) + local) * 6 +
         static_cast<std::uint64_t>(node.wall);
}

template <class T>
void WallRows<T>::find(std::vector<Node>& nodes, double dt) {
  const int blocks = grid_.grid().blocks.size();
  begin_.assign(blocks + 1, 0);
  rows_.clear();
  wall_of_.clear();
  ids_.clear();
  const std::size_t most = grid_.frictional().size();
  rows_.reserve(most);
  wall_of_.reserve(most);
  ids_.reserve(most);
  kept_.reserve(most);
  for (const SoilGrid::WallNode& at : grid_.frictional()) {
    Node& node = nodes[at.node];
    if (!(node.inverse_mass > T(0))) continue;
    const int axis = at.wall / 2;
    if (grid_.holder(at.node, axis) != SoilGrid::kFree) continue;
    Row row{};
    row.node = at.node;
    row.axis = axis;
    row.out = at.wall % 2 == 0 ? T(1) : T(-1);
    for (int a = 0; a < 3; ++a) row.free[a] = grid_.holder(at.node, a) == SoilGrid::kFree ? T(1) : T(0);
    row.friction = walls_[at.wall].friction.stick ? T(-1) : static_cast<T>(walls_[at.wall].friction.coefficient);
    const std::uint64_t id = id_of(at);
    const auto known =
        std::lower_bound(kept_.begin(), kept_.end(), id, [](const Kept& k, std::uint64_t i) { return k.id < i; });
    if (known != kept_.end() && known->id == id) {
      const double ratio = std::min(1.0, known->own / static_cast<double>(node.inverse_mass));
      for (int a = 0; a < 3; ++a) {
        row.impulse[a] = row.free[a] * static_cast<T>(ratio * ratio * dt * known->force[a]);
        node.v[a] += node.inverse_mass * row.impulse[a];
      }
    }
    rows_.push_back(row);
    wall_of_.push_back(at.wall);
    ids_.push_back(id);
    ++begin_[at.block + 1];
  }
  for (int b = 0; b < blocks; ++b) begin_[b + 1] += begin_[b];
}

template <class T>
void WallRows<T>::finish(const std::vector<Node>& nodes, const Impulses& of_held, double dt) {
  std::array<Vec3, 6> given;
  for (int w = 0; w < 6; ++w) given[w] = Vec3(of_held[w][0], of_held[w][1], of_held[w][2]);
  kept_.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const Node& node = nodes[row.node];
    Kept& kept = kept_[i] = {ids_[i], static_cast<double>(node.inverse_mass), Vec3::Zero()};
    for (int a = 0; a < 3; ++a) {
      const double impulse = static_cast<double>(row.impulse[a]);
      kept.force[a] = impulse / dt;
      given[wall_of_[i]][a] += impulse;
      (a == row.axis ? loss_ : friction_) -= impulse * static_cast<double>(node.v[a]);
    }
  }
  std::sort(kept_.begin(), kept_.end(), [](const Kept& a, const Kept& b) { return a.id < b.id; });
  for (int w = 0; w < 6; ++w) accounts_[w].add(given[w]);
}

template <class T>
void WallRows<T>::accounts(std::vector<ImpulseAccount>& list) const {
  for (int w = 0; w < 6; ++w) {
    if (is_wall(walls_[w].kind)) list.push_back(accounts_[w]);
  }
}

template <class T>
void WallRows<T>::energies(EnergyReport& report) const {
  const auto frictional = [](const WallDefinition& wall) { return wall.kind == WallKind::frictional; };
  if (std::any_of(walls_.begin(), walls_.end(), frictional)) {
    report.add("wall_friction", NamedEnergy::Kind::dissipated, friction_);
  }
  report.add("wall_loss", NamedEnergy::Kind::dissipated, loss_);
}

template <class T>
void WallRows<T>::serialise(StateArchive& archive) {
  for (ImpulseAccount& account : accounts_) {
    const StateArchive::Group group(archive, account.name.substr(5));
    account.serialise(archive);
  }
  archive.sum("friction_energy", friction_);
  archive.sum("held_energy", loss_);
  archive.rows("nodes", kept_);
  archive.column("nodes/id", kept_, &Kept::id);
  archive.column("nodes/own", kept_, &Kept::own);
  archive.column("nodes/force", kept_, &Kept::force);
}

template class WallRows<double>;
template class WallRows<float>;

}  // namespace mpm
