#include "host_field.hpp"

#include <algorithm>

#include "mpm/grid/each_share.hpp"
#include "mpm/kernel/soil_nodes.hpp"

namespace mpm {

template <class T>
HostField<T>::HostField(const FieldParts<T>& parts, const SoilBodies& bodies, int threads, double lightest, bool loads)
    : parts_(parts), cells_(bodies, parts.soil_grid, threads), threads_(threads), lightest_(lightest), loads_(loads) {}

template <class T>
void HostField<T>::begin(double dt, bool other_blocks) {
  timed("implicit: particles to cells", [&] {
    if (other_blocks) cells_.rebuild();
    load();
    cells_.gather(parts_.table, nodes_, dt);
  });
  timed("implicit: contact", [&] {
    parts_.soil_grid.shares().by_colour("implicit: contact", threads_,
                                        [&](int block) { parts_.table.push(block_at(block), nodes_.data()); });
  });
}

template <class T>
mpm_kernel::SoilBlock<T> HostField<T>::block_at(int block) {
  ToolRows<T>& tools = parts_.tools;
  WallRows<T>& walls = parts_.walls;
  return {cells_.groups(block),
          tools.count(block) > 0 ? tools.rows(block) : nullptr,
          walls.count(block) > 0 ? walls.rows(block) : nullptr,
          cells_.masks(),
          cells_.count(block),
          tools.count(block),
          walls.count(block)};
}

// Velocities with gravity and loads, none where walls hold, and those that conditions prescribe.
template <class T>
void HostField<T>::load() {
  const Grid& grid = parts_.grid;
  const SoilGrid& soil_grid = parts_.soil_grid;
  const GridLayout& layout = grid.layout;
  const int per_block = layout.nodes_per_block(), dim = layout.dim();
  nodes_.resize(soil_grid.numbers());
  before_.resize(soil_grid.nodes());
  std::fill(nodes_.begin() + soil_grid.nodes(), nodes_.end(), Node{});
  soil_grid.shares().at_once("implicit: velocities of nodes", threads_, [&](int block) {
    for (int n = 0; n < per_block; ++n) {
      Node& node = nodes_[block * per_block + n];
      node = {};
      if (!grid.carries(block, n)) continue;
      const double mass = grid.mass.at(block, 0, n);
      node.inverse_mass = static_cast<T>(1.0 / (mass + lightest_));
      for (int k = 0; k < dim; ++k) {
        const int axis = layout.axis(k);
        const std::uint8_t holder = soil_grid.holder(block * per_block + n, axis);
        if (holder != SoilGrid::kFree && holder != SoilGrid::kPrescribed) continue;
        double velocity = grid.velocity.at(block, k, n);
        if (holder == SoilGrid::kFree && loads_) {
          velocity = mpm_kernel::start_of_solve(mass, grid.momentum.at(block, k, n) / mass, velocity, lightest_, true);
        }
        node.v[axis] = static_cast<T>(velocity);
      }
    }
  });
}

template <class T>
void HostField<T>::meet() {
  parts_.soil_grid.shares().by_colour("implicit: sweeps over contacts", threads_,
                                      [&](int block) { parts_.table.meet(block_at(block), nodes_.data()); });
}

template <class T>
void HostField<T>::go_on(T factor) {
  const int per_block = parts_.grid.layout.nodes_per_block();
  parts_.soil_grid.shares().at_once("implicit: extrapolation", threads_, [&](int block) {
    const int first = block * per_block;
    parts_.table.extrapolate(block_at(block), &nodes_[first], &before_[first], per_block, factor);
  });
}

template <class T>
void HostField<T>::sweep(bool backwards, const std::vector<std::uint8_t>& marked,
                         std::vector<mpm_kernel::SweepChange>& changes) {
  parts_.soil_grid.shares().by_colour("implicit: sweeps over cells", threads_, [&](int block) {
    if (marked[block] != 0) changes[block] = parts_.table.sweep(block_at(block), nodes_.data(), backwards);
  });
}

template <class T>
void HostField<T>::finish(double dt, SoilDeeds& sum) {
  cells_.take(parts_.table, nodes_, dt);
  deeds_.assign(parts_.grid.blocks.size(), {});
  parts_.soil_grid.shares().at_once("implicit: velocities to the grid", threads_,
                                    [&](int block) { deeds_[block] = store(block, dt); });
  for (const SoilDeeds& deeds : deeds_) {
    sum.light += deeds.light;
    sum.taken += deeds.taken;
    for (int w = 0; w < 6; ++w) {
      for (int k = 0; k < 3; ++k) sum.held[w][k] += deeds.held[w][k];
    }
  }
}

template <class T>
SoilDeeds HostField<T>::store(int block, double dt) {
  Grid& grid = parts_.grid;
  const GridLayout& layout = grid.layout;
  const int per_block = layout.nodes_per_block();
  SoilDeeds deeds;
  for (int n = 0; n < per_block; ++n) {
    if (!grid.carries(block, n)) continue;
    const int number = block * per_block + n;
    const double mass = grid.mass.at(block, 0, n);
    for (int k = 0; k < layout.dim(); ++k) {
      const int axis = layout.axis(k);
      double &velocity = grid.velocity.at(block, k, n), &force = grid.force.at(block, k, n);
      const double start = grid.momentum.at(block, k, n) / mass;
      const std::uint8_t holder = parts_.soil_grid.holder(number, axis);
      if (holder == SoilGrid::kAtRest || holder == SoilGrid::kPrescribed) {  // holder stops it from there
        const double change = velocity - start;
        if (holder == SoilGrid::kPrescribed) deeds.taken += 0.5 * mass * change * change;
        velocity += force / mass;
        force = (velocity - start) / dt;
        continue;
      }
      const bool held = holder != SoilGrid::kFree;
      const double found = held ? 0.0 : static_cast<double>(nodes_[number].v[axis]);
      const mpm_kernel::SolvedComponent solved =
          mpm_kernel::end_of_solve(mass, start, velocity, found, held, lightest_, loads_, dt);
      if (held) {
        deeds.held[holder][axis] += solved.held;
      } else {
        deeds.light[axis] += solved.light;
      }
      deeds.taken += solved.taken;
      velocity = solved.velocity;
      force = solved.acceleration;
    }
  }
  return deeds;
}

template class HostField<double>;
template class HostField<float>;

}  // namespace mpm
