// target: the choice of a discretisation from a table and costs that are made up, with the best one worked out by hand;
// the section's refusals; and that a recorded choice is read and not made anew.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mpm/scene/target_choice.hpp"

namespace mpm {
namespace target_test {

using namespace pace;

// One problem in a plane. The answer is 1; errors of the grid are 10, 2 and 1 % with 4, 8 and 16 cells. With 8 cells
// single precision adds 1 % to the force and USF 3 %; the smallest cfl is 0.25, and from there 0.5 changes the force by
// 1.02/1 - 1 = 2 %, 0.75 by 4 %.
const char* const kTable =
    "problem,axes,cells,along,precision,update,cfl,force,cost\n"
    "blade,2,16,2,double,usavg,0.5,0.99,100\n"
    "blade,2,4,2,double,usavg,0.5,1.10,100\n"
    "blade,2,8,2,double,usavg,0.5,1.02,100\n"
    "blade,2,8,2,single,usavg,0.5,1.0302,50\n"
    "blade,2,8,2,double,usf,0.5,1.0506,80\n"
    "blade,2,8,2,double,usavg,0.25,1.00,100\n"
    "blade,2,8,2,double,usavg,0.75,1.04,100\n";

ForceErrors table(const std::string& text = kTable) {
  std::istringstream in(text);
  return read_force_errors(in);
}

Discretisation usual() { return {Vec3::Constant(0.1), 2, Precision::float64, UpdateScheme::usavg, 0.5}; }

TEST(ForceErrors, OfAGridAreReadBetweenNumbersOfCells) {
  const auto grid = [](double cells) { return table().of(usual(), cells, GeometryKind::plane_strain)->grid; };
  EXPECT_NEAR(grid(4.0), 0.10, 1e-12);
  EXPECT_NEAR(grid(8.0), 0.02, 1e-12);
  EXPECT_NEAR(grid(std::sqrt(32.0)), std::sqrt(0.1 * 0.02), 1e-12);  // in the middle, as powers go
  EXPECT_NEAR(grid(16.0), 0.01, 1e-12);
  EXPECT_NEAR(grid(100.0), 0.01, 1e-12) << "finer than all counts as the finest";
  EXPECT_FALSE(table().of(usual(), 3.9, GeometryKind::plane_strain)) << "coarser than all has no figure";
  EXPECT_FALSE(table().of(usual(), 8.0, GeometryKind::solid)) << "nor has a solid";
  Discretisation many = usual();
  many.along = 3;
  EXPECT_FALSE(table().of(many, 8.0, GeometryKind::plane_strain)) << "nor so many particles";
}

TEST(ForceErrors, AProblemCountsWithItsCoarsestGridOnCoarserOnes) {
  // A second problem with 8 cells alone, 14 % wrong: the mean square of 10 and 14 % with 4 cells, of 2 and 14 with 8.
  const ForceErrors two = table(std::string(kTable) + "wheel,2,8,2,double,usavg,0.5,0.86,100\n");
  const auto grid = [&](double cells) { return two.of(usual(), cells, GeometryKind::plane_strain)->grid; };
  EXPECT_NEAR(grid(4.0), std::sqrt((0.01 + 0.0196) / 2.0), 1e-12);
  EXPECT_NEAR(grid(8.0), std::sqrt((0.0004 + 0.0196) / 2.0), 1e-12);
}

TEST(ForceErrors, OfPartsAreTheChangesThatTheyAloneMake) {
  Discretisation one = usual();
  one.precision = Precision::float32;
  one.update = UpdateScheme::usf;
  one.cfl = 0.75;
  const ForceError error = *table().of(one, 8.0, GeometryKind::plane_strain);
  EXPECT_NEAR(error.precision, 0.01, 1e-12);
  EXPECT_NEAR(error.update, 0.03, 1e-12);
  EXPECT_NEAR(error.step, 0.04, 1e-12);
  EXPECT_NEAR(error.total(), std::sqrt(4.0 + 1.0 + 9.0 + 16.0) / 100.0, 1e-12);
  one.cfl = 0.25;
  EXPECT_NEAR(table().of(one, 8.0, GeometryKind::plane_strain)->step, 0.01, 1e-12);  // half of that at 0.5
  EXPECT_NEAR(table().cost_factor(Precision::float32, UpdateScheme::usavg), 0.5, 1e-12);
  EXPECT_NEAR(table().cost_factor(Precision::float32, UpdateScheme::usf), 1.0, 1e-12) << "without a figure";
}

TEST(ForceErrors, ABadTableIsRefusedWithItsLine) {
  const auto refused = [](const std::string& text) {
    try {
      table(text);
      return std::string("no error");
    } catch (const FiguresError& error) {
      return std::string(error.what());
    }
  };
  const std::string head = "problem,axes,cells,along,precision,update,cfl,force,cost\n";
  EXPECT_EQ(refused("a,b\n").find("line 1: not the header"), 0U);
  EXPECT_EQ(refused(head + "blade,4,8,2,double,usavg,0.5,1,1\n"), "line 2: '4' is not a whole number from 2 to 3");
  EXPECT_EQ(refused(head + "blade,2,8,2,half,usavg,0.5,1,1\n"), "line 2: 'half' is no precision");
  EXPECT_EQ(refused(head + "blade,2,8,2,double,leap,0.5,1,1\n"), "line 2: 'leap' is no update");
  EXPECT_EQ(refused(head + "blade,2,nan,2,double,usf,0.5,1,1\n"), "line 2: 'nan' is not a number greater than 0");
  EXPECT_EQ(refused(head + "blade,2,8\n"), "line 2: 3 cells, not 9");
  EXPECT_EQ(refused(head).find("no run in double precision"), 0U);
}

// 1000 particles of 10 us a step: a step of the base takes 10 ms. A wave needs 20 ms for a cell, so a step is 10 ms
// long at cfl 0.5, and the base runs in real time. Sync periods are 1 s, so that whole steps hardly round.
StepCosts costs() {
  StepCosts given;
  given.geometry = GeometryKind::plane_strain;
  given.base = usual();
  given.particles = 1000.0;
  given.sync = 1.0;
  given.wave_time = 0.02;
  given.particle_step = [](Precision precision, UpdateScheme update) {
    return 1e-5 * (precision == Precision::float32 ? 0.5 : 1.0) * (update == UpdateScheme::usf ? 0.8 : 1.0);
  };
  return given;
}

TEST(TargetChoice, ThePaceIsThatOfStepsAndParticles) {
  Discretisation one = usual();
  EXPECT_NEAR(costs().pace(one), 1.0, 1e-12);
  one.cell = Vec3(0.2, 1.0, 0.2);  // y counts for nothing in a plane
  EXPECT_NEAR(costs().pace(one), 8.0, 1e-12) << "a quarter of the particles, half of the steps";
  one = usual();
  one.along = 3;
  EXPECT_NEAR(costs().pace(one), 4.0 / 9.0, 1e-12);
  one = usual();
  one.precision = Precision::float32;
  one.update = UpdateScheme::usf;
  EXPECT_NEAR(costs().pace(one), 2.5, 1e-12);
  one.cfl = 0.9;  // 55.6 steps: 56
  EXPECT_NEAR(costs().pace(one), 2.5 * 100.0 / 56.0, 1e-12);
  StepCosts held = costs();
  held.step = 0.005;
  EXPECT_NEAR(held.pace(usual()), 0.5, 1e-12) << "time.step limits the step";
}

SimulationDefinition plane() {
  SimulationDefinition definition;
  definition.geometry = GeometryKind::plane_strain;
  definition.grid.cell = Vec3(0.1, 1.0, 0.1);
  return definition;
}

Target asks(std::optional<double> real_time, std::optional<double> force_error) {
  Target target;
  target.real_time = real_time;
  target.force_error = force_error;
  target.length = 0.8;
  return target;
}

const std::vector<std::pair<Vec3, int>> kCells = {
    {Vec3(0.1, 1.0, 0.1), 2}, {Vec3(0.05, 1.0, 0.05), 2}, {Vec3(0.2, 1.0, 0.2), 2}, {Vec3(0.4, 1.0, 0.4), 2}};

Candidate chosen(const Target& target) {
  const auto all = candidates(target, kCells, plane(), table(), costs());
  return all[choose(target, all)];
}

// By hand, from the table above; errors in percent as the root of grid² + precision² + update² + step², the step's
// being 1.2 at cfl 0.3, 2 at 0.5, 3.6 at 0.7 and 4.8 at 0.9. 8 cells: pace 1 at cfl 0.5, double, USAVG; 4 cells: 8, and
// 16 cells: 1/8. (2 cells have no figure.)
TEST(TargetChoice, APaceGetsTheLeastErrorThatReachesIt) {
  // 1.1 are asked of a candidate. 8 cells, double, cfl 0.5 make 1.0, which is too slow; single precision makes 2.0 with
  // sqrt(4 + 1 + 4) = 3 %, and at cfl 0.3, with 167 steps, 2 x 100/167 = 1.198 and sqrt(4 + 1 + 1.44) = 2.54 %. Double
  // precision at cfl 0.7 makes 100/72 = 1.39 with sqrt(4 + 12.96) = 4.12 %.
  const Candidate best = chosen(asks(1.0, {}));
  EXPECT_EQ(discretisation_text(best.what, GeometryKind::plane_strain),
            "cell 0.1 m, 4 particles a cell, single, usavg, cfl 0.3");
  EXPECT_NEAR(best.pace, 2.0 * 100.0 / 167.0, 1e-9);
  EXPECT_NEAR(best.error.total(), std::sqrt(6.44) / 100.0, 1e-9);
  // A slow target has room for 16 cells.
  EXPECT_EQ(chosen(asks(0.02, {})).what.cell.x(), 0.05);
  // Kept in the scene, precision is not changed: cfl 0.7 is then the least error that is fast enough, as near as none
  // to that of USF at cfl 0.5, sqrt(4 + 9 + 4) = 4.12 %, which makes 1.25.
  Target kept = asks(1.0, {});
  kept.keep = {"method.precision"};
  EXPECT_EQ(discretisation_text(chosen(kept).what, GeometryKind::plane_strain),
            "cell 0.1 m, 4 particles a cell, double, usavg, cfl 0.7");
}

TEST(TargetChoice, AnErrorGetsTheFastestThatKeepsIt) {
  // 4.5 %: 8 cells with single precision at cfl 0.7, sqrt(4 + 1 + 12.96) = 4.24 %, makes 2 x 100/72 = 2.78; USF at cfl
  // 0.5 has as much, sqrt(4 + 1 + 9 + 4), and makes 2.5; single precision at cfl 0.9 has 5.3 %.
  const Candidate best = chosen(asks({}, 0.045));
  EXPECT_EQ(discretisation_text(best.what, GeometryKind::plane_strain),
            "cell 0.1 m, 4 particles a cell, single, usavg, cfl 0.7");
  EXPECT_TRUE(reaches(asks({}, 0.045), best));
  // None keeps 1 %: the least there is, 16 cells in double precision at cfl 0.3, sqrt(1 + 1.44) = 1.56 %.
  const Candidate least = chosen(asks({}, 0.01));
  EXPECT_FALSE(reaches(asks({}, 0.01), least));
  EXPECT_NEAR(least.error.total(), std::sqrt(2.44) / 100.0, 1e-9);
}

TEST(TargetChoice, OutOfReachIsTheFastestOfBearableError) {
  const Candidate best = chosen(asks(1e9, {}));
  EXPECT_FALSE(reaches(asks(1e9, {}), best));
  EXPECT_LE(best.error.total(), kMostError);
  const auto all = candidates(asks(1e9, {}), kCells, plane(), table(), costs());
  for (const Candidate& one : all) EXPECT_TRUE(one.error.total() > kMostError || one.pace <= best.pace * 1.02);
}

TEST(TargetChoice, TheFrontHasNoneThatIsBeatenAndTheTableShowsIt) {
  const auto all = candidates(asks(1.0, {}), kCells, plane(), table(), costs());
  const auto best = front(all);
  ASSERT_GT(best.size(), 3U);
  for (std::size_t i = 1; i < best.size(); ++i) {
    EXPECT_GT(best[i].pace, best[i - 1].pace);
    EXPECT_GT(best[i].error.total(), best[i - 1].error.total());
  }
  const std::string text =
      candidates_table(all, chosen(asks(1.0, {})), discretisation_of(plane()), GeometryKind::plane_strain);
  for (const char* part : {"chosen ", "the scene ", "more exact ", "faster ", "error %"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(TargetChoice, LinesSayWhatDiffersInAnyUnits) {
  Discretisation one = usual();
  EXPECT_TRUE(set_lines(one, usual(), GeometryKind::solid).empty());
  one = {Vec3(0.05, 0.05, 0.1), 3, Precision::float32, UpdateScheme::usf, 0.9};
  EXPECT_EQ(set_lines(one, usual(), GeometryKind::solid),
            (std::vector<std::string>{"grid.cell=[0.05 m, 0.05 m, 0.1 m]", "method.particles_per_cell=27",
                                      "method.precision=single", "method.update=usf", "time.cfl=0.9"}));
  EXPECT_EQ(set_lines(one, usual(), GeometryKind::plane_strain)[1], "method.particles_per_cell=9");
}

TEST(TargetChoice, TheStepKeepsAMarginToTheStableOne) {
  EXPECT_DOUBLE_EQ(safe_cfl({TransferKind::flip, 1.0, 2}), 0.9);
  EXPECT_DOUBLE_EQ(safe_cfl({TransferKind::apic, 1.0, 2}), 0.63);  // stable to 0.7: doc/methods.md
}

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
  EXPECT_NEAR(scene.target->length, 0.2, 1e-12) << "the smaller of 0.2 and 0.3 m";
  const Scene set = parse_scene(kScene, "t", {"target.force_error=5 %", "target.length=80 mm"});
  EXPECT_NEAR(*set.target->force_error, 0.05, 1e-15);
  EXPECT_NEAR(set.target->length, 0.08, 1e-15);
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
  EXPECT_EQ(with_recorded_choice(open, chosen.text).text, chosen.text);
  // Not that of another target, nor of a run without one.
  const Scene other = parse_scene(kScene, "t", {"target.real_time=2"});
  EXPECT_FALSE(with_recorded_choice(other, chosen.text).target->chosen);
  EXPECT_FALSE(with_recorded_choice(open, kScene).target->chosen);
  // The lines alone make the same run, and its steps cost the same.
  const Scene by_hand = parse_scene(open.text, "t", {"grid.cell=0.1 m", "method.precision=single", "time.cfl=0.9"});
  EXPECT_EQ(text_without_target(by_hand), text_without_target(chosen));
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
  EXPECT_NE(refused("target.symmetric=y").find("target.symmetric: 'y' is not known"), std::string::npos);
}

TEST(SceneTarget, TheShippedTableHasFiguresForPlanesAndSolids) {
  const ForceErrors errors = load_force_errors(parse_scene(kScene, "t", {"target.real_time=1"}));
  for (const GeometryKind geometry : {GeometryKind::plane_strain, GeometryKind::solid}) {
    const auto coarse = errors.of(usual(), 5.0, geometry), fine = errors.of(usual(), 8.0, geometry);
    ASSERT_TRUE(coarse && fine);
    EXPECT_GE(coarse->grid, fine->grid);
  }
}

}  // namespace target_test
}  // namespace mpm
