// The law of the list that stands for all laws of users (add_user_law.hpp): it calls theirs, a particle at a time,
// through pointers.
#pragma once

#include <array>
#include <cstdint>

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
  double (*diffusivity)(const void* law, double j);
  double (*heat_fraction)(const void* law);
};

}  // namespace mpm_kernel

namespace mpm {

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
      if (!(lane(step.j_old, i) > ScalarOf<T>(0))) continue;  // no particle
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
      if (!(lane(j, i) > ScalarOf<T>(0))) continue;
      set_lane(speed, i, static_cast<ScalarOf<T>>(calls_.wave_speed(law_.data(), state(f, tau, j, i))));
    }
    return speed;
  }
  template <class T>
  T diffusivity(T j) const {
    T most(0);
    for (int i = 0; i < lane_count<T>; ++i) {
      if (!(lane(j, i) > ScalarOf<T>(0))) continue;
      set_lane(most, i, static_cast<ScalarOf<T>>(calls_.diffusivity(law_.data(), lane(j, i))));
    }
    return most;
  }
  double heat_fraction() const { return calls_.heat_fraction(law_.data()); }
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

}  // namespace mpm
