// Particles of one set as the mean stress of a cell sees them (mechanics/stress_average.hpp): which of them flow, and
// what they share. Numbers are double, whatever the precision of the particles. Functions are left to the caller, since
// those of the standard library are not a device's.
#pragma once

#include <array>
#include <cstdint>

#include "mpm/material/increment.hpp"
#include "mpm/math/dimension.hpp"

namespace mpm {

/// Storage of a stress: in a plane xx, zz, xz, yy.
template <class Geometry>
struct StoredStress {
  static constexpr int kCount = Geometry::kDim == 3 ? 6 : 4;
  static constexpr std::array<int, 3> kDiagonal =
      Geometry::kDim == 3 ? std::array<int, 3>{0, 1, 2} : std::array<int, 3>{0, 1, 3};

  static double mean(const double* s) { return (s[kDiagonal[0]] + s[kDiagonal[1]] + s[kDiagonal[2]]) / 3.0; }
  static auto symmetric(const double* s) {
    if constexpr (Geometry::kDim == 3) {
      return Symmetric3<double>{s[0], s[1], s[2], s[3], s[4], s[5]};
    } else {
      return SymmetricPlane<double>{s[0], s[1], s[2], s[3]};
    }
  }
};

/// Arrays of a set.
template <class T>
struct FlowingArrays {
  T* stress[6];           ///< Kirchhoff stress over initial density [J/kg]
  T* gradient[9];         ///< deformation gradient
  const T* strain;        ///< plastic strain now
  double* strain_before;  ///< plastic strain at the start of the step before
  double least_pressure;  ///< above which one of soil is under pressure [J/kg]
};

template <class Geometry, class T, class LawType>
class FlowingParticles {
  static_assert(LawType::kPlasticStrain >= 0, "what flows is known by its plastic strain");
  // Above round-off, which must not decide who takes part.
  static constexpr double kFlow = 1e-12;  ///< plastic strain in a step from which on a particle flows
  static constexpr int kRows = Geometry::kDim * Geometry::kDim;  ///< components along the grid's axes come first

 public:
  using Stored = StoredStress<Geometry>;
  static constexpr double kPressure = 1e-9;  ///< pressure over the stiffness of a wave from which on there is any

  explicit FlowingParticles(const FlowingArrays<T>& arrays) : arrays_(arrays) {}

  bool flows(std::uint32_t p) const {
    if (!(arrays_.strain[p] > arrays_.strain_before[p] + kFlow)) return false;
    if constexpr (finds_pressure(LawType::kStressFrom)) {
      return true;
    } else {
      double s[Stored::kCount];
      stress(p, s);
      return Stored::mean(s) < -arrays_.least_pressure;
    }
  }
  void remember(std::uint32_t p) const { arrays_.strain_before[p] = arrays_.strain[p]; }
  double volume_ratio(std::uint32_t p) const {
    return determinant(Geometry::load_matrix(Reader{arrays_.gradient}, static_cast<int>(p)));
  }
  void stress(std::uint32_t p, double (&s)[Stored::kCount]) const {
    for (int i = 0; i < Stored::kCount; ++i) s[i] = static_cast<double>(arrays_.stress[i][p]);
  }
  void set_stress(std::uint32_t p, const double (&s)[Stored::kCount]) const {
    for (int i = 0; i < Stored::kCount; ++i) arrays_.stress[i][p] = static_cast<T>(s[i]);
  }
  /// Scales the deformation along each of the grid's axes.
  void stretch(std::uint32_t p, double along) const {
    for (int i = 0; i < kRows; ++i) arrays_.gradient[i][p] = static_cast<T>(along * arrays_.gradient[i][p]);
  }

 private:
  struct Reader {
    T* const* arrays;
    struct Component {
      const T* from;
      double operator[](int p) const { return static_cast<double>(from[p]); }
    };
    Component operator[](int c) const { return {arrays[c]}; }
  };

  FlowingArrays<T> arrays_;
};

}  // namespace mpm
