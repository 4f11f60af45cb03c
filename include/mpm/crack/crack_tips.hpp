// The tips of the cracks in a run: J and stress intensities, and growth.
//
// When J is due, at sync points and before every look at growth, it is taken on a contour around the tip
// (j_integral.hpp) from nodal values (tip_values.hpp), with the terms of faces inside: tractions, friction, bends of
// the crack, other cracks. It is the J of growth straight on. A tip without J says why; it keeps the crack as it is.
// Growth is decided by tip_growth.hpp and adds points to the chain, which the next step's fields see. It ends where the
// tip meets a crack, its own or another, or comes within a quarter of a cell of it, where it leaves the material or the
// grid, and, for want of J, so near to another tip that no contour goes between them.
// Weak: J is taken in the middle of a step, with the stress between its start and its end. J of a body that has turned
// far is taken along the tip's present direction.
// Source: crack reference 4, 5; Nairn (2003), CMES 4(6), 649-663.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mpm/crack/crack_tractions.hpp"
#include "mpm/crack/face_terms.hpp"
#include "mpm/crack/interaction_integral.hpp"
#include "mpm/crack/j_integral.hpp"
#include "mpm/crack/tip_growth.hpp"
#include "mpm/crack/tip_heating.hpp"
#include "mpm/crack/tip_numbers.hpp"
#include "mpm/crack/tip_values.hpp"

namespace mpm {

/// Constants of a material for cracks.
struct FractureMaterial {
  std::string name;
  FractureConstants constants;
  std::optional<ElasticConstants> elastic;  ///< constants of isotropic elastic materials
  double wave_speed = 0.0;                  ///< [m/s]
};

struct TipSettings {
  ContourDefinition contour;
  CracksDefinition::Split split = CracksDefinition::Split::interaction;
  GrowthRule growth, alternate;
  double length = 0.5;       ///< length of a step of growth [cells]
  double time_factor = 0.5;  ///< time between looks, over that in which a wave crosses a cell
  std::vector<FractureMaterial> materials;
  std::vector<int> material_of_set;
  std::function<BodyEnergies()> energies;  ///< energies of the run between two steps
};

/// A tip as it was last looked at.
struct CrackTip : TipNumbers {
  int crack = 0, end = 0;
  bool looked = false;                                   ///< J has been asked for
  ContourStatus status = ContourStatus::meets_no_crack;  ///< `complete`: J is known
  int material = -1;                                     ///< index in TipSettings::materials
  Vec2 start_direction = Vec2::UnitX();                  ///< at the run's start
  std::string why;                                       ///< it grew or did not, or stopped for good
  TipGrowth growth;
};

class CrackTips {
 public:
  CrackTips(std::vector<Crack>& cracks, const CrackFields& chosen, CrackTractions& tractions, FieldJumps& jumps,
            TipParts parts, std::unique_ptr<ScalarTransfer> transfer, TipSettings settings);

  /// Finds in which materials the tips lie, when particles have chosen their fields.
  void find_materials();
  /// True if a tip has to be looked at at this time [s].
  bool growth_due(double time) const;
  /// Places of tips that may grow, now or later.
  void find_growing(std::vector<Vec2>& places) const;
  /// Finds what their next growth would add, for those that may grow with a law of tractions.
  void find_growing(std::vector<FacesOfGrowth>& faces) const;
  /// Finds the energies for growth at the end of the step that begins now, at `time` [s].
  void find_energies(double time);
  /// Finds J and K of all tips at a time [s]. Fields are those of a step in which momentum has been updated.
  void find(double time);
  /// Lets tips grow that are due, after find(). @throws FractureError
  void grow(double time, double dt);
  const std::vector<CrackTip>& tips() const { return tips_; }
  /// True if a tip grows no more: it has met a crack, has left the material or the grid, or is, for want of J, too near
  /// to another tip.
  bool stopped(const CrackTip& tip) const;
  /// Growth tells of its heat from now on; outlived by `heating`.
  void set_heating(TipHeating* heating) { heating_ = heating; }
  /// Heat of tips in this step, once masses are on the grid.
  void heat(double dt);
  void serialise(StateArchive& archive);

 private:
  static constexpr double kMet = 0.05;  ///< part of a cell: a tip this near to another crack has met it

  void find(CrackTip& tip);
  void lay_path(const CrackTip& tip);
  const Vec2& end_of(int crack, int end) const;
  bool lies_on_other_crack(int crack, const Vec2& place) const;
  bool divide_one_body(int crack, int other) const;
  int group_of(const CrackTip& tip, const ContourPath& path) const;
  void find_material(CrackTip& tip);
  void add_faces(const CrackTip& tip, const JForm& form, JResult& result);
  double friction_at(const CrackTip& tip, const JForm& form);
  void split(CrackTip& tip);
  /// The points by which a tip grows, none to all of its way, and why it stops there for good; empty: it does not.
  struct Way {
    std::vector<Vec2> points;
    std::string stop;
  };
  Way find_way(const CrackTip& tip, const Vec2& direction) const;
  void grow(CrackTip& tip, double time, double dt);
  void lengthen(CrackTip& tip, const TipState& state, const GrowthDecision& decision, const std::vector<Vec2>& points,
                const GrowthRule& rule, double dt);
  /// True if a node around a place carries material that the crack divides.
  bool has_material(int crack, const Vec2& place) const;
  bool may_grow(const CrackTip& tip) const;
  const std::string& law_of_growth(const CrackTip& tip, const GrowthRule& rule) const;
  Vec2 place_of(const CrackTip& tip) const {
    const Chain& chain = cracks_[tip.crack].chain;
    return chain.points()[chain.point_at(tip.end)].place;
  }
  /// With the square around the tip, whose edge is in `edge_`.
  JForm form_of(const Chain& chain, const Vec2& tip);

  std::vector<Crack>& cracks_;
  const CrackFields& chosen_;
  CrackTractions& tractions_;
  FieldJumps& jumps_;
  TipParts parts_;
  TipSettings settings_;
  TipValues values_;
  GridLines lines_;
  std::vector<CrackTip> tips_;
  TipHeating* heating_ = nullptr;
  bool by_balance_ = false;  ///< true if a criterion asks for energies
  std::optional<BodyEnergies> energies_;
  double grown_area_ = 0.0;   ///< area grown of all tips since the start [m^2]
  double area_before_ = 0.0;  ///< the same when energies were found
  double time_ = 0.0;         ///< time of the look at work [s]
  ContourPath path_, edge_;
  std::vector<Vec2> others_;  ///< places of other tips [m]
  std::vector<ContourPiece> pieces_;
  std::vector<AreaSample> samples_;
  std::vector<FaceSample> faces_;
  std::vector<FaceWork> work_;
  std::vector<FrictionSample> slips_;
};

}  // namespace mpm
