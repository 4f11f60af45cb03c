// Exact limit loads of soil and clay, and bounds where no exact value is known: what the suite of forces on tools is
// held against.
//
// A limit load is exact for a rigid-plastic material that flows associatedly (dilation = friction; of clay: at constant
// volume). Without associated flow it is an upper bound for any stress field that ends in the same mechanism
// (Radenkovic (1961)), and Davis's reduced friction gives the usual estimate. Weak: geometry that changes on the way
// is in none of them but swept_soil_growth(). Angles are in radians, forces for one metre across the
// plane.
#pragma once

namespace mpm::study {

/// Two values between which the truth lies; equal where it is known.
struct Bounds {
  double lower = 0.0, upper = 0.0;
};

/// K_p = tan^2(45 + phi/2), K_a = 1 / K_p: horizontal over vertical stress of soil that yields. Rankine (1857).
double passive_coefficient(double friction);
double active_coefficient(double friction);
/// K_p of a vertical wall as rough as the soil: the part of the force across the wall over 1/2 rho g d^2. Lower bound:
/// Lancellotta (2002), Geotechnique 52(8), 617-619. Upper: the least moment balance of a block between the wall and a
/// log spiral, the wall's force at a third of its height, Terzaghi (1943), Theoretical Soil Mechanics.
/// @param friction in (0, 45 degrees]
Bounds rough_wall_coefficient(double friction);
/// Growth of the force on a blade with its travel over its depth, as a part of the force at the start: the soil that
/// the blade has swept, depth times travel, lies as a heap before it on what it pushes. Smooth: 2 tan(45 - phi/2),
/// exact to the first order: the force is tan(45 + phi/2) times the weight above the plane from the edge at
/// 45 - phi/2, to which the swept soil is added, and that plane is the one of the least force. Rough: the moment of a
/// heap, as high in each place as the block of rough_wall_coefficient() rises there, over that of the block.
double swept_soil_growth(double friction, bool rough);

/// N_q = e^(pi tan phi) K_p and N_c = (N_q - 1) cot phi (2 + pi for phi = 0) of a strip, smooth or rough, on weightless
/// soil. Prandtl (1921), Reissner (1924).
double bearing_surcharge_factor(double friction);
double bearing_cohesion_factor(double friction);
/// N_gamma of a strip on soil with weight: force / (1/2 rho g B^2). Of 20, 30 and 40 degrees alone. C. M. Martin
/// (2005), Exact bearing capacity calculations using the method of characteristics, Proc. 11th IACMAG, Turin.
/// @throws StudyError for another angle
double bearing_weight_factor(double friction, bool rough);

/// Circular footing on clay: mean pressure over cohesion, 5.69 smooth (Shield (1955)) and 6.05 rough (Eason & Shield
/// (1960)).
double circular_footing_factor(bool rough);
/// A long cylinder pressed sideways through clay: force / (c D length), pi + 2 Delta + 2 cos(Delta) +
/// 4 (cos(Delta/2) + sin(Delta/2)) with sin(Delta) = adhesion / cohesion: 9.14 smooth to 11.94 rough. Exact when rough;
/// a lower bound, within 9 % when smooth. Randolph & Houlsby (1984), Geotechnique 34(4), 613-623; Martin & Randolph
/// (2006), Geotechnique 56(2), 141-145.
double lateral_pile_factor(double adhesion_over_cohesion);
/// rho g H / c up to which a vertical cut in clay stands: the best bounds of limit analysis. Pastor, Thai & Francescato
/// (2009), Int. J. Numer. Meth. Engng 77, 1488-1502. Taylor's circle gives 3.83.
Bounds vertical_cut_number();

/// A smooth wedge pressed into a rigid-plastic solid of shear strength k, which piles up beside it.
struct WedgeIndentation {
  double fan = 0.0;       ///< angle of the fan of slip lines, the root of cos(2 beta - fan) = cos(fan) / (1 + sin(fan))
  double pressure = 0.0;  ///< on the faces, over k: 2 (1 + fan)
  double contact = 0.0;   ///< length of a face that touches, over the depth of the tip
  double force = 0.0;     ///< over k and the depth of the tip, for a metre
};
/// Hill, Lee & Tupper (1947), Proc. R. Soc. A 188, 273-289. @param half_angle beta at the tip, in (0, 90 degrees)
WedgeIndentation wedge_indentation(double half_angle);

/// tan phi* = cos(psi) sin(phi) / (1 - sin(psi) sin(phi)): the friction with which associated flow has about the limit
/// load of soil with friction phi and dilation psi. An estimate: without associated flow the limit load is not unique.
/// Davis (1968), in Soil Mechanics: Selected Topics.
double davis_friction(double friction, double dilation);

/// Horizontal pressure on the walls of a silo between two parallel walls `width` apart, over rho g width, at `depth`
/// over width below the surface: (1 - exp(-2 mu K depth)) / (2 mu). Janssen (1895), with the ratio K of horizontal to
/// vertical stress and friction mu on the walls.
double silo_wall_pressure(double depth_over_width, double friction_coefficient, double stress_ratio);
/// Acceleration of a cohesionless layer down a slope, over g: sin(slope) - cos(slope) tan(friction), 0 where it stands.
double slope_acceleration(double slope, double friction);

}  // namespace mpm::study
