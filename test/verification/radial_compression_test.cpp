// Uniform radial compression of a disk, Nairn & Guilkey (2015) 4.1: figure 5 (domains fitted to the axis, or not),
// figure 6 (planar functions instead of those weighted with r), figure 7 (stresses against volume) and the compressions
// at which methods break down.
//
// Exact: F = diag(l, 1, l), J = l^2, stresses (66), (67), and every particle at l times its first radius. The rim
// closes like an iris, so the exact motion is uniform, and any nonuniformity is an error of the method. Of the two
// rules of motion `mean` is the paper's, `point` the remedy of method reference 3.5.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace radial_compression_test {

using Overrides = std::vector<std::string>;

constexpr int kThreads = 1;       // tests run side by side
constexpr double kRadius = 0.05;  // [m]
constexpr double kSpeed = 20.0;   // speed of the rim [m/s]
constexpr double kSpacing = 1.25e-3;
constexpr double kNear = 0.016;       // part of the radius shown in figures 5 and 6 [m]
constexpr double kBroken = 0.25;      // error of a J near the axis that counts as breakdown: noise as large as strain
constexpr double kOffTheChart = 1.0;  // error of a J above which it is left out of a picture
constexpr double kEnd = 0.4;          // stretch of figures 5 and 6
constexpr double kBulk = 2300e6 / (3.0 * (1.0 - 2.0 * 0.33)), kShear = 2300e6 / (2.0 * 1.33);  // [Pa]

double exact_rr(double j) {
  return (j - 1.0) / j * (0.5 * kBulk * (j + 1.0) + kShear / (3.0 * std::pow(j, 2.0 / 3.0)));  // (66)
}
double exact_zz(double j) {
  return (j - 1.0) / j * (0.5 * kBulk * (j + 1.0) - 2.0 * kShear / (3.0 * std::pow(j, 2.0 / 3.0)));  // (67)
}
double mean_of(const Numbers& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The disk at one time. Quantities by radius are means over the height, by initial radius.
struct Disk {
  double stretch = 1.0;                               ///< exact stretch of the radius
  Numbers start, j, radius;                           ///< initial radius [m], J, present radius over the exact one
  double mean_j = 1.0, mean_rr = 0.0, mean_zz = 0.0;  ///< means over all particles; stresses [Pa]
  double exact_j() const { return stretch * stretch; }
  double compression() const { return 100.0 * (1.0 - exact_j()); }  ///< compression of the volume [%]
  /// Largest |J / exact - 1| over the radii up to `within` [m].
  double worst_j(double within = 1.0) const {
    double worst = 0.0;
    for (std::size_t c = 0; c < j.size(); ++c) {
      if (start[c] < within) worst = std::max(worst, std::abs(j[c] / exact_j() - 1.0));
    }
    return worst;
  }
  double worst_radius() const {
    double worst = 0.0;
    for (const double one : radius) worst = std::max(worst, std::abs(one - 1.0));
    return worst;
  }
  /// Largest error of a mean stress over the exact radial one.
  double worst_stress() const {
    const double scale = std::abs(exact_rr(exact_j()));
    return std::max(std::abs(mean_rr - exact_rr(exact_j())), std::abs(mean_zz - exact_zz(exact_j()))) / scale;
  }
};

class Compression {
 public:
  explicit Compression(const Overrides& method) : simulation_(start("radial_compression", method, kThreads)) {
    first_ = field(simulation_, "x");
  }
  double stretch() const { return 1.0 - seconds(simulation_) * kSpeed / kRadius; }
  /// Advances one sync period, 2 % of the initial radius. @throws mpm::PhysicsError when the method breaks down
  void advance() { simulation_.advance(); }
  Disk disk() const {
    Disk disk;
    disk.stretch = stretch();
    const Numbers x = field(simulation_, "x"), j = field(simulation_, "j");
    disk.mean_j = mean_of(j);
    disk.mean_rr = mean_of(field(simulation_, "sxx"));
    disk.mean_zz = mean_of(field(simulation_, "szz"));
    // Particles are numbered row by row, and rows along r.
    const auto columns = static_cast<std::size_t>(std::lround(kRadius / kSpacing));
    const auto rows = static_cast<double>(x.size() / columns);
    for (std::size_t c = 0; c < columns; ++c) {
      double sum_j = 0.0, sum_r = 0.0;
      for (std::size_t p = c; p < x.size(); p += columns) {
        sum_j += j[p];
        sum_r += x[p];
      }
      disk.start.push_back(first_[c]);
      disk.j.push_back(sum_j / rows);
      disk.radius.push_back(sum_r / rows / (disk.stretch * first_[c]));
    }
    return disk;
  }

 private:
  mpm::Simulation simulation_;
  Numbers first_;
};

struct Method {
  std::string label;
  Overrides overrides;
};

/// `axis`: keys of method.axis. FLIP gets the short steps that it needs here; APIC has those of the scene.
Method method(const std::string& label, const std::string& shape, const std::string& transfer, const Overrides& axis) {
  Method one{label, {"method.shape=" + shape, "method.transfer=" + transfer}};
  if (transfer == "flip") one.overrides.emplace_back("time.cfl=0.2");
  for (const std::string& rule : axis) one.overrides.push_back("method.axis." + rule);
  return one;
}

/// The end of a run: the disk at stretch kEnd, or the point at which the method broke down.
struct Outcome {
  Disk disk;
  bool broke = false;
};
Outcome run(const Method& method) {
  Compression compression(method.overrides);
  Outcome outcome;
  try {
    while (compression.stretch() > kEnd + 1e-9) compression.advance();
  } catch (const mpm::PhysicsError&) {
    outcome.broke = true;
  }
  outcome.disk = compression.disk();
  return outcome;
}

struct Drawing {
  Page& page;
  Panel &of_j, &of_radius;
};
Drawing draw_on(Page& page) {
  Panel& of_j = page.figure().panel("J near the axis", "first radius [mm]", "J [%]");
  Panel& of_radius = page.figure().panel("Radii near the axis", "first radius [mm]", "radius / exact radius");
  of_j.exact("exact", {0.0, 1e3 * kNear}, {16.0, 16.0});
  of_radius.exact("exact", {0.0, 1e3 * kNear}, {1.0, 1.0});
  return {page, of_j, of_radius};
}

/// Runs a method, draws it, and reports its errors without a check.
Outcome show(Drawing& drawing, const Method& method) {
  const Outcome outcome = run(method);
  const Disk& disk = outcome.disk;
  if (outcome.broke) {
    drawing.page.report(method.label + ": a particle crosses the axis at a compression of", disk.compression(), "%");
    return outcome;
  }
  Numbers r, j, ratio;
  for (std::size_t c = 0; c < disk.start.size() && disk.start[c] < kNear; ++c) {
    r.push_back(1e3 * disk.start[c]);
    j.push_back(100.0 * disk.j[c]);
    ratio.push_back(disk.radius[c]);
  }
  if (disk.worst_j() < kOffTheChart) {
    drawing.of_j.line(method.label, r, j);
    drawing.of_radius.line(method.label, r, ratio);
  }
  drawing.page.report(method.label + ": largest error of J", 100.0 * disk.worst_j(), "%");
  drawing.page.report(method.label + ": largest error of a radius", 100.0 * disk.worst_radius(), "%");
  return outcome;
}

/// The requirement on the best methods: J uniform to the axis within 1 %, the mean within 1 %.
void ask(Page& page, const std::string& label, const Disk& disk) {
  page.below(label + ": largest error of J", 100.0 * disk.worst_j(), 1.0, "%");
  page.near(label + ": mean J", disk.mean_j, disk.exact_j(), 0.01, "");
  page.below(label + ": largest error of a radius", 100.0 * disk.worst_radius(), 1.0, "%");
}

const char* const kProblem =
    "A disk of radius 50 mm and height 10 mm between smooth plates (neo-Hookean, E = 2300 MPa, nu = 0.33), cells of "
    "2.5 mm with 4 particles, is compressed by a ring that closes at 1/100 of the speed of sound, to 40 % of its "
    "radius. FLIP runs with cfl 0.2: at 0.5 it breaks up beyond a compression of 60 % with any shape function.";

TEST(RadialCompression, DomainsAtTheAxis) {
  Page page("axisymmetric", "radial_compression", "Radial compression: domains fitted to the axis (figure 5)");
  page.problem(kProblem)
      .exact("F = diag(l, 1, l): J = l^2 = 16 % and radii l R, everywhere", "Nairn & Guilkey (2015) (63)")
      .scene("radial_compression")
      .meaning(
          "The paper finds J constant with uGIMP and CPDI whose domains are cut or shrunk at the axis, poor with "
          "whole uGIMP boxes, slightly wrong beside the axis with whole CPDI domains, and classic MPM unstable. The "
          "results here are the same, except for uGIMP: with FLIP and the paper's way to move particles one crosses "
          "the axis first. The right panel shows the reason: averages with the weight r are those of the centre of "
          "mass, and move particles beside the axis too fast (method reference 3.5). Moved by the grid's velocity at "
          "its position (`motion: point`, the default) a particle stays where it should, and J is exact; with APIC, "
          "which adds no noise, to 2e-4. uGIMP's boxes do not shrink with the material: J is within 1 % at the axis, "
          "4 % off at a third of the radius and 11 % at the rim.");
  Drawing drawing = draw_on(page);
  const Overrides mean = {"motion=mean"}, whole = {"motion=mean", "domains=whole"};
  const Outcome cpdi = show(drawing, method("CPDI, FLIP, mean", "cpdi", "flip", mean));
  const Outcome cpdi_whole = show(drawing, method("CPDI whole, FLIP, mean", "cpdi", "flip", whole));
  show(drawing, method("uGIMP, FLIP, mean", "ugimp", "flip", mean));
  show(drawing, method("uGIMP whole, FLIP, mean", "ugimp", "flip", whole));
  const Outcome dirac = show(drawing, method("Dirac, FLIP", "dirac", "flip", mean));
  const Outcome ugimp = show(drawing, method("uGIMP, APIC, point", "ugimp", "apic", {}));
  const Outcome by_point = show(drawing, method("CPDI, FLIP, point", "cpdi", "flip", {}));
  ask(page, "CPDI, FLIP, point", by_point.disk);
  for (const char* shape : {"cpdi", "ugimp_stretch", "qcpdi"}) {
    ask(page, fmt::format("{}, APIC, point", shape), run(method("", shape, "apic", {})).disk);
  }
  // Methods that fail in the paper.
  page.above("CPDI whole, mean: error of J at the first particle", 100.0 * std::abs(cpdi_whole.disk.j[0] / 0.16 - 1.0),
             3.0, "%");
  page.below("CPDI, mean: error of J at the first particle", 100.0 * std::abs(cpdi.disk.j[0] / 0.16 - 1.0), 1.0, "%");
  page.above("Dirac: largest error of J", 100.0 * dirac.disk.worst_j(), 50.0, "%");
  page.below("uGIMP, APIC, point: error of J at the first particle", 100.0 * std::abs(ugimp.disk.j[0] / 0.16 - 1.0),
             1.0, "%");
  // A one-dimensional trial found 0.74 for a domain that follows F, with the standard update (method reference 3.5).
  page.near("CPDI, FLIP, mean: first radius over the exact one", cpdi.disk.radius[0], 0.74, 0.02, "");
}

TEST(RadialCompression, PlanarFunctions) {
  Page page("axisymmetric", "radial_compression_planar", "Radial compression: planar functions (figure 6)");
  page.problem(std::string(kProblem) + " With APIC, so that the functions alone differ; steps by the scene's cfl.")
      .exact("J = 16 % everywhere", "Nairn & Guilkey (2015) (63)")
      .scene("radial_compression")
      .meaning(
          "As in the paper: planar functions are off at the first particles when the nodes beyond the axis are left "
          "free, and acceptable when those mirror the nodes inside; functions with the weight r do not use those "
          "nodes. The paper's curve for nodes held at zero lies between the two; here it hardly differs from free "
          "nodes in J.");
  Drawing drawing = draw_on(page);
  const auto planar = [](const std::string& ghosts) {
    return method("planar, " + ghosts, "ugimp", "apic", {"motion=mean", "functions=planar", "ghosts=" + ghosts});
  };
  const auto first = [](const Outcome& outcome) { return 100.0 * std::abs(outcome.disk.j[0] / 0.16 - 1.0); };
  const Outcome free = show(drawing, planar("free")), zero = show(drawing, planar("zero"));
  const Outcome mirror = show(drawing, planar("mirror"));
  const Outcome weighted = show(drawing, method("with the weight r, mean", "ugimp", "apic", {"motion=mean"}));
  const Outcome by_point = show(drawing, method("with the weight r, point", "ugimp", "apic", {}));
  page.above("free nodes: error of J at the first particle", first(free), 10.0, "%");
  page.report("nodes at zero: error of J at the first particle", first(zero), "%");
  page.below("mirrored nodes: error of J at the first particle", first(mirror), 5.0, "%");
  page.below("weight r, mean: error of J at the first particle", first(weighted), 5.0, "%");
  page.below("weight r, point: error of J at the first particle", first(by_point), 1.0, "%");
}

/// Mean stresses until `good` or the method fails.
struct Course {
  Numbers j, rr, zz;
  double worst_to_84 = 0.0;  ///< Disk::worst_stress() up to a compression of 84 %
  double breakdown =
      100.0;  ///< compression at which J is off by a quarter within 16 mm of the axis, or a particle is lost [%]
};
Course follow(const Method& method) {
  Compression compression(method.overrides);
  Course course;
  while (compression.stretch() > 0.17) {
    try {
      compression.advance();
    } catch (const mpm::PhysicsError&) {
      course.breakdown = compression.disk().compression();
      break;
    }
    const Disk disk = compression.disk();
    course.j.push_back(100.0 * disk.exact_j());
    course.rr.push_back(1e-6 * disk.mean_rr);
    course.zz.push_back(1e-6 * disk.mean_zz);
    if (disk.stretch > kEnd - 1e-9) course.worst_to_84 = std::max(course.worst_to_84, disk.worst_stress());
    if (disk.worst_j(kNear) > kBroken) {
      course.breakdown = disk.compression();
      break;
    }
  }
  return course;
}

TEST(RadialCompression, StressAndBreakdown) {
  Page page("axisymmetric", "radial_compression_stress", "Radial compression: stress against volume (figure 7)");
  page.problem(std::string(kProblem) + " It goes on to 17 % of the radius, three cells and a half.")
      .exact("sigma_rr = (J-1)/J [K (J+1)/2 + G/(3 J^(2/3))], sigma_zz with -2 G in place of G",
             "Nairn & Guilkey (2015) (66), (67)")
      .scene("radial_compression")
      .meaning(
          "Breakdown is where J is off by a quarter within 16 mm of the axis, or a particle is lost. The paper "
          "reports 88 % for uGIMP and about 93 % for CPDI. Moved as there, uGIMP loses a particle through the axis "
          "at 79 % here; nothing else breaks before 97 %, where three cells and a half are left, though FLIP's noise "
          "grows: with uGIMP and FLIP the error is 5 % of sigma_rr already at 84 %.");
  Panel& panel = page.figure().panel("Mean stress", "J [%]", "stress [MPa]");
  Numbers j, rr, zz;
  for (double v = 100.0; v > 2.95; v -= 1.0) {
    j.push_back(v);
    rr.push_back(1e-6 * exact_rr(0.01 * v));
    zz.push_back(1e-6 * exact_zz(0.01 * v));
  }
  panel.exact("exact, rr", j, rr).exact("exact, zz", j, zz);
  const auto add = [&](const Method& method) {
    const Course course = follow(method);
    panel.line(method.label + ", rr", course.j, course.rr).line(method.label + ", zz", course.j, course.zz);
    page.report(method.label + ": breakdown at a compression of (100: none to 97 %)", course.breakdown, "%");
    return course;
  };
  const Course cpdi = add(method("CPDI, APIC", "cpdi", "apic", {}));
  const Course ugimp = add(method("uGIMP, APIC", "ugimp", "apic", {}));
  const Course cpdi_flip = add(method("CPDI, FLIP", "cpdi", "flip", {}));
  const Course ugimp_flip = add(method("uGIMP, FLIP", "ugimp", "flip", {}));
  const Course paper = add(method("CPDI, FLIP, mean", "cpdi", "flip", {"motion=mean"}));
  add(method("uGIMP, FLIP, mean", "ugimp", "flip", {"motion=mean"}));
  page.below("CPDI, APIC: largest error of a mean stress over sigma_rr, to 84 %", 100.0 * cpdi.worst_to_84, 2.0, "%");
  page.below("CPDI, FLIP: the same", 100.0 * cpdi_flip.worst_to_84, 2.0, "%");
  page.below("uGIMP, APIC: the same", 100.0 * ugimp.worst_to_84, 2.0, "%");
  page.report("uGIMP, FLIP: the same", 100.0 * ugimp_flip.worst_to_84, "%");
  page.above("CPDI, APIC: breakdown", cpdi.breakdown, 93.0, "%");
  page.beside("CPDI, FLIP, mean: breakdown", paper.breakdown, 93.0, "%");
  page.beside("uGIMP, APIC: breakdown", ugimp.breakdown, 88.0, "%");
}

}  // namespace radial_compression_test
}  // namespace verification
