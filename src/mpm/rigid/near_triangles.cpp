#include "near_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mpm {
namespace {

constexpr double kMargin = 0.25;  ///< part of the longest edge of the bounds: where material is near
constexpr std::size_t kCellsATriangle = 256, kMostCells = 65536;
constexpr int kMostLookedAt = 96;      ///< triangles that may be nearest by the cell's ball alone
constexpr double kSlack = 1.0 + 1e-9;  ///< for the round-off of what is computed from coordinates

}  // namespace

NearTriangles::NearTriangles(const TriangleTree& tree, const std::vector<Triangle>& triangles, const Box& bounds,
                             Inside inside)
    : tree_(tree), triangles_(triangles), inside_(std::move(inside)) {
  const Box around = bounds.grown(kMargin * bounds.size().maxCoeff());
  low_ = around.min;
  const double most = static_cast<double>(std::min(kCellsATriangle * triangles.size(), kMostCells));
  const double edge = std::cbrt(around.size().prod() / most);
  std::size_t cells = 1;
  for (int k = 0; k < 3; ++k) {
    count_[k] = std::max(1, static_cast<int>(around.size()[k] / edge));
    per_metre_[k] = count_[k] / around.size()[k];
    half_[k] = 0.5 / per_metre_[k];
    cells *= count_[k];
  }
  cells_ = std::vector<Cell>(cells);
}

const NearTriangles::Cell* NearTriangles::cell(const Vec3& point) const {
  std::size_t place = 0;
  Vec3 middle;
  for (int k = 2; k >= 0; --k) {
    const double at = (point[k] - low_[k]) * per_metre_[k];
    if (!(at >= 0.0 && at < count_[k])) return nullptr;
    const int i = static_cast<int>(at);
    place = place * count_[k] + i;
    middle[k] = low_[k] + (2 * i + 1) * half_[k];
  }
  Cell& cell = cells_[place];
  std::uint8_t state = cell.state.load(std::memory_order_acquire);
  if (state == Cell::empty && cell.state.compare_exchange_strong(state, Cell::being_filled)) {
    fill(cell, middle);
    return &cell;
  }
  return state == Cell::being_filled ? nullptr : &cell;
}

void NearTriangles::fill(Cell& cell, const Vec3& middle) const {
  const Nearest nearest = tree_.nearest(middle);
  const double round_off = tree_.round_off();
  const double distance = std::sqrt(nearest.squared), half = kSlack * half_.norm() + 2.0 * round_off;
  // A little less, for the rounding to single precision.
  cell.clear = static_cast<float>(inside_(middle, nearest) ? -1.0 : 0.999999 * (distance - half));
  std::array<const Triangle*, kMostLookedAt> found;
  const int count = tree_.within(middle, kSlack * distance + 2.0 * half, found.data(), kMostLookedAt);

  // Squares of distances of the cell's corners: from each triangle, and from its point nearest to the middle.
  constexpr int kCorners = 8;
  std::array<std::array<double, kCorners>, kMostLookedAt> from_triangle, from_point;
  for (int t = 0; t < count; ++t) {
    Nearest own;
    nearest_of(*found[t], middle, own);
    for (int c = 0; c < kCorners; ++c) {
      Vec3 corner = middle;
      for (int k = 0; k < 3; ++k) corner[k] += ((c >> k & 1) != 0 ? 1.0 : -1.0) * (kSlack * half_[k] + round_off);
      Nearest of_corner;
      nearest_of(*found[t], corner, of_corner);
      from_triangle[t][c] = of_corner.squared;
      from_point[t][c] = kSlack * std::pow((corner - own.point).norm() + round_off, 2);
    }
  }
  const auto never_nearest = [&](int t) {
    for (int other = 0; other < count; ++other) {
      bool farther = true;
      for (int c = 0; c < kCorners && farther; ++c) farther = from_triangle[t][c] > from_point[other][c];
      if (farther) return true;
    }
    return false;
  };
  cell.count = 0;
  for (int t = 0; t < count; ++t) {
    if (never_nearest(t)) continue;
    if (cell.count == Cell::kMost) {
      cell.count = 0;
      break;
    }
    cell.triangles[cell.count++] = found[t]->index;
  }
  cell.state.store(Cell::filled, std::memory_order_release);
}

bool NearTriangles::nearest(const Vec3& point, double band, Nearest& best) const {
  const Cell* own = cell(point);
  if (own != nullptr && own->clear > 0.0F && own->clear > band) return false;
  if (own == nullptr || own->count == 0) {
    best = tree_.nearest(point);
  } else {
    best = Nearest();
    for (int t = 0; t < own->count; ++t) nearest_of(triangles_[own->triangles[t]], point, best);
  }
  return true;
}

}  // namespace mpm
