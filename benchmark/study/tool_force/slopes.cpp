// Soil under its own weight, without a tool: an infinite slope of sand that stands or runs, and a vertical cut in clay
// under a weight that grows until it falls. Gravity is tilted in the slope, whose ends are joined. Cells count over the
// depth of the layer, and over the height of the cut.
//
// Above the angle of friction the layer shears at its base. With associated flow it rises by tan(phi) times the way it
// runs, which presses it onto its base: its acceleration is the usual one over 1 + tan^2(phi). Without dilation, where
// the principal axes of stress and of plastic strain agree, the base bears between sin(phi) and tan(phi) times its
// normal stress: Davis (1968), in Soil Mechanics: Selected Topics.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/motion_measure.hpp"

namespace mpm::study::tool_force {
namespace slope_problems {

constexpr double kHeight = 0.2, kDensity = 1600.0, kGravity = 9.81, kYoung = 2e6, kPoisson = 0.3, kAngle = 30.0;
constexpr double kFrom = 0.1, kTo = 0.4;  ///< in which the layer's acceleration is measured [s]

double radians(double degrees) { return degrees * kPi / 180.0; }

std::string slope_scene(const Problem& problem, const Setup& setup, double slope, double dilation) {
  const double h = kHeight / setup.cells, length = 8.0 * h;
  return fmt::format(
      "geometry: plane_strain\n"
      "gravity: [{:.17g}, -{:.17g}]\n"
      "grid: {{cell: {:.17g}, min: [0, 0], max: [{:.17g}, {:.17g}]}}\n"
      "time: {{end: {}, sync: 0.0025}}\n"
      "materials:\n  - {}\n"
      "bodies:\n  - {{name: bed, material: soil, shape: {{box: {{min: [0, 0], max: [{:.17g}, {:.17g}]}}}}}}\n"
      "boundaries: {{x: periodic, z_min: fixed}}\n",
      kGravity * std::sin(slope), kGravity * std::cos(slope), h, length, 2.0 * kHeight, problem.to,
      soil_material(problem.law_of(setup), kDensity, kYoung, kPoisson, kAngle, dilation, 0.0), length, kHeight);
}

Problem layer(const std::string& name, const std::string& title, const std::string& text, double slope_degrees,
              double dilation) {
  const double slope = radians(slope_degrees);
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.text = text + fmt::format(
                            " A layer of sand 0.2 m deep on a slope of {:g}° as rough as the sand (friction 30°, "
                            "1600 kg/m³, E = 2 MPa), from rest. Cells: over the depth.",
                            slope_degrees);
  problem.length = kHeight;
  problem.from = kFrom;
  problem.to = kTo;
  problem.wave_speed = elastic_wave(kDensity, kYoung, kPoisson);
  problem.quick = true;
  problem.scene = [slope, dilation](const Problem& own, const Setup& setup) {
    return slope_scene(own, setup, slope, dilation);
  };
  return problem;
}

/// Growth of `part` of what gravity would give the layer, plus `sign` times its velocity.
std::function<std::unique_ptr<Measure>(const Problem&, double)> growth_of(double driven, double scale, double sign) {
  return [=](const Problem& problem, double) -> std::unique_ptr<Measure> {
    const auto read = [=, scratch = std::vector<double>()](Simulation& simulation) mutable {
      const double time = seconds_of(simulation.time());
      return scale * (driven * time + sign * mean_velocity(simulation, scratch));
    };
    return std::make_unique<SeriesMeasure>(problem, SeriesMeasure::Kind::growth, read);
  };
}

/// The weight grows from nothing to 8 c / H in 6.4 s.
constexpr double kLoadTime = 6.4, kMostLoad = 8.0, kCohesion = kDensity * kGravity * kHeight / 4.0;
constexpr double kCutYoung = 1000.0 * kCohesion;

std::string cut_scene(const Problem& problem, const Setup& setup) {
  const double h = kHeight / setup.cells, right = 3.0 * kHeight, left = -2.0 * kHeight;
  return fmt::format(
      "geometry: plane_strain\n"
      "grid: {{cell: {:.17g}, min: [{:.17g}, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
      "time: {{end: {}, sync: 0.002}}\n"
      "materials:\n  - {}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [{:.17g}, {:.17g}], max: [{:.17g}, 0]}}}}}}\n"
      "  - {{name: bank, material: soil, shape: {{box: {{min: [0, 0], max: [{:.17g}, {:.17g}]}}}}}}\n"
      "loads:\n  - {{body_force: {{acceleration: [0, \"-{:.17g} * t\"], body: all}}}}\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: fixed}}\n",
      h, left, -kHeight, right, 2.0 * kHeight, kLoadTime,
      soil_material(problem.law_of(setup), kDensity, kCutYoung, kPoisson, 0.0, 0.0, kCohesion), left, -kHeight, right,
      right, kHeight, kMostLoad * kCohesion / (kDensity * kHeight * kLoadTime));
}

Problem vertical_cut() {
  Problem problem;
  problem.name = "vertical_cut";
  problem.title = "Vertical cut in clay";
  problem.text =
      "Clay with a vertical face of 0.2 m, E = 1000 c, whose weight grows slowly: ρgH/c at which the face falls, with "
      "1 "
      "% of √(gH), which is 3 % after it began to. Cells: over the height.";
  problem.known = Known::bounds;
  problem.answer = vertical_cut_number();
  problem.answer_text =
      "ρgH/c between the best bounds of limit analysis, 3.775 and 3.777: Pastor, Thai and Francescato (2009); Taylor's "
      "(1937) circle gives 3.83";
  problem.length = kHeight;
  problem.to = kLoadTime;
  problem.wave_speed = elastic_wave(kDensity, kCutYoung, kPoisson);
  problem.finest = 12.0;
  problem.scene = cut_scene;
  problem.measure = [](const Problem& own, double) -> std::unique_ptr<Measure> {
    return std::make_unique<CollapseMeasure>(own, kMostLoad / kLoadTime, 0.01 * std::sqrt(kGravity * kHeight));
  };
  return problem;
}

}  // namespace slope_problems

std::vector<Problem> slopes() {
  using namespace slope_problems;
  const double phi = radians(kAngle), gentle = radians(25.0), steep = radians(35.0);
  Problem stands = layer("slope_stands", "Slope below the angle of friction",
                         "The part of the weight along the slope that its base bears, no dilation.", 25.0, 0.0);
  stands.from = 0.5;  // until it has come to rest
  stands.to = 1.5;
  stands.answer = {1.0, 1.0};
  stands.answer_text = "all of it: the slope stands";
  stands.measure = growth_of(kGravity * std::sin(gentle), 1.0 / (kGravity * std::sin(gentle)), -1.0);

  Problem runs =
      layer("slope_runs", "Slope above the angle of friction", "Acceleration [m/s²], associated flow.", 35.0, kAngle);
  const double slide = kGravity * slope_acceleration(steep, phi);
  runs.answer.lower = runs.answer.upper = slide / (1.0 + std::tan(phi) * std::tan(phi));
  runs.answer_text = "g (sin a - cos a tan φ) / (1 + tan²φ): Coulomb's law, and a layer that rises as it shears";
  runs.measure = growth_of(0.0, 1.0, 1.0);

  Problem still = layer("slope_runs_0", "Slope above the angle of friction, no dilation",
                        "Acceleration [m/s²], no dilation.", 35.0, 0.0);
  still.known = Known::bounds;
  still.answer = {slide, kGravity * (std::sin(steep) - std::cos(steep) * std::sin(phi))};
  still.answer_text =
      "between g (sin a - cos a tan φ), Coulomb, and g (sin a - cos a sin φ), a base that shears without change of "
      "volume: Davis (1968)";
  still.measure = growth_of(0.0, 1.0, 1.0);
  return {stands, runs, still, vertical_cut()};
}

}  // namespace mpm::study::tool_force
