// The table of features that do not go together: each of its rows refuses a scene that has both, no other pair is
// refused by it, and doc/features.md shows it. 0.3 s.
#include "mpm/simulation/feature_rules.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "mpm/math/build_info.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace feature_rules_test {

RigidBodyDefinition& add_body(SimulationDefinition& d) {
  d.rigid_bodies.emplace_back();
  d.rigid_bodies.back().name = "blade";
  return d.rigid_bodies.back();
}

/// Gives a definition the feature.
void add(Feature feature, SimulationDefinition& d) {
  switch (feature) {
    case Feature::absorbing_faces:
      d.walls[1].kind = WallKind::absorbing;
      break;
    case Feature::average_dilatation:
      d.method.average_dilatation = true;
      break;
    case Feature::average_stress:
      d.method.average_stress = true;
      break;
    case Feature::conditions:
      d.conditions.emplace_back();
      break;
    case Feature::contact_at_nodes:
      d.contact.method = ContactMethod::nodes;
      break;
    case Feature::contact_at_points:
      d.contact.method = ContactMethod::points;
      add_body(d).sides = Sides::one;
      break;
    case Feature::cracks:
      d.cracks.list.emplace_back();
      break;
    case Feature::divided_bodies:
      add_body(d).divides = {"bed"};
      break;
    case Feature::free_bodies:
      add_body(d).free.emplace();
      break;
    case Feature::implicit_steps:
      d.method.update = UpdateScheme::implicit;
      break;
    case Feature::leaving:
      d.grid.leave_limit = 1;
      break;
    case Feature::line:
      d.geometry = GeometryKind::line;
      break;
    case Feature::loads:
      d.body_forces.emplace_back();
      break;
    case Feature::oblique_biot:
    case Feature::pore_pressure:
    case Feature::transport: {
      QuantityDefinition quantity;
      quantity.quantity = feature == Feature::transport ? Transported::temperature : Transported::pore_pressure;
      quantity.materials.emplace_back();
      quantity.materials[0].biot = Symmetric3<double>::isotropic(1.0);
      if (feature == Feature::oblique_biot) quantity.materials[0].biot.xx = 0.5;
      d.transport.quantities.push_back(quantity);
      break;
    }
    case Feature::particle_tools:
      add_body(d).particles = true;
      break;
    case Feature::periodic_axes:
      d.walls[4].kind = d.walls[5].kind = WallKind::periodic;
      break;
    case Feature::plane_stress:
      d.geometry = GeometryKind::plane_stress;
      break;
    case Feature::ranks:
      break;
    case Feature::sleep:
      if (!d.sleep) d.sleep.emplace();
      break;
    case Feature::sleep_damping:
      if (!d.sleep) d.sleep.emplace();
      d.sleep->damping = 0.5;
      break;
    case Feature::solid:
      d.geometry = GeometryKind::solid;
      break;
    case Feature::thin_tools:
      add_body(d).sides = Sides::two;
      break;
  }
}

/// A definition with these features and what they bring.
SimulationDefinition with(const std::vector<Feature>& features) {
  SimulationDefinition d;
  d.geometry = GeometryKind::plane_strain;
  d.contact.method = ContactMethod::points;
  for (const Feature feature : features) add(feature, d);
  return d;
}

int processes(const std::vector<Feature>& features) {
  return std::find(features.begin(), features.end(), Feature::ranks) == features.end() ? 1 : 2;
}

// A pair is refused if a row of the table has both, or has two of what the pair brings with it (tools bring contact at
// points, a Biot coefficient brings water in pores).
TEST(FeatureRules, RefuseTheirPairsAndNoOthers) {
  int refused = 0;
  for (int a = 0; a < kFeatures; ++a) {
    for (int b = a; b < kFeatures; ++b) {
      const std::vector<Feature> pair = {static_cast<Feature>(a), static_cast<Feature>(b)};
      const SimulationDefinition d = with(pair);
      bool expected = false;
      for (const FeatureRule& rule : feature_rules()) {
        expected = expected ||
                   (find_feature(rule.feature, d, processes(pair)) && find_feature(rule.beside, d, processes(pair)));
      }
      EXPECT_EQ(feature_fault(d, processes(pair)).has_value(), expected)
          << feature_name(pair[0]) << ", " << feature_name(pair[1]);
      refused += expected ? 1 : 0;
    }
  }
  EXPECT_GE(refused, static_cast<int>(feature_rules().size()));
}

TEST(FeatureRules, NameBothWhyAndWhatToDo) {
  for (const FeatureRule& rule : feature_rules()) {
    const std::vector<Feature> pair = {rule.feature, rule.beside};
    const auto fault = feature_fault(with(pair), processes(pair));
    ASSERT_TRUE(fault) << feature_name(rule.feature) << ", " << feature_name(rule.beside);
    for (const char* part : {feature_name(rule.feature), feature_name(rule.beside), rule.reason, rule.remedy}) {
      EXPECT_NE(fault->text.find(part), std::string::npos) << part << " in: " << fault->text;
    }
    EXPECT_EQ(fault->key, feature_key(rule.feature));
  }
}

// A Simulation asks the table for what is made in C++.
TEST(FeatureRules, HoldForDefinitionsMadeInCpp) {
  SimulationDefinition d = with({Feature::sleep, Feature::cracks});
  d.time.sync = 1'000'000;
  try {
    const Simulation run(std::move(d), {1});
    FAIL() << "accepted";
  } catch (const DefinitionError& error) {
    EXPECT_NE(std::string(error.what()).find("sleep and cracks do not go together"), std::string::npos) << error.what();
  }
}

TEST(FeatureRules, StandInThePage) {
  std::ifstream file(source_folder() + "/doc/features.md");
  std::stringstream page;
  page << file.rdbuf();
  const std::string text = page.str();
  std::size_t rows = 0;
  for (std::size_t at = 0; (at = text.find("\n| `", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, feature_rules().size()) << "rows of the table in doc/features.md";
  for (const FeatureRule& rule : feature_rules()) {
    const std::string row =
        fmt::format("| `{}`: {} | {} | {} | {} |\n", feature_key(rule.feature), feature_name(rule.feature),
                    feature_name(rule.beside), rule.reason, rule.remedy);
    EXPECT_NE(text.find(row), std::string::npos) << "doc/features.md lacks the row\n" << row;
  }
}

}  // namespace feature_rules_test
}  // namespace mpm
