// Transfers by which a particle takes over the grid's motion, and their names in a scene.
//
// flip: velocity gains the grid's acceleration; a fraction below 1 mixes in PIC, which takes the grid's velocity
// itself, or XPIC, in all steps or in one of several. xpic, fmpm: PIC whose smoothing is undone to order m, from the
// velocity at the start or at the end of the step: motion that the grid does not resolve is filtered out, the rest is
// kept. apic: PIC, with the first moment of the velocity kept on the particle. Source: method reference 6.2, 6.6;
// Hammerquist & Nairn (2017), Nairn & Hammerquist (2021), Jiang et al. (2015).
#pragma once

#include <array>

namespace mpm {

enum class TransferKind { flip, xpic, fmpm, apic };

/// In the order of TransferKind.
inline constexpr std::array<const char*, 4> kTransferNames = {"flip", "xpic", "fmpm", "apic"};

struct Transfer {
  TransferKind kind = TransferKind::flip;
  double flip = 1.0;  ///< fraction of FLIP in a step, 0 is PIC; for flip only
  int order = 2;      ///< m of XPIC(m), k of FMPM(k), from 1, which is PIC; for these only
  int mixed = 1;      ///< m of the XPIC(m) that a fraction of FLIP below 1 is mixed with; for flip only

  int every = 1;  ///< steps from one to the next in which that fraction holds; others are FLIP's, for flip only

  /// True if FLIP is mixed with XPIC of an order above that of PIC.
  bool mixes() const { return kind == TransferKind::flip && flip != 1.0 && mixed > 1; }
};

}  // namespace mpm
