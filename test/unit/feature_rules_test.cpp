// The table of features that do not go together: each of its rows refuses a scene that has both, no other pair is
// refused by it, and doc/features.md shows it. 0.3 s.
#include "mpm/rules/feature_rules.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
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
    case Feature::apic:
      d.method.transfer.kind = TransferKind::apic;
      break;
    case Feature::average_dilatation:
      d.method.average_dilatation = true;
      break;
    case Feature::average_stress:
      d.method.average_stress = true;
      break;
    case Feature::axisymmetric:
      d.geometry = GeometryKind::axisymmetric;
      break;
    case Feature::body_laws:
      d.contact.pairs.emplace_back();
      d.contact.pairs.back().second = "bed";
      break;
    case Feature::conditions:
      d.conditions.emplace_back();
      break;
    case Feature::conditions_beside_contact:
      d.conditions.emplace_back();
      add_body(d);
      break;
    case Feature::contact_at_nodes:
      d.contact.method = ContactMethod::nodes;
      break;
    case Feature::cracks:
      d.cracks.list.emplace_back();
      break;
    case Feature::collisions:
      add_body(d).collide.emplace();
      break;
    case Feature::cut_particles:
      d.bodies[0].parts = {0.5};
      break;
    case Feature::damping:
      d.method.damping.grid = Function(1.0);
      d.method.damping.in_force = true;
      break;
    case Feature::damping_of_place:
      d.method.damping.grid = Function::parse("x");
      d.method.damping.in_force = true;
      break;
    case Feature::device:
    case Feature::ranks:
      break;  // a run has them, not a definition
    case Feature::divided_bodies:
      add_body(d).divides = {"bed"};
      break;
    case Feature::following_ground:
      d.bed.emplace();
      break;
    case Feature::free_bodies:
      add_body(d).free.emplace();
      break;
    case Feature::frictional_walls:
      d.walls[4].kind = WallKind::frictional;
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
    case Feature::loads_beside_cut:
      d.body_forces.emplace_back();
      d.bodies[0].parts = {0.5};
      break;
    case Feature::loads_of_place:
      d.body_forces.emplace_back();
      d.body_forces.back().acceleration[0] = Function::parse("x");
      break;
    case Feature::own_laws:
      d.materials[1].law = UserLawDefinition();
      break;
    case Feature::oblique_biot:
    case Feature::pore_pressure:
    case Feature::transport: {
      QuantityDefinition quantity;
      quantity.quantity = feature == Feature::transport ? Transported::concentration : Transported::pore_pressure;
      quantity.materials.resize(2);
      quantity.materials[0].biot = quantity.materials[1].biot = Symmetric3<double>::isotropic(1.0);
      if (feature == Feature::oblique_biot) quantity.materials[0].biot.xx = 0.5;
      d.transport.quantities.push_back(quantity);
      break;
    }
    case Feature::particle_damping:
      d.method.damping.particle = Function(1.0);
      break;
    case Feature::particle_tools:
      add_body(d).particles = true;
      break;
    case Feature::periodic_axes:
      d.walls[4].kind = d.walls[5].kind = WallKind::periodic;
      break;
    case Feature::plane_stress:
      d.geometry = GeometryKind::plane_stress;
      break;
    case Feature::point_particles:
      d.method.shape = ShapeKind::dirac;
      break;
    case Feature::rigid_bodies:
      add_body(d);
      break;
    case Feature::rings:
      add_body(d).inner_radius = 0.1;
      break;
    case Feature::robots:
      d.robots.emplace_back();
      d.robots.back().name = "digger";
      break;
    case Feature::sheared_boxes:
      d.method.shape = ShapeKind::cpdi;
      break;
    case Feature::sleep:
      if (!d.sleep) d.sleep = SleepDefinition{1.0, 1.0, 1.0};
      break;
    case Feature::sleep_damping:
      if (!d.sleep) d.sleep = SleepDefinition{1.0, 1.0, 1.0};
      d.sleep->damping = 0.5;
      break;
    case Feature::solid:
      d.geometry = GeometryKind::solid;
      break;
    case Feature::thin_tools:
      add_body(d).sides = Sides::two;
      break;
    case Feature::tool_heat: {
      QuantityDefinition heat;
      heat.quantity = Transported::temperature;
      heat.materials.resize(2);
      heat.tools.emplace_back();
      d.transport.quantities.push_back(heat);
      break;
    }
    case Feature::tool_laws:
      add_body(d).friction.adhesion = 1.0;
      break;
    case Feature::tractions_of_place:
      d.tractions.emplace_back();
      d.tractions.back().follows = true;
      break;
    case Feature::volumes:
      d.volumes.emplace_back();
      break;
  }
}

/// A definition with these features and what they bring. Its body is of the first of two materials.
SimulationDefinition with(const std::vector<Feature>& features) {
  SimulationDefinition d;
  d.geometry = GeometryKind::plane_strain;
  d.contact.method = ContactMethod::points;
  d.materials.resize(2);
  d.materials[0].name = "sand";
  d.materials[1].name = "rock";
  d.bodies.emplace_back();
  d.bodies[0].material = "sand";
  for (const Feature feature : features) add(feature, d);
  return d;
}

RunKind kind_of(const std::vector<Feature>& features) {
  const auto has = [&](Feature feature) {
    return std::find(features.begin(), features.end(), feature) != features.end();
  };
  return {has(Feature::ranks) ? 2 : 1, has(Feature::device)};
}

/// Features that a definition has when it is asked for one of them.
std::set<Feature> had_by(const std::vector<Feature>& asked) {
  std::set<Feature> had(asked.begin(), asked.end());
  const auto has = [&](Feature feature) { return had.count(feature) > 0; };
  if (has(Feature::sleep_damping)) had.insert(Feature::sleep);
  if (has(Feature::oblique_biot)) had.insert(Feature::pore_pressure);
  if (has(Feature::pore_pressure) || has(Feature::tool_heat)) had.insert(Feature::transport);
  if (has(Feature::particle_damping) || has(Feature::damping_of_place)) had.insert(Feature::damping);
  const auto is_of_body = [](Feature feature) {
    return feature == Feature::collisions || feature == Feature::divided_bodies || feature == Feature::free_bodies ||
           feature == Feature::particle_tools || feature == Feature::rings || feature == Feature::thin_tools ||
           feature == Feature::tool_laws || feature == Feature::conditions_beside_contact;
  };
  if (std::any_of(asked.begin(), asked.end(), is_of_body)) had.insert(Feature::rigid_bodies);
  if (has(Feature::conditions_beside_contact)) had.insert(Feature::conditions);
  if (has(Feature::conditions) &&
      (has(Feature::rigid_bodies) || has(Feature::frictional_walls) || has(Feature::implicit_steps))) {
    had.insert(Feature::conditions_beside_contact);
  }
  if (has(Feature::loads_beside_cut)) had.insert(Feature::cut_particles);
  if (has(Feature::loads_beside_cut) || has(Feature::loads_of_place) || has(Feature::tractions_of_place)) {
    had.insert(Feature::loads);
  }
  if (has(Feature::loads) && has(Feature::cut_particles)) had.insert(Feature::loads_beside_cut);
  return had;
}

/// True for two features of which a definition has one at a time.
bool exclude_each_other(Feature a, Feature b) {
  const std::vector<std::set<Feature>> choices = {
      {Feature::axisymmetric, Feature::line, Feature::plane_stress, Feature::solid},
      {Feature::point_particles, Feature::sheared_boxes},
      {Feature::frictional_walls, Feature::periodic_axes}};
  return a != b && std::any_of(choices.begin(), choices.end(),
                               [&](const auto& choice) { return choice.count(a) > 0 && choice.count(b) > 0; });
}

// Each feature is found where it was asked for, or is brought by one, and nowhere else; a pair is refused if a row of
// the table has two of them.
TEST(FeatureRules, RefuseTheirPairsAndNoOthers) {
  EXPECT_FALSE(feature_fault(with({})));
  std::size_t refused = 0;
  for (int a = 0; a < kFeatures; ++a) {
    for (int b = a; b < kFeatures; ++b) {
      const std::vector<Feature> pair = {static_cast<Feature>(a), static_cast<Feature>(b)};
      if (exclude_each_other(pair[0], pair[1])) continue;
      const SimulationDefinition d = with(pair);
      const std::set<Feature> had = had_by(pair);
      for (int f = 0; f < kFeatures; ++f) {
        const auto feature = static_cast<Feature>(f);
        EXPECT_EQ(find_feature(feature, d, kind_of(pair)).has_value(), had.count(feature) > 0)
            << feature_name(feature) << " of " << feature_name(pair[0]) << ", " << feature_name(pair[1]);
      }
      const auto& rules = feature_rules();
      const bool expected = std::any_of(rules.begin(), rules.end(), [&](const FeatureRule& rule) {
        return had.count(rule.feature) > 0 && had.count(rule.beside) > 0;
      });
      EXPECT_EQ(feature_fault(d, kind_of(pair)).has_value(), expected)
          << feature_name(pair[0]) << ", " << feature_name(pair[1]);
      refused += expected ? 1 : 0;
    }
  }
  EXPECT_GE(refused, feature_rules().size());
}

// A tool is thin by its shape, and a material counts if a body is of it.
TEST(FeatureRules, LookAtShapesAndMaterialsInUse) {
  const auto thin = [](double width) {
    SimulationDefinition d =
        parse_scene(
            fmt::format(
                "geometry: plane_strain\ngrid: {{cell: 0.05, min: [0, 0], max: [1, 1]}}\ntime: {{end: 1}}\n"
                "materials: [{{name: m, density: 1, law: neo_hookean, young: 1, poisson: 0.3}}]\n"
                "bodies: [{{name: b, material: m, shape: {{box: {{min: [0, 0], max: [1, 0.5]}}}}}}]\n"
                "rigid_bodies: [{{name: t, shape: {{box: {{size: [{}, 0.4]}}}}, pose: {{position: [0.5, 0.8]}}}}]\n",
                width),
            "scene", {})
            .definition;
    return find_feature(Feature::thin_tools, d);
  };
  EXPECT_EQ(thin(0.05), "'t'");
  EXPECT_FALSE(thin(0.2));
  SimulationDefinition d = with({Feature::oblique_biot});
  EXPECT_EQ(find_feature(Feature::oblique_biot, d), "'sand'");
  d.bodies[0].material = "rock";
  EXPECT_FALSE(find_feature(Feature::oblique_biot, d));
}

TEST(FeatureRules, NameBothWhyAndWhatToDo) {
  for (const FeatureRule& rule : feature_rules()) {
    const std::vector<Feature> pair = {rule.feature, rule.beside};
    const auto fault = feature_fault(with(pair), kind_of(pair));
    ASSERT_TRUE(fault) << feature_name(rule.feature) << ", " << feature_name(rule.beside);
    for (const char* part : {feature_name(rule.feature), feature_name(rule.beside), rule.reason, rule.remedy}) {
      EXPECT_NE(fault->text.find(part), std::string::npos) << part << " in: " << fault->text;
    }
    EXPECT_EQ(fault->key, feature_key(rule.feature));
  }
}

// Each row of steps on a graphics processor says how the scene runs all the same.
TEST(FeatureRules, NameTheProcessorThatRunsAScene) {
  for (const FeatureRule& rule : feature_rules()) {
    EXPECT_NE(rule.beside, Feature::device) << "the device is what is refused";
    if (rule.feature != Feature::device) continue;
    EXPECT_NE(std::string(rule.remedy).find("--device cpu"), std::string::npos) << feature_name(rule.beside);
  }
}

// A Simulation asks the table for what is made in C++.
TEST(FeatureRules, HoldForDefinitionsMadeInCpp) {
  const std::vector<std::vector<Feature>> pairs = {{Feature::cracks, Feature::implicit_steps},
                                                   {Feature::absorbing_faces, Feature::pore_pressure},
                                                   {Feature::pore_pressure, Feature::plane_stress}};
  for (const std::vector<Feature>& pair : pairs) {
    SimulationDefinition d = with(pair);
    d.time.sync = 1'000'000;
    try {
      const Simulation run(std::move(d), {1});
      FAIL() << "accepted: " << feature_name(pair[0]) << ", " << feature_name(pair[1]);
    } catch (const DefinitionError& error) {
      EXPECT_NE(std::string(error.what()).find("do not go together"), std::string::npos) << error.what();
    }
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
