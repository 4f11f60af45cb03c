// Tractions between the faces of cracks in the run: the laws' histories at the points of the chains, and the forces
// that they give to the nodes.
//
// At the end of a step every point with a law looks at the opening of its faces (crack/traction_law.hpp); in the next
// step the force on each face goes to nodes of its side around it, in proportion to hat function and mass, so that they
// accelerate alike. Both forces are opposite to the last bit.
// Weak: explicit, so a stiff law limits the step; a point without nodes on one of its sides gives no force. The limit
// of a sync period is that of the chains as it begins, and of what a tip may add next. Source: crack reference 5.4;
// GIMP notes 3.2 (the area about an axis is at the radius of the crack's point).
#pragma once

#include <vector>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/traction_law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/step/energy.hpp"
#include "mpm/step/scalar_transfer.hpp"

namespace mpm {

/// Faces that the next growth of a tip would add to its crack.
struct FacesOfGrowth {
  int crack, end, law;
  double length;  ///< length of chain that a point of it stands for [m]
};

class CrackTractions {
 public:
  /// `laws` are those of the scene; `across`: thickness of a planar scene [m]. All but `laws` outlive this object.
  CrackTractions(std::vector<Crack>& cracks, const CrackFields& chosen, Fields& fields,
                 const std::vector<TractionLawDefinition>& laws, GeometryKind geometry, double across);

  bool any() const { return !laws_.empty(); }
  /// The law of a name: its number; -1 for an empty name.
  int law_of(const std::string& name) const;
  const TractionLaw& law(int number) const { return laws_[number]; }

  /// Before the first step: what limits it. `sets` are all there are.
  void begin(ScalarTransfer& transfer, const std::vector<ParticleSet>& sets, const std::vector<FacesOfGrowth>& growth);
  /// Adds to Grid::force what the faces do to each other. `growth`: of tips that may grow with a law.
  void add_forces(const std::vector<FacesOfGrowth>& growth);
  /// Finds tractions from the openings at the end of a step.
  void find(double time);
  /// Growth has added points at an end, with this law (-1: none).
  void grow(int crack, int end, int points, int law);

  /// Number of a point's law; -1: none, or failed.
  int law_at(int crack, int point) const { return points_[crack].state[point].failed ? -1 : points_[crack].law[point]; }
  /// The same, of a failed law too.
  int law_number(int crack, int point) const { return points_[crack].law[point]; }
  const TractionState& state(int crack, int point) const { return points_[crack].state[point]; }
  /// Area of the faces that a point stands for [m^2].
  double area(int crack, int point) const;
  /// The least time in which a point on its law's stiffest part oscillates, over 2 pi, as of the last step [s].
  double shortest_time() const { return shortest_time_; }
  void energies(EnergyReport& report) const;
  /// [J], of one crack.
  double stored(int crack) const;
  double released(int crack) const;
  int failed(int crack) const;  ///< points whose law has failed
  void serialise(StateArchive& archive);
  void hashed(std::vector<double>& numbers) const;

 private:
  struct Points {
    std::vector<int> law;
    std::vector<TractionState> state;
    std::vector<Vec2> force;  ///< on the face above [N]
  };
  struct Share {
    int field;
    NodeRef ref;
    double mass, part;
  };
  static double mean_mass(const std::vector<Share>& shares);
  template <class Mass>
  void find_shares(int crack, const Vec2& place, const Vec2& from, Mass&& mass, std::vector<Share>& shares) const;
  template <class Mass>
  bool find_shares(int crack, int point, Mass&& mass);
  double across(int crack, double radius) const;
  template <class Mass>
  double fastest_growth(const std::vector<FacesOfGrowth>& growth, Mass&& mass);

  std::vector<Crack>& cracks_;
  const CrackFields& chosen_;
  Fields& fields_;
  std::vector<TractionLaw> laws_;
  GeometryKind geometry_;
  double across_;
  std::vector<std::vector<int>> groups_;
  std::vector<Points> points_;
  std::vector<Share> above_, below_;
  double shortest_time_ = 0.0;  ///< 0: nothing found yet
};

}  // namespace mpm
