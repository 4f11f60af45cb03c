// A cell of soil as sweeps begin with it, from the sums of its particles and the constants of its soil; and what its
// particles take when they have ended. For the processor, whose groups have eight cells, and for devices
// (soil_cells.hpp).
#pragma once

#include <cmath>

#include "mpm/kernel/soil_cells.hpp"

namespace mpm_kernel {

constexpr double kGivenBack = 0.2;  ///< part of it that soil which is too dense gives back in a step

/// A symmetric tensor with tension positive.
struct Tension {
  double xx, yy, zz, yz, xz, xy;
};
/// The stress that is mapped to r.
constexpr Tension tension_of(const double* r) {
  const double p = kOverRoot3 * r[0], q = kOverRoot6 * r[2], d = kOverRoot2 * r[1];
  return {-(p + d - q), -(p - d - q), -(p + 2.0 * q), -kOverRoot2 * r[3], -kOverRoot2 * r[4], -kOverRoot2 * r[5]};
}

/// Tension of the cell in a lane.
template <class T, int Cells>
constexpr Tension tension_in(const SoilGroup<T, Cells>& group, int lane) {
  double r[6] = {};
  for (int i = 0; i < 6; ++i) r[i] = static_cast<double>(group.stress[i][lane]);
  return tension_of(r);
}
/// The force by a unit of volume on one of the cell's nodes from such a tension, towards the cell; in rings that along
/// y, of the hoop stress, is one along r [N/m^3].
template <class T, int Cells>
constexpr void pull_on(const SoilGroup<T, Cells>& group, int lane, const Tension& s, int e, double (&force)[3]) {
  const double x = group.gradient[0][e][lane], y = group.gradient[1][e][lane], z = group.gradient[2][e][lane];
  force[0] = s.xx * x + s.xy * y + s.xz * z;
  force[1] = s.xy * x + s.yy * y + s.yz * z;
  force[2] = s.xz * x + s.yz * y + s.zz * z;
}

/// c cos(phi) [Pa], of a round cone xi c, of metal its yield stress over sqrt(3); `left`: mean over a cell of 1 -
/// per_strain times plastic strain.
inline double cohesion_at(const SoilConstants& soil, double left) {
  if (!soil.metal) return soil.cohesion_end + soil.cohesion_fall * left;
  const double strain = left - 1.0;
  const double lacks = soil.saturation > 0.0 ? soil.saturation * std::exp(-soil.saturation_rate * strain) : 0.0;
  return (soil.yield + soil.hardening * strain + (soil.saturation - lacks)) / std::sqrt(3.0);
}

/// Fills what all cells of a group have alike, before the first.
template <class T, int Cells>
void begin_group(SoilGroup<T, Cells>& group, const SoilConstants& soil) {
  group.mask = -1;
  group.friction_rise = static_cast<T>(soil.friction_rise);
  group.reference_rate = static_cast<T>(soil.reference_rate);
}

/// Fills a lane of a group, but for its nodes and place, and of the places of its soil. `rings`: cells are sections of
/// rings.
template <class T, int Cells>
void make_cell(const SoilSums<T>& sums, const SoilConstants& soil, double dt, bool rings, int lane,
               SoilGroup<T, Cells>& group, SoilPlaces<T, Cells>& places) {
  const double per_volume = 1.0 / sums.volume;
  for (int i = 0; i < 6; ++i) places.mean[i][lane] = static_cast<T>(per_volume * sums.place[i]);
  if (rings) {
    const T over_radius[4] = {sums.place[1], sums.place[3], sums.place[5], sums.stress[3]};
    for (int i = 0; i < 4; ++i) places.over_radius[i][lane] = static_cast<T>(per_volume * over_radius[i]);
  }
  const double push = dt * sums.volume, opening = per_volume * sums.opening, left = per_volume * sums.left;
  const double compliance_n = 1.0 / (3.0 * soil.bulk * dt), compliance_t = 1.0 / (2.0 * soil.shear * dt);
  group.push[lane] = static_cast<T>(push);
  group.compliance_n[lane] = static_cast<T>(compliance_n);
  group.compliance_t[lane] = static_cast<T>(compliance_t);
  group.sine[lane] = static_cast<T>(soil.sine_end + soil.sine_fall * left);
  group.cohesion[lane] = static_cast<T>(cohesion_at(soil, left));
  group.dilation[lane] = static_cast<T>(soil.dilation);
  group.dilates[lane] = static_cast<T>(per_volume * sums.dilates);
  group.least[lane] = static_cast<T>(soil.least);
  group.lode[lane] = soil.follows_lode ? T(1) : T(0);
  // Soil that has parted closes before it is pressed; volume that pressure should account for is an error.
  const bool closes = soil.opens && opening > 0.0;
  group.closing[lane] = static_cast<T>(kOverRoot3 * (closes ? opening : kGivenBack * opening) / dt);
  for (int i = 0; i < 6; ++i) {
    const double r = rings && i == 3 ? 0.0 : per_volume * sums.stress[i];
    group.stress[i][lane] = static_cast<T>(r);
    group.shift[i][lane] = static_cast<T>(-(i == 0 ? compliance_n : compliance_t) * r);
  }
  group.shift[0][lane] += group.closing[lane];
}

/// Finds what particles take from the cell in a lane.
template <class T, int Cells>
void find_motion(const SoilGroup<T, Cells>& group, const SoilFlow<T, Cells>& flow, int lane, SoilMotion<T>& motion) {
  for (int i = 0; i < 9; ++i) motion.gradient[i] = flow.gradient[i][lane];
  motion.power = T(0);
  for (int i = 0; i < 6; ++i) {
    motion.stress[i] = group.stress[i][lane];
    motion.power -= motion.stress[i] * flow.rate[i][lane];
  }
  motion.shear = flow.shear[lane];
  motion.opening = flow.opening[lane];
}

}  // namespace mpm_kernel
