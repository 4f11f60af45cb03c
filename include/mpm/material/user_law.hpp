// A law of the user's own, which a program adds when it starts and scenes then name as any other. It is a class written
// as the library's laws are (law.hpp), so that it can move into the library as it is:
//
//   class Foam : public mpm::LawDefaults { … Foam(const mpm::UserLawDefinition& d, double density); … };
//   const bool added = mpm::add_user_law<Foam>("foam", {{"crush_pressure", "Pa"}});
//
//   materials: [{name: pad, density: 100, law: foam, young: 2 MPa, poisson: 0.1, crush_pressure: 40 kPa}]
//
// Every such law has young and poisson, its stiffness at small strain, by which walls that absorb waves, cracks and
// starts under stress know it. Weak: its functions are called a particle at a time through a pointer, in double
// precision, so that a step of it takes longer than one of a law of the list; it has no implicit steps; a fluid, a law
// with a temperature of its own, and one that finds its pressure from J alone have to stand in the list.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"

// The kernels are compiled for several instruction sets, with the namespace mpm under another name in each; what they
// call of a user's law is plain data and pointers, under one name in all.
namespace mpm_kernel {

constexpr int kUserHistory = 4;   ///< scalars of history that a user's law may have
constexpr int kUserBytes = 1024;  ///< size that its object may have

/// Arguments of a user's law for one particle; tensors as Matrix3 and Symmetric3 of mpm/math/tensor.hpp.
struct UserPoint {
  double du[9], df[9], f[9];
  double j_old, j, dt;
  double tau[6];
  double history[kUserHistory];
};

struct UserLawCalls {
  void (*update)(const void* law, UserPoint& point);
  double (*elastic_energy)(const void* law, const UserPoint& point);
  double (*wave_speed)(const void* law, const UserPoint& point);
};

}  // namespace mpm_kernel

namespace mpm {

/// A key of a user's law beside young and poisson.
struct UserConstant {
  std::string key;
  std::string unit;  ///< unit such as "Pa", of the dimension that a scene has to give; empty: a plain number
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
};

/// The kinds added so far, in that order; they stay where they are.
const std::vector<const UserLawKind*>& user_laws();
/// @throws MaterialError for a name that a law has already, and for two constants of one key
bool add_user_law(UserLawKind kind);

/// The law of the closed list that stands for all laws of users.
class UserLaw : public LawDefaults {
 public:
  // Constants that the kernels have to know at compile time. The law's own traits are UserLawKind::traits.
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = mpm_kernel::kUserHistory;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kPlasticWork = 1;

  UserLaw(const UserLawDefinition& definition, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    for (int i = 0; i < lane_count<T>; ++i) {
      mpm_kernel::UserPoint point;
      put(lane(full(step.du), i), point.du);
      put(lane(full(step.df), i), point.df);
      put(lane(full(step.f), i), point.f);
      point.j_old = lane(step.j_old, i), point.j = lane(step.j, i), point.dt = lane(step.dt, i);
      put(lane(full(tau), i), point.tau);
      for (int h = 0; h < kHistory; ++h) point.history[h] = lane(history[h], i);
      calls_.update(law_.data(), point);
      set_stress(tau, i, point.tau);
      for (int h = 0; h < kHistory; ++h) set_lane(history[h], i, static_cast<ScalarOf<T>>(point.history[h]));
    }
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix& f, const Symmetric& tau, double j) const {
    return calls_.elastic_energy(law_.data(), state(f, tau, j, 0));
  }
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix& f, const Symmetric& tau, T j) const {
    T speed(0);
    for (int i = 0; i < lane_count<T>; ++i) {
      set_lane(speed, i, static_cast<ScalarOf<T>>(calls_.wave_speed(law_.data(), state(f, tau, j, i))));
    }
    return speed;
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const;
  double density() const { return density_; }
  const UserLawKind& kind() const { return *kind_; }

 private:
  template <class T>
  static void put(const Matrix3<T>& m, double (&to)[9]) {
    const double rows[] = {m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz};
    for (int c = 0; c < 9; ++c) to[c] = rows[c];
  }
  template <class T>
  static void put(const Symmetric3<T>& s, double (&to)[6]) {
    const double parts[] = {s.xx, s.yy, s.zz, s.yz, s.xz, s.xy};
    for (int c = 0; c < 6; ++c) to[c] = parts[c];
  }
  template <class T, class Matrix, class Symmetric>
  static mpm_kernel::UserPoint state(const Matrix& f, const Symmetric& tau, T j, int i) {
    mpm_kernel::UserPoint point{};
    put(lane(full(f), i), point.f);
    put(lane(full(tau), i), point.tau);
    point.j = lane(j, i);
    return point;
  }
  template <class T>
  static void set_stress(Symmetric3<T>& s, int i, const double (&from)[6]) {
    using Number = ScalarOf<T>;
    set_lane(
        s, i,
        Symmetric3<Number>{static_cast<Number>(from[0]), static_cast<Number>(from[1]), static_cast<Number>(from[2]),
                           static_cast<Number>(from[3]), static_cast<Number>(from[4]), static_cast<Number>(from[5])});
  }
  template <class T>
  static void set_stress(SymmetricPlane<T>& s, int i, const double (&from)[6]) {
    set_lane(s.xx, i, static_cast<ScalarOf<T>>(from[0]));
    set_lane(s.yy, i, static_cast<ScalarOf<T>>(from[1]));
    set_lane(s.zz, i, static_cast<ScalarOf<T>>(from[2]));
    set_lane(s.xz, i, static_cast<ScalarOf<T>>(from[4]));
  }

  mpm_kernel::UserLawCalls calls_;
  const UserLawKind* kind_;
  double density_;
  alignas(16) std::array<std::uint8_t, mpm_kernel::kUserBytes> law_{};
};

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
  static_assert(Own::kHistory == 0 || (Own::kPlasticStrain == 0 && Own::kPlasticWork == 1),
                "history begins with the plastic strain and the plastic work; what has none leaves them at zero");

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
  static Symmetric3<double> elastic_strain(const void* law, const StressedPoint& at) {
    return own(law).elastic_strain(at);
  }
  static void make(const UserLawDefinition& definition, double density, void* place) {
    new (place) Own(definition, density);
  }
};

/// Adds a law under the name that scenes give to it. Returns true, so that it can be called before main().
/// @throws MaterialError as above
template <class Own>
bool add_user_law(const std::string& name, std::vector<UserConstant> constants) {
  using Of = UserLawOf<Own>;
  return add_user_law(UserLawKind{name,
                                  std::move(constants),
                                  kTraitsOf<Own>,
                                  {&Of::update, &Of::elastic_energy, &Of::wave_speed},
                                  &Of::elastic_strain,
                                  &Of::make});
}

}  // namespace mpm
