#include "mpm/mechanics/sharpened_pic.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mpm {
namespace {

constexpr int kMostNodes = nodes_of_block(3);

/// Nodes of a block from one to the next along an axis; the last axis is the fastest.
int stride_of(int axis, int dim) { return axis == dim - 1 ? 1 : kBlockEdge * stride_of(axis + 1, dim); }

/// A node's mass along an axis across which its mirror image has as much again, and none beyond the mirror.
class MirroredMass {
 public:
  MirroredMass(const Grid& grid, int block) : grid_(grid), mass_(grid.mass.block(block)) {
    for (int k = 0; k < grid.layout.dim(); ++k) first_[k] = grid.blocks.block(block)[k] * kBlockEdge;
  }
  /// `at`: the node's numbers in its block.
  double operator()(int node, const std::array<int, 3>& at, int along) const {
    if (!(mass_[node] > grid_.least_mass)) return 0.0;
    double copies = 1.0;
    for (int k = 0; k < grid_.layout.dim(); ++k) {
      for (int upper = 0; upper < 2; ++upper) {
        if (!grid_.mirrors[2 * k + upper]) continue;
        const int number = first_[k] + at[k];
        const int beyond = upper == 0 ? -number : number - grid_.layout.last_node(k);
        if (beyond > 0) return 0.0;
        if (beyond == 0 && k == along) copies = 2.0;
      }
    }
    return copies * mass_[node];
  }

 private:
  const Grid& grid_;
  const double* mass_;
  std::array<int, 3> first_{};
};

}  // namespace

double smoothing_of(ShapeKind shape, int particles_per_direction) {
  if (shape == ShapeKind::bspline2) return 1.0 / 4.0;
  if (shape == ShapeKind::bspline3) return 1.0 / 3.0;
  const double n = particles_per_direction;
  return 1.0 / 6.0 + 1.0 / (12.0 * n * n);
}

SharpenedPic::SharpenedPic(double part, Fields& fields, int threads, Halo* halo)
    : part_(part), fields_(fields), threads_(threads), halo_(halo) {
  for (const auto& grid : fields) work_.emplace_back(grid->layout);
}

void SharpenedPic::follow_sort(int field) {
  const Grid& grid = *fields_[field];
  const BlockTable& blocks = grid.blocks;
  OfField& work = work_[field];
  const std::size_t sides = 2 * static_cast<std::size_t>(grid.layout.dim());
  if (work.generation == blocks.generation() && work.beside.size() == sides * blocks.size()) return;
  work.generation = blocks.generation();
  work.change.resize(blocks.size());
  work.beside.assign(sides * blocks.size(), -1);
  for (int b = 0; b < blocks.size(); ++b) {
    for (std::size_t side = 0; side < sides; ++side) {
      const int k = static_cast<int>(side) / 2;
      std::array<int, 3> block = blocks.block(b);
      block[k] += side % 2 == 0 ? -1 : 1;
      const int found = blocks.find(grid.layout.key(block));
      // The key of a block beyond the grid is that of another one.
      if (found >= 0 && (grid.layout.periodic(k) || blocks.block(found) == block))
        work.beside[sides * b + side] = found;
    }
  }
  if (halo_ != nullptr) work.own = halo_->reached_first(field, blocks);
}

void SharpenedPic::find() {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    Grid& grid = *fields_[f];
    OfField& work = work_[f];
    follow_sort(static_cast<int>(f));
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int b = 0; b < grid.blocks.size(); ++b) find_change(grid, work, b);
    if (halo_ != nullptr) halo_->add(static_cast<int>(f), work.change);
    std::swap(grid.increment, work.change);
  }
}

void SharpenedPic::find_change(const Grid& grid, OfField& work, int block) const {
  const int dim = grid.layout.dim(), nodes = grid.layout.nodes_per_block();
  const double* mass = grid.mass.block(block);
  const double* velocity = grid.increment.block(block);
  double* change = work.change.block(block);
  std::fill_n(change, dim * nodes, 0.0);
  for (int k = 0; k < dim; ++k) {
    const int stride = stride_of(k, dim);
    for (int upper = 0; upper < 2; ++upper) {
      const int side = work.beside[(static_cast<std::size_t>(block) * dim + k) * 2 + upper];
      const int step = upper == 0 ? -stride : stride, leap = -step * (kBlockEdge - 1);
      const int last = upper == 0 ? 0 : kBlockEdge - 1;
      const MirroredMass here(grid, block), there(grid, side < 0 ? block : side);
      const double* velocity_there = side < 0 ? velocity : grid.increment.block(side);
      for (int n = 0; n < nodes; ++n) {
        std::array<int, 3> at{};
        for (int a = 0; a < dim; ++a) at[a] = n / stride_of(a, dim) % kBlockEdge;
        const bool leaves = at[k] == last;
        if (leaves && side < 0) continue;
        const int other = n + (leaves ? leap : step);
        const double own_mass = here(n, at, k);
        at[k] = leaves ? kBlockEdge - 1 - last : at[k] + (upper == 0 ? -1 : 1);
        const double other_mass = leaves ? there(other, at, k) : here(other, at, k);
        const double least = std::min(own_mass, other_mass);
        if (!(least > 0.0)) continue;
        const double* beside = leaves ? velocity_there : velocity;
        const double weight = -part_ * least / mass[n];
        for (int c = 0; c < dim; ++c) {
          change[c * nodes + n] += weight * (beside[c * nodes + other] - velocity[c * nodes + n]);
        }
      }
    }
  }
  if (work.own.empty()) return;
  for (int n = 0; n < nodes; ++n) {
    if ((work.own[block] >> n & 1U) != 0) continue;
    for (int c = 0; c < dim; ++c) change[c * nodes + n] = 0.0;
  }
}

double SharpenedPic::add(double dt) {
  double work = 0.0;
  for (auto& field : fields_) {
    Grid& grid = *field;
    const int dim = grid.layout.dim(), nodes = grid.layout.nodes_per_block();
    work += sums_.over(grid.blocks.size(), threads_, [&](std::size_t number, double& sum) {
      const int b = static_cast<int>(number);
      const double* mass = grid.mass.block(b);
      const double* change = grid.increment.block(b);
      double* velocity = grid.velocity.block(b);
      double* acceleration = grid.force.block(b);
      double of_block = 0.0;
      for (int i = 0; i < dim * nodes; ++i) {
        velocity[i] += change[i];
        acceleration[i] += change[i] / dt;
        const double mean = velocity[i] - 0.5 * dt * acceleration[i];  // of before and after the step
        of_block += mass[i % nodes] * change[i] * mean;
      }
      if (grid.counts(b)) sum += of_block;
    });
  }
  return work;
}

}  // namespace mpm
