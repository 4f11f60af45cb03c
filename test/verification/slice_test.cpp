// A planar scene in plane strain and the same scene as a slice of one cell in three dimensions between smooth walls are
// one problem, and the sums of the method are the same: weights are products along the axes, and those along y add up
// to one over a cell. So the results agree to round-off, for any law, contact and schedule. Contact is at nodes here;
// at points the sweeps end when they change velocities by a thousandth, and the force differs by as much.
#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace slice_test {

/// Particles of the slice that correspond to those of the plane by their initial position: one of each pair along y.
struct Pairs {
  std::vector<std::size_t> front, back;
};

Pairs pair_up(const mpm::Simulation& plane, const mpm::Simulation& slice) {
  std::map<std::pair<long, long>, std::vector<std::size_t>> places;
  const auto key = [](double x, double z) { return std::pair(std::lround(1e6 * x), std::lround(1e6 * z)); };
  const std::vector<double> x = field(slice, "x"), z = field(slice, "z"), y = field(slice, "y");
  for (std::size_t p = 0; p < x.size(); ++p) places[key(x[p], z[p])].push_back(p);
  const std::vector<double> plane_x = field(plane, "x"), plane_z = field(plane, "z");
  Pairs pairs;
  for (std::size_t p = 0; p < plane_x.size(); ++p) {
    const std::vector<std::size_t>& found = places.at(key(plane_x[p], plane_z[p]));
    EXPECT_EQ(found.size(), 2u);
    pairs.front.push_back(found.at(0));
    pairs.back.push_back(found.at(1));
  }
  return pairs;
}

/// Largest difference of each field over the run, relative to the field's largest value.
struct Agreement {
  std::vector<double> difference;  // in the order of kFields
  double force = 0.0;              // difference of the force on the tool, over its largest value
  Numbers time, history;           // [s], largest of all fields so far
  Numbers x, z, mises;             // at the particles in plane strain, at the end [m], [Pa]
};

const std::vector<std::string> kFields = {"x", "z", "vx", "vz", "sxx", "szz", "sxz", "syy", "j"};

Agreement compare(const std::string& law, const std::string& update) {
  const std::vector<std::string> overrides = {law, "method.update=" + update, "contact.method=nodes"};
  mpm::Simulation plane = start("pressed_block", overrides, 1), slice = start("pressed_slice", overrides, 1);
  const Pairs pairs = pair_up(plane, slice);
  std::vector<double> difference(kFields.size()), scale(kFields.size());
  double force_difference = 0.0, force_scale = 0.0;
  Agreement agreement;
  while (seconds(plane) < 0.2 - 1e-9) {
    plane.advance();
    slice.advance();
    for (std::size_t f = 0; f < kFields.size(); ++f) {
      const std::vector<double> in_plane = field(plane, kFields[f]), in_slice = field(slice, kFields[f]);
      for (std::size_t p = 0; p < in_plane.size(); ++p) {
        scale[f] = std::max(scale[f], std::abs(in_plane[p]));
        for (const std::size_t q : {pairs.front[p], pairs.back[p]}) {
          difference[f] = std::max(difference[f], std::abs(in_plane[p] - in_slice[q]));
        }
      }
    }
    const mpm::Vec3 on_plane = plane.take_contact(0).mean.force, on_slice = slice.take_contact(0).mean.force;
    force_difference = std::max(force_difference, (on_plane - on_slice).norm());
    force_scale = std::max(force_scale, on_plane.norm());
    double most = 0.0;
    for (std::size_t f = 0; f < kFields.size(); ++f) most = std::max(most, difference[f] / scale[f]);
    agreement.time.push_back(seconds(plane));
    agreement.history.push_back(most);
  }
  for (std::size_t f = 0; f < kFields.size(); ++f) agreement.difference.push_back(difference[f] / scale[f]);
  agreement.force = force_difference / force_scale;
  agreement.x = field(plane, "x");
  agreement.z = field(plane, "z");
  agreement.mises = field(plane, "mises");
  EXPECT_EQ(plane.state().step.steps, slice.state().step.steps);
  EXPECT_GT(force_scale, 100.0);  // [N]; the tool pressed
  return agreement;
}

TEST(Slice, AgreesWithPlaneStrain) {
  Page page("conservation", "slice", "Plane strain and a slice in three dimensions");
  page.problem(
          "A block of 16 × 10 cells on a floor with friction 0.3 is pressed, dragged and turned by a tilted box with "
          "friction "
          "0.4, under gravity; once in plane strain, once in three dimensions as a slice of one cell between smooth "
          "walls.")
      .exact(
          "Both are one problem, and weights along y add up to one over a cell: every particle of the slice has the "
          "state of the particle in plane strain at the same position.",
          "the method's own sums; a difference is round-off")
      .meaning(
          "Planar and three-dimensional kernels, laws, walls, contact and reports agree. (This requires that walls "
          "act before contact as well as after it; otherwise friction would act on velocity that the wall removes "
          "afterwards.) The time step is given, since the wave speed of soil jumps where it yields, and round-off "
          "could then change the number of steps.")
      .scene("pressed_block");
  Panel& panel = page.figure().panel("Largest difference so far", "time [s]", "over the field's largest value").log_y();
  const std::vector<std::pair<std::string, std::string>> laws = {
      {"neo_hookean", "materials.soft.law=neo_hookean"},
      {"linear_elastic", "materials.soft.law=linear_elastic"},
      {"drucker_prager",
       "materials.soft={name: soft, density: 1000, law: drucker_prager, young: 200 kPa, poisson: 0.3, friction_angle: "
       "30 deg, "
       "dilation_angle: 5 deg, cohesion: 2 kPa}"}};
  for (const auto& [law, override_text] : laws) {
    for (const std::string update : {"usavg", "usf"}) {
      const Agreement agreement = compare(override_text, update);
      const std::string label = law + ", " + update;
      const double most = *std::max_element(agreement.difference.begin(), agreement.difference.end());
      // 1e-9 is required; the measured difference is the round-off of some hundred steps.
      page.below("largest difference of any field, " + label, most, 1e-9, "of the field's largest value");
      page.below("difference of the force on the tool, " + label, agreement.force, 1e-9, "of its largest");
      panel.line(label, agreement.time, agreement.history);
      if (law == "neo_hookean" && update == "usavg") {
        page.figure()
            .panel("The block at the end", "x [m]", "z [m]")
            .particles("von Mises stress [Pa]", agreement.x, agreement.z, agreement.mises);
      }
    }
  }
}

}  // namespace slice_test
}  // namespace verification
