// The height of the ground, from particles: the highest material in each column that hangs together with the rest.
//
// A column stands around each point of a raster and reaches half way to the next ones; one at an end of the domain is
// half as wide. It is divided into layers. A particle is the box that it stands for, and gives each cell of columns and
// layers the part of its volume that lies there. Cells that are half full or more hang together across their faces; the
// most material that does, and what else reaches as far down, is the ground. A thrown grain fills no half of a cell and
// is none of it, nor is what a bucket carries.
//
// The height is that of the volume, as in the method of height functions (Cummins, Francois & Kothe (2005)): that of
// the ground's bottom, or of the lowest of the full cells where there is a gap or a tool below them, and all that is
// filled above. So it is exact for a flat bed and for an even slope, and the volume under the map is that of the
// material. Of an upright face it is the mean over the column, and of an overhang the upper side.
//
// Weak: a grain within a cell above the ground raises its column by its own volume. Where particles have drawn nearer
// to each other than their volumes say, as they do in a heap that was pushed together, the height is above them.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Points at which heights are found: columns along x, rows along y (one in planar scenes).
struct GroundRaster {
  Vec2 low = Vec2::Zero();  ///< place of the first point [m]
  double resolution = 0.0;  ///< distance between points along both axes [m]
  int columns = 0, rows = 1;
};

/// Box around its centre that a particle fills.
struct GroundGrain {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 half = Vec3::Zero();    ///< half of its edges [m]; y does not count in planar scenes
  double volume = 0.0;         ///< [m^3]
};

class GroundSurface {
 public:
  /// `room`: the domain [m]; in planar scenes its size along y is the thickness. `layer`: height of a layer [m].
  GroundSurface(const Box& room, double layer, bool planar);

  /// Heights [m] at the points, row by row from low y, NaN where there is no ground. Memory is kept from call to call.
  const HeightGrid& find(const GroundRaster& raster, const std::vector<GroundGrain>& grains);

 private:
  void fit(const GroundRaster& raster, const std::vector<GroundGrain>& grains);
  void add(const GroundGrain& grain);
  /// Marks the cells of the ground.
  void mark();
  /// Marks what hangs together with a cell, and returns its volume in cells; `lowest`: the lowest layer of it.
  double spread(std::size_t from, std::uint32_t label, int& lowest);
  double height(int column, int row) const;
  /// Lets points at the ends of the domain, whose half columns lie beside them, have the height of the end itself.
  void extend_to_ends();

  std::size_t cell(int column, int row, int layer) const {
    return (static_cast<std::size_t>(row) * raster_.columns + column) * layers_ + layer;
  }
  bool ground(std::size_t cell) const { return label_[cell] == kGround; }
  /// True if a cell beside it, in another column, is of the ground.
  bool beside_ground(int column, int row, int layer) const;

  static constexpr std::uint32_t kNone = 0, kGround = 1;

  const Box room_;
  const double layer_;
  const bool planar_;
  GroundRaster raster_;
  double floor_ = 0.0;   ///< lower side of the lowest layer [m]
  double lowest_ = 0.0;  ///< lower side of the lowest grain [m]
  int layers_ = 0;
  int bottom_ = 0;                   ///< lowest layer of the ground
  std::vector<double> wide_, deep_;  ///< sizes of columns along x and y [m]
  std::vector<double> fill_;         ///< part of each cell that is filled
  std::vector<float> moment_;        ///< moment of the fill about the middle of its layer [layers]
  std::vector<std::uint32_t> label_;
  std::vector<std::size_t> stack_;
  std::vector<double> shares_[3];
  HeightGrid heights_;
};

}  // namespace mpm
