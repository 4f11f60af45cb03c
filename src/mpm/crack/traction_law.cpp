#include "mpm/crack/traction_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/crack/crack_error.hpp"
#include "opening_path.hpp"

namespace mpm {
namespace {

TractionKind shape_of(const TractionLawDefinition& definition) {
  if (definition.kind == TractionKind::coupled) return TractionKind::triangular;
  return definition.kind == TractionKind::mixed ? definition.curve : definition.kind;
}

FaceOpening when_open(const FaceOpening& opening) { return {std::max(opening.normal, 0.0), opening.shear}; }

}  // namespace

TractionLaw::TractionLaw(TractionLawDefinition definition) : definition_(std::move(definition)) {
  const TractionMode* const modes[2] = {&definition_.normal, &definition_.shear};
  const std::string place = definition_.where.empty() ? "" : definition_.where + ": ";
  for (int i = 0; i < 2; ++i) {
    try {
      if (has_curves()) curve_[i] = TractionCurve(shape_of(definition_), *modes[i]);
      if (definition_.kind == TractionKind::linear &&
          !(modes[i]->stiffness >= 0.0 && std::isfinite(modes[i]->stiffness))) {
        throw CrackError("the stiffness of a linear traction law must be 0 or more, and finite");
      }
    } catch (const CrackError& error) {
      throw CrackError(fmt::format("{}traction law '{}', {} direction: {}", place, definition_.name,
                                   i == 0 ? "normal" : "shear", error.what()));
    }
  }
  try {
    if (std::isnan(definition_.mix)) throw CrackError("the exponent of the rule of failure is not a number");
    if (definition_.kind == TractionKind::coupled) check_coupled();
  } catch (const CrackError& error) {
    throw CrackError(fmt::format("{}traction law '{}': {}", place, definition_.name, error.what()));
  }
}

bool TractionLaw::has_curves() const {
  return definition_.kind != TractionKind::linear && definition_.kind != TractionKind::pressure;
}

// Traction over opening, by direction, at openings that do not add to the damage.
std::array<double, 2> TractionLaw::secants(const TractionState& state) const {
  if (state.failed) return {0.0, 0.0};
  switch (definition_.kind) {
    case TractionKind::pressure:
      return {0.0, 0.0};
    case TractionKind::linear:
      return {definition_.normal.stiffness, definition_.shear.stiffness};
    case TractionKind::coupled: {
      const double factor = coupled_factor(state.damage);
      return {factor * curve_[0].stiffness(), factor * curve_[1].stiffness()};
    }
    case TractionKind::mixed:
      return {(1.0 - state.damage) * curve_[0].stiffness(), (1.0 - state.damage) * curve_[1].stiffness()};
    default:
      return {curve_[0].secant(state.largest[0]), curve_[1].secant(state.largest[1])};
  }
}

Traction TractionLaw::advance(double normal_opening, double shear_opening, double time, TractionState& state) const {
  if (!std::isfinite(normal_opening) || !std::isfinite(shear_opening)) {
    throw CrackError(fmt::format("traction law '{}': an opening of the crack is not finite", definition_.name));
  }
  const FaceOpening last = state.opening, now{normal_opening, shear_opening};
  const FaceOpening from = when_open(last), to = when_open(now);
  state.opening = now;
  if (state.failed) return state.traction = {};
  switch (definition_.kind) {
    case TractionKind::pressure:
      // A load that is on before the faces move: what it does is the present one times the way.
      state.traction = {normal_opening > definition_.least_opening || definition_.least_opening < 0.0
                            ? definition_.pressure(time)
                            : 0.0,
                        0.0};
      state.work += state.traction.normal * (now.normal - last.normal);
      break;
    case TractionKind::linear: {
      const std::array<double, 2> stiffness = secants(state);
      state.traction = traction_of(stiffness, to);
      state.work += traction_work(traction_of(stiffness, from), from, state.traction, to);
      break;
    }
    case TractionKind::coupled:
      advance_coupled(from, to, state);
      break;
    case TractionKind::mixed:
      advance_mixed(from, to, state);
      break;
    default:
      advance_decoupled(from, to, state);
  }
  return state.traction;
}

double TractionLaw::stored(const TractionState& state, double normal_opening, double shear_opening) const {
  const FaceOpening opening = when_open({normal_opening, shear_opening});
  const Traction traction = traction_of(secants(state), opening);
  return 0.5 * (traction.normal * opening.normal + traction.shear * opening.shear);
}

double TractionLaw::released(const TractionState& state) const {
  return state.dissipated[0] + state.dissipated[1] + state.freed;
}

double TractionLaw::face_work(const TractionState& state) const {
  if (definition_.kind != TractionKind::pressure) return state.work;
  return state.traction.normal * (state.opening.normal - std::max(definition_.least_opening, 0.0));
}

double TractionLaw::stiffness() const {
  const std::array<double, 2> fresh = secants({});
  return std::max(fresh[0], fresh[1]);
}

double TractionLaw::toughness(CrackMode mode) const {
  return has_curves() ? curve_[static_cast<int>(mode)].toughness() : std::numeric_limits<double>::infinity();
}

void serialise(StateArchive& archive, std::vector<TractionState>& states) {
  archive.rows("traction", states);
  archive.column("traction/largest_normal", states, [](TractionState& s) -> double& { return s.largest[0]; });
  archive.column("traction/largest_shear", states, [](TractionState& s) -> double& { return s.largest[1]; });
  archive.column("traction/damage", states, &TractionState::damage);
  archive.column("traction/dissipated_normal", states, [](TractionState& s) -> double& { return s.dissipated[0]; });
  archive.column("traction/dissipated_shear", states, [](TractionState& s) -> double& { return s.dissipated[1]; });
  archive.column("traction/freed", states, &TractionState::freed);
  archive.column("traction/work", states, &TractionState::work);
  archive.column("traction/opening_normal", states, [](TractionState& s) -> double& { return s.opening.normal; });
  archive.column("traction/opening_shear", states, [](TractionState& s) -> double& { return s.opening.shear; });
  archive.column("traction/normal", states, [](TractionState& s) -> double& { return s.traction.normal; });
  archive.column("traction/shear", states, [](TractionState& s) -> double& { return s.traction.shear; });
  archive.column("traction/failed", states, &TractionState::failed);
}

}  // namespace mpm
