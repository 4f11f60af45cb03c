// Links and joints as a skeleton of DART: mass matrix, Coriolis forces and weight, Jacobians, inverse dynamics.
// Its own steps, contact, springs and limits are not used.
#include <fmt/format.h>

#include <algorithm>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>

#include "mpm/robot/engine.hpp"
#include "mpm_robots/robots.hpp"

namespace mpm {
namespace {

namespace dynamics = dart::dynamics;

Eigen::Isometry3d transform_of(const Pose& pose) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = pose.orientation.toRotationMatrix();
  transform.translation() = pose.position;
  return transform;
}

/// DART asks for masses greater than zero. This is that of a link without any [kg], [kg m^2].
constexpr double kNoMass = 1e-12;

dynamics::BodyNode::Properties properties_of(const ModelLink& link) {
  const bool carries = link.mass > 0.0 && link.inertia.trace() > 0.0;
  const Mat3 least = kNoMass * Mat3::Identity();
  const dynamics::Inertia inertia(std::max(link.mass, kNoMass), link.centre, carries ? link.inertia : least);
  return dynamics::BodyNode::Properties(dynamics::BodyNode::AspectProperties(link.name, inertia));
}

class DartEngine final : public RobotEngine {
 public:
  DartEngine(const RobotDefinition& definition, const Vec3& gravity)
      : skeleton_(dynamics::Skeleton::create(definition.name)), fixed_(definition.base.kind == BaseKind::fixed) {
    skeleton_->setGravity(gravity);
    add_base(definition.model.links.front());
    for (std::size_t j = 0; j < definition.model.joints.size(); ++j) {
      add_joint(definition.model.joints[j], definition.model.links[j + 1]);
    }
    const auto count = static_cast<Eigen::Index>(skeleton_->getNumDofs());
    mass_ = Eigen::MatrixXd::Zero(count, count);
    bias_ = positions_ = velocities_ = Eigen::VectorXd::Zero(count);
    for (const dynamics::BodyNode* node : nodes_) {
      const dynamics::Joint* joint = node->getParentJoint();
      for (std::size_t k = 0; k < joint->getNumDofs(); ++k) {
        numbers_.push_back(static_cast<int>(joint->getIndexInSkeleton(k)));
      }
    }
    number_of_.resize(numbers_.size());
    for (std::size_t i = 0; i < numbers_.size(); ++i) number_of_[numbers_[i]] = static_cast<int>(i);
  }

  int freedoms() const override { return static_cast<int>(numbers_.size()); }

  void set_positions(const Pose& base, const Eigen::VectorXd& joints) override {
    const Eigen::Index own = fixed_ ? 0 : 6;
    if (fixed_) {
      skeleton_->getRootJoint()->setTransformFromParentBodyNode(transform_of(base));
    } else {
      const Eigen::Matrix<double, 6, 1> free = dynamics::FreeJoint::convertToPositions(transform_of(base));
      for (Eigen::Index k = 0; k < 6; ++k) positions_[numbers_[k]] = free[k];
    }
    for (Eigen::Index i = 0; i < joints.size(); ++i) positions_[numbers_[own + i]] = joints[i];
    skeleton_->setPositions(positions_);
  }

  const Eigen::MatrixXd& mass_matrix() override {
    const Eigen::MatrixXd& theirs = skeleton_->getMassMatrix();
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      for (std::size_t j = 0; j < numbers_.size(); ++j) {
        mass_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = theirs(numbers_[i], numbers_[j]);
      }
    }
    return mass_;
  }

  const Eigen::VectorXd& bias(const Eigen::VectorXd& velocities) override {
    set_velocities(velocities);
    const Eigen::VectorXd& theirs = skeleton_->getCoriolisAndGravityForces();
    for (std::size_t i = 0; i < numbers_.size(); ++i) bias_[static_cast<Eigen::Index>(i)] = theirs[numbers_[i]];
    return bias_;
  }

  Pose pose(int link) override {
    const Eigen::Isometry3d& transform = nodes_[link]->getWorldTransform();
    return {transform.translation(), Quat(transform.linear()).normalized()};
  }

  void jacobian(int link, Eigen::MatrixXd& into) override {
    const dynamics::BodyNode& node = *nodes_[link];
    const Mat3 axes = node.getWorldTransform().linear();
    const auto& own = node.getJacobian();
    const std::vector<std::size_t>& columns = node.getDependentGenCoordIndices();
    into.setZero();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Eigen::Index column = number_of_[columns[c]];
      into.col(column).head<3>() = axes * own.col(static_cast<Eigen::Index>(c)).head<3>();
      into.col(column).tail<3>() = axes * own.col(static_cast<Eigen::Index>(c)).tail<3>();
    }
  }

  double potential() override {
    // DART 6.12 counts the weight at the links' origins.
    double sum = 0.0;
    for (const dynamics::BodyNode* node : nodes_) {
      if (node->getMass() > kNoMass) sum -= node->getMass() * skeleton_->getGravity().dot(node->getCOM());
    }
    return sum;
  }

  Eigen::Matrix<double, 6, 1> joint_wrench(int joint, const Eigen::VectorXd& velocities,
                                           const Eigen::VectorXd& accelerations, const std::vector<int>& links,
                                           const std::vector<Eigen::Matrix<double, 6, 1>>& wrenches,
                                           bool weight) override {
    set_velocities(velocities);
    Eigen::VectorXd theirs(velocities.size());
    for (std::size_t i = 0; i < numbers_.size(); ++i) theirs[numbers_[i]] = accelerations[static_cast<Eigen::Index>(i)];
    skeleton_->setAccelerations(theirs);
    skeleton_->clearExternalForces();
    for (std::size_t l = 0; l < links.size(); ++l) {
      dynamics::BodyNode& node = *nodes_[links[l]];
      node.addExtTorque(wrenches[l].head<3>(), false);
      node.addExtForce(wrenches[l].tail<3>(), Vec3::Zero(), false, true);
    }
    const Vec3 gravity = skeleton_->getGravity();
    if (!weight) skeleton_->setGravity(Vec3::Zero());
    skeleton_->computeInverseDynamics(true);
    if (!weight) skeleton_->setGravity(gravity);
    const Eigen::Matrix<double, 6, 1> wrench = nodes_[joint + 1]->getBodyForce();
    skeleton_->clearExternalForces();
    return wrench;
  }

 private:
  void add_base(const ModelLink& link) {
    const dynamics::BodyNode::Properties properties = properties_of(link);
    if (fixed_) {
      nodes_.push_back(skeleton_->createJointAndBodyNodePair<dynamics::WeldJoint>(nullptr, {}, properties).second);
    } else {
      nodes_.push_back(skeleton_->createJointAndBodyNodePair<dynamics::FreeJoint>(nullptr, {}, properties).second);
    }
  }

  void add_joint(const ModelJoint& joint, const ModelLink& link) {
    dynamics::BodyNode* parent = nodes_[joint.parent];
    const dynamics::BodyNode::Properties properties = properties_of(link);
    const Eigen::Isometry3d origin = transform_of(joint.origin);
    if (joint.kind == ModelJoint::Kind::revolute) {
      dynamics::RevoluteJoint::Properties own;
      own.mName = joint.name;
      own.mAxis = joint.axis;
      own.mT_ParentBodyToJoint = origin;
      nodes_.push_back(skeleton_->createJointAndBodyNodePair<dynamics::RevoluteJoint>(parent, own, properties).second);
    } else if (joint.kind == ModelJoint::Kind::prismatic) {
      dynamics::PrismaticJoint::Properties own;
      own.mName = joint.name;
      own.mAxis = joint.axis;
      own.mT_ParentBodyToJoint = origin;
      nodes_.push_back(skeleton_->createJointAndBodyNodePair<dynamics::PrismaticJoint>(parent, own, properties).second);
    } else {
      dynamics::WeldJoint::Properties own;
      own.mName = joint.name;
      own.mT_ParentBodyToJoint = origin;
      nodes_.push_back(skeleton_->createJointAndBodyNodePair<dynamics::WeldJoint>(parent, own, properties).second);
    }
  }

  void set_velocities(const Eigen::VectorXd& velocities) {
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      velocities_[numbers_[i]] = velocities[static_cast<Eigen::Index>(i)];
    skeleton_->setVelocities(velocities_);
  }

  dynamics::SkeletonPtr skeleton_;
  bool fixed_;
  std::vector<dynamics::BodyNode*> nodes_;  ///< one for each link of the model
  std::vector<int> numbers_;                ///< DART's number of each freedom
  std::vector<int> number_of_;              ///< the inverse
  Eigen::MatrixXd mass_;
  Eigen::VectorXd bias_, positions_, velocities_;
};

std::unique_ptr<RobotEngine> make(const RobotDefinition& definition, const Vec3& gravity) {
  return std::make_unique<DartEngine>(definition, gravity);
}

}  // namespace

void provide_robots() { set_robot_engine(&make); }
std::string robot_engine_name() { return fmt::format("DART {}", DART_VERSION); }

}  // namespace mpm
