// Prescribed velocity on the grid: nodes inside a region have a given velocity along a direction, v . n = v(t, x). What
// is across the direction stays free. The region is a rigid surface at a pose, at rest or moving.
//
// Conditions are superposed on a node: along one direction their velocities add, and different directions must be
// orthogonal, for otherwise each would undo the other. They stand above walls: along its direction a condition moves
// what a wall would hold.
//
// The velocity is that of the step's start while strain is updated first and that of its end from the update of
// momentum on, so that USAVG stays second order in time. A node is held whole or not at all: the boundary of a region
// between two rows of nodes is felt at the row inside it.
//
// Implicit steps are told which nodes are held, so that all others answer to them in the same step, and leave at these
// the velocity that they would have had: from that a condition stops them a second time, which is what it gives. It
// then works on the velocity of the end alone. Directions are those of axes there.
// Source: Nairn, GIMP notes (3.1)-(3.11); method reference 5.2.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/math/function.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Conditions that contradict each other or a wall, or have no value. what() names both.
class ConditionError : public ModuleError {
 public:
  using ModuleError::ModuleError;
};

/// Definition of one condition in a scene.
struct ConditionDefinition {
  /// Its name, surface, pose at the start and motion; friction and reach have no part.
  RigidBodyDefinition region;
  Vec3 direction = Vec3::UnitX();    ///< unit vector, in the grid's axes
  std::optional<Function> velocity;  ///< along it, of t and of the node's place [m/s]; without one the region's own
  std::string where;                 ///< "file:line: key.path", for errors; may be empty
};

/// A face of the domain through which nothing moves: 2 * grid axis, + 1 for the upper one.
struct HeldFace {
  int face = 0;
  std::string name;
};

/// All conditions of a scene. Audit: "condition/<name>", the impulse that each gave; what several along one direction
/// give together at a node is booked in equal parts.
class VelocityConditions final : public FieldStage, public RestPartner {
 public:
  /// A node's velocity along one direction, by one condition or the sum of several.
  struct Held {
    NodeRef ref;
    Vec3 position;
    Vec3 direction;
    int first, count;   ///< range of parts()
    double start, end;  ///< velocity along the direction as the step begins and ends [m/s]
  };
  struct Part {
    int condition;
    double sign;  ///< -1: its direction is opposite to that of the Held
  };
  /// `faces`: slip walls; `field`: the velocity field in which it acts. @throws ConditionError for a direction that is
  /// not a unit vector of the grid's axes
  VelocityConditions(const std::vector<ConditionDefinition>& definitions, std::vector<HeldFace> faces,
                     const GridLayout& layout, int field = 0);

  /// Finds the nodes that are held where material is now. @throws ConditionError when directions on a node, or a
  /// direction and a slip wall, are neither the same nor orthogonal
  void find_nodes(const Grid& grid);

  std::string name() const override { return "conditions"; }
  Ranks ranks(Hook hook) const override { return holding(hook, Rank::condition, Rank::condition_again); }

  void run_begun(FieldContext& context) override { find_nodes(context.grid); }
  void momentum_gathered(FieldContext& context) override;
  void before_strain(FieldContext& context) override;
  void momentum_updated(FieldContext& context) override;
  void velocity_found(FieldContext& context) override;
  void increment_found(FieldContext& context) override;
  void grid_advanced(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override;
  void energies(EnergyReport& report) const override { report.add("load_work", NamedEnergy::Kind::work, work_); }
  /// @throws ConditionError
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override;
  std::string limit_text(const StepLimit& limit) const override;
  void serialise(StateArchive& archive) override;

  /// True where a condition moves a node of the block's tile now or until sleep asks again, and for a region that moves
  /// and is as near as a block. A velocity of zero is a wall, under which material may sleep. @throws ConditionError
  bool stirs(const RestingBlock& block, const RestTimes& times) override;
  bool holds(int field, const Grid& grid, NodeRef node) const override;

  // Functions for a device that takes the steps (step/device.hpp), has the blocks in use and acts on their nodes.

  /// Regions take the velocities of a step of `dt` from `start` on [s]. @throws ConditionError
  void begin_step(double start, double dt);
  /// Finds the nodes that are held in these blocks, which are in ascending order; they refer to them by place in the
  /// list. @throws ConditionError
  void find_nodes(const std::vector<std::array<int, 3>>& blocks);
  /// Finds the velocities at which they are held as the step begins and ends. @throws ConditionError
  void find_velocities(double start, double dt);
  void end_step(double dt);

  /// True if nodes are to be found anew in every step; true if their velocities are.
  bool moving() const { return moving_; }
  bool changing() const;
  const std::vector<Held>& held() const { return held_; }
  const std::vector<Part>& parts() const { return parts_; }
  int count() const { return static_cast<int>(conditions_.size()); }
  /// Books what a condition has given along its direction [N s], and the work of all [J].
  void count(int condition, double impulse, double exchanged);
  void count_work(double work) { work_ += work; }

  /// The largest prescribed speed at the held nodes at a time [s], the regions standing as they do now [m/s].
  /// @throws ConditionError
  double largest_speed(double time) const;

 private:
  struct Condition {
    RigidBody region;
    Vec3 direction;
    std::optional<Function> velocity;
    std::string where;
    ImpulseAccount account;
    Vec3 given = Vec3::Zero();  ///< in this step [N s]
  };
  /// A condition that holds a node, while nodes are found.
  struct Found {
    NodeRef ref;
    int condition;
  };

  std::string title(const Condition& condition) const;
  void check_walls(const Condition& condition, const std::array<int, 3>& node, const GridLayout& layout) const;
  /// Makes the directions held at a node from the conditions found there.
  void join(const Found* begin, const Found* end, const std::array<int, 3>& block);
  /// Finds nodes in so many blocks: block_at(number).
  template <class BlockAt>
  void find_in(int blocks, BlockAt&& block_at);
  double value(const Held& held, double time) const;
  /// `velocity`: along the direction, at which the impulse works [m/s].
  void give(const Held& held, const Vec3& impulse, double velocity);

  /// The velocity that a condition gives a node by itself [m/s]. @throws ConditionError
  double velocity_of(const Condition& condition, double time, const Vec3& position) const;
  /// True if a condition moves a node of a block's tile at one of these times.
  bool moves_tile(const Condition& condition, const RestingBlock& block, const RestTimes& times) const;

  int field_;
  GridLayout layout_;
  std::vector<Condition> conditions_;
  std::vector<HeldFace> faces_;
  std::vector<Found> found_;
  std::vector<Held> held_;
  std::vector<Part> parts_;
  bool moving_ = false;                     ///< any region does
  bool ended_ = false;                      ///< momentum of this step has been updated
  std::uint64_t generation_ = 0;            ///< generation of the block table that held_ was made from
  std::vector<std::array<int, 3>> listed_;  ///< blocks that it was made from in place of a table
  double work_ = 0.0;                       ///< on the material since the start [J]
};

}  // namespace mpm
