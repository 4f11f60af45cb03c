// Finds a run that makes energy out of nothing: one whose steps are too long, whose shape functions fail under large
// shear, or whose contact feeds itself. Its kinetic energy then exceeds all that was there at the start, that fell down
// or that tools and loads gave, while the balance says that it has no source. Both together do not happen to a run that
// only counts its energies badly. What makes less than that is not found here: the balance in reports shows it.
#pragma once

#include <cstdint>

#include "mpm/math/state_archive.hpp"
#include "mpm/step/energy.hpp"

namespace mpm {

class EnergyWatch {
 public:
  /// Energy that a run has made.
  struct Made {
    double kinetic, given, made;  ///< [J]
    bool too_much;
  };

  /// True if so many steps have passed since the last look that it is time for another.
  bool due(std::uint64_t steps) const { return steps >= looked_ + kStepsBetween; }
  /// Looks at the energies after so many steps. `least` [J]: what is noise in this run. The first call takes the state
  /// as the start.
  Made look(const EnergyReport& energy, double least, std::uint64_t steps);
  void serialise(StateArchive& archive);

 private:
  static constexpr std::uint64_t kStepsBetween = 200;  ///< a look costs a tenth of a step

  bool begun_ = false;
  std::uint64_t looked_ = 0;                             ///< steps at the last look
  double balance_ = 0.0, potential_ = 0.0, work_ = 0.0;  ///< at the start [J]
  double own_ = 0.0;                                     ///< at the start, of motion and strain [J]
  double given_ = 0.0;                                   ///< the most that the run has had so far [J]
};

}  // namespace mpm
