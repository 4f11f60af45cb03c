// Tractions on faces of particles' domains: a force over the current area of an edge (a face in a solid, an end in a
// line), in a fixed direction, or following the face: pressure against its outward normal, and shear along it. To the
// grid: f_i += T sum_a A_a N_i(x_a) over the corners of the face (shape/traction.hpp), at the hook where forces are
// gathered.
//
// The domain is the one that the scene's shape function has in this step: uGIMP's box, the box of ugimp_stretch, the
// deformed domain of CPDI and qCPDI, each cut off or made smaller at r = 0 as there. dirac and the B-splines have no
// box: the one that the particle had at the start stands in. Boxes do not turn or shear, so a load on them does not
// follow, and one that keeps its size makes T a force per area at the start; only CPDI and qCPDI hold a traction per
// current area at large strain. A corner may lie where dirac or a spline folded at a wall puts no mass: what such a
// node should take goes to the other nodes of the corner's cell, so the force is right always and its moment is not;
// with dirac the work is not what the particles gain either.
//
// T is read at the middle of the step, at the middle of the face as it will be then, and is the same all over the face;
// the face itself is that of the step's start. Few particles carry tractions, so this is plain code for one thread.
// Source: Nairn & Guilkey (2015) eq. (40)-(55) and section 4.2; method reference 4.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/mechanics/particle_loads.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/shape/traction.hpp"
#include "mpm/step/domain_faces.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// A traction on one face of each of some particles of a set.
struct TractionTerm {
  int set = 0;
  DomainFace face;
  /// Particles of the set that it acts on, by id from the set's first.
  std::vector<std::uint32_t> particles;
  /// It follows the face: `value` is pressure (compression is positive), then shear along the half vectors that span
  /// the face, in the order of axes. Else it is the traction by world axis. [Pa]
  bool follows = false;
  std::array<Function, 3> value;
};

/// As ParticleLoads, one of the last stages: its work is taken with the velocity that conditions have left. Audit:
/// "traction", the sum over the faces of particles awake of T times area times dt; the grid has no part in it. What
/// sleeps bears the traction with which it fell asleep, and wakes when it changes.
class FaceTractions : public Stage, public RestPartner {
 public:
  /// `fields` and `sets` outlive this; those that a term with X, Y or Z acts on have their start_x. `gravity`: its size
  /// [m/s^2].
  FaceTractions(const FaceSettings& settings, Fields& fields, const std::vector<ParticleSet>& sets,
                std::vector<TractionTerm> terms, double gravity = 0.0);

  std::string name() const override { return account_.name; }
  Ranks ranks(Hook) const override { return {Rank::traction}; }

  /// @throws LoadError for a traction that is not finite, or a corner that lies off the grid
  void forces_gathered(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  bool stirs(const RestingBlock& block, const RestTimes& times) override;
  bool has_forces() const override { return true; }
  void find_forces(const StepContext& context) override { find_loads(context); }
  /// Those of the step that has ended, in which it was at rest.
  void add_forces(const RestingBlock& block, BlockForces& forces) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void energies(EnergyReport& report) const override { report.add("load_work", NamedEnergy::Kind::work, work_); }
  void serialise(StateArchive& archive) override {
    archive.sum("work", work_);
    account_.serialise(archive);
  }
  /// Work on the material since the start [J]: nodal load times the displacement of its node in the step.
  double work() const { return work_; }

  const std::vector<TractionTerm>& terms() const { return terms_; }
  /// Books what tractions have given where a device takes the steps (step/device.hpp): momentum, and work [J].
  void count(const ImpulseAccount& given, double work) {
    account_.impulse += given.impulse;
    account_.exchanged += given.exchanged;
    work_ += work;
  }

 private:
  struct NodalLoad {
    int set, particle;
    int field;
    NodeRef node;
    Vec3 force;  ///< by world axis [N]
  };

  void look_for_particles();
  /// The loads at the nodes in a step. Returns the impulse that they are.
  Vec3 find_loads(const StepContext& context);
  /// By world axis [Pa].
  /// `half`: half of the step [s], in which the particle moves on until `time` [s].
  Vec3 value_at(const TractionTerm& term, const FaceParts& parts, int p, double time, double half) const;
  /// A force on the nodes of the cell that a place is in, in the particle's field.
  void spread(int set, int p, const PlacedDomain::Vector& at, const Vec3& force);
  /// Adds the loads of a field on all ranks to its forces.
  void add_over_ranks(int field);

  Fields& fields_;
  const std::vector<ParticleSet>& sets_;
  DomainFaces faces_;
  std::vector<TractionTerm> terms_;
  std::vector<std::vector<int>> places_;  ///< places of each term's particles in their set, since it was sorted
  std::vector<int> place_of_;             ///< scratch: of a set's particles, by id from the first
  std::uint64_t generation_ = 0;          ///< generation of the blocks that places_ were found with
  bool any_chooses_ = false;              ///< some particle chooses its fields, and changes its place in every step
  std::vector<NodalLoad> loads_;          ///< loads of this step
  Halo* halo_;
  NodalField nodal_;  ///< nodal values of a field's loads, where there is a halo [N]
  double weight_;     ///< weight of a unit of mass [N/kg]
  std::vector<std::vector<char>>
      bears_;  ///< marks of particles by id from the set's first, for each term that changes with time
  ImpulseAccount account_;
  double work_ = 0.0;
};

}  // namespace mpm
