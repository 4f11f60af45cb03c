// Bad scenes: each refusal with its place and its advice. Expected texts are written by hand from the rule "file:line:
// key.path: what; what to write instead".
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_bad_input_test {

// One key per line, so that a replaced line is the line of the error.
const std::vector<std::string> kLines = {
    "name: good",                                                      // 1
    "grid:",                                                           // 2
    "  cell: 0.1",                                                     // 3
    "  min: [0, 0, 0]",                                                // 4
    "  max: [1, 1, 1]",                                                // 5
    "time: {end: 1, cfl: 0.5}",                                        // 6
    "method:",                                                         // 7
    "  shape: ugimp",                                                  // 8
    "  update: usavg",                                                 // 9
    "  transfer: flip",                                                // 10
    "gravity: [0, 0, -9.81]",                                          // 11
    "materials:",                                                      // 12
    "  - name: soft",                                                  // 13
    "    density: 1000",                                               // 14
    "    law: neo_hookean",                                            // 15
    "    young: 1 MPa",                                                // 16
    "    poisson: 0.3",                                                // 17
    "bodies:",                                                         // 18
    "  - name: block",                                                 // 19
    "    material: soft",                                              // 20
    "    shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}",  // 21
    "    initial: {velocity: [0, 0, 0]}",                              // 22
    "rigid_bodies:",                                                   // 23
    "  - name: ball",                                                  // 24
    "    shape: {sphere: {radius: 0.1}}",                              // 25
    "    pose: {position: [0.4, 0.4, 0.8]}",                           // 26
    "    motion: {velocity: [0, 0, \"-0.1*t\"]}",                      // 27
    "contact: {friction: 0.3}",                                        // 28
    "boundaries: {all: slip}",                                         // 29
    "output: {period: 0.02, particle_fields: [vx]}",                   // 30
    "metrics: {mean_vx: {mean: vx, of: block}}",                       // 31
};

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string with_line(std::size_t number, const std::string& line) {
  std::vector<std::string> lines = kLines;
  lines.at(number - 1) = line;
  return text_of(lines);
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    build(parse_scene(text, "bad.yaml", overrides));
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_refused(std::size_t number, const std::string& line, const std::string& start,
                    const std::string& part = "") {
  const std::string found = refusal(with_line(number, line));
  const std::string expected = "bad.yaml:" + std::to_string(number) + ": " + start;
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
  EXPECT_NE(found.find(part), std::string::npos) << part << "\nnot in: " << found;
}

TEST(SceneBadInput, TheSceneThatIsSpoiltIsGood) { EXPECT_NO_THROW(build(parse_scene(text_of(kLines), "good.yaml"))); }

TEST(SceneBadInput, UnknownKeysSuggestTheNearest) {
  expect_refused(7, "metod:", "metod: unknown key 'metod'; did you mean 'method'?");
  expect_refused(3, "  cel: 0.1", "grid.cel: unknown key 'cel'; did you mean 'cell'?");
  expect_refused(14, "    desnity: 1000", "materials.soft.desnity: unknown key 'desnity'; did you mean 'density'?");
  expect_refused(17, "    friction_angle: 35 deg",
                 "materials.soft.friction_angle: unknown key 'friction_angle'; known here:");
  expect_refused(29, "boundaries: {zmin: slip}", "boundaries.zmin: unknown key 'zmin'; did you mean 'z_min'?");
  expect_refused(30, "output: {perod: 0.02}", "output.perod: unknown key 'perod'; did you mean 'period'?");
  expect_refused(9, "  updaet: usf", "method.updaet: unknown key 'updaet'; did you mean 'update'?");
  expect_refused(25, "    shape: {spher: {radius: 0.1}}", "rigid_bodies.ball.shape.spher: unknown key", "'sphere'");
}

TEST(SceneBadInput, UnknownWordsSuggestTheNearest) {
  expect_refused(9, "  update: usavgg", "method.update: 'usavgg' is not known; did you mean 'usavg'?");
  expect_refused(15, "    law: neo_hookian",
                 "materials.soft.law: 'neo_hookian' is not known; did you mean 'neo_hookean'?");
  expect_refused(20, "    material: sofd", "bodies.block.material: no material 'sofd'; did you mean 'soft'?");
  expect_refused(30, "output: {particle_fields: [vxx]}",
                 "output.particle_fields.0: no particle field 'vxx'; did you mean");
  expect_refused(31, "metrics: {m: {mean: vx, of: blok}}", "metrics.m.of: no body 'blok'; did you mean 'block'?");
  expect_refused(29, "boundaries: {all: sticky}",
                 "boundaries.all: 'sticky' is not known; write one of none, fixed, slip");
}

TEST(SceneBadInput, WhatIsNotBuiltYetSaysSo) {
  expect_refused(28, "transport: {}", "transport: names no quantity;");
  expect_refused(28, "cracks: {}", "cracks: cracks and a solid scene do not go together:");
  expect_refused(21, "    shape: {mesh: {file: a.stl}}", "bodies.block.shape.mesh: 'mesh' is no key here; use box");
}

TEST(SceneBadInput, WrongUnitsAndValues) {
  expect_refused(16, "    young: 1 mm", "materials.soft.young: '1 mm' is a length, but a pressure is expected;");
  expect_refused(16, "    young: 1 MPaa", "materials.soft.young: unknown unit 'MPaa'; did you mean 'MPa'?");
  expect_refused(16, "    young: stiff",
                 "materials.soft.young: 'stiff' is not a number; write a pressure, such as 5 kPa");
  expect_refused(3, "  cell: -0.1", "grid.cell: '-0.1' is not greater than 0;");
  expect_refused(3, "  cell: 0", "grid.cell: '0' is not greater than 0;");
  expect_refused(3, "  cell: .nan", "grid.cell: '.nan' is not a number;");
  expect_refused(3, "  cell: 1e999", "grid.cell: '1e999' is not a number;");
  expect_refused(3, "  cell:", "grid.cell: has no value;");
  expect_refused(6, "time: {end: 1, cfl: 1}", "time.cfl: '1' is not below 1");
  expect_refused(6, "time: {end: 1 kg}", "time.end: '1 kg' is a mass, but a time is expected;");
  expect_refused(6, "time: {end: -1}", "time.end: '-1' is less than 1e-07 s;");
  expect_refused(11, "gravity: [0, -9.81]", "gravity: found 2 components; write three components, [x, y, z]");
  expect_refused(11, "gravity: -9.81", "gravity: found one value; write three components");
  expect_refused(10, "  transfer: {flip: 1.5}", "method.transfer.flip: '1.5' is not a fraction;");
  expect_refused(10, "  particles_per_cell: 4",
                 "method.particles_per_cell: 4 is not possible; a solid scene has 1, 8 or 27");
  expect_refused(10, "  gradient_terms: 0",
                 "method.gradient_terms: 0 is less than 1; write a whole number from 1 to 12");
  expect_refused(10, "  gradient_terms: 2.5", "method.gradient_terms: '2.5' is not a whole number;");
  expect_refused(10, "  precision: half", "method.precision: 'half' is not known; write one of single, double");
  expect_refused(10, "  damping: -1", "method.damping: '-1' is less than 0;");
  expect_refused(27, "    motion: {velocity: [0, 0, \"-0.1*tt\"]}",
                 "rigid_bodies.ball.motion.velocity.2: expression '-0.1*tt': unknown name 'tt'");
  expect_refused(26, "    pose: {quaternion: [0, 0, 0, 0]}",
                 "rigid_bodies.ball.pose.quaternion: its length is 0, not 1;");
  expect_refused(28, "contact: {friction: -0.1}", "contact.friction: '-0.1' is less than 0;");
  expect_refused(28, "contact: {friction: sticky}", "contact.friction: expression 'sticky': unknown name 'sticky';");
  expect_refused(19, "  - name: a block", "bodies.a block.name: 'a block' is not a name;");
}

TEST(SceneBadInput, MaterialConstantsOutOfRange) {
  expect_refused(14, "    density: 0", "materials.soft.density: ");
  expect_refused(14, "    density: -1000", "materials.soft.density: ");
  expect_refused(16, "    young: 0", "materials.soft.young: ");
  expect_refused(17, "    poisson: 0.5", "materials.soft.poisson: ");
  expect_refused(17, "    poisson: 0.6", "materials.soft.poisson: ");
  expect_refused(17, "    poisson: -1", "materials.soft.poisson: ");
  expect_refused(17, "    poisson: 10 deg", "materials.soft.poisson: '10 deg' is an angle,");
}

TEST(SceneBadInput, SoilConstantsOutOfRange) {
  const auto soil = [](const std::string& last) {
    return refusal(with_line(17, "    poisson: 0.3\n    friction_angle: 30 deg\n    " + last),
                   {"materials.soft.law=drucker_prager"});
  };
  const auto starts = [&soil](const std::string& last, const std::string& start) {
    const std::string found = soil(last);
    EXPECT_EQ(found.substr(0, start.size()), start) << found;
  };
  starts("dilation_angle: 31 deg", "bad.yaml:19: materials.soft.dilation_angle: ");
  starts("dilation_angle: -1 deg", "bad.yaml:19: materials.soft.dilation_angle: ");
  starts("cohesion: -1", "bad.yaml:19: materials.soft.cohesion: ");
  starts("tension_cutoff: -1", "bad.yaml:19: materials.soft.tension_cutoff: '-1' is less than 0;");
  starts("match: inner", "bad.yaml:19: materials.soft.match: 'inner' is not known; write one of mohr_coulomb");
  // Without a unit an angle is in radians, and 30 is beyond a right angle.
  const std::string found =
      refusal(with_line(17, "    poisson: 0.3\n    friction_angle: 30"), {"materials.soft.law=drucker_prager"});
  EXPECT_EQ(found.find("bad.yaml:18: materials.soft.friction_angle: '30', 1718.87 deg, is not below 90 deg"), 0U)
      << found;
}

TEST(SceneBadInput, MissingKeysAndNamesTwice) {
  EXPECT_EQ(refusal("materials: []\n"), "bad.yaml:1: scene: the key 'grid' is missing; add it");
  std::vector<std::string> lines = kLines;
  lines.erase(lines.begin() + 13);
  EXPECT_EQ(refusal(text_of(lines)), "bad.yaml:13: materials.soft: the key 'density' is missing; add it");
  expect_refused(24, "  - name: block", "rigid_bodies.block: 'block' is already the name of a deformable body;");
  expect_refused(17, "    density: 3", "materials.0.density: the key is written twice; keep one of them");
  expect_refused(11, "name: again", "name: the key is written twice;");
}

TEST(SceneBadInput, TextThatIsNotAScene) {
  EXPECT_EQ(refusal("grid: [1, 2\nname: x\n").substr(0, 9), "bad.yaml:");
  EXPECT_NE(refusal("grid: [1, 2\nname: x\n").find("not YAML"), std::string::npos);
  EXPECT_NE(refusal("").find("a scene is a list of 'key: value' lines"), std::string::npos);
  EXPECT_NE(refusal("- a\n- b\n").find("found a list"), std::string::npos);
  EXPECT_NE(refusal("a: 1\n---\nb: 2\n").find("2 YAML documents"), std::string::npos);
  EXPECT_NE(refusal("&a [*a]\n"), "no error");
  EXPECT_NE(refusal("a: &a [*a]\n").find("nested too deep"), std::string::npos);
  EXPECT_NE(refusal("[1, 2]: 3\n").find("a key must be a word"), std::string::npos);
}

// Characters that look right and are not: each error says which character it is.
TEST(SceneBadInput, CharactersThatLookLikeOthers) {
  const std::string good = text_of(kLines);
  const auto found = [&](const std::string& set) { return refusal(good, {set}); };
  EXPECT_NE(found("gravity=[0, 0, \u22129.81]").find("it has a Unicode minus (U+2212); write '-' in its place"),
            std::string::npos);
  EXPECT_NE(found("time.end=2\u00a0s").find("it has a no-break space (U+00A0), which looks like a space"),
            std::string::npos);
  const std::string key = refusal(good + "grid\u200b: {cell: 1}\n");
  EXPECT_NE(key.find("it has a zero-width space (U+200B), which is not seen; delete it"), std::string::npos) << key;
  EXPECT_NE(refusal(good, {"materials.0.<<={young: 1}"}).find("merge keys are not understood; write the keys out"),
            std::string::npos);
  // Lists a key once that several laws have.
  const std::string listed = refusal(good, {"materials.0.qqqqqq=1"});
  EXPECT_EQ(listed.find("young"), listed.rfind("young")) << listed;
}

TEST(SceneBadInput, AWrongShapeListsAll) {
  expect_refused(25, "    shape: {boks: {}}",
                 "rigid_bodies.ball.shape.boks: unknown key 'boks'; did you mean 'box'? write one of mesh, urdf, box, "
                 "sphere, cylinder, capsule, plane, height_field, polygon, revolved, cone, ring");
  expect_refused(21, "    shape: {boks: {}}",
                 "bodies.block.shape.boks: ", "write one of box, sphere, cylinder, height_field");
}

TEST(SceneBadInput, FilesThatAreNotThere) {
  const auto why = [](const std::string& name) {
    try {
      load_scene(name);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string folder = std::filesystem::current_path().string();
  const std::string lost = why("no/such/scene.yaml"), home = why("~/scene.yaml");
  EXPECT_EQ(lost.find("no/such/scene.yaml: no such scene file in " + folder + "/no/such; write an absolute path"), 0U)
      << lost;
  EXPECT_NE(home.find("~ is not the home folder here"), std::string::npos) << home;
  EXPECT_NE(why("/no/such/scene.yaml").find("in /no/such; check the path, or name"), std::string::npos);
  EXPECT_EQ(why("eastic_block"), "eastic_block: no shipped scene of that name; did you mean 'elastic_block'?");
  expect_refused(25, "    shape: {mesh: {file: nowhere.stl}}",
                 "rigid_bodies.ball.shape.mesh.file: nowhere.stl: no such file in " + folder + ";");
  expect_refused(25, "    shape: {mesh: {file: ~/tool.stl}}", "rigid_bodies.ball.shape.mesh.file: ~/tool.stl: no such",
                 "~ is not the home folder");
  expect_refused(25, "    shape: {mesh: {file: \"file://tool.stl\"}}",
                 "rigid_bodies.ball.shape.mesh.file: file://tool.stl: file:// takes an absolute path");
  expect_refused(25, "    shape: {mesh: {file: \"file:///no/tool.stl\"}}",
                 "rigid_bodies.ball.shape.mesh.file: ", "no such file in /no;");
  expect_refused(25, "    shape: {mesh: {file: \"package://no_such_package/a.stl\"}}",
                 "rigid_bodies.ball.shape.mesh.file: ", "no_such_package");
}

TEST(SceneBadInput, AMeshThatIsNotClosed) {
  // Three faces of a tetrahedron.
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "mpm_scene_open_mesh.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  expect_refused(25, "    shape: {mesh: {file: " + file.string() + "}}",
                 "rigid_bodies.ball.shape.mesh.file: ", "closed");
  std::filesystem::remove(file);
}

TEST(SceneBadInput, PlacesThatCannotBe) {
  expect_refused(5, "  max: [1, 1, 0]", "grid.max: z = 0 m is not above grid.min (0 m);");
  expect_refused(5, "  max: [1, 1, 1.05]",
                 "grid.max: 10.5 cells along z; a grid is a whole number of cells: write max z = ");
  expect_refused(21, "    shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 1.6]}}",
                 "bodies.block.shape: body 'block' reaches out of the grid along z");
  expect_refused(21, "    shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.25]}}",
                 "bodies.block.shape: body 'block' is smaller than a cell along z: 0.05 m in a cell of 0.1 m;");
  expect_refused(21, "    shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.1, 0.6]}}",
                 "bodies.block.shape.box.max: y = 0.1 m is not above the box's min (0.2 m);");
}

TEST(SceneBadInput, BodiesThatOverlap) {
  // Both contain the cube from 0.5 to 0.6: one cell, 2 x 2 x 2 particles.
  const std::string second =
      "    initial: {}\n  - {name: other, material: soft, shape: {box: {min: [0.5, 0.5, 0.5], max: [0.7, 0.7, 0.7]}}}";
  const std::string found = refusal(with_line(22, second));
  EXPECT_EQ(found.find("bad.yaml:23: bodies.other.shape: bodies 'other' and 'block' overlap: both hold 8 "), 0U)
      << found;
  // Bodies that share a face do not overlap.
  const std::string beside =
      "    initial: {}\n  - {name: other, material: soft, shape: {box: {min: [0.2, 0.2, 0.6], max: [0.6, 0.6, 0.7]}}}";
  EXPECT_EQ(refusal(with_line(22, beside)), "no error");
}

TEST(SceneBadInput, ABodyInsideARigidBody) {
  // The ball's centre is on the block's top: the deepest particle centres, at (0.375, 0.375, 0.575) and around, are 0.1
  // - 0.025 sqrt(3) = 0.0567 m inside.
  const std::string found = refusal(with_line(26, "    pose: {position: [0.4, 0.4, 0.6]}"));
  EXPECT_EQ(found.find("bad.yaml:21: bodies.block.shape: body 'block' overlaps rigid body 'ball' at the start: "), 0U)
      << found;
  EXPECT_NE(found.find("the deepest by 0.0567 m"), std::string::npos) << found;
  // The ball touches: its lowest point is on the block's face.
  EXPECT_EQ(refusal(with_line(26, "    pose: {position: [0.4, 0.4, 0.7]}")), "no error");
}

TEST(SceneBadInput, TimesThatDoNotFit) {
  EXPECT_EQ(refusal(with_line(30, "output: {period: 0.025}"), {"time.sync=0.01"}),
            "bad.yaml:30: output.period: 0.025 s is not a whole number of sync periods of 0.01 s; write 0.03 s");
  EXPECT_EQ(refusal(text_of(kLines), {"time.sync=1.5 ns"}),
            "--set time.sync=1.5 ns: time.sync: 1.5e-09 s is not a whole number of nanoseconds; write 2e-09 s");
  // A prime number of nanoseconds has no divisor.
  expect_refused(30, "output: {period: 0.020000003}",
                 "output.period: 0.020000003 s cannot be divided into sync periods");
}

TEST(SceneBadInput, OverridesThatDoNotFit) {
  const std::string good = text_of(kLines);
  EXPECT_EQ(refusal(good, {"grid.cell"}), "--set grid.cell: an override is key.path=value, as in grid.cell=0.02");
  EXPECT_EQ(refusal(good, {"bodies.blok.material=soft"}),
            "--set bodies.blok.material=soft: bodies: no element 'blok'; did you mean 'block'?");
  EXPECT_EQ(refusal(good, {"metod.update=usf"})
                .find("--set metod.update=usf: metod: unknown key 'metod'; did you mean 'method'?"),
            0U)
      << refusal(good, {"metod.update=usf"});
  EXPECT_EQ(refusal(good, {"grid.cell.x=1"}),
            "--set grid.cell.x=1: grid.cell: is one value without keys; set 'grid.cell' itself");
  EXPECT_EQ(refusal(good, {"grid..cell=1"}).find("--set grid..cell=1: "), 0U);
  EXPECT_EQ(refusal(good, {"grid.cell=-1"}).find("--set grid.cell=-1: grid.cell: '-1' is not greater than 0"), 0U);
  EXPECT_EQ(refusal(good, {"grid.cell=[1"}).find("--set grid.cell=[1: grid.cell: the value is not YAML"), 0U);
}

TEST(SceneBadInput, PlanarScenesRefuseTheThirdDimension) {
  const std::string planar =
      "geometry: plane_strain\n"
      "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.3}]\n"
      "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n";
  EXPECT_EQ(refusal(planar), "no error");
  EXPECT_EQ(refusal(planar + "gravity: [0, 0, -9.81]\n"),
            "bad.yaml:5: gravity: found 3 components; write two components, [x, z], for the scene is planar");
  EXPECT_EQ(refusal(planar + "boundaries: {y_min: slip}\n").find("bad.yaml:5: boundaries.y_min: "), 0U);
  EXPECT_EQ(refusal(planar + "rigid_bodies: [{name: b, shape: {mesh: {file: a.stl}}}]\n")
                .find("bad.yaml:5: rigid_bodies.b.shape.mesh: a planar scene has no mesh"),
            0U);
  EXPECT_EQ(refusal(planar + "rigid_bodies: [{name: b, shape: {sphere: {radius: 0.1}}, pose: {rpy: [0.1, 0, 0]}}]\n")
                .find("bad.yaml:5: rigid_bodies.b.pose.rpy: turns the body out of the plane"),
            0U);
}

// A randomly mutated scene is either read or refused with a SceneError.
TEST(SceneBadInput, MutatedScenesNeverEscape) {
  const std::string good = text_of(kLines);
  const std::string letters = " \n:{}[],-.0159eE\"'#&*|>%?@!xyzt";
  std::mt19937 random(20240607);
  const auto below = [&random](std::size_t n) { return random() % n; };
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string text = good;
    const std::size_t edits = 1 + below(4);
    for (std::size_t e = 0; e < edits && !text.empty(); ++e) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = letters[below(letters.size())];
          break;
        case 1:
          text.erase(at, 1 + below(12));
          break;
        case 2:
          text.insert(at, 1, letters[below(letters.size())]);
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(30)));
      }
    }
    try {
      parse_scene(text, "mutated.yaml");
    } catch (const SceneError&) {
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "round " << round << ": " << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(refused, 100);  // otherwise the mutations are too mild
}

// A wave of speed c, c^2 = 1.346 E / density at nu = 0.3, crosses half a cell of 0.1 m in each step: 1e7 steps in a
// sync period of 1 ms are c = 5e8 m/s, and E = 1.857e20 Pa.
TEST(SceneBadInput, StepsThatCannotBeMeant) {
  const auto refusal = [](const std::string& text) { return scene_bad_input_test::refusal(text, {"time.sync=0.001"}); };
  EXPECT_EQ(refusal(with_line(16, "    young: 1.85e20")), "no error");
  const std::string just = refusal(with_line(16, "    young: 1.87e20"));
  EXPECT_EQ(just.find("bad.yaml: materials.soft: its wave of 5.01"), 0U) << just;
  EXPECT_NE(just.find("check its stiffness, its density and their units"), std::string::npos) << just;
  for (const std::string young : {"1e30", "1e60"}) {
    const std::string found = refusal(with_line(16, "    young: " + young));
    EXPECT_EQ(found.find("bad.yaml: materials.soft: its wave of "), 0U) << found;
  }
  const std::string step = refusal(with_line(6, "time: {end: 1, cfl: 0.5, step: 1e-12}"));
  EXPECT_EQ(step.find("bad.yaml: time.step: it means 1e+09 steps of 1e-12 s in each sync period of 0.001 s"), 0U)
      << step;
}

TEST(SceneBadInput, NumbersBeyondAllMeasure) {
  const auto refused = [](std::size_t line, const std::string& text, const std::string& where,
                          const std::string& number) {
    expect_refused(line, text,
                   where + ": '" + number + "' is beyond 1e-60 to 1e+60 SI units, where products overflow; ");
  };
  refused(16, "    young: 1e300", "materials.soft.young", "1e300");
  refused(14, "    density: 1e-300", "materials.soft.density", "1e-300");
  refused(11, "gravity: [0, 0, -1e300]", "gravity.2", "-1e300");
  refused(22, "    initial: {velocity: [1e300, 0, 0]}", "bodies.block.initial.velocity.0", "1e300");
  refused(27, "    motion: {velocity: [0, 0, -2e60]}", "rigid_bodies.ball.motion.velocity.2", "-2e60");
  EXPECT_EQ(refusal(with_line(27, "    motion: {velocity: [0, 0, 1e-50]}")), "no error");
}

}  // namespace scene_bad_input_test
}  // namespace mpm
