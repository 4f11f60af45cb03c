// Exact contact of a smooth rigid tool with an elastic layer or block that rests on a smooth rigid base: flat punch
// (Boussinesq's problem) and paraboloid (Hertz's problem), circular and in plane strain.
//
// A surface pressure of wave number k deflects the surface of a layer of height H by g(k) times the pressure,
//   g(k) = 2 K(kH) / (E* k),   K(u) = 2 sinh^2 u / (2 u + sinh 2u),   E* = E / (1 - nu^2)
// (Airy's stress function with no shear on both faces and no deflection of the lower one; K = 1 is the half space).
// Smooth rigid side walls are planes of symmetry: a block between them is one cell of a layer under a lattice of tools.
// It therefore has the same g, at the wave numbers of the lattice only, and the value H (1 + nu)(1 - 2 nu) /
// (E (1 - nu)) of the oedometer at k = 0, where the walls prevent expansion. In a round block of radius L with a smooth
// rigid wall, a pressure J0(kr) displaces the material along r as J1(kr), and shears it likewise. The conditions at the
// wall hold term by term at the zeros of J1(kL), and a pressure is a sum of these terms (Dini's series).
//
// The pressure is the combination of p_n = (1 - r^2/a^2)^(n - 1/2), n = 0 ... N-1, whose deflection equals the shape of
// the tool in the means weighted by each p_n. It is exact on a half space with N = 1 for a flat punch and N = 2 for a
// paraboloid; further terms account for the layer and the images, and decrease fast. In a block the pressure under a
// circular tool is assumed to be round, though four walls make it very slightly square. Source: Johnson, Contact
// Mechanics (1985), sections 3.8, 4.2, 5.8; Lebedev and Ufliand (1958) for the layer.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/math/constants.hpp"

namespace verification {

enum class ToolShape { circular, strip };  ///< round about z, or endless along y in plane strain

/// The elastic block, on whose upper face one tool presses at the middle. Lengths are in m; the block of a strip has no
/// width.
struct ElasticBlock {
  double young = 1.0;  ///< [Pa]
  double poisson = 0.3;
  double height = std::numeric_limits<double>::infinity();  ///< infinite: half space
  double half_length =
      std::numeric_limits<double>::infinity();  ///< from the tool's middle to the walls in x and (circular) y
  bool round = false;  ///< circular tools: a cylinder of radius half_length in place of a square block

  double plane_modulus() const { return young / (1.0 - poisson * poisson); }  ///< E* [Pa]
};

/// A tool pressed onto the block.
struct PressedTool {
  double force;                  ///< [N], or [N/m] for a strip
  double approach;               ///< depth of the tool's lowest point below the undisturbed surface [m]
  double radius;                 ///< radius of the contact, or half its width [m]
  Eigen::VectorXd coefficients;  ///< coefficients of p_n in the pressure [Pa]

  /// Pressure at a distance r < radius from the middle [Pa].
  double pressure(double r) const {
    const double q = 1.0 - r * r / (radius * radius);
    double sum = 0.0;
    for (int n = 0; n < coefficients.size(); ++n) sum += coefficients[n] * std::pow(q, n - 0.5);
    return sum;
  }
};

class LayerContact {
 public:
  /// `radius`: radius of the contact, or half the width of a strip [m]; `terms`: N. Four terms give 1e-4 up to
  /// radius = height.
  LayerContact(const ElasticBlock& block, ToolShape tool, double radius, int terms = 4)
      : block_(block), tool_(tool), a_(radius), terms_(terms) {
    build();
  }

  /// A flat punch of this radius, pressed in by `approach` [m].
  PressedTool flat_punch(double approach) const { return pressed(approach * solve(area_), approach); }

  /// A paraboloid z = r^2 / (2 R) in contact up to this radius. There the pressure falls to zero as a square root,
  /// which determines the approach.
  PressedTool paraboloid(double tool_radius) const {
    const Eigen::VectorXd by_depth = solve(area_), by_shape = solve(second_ / (2.0 * tool_radius));
    const double approach = by_shape[0] / by_depth[0];
    return pressed(approach * by_depth - by_shape, approach);
  }

 private:
  static constexpr double kPi = mpm::kPi;
  static constexpr double kLast = 150.0;  ///< largest k a that is summed; the remainder is estimated by its mean

  PressedTool pressed(const Eigen::VectorXd& coefficients, double approach) const {
    return {coefficients.dot(area_), approach, a_, coefficients};
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return compliance_.ldlt().solve(right); }

  double shape_factor(double k) const {
    const double u = k * block_.height;
    if (u > 20.0) return 1.0;
    const double s = std::sinh(u);
    return 2.0 * s * s / (2.0 * u + std::sinh(2.0 * u));
  }
  /// g(k) [m/Pa], k > 0.
  double deflection(double k) const { return 2.0 * shape_factor(k) / (block_.plane_modulus() * k); }

  /// Fourier transforms of all p_n at wave number k, over the plane (circular) or along x (strip).
  Eigen::VectorXd transforms(double k) const {
    Eigen::VectorXd result(terms_);
    const double x = k * a_;
    // circular: 2 pi a^2 (2n - 1)!! j_n(x) / x^n (Sonine); strip: a sqrt(pi) Gamma(n + 1/2) (2/x)^n J_n(x) (Poisson)
    double factor = tool_ == ToolShape::circular ? 2.0 * kPi * a_ * a_ : kPi * a_;
    for (int n = 0; n < terms_; ++n) {
      result[n] = factor * (tool_ == ToolShape::circular ? std::sph_bessel(n, x) : std::cyl_bessel_j(n, x));
      factor *= (tool_ == ToolShape::circular ? 2.0 * n + 1.0 : 2.0 * (n + 0.5)) / x;
    }
    return result;
  }

  /// Integrals of p_n times r^(2m) over the contact.
  Eigen::VectorXd moments(int m) const {
    Eigen::VectorXd result(terms_);
    for (int n = 0; n < terms_; ++n) {
      const double q = n + 0.5, s = tool_ == ToolShape::circular ? m + 1.0 : m + 0.5;  // Beta function of s and q
      const double beta = std::tgamma(s) * std::tgamma(q) / std::tgamma(s + q);
      result[n] =
          tool_ == ToolShape::circular ? kPi * std::pow(a_, 2.0 * m + 2.0) * beta : std::pow(a_, 2.0 * m + 1.0) * beta;
    }
    return result;
  }

  void add(double weight, double k) {
    const Eigen::VectorXd f = transforms(k);
    compliance_ += weight * deflection(k) * f * f.transpose();
  }

  void build() {
    area_ = moments(0);
    second_ = moments(1);
    compliance_ = Eigen::MatrixXd::Zero(terms_, terms_);
    const double last = kLast / a_;
    if (std::isinf(block_.half_length)) {
      integrate(last);
    } else {
      sum(last);
    }
    // Beyond, only p_0 with itself matters; its transform squared is 1/(2 x^2) (circular), 1/(pi x) (strip) in the
    // mean.
    const double e = block_.plane_modulus();
    compliance_(0, 0) +=
        tool_ == ToolShape::circular ? 2.0 * kPi * a_ * a_ * a_ / (e * kLast) : 2.0 * a_ * a_ / (e * kLast);
  }

  /// Layer without walls: integrates over all wave numbers by Simpson's rule.
  void integrate(double last) {
    const int intervals = 20000;
    const double step = last / intervals;
    for (int i = 0; i <= intervals; ++i) {
      const double k = std::max(i * step, 1e-6 * step);
      const double simpson = step / 3.0 * (i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
      add(simpson * (tool_ == ToolShape::circular ? k / (2.0 * kPi) : 1.0 / kPi), k);
    }
  }

  /// Block: sums over the lattice of wave numbers pi m / L.
  void sum(double last) {
    const double spacing = kPi / block_.half_length, length = 2.0 * block_.half_length;
    const int most = static_cast<int>(last / spacing);
    const double nu = block_.poisson;
    const double oedometer =
        block_.height * (1.0 + nu) * (1.0 - 2.0 * nu) / (block_.young * (1.0 - nu));  // g(0) [m/Pa]
    const double area = tool_ == ToolShape::circular ? length * length : length;
    if (block_.round) {
      sum_round(oedometer, most);
      return;
    }
    compliance_ += oedometer / area * area_ * area_.transpose();
    if (tool_ == ToolShape::strip) {
      for (int m = 1; m <= most; ++m) add(2.0 / area, m * spacing);
      return;
    }
    for (int m = 1; m <= most; ++m) {
      for (int n = 0; n * n + m * m <= most * most; ++n) {  // m > 0, n >= 0: a quarter of the lattice
        add(4.0 / area, spacing * std::hypot(m, n));
      }
    }
  }

  /// Round block: sums over the first `most` zeros of J1, which Newton's method finds from McMahon's first terms.
  void sum_round(double oedometer, int most) {
    const double radius = block_.half_length, area = kPi * radius * radius;
    compliance_ += oedometer / area * area_ * area_.transpose();
    for (int m = 1; m <= most; ++m) {
      const double b = kPi * (m + 0.25);
      double zero = b - 3.0 / (8.0 * b);
      for (int i = 0; i < 3; ++i) {
        const double j1 = std::cyl_bessel_j(1, zero);
        zero -= j1 / (std::cyl_bessel_j(0, zero) - j1 / zero);
      }
      const double j0 = std::cyl_bessel_j(0, zero);
      add(1.0 / (area * j0 * j0), zero / radius);
    }
  }

  ElasticBlock block_;
  ToolShape tool_;
  double a_;
  int terms_;
  Eigen::MatrixXd compliance_;  ///< integral of p_i times the deflection by p_j [m^3/Pa], strip [m^2/Pa]
  Eigen::VectorXd area_;        ///< integrals of p_n [m^2], strip [m]
  Eigen::VectorXd second_;      ///< integrals of p_n r^2
};

}  // namespace verification
