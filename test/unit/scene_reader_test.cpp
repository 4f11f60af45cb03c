// Reading of a scene's text: defaults, units, overrides, sync points.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/scene.hpp"
#include "test_files.hpp"

namespace mpm {
namespace scene_reader_test {

const char* const kSmall = R"yaml(grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}
materials:
  - {name: bar, density: 1000, law: linear_elastic, young: 100, poisson: 0.3}
bodies:
  - {name: block, material: bar, shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}}
)yaml";

Scene small(const std::vector<std::string>& overrides = {}) {
  return parse_scene(kSmall, "folder/small.yaml", overrides);
}

TEST(SceneReader, ASmallSceneHasSoundDefaults) {
  const Scene scene = small();
  const SimulationDefinition& d = scene.definition;
  EXPECT_EQ(d.name, "small");
  EXPECT_EQ(d.geometry, GeometryKind::solid);
  EXPECT_EQ(d.grid.cell, Vec3(0.1, 0.1, 0.1));
  EXPECT_EQ(d.time.end, 0.0);
  EXPECT_EQ(d.time.cfl, 0.5);
  EXPECT_FALSE(d.time.step.has_value());
  EXPECT_EQ(d.time.sync, 10'000'000);
  EXPECT_EQ(scene.output.period, 0.02);
  EXPECT_EQ(d.method.particles_per_direction, 2);  // the choice of the method is tested in auto_method_test.cpp
  EXPECT_EQ(d.method.gradient_terms, 2);
  EXPECT_EQ(d.method.precision, Precision::float64);
  EXPECT_EQ(d.gravity, Vec3::Zero());
  for (const WallDefinition& wall : d.walls) EXPECT_EQ(wall.kind, WallKind::none);
  EXPECT_EQ(scene.output.particle_fields, (std::vector<std::string>{"vx", "vy", "vz", "p", "j"}));
  EXPECT_FALSE(scene.choices.empty());
}

TEST(SceneReader, ReadsEveryKeyOfASolidScene) {
  const Scene scene = parse_scene(R"yaml(name: everything
units: si
geometry: solid
grid: {cell: [0.1, 10 cm, 100 mm], min: [-1, -1, -1], max: [1, 1, 1]}
time: {end: 2 s, cfl: 0.4, step: 0.1 ms, sync: 10 ms}
method: {shape: ugimp, update: usf, transfer: {flip: 0.9}, damping: 3, gradient_terms: 3, particles_per_cell: 27, precision: single}
gravity: [0, 0, -9.81]
materials:
  - {name: sand, density: 1600, law: drucker_prager, young: 0.5 MPa, poisson: 0.3, friction_angle: 35 deg,
     dilation_angle: 5 deg, cohesion: 1 kPa, tension_cutoff: 10, match: extension}
  - {name: rubber, density: 1 g/cm^3, law: neo_hookean, young: 1 MPa, poisson: 0.45}
bodies:
  - {name: soil, material: sand, shape: {box: {min: [-1, -1, -1], max: [1, 1, 0]}}, initial: {velocity: [0, 1 mm/s, "2*x"]}}
  - {name: ball, material: rubber, shape: {sphere: {center: [0, 0, 0.5], radius: 0.25}}}
rigid_bodies:
  - name: roller
    shape: {cylinder: {radius: 0.2, height: 0.4, axis: y}}
    pose: {position: [0, 0, 2], rpy: [0, 90 deg, 0]}
    motion: {velocity: ["0.1*(t<1)", 0, 0], rotation_rate: [0, 90 deg/s, 0]}
    friction: stick
  - {
name:
  plate, shape : {box : {size : [ 1, 1, 0.1 ]}}, pose : {
  quaternion:
    [ 0, 0, 0.70710678, 0.70710678 ]
  }
}
contact: {friction: 0.3}
boundaries: {all: slip, z_min: {friction: 0.5}, x_max: none, y_min: fixed}
output: {period: 0.02, particle_fields: [vx, szz], particle_stride: 4}
metrics: {mean_szz: {mean: szz, of: soil}, widest: {max: vx}}
)yaml",
                                  "everything.yaml");
  const SimulationDefinition& d = scene.definition;
  EXPECT_EQ(d.grid.cell, Vec3(0.1, 0.1, 0.1));
  EXPECT_EQ(d.time.end, 2.0);
  EXPECT_EQ(d.time.step, 1e-4);
  EXPECT_EQ(d.time.sync, 10'000'000);
  EXPECT_EQ(d.method.update, UpdateScheme::usf);
  EXPECT_EQ(d.method.transfer.flip, 0.9);
  EXPECT_EQ(d.method.damping.grid(0.0), 3.0);
  EXPECT_EQ(d.method.gradient_terms, 3);
  EXPECT_EQ(d.method.precision, Precision::float32);
  EXPECT_EQ(d.method.particles_per_direction, 3);
  const auto& sand = std::get<DruckerPragerDefinition>(d.materials.at(0).law);
  EXPECT_EQ(sand.elasticity.young, 5e5);
  EXPECT_NEAR(sand.friction_angle, 0.610865238, 1e-9);  // 35 pi / 180, to the digits written
  EXPECT_EQ(sand.cohesion, 1000.0);
  EXPECT_EQ(sand.tension_cutoff, 10.0);
  EXPECT_EQ(sand.match, ConeMatch::extension);
  EXPECT_NEAR(d.materials.at(1).density, 1000.0, 1e-10);  // round-off of the unit's factor
  EXPECT_EQ(scene.bodies.at(0).velocity[1](0.0), 1e-3);
  EXPECT_EQ(scene.bodies.at(0).velocity[2](0.0, Vec3(3, 0, 0)), 6.0);
  EXPECT_EQ(scene.bodies.at(1).region.kind, Region::Kind::sphere);
  const RigidBodyDefinition& roller = d.rigid_bodies.at(0);
  EXPECT_TRUE(roller.friction.stick);
  EXPECT_EQ(roller.velocity[0](0.5), 0.1);
  EXPECT_EQ(roller.velocity[0](1.5), 0.0);
  EXPECT_NEAR(roller.rotation_rate[1](0.0), M_PI / 2, 1e-15);
  // Pitch of 90 degrees takes z to x (right-handed about y).
  EXPECT_NEAR((roller.pose.orientation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 0.0, 1e-15);
  EXPECT_EQ(d.rigid_bodies.at(1).friction.coefficient, 0.3);
  EXPECT_NEAR(d.rigid_bodies.at(1).pose.orientation.norm(), 1.0, 1e-15);
  EXPECT_EQ(d.walls[0].kind, WallKind::slip);        // x_min
  EXPECT_EQ(d.walls[1].kind, WallKind::none);        // x_max
  EXPECT_EQ(d.walls[2].kind, WallKind::fixed);       // y_min
  EXPECT_EQ(d.walls[4].kind, WallKind::frictional);  // z_min
  EXPECT_EQ(d.walls[4].friction.coefficient, 0.5);
  EXPECT_EQ(scene.output.particle_stride, 4);
  ASSERT_EQ(d.metrics.size(), 2U);
  EXPECT_EQ(d.metrics[0].name, "mean_szz");
  EXPECT_EQ(d.metrics[0].body, "soil");
  EXPECT_EQ(d.metrics[1].statistic, Statistic::max);
  EXPECT_EQ(d.metrics[1].body, "");
}

TEST(SceneReader, PlanarScenesLieInXAndZ) {
  const Scene scene = parse_scene(R"yaml(geometry: plane_strain
thickness: 0.5
grid: {cell: 0.1, min: [0, 0], max: [1, 2]}
gravity: [1, -9.81]
method: {particles_per_cell: 9}
materials:
  - {name: bar, density: 1000, law: linear_elastic, young: 100, poisson: 0.3}
bodies:
  - {name: disk, material: bar, shape: {sphere: {center: [0.5, 0.5], radius: 0.3}}}
rigid_bodies:
  - {name: plate, shape: {box: {size: [1, 0.4]}}, pose: {position: [0.5, 1.5], rpy: [0, 0.1, 0]}, motion: {rotation_rate: "t"}}
  - {name: rod, shape: {sphere: {radius: 0.2}}, pose: {position: [0, 5]}}
)yaml",
                                  "plane.yaml");
  const SimulationDefinition& d = scene.definition;
  EXPECT_EQ(d.thickness, 0.5);
  EXPECT_EQ(d.grid.max, Vec3(1, 0.25, 2));
  EXPECT_EQ(d.gravity, Vec3(1, 0, -9.81));
  EXPECT_EQ(d.method.particles_per_direction, 3);
  // The body is infinite along y: the distance does not depend on y.
  EXPECT_NEAR(d.rigid_bodies[0].surface->at(Vec3(0, 1000, 0.3)).distance, 0.1, 1e-12);
  EXPECT_NEAR(d.rigid_bodies[1].surface->at(Vec3(0.3, 1000, 0)).distance, 0.1, 1e-12);
  EXPECT_EQ(d.rigid_bodies[0].rotation_rate[1](2.0), 2.0);
  EXPECT_EQ(d.rigid_bodies[0].rotation_rate[0](2.0), 0.0);
}

TEST(SceneReader, PlainNumbersAndExpressionsAreInTheScenesUnits) {
  const Scene scene = parse_scene(R"yaml(units: {length: mm, mass: g, time: ms}
grid: {cell: 100, min: [0, 0, 0], max: [1000, 1000, 1 m]}
time: {end: 200}
materials:
  - {name: bar, density: 1e-3, law: linear_elastic, young: 2, poisson: 0.3}
bodies:
  - {name: block, material: bar, shape: {box: {min: [200, 200, 200], max: [600, 600, 600]}}, initial: {velocity: ["x", 0, 0]}}
rigid_bodies:
  - {name: ball, shape: {sphere: {radius: 10}}, pose: {position: [0, 0, 2000]}, motion: {velocity: ["t", 0, 0]}}
)yaml",
                                  "small.yaml");
  const SimulationDefinition& d = scene.definition;
  // Round-off of three or four operations each.
  EXPECT_NEAR(d.grid.max.x(), 1.0, 1e-15);
  EXPECT_NEAR(d.time.end, 0.2, 1e-16);
  EXPECT_NEAR(d.materials[0].density, 1000.0, 1e-11);
  EXPECT_NEAR(std::get<LinearElasticDefinition>(d.materials[0].law).elasticity.young, 2e6, 1e-8);  // g/(mm ms^2) = MPa
  EXPECT_NEAR(scene.bodies[0].velocity[0](0.0, Vec3(0.3, 0, 0)), 300.0, 1e-11);                    // 300 mm/ms
  EXPECT_NEAR(d.rigid_bodies[0].velocity[0](0.005), 5.0, 1e-13);                                   // 5 mm/ms at 5 ms
}

TEST(SceneReader, SyncDividesTheOutputPeriod) {
  const auto times = [](const std::string& time, const std::string& output) {
    const Scene scene = small({"time=" + time, "output=" + output});
    return std::make_pair(scene.definition.time.sync, scene.output.period);
  };
  using Pair = std::pair<std::int64_t, double>;
  // end/50 = 0.04 rounded down to 0.02; sync at most 10 ms and end/100 = 20 ms.
  EXPECT_EQ(times("{end: 2}", "{}"), Pair(10'000'000, 0.02));
  // At most 10 ms: 25 ms / 3 is not a whole number of nanoseconds, 25 ms / 4 is.
  EXPECT_EQ(times("{end: 2}", "{period: 0.025}"), Pair(6'250'000, 0.025));
  // end/100 = 1 ms.
  EXPECT_EQ(times("{end: 0.1}", "{}"), Pair(1'000'000, 0.002));
  EXPECT_EQ(times("{end: 0.1}", "{period: 0.03}"), Pair(1'000'000, 0.03));
  // A hundred microseconds: 1 us and 2 us.
  EXPECT_EQ(times("{end: 100 us}", "{}"), Pair(1'000, 2e-6));
  // A period below the limit is its own sync period.
  EXPECT_EQ(times("{end: 2}", "{period: 0.004}"), Pair(4'000'000, 0.004));
  // The default snapshots do not fit this sync period and move to the nearest multiple.
  EXPECT_EQ(times("{end: 2, sync: 0.007}", "{}"), Pair(7'000'000, 0.021));
}

TEST(SceneReader, OverridesReachEveryValue) {
  const Scene scene = small({"grid.cell=0.05", "bodies.block.shape={sphere: {center: [0.5, 0.5, 0.5], radius: 0.2}}",
                             "bodies.0.initial.velocity=[1, 0, 0]", "materials.bar.density=2000",
                             "materials.bar.density=3000", "method.update=usf", "grid.max.2=2"});
  EXPECT_EQ(scene.definition.grid.cell.x(), 0.05);
  EXPECT_EQ(scene.definition.grid.max.z(), 2.0);
  EXPECT_EQ(scene.bodies[0].region.kind, Region::Kind::sphere);
  EXPECT_EQ(scene.bodies[0].velocity[0](0.0), 1.0);
  EXPECT_EQ(scene.definition.materials[0].density, 3000.0);
  EXPECT_EQ(scene.definition.method.update, UpdateScheme::usf);
}

TEST(SceneReader, TheTextKeptReadsBackToTheSameScene) {
  const Scene first = small({"grid.cell=0.05", "time.end=0.3"});
  const Scene again = parse_scene(first.text, "folder/small.yaml");
  EXPECT_EQ(again.text, first.text);
  EXPECT_EQ(again.definition.grid.cell, Vec3(0.05, 0.05, 0.05));
  EXPECT_EQ(again.definition.time.end, 0.3);
}

TEST(SceneReader, FindsShippedScenesByName) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("mpm_scene_reader_test_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "my_own.yaml") << "# One line of description.\n" << kSmall;
  setenv("MPM_ROS_SCENE_PATH", folder.c_str(), 1);
  bool listed = false;
  for (const auto& [name, line] : shipped_scenes())
    listed = listed || (name == "my_own" && line == "One line of description.");
  EXPECT_TRUE(listed);
  EXPECT_EQ(load_scene("my_own").definition.name, "my_own");
  EXPECT_EQ(load_scene((folder / "my_own.yaml").string()).path, (folder / "my_own.yaml").string());
  unsetenv("MPM_ROS_SCENE_PATH");
  std::filesystem::remove_all(folder);
}

TEST(SceneReader, ShippedScenesLoadAndHaveADescription) {
  const auto scenes = shipped_scenes();
  EXPECT_GE(scenes.size(), 4U);
  for (const auto& [name, line] : scenes) {
    EXPECT_NE(line, "") << name;
    // Meshes at package:// are found in a sourced workspace only; other tests run these scenes.
    std::ifstream file(source_file("config/scenes/" + name + ".yaml"));
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (text.find("package://") != std::string::npos) continue;
    EXPECT_NO_THROW(build(load_scene(name))) << name;
  }
}

TEST(Nearest, CountsEdits) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook example
  EXPECT_EQ(edit_distance("methdo", "method"), 1);   // two neighbouring letters swapped
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(nearest("metod", {"grid", "method"}), "method");
  EXPECT_EQ(nearest("zzz", {"grid", "method"}), "");
}

}  // namespace scene_reader_test
}  // namespace mpm
