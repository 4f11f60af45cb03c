// Uniform radial compression of a disk, Nairn & Guilkey (2015) 4.1: figure 5 (what fitting domains to the axis does),
// figure 6 (planar functions in place of those with the weight r), figure 7 (stresses against volume) and the
// compressions at which methods break down.
//
// Exact: F = diag(l, 1, l), J = l^2, stresses (66), (67), and every particle at l times its first radius. The rim closes
// like an iris, so the disk is asked for an even motion; what is uneven is the method's. Two rules of motion are shown:
// `mean` is the paper's, `point` is the remedy of method reference 3.5.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace {

using Overrides = std::vector<std::string>;

constexpr int kThreads = 1;        // tests run side by side
constexpr double kRadius = 0.05;   // [m]
constexpr double kSpeed = 20.0;    // of the rim [m/s]
constexpr double kBulk = 2300e6 / (3.0 * (1.0 - 2.0 * 0.33)), kShear = 2300e6 / (2.0 * 1.33);  // [Pa]
constexpr double kNear = 0.016;    // what figures 5 and 6 show of the radius [m]

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

/// The disk at one moment; what depends on the radius is the mean over the height, by first radius.
struct Disk {
  double stretch = 1.0;  ///< exact, of the radius
  Numbers start, j, radius;  ///< first radius [m], J, present radius over the exact one
  double mean_j = 1.0, mean_rr = 0.0, mean_zz = 0.0;  ///< of all particles; stresses [Pa]
  double exact_j() const { return stretch * stretch; }
  /// Largest |J / exact - 1| over all radii.
  double worst_j() const {
    double worst = 0.0;
    for (const double one : j) worst = std::max(worst, std::abs(one / exact_j() - 1.0));
    return worst;
  }
  double worst_radius() const {
    double worst = 0.0;
    for (const double one : radius) worst = std::max(worst, std::abs(one - 1.0));
    return worst;
  }
};

class Compression {
 public:
  explicit Compression(const Overrides& method) : simulation_(start("radial_compression", method, kThreads)) {
    first_ = field(simulation_, "x");
  }
  /// @throws mpm::PhysicsError when the method breaks down
  void to(double stretch) { run_until(simulation_, (1.0 - stretch) * kRadius / kSpeed); }
  void advance() { simulation_.advance(); }
  Disk disk() const {
    Disk disk;
    disk.stretch = 1.0 - seconds(simulation_) * kSpeed / kRadius;
    const Numbers x = field(simulation_, "x"), j = field(simulation_, "j");
    disk.mean_j = mean_of(j);
    disk.mean_rr = mean_of(field(simulation_, "sxx"));
    disk.mean_zz = mean_of(field(simulation_, "szz"));
    // Particles are numbered row by row, and rows along r.
    const auto columns = static_cast<std::size_t>(std::lround(kRadius / 1.25e-3));
    for (std::size_t c = 0; c < columns; ++c) {
      double sum_j = 0.0, sum_r = 0.0;
      for (std::size_t p = c; p < x.size(); p += columns) sum_j += j[p], sum_r += x[p];
      const auto rows = static_cast<double>(x.size() / columns);
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

Method method(const std::string& label, const std::string& shape, const Overrides& axis = {}) {
  Method one{label, {"method.shape=" + shape}};
  for (const std::string& rule : axis) one.overrides.push_back("method.axis." + rule);
  return one;
}

/// Draws J and radius near the axis, and tells the worst of both over the whole disk.
Disk show(Page& page, Panel& of_j, Panel& of_radius, const Method& method) {
  Compression run(method.overrides);
  Disk disk;
  try {
    run.to(0.4);
    disk = run.disk();
  } catch (const mpm::PhysicsError&) {
    disk = run.disk();
    page.report(method.label + ": breaks down at a compression of", 100.0 * (1.0 - disk.exact_j()), "%");
    return disk;
  }
  Numbers r, j, ratio;
  for (std::size_t c = 0; c < disk.start.size() && disk.start[c] < kNear; ++c) {
    r.push_back(1e3 * disk.start[c]);
    j.push_back(100.0 * disk.j[c]);
    ratio.push_back(disk.radius[c]);
  }
  of_j.line(method.label, r, j);
  of_radius.line(method.label, r, ratio);
  page.report(method.label + ": largest error of J", 100.0 * disk.worst_j(), "%");
  page.report(method.label + ": largest error of a radius", 100.0 * disk.worst_radius(), "%");
  return disk;
}

const Numbers kSpan = {0.0, 1e3 * kNear};

TEST(Probe, One) {
  Overrides overrides;
  std::string text = std::getenv("PROBE") ? std::getenv("PROBE") : "";
  for (std::size_t at = 0; at < text.size();) { auto end = std::min(text.find(';', at), text.size()); overrides.push_back(text.substr(at, end - at)); at = end + 1; }
  Compression run(overrides);
  for (double l : {0.99, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.35,0.3}) {
    try { run.to(l); } catch (const std::exception& e) { fmt::print("{}\n", std::string(e.what()).substr(0, 90)); break; }
    const Disk d = run.disk();
    fmt::print("l {:.2f} J {:.4f} mean {:.4f} worst {:.4f} radius {:.4f} | J {:.4f} {:.4f} {:.4f} .. {:.4f} {:.4f} | r {:.3f} {:.3f} .. {:.3f} {:.3f}\n", l, d.exact_j(), d.mean_j, d.worst_j(), d.worst_radius(), d.j[0], d.j[1], d.j[2], d.j[d.j.size()-2], d.j.back(), d.radius[0], d.radius[1], d.radius[d.j.size()-2], d.radius.back());
  }
}

}  // namespace
}  // namespace verification
