#include "mpm/implicit/soil_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/grid/each_share.hpp"
#include "mpm/kernel/soil_cell.hpp"

namespace mpm {
namespace {

/// The cells of a block, those whose numbers along each axis are odd or even alike after each other.
struct CellOrder {
  explicit CellOrder(int dim) {
    const int cells = nodes_of_block(dim);
    for (int colour = 0; colour < 1 << dim; ++colour) {
      begin[colour] = static_cast<int>(numbers.size());
      for (int n = 0; n < cells; ++n) {
        int bits = 0;
        for (int k = 0, rest = n; k < dim; ++k, rest /= kBlockEdge) bits |= (rest & 1) << k;
        if (bits == colour) numbers.push_back(n);
      }
      begin[colour + 1] = static_cast<int>(numbers.size());
    }
  }
  std::vector<int> numbers;
  std::array<int, 9> begin{};
};

const CellOrder& cell_order(int dim) {
  static const CellOrder kPlane(2), kSpace(3);
  return dim == 3 ? kSpace : kPlane;
}

/// Number of groups of the cells of a soil in a block.
template <class T>
int count_groups(const mpm_kernel::SoilSums<T>* sums, int dim) {
  const CellOrder& order = cell_order(dim);
  int groups = 0;
  for (int c = 0; c < 1 << dim; ++c) {
    int cells = 0;
    for (int i = order.begin[c]; i < order.begin[c + 1]; ++i) cells += sums[order.numbers[i]].volume > T(0);
    groups += (cells + mpm_kernel::kGroupCells - 1) / mpm_kernel::kGroupCells;
  }
  return groups;
}

/// A lane without a cell: that of the first one, which moves nothing.
template <class T>
void copy_without_soil(mpm_kernel::SoilGroup<T>& group, mpm_kernel::SoilPlaces<T>& places, int lane, int no_node) {
  for (auto& mean : places.mean) mean[lane] = mean[0];
  for (auto& mean : places.over_radius) mean[lane] = mean[0];
  for (auto& node : group.node) node[lane] = no_node;
  for (int i = 0; i < 6; ++i) group.stress[i][lane] = group.shift[i][lane] = T(0);
  for (auto* numbers : {&group.compliance_n, &group.compliance_t, &group.sine, &group.cohesion, &group.dilation,
                        &group.dilates, &group.least, &group.lode, &group.closing}) {
    (*numbers)[lane] = (*numbers)[0];
  }
  group.push[lane] = T(0);
  group.place[lane] = -1;
}

}  // namespace

template <class T>
SoilCells<T>::SoilCells(const SoilBodies& bodies, const SoilGrid& grid, int threads)
    : bodies_(bodies), grid_(grid), threads_(threads) {
  for (const ImplicitSoil& soil : bodies_.soils) constants_.push_back(soil.constants());
}

// A particle's box lies in the blocks around its owner.
template <class T>
void SoilCells<T>::rebuild() {
  const Grid& grid = grid_.grid();
  blocks_ = grid.blocks.size();
  slots_.assign(bodies_.soils.size() * blocks_, -1);
  const int per_block = grid.layout.nodes_per_block();
  std::size_t used = 0;
  for (const SoilBodies::Body& body : bodies_.list) {
    const std::uint32_t* begin = &body.set->begin[grid.first_owner];
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      if (begin[owner] == begin[owner + 1]) continue;
      for (int n = 0; n < grid.blocks.neighbour_count(); ++n) {
        int& place = slot(body.soil, grid.blocks.neighbours(owner)[n]);
        if (place >= 0) continue;
        place = static_cast<int>(used);
        used += per_block;
      }
    }
  }
  if (used > sums_.size()) sums_.resize(used + used / 16);
  if (sums_.size() > motion_.size()) motion_.resize(sums_.size());
  // As many groups as there may be: one of each colour in a block. What is not used is not touched.
  const std::size_t most = (used / per_block) << grid.layout.dim();
  if (most > groups_.capacity()) {
    groups_.reserve(most + most / 16);
    masks_.reserve(most + most / 16);
  }
  begin_.resize(blocks_ + 1);
}

template <class T>
mpm_kernel::SoilParticles<T> SoilCells<T>::view_of(int body) const {
  ParticleSet& set = *bodies_.list[body].set;
  const ImplicitSoil& soil = bodies_.soils[bodies_.list[body].soil];
  const GridLayout& layout = grid_.grid().layout;
  mpm_kernel::SoilParticles<T> view{};
  for (int k = 0; k < layout.dim(); ++k) {
    view.x[k] = set.x[k].data();
    view.half[k] = set.half[k];
    view.origin[k] = layout.origin(k);
    view.inverse_cell[k] = layout.inverse_cell(k);
  }
  for (std::size_t i = 0; i < set.f.size(); ++i) view.f[i] = set.f[i].template data<T>();
  for (std::size_t i = 0; i < set.tau.size(); ++i) view.tau[i] = set.tau[i].template data<T>();
  view.strain = set.history[soil.strain_at].template data<T>();
  view.opening = soil.opening_at ? set.history[*soil.opening_at].template data<T>() : nullptr;
  view.work = set.history[soil.work_at].template data<T>();
  view.masses = set.masses.empty() ? nullptr : set.masses[0].template data<T>();
  view.mass = set.mass;
  describe(soil, view);
  return view;
}

template <class T>
template <class Pass>
void SoilCells<T>::each_owner(int body, int owner, Pass&& pass) {
  const Grid& grid = grid_.grid();
  const std::uint32_t* begin = &bodies_.list[body].set->begin[grid.first_owner + owner];
  if (begin[0] == begin[1]) return;
  mpm_kernel::SoilPlacesOf<T> places{};
  for (int n = 0; n < grid.blocks.neighbour_count(); ++n) {
    const int at = slot(bodies_.list[body].soil, grid.blocks.neighbours(owner)[n]);
    places.sums[n] = at < 0 ? nullptr : sums_.data() + at;
    places.motion[n] = at < 0 ? nullptr : motion_.data() + at;
  }
  int corner[3] = {};
  for (int k = 0; k < grid.layout.dim(); ++k) {
    corner[k] = kBlockEdge * grid.blocks.block(grid.blocks.owner_block(owner))[k];
  }
  pass(static_cast<int>(begin[0]), static_cast<int>(begin[1]), corner, places);
}

template <class T>
void SoilCells<T>::gather(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt) {
  const Grid& grid = grid_.grid();
  const int bodies = static_cast<int>(bodies_.list.size()), per_block = grid.layout.nodes_per_block();
  const auto each_slot = [&](int block, auto&& visit) {
    for (int soil = 0; soil < static_cast<int>(bodies_.soils.size()); ++soil) {
      if (const int at = slot(soil, block); at >= 0) visit(at);
    }
  };
  grid_.shares().at_once("implicit: particles to cells", threads_, [&](int block) {
    each_slot(block, [&](int at) { std::fill_n(sums_.begin() + at, per_block, Sums{}); });
  });
  views_.clear();
  for (int body = 0; body < bodies; ++body) views_.push_back(view_of(body));
  const mpm_kernel::SoilPasses<T>& passes = table.passes;
  grid.shares.by_colour("implicit: particles to cells", threads_, [&](int owner) {
    for (int body = 0; body < bodies; ++body) {
      each_owner(body, owner, [&](int first, int last, const int* corner, const mpm_kernel::SoilPlacesOf<T>& places) {
        passes.gather(views_[body], first, last, corner, places);
      });
    }
  });
  grid_.shares().at_once("implicit: groups of cells", threads_, [&](int block) {
    int groups = 0;
    each_slot(block, [&](int at) { groups += count_groups(sums_.data() + at, grid.layout.dim()); });
    begin_[block + 1] = groups;
  });
  begin_[0] = 0;
  for (int block = 0; block < blocks_; ++block) begin_[block + 1] += begin_[block];
  const std::size_t size = begin_[blocks_];
  groups_.resize(size);
  masks_.resize(size);
  grid_.shares().at_once("implicit: groups of cells", threads_,
                         [&](int block) { make_groups(table, nodes, dt, block); });
}

template <class T>
void SoilCells<T>::make_groups(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt,
                               int block) {
  int next = begin_[block];
  if (next == begin_[block + 1]) return;
  const GridLayout& layout = grid_.grid().layout;
  const int dim = layout.dim();
  const CellOrder& order = cell_order(dim);
  mpm_kernel::SoilPlaces<T> places{};
  for (int k = 0; k < dim; ++k) places.inverse_cell[layout.axis(k)] = static_cast<T>(layout.inverse_cell(k));
  const auto finish = [&](int lanes) {
    Group& group = groups_[next];
    for (int lane = lanes; lane < mpm_kernel::kGroupCells; ++lane) {
      copy_without_soil(group, places, lane, grid_.no_node(block));
    }
    table.prepare(group, places, nodes.data(), group.mask >= 0 ? &masks_[next] : nullptr);
    table.project(group);
    ++next;
  };
  for (int soil = 0; soil < static_cast<int>(bodies_.soils.size()); ++soil) {
    const int at = slot(soil, block);
    if (at < 0) continue;
    for (int c = 0; c < 1 << dim; ++c) {
      int lanes = 0;
      for (int i = order.begin[c]; i < order.begin[c + 1]; ++i) {
        const int n = order.numbers[i];
        if (!(sums_[at + n].volume > 0.0)) continue;
        if (lanes == 0) mpm_kernel::begin_group(groups_[next], constants_[soil]);
        std::array<int, 3> local{};
        for (int k = dim - 1, rest = n; k >= 0; --k, rest /= kBlockEdge) local[k] = rest % kBlockEdge;
        make_cell(sums_[at + n], soil, block, local, dt, next, lanes, places);
        groups_[next].place[lanes] = at + n;
        if (++lanes == mpm_kernel::kGroupCells) {
          finish(lanes);
          lanes = 0;
        }
      }
      if (lanes > 0) finish(lanes);
    }
  }
}

template <class T>
void SoilCells<T>::make_cell(const Sums& sums, int number_of_soil, int block, const std::array<int, 3>& local,
                             double dt, int number, int lane, mpm_kernel::SoilPlaces<T>& places) {
  Group& group = groups_[number];
  const int corners = 1 << grid_.grid().layout.dim();
  for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
    const int node = e < corners ? grid_.corner(block, local, e) : grid_.no_node(block);
    group.node[e][lane] = node;
    if (!grid_.held(node)) continue;
    mpm_kernel::SoilMask<T>& mask = masks_[number];
    if (group.mask < 0) std::fill_n(&mask.free[0][0][0], sizeof(mask) / sizeof(T), T(1));
    group.mask = number;
    for (int k = 0; k < 3; ++k) {
      if (grid_.holder(node, k) != SoilGrid::kFree) mask.free[k][e][lane] = T(0);
    }
  }
  mpm_kernel::make_cell(sums, constants_[number_of_soil], dt, grid_.rings(), lane, group, places);
}

template <class T>
void SoilCells<T>::add_to_held(HeldImpulses& held) const {
  for (const Group& group : groups_) {
    if (group.mask < 0) continue;
    for (int lane = 0; lane < mpm_kernel::kGroupCells; ++lane) {
      if (group.place[lane] < 0) continue;
      const mpm_kernel::Tension tension = mpm_kernel::tension_in(group, lane);
      for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
        const int node = group.node[e][lane];
        if (!grid_.held(node)) continue;
        double force[3];
        mpm_kernel::pull_on(group, lane, tension, e, force);
        if (grid_.rings()) force[0] += std::exchange(force[1], 0.0);
        for (int k = 0; k < 3; ++k) {
          const std::uint8_t holder = grid_.holder(node, k);
          if (holder != SoilGrid::kFree) held.add(node, k, holder, -static_cast<double>(group.push[lane]) * force[k]);
        }
      }
    }
  }
}

template <class T>
double SoilCells<T>::of_hoops() const {
  double sum = 0.0;
  for (const Group& group : groups_) {
    for (int lane = 0; lane < mpm_kernel::kGroupCells; ++lane) {
      if (group.place[lane] < 0) continue;
      double r[6], functions = 0.0;
      for (int i = 0; i < 6; ++i) r[i] = static_cast<double>(group.stress[i][lane]);
      for (const auto& hoop : group.gradient[1]) functions += static_cast<double>(hoop[lane]);
      sum -= static_cast<double>(group.push[lane]) * functions * mpm_kernel::tension_of(r).yy;
    }
  }
  return sum;
}

template <class T>
void SoilCells<T>::find_motion(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, int number) {
  const Group& group = groups_[number];
  mpm_kernel::SoilFlow<T> flow;
  table.flow(group, nodes.data(), flow);
  for (int lane = 0; lane < mpm_kernel::kGroupCells; ++lane) {
    if (group.place[lane] < 0) continue;
    mpm_kernel::find_motion(group, flow, lane, motion_[group.place[lane]]);
  }
}

template <class T>
void SoilCells<T>::take(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt) {
  const Grid& grid = grid_.grid();
  grid_.shares().at_once("implicit: cells to particles", threads_, [&](int block) {
    for (int group = begin_[block]; group < begin_[block + 1]; ++group) find_motion(table, nodes, group);
  });
  const mpm_kernel::SoilPasses<T>& passes = table.passes;
  grid.shares.at_once("implicit: cells to particles", threads_, [&](int owner) {
    for (int body = 0; body < static_cast<int>(bodies_.list.size()); ++body) {
      each_owner(body, owner, [&](int first, int last, const int* corner, const mpm_kernel::SoilPlacesOf<T>& places) {
        passes.take(views_[body], first, last, corner, places, dt);
      });
    }
  });
}

template class SoilCells<double>;
template class SoilCells<float>;

}  // namespace mpm
