// The methods that the atlas compares: one list per question. A method that the solver refuses gives an empty column of
// a map, which is filled once the method exists.
#pragma once

#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"

namespace stability {

struct Method {
  std::string name;
  mpm::MethodDefinition definition;
};

/// Every shape function, with USAVG and FLIP unless said otherwise.
inline std::vector<Method> shapes(mpm::UpdateScheme update = mpm::UpdateScheme::usavg) {
  std::vector<Method> list;
  for (std::size_t i = 0; i < mpm::kShapeTraits.size(); ++i) {
    Method method{mpm::kShapeTraits[i].name, {}};
    method.definition.shape = static_cast<mpm::ShapeKind>(i);
    method.definition.update = update;
    list.push_back(method);
  }
  return list;
}

/// Every update, with FLIP.
inline std::vector<Method> updates(mpm::ShapeKind shape = mpm::ShapeKind::ugimp) {
  std::vector<Method> list;
  for (std::size_t i = 0; i < mpm::kUpdateNames.size(); ++i) {
    Method method{mpm::kUpdateNames[i], {}};
    method.definition.shape = shape;
    method.definition.update = static_cast<mpm::UpdateScheme>(i);
    list.push_back(method);
  }
  return list;
}

/// Every transfer: FLIP, a FLIP that mixes in a hundredth of PIC, PIC, XPIC and FMPM of low and higher order, APIC.
inline std::vector<Method> transfers(mpm::ShapeKind shape = mpm::ShapeKind::ugimp,
                                     mpm::UpdateScheme update = mpm::UpdateScheme::usavg) {
  using Kind = mpm::TransferKind;
  const std::vector<std::pair<std::string, mpm::Transfer>> named = {
      {"FLIP", {Kind::flip, 1.0, 2}},    {"FLIP 0.99", {Kind::flip, 0.99, 2}}, {"PIC", {Kind::flip, 0.0, 2}},
      {"XPIC(2)", {Kind::xpic, 1.0, 2}}, {"XPIC(5)", {Kind::xpic, 1.0, 5}},    {"FMPM(2)", {Kind::fmpm, 1.0, 2}},
      {"FMPM(5)", {Kind::fmpm, 1.0, 5}}, {"APIC", {Kind::apic, 1.0, 2}}};
  std::vector<Method> list;
  for (const auto& [name, transfer] : named) {
    Method method{name, {}};
    method.definition.shape = shape;
    method.definition.update = update;
    method.definition.transfer = transfer;
    list.push_back(method);
  }
  return list;
}

/// True if a simulation with this method can be made of the definition.
inline bool possible(mpm::SimulationDefinition definition, const mpm::MethodDefinition& method) {
  definition.method = method;
  try {
    mpm::Simulation(std::move(definition), {1});
    return true;
  } catch (const mpm::DefinitionError&) {
    return false;
  }
}

}  // namespace stability
