// Criteria of growth as functions of numbers: the angle at which a crack turns, and how much of the material's
// toughness is used up. Angles are counter-clockwise from the tip's direction [rad], between -pi and pi.
// All but the elliptical one are written for the leading terms of the field at the tip; in shear the kink of largest
// energy release lies at 75.6 degrees then, not at the 70.5 of the hoop stress.
// Source: crack reference 5.2; Erdogan and Sih (1963); Sih (1974), Strain energy density factor.
#pragma once

#include <string>

#include "mpm/crack/fracture_definition.hpp"
#include "mpm/crack/stress_intensity.hpp"

namespace mpm {

/// Angle of the largest hoop stress, on the side where the shear opens. It depends on the ratio of the two numbers, so
/// that openings can stand for K. Above 70.53 degrees where `one` is negative. 0 for two zeros.
double hoop_angle(double one, double two);
/// The hoop stress at that angle, as the K_I that has it without shear [Pa sqrt(m)].
double hoop_equivalent(const StressIntensity& k);

/// Angle at which the density of strain energy has its minimum, with angle K_II <= 0: the first minimum from 0 on, for
/// the energy also falls towards the crack's faces. A negative K_I is taken for 0, as faces that touch carry it. For
/// Kolosov's constant below 3 (a Poisson's ratio above 0) there is one minimum, within acos((kappa - 1) / 6).
double density_angle(double one, double two, double kappa);
/// The density at that angle, as the K_I that has it without shear [Pa sqrt(m)]; kappa is above 1.
double density_equivalent(const StressIntensity& k, double kappa);

/// (K_I / K_Ic)^p + (|K_II| / K_IIc)^q, which is 1 on the ellipse; a negative K_I counts as 0.
double elliptical_measure(const StressIntensity& k, const FractureConstants& constants);

/// Reason why the rule cannot be applied with these constants: one sentence that names what is missing and the remedy;
/// empty if nothing is. `elastic`: null for a material that is not isotropic and elastic, for which there is no K.
/// `alternate`: whether the rule is the second one.
std::string criterion_fault(const GrowthRule& rule, const FractureConstants& constants, const ElasticConstants* elastic,
                            bool alternate = false);

/// True if the criterion compares stress intensities; they exist for isotropic elastic materials only.
bool needs_stress_intensity(FractureCriterion criterion);

}  // namespace mpm
