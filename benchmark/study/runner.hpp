// Runs one method on one suite, and measures what it costs beside the reference.
//
// Cost: processor time of stepping, of one thread. Two things are taken out of it. The body force of a manufactured
// problem is a formula that is read by an interpreter for every particle and would hide the method's own cost; so time
// is measured on a twin, the same definition without body forces, and a run's seconds are those of a step of the twin
// times its steps. And a machine has its moods: the twin of uGIMP/USF/FLIP on the same grid is stepped in turns with
// the method's, a few steps each. The median of the ratios is the relative cost, and a method's seconds are that times
// the reference's, which are measured once a grid: so runs on one grid differ by what they cost, not by when they ran.
// Weak: a twin without force hardly deforms, so a domain that would reach more nodes later is measured at rest.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "mpm/choice/method_choice.hpp"
#include "study/row.hpp"

namespace mpm::study {

/// Processor time of this process, which computes nothing else while it measures [s].
double processor_time();

struct CostSettings {
  int turns = 5;        ///< turns of reference and method, after one to warm up
  double slice = 3e-3;  ///< processor time of each's part of a turn, at least [s]
};

struct Cost {
  double seconds_per_step = kUnknown;  ///< time of the processor [s]
  double relative = kUnknown;          ///< over the reference's
};

class Runner {
 public:
  explicit Runner(CostSettings settings = {});
  ~Runner();
  /// Never throws for what a method does: a refusal or a failure is the row's status and message.
  Row run(const Suite& suite, const choice::MethodChoice& choice, const Discretisation& discretisation);

 private:
  class Twin;
  Cost cost(const Suite& suite, const choice::MethodChoice& choice, const Discretisation& discretisation);

  CostSettings settings_;
  std::string place_;                ///< suite and grid that reference_ and costs_ belong to
  std::unique_ptr<Twin> reference_;  ///< uGIMP/USF/FLIP
  double reference_seconds_ = 0.0;   ///< time of one of its steps [s]
  std::map<std::string, Cost> costs_;
};

}  // namespace mpm::study
