// Transport of a run: its quantities, when they are updated, what they do to the motion, and the service through which
// contact gives them its heat.
//
//   forces gathered   the pressure that strain has made is taken, and its force goes to the grid
//   grid advanced     each quantity that is due moves; what expands gets its new free strain evenly over as long a time
//                     as the update has waited, so that nothing is struck (kernel/free_strain.hpp)
//
// A quantity that moves slowly is not updated in every step: it waits until a stable step of one stage has gone by,
// which it then takes in three, or the sync period ends, or contact has given heat; so a scene whose heat creeps pays
// little for it. Reports are those of the sync point. One that moves fast is updated in every step, in stages; the step
// of the mechanics does not shorten for it. The pressure of water, which pushes the material at once, is updated in
// every step too; it changes the speed of waves, and so the step.
//
// Where blocks sleep, a quantity keeps them awake while it changes, and wakes them (content_at_rest.hpp); the force of
// the water is one of those that a block asleep remembers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/step/stage.hpp"
#include "mpm/transport/enhanced_strain.hpp"
#include "mpm/transport/pore_water.hpp"
#include "mpm/transport/surface_heat.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {

/// Names and units of the numbers that any scene may have, by name "temperature content".
std::vector<std::pair<std::string, std::string>> transport_numbers();

class Transport final : public Stage, public RestPartner {
 public:
  /// `drained_speeds`: of each set, its fastest wave without water [m/s]; `sync`: [ns].
  Transport(TransportParts parts, std::int64_t sync, std::vector<double> drained_speeds);

  /// Quantities, in any order; all are added before the first step.
  void add(std::unique_ptr<TransportedField> field);
  void add(std::unique_ptr<PoreWater> water) { water_ = std::move(water); }
  /// Takes over nothing: the temperature owns it.
  void set_surface_heat(SurfaceHeat* heat) { surface_ = heat; }
  /// Makes the sets whose materials expand remember their free strain. `make_transfer`: of the run's sets and fields.
  void prepare_expansion(const std::function<std::unique_ptr<ScalarTransfer>()>& make_transfer);

  bool stirs(const RestingBlock& block, const RestTimes& times) override;
  bool at_once() const override { return false; }
  void add_forces(const RestingBlock& block, BlockForces& forces) override {
    if (water_) water_->add_forces(block, forces);
  }
  void falls_asleep(const RestingBlock& block) override {
    for (const auto& field : fields_) field->falls_asleep(block);
    if (enhanced_) enhanced_->masses_changed();
  }
  void wakes(const RestingBlock& block) override {
    for (const auto& field : fields_) field->wakes(block);
    if (enhanced_) enhanced_->masses_changed();
  }

  std::string name() const override { return "transport"; }
  Ranks ranks(Hook) const override { return {Rank::transport}; }
  void step_begun(StepContext& context) override;
  void forces_gathered(StepContext& context) override;
  void grid_advanced(StepContext& context) override;
  void at_sync(std::int64_t time) override {
    sync_end_ = time + sync_;
    finish_expansion();
    if (enhanced_) enhanced_->at_sync();
  }
  void before_sort() override { finish_expansion(); }
  void accounts(std::vector<ImpulseAccount>& list) const override;
  void energies(EnergyReport& report) const override;
  void numbers(std::vector<NamedNumber>& list) const override;
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override;
  std::string limit_text(const StepLimit& limit) const override;
  void serialise(StateArchive& archive) override;
  void hashed(std::vector<double>& numbers) const override;

  /// Content gained by particles less that of all accounts, over what was exchanged: round-off. An error that is no
  /// more than round-off of what the particles hold, relative to that: what is exchanged may be next to nothing.
  double budget_error(const TransportedField& field) const;

 private:
  /// Takes the free strain nearer to that of the quantities, by a part of what is left.
  void expand(double part);
  /// Books the second half of the work of an expansion, once the stress has taken it.
  void finish_expansion();
  /// Sum of term(p) over the particles awake, in groups: the same bits on any number of threads.
  template <class Term>
  double sum_over(const ParticleSet& set, Term&& term);

  TransportParts parts_;
  std::int64_t sync_, sync_end_;
  std::vector<double> drained_speeds_;
  std::vector<std::unique_ptr<TransportedField>> fields_;
  std::vector<double> waited_;  ///< time of each quantity since its last update [s]
  std::unique_ptr<PoreWater> water_;
  SurfaceHeat* surface_ = nullptr;
  std::vector<double> sums_;
  /// Work of expansion against the stress, the mean of that before and after it [J]: what the stress has taken, and the
  /// first half of what it has not.
  double expansion_work_ = 0.0, expansion_begun_ = 0.0;
  bool begun_ = false;  ///< the stress has not taken it everywhere
  bool expands_ = false;
  std::unique_ptr<EnhancedStrain> enhanced_;  ///< null where nothing expands, or the shape function needs none
  bool changed_ = true;                       ///< some quantity was updated since its last look
  double expands_for_ = 0.0;                  ///< time in which the free strain reaches that of the last update [s]
  ImpulseAccount hoop_;
};

}  // namespace mpm
