// J about an axis, from the exact field of a penny-shaped crack under tension: the two forms and the size of their area
// terms.
//
// The field is that of pressure in the crack, from one harmonic function f (Green and Zerna), with a uniform tension
// added: 2 G u_r = (1 - 2 nu) phi_r + z f_r, 2 G u_z = -2 (1 - nu) f + z f_z, f = phi_z, for z > 0, and its mirror
// image below. With s = z - i a, R = sqrt(r^2 + s^2), L = ln(R + s), X = s L - R:
//   f = -2 p / pi (Im X + a Re L),  which is 0 at z = 0 outside the crack and -2 p / pi sqrt(a^2 - r^2) inside.
#include <gtest/gtest.h>

#include "crack_exact_fields.hpp"
#include "mpm/crack/j_integral.hpp"

namespace mpm::test {
namespace crack_penny_test {

constexpr double kYoungs = 2.5, kPoisson = 0.33, kTension = 0.01, kRadius = 1.0;
constexpr double kShear = 0.5 * kYoungs / (1.0 + kPoisson);
/// 4 (1 - nu^2) sigma^2 a / (pi E), problem 7.8 of the crack reference.
const double kExact = 4.0 * (1.0 - kPoisson * kPoisson) * kTension * kTension * kRadius / (kPi * kYoungs);

void add_stress(ContourValues& v) {
  const double trace = v.gradient[0][0] + v.gradient[1][1] + v.hoop_gradient;
  const double lambda = 2.0 * kShear * kPoisson / (1.0 - 2.0 * kPoisson);
  v.xx = lambda * trace + 2.0 * kShear * v.gradient[0][0];
  v.zz = lambda * trace + 2.0 * kShear * v.gradient[1][1];
  v.hoop = lambda * trace + 2.0 * kShear * v.hoop_gradient;
  v.xz = kShear * (v.gradient[0][1] + v.gradient[1][0]);
  v.energy = 0.5 * (v.xx * v.gradient[0][0] + v.zz * v.gradient[1][1] + v.hoop * v.hoop_gradient +
                    v.xz * (v.gradient[0][1] + v.gradient[1][0]));
}

/// At radius r and height z, the latter of either sign; `above` decides at z = 0.
ContourValues penny(double r, double height, bool above, double tension) {
  using Complex = std::complex<double>;
  const double a = kRadius, nu = kPoisson, z = std::abs(height), factor = -2.0 * tension / kPi;
  const Complex s(z, -a);
  Complex root = std::sqrt(r * r + s * s);
  if (z == 0.0 && r < a) root = Complex(0.0, -std::sqrt(a * a - r * r));  // the limit from z > 0
  const Complex log = std::log(root + s), sum = root + s;
  const auto value = [&](const Complex& of, const Complex& by_a) { return factor * (of.imag() + a * by_a.real()); };
  // phi from P with P_z = X: P = ((s^2 - r^2 / 2) L - 3 / 2 s R) / 2
  const double phi_r =
      value(0.5 * (-r * log + (s * s - 0.5 * r * r) * r / (root * sum) - 1.5 * s * r / root), -r / sum);
  const double f_z = value(log, 1.0 / root), f_r = value(-r / sum, r / (root * sum));
  const double f_zz = value(1.0 / root, -s / (root * root * root));
  const double f_rz = value(r / (root * sum), -r / (root * root * root));
  const double f_rr = -f_zz - f_r / r, phi_rr = -f_z - phi_r / r;
  const double mirror = height > 0.0 || (height == 0.0 && above) ? 1.0 : -1.0, compliance = 0.5 / kShear;
  ContourValues v;
  v.gradient[0][0] = compliance * ((1.0 - 2.0 * nu) * phi_rr + z * f_rr) - nu * tension / kYoungs;
  v.gradient[0][1] = mirror * compliance * (2.0 * (1.0 - nu) * f_r + z * f_rz);
  v.gradient[1][0] = mirror * compliance * (-2.0 * (1.0 - nu) * f_r + z * f_rz);
  v.gradient[1][1] = compliance * ((2.0 * nu - 1.0) * f_z + z * f_zz) + tension / kYoungs;
  v.hoop_gradient = compliance * ((1.0 - 2.0 * nu) * phi_r + z * f_r) / r - nu * tension / kYoungs;
  add_stress(v);
  return v;
}

TEST(PennyCrack, FieldIsExact) {
  const double t = kTension;
  // Faces without traction, beyond the crack Sneddon's stress, far away the tension.
  for (const double r : {0.05, 0.3, 0.7, 0.99}) {
    const ContourValues v = penny(r, 0.0, true, t);
    EXPECT_NEAR(v.zz, 0.0, 1e-12 * t) << r;
    EXPECT_NEAR(v.xz, 0.0, 1e-12 * t) << r;
  }
  for (const double r : {1.01, 1.5, 4.0}) {
    const double root = std::sqrt(r * r - 1.0);
    EXPECT_NEAR(penny(r, 0.0, true, t).zz, t + 2.0 * t / kPi * (1.0 / root - std::asin(1.0 / r)), 1e-12 * t) << r;
  }
  EXPECT_NEAR(penny(300.0, 400.0, true, t).zz, t, 1e-6 * t);
  // Balance, by central differences of 1e-4: their error is about 1e-7.
  for (const Vec2& place : {Vec2(0.6, 0.2), Vec2(1.2, -0.3), Vec2(0.9, -0.15)}) {
    const double r = place[0], z = place[1], h = 1e-4;
    const auto at = [&](double dr, double dz) { return penny(r + dr, z + dz, true, t); };
    const ContourValues v = at(0.0, 0.0);
    const double along_r = (at(h, 0).xx - at(-h, 0).xx + at(0, h).xz - at(0, -h).xz) / (2 * h) + (v.xx - v.hoop) / r;
    const double along_z = (at(h, 0).xz - at(-h, 0).xz + at(0, h).zz - at(0, -h).zz) / (2 * h) + v.xz / r;
    EXPECT_NEAR(along_r, 0.0, 1e-5 * t);
    EXPECT_NEAR(along_z, 0.0, 1e-5 * t);
    // and one displacement behind all: d(r u_r / r) / dr = u_r,r, and the mixed derivatives.
    const double of_hoop = ((r + h) * at(h, 0).hoop_gradient - (r - h) * at(-h, 0).hoop_gradient) / (2 * h);
    EXPECT_NEAR(of_hoop, v.gradient[0][0], 1e-5 * t);
    for (int i = 0; i < 2; ++i) {
      const double by_z = (at(0, h).gradient[i][0] - at(0, -h).gradient[i][0]) / (2 * h);
      const double by_r = (at(h, 0).gradient[i][1] - at(-h, 0).gradient[i][1]) / (2 * h);
      EXPECT_NEAR(by_z, by_r, 1e-5 * t);
    }
  }
}

/// A contour of `size` cells, its half width `half`, around a node that lies off the tip by `off` cells.
struct PennyContour {
  GridLines lines;
  ContourPath path;
  std::vector<ContourPiece> pieces;
  double tension;

  PennyContour(double half, int size, const Vec2& off, double stress = kTension) : tension(stress) {
    const double cell = half / size;
    lines.cell = Vec2::Constant(cell);
    lines.nodes = {2 * size + 1, 2 * size + 1};
    lines.origin = Vec2(kRadius, 0.0) - cell * (off + Vec2::Constant(size));
    const std::vector<Vec2> line{{0.0, 0.0}, {kRadius, 0.0}};
    make_path(lines, line.data(), 2, line[1], size, path);
    const ExactContourSource source(lines, [this](const Vec2& place, ContourField side) {
      const bool own = side == ContourField::own;
      if (own || place[0] > kRadius) return penny(place[0], place[1], true, tension);
      // Field across the crack, gone on over it: the mirror image of the field there, to second order.
      const ContourValues near = penny(place[0], place[1] < 0.0 ? 0.0 : -0.0, place[1] < 0.0, tension);
      const double z = std::abs(place[1]);
      const ContourValues there = penny(place[0], place[1] < 0.0 ? z : -z, true, tension);
      return ContourValues::between(there, near, 2.0);
    });
    if (path.status == ContourStatus::complete) path.status = gather_contour(lines, path, source, pieces);
  }

  /// A fine rule over triangles from the tip to the sides of the contour, where the crack is one border of two of them.
  /// Distances from the tip go by the square, which takes the singularity away.
  std::vector<AreaSample> fine_rule() const {
    std::vector<AreaSample> samples;
    const Vec2 tip(kRadius, 0.0);
    constexpr int kParts = 60;
    for (const ContourPiece& piece : pieces) {
      const Vec2 middle = 0.5 * (piece.from + piece.to), p = piece.from - tip, q = piece.to - tip;
      const double doubled = p[0] * q[1] - p[1] * q[0];
      for (int k = 0; k < kParts; ++k) {
        const double part = (k + 0.5) / kParts, s = part * part;
        AreaSample sample;
        sample.place = tip + s * (middle - tip);
        sample.area = doubled * s * 2.0 * part / kParts;  // doubled s ds
        sample.values = penny(sample.place[0], sample.place[1], true, tension);
        samples.push_back(sample);
      }
    }
    return samples;
  }
  Vec2 area(const JForm& form, const std::vector<AreaSample>& samples) const {
    return area_term(form, samples, path.area(lines));
  }
};

const JForm kBroberg{JForm::Kind::broberg, kRadius, false};
const JForm kBergkvistHuong{JForm::Kind::bergkvist_huong, kRadius, false};

// The crack reference, 4.6, has the size of the area terms for these half widths [% of J], and both sums exact. Here
// 100 cells: the error of the nodal rule is 0.01 %, that of the area 1e-4 of it.
TEST(PennyCrack, BothFormsGiveJOnAnyContour) {
  struct Row {
    double half, broberg, bergkvist_huong;
  };
  for (const Row& row : {Row{0.05, 2.2, 2.9}, Row{0.1, 4.4, 6.2}, Row{0.2, 8.9, 14.4}, Row{0.4, 18.8, 36.3}}) {
    const PennyContour contour(row.half, 100, {0.0, 0.45});
    ASSERT_EQ(contour.path.status, ContourStatus::complete);
    const std::vector<AreaSample> samples = contour.fine_rule();
    for (const JForm& form : {kBroberg, kBergkvistHuong}) {
      const Vec2 along = contour_term(form, contour.pieces), area = contour.area(form, samples);
      const bool first = form.kind == JForm::Kind::broberg;
      EXPECT_NEAR(100.0 * std::abs(area[0]) / kExact, first ? row.broberg : row.bergkvist_huong, 0.15) << row.half;
      EXPECT_NEAR((along + area)[0] / kExact, 1.0, 1e-3) << row.half << " form " << int(form.kind);
    }
  }
}

// The form of Broberg in a square around the tip, joined along the square's edge to that of Bergkvist and Huong. Cells
// and errors are those above.
TEST(PennyCrack, FormsJoinAroundTheTip) {
  const PennyContour contour(0.4, 100, {0.0, 0.45}), square(0.2, 50, {0.0, 0.45});
  JForm form = kBergkvistHuong;
  form.low = square.lines.place(square.path.low);
  form.high = square.lines.place(square.path.high);
  const Vec2 sum = contour_term(form, contour.pieces) + contour.area(form, contour.fine_rule());
  const Vec2 joining = joining_term(form, square.pieces);
  EXPECT_GT(std::abs(joining[0]), 0.05 * kExact);
  EXPECT_NEAR((sum + joining)[0], kExact, 1e-3 * kExact);
  EXPECT_NEAR((sum + joining)[1], 0.0, 1e-3 * kExact);
}

// J_z is 0 by symmetry, also on a contour that lies aside of the crack's plane, where Broberg's form needs the term
// that NairnMPM leaves out. The energy on the two faces is the same, so that they add nothing.
TEST(PennyCrack, HasNoJAcrossItsPlane) {
  const PennyContour fine(0.2, 120, {0.0, 0.45});
  // The rectangle lies aside: around a node far below the tip.
  GridLines lines = fine.lines;
  lines.origin[1] -= 0.12;
  const std::vector<Vec2> line{{0.0, 0.0}, {kRadius, 0.0}};
  ContourPath path;
  make_path(lines, line.data(), 2, Vec2(kRadius, -0.12), 120, path);
  ASSERT_EQ(path.status, ContourStatus::complete);
  PennyContour aside = fine;
  aside.lines = lines;
  aside.path = path;
  const ExactContourSource source(
      lines, [](const Vec2& place, ContourField) { return penny(place[0], place[1], true, kTension); });
  ASSERT_EQ(gather_contour(lines, path, source, aside.pieces), ContourStatus::complete);
  const std::vector<AreaSample> samples = aside.fine_rule();
  for (const JForm& form : {kBroberg, kBergkvistHuong}) {
    const Vec2 along = contour_term(form, aside.pieces), area = aside.area(form, samples);
    EXPECT_NEAR((along + area)[1], 0.0, 3e-3 * kExact);
    EXPECT_NEAR((along + area)[0], kExact, 3e-3 * kExact);
    if (form.kind == JForm::Kind::broberg) {
      EXPECT_GT(std::abs(area[1]), 0.01 * kExact);
    }
  }
}

}  // namespace crack_penny_test
}  // namespace mpm::test
