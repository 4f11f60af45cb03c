#include "mpm/material/initial_state.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "mpm/math/dimension.hpp"
#include "mpm/math/principal.hpp"

namespace mpm {
namespace {

constexpr double kUnlimited = 1e30;  // [s]
constexpr double kChange = 1e-6;     // change of a logarithmic stretch for differences
constexpr double kLargest = 0.5;     // change of a logarithmic stretch in one step of Newton's method
constexpr int kSteps = 100;
constexpr double kSame = 1e-9;        // part of the largest component below which stresses are equal
constexpr double kRoundOff = 1e-14;   // part of the stiffness below which they are: the last digit of a stretch
constexpr double kCompatible = 1e-6;  // as kSame, for a stress along y from the scene

struct PoissonRatio {
  template <class Definition>
  auto operator()(const Definition& d) const -> decltype(d.elasticity, std::optional<double>()) {
    return d.elasticity.poisson;
  }
  std::optional<double> operator()(const NewtonianFluidDefinition&) const { return std::nullopt; }
  std::optional<double> operator()(const IdealGasDefinition&) const { return std::nullopt; }
  std::optional<double> operator()(const JohnsonCookDefinition&) const { return std::nullopt; }
  std::optional<double> operator()(const NorSandDefinition& d) const { return d.poisson; }
  std::optional<double> operator()(const CamClayDefinition& d) const {
    if (d.shear_modulus == 0.0) return d.poisson;
    return std::nullopt;
  }
};

double largest(const Symmetric3<double>& s) {
  double most = 0.0;
  for (const double c : {s.xx, s.yy, s.zz, s.yz, s.xz, s.xy}) most = std::max(most, std::abs(c));
  return most;
}

/// Largest component of the difference.
double distance(const Symmetric3<double>& a, const Symmetric3<double>& b) {
  return largest(sum(a, scale_shift(b, -1.0, 0.0)));
}

std::string text(const Symmetric3<double>& s) {
  return fmt::format("xx {:.4g}, yy {:.4g}, zz {:.4g}, yz {:.4g}, xz {:.4g}, xy {:.4g} Pa", s.xx, s.yy, s.zz, s.yz,
                     s.xz, s.xy);
}

bool finite(const Symmetric3<double>& s) { return std::isfinite(s.xx + s.yy + s.zz + s.yz + s.xz + s.xy); }

/// Axes along which the material can strain. In principal axes they are the first ones.
int free_axes(GeometryKind geometry) {
  const bool across = geometry == GeometryKind::plane_stress || axisymmetric(geometry);
  return across ? 3 : dimensions(geometry);
}

Matrix3<double> dilatation(double j, GeometryKind geometry) {
  const int axes = free_axes(geometry);
  if (axes == 3) return Solid::dilatation(j);
  const double edge = axes == 1 ? j : std::sqrt(j);
  return {edge, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, axes == 1 ? 1.0 : edge};
}

/// Principal values and axes; in two dimensions those in the x-z plane, then y.
Principal<double> principal_axes(const Symmetric3<double>& s, GeometryKind geometry) {
  return free_axes(geometry) == 3 ? principal(s) : principal(SymmetricPlane<double>{s.xx, s.zz, s.xz, s.yy});
}

Matrix3<double> stretch(const Principal<double>& axes) {
  const Symmetric3<double> v = compose(axes, Symmetric3<double>{});
  return {v.xx, v.xy, v.xz, v.xy, v.yy, v.yz, v.xz, v.yz, v.zz};
}

}  // namespace

InitialStates::InitialStates(const MaterialDefinition& material, GeometryKind geometry)
    : material_(material), law_(make_law(material)), geometry_(geometry) {
  const double speed =
      std::visit([&](const auto& law) { return law.wave_speed(Matrix3<double>::identity(), relaxed({}), 1.0); }, law_);
  least_ = kRoundOff * material.density * speed * speed;
}

void InitialStates::refuse(const std::string& why) const {
  throw InitialStateError(fmt::format("material '{}' ({}) {}", material_.name, law_name(material_.law), why));
}

int InitialStates::hardening_index() const {
  return std::visit([](const auto& law) { return law.kHardening; }, law_);
}

int InitialStates::temperature_index() const {
  return std::visit([](const auto& law) { return law.kTemperature; }, law_);
}

bool InitialStates::yy_is_bound() const {
  return geometry_ == GeometryKind::plane_strain && traits_of(law_).stress_from == StressSource::deformation;
}

Symmetric3<double> InitialStates::relaxed(const InitialState& state) const {
  return std::visit(
      [&](const auto& law) {
        std::array<double, std::decay_t<decltype(law)>::kHistory + 1> scalars{};
        if constexpr (std::decay_t<decltype(law)>::kTemperature >= 0) {
          scalars[law.kTemperature] = state.temperature_excess;
        }
        if constexpr (std::decay_t<decltype(law)>::kHardening >= 0) scalars[law.kHardening] = state.hardening;
        const Matrix3<double> none{}, same = Matrix3<double>::identity();
        const double j = state.j();
        Symmetric3<double> tau = state.tau;
        law.update(Increment<double, Matrix3<double>>{none, same, state.f, j, j, kUnlimited}, tau, scalars.data());
        return tau;
      },
      law_);
}

Symmetric3<double> InitialStates::cauchy_of(const InitialState& state) const {
  return scale_shift(relaxed(state), material_.density / state.j(), 0.0);
}

InitialState InitialStates::find(const InitialRequest& request) const {
  InitialState state;
  if (request.temperature) {
    if (temperature_index() < 0) refuse("has no temperature; leave it out");
    if (!(*request.temperature > 0.0) || !std::isfinite(*request.temperature)) {
      refuse(fmt::format("cannot start at {:g} K; a temperature is absolute and positive", *request.temperature));
    }
    state.temperature_excess =
        *request.temperature - std::visit([](const auto& law) { return law.reference_temperature(); }, law_);
  }
  if (!request.cauchy) {
    state.tau = relaxed(state);
    return state;
  }
  Symmetric3<double> cauchy = *request.cauchy;
  if (!finite(cauchy)) refuse(fmt::format("cannot start under a stress that is not finite: {}", text(cauchy)));
  if (geometry_ == GeometryKind::plane_stress && cauchy.yy != 0.0) {
    refuse(fmt::format("cannot have yy = {:.6g} Pa in plane stress, which has none; leave yy out", cauchy.yy));
  }
  const StressSource source = traits_of(law_).stress_from;
  // A locked axis has no strain relative to the state without stress; a fluid has the same pressure in all directions.
  const double ratio = std::visit(PoissonRatio(), material_.law).value_or(0.5);
  const bool follows =
      geometry_ == GeometryKind::line || (geometry_ == GeometryKind::plane_strain && request.yy_follows);
  if (geometry_ == GeometryKind::line) {
    const double across = ratio / (1.0 - ratio) * cauchy.xx;
    cauchy = {cauchy.xx, across, across, 0.0, 0.0, 0.0};
  } else if (follows && source != StressSource::deformation) {
    cauchy.yy = ratio * (cauchy.xx + cauchy.zz);
  }
  switch (source) {
    case StressSource::stress:
      state.tau = scale_shift(cauchy, 1.0 / material_.density, 0.0);
      state.hardening = std::visit([&](const auto& law) { return law.initial_hardening(cauchy); }, law_);
      break;
    case StressSource::volume_and_stress:
    case StressSource::volume:
      state = volume_for(cauchy, state.temperature_excess);
      break;
    case StressSource::deformation:
      state = stretch_for(cauchy, follows);
      cauchy = cauchy_of(state);
      break;
  }
  const Symmetric3<double> carried = cauchy_of(state);
  if (!(distance(carried, cauchy) <= kSame * largest(cauchy) + least_)) {
    if (source == StressSource::volume) {
      refuse(fmt::format("is a fluid and carries pressure alone at rest, not {}; write equal xx, yy and zz",
                         text(cauchy)));
    }
    refuse(
        fmt::format("cannot carry the stress {}: it is outside its yield surface, which would leave {}; lower the "
                    "difference of its components, bring k0 nearer to 1, or give the material more strength",
                    text(cauchy), text(carried)));
  }
  state.tau = relaxed(state);
  return state;
}

bool InitialStates::carries(const Symmetric3<double>& cauchy) const {
  try {
    find({cauchy, yy_is_bound(), std::nullopt});
  } catch (const InitialStateError&) {
    return false;
  }
  return true;
}

// Mean stress rises with ln J in every law. The difference is taken towards the root: without tension a fluid's
// pressure has a corner at J = 1.
InitialState InitialStates::volume_for(const Symmetric3<double>& cauchy, double excess) const {
  const double target = trace(cauchy) / 3.0;
  const auto at = [&](double e) {
    InitialState state;
    state.f = dilatation(std::exp(e), geometry_);
    state.tau = scale_shift(cauchy, std::exp(e) / material_.density, 0.0);
    state.temperature_excess = excess;
    return state;
  };
  const auto miss = [&](double e) { return trace(cauchy_of(at(e))) / 3.0 - target; };
  double e = 0.0, error = miss(e);
  for (int step = 0; step < kSteps && error != 0.0; ++step) {
    const double change = error > 0.0 ? -kChange : kChange;
    const double slope = (miss(e + change) - error) / change;
    if (!(slope > 0.0)) break;
    e += std::clamp(-error / slope, -kLargest, kLargest);
    const double next = miss(e);
    if (std::abs(next) >= std::abs(error) && std::abs(next) <= kSame * std::abs(target) + least_) break;  // round-off
    error = next;
  }
  if (!(std::abs(miss(e)) <= kSame * std::abs(target) + least_)) {
    refuse(fmt::format("has no volume at which its mean stress is {:.4g} Pa; give a stress that it can carry", target));
  }
  return at(e);
}

InitialState InitialStates::stretch_for(const Symmetric3<double>& cauchy, bool yy_follows) const {
  const Principal<double> axes = principal_axes(cauchy, geometry_);
  const int unknowns = free_axes(geometry_);
  using Vector = Eigen::Vector3d;
  const Vector target(axes.value[0], axes.value[1], axes.value[2]);
  const auto principal_stress = [&](const Vector& e) {
    InitialState state;
    state.f = {std::exp(e[0]), 0.0, 0.0, 0.0, std::exp(e[1]), 0.0, 0.0, 0.0, std::exp(e[2])};
    const Symmetric3<double> s = cauchy_of(state);
    return Vector(s.xx, s.yy, s.zz);
  };
  const auto size = [unknowns](const Vector& v) { return v.head(unknowns).cwiseAbs().maxCoeff(); };
  Vector e = Vector::Zero(), error = principal_stress(e) - target;
  for (int step = 0; step < kSteps && size(error) > 0.0; ++step) {
    Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
    for (int k = 0; k < unknowns; ++k) {
      const Vector change = kChange * Vector::Unit(k);
      slope.col(k) = (principal_stress(e + change) - principal_stress(e - change)) / (2.0 * kChange);
    }
    const Eigen::MatrixXd part = slope.topLeftCorner(unknowns, unknowns);
    Vector correction = Vector::Zero();
    correction.head(unknowns) = -part.fullPivLu().solve(error.head(unknowns));
    if (const double most = size(correction); most > kLargest) correction *= kLargest / most;
    e += correction;
    const Vector next = principal_stress(e) - target;
    const bool stuck = size(next) >= size(error) && size(next) <= kSame * size(target) + least_;
    error = next;
    if (stuck) break;  // round-off
  }
  if (!(size(error) <= kSame * size(target) + least_)) {
    refuse(fmt::format("has no stretch under which its stress is {}; give a smaller stress or a stiffer material",
                       text(cauchy)));
  }
  if (geometry_ == GeometryKind::plane_strain && !yy_follows) {
    const double yy = principal_stress(e)[2];
    if (!(std::abs(yy - cauchy.yy) <= kCompatible * std::max(largest(cauchy), std::abs(yy)))) {
      refuse(
          fmt::format("cannot have yy = {:.6g} Pa in plane strain: with the other components it is {:.6g} Pa; leave yy "
                      "out",
                      cauchy.yy, yy));
    }
  }
  Principal<double> stretches = axes;
  for (int k = 0; k < 3; ++k) stretches.value[k] = std::exp(e[k]);
  InitialState state;
  state.f = stretch(stretches);
  return state;
}

std::optional<double> pressure_at_rest(const LawDefinition& law) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&law)) return 1.0 - std::sin(soil->friction_angle);
  if (const auto* soil = std::get_if<MohrCoulombDefinition>(&law)) return 1.0 - std::sin(soil->friction_angle);
  if (const auto* grain = std::get_if<MuIDefinition>(&law)) return 1.0 - grain->static_friction;
  if (const auto* clay = std::get_if<CamClayDefinition>(&law)) {
    const double sine = 3.0 * clay->slope / (6.0 + clay->slope);
    return (1.0 - sine) * std::pow(std::max(clay->overconsolidation, 1.0), sine);
  }
  if (const auto* sand = std::get_if<NorSandDefinition>(&law)) {
    const double sine = 3.0 * sand->slope / (6.0 + sand->slope);
    return (1.0 - sine) * std::pow(sand->overconsolidation, sine);
  }
  if (std::holds_alternative<IdealGasDefinition>(law)) return std::nullopt;
  const std::optional<double> poisson = std::visit(PoissonRatio(), law);
  return poisson ? *poisson / (1.0 - *poisson) : 1.0;
}

}  // namespace mpm
