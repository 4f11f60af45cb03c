// Bad scenes with cracks: each refusal with its place and its advice. Expected texts are written by hand from the rule
// "file:line: key.path: what; what to write instead".
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mpm/scene/scene.hpp"

namespace mpm::test {
namespace scene_crack_bad_input_test {

// One key per line, so that a replaced line is the line of the error.
const std::vector<std::string> kCracked = {
    "geometry: plane_strain",                                                     // 1
    "grid: {cell: 0.1, min: [0, 0], max: [2.4, 1.6]}",                            // 2
    "time: {end: 1, sync: 5 ms}",                                                 // 3
    "materials:",                                                                 // 4
    "  - name: glass",                                                            // 5
    "    density: 2500",                                                          // 6
    "    law: linear_elastic",                                                    // 7
    "    young: 70 GPa",                                                          // 8
    "    poisson: 0.22",                                                          // 9
    "    fracture: {k_ic: 0.7 MPa m^0.5}",                                        // 10
    "bodies:",                                                                    // 11
    "  - name: plate",                                                            // 12
    "    material: glass",                                                        // 13
    "    shape: {box: {min: [0.2, 0.2], max: [2.2, 1.4]}}",                       // 14
    "boundaries: {all: slip}",                                                    // 15
    "cracks:",                                                                    // 16
    "  list:",                                                                    // 17
    "    - name: notch",                                                          // 18
    "      points: [[0.22, 0.85], [1.01, 0.85]]",                                 // 19
    "      end: tip",                                                             // 20
    "      start: none",                                                          // 21
    "      faces: {friction: 0}",                                                 // 22
    "  traction_laws:",                                                           // 23
    "    glue: {kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm}}",  // 24
    "  contour: {size: 3}",                                                       // 25
    "  growth: {criterion: hoop_stress}",                                         // 26
    "  length: 0.5",                                                              // 27
};

std::string spoilt_scene(std::size_t number, const std::string& line) {
  std::vector<std::string> lines = kCracked;
  if (number > 0) lines.at(number - 1) = line;
  std::string text;
  for (const std::string& one : lines) text += one + "\n";
  return text;
}

std::string crack_refusal(const std::string& text, const std::string& label = "bad.yaml") {
  try {
    build(parse_scene(text, label));
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_crack_refused(std::size_t number, const std::string& line, const std::string& start,
                          const std::string& part = "", std::size_t at = 0) {
  const std::string found = crack_refusal(spoilt_scene(number, line));
  const std::string expected = "bad.yaml:" + std::to_string(at == 0 ? number : at) + ": " + start;
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
  EXPECT_NE(found.find(part), std::string::npos) << part << "\nnot in: " << found;
}

TEST(SceneCrackBadInput, TheSceneThatIsSpoiltIsGood) { EXPECT_EQ(crack_refusal(spoilt_scene(0, "")), "no error"); }

TEST(SceneCrackBadInput, ChainsThatAreNone) {
  const std::string points = "cracks.list.notch.points: ";
  expect_crack_refused(19, "      points: []", points + "no point;", "two points or more");
  expect_crack_refused(19, "      points: [[0.22, 0.85]]", points + "one point;", "two points or more");
  expect_crack_refused(19, "      points: [[0.22, 0.85], [0.22, 0.85]]", points + "all its points lie in one place;");
  expect_crack_refused(19, "      points: [[0.5, 0.5], [1.01, 0.9], [1.01, 0.5], [0.5, 0.9]]", points, "cross");
  expect_crack_refused(19, "      points: [[0.5, 0.5, 0.5], [1, 1, 1]]",
                       points.substr(0, points.size() - 2) + ".0: ", "two components, [x, z]");
  expect_crack_refused(19, "      points: [[-0.1, 0.85], [1.01, 0.85]]", points + "the point (-0.1, 0.85) m is not in");
  expect_crack_refused(19, "      points: [[0.22 s, 0.85], [1.01, 0.85]]",
                       "cracks.list.notch.points.0.0: ", "a length");
  expect_crack_refused(19, "      line: {from: [0.22, 0.85]}", "cracks.list.notch.line: the key 'to' is missing");
  expect_crack_refused(19, "      arc: {centre: [1, 0.8], radius: 0.3, from: 0, to: 400 deg}",
                       "cracks.list.notch.arc.to: the arc goes round more than once;");
  expect_crack_refused(19, "      arc: {centre: [1, 0.8], radius: 0.3, from: 1, to: 1}",
                       "cracks.list.notch.arc.to: the arc ends where it begins;");
  expect_crack_refused(19,
                       "      parts: [{line: {from: [0.5, 0.5], to: [0.8, 0.5]}}, {points: [[1.2, 0.5], [1.3, 0.5]]}]",
                       "cracks.list.notch.parts: ", "more than two cells");
  expect_crack_refused(19, "      parts: []", "cracks.list.notch.parts: no part;");
  expect_crack_refused(19, "      thickness: 1 mm", "cracks.list.notch: says not where it is; write points,", "", 18);
}

TEST(SceneCrackBadInput, SegmentsAndShapes) {
  expect_crack_refused(21, "      segment: 2.5", "cracks.list.notch.segment: segments of 2.5 cells; write 0.1 to 2");
  expect_crack_refused(21, "      segment: 0.05", "cracks.list.notch.segment: segments of 0.05 cells; write 0.1 to 2");
  expect_crack_refused(21, "      line: {from: [0, 0], to: [1, 1]}",
                       "cracks.list.notch.line: a second shape beside points;");
  expect_crack_refused(21, "      segmnet: 1", "cracks.list.notch.segmnet: unknown key", "'segment'");
  // A grid that no memory holds would come later; a chain of 10,000 segments and more is refused before it is cut.
  std::string text = spoilt_scene(19, "      points: [[0, 0], [1e9, 0]]");
  EXPECT_NE(crack_refusal(text).find("write a shorter crack"), std::string::npos);
}

TEST(SceneCrackBadInput, FilesOfPoints) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "scene_crack_bad_input_test";
  std::filesystem::create_directories(folder);
  const std::string label = (folder / "bad.yaml").string();
  const std::string text = spoilt_scene(19, "      file: path.csv");
  std::filesystem::remove(folder / "path.csv");
  const auto refused_with = [&](const char* rows) {
    std::ofstream(folder / "path.csv") << rows;
    return crack_refusal(text, label);
  };
  EXPECT_NE(crack_refusal(text, label).find("bad.yaml:19: cracks.list.notch.file: "), std::string::npos);
  EXPECT_NE(crack_refusal(text, label).find("no such file; check the path"), std::string::npos);
  EXPECT_NE(refused_with("0.3, 0.85, 1\n1, 0.85, 1\n").find("3 numbers a line; write two"), std::string::npos);
  EXPECT_NE(refused_with("0.3, 0.85\n").find("one point; a crack has two or more"), std::string::npos);
  EXPECT_NE(refused_with("").find("path.csv: it is empty; write lines of x and z"), std::string::npos);
  const std::string directory = crack_refusal(spoilt_scene(19, "      file: ."), label);
  EXPECT_NE(directory.find("it is a folder; name a file"), std::string::npos) << directory;
  EXPECT_NE(refused_with("0.3, 0.85\n1, inf\n").find("not finite"), std::string::npos);
  const std::string broken = refused_with("0.3, 0.85\n1, here\n");
  EXPECT_NE(broken.find("path.csv:2: 'here' is not a number"), std::string::npos) << broken;
  EXPECT_NE(broken.find("bad.yaml:19: cracks.list.notch.file: "), std::string::npos) << broken;
  EXPECT_NE(refused_with("0,3\t0,85\n").find("if these are decimal commas, write points"), std::string::npos);
  // Once each segment was checked against every other: 300,000 points took minutes.
  std::string many;
  for (int i = 0; i < 300000; ++i) many += "0." + std::to_string(3000000 + i) + ", 0.85\n";
  EXPECT_NE(refused_with(many.c_str()).find("300000 points make more than 10000 segments, the most of a crack"),
            std::string::npos);
  EXPECT_NE(crack_refusal(spoilt_scene(19, "      file: /dev/zero"), label).find("it is a device"), std::string::npos);
  EXPECT_EQ(refused_with("0.3, 0.85\n1, 0.85\n"), "no error");
}

TEST(SceneCrackBadInput, NamesThatAreNot) {
  expect_crack_refused(18, "    - body: plate", "cracks.list.0: the key 'name' is missing;", "", 18);
  expect_crack_refused(21, "      body: plat", "cracks.list.notch.body: no deformable body 'plat';", "'plate'");
  expect_crack_refused(21, "      traction: glu", "cracks.list.notch.traction: no law 'glu'; did you mean 'glue'?");
  expect_crack_refused(20, "      end: {tip: glas}", "cracks.list.notch.end.tip: no material 'glas'; did you mean");
  expect_crack_refused(20, "      end: {exterior: glass}", "cracks.list.notch.end.exterior: unknown key");
  expect_crack_refused(20, "      end: open", "cracks.list.notch.end: 'open' is not known;", "none, tip, exterior");
  expect_crack_refused(26, "  growth: {criterion: hoop}", "cracks.growth.criterion: 'hoop' is not known;");
  expect_crack_refused(26, "  growth: {criterion: 8}", "cracks.growth.criterion: '8' is not known;");
  expect_crack_refused(26, "  growth: {direction: initial}", "cracks.growth: the key 'criterion' is missing;");
  expect_crack_refused(26, "  growth: {criterion: 1, traction: tape}", "cracks.growth.traction: no law 'tape';");
  expect_crack_refused(27, "  ignored_by: [plat]", "cracks.ignored_by.0: no deformable body 'plat';");
  expect_crack_refused(27, "  ignored_by: [plate]", "cracks.list.notch: cracks.ignored_by names every body;", "", 18);
  std::string text = spoilt_scene(21, "      body: plate") + "  ignored_by: [plate]\n";
  EXPECT_EQ(crack_refusal(text).rfind("bad.yaml:21: cracks.list.notch.body: 'plate' heeds no crack", 0), 0u);
  text = spoilt_scene(23, "    - {name: notch, points: [[0.5, 0.5], [0.9, 0.5]]}\n  traction_laws:");
  EXPECT_EQ(crack_refusal(text).rfind("bad.yaml:23: cracks.list.notch: a second crack 'notch';", 0), 0u)
      << crack_refusal(text);
}

// Segments of half a cell, 0.05 m; the plate begins at 0.2 m, so that an end is exterior up to 0.4 m.
TEST(SceneCrackBadInput, ExteriorEndsInsideABody) {
  const auto from = [](const std::string& x) {
    std::string text = spoilt_scene(19, "      points: [[" + x + ", 0.85], [1.02, 0.85]]");
    return crack_refusal(text.replace(text.find("start: none"), 11, "start: exterior"));
  };
  EXPECT_EQ(from("0.22"), "no error");
  EXPECT_EQ(from("0.37"), "no error");
  const std::string inside = from("0.52"),
                    start = "bad.yaml:21: cracks.list.notch.start: an exterior end is lengthened";
  EXPECT_EQ(inside.substr(0, start.size()), start) << inside;
  EXPECT_NE(inside.find("'plate' is still there at (0.32, 0.85) m; put the end a quarter to half a cell inside"),
            std::string::npos)
      << inside;
}

TEST(SceneCrackBadInput, CracksThatLieAlongOneAnother) {
  const auto beside = [](const std::string& points) {
    return crack_refusal(spoilt_scene(23, "    - {name: other, points: " + points + ", end: none}\n  traction_laws:"));
  };
  const std::string along = "bad.yaml:23: cracks.list.other: 'other' lies along 'notch'; make one crack of both,";
  EXPECT_EQ(beside("[[0.22, 0.85], [1.01, 0.85]]").substr(0, along.size()), along);  // the same
  EXPECT_EQ(beside("[[0.75, 0.85], [1.6, 0.85]]").substr(0, along.size()), along);   // goes on where it ends
  EXPECT_EQ(beside("[[0.5, 0.853], [0.8, 0.853]]").substr(0, along.size()), along);  // a thirtieth of a cell beside it
  EXPECT_EQ(beside("[[1.01, 0.85], [1.3, 1.0]]"), "no error");                       // shares a point
  EXPECT_EQ(beside("[[0.6, 0.5], [0.6, 1.1]]"), "no error");                         // crosses
  EXPECT_EQ(beside("[[0.5, 0.88], [0.8, 0.88]]"), "no error");                       // three tenths of a cell beside it
}

TEST(SceneCrackBadInput, TipsThatCannotGrow) {
  const std::string end = "cracks.list.notch.end: ";
  expect_crack_refused(10, "", end + "the tip's material is 'glass', and its growth: ", "k_ic", 20);
  expect_crack_refused(26, "  growth: {criterion: release_rate}", end, "j_ic", 20);
  expect_crack_refused(26, "  growth: {criterion: elliptical}", end, "k_iic", 20);
  expect_crack_refused(26, "  growth: {criterion: opening}", end, "opening_ic", 20);
  expect_crack_refused(26, "  growth: {criterion: steady_state}", end, "speed", 20);
  expect_crack_refused(26, "  growth: {criterion: energy_balance}", end, "j_ic", 20);
  expect_crack_refused(27, "  alternate: {criterion: release_rate}",
                       end + "the tip's material is 'glass', and its alternate: ", "j_ic", 20);
  expect_crack_refused(27, "  alternate: {criterion: 2}", "cracks.alternate.criterion: steady_state sets when");
  expect_crack_refused(27, "  alternate: {criterion: energy_balance}",
                       "cracks.alternate.criterion: energy_balance sets");
  expect_crack_refused(26, "  alternate: {criterion: hoop_stress}", "cracks.alternate: stands in for growth");
  expect_crack_refused(10, "    fracture: {k_ic: 7e5, alternate: {criterion: 3}}",
                       "materials.glass.fracture.alternate.criterion: energy_balance sets when");
  expect_crack_refused(20, "      end: none", "cracks.growth: no crack has a tip,", "", 26);
  expect_crack_refused(19, "      points: [[0.22, 0.85], [2.3, 0.85]]", end + "the tip (2.3, 0.85) m is in no body",
                       "write end: exterior", 20);
  expect_crack_refused(27, "  length: 0.3", "cracks.length: steps of 0.3 cells,", "at least time_factor");
  expect_crack_refused(27, "  heating: 0.5", "cracks.heating: heat needs a temperature;",
                       "write transport: {temperature: {}}");
  expect_crack_refused(27, "  heating: 2", "cracks.heating: '2' is more than 1; write a number from 0 to 1");
}

TEST(SceneCrackBadInput, JIsOfSolids) {
  const std::vector<std::pair<std::string, std::string>> laws = {
      {"newtonian_fluid", "{name: other, density: 1000, law: newtonian_fluid, bulk_modulus: 1 MPa, viscosity: 1}"},
      {"ideal_gas", "{name: other, density: 1.2, law: ideal_gas, pressure: 1e5, temperature: 293}"},
      {"drucker_prager",
       "{name: other, density: 1600, law: drucker_prager, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg}"},
      {"mohr_coulomb",
       "{name: other, density: 1600, law: mohr_coulomb, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg}"}};
  for (const auto& [law, material] : laws) {
    const std::string text = spoilt_scene(20, "      end: {tip: other}");
    const std::string with =
        text.substr(0, text.find("bodies:")) + "  - " + material + "\n" + text.substr(text.find("bodies:"));
    const std::string found = crack_refusal(with);
    EXPECT_EQ(found.rfind("bad.yaml:21: cracks.list.notch.end: J is of solids, and the tip's material 'other'", 0), 0u)
        << law << ": " << found;
    EXPECT_NE(found.find("write end: none"), std::string::npos) << found;
  }
}

TEST(SceneCrackBadInput, ContoursOfJ) {
  expect_crack_refused(25, "  contour: {size: 1}", "cracks.contour.size: 1 is less than 2;", "of 2 or more");
  expect_crack_refused(25, "  contour: {terms: 3}",
                       "cracks.contour.terms: 3 is more than 2; write a whole number from 1 to 2");
  expect_crack_refused(25, "  contour: {form: broberg}",
                       "cracks.contour.form: the two forms differ about an axis alone;");
  expect_crack_refused(25, "  contour: {energy: nodes}", "cracks.contour.energy: 'nodes' is not known;");
  // The node nearest to the tip, (1, 0.8) or (1, 0.9) m, has 5 to 6 cells of material above or below it.
  expect_crack_refused(25, "  contour: {size: 7}", "cracks.list.notch.end: the contour of J reaches 7 cells", "along z",
                       20);
  EXPECT_EQ(crack_refusal(spoilt_scene(25, "  contour: {size: 5}")), "no error");
  expect_crack_refused(19, "      points: [[0.22, 0.85], [2.01, 0.85]]",
                       "cracks.list.notch.end: the contour of J reaches 3 cells", "after 2 along x", 20);
}

TEST(SceneCrackBadInput, FacesAndTractions) {
  expect_crack_refused(22, "      faces: open", "cracks.list.notch.faces: 'open' is not known; write one of ignored");
  expect_crack_refused(22, "      faces: {friction: -1}", "cracks.list.notch.faces.friction: '-1' is less than 0;");
  expect_crack_refused(22, "      faces: {position: 0.8}", "cracks.list.notch.faces.position: a distance");
  expect_crack_refused(22, "      faces: {law: interface, tangential: 1e9}",
                       "cracks.list.notch.faces: the key 'opened' is missing;");
  expect_crack_refused(22, "      faces: {law: interface, normal: 1e9, tangential: 1e9}",
                       "cracks.list.notch.end: an interface has no J,", "write end: none", 20);
  expect_crack_refused(22, "      faces: {law: interface, normal: 1e9, tangential: 1e9, detection: positions}",
                       "cracks.list.notch.faces.detection: an interface follows displacements;");
  expect_crack_refused(21, "      traction: glue\n      fixed: true",
                       "cracks.list.notch.traction: the faces of a fixed crack");
  std::string text = spoilt_scene(22, "      faces: {friction: 0.3}\n      traction_of_growth: glue");
  EXPECT_EQ(crack_refusal(text).rfind("bad.yaml:23: cracks.list.notch.traction_of_growth: faces with a law", 0), 0u);
  const auto with_tractions = [](const std::string& own) {
    std::string scene = spoilt_scene(22, own);
    return scene.replace(scene.find("criterion: hoop_stress"), 22, "criterion: hoop_stress, traction: glue");
  };
  EXPECT_EQ(crack_refusal(with_tractions("      faces: {friction: 0.0}")), "no error");
  const std::string rough = crack_refusal(with_tractions("      faces: {friction: 0.3}"));
  EXPECT_EQ(rough.rfind("bad.yaml:20: cracks.list.notch.end: faces with a law of tractions are smooth", 0), 0u)
      << rough;
  const std::string held = crack_refusal(with_tractions("      fixed: true"));
  EXPECT_EQ(held.rfind("bad.yaml:20: cracks.list.notch.end: 'notch' is fixed, and its growth", 0), 0u) << held;
  text = spoilt_scene(21, "      fixed: true");
  EXPECT_EQ(crack_refusal(text), "no error");  // K by the interaction integral needs no faces
  text += "  split: openings\n";
  EXPECT_EQ(crack_refusal(text).rfind("bad.yaml:20: cracks.list.notch.end: 'notch' grows by openings,", 0), 0u);
}

TEST(SceneCrackBadInput, LawsOfTractions) {
  const std::string law = "cracks.traction_laws.glue";
  const auto refused = [&](const std::string& keys, const std::string& start, const std::string& part = "") {
    expect_crack_refused(24, "    glue: {" + keys + "}", law + start, part);
  };
  refused("normal: {strength: 1}", ": the key 'kind' is missing;");
  refused("kind: triangle, normal: {}", ".kind: 'triangle' is not known;", "triangular, cubic");
  refused("kind: triangular", ": the key 'normal' is missing;");
  refused("kind: triangular, normal: {strength: 10 MPa}", ".normal: ");
  refused("kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm, toughness: 500}", ".normal: ");
  refused("kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm, elastic: 1e-5, elastic_part: 0.1}",
          ".normal: ");
  refused("kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm, elastic: 0.2 mm}", ".normal: ");
  refused("kind: cubic, normal: {strength: 10 MPa, opening: 0.1 mm, stiffness: 1e9}", ".normal.stiffness: unknown key");
  refused("kind: exponential, normal: {strength: 10 MPa, opening: 0.1 mm, elastic: 0.01 mm}",
          ".normal: the key 'decay' is missing;");
  refused("kind: trilinear, normal: {strength: 10 MPa, elastic: 1e-5, opening: 1e-4, toughness: 400}", ".normal: ");
  refused("kind: linear, normal: {stiffness: -1}", ".normal.stiffness: '-1' is less than 0;");
  refused("kind: linear, normal: {stiffness: 1e9}, mix: 1", ".mix: it is of laws whose directions");
  refused("kind: pressure, pressure: 1e5, normal: {}", ".normal: it is of laws of the opening,");
  refused("kind: pressure, pressure: \"x\"", ".pressure: it acts on all of a crack;");
  refused("kind: triangular, normal: {strength: 1e7, opening: 1e-4}, pressure: 1",
          ".pressure: it is of the law pressure,");
  refused("kind: triangular, normal: {strength: 1e7, opening: 1e-4}, curve: cubic", ".curve: it is of the law mixed,");
  expect_crack_refused(24, "    a glue: {kind: linear}", "cracks.traction_laws.a glue: 'a glue' is not a name;");
}

TEST(SceneCrackBadInput, ConstantsOfMaterials) {
  const std::string at = "materials.glass.fracture";
  expect_crack_refused(10, "    fracture: {k_ic: -1}", at + ".k_ic: '-1' is not greater than 0;");
  expect_crack_refused(10, "    fracture: {k_ic: 1 MPa}",
                       at + ".k_ic: '1 MPa' is a pressure, but a fracture toughness");
  expect_crack_refused(10, "    fracture: {j_ic: 1 MPa}", at + ".j_ic: '1 MPa' is a pressure,");
  expect_crack_refused(10, "    fracture: {exponents: [2]}", at + ".exponents: write two,");
  expect_crack_refused(10, "    fracture: {way: [0, 0]}", at + ".way: a way has a length;");
  expect_crack_refused(10, "    fracture: {start_time: -1}", at + ".start_time: '-1' is less than 0;");
  expect_crack_refused(10, "    fracture: {growth: {criterion: 3}, speed: 2, j_ic: 8}",
                       at + ".speed: ", "is more than 1");
  expect_crack_refused(10, "    fracture: {K_ic: 1}", at + ".K_ic: unknown key 'K_ic';", "'k_ic'");
  std::string text = spoilt_scene(0, "");
  text = text.substr(0, text.find("cracks:"));
  EXPECT_EQ(crack_refusal(text).rfind("bad.yaml:10: materials.glass.fracture: its constants are of cracks,", 0), 0u)
      << crack_refusal(text);
}

TEST(SceneCrackBadInput, GeometriesWithoutAPlane) {
  const char* const kSolid = R"yaml(grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}
time: {end: 1}
materials: [{name: glass, density: 2500, law: linear_elastic, young: 70 GPa, poisson: 0.22}]
bodies: [{name: plate, material: glass, shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}}]
cracks: {list: [{name: notch, points: [[0.2, 0.4], [0.4, 0.4]]}]}
)yaml";
  const std::string solid = crack_refusal(kSolid);
  EXPECT_EQ(solid.rfind("bad.yaml:5: cracks: cracks and a solid scene do not go together", 0), 0u) << solid;
  EXPECT_NE(solid.find("write geometry: plane_strain,"), std::string::npos);
  const std::string line = crack_refusal(R"yaml(geometry: line
grid: {cell: 0.1, min: 0, max: 1}
time: {end: 1}
materials: [{name: glass, density: 2500, law: linear_elastic, young: 70 GPa, poisson: 0.22}]
bodies: [{name: plate, material: glass, shape: {box: {min: 0.2, max: 0.6}}}]
cracks: {list: []}
)yaml");
  EXPECT_EQ(line.rfind("bad.yaml:6: cracks: cracks and a line do not go together", 0), 0u) << line;
  const std::string whole = spoilt_scene(0, "");
  const std::string before = whole.substr(0, whole.find("cracks:"));
  EXPECT_EQ(crack_refusal(before + "cracks: {list: []}\n").substr(0, 40), "bad.yaml:16: cracks.list: names no crack");
  EXPECT_EQ(crack_refusal(before + "cracks: 1\n").substr(0, 26), "bad.yaml:16: cracks: found");
  EXPECT_EQ(crack_refusal(before + "cracks: {}\n").substr(0, 51),
            "bad.yaml:16: cracks: the key 'list' is missing; add");
}

/// The good scene with a section more, which begins in line 28.
std::string refusal_beside(const std::string& section, std::size_t number = 0, const std::string& line = "") {
  return crack_refusal(spoilt_scene(number, line) + section);
}

TEST(SceneCrackBadInput, WhatGoesTogetherWithCracks) {
  EXPECT_EQ(refusal_beside("sleep: {speed: 1 mm/s, after: 1 ms}\n"), "no error");
  EXPECT_EQ(refusal_beside("transport: {temperature: {}}\n", 6, "    density: 2500\n    heat_capacity: 800"),
            "no error");
  const std::string blade =
      "rigid_bodies: [{name: blade, shape: {box: {size: [0.05, 0.4]}}, pose: {position: [1, 1.5]}";
  EXPECT_EQ(refusal_beside(blade + "}]\n"), "no error");
  EXPECT_EQ(refusal_beside(blade + ", sides: two}]\n"), "no error");
}

}  // namespace scene_crack_bad_input_test
}  // namespace mpm::test
