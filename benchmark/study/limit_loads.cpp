#include "study/limit_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/math/constants.hpp"
#include "study/suite.hpp"

namespace mpm::study {
namespace {

double square(double x) { return x * x; }

/// A block that a wall pushes, by its moments about the pole of its log spiral.
struct SpiralBlock {
  double coefficient = std::numeric_limits<double>::infinity();  ///< K_p; infinite for a pole that leaves no block
  double moment = 0.0;                                           ///< moment of its weight
  double end = 0.0;                                              ///< place where the spiral meets the surface
};

/// The block of rough_wall_coefficient() for one pole (x, z): a wall from the foot (0, -1) to the surface z = 0, and a
/// log spiral from the foot to the surface that grows as it turns from below towards the surface, on which the
/// resultant of stress and friction points to the pole. Soil of unit weight.
SpiralBlock spiral_block(double friction, double x, double z) {
  const SpiralBlock kNone;
  const double tangent = std::tan(friction);
  // The wall's force acts at a third of its height, and downwards on soil that rises along it.
  const double lever = z + 2.0 / 3.0 + x * tangent;
  if (lever <= 0.0) return kNone;
  const double foot_radius = std::hypot(x, z + 1.0), foot_angle = std::atan2(-1.0 - z, -x);
  constexpr int kPieces = 500;
  constexpr double kTurn = kPi / kPieces;
  double from_x = 0.0, from_z = -1.0, moment = 0.0;
  for (int i = 1; i <= kPieces; ++i) {
    const double turn = i * kTurn, radius = foot_radius * std::exp(turn * tangent);
    double to_x = x + radius * std::cos(foot_angle + turn), to_z = z + radius * std::sin(foot_angle + turn);
    const bool surfaces = to_z >= 0.0;
    if (surfaces) {
      to_x = from_x + (to_x - from_x) * from_z / (from_z - to_z);
      to_z = 0.0;
    }
    if (to_x < from_x) return kNone;
    // The strip of soil above this piece, of unit weight.
    moment += (to_x - from_x) * -0.5 * (from_z + to_z) * (0.5 * (from_x + to_x) - x);
    if (surfaces) return {moment / lever / 0.5, moment, to_x};
    from_x = to_x;
    from_z = to_z;
  }
  return kNone;
}

struct WeakestBlock {
  double x = -0.5, z = 0.5;  ///< its pole
  SpiralBlock block;
};

/// The block of the least force, by a search over poles whose steps halve where none of them helps.
WeakestBlock weakest_block(double friction) {
  WeakestBlock best;
  best.block = spiral_block(friction, best.x, best.z);
  double step = 0.25;
  while (step > 1e-4) {
    const double before = best.block.coefficient;
    for (const auto& [dx, dz] : {std::pair{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
      const WeakestBlock tried{best.x + dx, best.z + dz, spiral_block(friction, best.x + dx, best.z + dz)};
      if (tried.block.coefficient < best.block.coefficient) best = tried;
    }
    if (best.block.coefficient == before) step *= 0.5;
  }
  return best;
}

}  // namespace

double passive_coefficient(double friction) { return square(std::tan(0.25 * kPi + 0.5 * friction)); }
double active_coefficient(double friction) { return 1.0 / passive_coefficient(friction); }

double bearing_surcharge_factor(double friction) {
  return std::exp(kPi * std::tan(friction)) * passive_coefficient(friction);
}

double bearing_cohesion_factor(double friction) {
  if (friction == 0.0) return 2.0 + kPi;
  return (bearing_surcharge_factor(friction) - 1.0) / std::tan(friction);
}

Bounds rough_wall_coefficient(double friction) {
  const double sine = std::sin(friction), cosine = std::cos(friction);
  // With wall friction = friction the root of sin^2(phi) - sin^2(delta) vanishes, and 2 theta = 90 degrees + delta.
  const double lower = square(cosine) / (1.0 - sine) * std::exp((0.5 * kPi + friction) * std::tan(friction));
  return {lower, weakest_block(friction).block.coefficient};
}

double swept_soil_growth(double friction, bool rough) {
  if (!rough) return 2.0 * std::tan(0.25 * kPi - 0.5 * friction);
  const WeakestBlock weakest = weakest_block(friction);
  // The block turns about its pole, so that it rises in proportion to the distance from it, and so does the heap.
  const double near = -weakest.x, far = weakest.block.end - weakest.x;
  const double arm = 2.0 / 3.0 * (far * far * far - near * near * near) / (far * far - near * near);
  return arm / weakest.block.moment;
}

double bearing_weight_factor(double friction, bool rough) {
  struct Value {
    double degrees, smooth, rough;
  };
  constexpr Value kValues[] = {{20.0, 1.579, 2.839}, {30.0, 7.653, 14.75}, {40.0, 43.19, 85.57}};
  const double degrees = friction * 180.0 / kPi;
  for (const Value& value : kValues) {
    if (std::abs(degrees - value.degrees) < 1e-9) return rough ? value.rough : value.smooth;
  }
  throw StudyError(fmt::format("N_gamma is known for 20, 30 and 40 degrees, not for {:g}", degrees));
}

double circular_footing_factor(bool rough) { return rough ? 6.05 : 5.69; }

double lateral_pile_factor(double adhesion_over_cohesion) {
  const double delta = std::asin(adhesion_over_cohesion);
  return kPi + 2.0 * delta + 2.0 * std::cos(delta) + 4.0 * (std::cos(0.5 * delta) + std::sin(0.5 * delta));
}

Bounds vertical_cut_number() { return {3.7752, 3.7776}; }

WedgeIndentation wedge_indentation(double half_angle) {
  // The difference rises with the fan's angle, which lies between 0 and 90 degrees.
  double low = 0.0, high = 0.5 * kPi;
  for (int i = 0; i < 60; ++i) {
    const double fan = 0.5 * (low + high);
    (std::cos(2.0 * half_angle - fan) < std::cos(fan) / (1.0 + std::sin(fan)) ? low : high) = fan;
  }
  WedgeIndentation wedge;
  wedge.fan = low;
  wedge.pressure = 2.0 * (1.0 + low);
  wedge.contact = 1.0 / (std::cos(half_angle) - std::sin(half_angle - low));
  wedge.force = 2.0 * wedge.pressure * wedge.contact * std::sin(half_angle);
  return wedge;
}

double davis_friction(double friction, double dilation) {
  return std::atan(std::cos(dilation) * std::sin(friction) / (1.0 - std::sin(dilation) * std::sin(friction)));
}

double silo_wall_pressure(double depth_over_width, double friction_coefficient, double stress_ratio) {
  return -std::expm1(-2.0 * friction_coefficient * stress_ratio * depth_over_width) / (2.0 * friction_coefficient);
}

double slope_acceleration(double slope, double friction) {
  return std::max(0.0, std::sin(slope) - std::cos(slope) * std::tan(friction));
}

}  // namespace mpm::study
