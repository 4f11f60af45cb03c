// The section `cracks` of a scene and the key `fracture` of materials: what is read, with which defaults. What both
// refuse is in scene_crack_bad_input_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "mpm/scene/scene.hpp"

namespace mpm::test {
namespace scene_crack_test {

// A plate of 2 m by 1.2 m, cells of 0.1 m, and a crack from its left edge along a line in the middle of cells.
const char* const kPlate = R"yaml(geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [2.4, 1.6]}
time: {end: 1, sync: 5 ms}
materials:
  - {name: glass, density: 2500, law: linear_elastic, young: 70 GPa, poisson: 0.22}
  - {name: resin, density: 1200, law: neo_hookean, young: 3 GPa, poisson: 0.35}
bodies: [{name: plate, material: glass, shape: {box: {min: [0.2, 0.2], max: [2.2, 1.4]}}}]
)yaml";

Scene crack_scene(const std::string& section, const std::vector<std::string>& changes = {}) {
  return parse_scene(kPlate + section, "crack.yaml", changes);
}

/// The crack of a scene with one.
CrackDefinition one_crack(const std::string& keys) {
  const Scene scene = crack_scene("cracks: {list: [{name: notch, " + keys + "}]}\n");
  return scene.definition.cracks.list.at(0);
}

TEST(SceneCrack, ASceneWithoutTheSectionHasNone) {
  const Scene scene = crack_scene("");
  EXPECT_FALSE(scene.definition.cracks.any());
  EXPECT_TRUE(scene.definition.cracks.materials.empty());
}

// The defaults are those of definition.hpp, which doc/scene.md lists.
TEST(SceneCrack, Defaults) {
  const Scene scene = crack_scene("cracks: {list: [{name: notch, points: [[0.22, 0.85], [1.01, 0.85]]}]}\n");
  const CracksDefinition& cracks = scene.definition.cracks;
  ASSERT_EQ(cracks.list.size(), 1u);
  const CrackDefinition& crack = cracks.list[0];
  EXPECT_EQ(crack.name, "notch");
  EXPECT_EQ(crack.body, "");
  EXPECT_EQ(crack.ends[0], CrackEnd::none);
  EXPECT_EQ(crack.ends[1], CrackEnd::tip);
  EXPECT_EQ(crack.tip_materials[1], "");
  EXPECT_FALSE(crack.fixed);
  EXPECT_EQ(crack.thickness, 0.0);
  EXPECT_FALSE(crack.faces.ignored);
  EXPECT_EQ(crack.faces.law.kind, ContactLaw::Kind::coulomb);
  EXPECT_EQ(crack.faces.law.friction(0.0), 0.0);
  EXPECT_EQ(crack.faces.detection, CrackFaces::Detection::displacements);
  EXPECT_EQ(crack.faces.position, 0.8);
  EXPECT_EQ(crack.traction, "");
  EXPECT_EQ(crack.longest, 0.0);
  EXPECT_EQ(crack.longest_open, 0.0);
  EXPECT_EQ(crack.where.rfind("crack.yaml:8: cracks.list.notch", 0), 0u) << crack.where;
  // 0.79 m in the fewest segments of 0.05 m at most: 16.
  ASSERT_EQ(crack.points.size(), 17u);
  EXPECT_EQ(crack.points.front(), Vec2(0.22, 0.85));
  EXPECT_EQ(crack.points.back(), Vec2(1.01, 0.85));
  EXPECT_NEAR(crack.points[1].x(), 0.22 + 0.79 / 16.0, 1e-15);
  EXPECT_EQ(cracks.contour.size, 3);
  EXPECT_EQ(cracks.contour.terms, 2);
  EXPECT_EQ(cracks.contour.energy, ContourDefinition::Energy::particles);
  EXPECT_EQ(cracks.move, CracksDefinition::Move::average);
  EXPECT_TRUE(cracks.prevent);
  EXPECT_EQ(cracks.split, CracksDefinition::Split::interaction);
  EXPECT_EQ(cracks.growth.criterion, FractureCriterion::none);
  EXPECT_EQ(cracks.alternate.criterion, FractureCriterion::none);
  EXPECT_EQ(cracks.length, 0.5);
  EXPECT_EQ(cracks.time_factor, 0.5);
  EXPECT_EQ(cracks.heating, 0.0);
  ASSERT_EQ(cracks.materials.size(), 2u);
  EXPECT_FALSE(cracks.materials[0].known());
}

TEST(SceneCrack, ALineAndSegmentsOfAnotherLength) {
  const CrackDefinition crack =
      one_crack("line: {from: [220 mm, 0.85], to: [1.02, 0.85]}, segment: 1, end: {tip: resin}");
  ASSERT_EQ(crack.points.size(), 9u);  // 0.8 m of 0.1 m each
  EXPECT_EQ(crack.points.front(), Vec2(0.22, 0.85));
  EXPECT_EQ(crack.tip_materials[1], "resin");
}

// A quarter of a circle around (1, 0.8) from the right to the top: 0.3 pi / 2 = 0.4712 m in 10 segments.
TEST(SceneCrack, AnArcGoesRoundCounterClockwise) {
  const CrackDefinition crack =
      one_crack("arc: {centre: [1, 0.8], radius: 0.3, from: 0 deg, to: 90 deg}, start: tip, end: none");
  ASSERT_EQ(crack.points.size(), 11u);
  EXPECT_NEAR((crack.points.front() - Vec2(1.3, 0.8)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((crack.points.back() - Vec2(1.0, 1.1)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((crack.points[5] - Vec2(1.0, 0.8)).norm(), 0.3, 1e-14);
  EXPECT_GT(crack.points[5].y(), 0.8);
  EXPECT_EQ(crack.ends[0], CrackEnd::tip);
  EXPECT_EQ(crack.ends[1], CrackEnd::none);
}

TEST(SceneCrack, PartsAreJoined) {
  const CrackDefinition crack = one_crack(
      "parts: [{line: {from: [0.7, 0.5], to: [1, 0.5]}}, {arc: {centre: [1, 0.8], radius: 0.3, from: -90 deg, to: "
      "0}}]");
  // 6 segments of the line and 10 of the arc, which share a point.
  ASSERT_EQ(crack.points.size(), 17u);
  EXPECT_NEAR((crack.points[6] - Vec2(1.0, 0.5)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((crack.points.back() - Vec2(1.3, 0.8)).norm(), 0.0, 1e-14);
}

TEST(SceneCrack, AFileHasLinesOfXAndZInTheScenesUnits) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "scene_crack_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "path.csv") << "# x, z\n0.7, 0.85\n1.0, 0.85\n1.2, 1.0\n";
  const std::string text = std::string(kPlate) + "cracks: {list: [{name: notch, file: path.csv, segment: 1}]}\n";
  const Scene scene = parse_scene(text, (folder / "scene.yaml").string());
  const std::vector<Vec2>& points = scene.definition.cracks.list.at(0).points;
  ASSERT_EQ(points.size(), 7u);  // 0.3 m in 3, 0.25 m in 3
  EXPECT_NEAR((points[3] - Vec2(1.0, 0.85)).norm(), 0.0, 1e-15);
  EXPECT_EQ(points.back(), Vec2(1.2, 1.0));
}

TEST(SceneCrack, FacesHaveTheLawsOfContact) {
  const std::string line = "points: [[0.7, 0.85], [1.01, 0.85]], ";
  CrackFaces faces = one_crack(line + "faces: {friction: 0.3, static_friction: 0.4, adhesion: 2 kPa}").faces;
  EXPECT_EQ(faces.law.friction(0.0), 0.3);
  EXPECT_EQ((*faces.law.static_friction)(0.0), 0.4);
  EXPECT_EQ(faces.law.adhesion(0.0), 2000.0);
  faces = one_crack(line + "faces: {friction: stick, detection: positions, position: 0.9}").faces;
  EXPECT_EQ(faces.law.kind, ContactLaw::Kind::stick);
  EXPECT_EQ(faces.detection, CrackFaces::Detection::positions);
  EXPECT_EQ(faces.position, 0.9);
  faces = one_crack(line + "end: none, faces: {law: interface, normal: 2 MPa/mm, tangential: perfect}").faces;
  EXPECT_EQ(faces.law.kind, ContactLaw::Kind::interface);
  EXPECT_EQ(faces.law.interface.opened, 2e9);
  EXPECT_EQ(faces.law.interface.closed, 2e9);
  EXPECT_LT(faces.law.interface.tangential, 0.0);
  EXPECT_EQ(one_crack(line + "faces: {law: one_field}").faces.law.kind, ContactLaw::Kind::one_field);
  EXPECT_TRUE(one_crack(line + "faces: ignored").faces.ignored);
}

TEST(SceneCrack, WhatIsSaidOfOneCrack) {
  const CrackDefinition crack = one_crack(
      "body: plate, points: [[0.3, 0.85], [1.01, 0.85]], start: exterior, end: tip, fixed: true, thickness: 2 mm, "
      "longest: 1.5, longest_open: 80 cm");
  EXPECT_EQ(crack.body, "plate");
  EXPECT_EQ(crack.ends[0], CrackEnd::exterior);
  EXPECT_TRUE(crack.fixed);
  EXPECT_EQ(crack.thickness, 0.002);
  EXPECT_EQ(crack.longest, 1.5);
  EXPECT_EQ(crack.longest_open, 0.8);
}

TEST(SceneCrack, WhatIsSaidOfAllCracks) {
  const Scene scene = crack_scene(R"yaml(cracks:
  list: [{name: notch, points: [[0.3, 0.85], [1.01, 0.85]]}]
  contour: {size: 4, terms: 1, energy: grid}
  move: centre_of_mass
  prevent: false
  split: openings
  growth: {criterion: hoop_stress, direction: self_similar}
  alternate: {criterion: 7, direction: 4}
  length: 0.8
  time_factor: 0.4
  heating: 0
)yaml",
                                  {"materials.glass.fracture={k_ic: 0.7 MPa m^0.5, j_ic: 8}"});
  const CracksDefinition& cracks = scene.definition.cracks;
  EXPECT_EQ(cracks.contour.size, 4);
  EXPECT_EQ(cracks.contour.terms, 1);
  EXPECT_EQ(cracks.contour.energy, ContourDefinition::Energy::grid);
  EXPECT_EQ(cracks.move, CracksDefinition::Move::centre_of_mass);
  EXPECT_FALSE(cracks.prevent);
  EXPECT_EQ(cracks.split, CracksDefinition::Split::openings);
  EXPECT_EQ(cracks.growth.criterion, FractureCriterion::hoop_stress);
  EXPECT_EQ(cracks.growth.direction, GrowthDirection::self_similar);
  // 7 and 4 in the manual's Propagate: critical energy release rate, initial direction.
  EXPECT_EQ(cracks.alternate.criterion, FractureCriterion::release_rate);
  EXPECT_EQ(cracks.alternate.direction, GrowthDirection::initial);
  EXPECT_EQ(cracks.length, 0.8);
  EXPECT_EQ(cracks.time_factor, 0.4);
}

TEST(SceneCrack, ConstantsOfMaterialsInTheirOrder) {
  const Scene scene = crack_scene(
      "cracks: {list: [{name: notch, points: [[0.3, 0.85], [1.01, 0.85]]}]}\n",
      {"materials.resin.fracture={k_ic: 1 MPa sqrt(m), k_iic: 2e6, exponents: [1, 3], j_ic: 0.2 N/mm, opening_ic: 0.1 "
       "mm, opening_iic: 0.2 mm, speed: 300, start_time: 1 ms, longest: 0.5, way: [1, 0.5], surface_energy: 50, "
       "plastic_part: 0.5, gain: 0.2, keeps_tips: true, growth: {criterion: steady_state}, alternate: {criterion: "
       "opening, direction: normal_to_opening}}"});
  const FractureConstants& resin = scene.definition.cracks.materials.at(1);
  EXPECT_FALSE(scene.definition.cracks.materials.at(0).known());
  EXPECT_TRUE(resin.known());
  EXPECT_EQ(resin.k_ic, 1e6);
  EXPECT_EQ(resin.k_iic, 2e6);
  EXPECT_EQ(resin.k_exponent, 1.0);
  EXPECT_EQ(resin.k_ii_exponent, 3.0);
  EXPECT_NEAR(resin.j_ic, 200.0, 1e-12);
  EXPECT_NEAR(resin.opening_ic, 1e-4, 1e-18);
  EXPECT_NEAR(resin.opening_iic, 2e-4, 1e-18);
  EXPECT_EQ(resin.speed, 300.0);
  EXPECT_EQ(resin.start_time, 0.001);
  EXPECT_EQ(resin.longest, 0.5);
  EXPECT_EQ(resin.way, (std::array<double, 2>{1.0, 0.5}));
  EXPECT_EQ(resin.surface_energy, 50.0);
  EXPECT_EQ(resin.plastic_part, 0.5);
  EXPECT_EQ(resin.gain, 0.2);
  EXPECT_TRUE(resin.keeps_tips);
  EXPECT_EQ(resin.growth->criterion, FractureCriterion::steady_state);
  EXPECT_EQ(resin.alternate->criterion, FractureCriterion::opening);
  EXPECT_EQ(resin.alternate->direction, GrowthDirection::normal_to_opening);
}

// Plain numbers in mm, g and ms are mm, MPa sqrt(mm) and N/mm: 22 MPa sqrt(mm) = 22e6 sqrt(1e-3) Pa sqrt(m).
// Where a crack may grow, by the scene's rule or a material's, and the scene names no transfer, it is xpic 2.
TEST(SceneCrack, GrowthIsCalmed) {
  const auto transfer = [](const std::string& more, const std::vector<std::string>& changes) {
    const std::string section = "cracks:\n  list: [{name: notch, points: [[0.22, 0.85], [1.01, 0.85]]}]\n" + more;
    return crack_scene(section, changes).definition.method.transfer;
  };
  const std::string grows = "  growth: {criterion: hoop_stress}\n";
  const std::string constant = "materials.glass.fracture.k_ic=0.7 MPa m^0.5";
  for (const std::string method : {"auto", "{shape: ugimp}", "{auto: {}, shape: ugimp}"}) {
    const Transfer calmed = transfer(grows, {constant, "method=" + method});
    EXPECT_EQ(calmed.kind, TransferKind::xpic) << method;
    EXPECT_EQ(calmed.order, 2) << method;
  }
  EXPECT_EQ(transfer("", {constant, "materials.glass.fracture.growth.criterion=hoop_stress"}).kind, TransferKind::xpic);
  EXPECT_EQ(transfer(grows, {constant, "method={transfer: flip}"}).kind, TransferKind::flip);
  EXPECT_EQ(transfer("", {"method={shape: ugimp}"}).kind, TransferKind::flip);
  EXPECT_EQ(transfer("  growth: {criterion: none}\n", {"method={shape: ugimp}"}).kind, TransferKind::flip);
}

TEST(SceneCrack, PlainNumbersAreInTheScenesUnits) {
  const Scene scene = parse_scene(R"yaml(units: mm-g-ms
geometry: plane_stress
grid: {cell: 1, min: [0, 0], max: [24, 16]}
time: {end: 1, sync: 5e-3}
materials:
  - {name: glass, density: 2.5e-3, law: linear_elastic, young: 70e3, poisson: 0.22, fracture: {k_ic: 22, j_ic: 0.2}}
bodies: [{name: plate, material: glass, shape: {box: {min: [2, 2], max: [22, 14]}}}]
cracks:
  list: [{name: notch, points: [[3, 8.5], [10.1, 8.5]]}]
  growth: {criterion: hoop_stress}
)yaml",
                                  "crack.yaml");
  EXPECT_NEAR(scene.definition.cracks.materials[0].k_ic, 22e6 * std::sqrt(1e-3), 1e-6);
  EXPECT_NEAR(scene.definition.cracks.materials[0].j_ic, 200.0, 1e-10);
  EXPECT_NEAR(scene.definition.cracks.list[0].points.back().x(), 0.0101, 1e-17);
}

TEST(SceneCrack, LawsOfTractionsFollowFromTheNumbersThatSuffice) {
  const Scene scene = crack_scene(R"yaml(cracks:
  list:
    - {name: notch, points: [[0.3, 0.85], [1.01, 0.85]], traction: glue, traction_of_growth: fibres}
  traction_laws:
    glue: {kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm}, mix: 2}
    fibres: {kind: linear, normal: {stiffness: 2 MPa/mm}, shear: {stiffness: 1 MPa/mm}}
    gas: {kind: pressure, pressure: "-1e5*t", least_opening: 1 mm}
    round: {kind: cubic, normal: {toughness: 450, opening: 0.08 mm}}
    both: {kind: mixed, normal: {strength: 10 MPa, opening: 0.1 mm, elastic: 0.01 mm},
           shear: {strength: 20 MPa, toughness: 2 N/mm, elastic_part: 0.1}}
    corners: {kind: trilinear, normal: {strength: 10 MPa, elastic: 0.01 mm, strength_2: 4 MPa, elastic_2: 0.03 mm,
              opening: 0.1 mm}}
    falling: {kind: exponential, normal: {strength: 10 MPa, opening: 0.1 mm, elastic: 0.01 mm, decay: 2}}
  growth: {criterion: release_rate, traction: glue}
)yaml",
                                  {"materials.glass.fracture={j_ic: 8}"});
  const CracksDefinition& cracks = scene.definition.cracks;
  EXPECT_EQ(cracks.list[0].traction, "glue");
  EXPECT_EQ(cracks.list[0].traction_of_growth, "fibres");
  EXPECT_EQ(cracks.growth.traction, "glue");
  ASSERT_EQ(cracks.laws.size(), 7u);
  const auto law = [&](const std::string& name) {
    for (const TractionLawDefinition& one : cracks.laws) {
      if (one.name == name) return one;
    }
    ADD_FAILURE() << name;
    return TractionLawDefinition{};
  };
  // Crack reference 5.5: a triangular law of which nothing else is said is elastic up to 0.225926299 of its opening.
  EXPECT_EQ(law("glue").kind, TractionKind::triangular);
  EXPECT_NEAR(law("glue").normal.elastic, 0.225926299e-4, 1e-16);
  EXPECT_EQ(law("glue").shear.strength, 10e6);
  EXPECT_EQ(law("glue").mix, 2.0);
  EXPECT_NE(law("glue").where.find("crack.yaml:"), std::string::npos);
  EXPECT_EQ(law("fibres").normal.stiffness, 2e9);
  EXPECT_EQ(law("fibres").shear.stiffness, 1e9);
  EXPECT_EQ(law("gas").pressure(2.0), -2e5);
  EXPECT_EQ(law("gas").least_opening, 0.001);
  // G_c = 9/16 sigma u_c.
  EXPECT_NEAR(law("round").normal.strength, 450.0 * 16.0 / 9.0 / 0.08e-3, 1e-6);
  // G_c = sigma u_c / 2.
  EXPECT_NEAR(law("both").shear.opening, 0.2e-3, 1e-15);
  EXPECT_NEAR(law("both").shear.elastic, 0.02e-3, 1e-15);
  EXPECT_EQ(law("corners").normal.strength_2, 4e6);
  EXPECT_NEAR(law("falling").shear.decay, 2.0, 0.0);
}

TEST(SceneCrack, AboutAnAxisTheFormsOfJMayBeChosen) {
  const std::string section =
      "cracks: {list: [{name: penny, points: [[0.25, 0.85], [1.01, 0.85]], start: exterior}]}\n";
  const Scene plain = crack_scene(section, {"geometry=axisymmetric"});
  EXPECT_TRUE(plain.definition.cracks.contour.about_axis_by_broberg);
  EXPECT_EQ(plain.definition.cracks.split, CracksDefinition::Split::openings);
  EXPECT_FALSE(crack_scene(section, {"geometry=axisymmetric", "cracks.contour={form: bergkvist_huong}"})
                   .definition.cracks.contour.about_axis_by_broberg);
}

TEST(SceneCrack, BodiesMayHeedNoCrack) {
  const Scene scene =
      crack_scene("cracks: {list: [{name: notch, points: [[0.3, 0.85], [1.01, 0.85]]}], ignored_by: [cover]}\n",
                  {"bodies=[{name: plate, material: glass, shape: {box: {min: [0.2, 0.2], max: [2.2, 1.2]}}}, {name: "
                   "cover, material: resin, shape: {box: {min: [0.2, 1.2], max: [2.2, 1.4]}}}]"});
  EXPECT_EQ(scene.definition.cracks.ignored_by, std::vector<std::string>{"cover"});
}

TEST(SceneCrack, TheDefinitionReachesTheSimulation) {
  const Scene scene = crack_scene("cracks: {list: [{name: notch, points: [[0.3, 0.85], [1.01, 0.85]]}]}\n");
  EXPECT_EQ(build(scene).cracks.list.size(), 1u);
}

}  // namespace scene_crack_test
}  // namespace mpm::test
