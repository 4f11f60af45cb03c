#include "mpm/bed/bed_columns.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

BedColumns::BedColumns(const GridLayout& layout) : layout_(&layout) {
  for (int k = 0; k + 1 < layout.dim(); ++k) counts_[k] = layout.last_node(k) / kBlockEdge + 1;
}

int BedColumns::of_block(const std::array<int, 3>& block) const {
  const int x = std::clamp(block[0], 0, counts_[0] - 1), y = is_flat() ? 0 : std::clamp(block[1], 0, counts_[1] - 1);
  return x * counts_[1] + y;
}

int BedColumns::of_point(const Vec3& place) const {
  std::array<int, 3> block{};
  for (int k = 0; k + 1 < layout_->dim(); ++k) block[k] = std::max(0, nearest(k, place)) / kBlockEdge;
  return of_block(block);
}

int BedColumns::node_of(const Vec3& place) const {
  int node = 0;
  for (int k = 0; k + 1 < layout_->dim(); ++k) {
    const int at = std::clamp(nearest(k, place), 0, layout_->last_node(k));
    node = node * kBlockEdge + at % kBlockEdge;
  }
  return node;
}

bool BedColumns::holds(const Vec3& place) const {
  bool inside = true;
  for (int k = 0; k + 1 < layout_->dim(); ++k) {
    const double cells = layout_->in_cells(k, place[k]);
    inside = inside && cells >= 0.0 && cells <= layout_->last_node(k);
  }
  return inside;
}

Box BedColumns::bounds(int column) const {
  Box box = bounds_of_node(column, 0);
  for (int k = 0; k + 1 < layout_->dim(); ++k) box.max[k] += (kBlockEdge - 1) * layout_->cell(k);
  return box;
}

Box BedColumns::bounds_of_node(int column, int node) const {
  constexpr double kFar = 1e9;  // [m]
  Box box{Vec3::Constant(-kFar), Vec3::Constant(kFar)};
  const std::array<int, 2> block{column / counts_[1], column % counts_[1]};
  const std::array<int, 2> own{is_flat() ? node : node / kBlockEdge, is_flat() ? 0 : node % kBlockEdge};
  for (int k = 0; k + 1 < layout_->dim(); ++k) {
    const double at = kBlockEdge * block[k] + own[k];
    box.min[k] = layout_->origin(k) + (at - 0.5) * layout_->cell(k);
    box.max[k] = layout_->origin(k) + (at + 0.5) * layout_->cell(k);
  }
  return box;
}

std::array<int, 2> BedColumns::range(int k, double low, double high) const {
  if (is_flat() && k == 1) return {0, 0};
  const auto block = [&](double place) {
    const double at = std::floor((layout_->in_cells(k, place) + 0.5) / kBlockEdge);
    return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(counts_[k])));
  };
  return {std::max(0, block(low)), std::min(counts_[k] - 1, block(high))};
}

void BedColumns::mark_near(const Vec3& point, double within, Flags& flags) const {
  const std::array<int, 2> x = range(0, point.x() - within, point.x() + within);
  const std::array<int, 2> y = range(1, point.y() - within, point.y() + within);
  for (int i = x[0]; i <= x[1]; ++i) {
    for (int j = y[0]; j <= y[1]; ++j) {
      const int column = i * counts_[1] + j;
      const Box box = bounds(column);
      double squared = 0.0;
      for (int k = 0; k + 1 < layout_->dim(); ++k) {
        const double apart = std::max({0.0, box.min[k] - point[k], point[k] - box.max[k]});
        squared += apart * apart;
      }
      if (squared <= within * within) flags[column] = 1;
    }
  }
}

void BedColumns::mark_in(const Box& box, Flags& flags) const {
  const std::array<int, 2> x = range(0, box.min.x(), box.max.x()), y = range(1, box.min.y(), box.max.y());
  for (int i = x[0]; i <= x[1]; ++i) {
    for (int j = y[0]; j <= y[1]; ++j) flags[i * counts_[1] + j] = 1;
  }
}

BedColumns::Flags BedColumns::grown(const Flags& flags) const {
  Flags all = flags;
  for (int column = 0; column < count(); ++column) {
    if (flags[column] == 0) continue;
    each_beside(column, [&](int beside) { all[beside] = 1; });
  }
  return all;
}

BedColumns::Flags columns_with_ground(const BedColumns& columns, const std::vector<Vec3>& places, double within) {
  BedColumns::Flags near(columns.count(), 0);
  for (const Vec3& place : places) columns.mark_near(place, within, near);
  return columns.grown(near);
}

void add_column(const BedColumns& columns, int column, const GroundSource& source, GroundParticles& ground) {
  GroundParticles found;
  source.add(columns.bounds(column), found);
  for (std::size_t p = 0; p < found.positions.size(); ++p) {
    if (columns.of_point(found.positions[p]) != column) continue;
    ground.positions.push_back(found.positions[p]);
    if (found.parts.empty()) continue;
    ground.parts.push_back(found.parts[p]);
    ground.surfaces.push_back(found.surfaces[p]);
  }
}

}  // namespace mpm
