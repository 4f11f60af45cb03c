// Moves the points of chains with the material: each surface by the nodes of its own side, weighted by hat functions
// and mass, at the end of a step; the chain between them as the scene says (crack/chain.hpp).
//
// Weak: hat functions reach one cell, whatever functions particles have; a surface whose side has no material near it
// goes with the other.
// Source: crack reference 3.1 to 3.4; NairnMPM's manual, MovePlane.
#pragma once

#include <vector>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/crack_tractions.hpp"

namespace mpm {

class CrackMotion {
 public:
  /// All outlive this object.
  CrackMotion(std::vector<Crack>& cracks, const CrackFields& chosen, const Fields& fields, CracksDefinition::Move by,
              bool prevent);

  /// Grid::velocity is v^{n+1} and Grid::force the acceleration.
  void move(const CrackTractions& tractions, double dt);
  /// Moves of more than half a cell in one step, which were stopped, since the start.
  long stopped() const { return stopped_; }
  void serialise(StateArchive& archive) { archive.value("stopped", stopped_); }

 private:
  /// Motion, by the nodes of the groups, of material at `from`, near `place`.
  SurfaceMotion surface(const std::vector<int>& groups, const Vec2& place, const Vec2& from) const;
  SurfaceMotion centre(const std::vector<int>& groups, const Vec2& place) const;

  std::vector<Crack>& cracks_;
  const CrackFields& chosen_;
  const Fields& fields_;
  CracksDefinition::Move by_;
  bool prevent_;
  std::vector<std::vector<int>> groups_;                            ///< groups of each crack
  std::vector<std::vector<SurfaceMotion>> above_, below_, centre_;  ///< surfaces of each crack
  long stopped_ = 0;
};

}  // namespace mpm
