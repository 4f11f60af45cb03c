// A node at which fields across cracks are in use: which material is in which of its fields.
#pragma once

#include <array>

#include "mpm/math/geometry.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// Material across a crack from a node: above it or below it. Of field 3 there are two such, in the cracks' order.
struct AcrossCrack {
  int crack = -1;  ///< none
  bool above = false;
  bool operator==(const AcrossCrack& other) const { return crack == other.crack && above == other.above; }
};

/// Cracks between a particle and a node: at most two cracks, in their order.
struct CracksBetween {
  std::array<AcrossCrack, 2> across{};
  int count = 0;
  /// Adds a crack, or takes it away if it is there: a way that crosses twice does not cross.
  void toggle(const AcrossCrack& crossed);
};

/// Labels of what the fields of a node hold.
struct FieldLabels {
  static constexpr int kFields = 4;
  std::array<AcrossCrack, 2> single{};  ///< crack of fields 1 and 2
  std::array<AcrossCrack, 2> both{};    ///< cracks of field 3

  /// Number of the field that holds the material beyond these cracks; -1: none does.
  int field_of(const CracksBetween& between) const;
};

struct DividedNode : FieldLabels {
  int first = 0;                       ///< number of its field 0 among all fields
  std::array<NodeRef, kFields> ref{};  ///< in each of the fields; block -1 where there is none
  std::array<Vec2, 2> normal{Vec2::Zero(),
                             Vec2::Zero()};  ///< normals of the cracks of 1 and 2, summed; from above to below [m]
  Vec2 place = Vec2::Zero();                 ///< [m]
};

}  // namespace mpm
