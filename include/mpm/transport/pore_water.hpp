// Water in the pores of a skeleton, after Biot: total stress = the law's stress - alpha p, so that laws act on
// effective stress; and dp = -Q alpha : d(strain) where no water moves (method reference 9.1, erratum 27: GIMP notes
// (6.39)-(6.41) omit Q). The force of the pressure, sum of V alpha p G, goes to the grid beside that of the law, with
// the pressure that the strain of the same stress has made: explicit steps see one material of modulus M + alpha^2 Q.
//
// Weak: where water hardly flows, pressures of neighbouring cells may alternate, as volumes do that lock; what a mesh
// cannot squeeze out stays. An anisotropic alpha takes the strain of an increment as the symmetric part of
// (F - F_before) over the mean of both.
#pragma once

#include <memory>
#include <vector>

#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/step_context.hpp"
#include "mpm/transport/local_gain.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {

/// Strain of an anisotropic set since the last look, contracted with Biot's tensor: a number of its particles.
inline constexpr const char* kSqueezedBy = "squeezed_by";

/// The pressure that a squeezed skeleton gives its water.
class SkeletonGain final : public LocalGain {
 public:
  SkeletonGain(const TransportParts& parts, std::vector<TransportMaterial> of_set);
  std::string name() const override { return "skeleton"; }
  bool acts_on(int) const override { return true; }
  void take(int set, int first, int last, const double* value, double* gain) override;

 private:
  TransportParts parts_;
  std::vector<TransportMaterial> of_set_;
  std::vector<std::size_t> last_;  ///< place of ln J, or of F's components, at the last look in ParticleSet::brought
};

class PoreWater {
 public:
  /// `pressure` outlives this.
  /// `averaged`: the mechanics take volume changes averaged over the grid (kernel/mean.hpp); then so is what pushes.
  PoreWater(TransportedField& pressure, const TransportParts& parts, std::unique_ptr<ScalarTransfer> transfer,
            bool averaged);

  /// Adds the force of the pressure to the nodes.
  void add_force(StepContext& context);
  /// Adds to `forces` those of a block that falls asleep after a step, as in its last add_force().
  void add_forces(const RestingBlock& block, BlockForces& forces);
  /// Work of the pressure on the skeleton since the start [J]: to be called once in a step, after its force was added.
  double work() const { return work_; }
  /// Radial momentum by the hoop direction about an axis in this step [N s].
  double radial() const { return radial_; }
  /// Fastest wave of an undrained set with this drained speed [m/s].
  double undrained_speed(int set, double drained) const;
  void serialise(StateArchive& archive);

 private:
  void fit_scratch();
  double stiffness(int set) const;
  /// Finds what pushes along a grid axis, by mass: row `axis` of alpha times p J / rho0.
  void push_rows(int set, int axis);
  void push_rows(int set, int axis, int first, int end);
  /// Replaces what pushes by the mean of the nodes around a particle, the adjoint of an averaged strain; and so the
  /// pressure that is seen.
  void average();
  /// The same of the hoop direction alone.
  void push_hoop(int set);
  void push_hoop(int set, int first, int end);

  TransportedField& pressure_;
  TransportParts parts_;
  std::unique_ptr<ScalarTransfer> transfer_;
  bool isotropic_ = true, averaged_;
  NodalField force_, part_;
  NodalField around_, one_around_;  ///< scratch: forces of one block, along all axes and along one [N]
  std::vector<std::array<PaddedArray<double>, 3>> push_;  ///< push of each set, pushed_ of them in use
  int pushed_ = 0;
  ScalarTransfer::Given pushes_, by_axis_;
  ScalarTransfer::Taken means_;
  std::vector<PaddedArray<double>> mean_;  ///< scratch, where averages are taken
  std::vector<std::size_t> last_;          ///< place of J at the last force in ParticleSet::brought
  std::vector<std::size_t> squeezed_;      ///< place there of kSqueezedBy, of anisotropic sets
  std::vector<double> sums_;
  double work_ = 0.0, radial_ = 0.0;
};

inline bool is_isotropic(const Symmetric3<double>& s) {
  return s.xx == s.yy && s.yy == s.zz && s.yz == 0.0 && s.xz == 0.0 && s.xy == 0.0;
}

}  // namespace mpm
