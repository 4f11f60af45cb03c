// Exact plane fields around the tip of a crack for tests, as nodal values of a grid. Elastic fields by the complex
// potentials of Kolosov and Muskhelishvili: 2 G (u + i v) = kappa phi - z conj(phi') - conj(psi).
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "mpm/crack/contour_values.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::test {

using CrackField = std::function<ContourValues(const Vec2& place, ContourField side)>;

/// A field at all nodes of a grid.
class ExactContourSource final : public ContourSource {
 public:
  ExactContourSource(GridLines lines, CrackField field) : lines_(lines), field_(std::move(field)) {}
  bool find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const override {
    values = field_(lines_.place(node), field);
    values.centre = lines_.place(node);
    return true;
  }

 private:
  GridLines lines_;
  CrackField field_;
};

/// Near-tip field of a semi-infinite straight crack, whose first terms after the singular one are uniform stresses:
/// `along` (the T-stress) leaves the faces free of traction, `across` and `shear` do not.
struct WilliamsField {
  double shear_modulus = 1.0, kappa = 1.8;
  double k_i = 1.0, k_ii = 0.0;
  double along = 0.0, across = 0.0, shear = 0.0;
  Vec2 tip{0.0, 0.0};
  double angle = 0.0;  ///< angle of the direction of growth to the x axis

  double modulus() const { return 8.0 * shear_modulus / (kappa + 1.0); }
  Vec2 direction() const { return {std::cos(angle), std::sin(angle)}; }

  /// At `radius` and `theta` from the tip; the faces are at -pi and pi, and values go on beyond them.
  ContourValues at(double radius, double theta) const {
    using Complex = std::complex<double>;
    const Complex i(0.0, 1.0), k(k_i, -k_ii), z = std::polar(radius, theta);
    const Complex root = std::polar(1.0 / std::sqrt(2.0 * kPi * radius), -0.5 * theta);
    // sigma_xx + sigma_yy = 4 Re phi', sigma_yy - sigma_xx + 2 i sigma_xy = 2 (conj(z) phi'' + psi')
    const Complex phi1 = 0.5 * k * root + 0.25 * (along + across), phi2 = -0.25 * k * root / z;
    const Complex psi1 = 0.5 * std::conj(k) * root - 0.5 * k * root - z * phi2 + 0.5 * (across - along) + i * shear;
    const Complex dx = (kappa * phi1 - std::conj(phi1) - z * std::conj(phi2) - std::conj(psi1)) / (2.0 * shear_modulus);
    const Complex dy =
        i * (kappa * phi1 - std::conj(phi1) + z * std::conj(phi2) + std::conj(psi1)) / (2.0 * shear_modulus);
    const Complex sum = 4.0 * phi1.real(), difference = 2.0 * (std::conj(z) * phi2 + psi1);
    const double xx = 0.5 * (sum.real() - difference.real()), yy = 0.5 * (sum.real() + difference.real());
    const double xy = 0.5 * difference.imag();
    // into the grid's axes
    const double c = std::cos(angle), s = std::sin(angle);
    const double turn[2][2] = {{c, -s}, {s, c}}, g[2][2] = {{dx.real(), dy.real()}, {dx.imag(), dy.imag()}};
    ContourValues values;
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        for (int m = 0; m < 2; ++m) {
          for (int n = 0; n < 2; ++n) values.gradient[a][b] += turn[a][m] * g[m][n] * turn[b][n];
        }
      }
    }
    values.xx = c * c * xx + s * s * yy - 2.0 * c * s * xy;
    values.zz = s * s * xx + c * c * yy + 2.0 * c * s * xy;
    values.xz = c * s * (xx - yy) + (c * c - s * s) * xy;
    values.energy = 0.5 * (xx * g[0][0] + yy * g[1][1] + xy * (g[0][1] + g[1][0]));
    return values;
  }

  double theta_of(const Vec2& place) const {
    const Vec2 arm = place - tip, d = direction();
    return std::atan2(d[0] * arm[1] - d[1] * arm[0], d.dot(arm));
  }
  ContourValues operator()(const Vec2& place, ContourField side) const {
    const double theta = theta_of(place);
    const double beyond = side == ContourField::own ? 0.0 : theta > 0.0 ? -2.0 * kPi : 2.0 * kPi;
    return at((place - tip).norm(), theta + beyond);
  }
  /// Opening (along, across) behind the tip [m], of the singular term.
  Vec2 opening(double radius) const {
    return Vec2(k_ii, k_i) * ((kappa + 1.0) * std::sqrt(0.5 * radius / kPi) / shear_modulus);
  }
};

/// Two equal cracks in line, |x - middle| from b to a on y = middle, in an infinite body under `stress` in both
/// directions (Westergaard): 2 phi' = stress (z^2 - c^2) / sqrt((z^2 - a^2) (z^2 - b^2)), psi' = -z phi'', with c such
/// that neither crack opens in all: c^2 / a^2 = E / K of the modulus sqrt(1 - b^2 / a^2).
struct CollinearField {
  double shear_modulus = 1.0, kappa = 1.8, stress = 1.0;
  double outer = 20.0, inner = 4.0;  ///< a, b
  Vec2 middle{0.0, 0.0};

  double modulus() const { return 8.0 * shear_modulus / (kappa + 1.0); }
  double zero() const {  ///< c^2
    const double k = std::sqrt(1.0 - inner * inner / (outer * outer));
    return outer * outer * std::comp_ellint_2(k) / std::comp_ellint_1(k);
  }
  double width() const { return std::sqrt(outer * outer - inner * inner); }
  double k_inner() const { return stress * std::sqrt(kPi / inner) * (zero() - inner * inner) / width(); }
  double k_outer() const { return stress * std::sqrt(kPi / outer) * (outer * outer - zero()) / width(); }

  ContourValues operator()(const Vec2& place, ContourField side) const {
    using Complex = std::complex<double>;
    const Complex i(0.0, 1.0), z(place[0] - middle[0], place[1] - middle[1]);
    // Each root's cut runs to the left; two of them cancel outside the cracks.
    Complex root = std::sqrt(z - outer) * std::sqrt(z - inner) * std::sqrt(z + inner) * std::sqrt(z + outer);
    if (side != ContourField::own) root = -root;  // continued across a crack
    const Complex over = z * z - zero(), square = root * root;
    const Complex phi1 = 0.5 * stress * over / root;
    const Complex phi2 =
        0.5 * stress * (2.0 * z / root - over * z * (2.0 * z * z - outer * outer - inner * inner) / (square * root));
    const Complex psi1 = -z * phi2;
    const Complex dx = (kappa * phi1 - std::conj(phi1) - z * std::conj(phi2) - std::conj(psi1)) / (2.0 * shear_modulus);
    const Complex dy =
        i * (kappa * phi1 - std::conj(phi1) + z * std::conj(phi2) + std::conj(psi1)) / (2.0 * shear_modulus);
    const Complex sum = 4.0 * phi1.real(), difference = 2.0 * (std::conj(z) * phi2 + psi1);
    ContourValues values;
    values.gradient[0][0] = dx.real(), values.gradient[0][1] = dy.real();
    values.gradient[1][0] = dx.imag(), values.gradient[1][1] = dy.imag();
    values.xx = 0.5 * (sum.real() - difference.real());
    values.zz = 0.5 * (sum.real() + difference.real());
    values.xz = 0.5 * difference.imag();
    values.energy = 0.5 * (values.xx * dx.real() + values.zz * dy.imag() + values.xz * (dy.real() + dx.imag()));
    return values;
  }
};

/// 64 x 64 cells of edge 1, a tip near node (32, 32) and the pieces of a contour around it.
struct WilliamsContour {
  GridLines lines{{0.0, 0.0}, {1.0, 1.0}, {65, 65}};
  ContourPath path;
  std::vector<ContourPiece> pieces;

  /// @param off of the tip from the node [cells].
  ContourStatus gather(WilliamsField& field, const Vec2& off, int size) {
    field.tip = Vec2(32.0, 32.0) + off;
    const std::array<Vec2, 2> line{field.tip - 100.0 * field.direction(), field.tip};
    make_path(lines, line.data(), 2, field.tip, size, path);
    if (path.status != ContourStatus::complete) return path.status;
    return gather_contour(lines, path, ExactContourSource(lines, field), pieces);
  }
};

}  // namespace mpm::test
