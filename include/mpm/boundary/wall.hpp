// A face of the domain as a condition on the velocity of the nodes on it and beyond it.
//
// fixed: no velocity. slip: no velocity along the normal, in or out. frictional: Coulomb contact, lets go. symmetry: as
// slip, by the name of what it stands for. For contact that is found from volume, every wall is a mirror
// (Grid::mirrored).
//
// Two walls that meet act one after the other; as their normals are orthogonal neither undoes the other. Contact may: a
// wall that always holds acts before it and again after it (step/order.hpp). Nodes are visited on several threads.
// Source: Nairn, GIMP notes (3.1)-(3.11): a condition replaces the momentum along one direction, force and momentum
// alike.
#pragma once

#include <utility>
#include <vector>

#include "mpm/boundary/wall_definition.hpp"
#include "mpm/loop/chunk_sums.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/step/node_loss.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class Wall final : public FieldStage {
 public:
  /// `face`: 2 * grid axis, + 1 for the upper one. `name` as in scenes ("z_min"). `gravity` [m/s^2] serves the account
  /// of energy alone. `heat`: what is told of friction, if there is heat; outlives the wall.
  Wall(int face, const WallDefinition& definition, const std::string& name, const Vec3& gravity = Vec3::Zero(),
       int threads = 1, HeatSink* heat = nullptr);

  std::string name() const override { return account_.name; }
  Ranks ranks(Hook hook) const override {
    if (definition_.kind == WallKind::frictional) return {Rank::frictional_wall};
    return holding(hook, Rank::wall, Rank::wall_again);
  }

  void count(Device& device) override;
  void learn(const Device& device) override;
  void teach(Device& device) const override;

  void momentum_gathered(FieldContext& context) override;
  void before_strain(FieldContext& context) override;
  void momentum_updated(FieldContext& context) override;
  void velocity_found(FieldContext& context) override;
  void increment_found(FieldContext& context) override;
  void grid_advanced(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  /// "wall_friction" of a frictional wall, and "wall_loss", of motion that walls hold up.
  void energies(EnergyReport& report) const override {
    if (definition_.kind == WallKind::frictional) {
      report.add("wall_friction", NamedEnergy::Kind::dissipated, loss_.friction);
    }
    report.add("wall_loss", NamedEnergy::Kind::dissipated, loss_.held);
  }
  void share_memory(Communicator& ranks) override { held_.share(ranks); }
  void serialise(StateArchive& archive) override {
    account_.serialise(archive);
    archive.sum("given", given_);
    archive.sum("friction_energy", loss_.friction);
    archive.sum("held_energy", loss_.held);
    held_.serialise(archive);
  }

 private:
  struct Node {
    NodeRef ref;
    std::uint64_t id;
    Hold hold;    ///< in the step before, then in this one
    bool counts;  ///< to sums, which over several ranks it does on one
    // For a wall that always holds, along the grid's axes:
    Vec3 removed = Vec3::Zero();  ///< velocity for strain at the start of the step, by all its acts in it [m/s]
    Vec3 at_end = Vec3::Zero();   ///< factor of c1 in what it takes [N s]
  };
  /// Actions of the wall in a step.
  struct Deeds {
    Vec3 given = Vec3::Zero();  ///< [N s]
    SurfaceLoss loss;
    Deeds& operator+=(const Deeds& other) {
      given += other.given;
      loss += other.loss;
      return *this;
    }
  };
  /// The nodes on the face and beyond it, when blocks have changed.
  void find_nodes(const Grid& grid);
  bool always_holds() const { return definition_.kind != WallKind::frictional; }
  /// Grid axes [first, end) along which a wall that always holds does so.
  std::pair<int, int> held_axes(const GridLayout& layout) const;
  /// Books what a wall that always holds takes at a node by the start of the step, by an impulse [N s], and keeps for
  /// before_strain() what it will take by the end. With USF, where nothing is gathered any more, it books both if it
  /// held the node in the step before (AxisLoss).
  void hold_up(Node& node, const FieldContext& context, const Vec3& impulse, Hold before, SurfaceLoss& loss) const;
  /// Acts at one node.
  void act(std::size_t node, FieldContext& context, const Vec3& normal, Deeds& deeds);
  /// Visits the nodes with material on several threads, and books the sums.
  template <class Visit>
  void each_node(Visit&& visit) {
    const Deeds all = deeds_.over("walls: nodes", carrying_.size(), threads_, [&](std::size_t i, Deeds& deeds) {
      Deeds of_other_rank;
      visit(carrying_[i], nodes_[carrying_[i]].counts ? deeds : of_other_rank);
    });
    given_ += all.given;
    loss_ += all.loss;
  }
  /// Tells of what friction took since the last call.
  void tell_of_heat(const FieldContext& context);
  /// Frictional: how the wall holds the node; else what it always does.
  ContactChange change(const Vec3& velocity, const Vec3& normal) const;
  Vec3 normal(const GridLayout& layout) const;

  int face_;
  WallDefinition definition_;
  Vec3 gravity_;
  int threads_;
  ImpulseAccount account_;
  Vec3 given_ = Vec3::Zero();  ///< in this step [N s]
  SurfaceLoss loss_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> carrying_;  ///< indices in nodes_ of those with material in this step
  ChunkSums<Deeds> deeds_;
  std::vector<NodeLoss> losses_;  ///< frictional only: at nodes_, in this step
  HeatSink* heat_;
  std::vector<double> rubbed_;    ///< heat of friction at each of nodes_, not told yet [J]
  bool acted_ = false;            ///< true if the step's impulses were given
  HeldNodes held_;                ///< nodes held, for a frictional wall and with USF
  std::uint64_t generation_ = 0;  ///< generation of the block table that nodes_ was made from
};

}  // namespace mpm
