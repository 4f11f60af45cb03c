// Drives a material along a path (strain_path.hpp). Strains of stress-controlled components are solved for at every
// step by Newton's method on copies of the point, with a numerical tangent.
//
//   PathDriver driver(material);
//   for (const Leg& leg : make_strain_path("triaxial", {})) driver.run(leg, [&] { print(driver.point().cauchy()); });
#pragma once

#include <functional>

#include "mpm/material/material_point.hpp"
#include "mpm/material/strain_path.hpp"

namespace mpm {

/// Thrown when the law fails: a stress that the material cannot carry, a value that is not finite, J <= 0.
class PathFailure : public Error {
 public:
  using Error::Error;
};

class PathDriver {
 public:
  /// Starts at rest at time 0. @throws MaterialError
  explicit PathDriver(const MaterialDefinition& material);

  /// Calls `after_step` at the end of every step. @throws PathError, PathFailure
  void run(const Leg& leg, const std::function<void()>& after_step = {});

  /// From the next leg on no water leaves the pores, and stresses are total (MaterialPoint::close_pores).
  void close_pores(double biot, double modulus) { point_.close_pores(biot, modulus); }

  const MaterialPoint& point() const { return point_; }
  double time() const { return time_; }                 ///< [s]
  const Components& strain() const { return strain_; }  ///< integral of the rate of deformation
  /// ln V of the whole deformation since the start.
  Symmetric3<double> logarithmic_strain() const;
  double work() const { return work_; }  ///< work done on the material since the start [J/kg]

 private:
  struct Progress;
  struct Step;
  /// Advances to the part `share` of the leg, in one step or in halves.
  void advance_to(Progress& progress, double share, int divisions);
  MaterialPoint advanced(const Step& step, const Components& increment) const;
  /// Returns false when the required stresses were not reached; `increment` is then the nearest found.
  bool solve(const Step& step, Components& increment) const;
  void accept(const Step& step, const Components& increment);
  [[noreturn]] void give_up(const Step& step, const Components& increment) const;

  MaterialPoint point_;
  double density_;
  double modulus_;  ///< modulus of the fastest wave at the start [Pa]: the scale below which a stress is round-off
  Matrix3<double> f_ = Matrix3<double>::identity();
  double time_ = 0.0;
  double work_ = 0.0;
  Components strain_{};
  Components last_{};  ///< increment of the last step, where Newton's method starts from
};

/// The components in the order of kComponentNames.
inline Components components(const Symmetric3<double>& s) { return {s.xx, s.yy, s.zz, s.yz, s.xz, s.xy}; }

}  // namespace mpm
