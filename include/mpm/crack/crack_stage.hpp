// Explicit cracks in a run: puts together what they do in a step.
//
//   a step begins     particles near cracks choose their fields, which hold for the whole step (crack_fields.hpp)
//   forces gathered   tractions between faces (crack_tractions.hpp); heat of tips (tip_heating.hpp)
//   grid advanced     J, K and growth where they are due (crack_tips.hpp); surfaces and chains move (crack_motion.hpp);
//                     tractions of the next step follow from the new openings
//
// Contact between faces is a stage of its own (crack_contact.hpp). Blocks near a crack never sleep: those whose nodes
// its particles and contours may need.
//
// Over several ranks all have the same chains, tips and laws, and move them alike, since they have all nodes near them
// with the same bits (ranks/halo.hpp). What is asked of particles is gathered: which fields are in use at a node, the
// material at a tip, the area inside a contour, the energies of the run. Weak: nothing of this is shared out.
// Source: Nairn (2003), CMES 4(6), 649-663; crack reference 3.6, with J taken before the chain moves, in the middle of
// the step.
#pragma once

#include <memory>
#include <vector>

#include "mpm/crack/crack_contact.hpp"
#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/crack_motion.hpp"
#include "mpm/crack/crack_tips.hpp"
#include "mpm/crack/crack_tractions.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class CrackStage final : public Stage, public RestPartner {
 public:
  /// Parts that it works with; made by modules/crack_module.cpp. `sync`: between sync points [s].
  struct Parts {
    std::vector<Crack> cracks;
    std::unique_ptr<FieldJumps> jumps;
    std::unique_ptr<CrackFields> chosen;
    std::unique_ptr<CrackMotion> motion;
    std::unique_ptr<CrackTractions> tractions;
    std::unique_ptr<CrackTips> tips;
    const std::vector<ParticleSet>* sets = nullptr;
    double sync = 0.0;
    int contour = 0;     ///< half of the edge of the contours of tips [cells]
    double reach = 0.0;  ///< distance from a chain within which nodes are needed [cells]
    bool counts = true;  ///< over several ranks, which all have the same cracks: whether these are reported here
    std::unique_ptr<ScalarTransfer> masses;  ///< for the limit of the first step
    std::vector<Vec2> growing;               ///< places of tips
    std::vector<FacesOfGrowth> faces;
  };
  /// The parts refer to each other: `parts` is where they lie.
  explicit CrackStage(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

  std::string name() const override { return "cracks"; }
  Ranks ranks(Hook hook) const override { return {hook == Hook::step_begun ? Rank::node_choice : Rank::traction}; }

  void before_sort() override { parts_->chosen->before_sort(); }
  bool needs_sort() const override { return parts_->chosen->needs_sort(); }
  void run_begun(StepContext& context) override;
  void step_begun(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void forces_gathered(StepContext& context) override;
  /// @throws ModuleError
  void grid_advanced(StepContext& context) override;

  bool stirs(const RestingBlock& block, const RestTimes&) override {
    return parts_->chosen->near(block.block, parts_->reach);
  }
  /// A tip may grow by several cells between two looks.
  bool moves_with_sorts() const override { return true; }

  void limit_step(const PeriodAhead& period, StepLimit& limit) const override;
  std::string limit_text(const StepLimit&) const override { return "stiffest law of tractions on a crack"; }
  void energies(EnergyReport& report) const override {
    report.weigh(parts_->counts ? 1.0 : 0.0);
    parts_->tractions->energies(report);
  }
  /// "crack length 1", "crack 1 end j", ...: cracks counted from 1; "crack misfits", pairs of particle and node that
  /// fitted into no field; "crack moves stopped", of surfaces by more than half a cell in a step.
  void numbers(std::vector<NamedNumber>& list) const override;
  void serialise(StateArchive& archive) override;
  void hashed(std::vector<double>& numbers) const override;

  const std::vector<Crack>& cracks() const { return parts_->cracks; }
  const std::vector<CrackTip>& tips() const { return parts_->tips->tips(); }
  bool tip_stopped(const CrackTip& tip) const { return parts_->tips->stopped(tip); }
  const CrackTractions& tractions() const { return *parts_->tractions; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// Numbers that crack `number`, from 1, adds: name and unit.
std::vector<std::pair<std::string, std::string>> crack_numbers(int number);

}  // namespace mpm
