#include "mpm/crack/interaction_integral.hpp"

#include <cmath>

#include "mpm/crack/crack_tip_field.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

/// sigma_ij e'_ij n_1 - sigma_ij n_j u'_i,1 - sigma'_ij n_j u_i,1 in the tip's frame.
double shared_flux(const Eigen::Matrix2d& stress, const Eigen::Matrix2d& gradient, const TipFieldValue& mode,
                   const Vec2& normal) {
  return stress.cwiseProduct(mode.gradient).sum() * normal[0] - (stress * normal).dot(mode.gradient.col(0)) -
         (mode.stress * normal).dot(gradient.col(0));
}

}  // namespace

StressIntensity interaction_integral(const ElasticConstants& constants, const Vec2& tip, const Vec2& direction,
                                     const std::vector<ContourPiece>& pieces) {
  Eigen::Matrix2d frame;  // rows: the tip's axes
  frame << direction[0], direction[1], -direction[1], direction[0];
  const CrackTipField one({1.0, 0.0}, 0.0, constants), two({0.0, 1.0}, 0.0, constants);
  StressIntensity sum;
  const double rotation = mean_rotation(pieces);  // adds nothing but an error of quadrature (j_integral.hpp)
  double angle = -kPi;  // followed around the tip from the face on the right of `direction` to that on the left
  const auto add = [&](const Vec2& place, const ContourValues& values, const Vec2& n, double length) {
    const Vec2 arm = frame * (place - tip), normal = frame * n;
    const double principal = std::atan2(arm[1], arm[0]);
    const double turns = std::round((angle - principal) / (2.0 * kPi));
    angle = principal + 2.0 * kPi * turns;
    // The near-tip field changes its sign with a whole turn: it goes on beyond the faces, which may lie aside a little.
    const double part = 0.5 * length * (turns == 0.0 ? 1.0 : -1.0);
    Eigen::Matrix2d stress, gradient;
    stress << values.xx, values.xz, values.xz, values.zz;
    gradient << values.gradient[0][0], values.gradient[0][1] - rotation, values.gradient[1][0] + rotation,
        values.gradient[1][1];
    stress = frame * stress * frame.transpose();
    gradient = frame * gradient * frame.transpose();
    sum.one += part * shared_flux(stress, gradient, one.at(arm), normal);
    sum.two += part * shared_flux(stress, gradient, two.at(arm), normal);
  };
  for (const ContourPiece& piece : pieces) {
    add(piece.from, piece.first, piece.normal, piece.length());
    add(piece.to, piece.last, piece.normal, piece.length());
  }
  const double half = 0.5 * constants.plane_modulus();
  return {half * sum.one, half * sum.two};
}

StressIntensity eigenstrain_term(const ElasticConstants& constants, const Vec2& tip, const Vec2& direction,
                                 const std::vector<AreaSample>& samples, double area) {
  Eigen::Matrix2d frame;
  frame << direction[0], direction[1], -direction[1], direction[0];
  const CrackTipField one({1.0, 0.0}, 0.0, constants), two({0.0, 1.0}, 0.0, constants);
  StressIntensity sum;
  double covered = 0.0;
  for (const AreaSample& sample : samples) {
    const Vec2 arm = frame * (sample.place - tip);
    const double slope = sample.area * sample.eigenstrain_slope.dot(direction);
    const auto trace = [&](const TipFieldValue& mode) { return mode.stress.trace() + mode.stress_out; };
    sum.one += slope * trace(one.at(arm));
    sum.two += slope * trace(two.at(arm));
    covered += sample.area;
  }
  if (covered <= 0.0) return {};
  const double scale = 0.5 * constants.plane_modulus() * area / covered;
  return {scale * sum.one, scale * sum.two};
}

}  // namespace mpm
