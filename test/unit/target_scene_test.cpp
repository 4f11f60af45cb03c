// The section `target` of a scene: its refusals, the cells that fit, that a recorded choice is read and not made anew,
// and the half of a symmetric scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/advice/target_choice.hpp"
#include "mpm/advice/target_half.hpp"
#include "mpm/advice/target_record.hpp"

namespace mpm {
namespace target_scene_test {

const char* const kScene =
    "geometry: plane_strain\n"
    "gravity: [0, -9.81]\n"
    "grid: {cell: 0.05, min: [0, 0], max: [1.6, 0.8]}\n"
    "time: {end: 0.02, sync: 0.005}\n"
    "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg, "
    "dilation_angle: 0 deg, cohesion: 0}]\n"
    "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}}]\n"
    "rigid_bodies: [{name: tool, shape: {polygon: {points: [[0, 0], [0.2, 0], [0.2, 0.3], [0, 0.3]]}}, "
    "pose: {position: [0.7, 0.41]}}]\n"
    "boundaries: {all: slip}\n";

std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    parse_scene(text, "test.yaml", set);
    return "no error";
  } catch (const SceneError& error) {
    return error.what();
  }
}

void expect_start(const std::string& found, const std::string& start) {
  EXPECT_EQ(found.substr(0, start.size()), start) << "whole text: " << found;
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
}

TEST(SceneTarget, EachTargetAndItsOtherKeysAreRead) {
  const Scene scene = parse_scene(std::string(kScene) + "target: {real_time: 0.5, keep: [grid.cell, time.cfl]}\n", "t");
  ASSERT_TRUE(scene.target);
  EXPECT_EQ(scene.target->real_time, 0.5);
  EXPECT_TRUE(scene.target->keeps("grid.cell") && scene.target->keeps("time.cfl"));
  EXPECT_FALSE(scene.target->keeps("method.update"));
  EXPECT_NEAR(scene.target->extent, 0.2, 1e-12) << "the smaller of 0.2 and 0.3 m";
  EXPECT_FALSE(scene.target->length || scene.target->use);
  const Scene set = parse_scene(kScene, "t", {"target={force_error: 5 %, length: 80 mm, tool: wheel}"});
  EXPECT_NEAR(*set.target->force_error, 0.05, 1e-15);
  EXPECT_NEAR(*set.target->length, 0.08, 1e-15);
  EXPECT_EQ(*set.target->use, pace::ToolUse::wheel);
  EXPECT_FALSE(parse_scene(kScene, "t").target);
}

TEST(SceneTarget, IsRefusedInOneLineWithItsPlace) {
  const std::string scene = kScene;
  const auto with = [&](const std::string& keys) { return refusal(scene + "target: {" + keys + "}\n"); };
  expect_start(with("real_tim: 1"), "test.yaml:9: target.real_tim: unknown key 'real_tim'; did you mean 'real_time'?");
  expect_start(with("real_time: 1, force_error: 5 %"),
               "test.yaml:9: target.force_error: a target is a pace or an error, not both; leave one out");
  expect_start(with("keep: [grid.cell]"), "test.yaml:9: target: names no target; write real_time: 1 or force_error");
  for (const char* bad : {"0", "-1", ".nan", "1e99", "fast"})
    expect_start(with(fmt::format("real_time: {}", bad)), "test.yaml:9: target.real_time: ");
  for (const char* bad : {"0", "-5 %", "100 %", "3", ".inf"})
    expect_start(with(fmt::format("force_error: {}", bad)), "test.yaml:9: target.force_error: ");
  expect_start(with("real_time: 1, keep: [cell]"), "test.yaml:9: target.keep.0: 'cell' is not known; ");
  expect_start(with("real_time: 1, tool: plough"), "test.yaml:9: target.tool: 'plough' is not known; ");
  expect_start(with("real_time: 1, length: 0"), "test.yaml:9: target.length: '0' is not greater than 0");
  expect_start(with("real_time: 1, expected: {real_time: 1}"), "test.yaml:9: target.expected: belongs to a recorded");
  expect_start(refusal(scene, {"target=fast"}), "--set target=fast: target: found one value");
  expect_start(refusal(scene, {"target.real_time=0"}), "--set target.real_time=0: target.real_time: '0' is not");
  expect_start(refusal(scene, {"target.real_time=1", "rigid_bodies=[]"}),
               "--set target.real_time=1: target: weighs the force on a tool, and there is no rigid body; ");
  // Another budget beside it; `method: auto` without one may stand there.
  expect_start(refusal(scene + "target: {real_time: 1}\nmethod: {auto: {error: 1 %}}\n"),
               "test.yaml:9: target: method.auto.error is another budget; leave one of them out");
  EXPECT_EQ(refusal(scene + "target: {real_time: 1}\nmethod: auto\n"), "no error");
}

TEST(SceneTarget, CellsFitGridAndBodies) {
  // 32 x 16 cells of 0.05 m: 16 shared parts, so cells are 0.8 m over a whole number from 4 to 64; the faces at 0.4 and
  // 1.6 m lie on a lattice of two a cell with each of them, and of three with even numbers.
  const auto cells = fitting_cells(parse_scene(kScene, "t"));
  EXPECT_EQ(cells.front().first.x(), 0.05);
  EXPECT_EQ(cells.front().second, 2);
  const auto has = [&](double parts, int along) {
    return std::any_of(cells.begin(), cells.end(), [&](const auto& one) {
      return std::abs(one.first.x() * parts / 0.8 - 1.0) < 1e-12 && one.second == along;
    });
  };
  EXPECT_TRUE(has(4, 2) && has(15, 2) && has(64, 2));
  EXPECT_FALSE(has(3, 2) || has(65, 2));
  EXPECT_TRUE(has(14, 3));
  EXPECT_FALSE(has(15, 3));
  for (const auto& [cell, along] : cells) {
    const std::string set = fmt::format("grid.cell={:.15g} m", cell.x());
    EXPECT_NO_THROW(parse_scene(kScene, "t", {set, fmt::format("method.particles_per_cell={}", along * along)})) << set;
  }
}

TEST(SceneTarget, AChoiceIsRecordedAndNotMadeAnew) {
  const Scene open = parse_scene(kScene, "t", {"target.real_time=1"});
  ASSERT_FALSE(open.target->chosen);
  const std::vector<std::string> lines = {"grid.cell=0.1 m", "method.precision=single", "time.cfl=0.9"};
  const Scene chosen = with_chosen(open, lines, 1.25, 0.06);
  EXPECT_EQ(chosen.definition.grid.cell.x(), 0.1);
  EXPECT_EQ(chosen.definition.method.precision, Precision::float32);
  EXPECT_EQ(chosen.definition.time.cfl, 0.9);
  // The text alone brings it back, as a bag or a checkpoint does on another machine.
  const Scene again = parse_scene(chosen.text, "t");
  ASSERT_TRUE(again.target->chosen);
  EXPECT_EQ(*again.target->chosen, lines);
  EXPECT_EQ(again.target->expected_pace, 1.25);
  EXPECT_EQ(again.target->expected_error, 0.06);
  EXPECT_EQ(again.definition.grid.cell, chosen.definition.grid.cell);
  EXPECT_EQ(again.text, chosen.text);
  // The scene itself, loaded again, takes the recorded choice, to the letter: that is what a checkpoint is held
  // against.
  EXPECT_EQ(with_recorded_choice(open, chosen.text).scene.value().text, chosen.text);
  // Not that of another target, nor of a run without one.
  const Scene other = parse_scene(kScene, "t", {"target.real_time=2"});
  EXPECT_EQ(with_recorded_choice(other, chosen.text).why, "the run has another target");
  EXPECT_EQ(with_recorded_choice(open, kScene).why, "the run has no target");
  EXPECT_EQ(with_recorded_choice(open, open.text).why, "nothing was chosen for the run's target");
  // The lines alone make the same run, and its steps cost the same.
  const Scene by_hand = parse_scene(open.text, "t", {"grid.cell=0.1 m", "method.precision=single", "time.cfl=0.9"});
  EXPECT_EQ(text_without_target(by_hand), text_without_target(chosen));
}

TEST(SceneTarget, ARecordedChoiceIsOfThatSceneAlone) {
  const Scene open = parse_scene(kScene, "t", {"target.real_time=1"});
  const Scene chosen = with_chosen(open, {"grid.cell=0.1 m", "time.cfl=0.9"}, 1.25, 0.06);
  const auto with = [&](const std::string& line) {
    return with_recorded_choice(parse_scene(kScene, "t", {"target.real_time=1", line}), chosen.text);
  };
  // Counts what the user sets, be it a key that was chosen or another.
  EXPECT_EQ(with("time.cfl=0.2").why,
            "what was chosen was chosen from time.cfl by default, and the scene has time.cfl=0.2");
  EXPECT_EQ(with("grid.cell=0.2").why,
            "what was chosen was chosen from grid.cell=0.05, and the scene has grid.cell=0.2");
  for (const char* other : {"gravity=[0, -1.6]", "method.precision=single", "grid.max=[1.6, 1.2]"}) {
    EXPECT_FALSE(with(other).scene) << other;
    EXPECT_NE(with(other).why.find(" there and '"), std::string::npos) << with(other).why;
  }
  EXPECT_EQ(with("grid.cell=0.05").scene.value().text, chosen.text) << "said again, it is the same scene";
}

TEST(SceneTarget, ForAnotherTargetWhatWasChosenIsUndone) {
  const Scene open = parse_scene(kScene, "t", {"target.real_time=1"});
  const Scene chosen = with_chosen(open, {"grid.cell=0.1 m", "method.precision=single", "time.cfl=0.9"}, 1.25, 0.06);
  const Scene faster = parse_scene(chosen.text, "t", {"target.real_time=20"});
  EXPECT_FALSE(faster.target->chosen);
  EXPECT_EQ(*faster.target->real_time, 20.0);
  EXPECT_EQ(faster.definition.grid.cell.x(), 0.05);
  EXPECT_EQ(faster.definition.method.precision, open.definition.method.precision);
  EXPECT_EQ(faster.definition.time.cfl, open.definition.time.cfl);
  // But for what is set at the same time.
  const Scene small = parse_scene(chosen.text, "t", {"target.keep=[time.cfl]", "time.cfl=0.2"});
  EXPECT_FALSE(small.target->chosen);
  EXPECT_EQ(small.definition.grid.cell.x(), 0.05);
  EXPECT_EQ(small.definition.time.cfl, 0.2);
}

TEST(SceneTarget, ARecordThatTheSceneContradictsIsRefused) {
  const Scene open = parse_scene(kScene, "t", {"target.real_time=1"});
  const Scene chosen = with_chosen(open, {"grid.cell=0.1 m", "time.cfl=0.9"}, 1.25, 0.06);
  EXPECT_NE(refusal(chosen.text, {"time.cfl=0.2"})
                .find(": target.chosen: time.cfl=0.9 was chosen, and the scene has time.cfl=0.2; replace the target"),
            std::string::npos)
      << refusal(chosen.text, {"time.cfl=0.2"});
  const std::string other = "target={real_time: 1, chosen: [grid.cell=0.1]}";
  expect_start(refusal(kScene, {other}), "--set " + other +
                                             ": target.chosen: grid.cell=0.1 was chosen, and the scene has "
                                             "grid.cell=0.05; replace the target");
  const std::string bare = "target={real_time: 1, chosen: [grid.cell=0.05]}";
  expect_start(refusal(kScene, {bare}), "--set " + bare + ": target.chosen: a record of a choice has before and asked");
  const std::string asked = "target={real_time: 1, asked: {real_time: 1}}";
  expect_start(refusal(kScene, {asked}), "--set " + asked + ": target.asked: belongs to a recorded choice");
}

TEST(SceneTarget, GroundFromAMapKeepsItsFacesAndAnExpressionItsCell) {
  const auto cells = [](const std::string& field) {
    return fitting_cells(parse_scene(kScene, "t", {"bodies.bed.shape={height_field: {x: [0, 1.6], " + field + "}}"}));
  };
  const auto fits = [&](const std::string& field, double parts) {
    const auto all = cells(field);
    return std::any_of(all.begin(), all.end(), [&](const auto& one) {
      return std::abs(one.first.x() * parts / 0.8 - 1.0) < 1e-12 && one.second == 2;
    });
  };
  // Cells of 0.8 m over n, two particles along each: 0.1 m are n/4 of them, 0.2 m are n/2.
  const std::string flat = "heights: [0.41, 0.41]";
  EXPECT_TRUE(fits(flat, 15)) << "the surface is no face";
  EXPECT_TRUE(fits(flat + ", bottom: 0.1", 12));
  EXPECT_FALSE(fits(flat + ", bottom: 0.1", 14));
  EXPECT_TRUE(fits(flat + ", within: {x: [0.2, 1.4]}", 14));
  EXPECT_FALSE(fits(flat + ", within: {x: [0.2, 1.4]}", 15));
  for (const auto& [cell, along] : cells("heights: 0.4 + 0.01*x")) EXPECT_EQ(cell.x(), 0.05);
  EXPECT_TRUE(fits("heights: 0.4 + 0.01*x, cells: 8", 12));
}

TEST(SceneTarget, ASymmetricSceneIsHalvedAtTheMiddleOfItsGrid) {
  // The tool's origin is made its middle: at 0.8 m of 1.6 m.
  const std::vector<std::string> set = {
      "target={real_time: 1, symmetric: x}",
      "rigid_bodies.tool.shape={polygon: {points: [[-0.1, 0], [0.1, 0], [0.1, 0.3], [-0.1, 0.3]]}}",
      "rigid_bodies.tool.pose.position=[0.8, 0.41]"};
  const Scene whole = parse_scene(kScene, "t", set);
  const Scene half = with_chosen(whole, half_lines(whole, *whole.target->symmetric), 1.0, 0.1);
  EXPECT_EQ(half.definition.grid.min.x(), 0.8);
  EXPECT_EQ(half.definition.grid.max.x(), 1.6);
  EXPECT_EQ(half.definition.walls[0].kind, WallKind::symmetry);
  EXPECT_EQ(half.definition.walls[1].kind, WallKind::slip);
  EXPECT_EQ(2 * build(half).bodies[0].positions.size(), build(whole).bodies[0].positions.size());
  EXPECT_EQ(parse_scene(half.text, "t").text, half.text) << "a half is not halved again";
  const Scene again = parse_scene(half.text, "t", {"target.real_time=2"});
  EXPECT_FALSE(again.target->chosen);
  EXPECT_EQ(again.definition.grid.min.x(), 0.0) << "for another target it is whole again";
  EXPECT_EQ(again.definition.walls[0].kind, WallKind::slip);
  EXPECT_EQ(again.bodies[0].region.box.min.x(), 0.0);
  const auto refused = [&](const std::string& more) {
    std::vector<std::string> all = set;
    all.push_back(more);
    return refusal(kScene, all);
  };
  const std::string start =
      "--set target={real_time: 1, symmetric: x}: target.symmetric: the scene is not its own mirror image across the "
      "middle of its grid along x: ";
  expect_start(refused("rigid_bodies.tool.pose.position=[0.7, 0.41]"), start + "rigid body 'tool' does not lie on");
  expect_start(refused("rigid_bodies.tool.motion={velocity: [0.1, 0]}"), start + "rigid body 'tool' moves across");
  expect_start(refused("rigid_bodies.tool.motion={rotation_rate: 1}"), start + "rigid body 'tool' turns out of");
  expect_start(refused("bodies.bed.shape.box.min=[0.2, 0]"), start + "body 'bed' is no box whose middle lies on");
  expect_start(refused("gravity=[1, -9.81]"), start + "gravity pulls across");
  expect_start(refused("boundaries.x_min=fixed"), start + "the two faces of the grid differ");
  // Refuses what acts, or starts, on one side alone.
  expect_start(refused("boundaries={all: slip, x_min: {friction: 0.3}, x_max: {friction: 0.5}}"),
               start + "the two faces of the grid differ");
  EXPECT_EQ(refused("boundaries={all: slip, x_min: {friction: 0.3}, x_max: {friction: 0.3}}"), "no error");
  expect_start(refused("bodies.bed.initial={velocity: [0.1, 0]}"), start + "body 'bed' moves across");
  expect_start(refused("bodies.bed.initial={velocity: [x - 0.8, 0]}"), start + "body 'bed' moves across");
  expect_start(refused("bodies.bed.initial={velocity: [0, x]}"), start + "body 'bed' starts with a velocity that is");
  EXPECT_EQ(refused("bodies.bed.initial={velocity: [0, -0.1]}"), "no error");
  expect_start(refused("bodies.bed.initial={stress: {xx: x}}"), start + "body 'bed' starts with a stress that is");
  expect_start(refused("bodies.bed.initial={stress: {xz: 10}}"), start + "body 'bed' starts with a shear stress");
  EXPECT_EQ(refused("bodies.bed.initial={stress: {xx: 10}}"), "no error");
  expect_start(refused("bodies.bed.jitter=0.2"), start + "body 'bed' has random places");
  expect_start(refused("bodies.bed.cut_out=[tool]"), start + "body 'bed' leaves out");
  expect_start(refused("rigid_bodies.tool.drive={tf: tool0}"), start + "rigid body 'tool' follows a tf frame");
  // Turned by half a radian; a rectangle about its origin reaches as far on both sides even then.
  for (const char* low : {"0", "-0.3"}) {
    std::vector<std::string> turned = set;
    turned.push_back("rigid_bodies.tool.pose={position: [0.8, 0.41], rpy: [0, 0.5, 0]}");
    turned.push_back(fmt::format(
        "rigid_bodies.tool.shape={{polygon: {{points: [[-0.1, {0}], [0.1, {0}], [0.1, 0.3], [-0.1, 0.3]]}}}}", low));
    expect_start(refusal(kScene, turned), start + "rigid body 'tool' reaches further on one side of that plane, or is");
  }
  expect_start(refused("cracks={list: [{name: c, points: [[0.4, 0.2], [1.2, 0.2]], end: none, start: none}]}"),
               start + "cracks are not halved");
  const std::string field = refused("rigid_bodies.tool.shape={height_field: {x: [-0.1, 0.1], heights: [0, 0.1]}}");
  EXPECT_NE(field.find("rigid body 'tool' is a height field"), std::string::npos) << field;
  EXPECT_NE(refused("target.symmetric=y").find("target.symmetric: 'y' is not known"), std::string::npos);
}

// A half of what is carried, held, fed or drained on one side would be doubled or left out.
TEST(SceneTarget, TransportThatIsNotSymmetricIsNotHalved) {
  const auto refused = [&](const std::string& quantity) {
    return refusal(kScene,
                   {"target={real_time: 1, symmetric: x}", "transport={temperature: {" + quantity + "}}",
                    "rigid_bodies.tool.shape={box: {size: [0.2, 0.3]}}", "rigid_bodies.tool.pose.position=[0.8, 0.56]",
                    "materials.sand={name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, "
                    "friction_angle: 30 deg, heat_capacity: 800, conductivity: 1}"});
  };
  const std::string start =
      "--set target={real_time: 1, symmetric: x}: target.symmetric: the scene is not its own mirror image across the "
      "middle of its grid along x: transport.temperature: ";
  for (const char* good : {"initial: 300", "initial: 300 + 10*z",
                           "values: [{region: {box: {min: [0, 0], max: [1.6, 0.1]}}, value: 300 + t + z}]",
                           "fluxes: [{body: bed, edge: z_max, flux: 10}]", "sources: [{rate: 10 + t}]",
                           "tools: [{body: tool, conductance: 100, temperature: 350}]"}) {
    EXPECT_EQ(refused(good), "no error") << good;
  }
  expect_start(refused("initial: 300 + 100*x"), start + "its start differs on the two sides");
  expect_start(refused("values: [{region: {box: {min: [0, 0], max: [0.1, 0.4]}}, value: 300}]"),
               start + "the region of the value 'value_0' lies on one side");
  expect_start(refused("values: [{region: {box: {min: [0, 0], max: [1.6, 0.1]}}, value: 300 + x}]"),
               start + "the value 'value_0' differs");
  expect_start(refused("fluxes: [{body: bed, edge: x_max, flux: 10}]"), start + "the flux 'flux_0' is through a face");
  expect_start(refused("fluxes: [{body: bed, edge: z_max, flux: 10*x}]"), start + "the flux 'flux_0' differs");
  expect_start(refused("fluxes: [{body: bed, edge: z_max, convection: {coefficient: 5, ambient: 300 + x}}]"),
               start + "the flux 'flux_0' differs");
  expect_start(refused("fluxes: [{body: bed, edge: z_max, flux: 10, region: {box: {min: [0, 0.3], max: [0.4, 0.4]}}}]"),
               start + "the flux 'flux_0' has a region on one side");
  expect_start(refused("sources: [{rate: 10*x}]"), start + "a source differs");
  expect_start(refused("tools: [{body: tool, conductance: 100, temperature: 350, heat_capacity: 20}]"),
               start + "the heat capacity of 'tool'");
}

TEST(SceneTarget, GroundIsToldByTheLawsOfMaterials) {
  const auto ground = [](const std::string& law) {
    return ground_of(parse_scene(kScene, "t", {"materials.sand={name: sand, density: 1600, " + law + "}"}).definition);
  };
  const std::string elastic = ", young: 1 MPa, poisson: 0.3";
  EXPECT_EQ(ground("law: drucker_prager, friction_angle: 30 deg" + elastic), pace::Ground::sand);
  EXPECT_EQ(ground("law: mohr_coulomb, friction_angle: 0, cohesion: 1 kPa" + elastic), pace::Ground::clay);
  EXPECT_EQ(ground("law: j2_plasticity, yield_stress: 1 kPa" + elastic), pace::Ground::clay);
  EXPECT_FALSE(ground("law: neo_hookean" + elastic));
  SimulationDefinition implicit =
      parse_scene(
          kScene, "t",
          {"materials.sand={name: sand, density: 1600, law: j2_plasticity, yield_stress: 1 kPa" + elastic + "}"})
          .definition;
  implicit.method.update = UpdateScheme::implicit;
  EXPECT_FALSE(ground_of(implicit)) << "no tool was measured in metal with implicit steps";
  EXPECT_FALSE(
      ground("law: mu_i, mu_s: 0.38, mu_2: 0.64, I_0: 0.28, grain_diameter: 1 mm, grain_density: 2500" + elastic))
      << "no tool was measured in it";
}

TEST(SceneTarget, TheShippedTableHasFiguresForWhatWasMeasuredAndNoOthers) {
  const pace::ForceErrors errors = load_force_errors(parse_scene(kScene, "t", {"target.real_time=1"}));
  using pace::Ground;
  using pace::ToolUse;
  for (const ToolUse use : {ToolUse::blade, ToolUse::plate, ToolUse::wheel}) {
    EXPECT_EQ(errors.covers({use, Ground::sand, 1.0}, GeometryKind::plane_strain), use != ToolUse::wheel);
    EXPECT_EQ(errors.covers({use, Ground::sand, 1.0}, GeometryKind::solid), use == ToolUse::blade);
    EXPECT_EQ(errors.covers({use, Ground::clay, 1.0}, GeometryKind::axisymmetric), use == ToolUse::plate);
  }
  // Half a cell of a blade in the ground was not measured, so nothing is promised there.
  const pace::Discretisation usual = {Vec3::Constant(0.1), 2, Precision::float64, UpdateScheme::usavg, 0.5};
  EXPECT_FALSE(errors.of(usual, {ToolUse::blade, Ground::sand, 0.05}, GeometryKind::plane_strain));
}

}  // namespace target_scene_test
}  // namespace mpm
