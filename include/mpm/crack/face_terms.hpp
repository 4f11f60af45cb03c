// Terms that crack faces inside a contour add to J at the tip: faces of other cracks, faces of this crack where it
// turns, and tractions on this crack's faces.
//
// Weak: the work of tractions is that of loading; where faces unload inside the contour it is another. Friction is
// taken from the slip at this time, as if it had grown with the shear that acts now.
// Source: crack reference 4.4 to 4.6. NairnMPM has neither the faces of a crack that turns nor friction.
#pragma once

#include <vector>

#include "mpm/crack/j_integral.hpp"

namespace mpm {

/// A piece of a crack inside the contour with the fields at both its faces. Above is to the left of `along`.
struct FaceSample {
  Vec2 place{0.0, 0.0};  ///< its middle [m]
  Vec2 along{0.0, 0.0};  ///< from its start to its end [m]
  ContourValues above, below;
  Vec2 traction_above{0.0, 0.0}, traction_below{0.0, 0.0};  ///< that act on the material there [Pa]
};

enum class TractionTerms {
  counted,  ///< for other cracks: 0 on open faces, a law's traction, or that of the stress on closed ones
  left_out  ///< for this crack's own faces, whose tractions are in traction_work() and friction_work()
};

/// int [(W + K) n_k - t_i u_i,k] ds over both faces, n outward from the material: to add to J_k [J/m^2].
Vec2 face_term(const JForm& form, const std::vector<FaceSample>& samples, TractionTerms tractions);

/// Work that tractions have taken up at a place of the crack.
struct FaceWork {
  Vec2 place{0.0, 0.0};  ///< [m]
  double work = 0.0;     ///< int T . d(opening), T pulling the faces together [J/m^2]
};

/// To take off J [J/m^2]: the work at the first place, the contour's crossing; about an axis after Bergkvist and Huong
/// -int (r / a) dw along the list, which goes from the crossing to the tip. 0 for an empty list. A pressure p that
/// opens the crack by d has w = -p d.
double traction_work(const JForm& form, const std::vector<FaceWork>& from_crossing_to_tip);

/// A piece of a closed crack inside the contour.
struct FrictionSample {
  Vec2 from{0.0, 0.0}, to{0.0, 0.0};  ///< its ends, the second one nearer to the tip [m]
  double shear = 0.0;                 ///< stress of friction on its faces [Pa], of any sign
  double slip = 0.0;                  ///< by which the slip at its two ends differs [m], of any sign

  Vec2 middle() const { return 0.5 * (from + to); }
};

/// sum |shear| |change of slip|: to take off J [J/m^2], like traction_work().
double friction_work(const JForm& form, const std::vector<FrictionSample>& samples);

}  // namespace mpm
