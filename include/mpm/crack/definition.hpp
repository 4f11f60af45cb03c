// Definition of the explicit cracks of a scene: lines in the plane across which material has no strength.
// Source: Nairn (2003), Material point method calculations with explicit cracks; NairnMPM's manual, Cracks.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "mpm/crack/fracture_definition.hpp"
#include "mpm/crack/traction_law_definition.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/rigid/contact_law.hpp"

namespace mpm {

/// Fate of the end of a crack.
enum class CrackEnd {
  none,     ///< it has no J and does not grow
  tip,      ///< it has J and K, and grows by the constants of its material
  exterior  ///< the crack leaves the body here
};
inline constexpr std::array<const char*, 3> kCrackEndNames = {"none", "tip", "exterior"};

/// Action of faces that meet on each other.
struct CrackFaces {
  enum class Detection { displacements, positions };
  ContactLaw law;        ///< frictionless by default; kind one_field: no crack is felt at all
  bool ignored = false;  ///< the faces pass through each other
  Detection detection = Detection::displacements;
  double position = 0.8;  ///< distance of detection by positions [cells]

  /// True if nothing but pressure acts where they meet, as faces with a law of tractions need.
  bool smooth() const {
    const auto zero = [](const Function& function) { return function.is_constant() && function(0.0) == 0.0; };
    return !ignored && law.kind == ContactLaw::Kind::coulomb && zero(law.friction) && zero(law.adhesion) &&
           (!law.static_friction || zero(*law.static_friction));
  }
};

struct CrackDefinition {
  std::string name;
  std::string body;          ///< name of the body whose material the crack divides; empty: all bodies that heed cracks
  std::vector<Vec2> points;  ///< the chain, along the grid's axes, from its start to its end [m]; at least two
  std::array<CrackEnd, 2> ends{CrackEnd::none, CrackEnd::tip};
  std::array<std::string, 2> tip_materials;  ///< empty: the material found at the tip
  bool fixed = false;                        ///< it does not move with the material
  double thickness = 0.0;                    ///< for tractions and the heat of tips [m]; 0: the scene's
  CrackFaces faces;
  std::string traction;                      ///< law of all its faces from the start; empty: none
  std::string traction_of_growth;            ///< law of the faces that growth makes; empty: the rule's
  double longest = 0.0, longest_open = 0.0;  ///< length [m], all or without tractions, at which growth stops; 0: never
  std::string where;                         ///< "file:line: key.path", for errors; may be empty
};

/// The path around a tip on which J is taken.
struct ContourDefinition {
  int size = 3;                       ///< half of its edge [cells], at least 2
  int terms = 2;                      ///< 2: with the term of the area, which counts where waves run or about an axis
  bool about_axis_by_broberg = true;  ///< about an axis; else in the form of Bergkvist and Huong
  enum class Energy { particles, grid } energy = Energy::particles;
};

struct CracksDefinition {
  std::vector<CrackDefinition> list;
  std::vector<TractionLawDefinition> laws;
  std::vector<FractureConstants> materials;  ///< in the order of SimulationDefinition::materials
  std::vector<std::string> ignored_by;       ///< bodies that heed no crack
  ContourDefinition contour;
  enum class Move { average, centre_of_mass } move = Move::average;
  bool prevent = true;  ///< faces that have crossed the crack's line are put back
  enum class Split { interaction, openings } split = Split::interaction;  ///< splitting of J into K_I and K_II
  GrowthRule growth, alternate;
  double length = 0.5;       ///< length of a step of growth [cells]
  double time_factor = 0.5;  ///< time between two looks at growth, over that in which a wave crosses a cell
  double heating = 0.0;      ///< part of the energy released at a growing tip that becomes heat there

  bool any() const { return !list.empty(); }
  /// True if the crack divides the material of a body.
  bool divides(const CrackDefinition& crack, const std::string& body) const {
    const bool ignores = std::find(ignored_by.begin(), ignored_by.end(), body) != ignored_by.end();
    return !ignores && (crack.body.empty() || crack.body == body);
  }
};

}  // namespace mpm
