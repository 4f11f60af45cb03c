// materials: the laws of soil that have an angle of friction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// Width of a shear band as the grid resolves it [m]: `shear_band`, or the longest edge of a cell; 0 outside a scene.
double read_band(const Map& map, const Scene& scene) {
  double cell = 0.0;
  if (scene.definition.grid.cell.x() > 0.0) {
    for (const int axis : axes_of(scene)) cell = std::max(cell, scene.definition.grid.cell[axis]);
  }
  const auto named = map.find("shear_band");
  if (!named) return cell;
  const double band = named->positive(kLength);
  if (band < cell * (1.0 - 1e-9)) {
    named->fail(fmt::format("{:g} m is narrower than a cell, {:g} m, in which the grid resolves a band; leave it out",
                            band, cell));
  }
  return band;
}

/// A band as --explain tells it.
std::string band_text(const Map& map, double band) {
  return fmt::format("a band {}{:g} m wide", map.find("shear_band") ? "" : "of one cell, ", band);
}

/// Completes how a soil loses its strength along a shear band.
template <class SoilDefinition>
void read_softening(const Map& map, Scene& scene, SoilDefinition& law) {
  const auto slip = map.find("softening_slip");
  for (const char* key : {"residual_friction_angle", "residual_cohesion"}) {
    if (slip || !map.find(key)) continue;
    map.at(key).fail(
        "strength that falls needs the slip along a shear band over which it does, since a grid resolves a band in a "
        "cell, and with a strain the force would depend on the cell: write softening_slip");
  }
  if (!slip) return;
  SoilSoftening& fall = law.softening;
  if (!map.find("residual_friction_angle")) fall.friction_angle = law.friction_angle;
  if (!map.find("residual_cohesion")) fall.cohesion = law.cohesion;
  fall.band = read_band(map, scene);
  if (fall.band == 0.0) slip->fail("without a grid the width of a shear band is not known; add shear_band");
  scene.choices.emplace_back(map.value().path() + ".softening_slip",
                             fmt::format("{:g} m is a plastic shear strain of {:.3g} in {}", fall.slip, fall.strain(),
                                         band_text(map, fall.band)));
}

/// Completes where dilation ends: at a volume, or sooner, where a shear band has risen; in soil that softens, with the
/// fall.
template <class SoilDefinition>
void read_dilation_end(const Map& map, Scene& scene, SoilDefinition& law) {
  const auto limit = map.find("dilation_limit"), rise = map.find("dilation_rise");
  if (!limit && law.softening.falls()) {
    law.dilation_limit = kInfinity;  // it ends with the fall
  } else if (!limit && law.dilation_angle > 0.0) {
    scene.choices.emplace_back(
        map.value().path() + ".dilation_limit",
        fmt::format("{:g}: dilation ends when the volume has grown by that part", kDilationLimit));
  }
  SoilSoftening& fall = law.softening;
  const bool ends = law.dilation_angle > 0.0 && std::isfinite(law.dilation_limit);
  const double band = rise || ends ? read_band(map, scene) : 0.0;
  if (rise && std::isfinite(fall.rise) && band == 0.0) {
    rise->fail("without a grid the width of a shear band is not known; add shear_band");
  } else if (!rise && ends && band > 0.0) {  // without a grid there are no bands
    fall.rise = kDilationRise;
  }
  if (std::isinf(fall.rise)) {
    const auto unused = map.find("shear_band");
    if (unused && !fall.falls()) {
      unused->fail("nothing falls along a shear band: write softening_slip, or dilation_rise, or leave it out");
    }
    return;
  }
  fall.band = band;
  const double gained = fall.rise / band;
  scene.choices.emplace_back(
      map.value().path() + ".dilation_rise",
      gained < law.dilation_limit
          ? fmt::format("{:g} m: dilation ends when the volume has grown by {:.3g} in {}", fall.rise, gained,
                        band_text(map, band))
          : fmt::format("{:g} m: a cell is finer than a band in the soil, where dilation ends at dilation_limit, {:g}",
                        fall.rise, law.dilation_limit));
}

}  // namespace

template <class Soil>
void complete_soil(const Map& map, Scene& scene, Soil& law) {
  read_softening(map, scene, law);
  read_dilation_end(map, scene, law);
}
void complete_law(const Map& map, Scene& scene, DruckerPragerDefinition& law) { complete_soil(map, scene, law); }
void complete_law(const Map& map, Scene& scene, MohrCoulombDefinition& law) { complete_soil(map, scene, law); }

}  // namespace mpm
