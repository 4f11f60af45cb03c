#include "mpm/terrain/ground_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mpm {
namespace {

constexpr double kHalfFull = 0.5;  ///< fill from which cells hang together
constexpr double kFull = 0.75;     ///< fill from which two cells, one on the other, are ground without a gap
constexpr double kSome = 0.05;     ///< fill from which a cell beside or under the ground belongs to it
constexpr double kAtEnd = 1e-6;    ///< part of a column by which it may miss the end of the domain

double smaller_of_one_sign(double a, double b) {
  if (a * b <= 0.0) return 0.0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// Sizes of columns around `count` points from `low` on, cut off at the ends of the domain.
void size_columns(double low, double resolution, int count, double from, double to, std::vector<double>& sizes) {
  sizes.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double middle = low + i * resolution;
    sizes[static_cast<std::size_t>(i)] =
        std::min(middle + 0.5 * resolution, to) - std::max(middle - 0.5 * resolution, from);
  }
}

/// Parts of an edge from `low` to `high` that lie in pieces of length `size`, of which piece 0 begins at `origin`.
/// Returns the first piece.
int share_edge(double low, double high, double origin, double size, std::vector<double>& parts) {
  const auto piece = [&](double place) { return static_cast<int>(std::floor((place - origin) / size)); };
  const int first = piece(low), last = std::max(first, piece(high));
  parts.resize(static_cast<std::size_t>(last - first + 1));
  for (int i = first; i <= last; ++i) {
    const double from = std::max(low, origin + i * size), to = std::min(high, origin + (i + 1) * size);
    parts[static_cast<std::size_t>(i - first)] = std::max(to - from, 0.0) / (high - low);
  }
  return first;
}

}  // namespace

GroundSurface::GroundSurface(const Box& room, double layer, bool planar)
    : room_(room), layer_(layer), planar_(planar) {}

const HeightGrid& GroundSurface::find(const GroundRaster& raster, const std::vector<GroundGrain>& grains) {
  fit(raster, grains);
  for (const GroundGrain& grain : grains) add(grain);
  mark();
  for (int row = 0; row < raster_.rows; ++row) {
    for (int column = 0; column < raster_.columns; ++column) {
      heights_.heights[static_cast<std::size_t>(row) * raster_.columns + column] = height(column, row);
    }
  }
  extend_to_ends();
  return heights_;
}

void GroundSurface::fit(const GroundRaster& raster, const std::vector<GroundGrain>& grains) {
  raster_ = raster;
  heights_.low = raster.low;
  heights_.high = raster.low + raster.resolution * Vec2(raster.columns - 1, raster.rows - 1);
  heights_.columns = raster.columns;
  heights_.rows = raster.rows;
  heights_.heights.resize(static_cast<std::size_t>(raster.columns) * raster.rows);
  size_columns(raster.low.x(), raster.resolution, raster.columns, room_.min.x(), room_.max.x(), wide_);
  if (planar_) {
    deep_.assign(1, room_.max.y() - room_.min.y());
  } else {
    size_columns(raster.low.y(), raster.resolution, raster.rows, room_.min.y(), room_.max.y(), deep_);
  }
  double highest = room_.min.z();
  lowest_ = std::numeric_limits<double>::infinity();
  for (const GroundGrain& grain : grains) {
    lowest_ = std::min(lowest_, grain.centre.z() - grain.half.z());
    highest = std::max(highest, grain.centre.z() + grain.half.z());
  }
  if (grains.empty()) lowest_ = room_.min.z();
  // Layers are those of the grid, a layer more than the grains reach.
  floor_ = room_.min.z() + layer_ * std::floor((lowest_ - room_.min.z()) / layer_ + kAtEnd);
  layers_ = std::max(1, static_cast<int>(std::ceil((highest - floor_) / layer_ - kAtEnd)) + 1);
  const std::size_t cells = heights_.heights.size() * static_cast<std::size_t>(layers_);
  fill_.assign(cells, 0.0);
  moment_.assign(cells, 0.0F);
  label_.assign(cells, kNone);
}

void GroundSurface::add(const GroundGrain& grain) {
  Vec3 low = grain.centre - grain.half, high = grain.centre + grain.half;
  // Keeps the whole volume within the domain.
  for (const int axis : {0, 1}) {
    low[axis] = std::min(std::max(low[axis], room_.min[axis]), grain.centre[axis]);
    high[axis] = std::max(std::min(high[axis], room_.max[axis]), grain.centre[axis]);
  }
  const auto edge = [&](int axis, double origin, double size) {
    return share_edge(low[axis], high[axis], origin, size, shares_[axis]);
  };
  const double half = 0.5 * raster_.resolution;
  const int left = edge(0, raster_.low.x() - half, raster_.resolution);
  const int under = edge(2, floor_, layer_);
  int front = 0;
  if (planar_) {
    shares_[1].assign(1, 1.0);
  } else {
    front = edge(1, raster_.low.y() - half, raster_.resolution);
  }
  for (std::size_t j = 0; j < shares_[1].size(); ++j) {
    const int row = front + static_cast<int>(j);
    if (row < 0 || row >= raster_.rows) continue;
    for (std::size_t i = 0; i < shares_[0].size(); ++i) {
      const int column = left + static_cast<int>(i);
      if (column < 0 || column >= raster_.columns) continue;
      const double here = grain.volume * shares_[0][i] * shares_[1][j] /
                          (wide_[static_cast<std::size_t>(column)] * deep_[static_cast<std::size_t>(row)] * layer_);
      for (std::size_t k = 0; k < shares_[2].size(); ++k) {
        const int layer = under + static_cast<int>(k);
        if (layer < 0 || layer >= layers_) continue;
        const double base = floor_ + layer * layer_;
        const double middle =
            0.5 * (std::max(low.z(), base) + std::min(high.z(), base + layer_)) - (base + 0.5 * layer_);
        const std::size_t at = cell(column, row, layer);
        fill_[at] += here * shares_[2][k];
        moment_[at] += static_cast<float>(here * shares_[2][k] * middle / layer_);
      }
    }
  }
}

void GroundSurface::mark() {
  std::uint32_t labels = kGround;  // the last one that was given away
  std::vector<int> lowest_of;
  std::uint32_t most = kNone;
  for (const double least : {kHalfFull, kSome}) {
    double largest = 0.0;
    for (std::size_t at = 0; at < fill_.size(); ++at) {
      if (label_[at] != kNone || fill_[at] < least) continue;
      int lowest = layers_;
      const double volume = spread(at, ++labels, lowest);
      lowest_of.push_back(lowest);
      if (volume > largest) largest = volume, most = labels;
    }
    if (most != kNone) break;  // else all of it is a film
  }
  bottom_ = most == kNone ? 0 : lowest_of[most - kGround - 1];
  for (std::size_t at = 0; at < fill_.size(); ++at) {
    std::uint32_t& label = label_[at];
    const bool on_floor = label == kNone ? fill_[at] >= kSome && static_cast<int>(at % layers_) <= bottom_
                                         : lowest_of[label - kGround - 1] <= bottom_;
    label = on_floor ? kGround : kNone;
  }
}

double GroundSurface::spread(std::size_t from, std::uint32_t label, int& lowest) {
  const double least = fill_[from] < kHalfFull ? kSome : kHalfFull;
  const auto layers = static_cast<std::size_t>(layers_), columns = static_cast<std::size_t>(raster_.columns);
  double volume = 0.0;
  const auto take = [&](std::size_t at) {
    if (label_[at] != kNone || fill_[at] < least) return;
    label_[at] = label;
    stack_.push_back(at);
  };
  take(from);
  while (!stack_.empty()) {
    const std::size_t at = stack_.back();
    stack_.pop_back();
    volume += fill_[at];
    const std::size_t layer = at % layers, column = at / layers % columns, row = at / layers / columns;
    lowest = std::min(lowest, static_cast<int>(layer));
    if (layer > 0) take(at - 1);
    if (layer + 1 < layers) take(at + 1);
    if (column > 0) take(at - layers);
    if (column + 1 < columns) take(at + layers);
    if (row > 0) take(at - layers * columns);
    if (row + 1 < static_cast<std::size_t>(raster_.rows)) take(at + layers * columns);
  }
  return volume;
}

bool GroundSurface::beside_ground(int column, int row, int layer) const {
  return (column > 0 && ground(cell(column - 1, row, layer))) ||
         (column + 1 < raster_.columns && ground(cell(column + 1, row, layer))) ||
         (row > 0 && ground(cell(column, row - 1, layer))) ||
         (row + 1 < raster_.rows && ground(cell(column, row + 1, layer)));
}

double GroundSurface::height(int column, int row) const {
  const std::size_t base = cell(column, row, 0);
  int top = layers_ - 1;
  while (top >= 0 && !ground(base + top)) --top;
  if (top < 0) return std::numeric_limits<double>::quiet_NaN();
  // Adds what is less than half full: of the surface itself, and of an upright face that the column is cut by.
  int upper = top;
  if (top + 1 < layers_) upper = top + 1;
  while (upper > top && upper + 1 < layers_ && fill_[base + upper] >= kSome && fill_[base + upper + 1] >= kSome &&
         beside_ground(column, row, upper + 1)) {
    ++upper;
  }
  double total = 0.0, moment = 0.0;  // [layers]
  std::optional<double> over_full;
  for (int layer = upper; layer >= 0; --layer) {
    const double fill = fill_[base + layer];
    if (layer <= top && fill < (over_full ? kHalfFull : kSome)) break;
    total += fill;
    moment += fill * layer + static_cast<double>(moment_[base + layer]);
    if (layer <= bottom_) return std::max(lowest_, floor_ + layer * layer_) + total * layer_;
    if (layer <= top && fill >= kFull && fill_[base + layer - 1] >= kFull)
      over_full = floor_ + (layer + total) * layer_;
  }
  if (over_full) return *over_full;
  // Middle of a ledge, and half of its thickness.
  return floor_ + (moment / total + 0.5 + 0.5 * total) * layer_;
}

void GroundSurface::extend_to_ends() {
  const auto extend = [&](int count, const std::vector<double>& sizes, auto&& at) {
    if (count < 3) return;
    for (const bool last : {false, true}) {
      const int end = last ? count - 1 : 0, in = last ? -1 : 1;
      // The mean of a half column is that of its middle, a quarter of a column from the point.
      if (std::abs(sizes[static_cast<std::size_t>(end)] - 0.5 * raster_.resolution) > kAtEnd * raster_.resolution)
        continue;
      const double rise = (at(end) - at(end + in)) / 0.75, before = at(end + in) - at(end + 2 * in);
      if (std::isfinite(rise) && std::isfinite(before)) at(end) += 0.25 * smaller_of_one_sign(rise, before);
    }
  };
  const auto height_at = [this](int column, int row) -> double& {
    return heights_.heights[static_cast<std::size_t>(row) * raster_.columns + column];
  };
  for (int row = 0; row < raster_.rows; ++row)
    extend(raster_.columns, wide_, [&](int column) -> double& { return height_at(column, row); });
  if (planar_) return;
  for (int column = 0; column < raster_.columns; ++column)
    extend(raster_.rows, deep_, [&](int row) -> double& { return height_at(column, row); });
}

}  // namespace mpm
