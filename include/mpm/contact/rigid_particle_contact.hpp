// Contact of the material with a rigid body made of particles, as the sources have it: nodes where both have volume,
// the normal from volume gradients (with rigid bias) and the distance from mean places, as between deformable bodies;
// the rigid side has infinite mass and the velocity of its pose.
//
// For comparison with the sources and for bodies whose surface is not smooth enough to give normals. Where a surface
// has exact normals, contact/rigid_contact.hpp and contact/point_contact.hpp are better. What is reported is what was
// applied, as there. Over several ranks all have the nodes where the body has volume, and each solves them for itself.
// Weak: a staircase of particles, and contact a tenth of a cell early or late.
// Source: Nairn, GIMP notes 3.2, (3.12)-(3.20); manual, rigid materials with SetDirection 8; method reference 5.3, 8.
#pragma once

#include <vector>

#include "mpm/contact/contact_reporter.hpp"
#include "mpm/contact/node_contact.hpp"
#include "mpm/contact/pair_detection.hpp"
#include "mpm/contact/rigid_particles.hpp"
#include "mpm/rigid/contact_law.hpp"
#include "mpm/step/stage.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

struct RigidParticleSettings {
  NormalRule normals;
  DetectionRule detection;
  std::vector<ContactLaw> laws;  ///< law of each velocity field against the body
  GeometryKind geometry = GeometryKind::solid;
  int per_cell = 2;               ///< particles along a cell's edge
  double across = 1.0;            ///< thickness or area beside the grid's axes [m, m^2]
  Communicator* ranks = nullptr;  ///< communicator of a run over several ranks; else null
};

class RigidParticleContact final : public Stage, public ContactReporter {
 public:
  /// `body`, `fields` and `survey` must outlive the stage. @throws RigidError as RigidParticles.
  RigidParticleContact(const RigidBody& body, RigidParticleSettings settings, Fields& fields, VolumeSurvey& survey);

  std::string name() const override { return ledger_.account().name; }
  Ranks ranks(Hook) const override { return {Rank::rigid_body}; }
  bool same_on_all_ranks() const override { return true; }

  /// @throws FunctionError as ContactLaw::in_step().
  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(ledger_.account()); }
  void energies(EnergyReport& report) const override {
    ledger_.energies(report);
    report.leave_open();  // motion that it holds up is not counted
  }
  ContactLedger* ledger_of(const RigidBody& body) override { return &body == &body_ ? &ledger_ : nullptr; }
  void serialise(StateArchive& archive) override;

  ContactLedger& ledger() { return ledger_; }
  const ContactLedger& ledger() const { return ledger_; }
  int particles() const { return particles_.size(); }

 private:
  struct Node {
    int field;
    NodeRef ref;
    std::uint64_t id;  ///< HeldNodes::id
    NodeMaterial material, rigid;
    NodePair pair;
    Vec3 arm;  ///< from the body's origin [m]
  };
  struct Held {
    int field;
    std::uint64_t node;
    PairHold hold;
  };
  void find_blocks();
  void find_surveyed();
  void add_nodes(int field, double dt);
  PairHold held(int field, std::uint64_t node) const;
  /// Applies the law's impulse to the `velocity` of a node's material.
  void act(Node& node, Vec3& velocity, double dt);

  const RigidBody& body_;
  RigidParticleSettings settings_;
  Fields& fields_;
  VolumeSurvey& survey_;
  RigidParticles particles_;
  ContactLedger ledger_;
  double cell_volume_;
  std::vector<NodalVolumes> volumes_;
  std::vector<FrictionLaw> friction_;            ///< friction of each field, in this step
  std::vector<std::uint64_t> keys_;              ///< keys of blocks near the body, ascending
  std::vector<std::vector<std::uint8_t>> near_;  ///< marks of these in each field
  std::vector<double> surveyed_;                 ///< for each field, not 0 if some rank has any of them there
  std::vector<Node> nodes_;                      ///< by field, then key, then node
  std::vector<Held> held_;
  std::vector<NodeMaterial> two_;
  std::vector<NodePair> one_;
  bool started_ = false;
};

}  // namespace mpm
