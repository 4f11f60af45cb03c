// A law of the user's own, which a program adds when it starts and scenes then name as any other. It is a class written
// as the library's laws are (law.hpp), so that it can move into the library as it is:
//
//   class Foam : public mpm::LawDefaults { … Foam(const mpm::UserLawDefinition& d, double density); … };
//   const bool added = mpm::add_user_law<Foam>("foam", {{"crush_pressure", mpm::kPressure, mpm::kPositive}});
//
//   materials: [{name: pad, density: 100, law: foam, young: 2 MPa, poisson: 0.1, crush_pressure: 40 kPa}]
//
// Every such law has young and poisson, its stiffness at small strain, by which walls that absorb waves, cracks and
// starts under stress know it. Weak: its functions are called a particle at a time through a pointer, in double
// precision, so that a step of it takes longer than one of a law of the list; it has no implicit steps; a fluid, a law
// with a temperature of its own, and one that finds its pressure from J alone have to stand in the list.
// Its functions are called from several threads at once, and must not throw.
#pragma once

#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mpm/keys/key_table.hpp"
#include "mpm/material/user_law.hpp"

namespace mpm {

/// A key of a user's law beside young and poisson.
struct UserConstant {
  std::string key;
  Dimension dimension = {};
  Range range = {};
  std::optional<double> otherwise = {};  ///< value where the scene has none [SI]; empty: the key is needed
};

/// A law that a program has added.
struct UserLawKind {
  std::string name;
  std::vector<UserConstant> constants;
  LawTraits traits;
  mpm_kernel::UserLawCalls calls;
  Symmetric3<double> (*elastic_strain)(const void* law, const StressedPoint& at);
  /// Makes the object in `place`. @throws MaterialError
  void (*make)(const UserLawDefinition& definition, double density, void* place);
  KeyTable<UserLawDefinition> keys = KeyTable<UserLawDefinition>("");  ///< made by add_user_law()

  /// A definition with the values of keys that a scene may leave out.
  UserLawDefinition fresh() const;
};

/// The kinds added so far, in that order; they stay where they are.
const std::vector<const UserLawKind*>& user_laws();
/// @throws MaterialError for a name that a law has already, and for two constants of one key
bool add_user_law(UserLawKind kind);

/// The functions of a law as UserLawCalls has them.
template <class Own>
struct UserLawOf {
  static_assert(std::is_trivially_copyable_v<Own> && sizeof(Own) <= mpm_kernel::kUserBytes && alignof(Own) <= 16,
                "laws cross the border between instruction sets as bytes");
  static_assert(Own::kMatter == Matter::solid || Own::kMatter == Matter::soil, "a fluid stands in the list of laws");
  static_assert(!Own::kForgetsShape && Own::kTemperature < 0 && Own::kHardening < 0 &&
                    !finds_pressure(Own::kStressFrom),
                "such a law stands in the list of laws");
  static_assert(Own::kImplicit == ImplicitSteps::refused, "implicit steps know the laws of the list alone");
  static_assert(Own::kHistory <= mpm_kernel::kUserHistory);
  static_assert(Own::kPlasticStrain < 0 || (Own::kPlasticStrain == 0 && Own::kPlasticWork == 1),
                "history begins with the plastic strain and the plastic work; what has none leaves these two at zero");
  static_assert(!Own::kAveragesStress || (Own::kPlasticStrain == 0 && Own::kStressFrom == StressSource::stress),
                "what shares its stress has a plastic strain and advances the stress that it had");
  static_assert(Own::kPlasticStrain < 0 ||
                    !std::is_same_v<decltype(&Own::elastic_strain), decltype(&LawDefaults::elastic_strain)>,
                "a law that flows tells the elastic part of its strain");

  static const Own& own(const void* law) { return *static_cast<const Own*>(law); }
  static Matrix3<double> matrix(const double (&m)[9]) { return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]}; }
  static Symmetric3<double> symmetric(const double (&s)[6]) { return {s[0], s[1], s[2], s[3], s[4], s[5]}; }

  static void update(const void* law, mpm_kernel::UserPoint& point) {
    const Matrix3<double> du = matrix(point.du), df = matrix(point.df), f = matrix(point.f);
    Symmetric3<double> tau = symmetric(point.tau);
    own(law).update(Increment<double, Matrix3<double>>{du, df, f, point.j_old, point.j, point.dt}, tau, point.history);
    const double parts[] = {tau.xx, tau.yy, tau.zz, tau.yz, tau.xz, tau.xy};
    for (int c = 0; c < 6; ++c) point.tau[c] = parts[c];
  }
  static double elastic_energy(const void* law, const mpm_kernel::UserPoint& point) {
    return own(law).elastic_energy(matrix(point.f), symmetric(point.tau), point.j);
  }
  static double wave_speed(const void* law, const mpm_kernel::UserPoint& point) {
    return own(law).wave_speed(matrix(point.f), symmetric(point.tau), point.j);
  }
  static double diffusivity(const void* law, double j) { return own(law).diffusivity(j); }
  static double heat_fraction(const void* law) { return own(law).heat_fraction(); }
  static Symmetric3<double> elastic_strain(const void* law, const StressedPoint& at) {
    return own(law).elastic_strain(at);
  }
  static void make(const UserLawDefinition& definition, double density, void* place) {
    new (place) Own(definition, density);
  }
};

inline LawTraits traits_of_user(LawTraits traits) {
  traits.listed = false;
  return traits;
}

/// Adds a law under the name that scenes give to it. Returns true, so that it can be called before main().
/// @throws MaterialError as above
template <class Own>
bool add_user_law(const std::string& name, std::vector<UserConstant> constants) {
  using Of = UserLawOf<Own>;
  return add_user_law(
      UserLawKind{name,
                  std::move(constants),
                  traits_of_user(kTraitsOf<Own>),
                  {&Of::update, &Of::elastic_energy, &Of::wave_speed, &Of::diffusivity, &Of::heat_fraction},
                  &Of::elastic_strain,
                  &Of::make});
}

}  // namespace mpm
