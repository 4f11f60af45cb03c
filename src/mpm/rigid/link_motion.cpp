#include "mpm/rigid/link_motion.hpp"

namespace mpm {
namespace {

/// Velocity of a point at `arm` from the origin, by the twist of the origin.
Eigen::Matrix<double, 3, 6> of_point(const Vec3& arm) {
  Eigen::Matrix<double, 3, 6> matrix;
  matrix << 0.0, arm.z(), -arm.y(), 1.0, 0.0, 0.0,  //
      -arm.z(), 0.0, arm.x(), 0.0, 1.0, 0.0,        //
      arm.y(), -arm.x(), 0.0, 0.0, 0.0, 1.0;
  return matrix;
}

}  // namespace

void LinkMotion::push(const Vec3& impulse, const Vec3& point) {
  Vec6 wrench;
  wrench << (point - centre_).cross(impulse), impulse;
  pushed_ += wrench;
  response_->change.noalias() = response_->matrix.middleCols<6>(6 * place_) * wrench;
  for (std::size_t l = 0; l < response_->links.size(); ++l) {
    response_->links[l]->add(response_->change.segment<6>(6 * static_cast<Eigen::Index>(l)));
  }
}

Mat3 LinkMotion::compliance_at(const Vec3& point) const { return compliance_by(*this, point); }

Mat3 LinkMotion::compliance_by(const LinkMotion& other, const Vec3& point) const {
  const auto block = response_->matrix.block<6, 6>(6 * place_, 6 * other.place_);
  return of_point(point - centre_) * block * of_point(point - other.centre_).transpose();
}

std::string LinkMotion::refused_velocity() const {
  return "it is a link of a robot, which its joints move; command those";
}

}  // namespace mpm
