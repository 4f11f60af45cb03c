// Scenes of every geometry: how values are read, and the refusals of a line and of plane stress.
#include <gtest/gtest.h>

#include "mpm/advice/explain.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_geometry_test {

std::string line_scene(const std::string& rest = "", const std::string& body = "", const std::string& law = "") {
  return "geometry: line\n"
         "grid: {cell: 0.1, min: 0, max: 2}\n"
         "materials:\n"
         "  - {name: bar, density: 1000, " +
         (law.empty() ? "law: neo_hookean, young: 1 MPa, poisson: 0.3" : law) +
         "}\n"
         "bodies:\n"
         "  - {name: rod, material: bar, shape: {box: {min: 0.5, max: 1.5}}" +
         body + "}\n" + rest;
}

std::string plane_scene(const std::string& rest = "", const std::string& body = "", const std::string& law = "") {
  return "geometry: plane_stress\n"
         "grid: {cell: 0.1, min: [0, 0], max: [2, 1]}\n"
         "materials:\n"
         "  - {name: sheet, density: 1000, " +
         (law.empty() ? "law: neo_hookean, young: 1 MPa, poisson: 0.3" : law) +
         "}\n"
         "bodies:\n"
         "  - {name: plate, material: sheet, shape: {box: {min: [0.5, 0.2], max: [1.5, 0.6]}}" +
         body + "}\n" + rest;
}

std::string refusal(const std::string& text) {
  try {
    build(parse_scene(text, "bad.yaml"));
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_refused(const std::string& text, const std::string& where, const std::string& what) {
  const std::string found = refusal(text), expected = "bad.yaml:" + where + ": " + what;
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
}

TEST(SceneGeometry, NamesAreInTheOrderOfTheKinds) {
  EXPECT_STREQ(geometry_name(GeometryKind::line), "line");
  EXPECT_STREQ(geometry_name(GeometryKind::plane_strain), "plane_strain");
  EXPECT_STREQ(geometry_name(GeometryKind::plane_stress), "plane_stress");
  EXPECT_STREQ(geometry_name(GeometryKind::solid), "solid");
  EXPECT_EQ(spoken_name(GeometryKind::plane_stress), "plane stress");
  EXPECT_EQ(axes_of(GeometryKind::line), (std::vector<int>{0}));
  EXPECT_EQ(axes_beside(GeometryKind::line), (std::vector<int>{1, 2}));
  EXPECT_EQ(axes_of(GeometryKind::plane_stress), (std::vector<int>{0, 2}));
}

TEST(SceneGeometry, ALineHasOneComponent) {
  const Scene scene = parse_scene(
      line_scene("area: 4 cm^2\n"
                 "gravity: -9.81\n"
                 "method: {particles_per_cell: 5}\n"
                 "boundaries: {x_min: fixed}\n"
                 "loads: [{body_force: {acceleration: [\"2*X\"]}}]\n"
                 "rigid_bodies:\n"
                 "  - {name: stop, shape: {box: {size: 0.2}}, pose: {position: 1.8}, motion: {velocity: \"-t\"}}\n"
                 "  - {name: end, shape: {sphere: {radius: 0.1}}, pose: {position: [0.2]}}\n",
                 ", initial: {velocity: \"3*x\", stress: {xx: -1 kPa}}"),
      "line.yaml");
  const SimulationDefinition& d = scene.definition;
  EXPECT_EQ(d.geometry, GeometryKind::line);
  EXPECT_DOUBLE_EQ(d.area, 4e-4);
  EXPECT_EQ(d.gravity, Vec3(-9.81, 0, 0));
  EXPECT_EQ(d.method.particles_per_direction, 5);
  EXPECT_TRUE(d.grid.max.isApprox(Vec3(2, 0.01, 0.01), 1e-14));  // a square of 2 cm about the axis
  EXPECT_EQ(d.walls[0].kind, WallKind::fixed);
  EXPECT_EQ(d.body_forces[0].acceleration[0](0.0, Vec3::Zero(), Vec3(0.5, 0, 0)), 1.0);
  EXPECT_EQ(d.body_forces[0].acceleration[2](0.0), 0.0);
  EXPECT_EQ(scene.output.particle_fields, (std::vector<std::string>{"vx", "p", "j"}));
  // Tools are intervals: nothing depends on y and z.
  EXPECT_NEAR(d.rigid_bodies[0].surface->at(Vec3(0.3, 50, -70)).distance, 0.2, 1e-12);
  EXPECT_NEAR(d.rigid_bodies[1].surface->at(Vec3(0.3, 50, -70)).distance, 0.2, 1e-12);
  EXPECT_EQ(d.rigid_bodies[0].velocity[0](2.0), -2.0);

  const SimulationDefinition built = build(scene);
  const DeformableBody& rod = built.bodies[0];
  ASSERT_EQ(rod.positions.size(), 50U);
  EXPECT_TRUE(rod.positions[0].isApprox(Vec3(0.51, 0, 0), 1e-12));
  EXPECT_TRUE(rod.velocities[0].isApprox(Vec3(1.53, 0, 0), 1e-12));
  EXPECT_EQ(rod.stresses[0].xx, -1000.0);
  EXPECT_NEAR(rod.particle_volume, 0.02 * 4e-4, 1e-18);
  const std::string text = explain(scene, built);
  EXPECT_NE(text.find("method: line, 0.0004 m^2 across"), std::string::npos) << text;
  EXPECT_NE(text.find("grid: x 0 to 2 m by 0.1 m\n"), std::string::npos) << text;
}

TEST(SceneGeometry, ALinesDefaults) {
  const Scene scene =
      parse_scene("units: mm-g-s\n" + line_scene("", "", "law: linear_elastic, young: 1, poisson: 0"), "line.yaml");
  EXPECT_EQ(scene.definition.area, 1e-6);  // a square of the scene's unit of length
  EXPECT_EQ(scene.definition.method.particles_per_direction, 2);
  EXPECT_EQ(build(scene).bodies[0].positions.size(), 20U);
}

TEST(SceneGeometry, ASphereInALineIsAnInterval) {
  const std::string text = line_scene();
  const std::string box = "box: {min: 0.5, max: 1.5}";
  std::string sphere = text;
  sphere.replace(sphere.find(box), box.size(), "sphere: {center: 1, radius: 0.3}");
  EXPECT_EQ(build(parse_scene(sphere, "line.yaml")).bodies[0].positions.size(), 12U);  // 0.6 m at 0.05 m each
}

TEST(SceneGeometry, ALineRefusesWhatItDoesNotHave) {
  EXPECT_EQ(refusal(line_scene()), "no error");
  expect_refused(line_scene("gravity: [0, 0, -9.81]\n"), "7",
                 "gravity: found 3 components; write one component, x, for the scene is a line");
  expect_refused(line_scene("thickness: 1\n"), "7", "thickness: only a planar scene has a thickness");
  expect_refused(line_scene("boundaries: {z_min: slip}\n"), "7", "boundaries.z_min: a line has no face along z");
  expect_refused(line_scene("method: {particles_per_cell: 9}\n"), "7",
                 "method.particles_per_cell: 9 is not possible; a line has 1, 2, 3, 4 or 5 particles a cell");
  expect_refused(line_scene("gravity: -1\n", ", initial: geostatic"), "6",
                 "bodies.rod.initial: a line has no ground to both sides");
  expect_refused(line_scene("", ", initial: {stress: {xx: 1, zz: 1}}"), "6",
                 "bodies.rod.initial.stress.zz: unknown key");
  const std::string tool = "rigid_bodies: [{name: t, shape: ", box = "{box: {size: 0.1}}";
  EXPECT_EQ(refusal(line_scene(tool + box + "}]\n")), "no error");
  expect_refused(line_scene(tool + "{mesh: {file: a.stl}}}]\n"), "7", "rigid_bodies.t.shape.mesh: a line has no mesh");
  expect_refused(line_scene(tool + "{cylinder: {radius: 1}}}]\n"), "7",
                 "rigid_bodies.t.shape.cylinder: a line has no cylinder");
  expect_refused(line_scene(tool + box + ", pose: {rpy: [0, 0, 0]}}]\n"), "7",
                 "rigid_bodies.t.pose.rpy: nothing turns in a line");
  expect_refused(line_scene(tool + box + ", motion: {rotation_rate: 1}}]\n"), "7",
                 "rigid_bodies.t.motion.rotation_rate: nothing turns in a line");
}

TEST(SceneGeometry, PlaneStressIsReadAsAPlane) {
  const Scene scene = parse_scene(
      plane_scene("thickness: 2 mm\nmethod: {particles_per_cell: 25}\n", ", initial: {stress: {xx: 1 kPa, xz: 2}}"),
      "plate.yaml");
  EXPECT_EQ(scene.definition.geometry, GeometryKind::plane_stress);
  EXPECT_EQ(scene.definition.thickness, 0.002);
  const SimulationDefinition built = build(scene);
  EXPECT_EQ(built.bodies[0].positions.size(), 40U * 25U);
  EXPECT_NEAR(built.bodies[0].particle_volume, 0.02 * 0.02 * 0.002, 1e-18);
  EXPECT_FALSE(built.bodies[0].yy_follows);
  EXPECT_EQ(built.bodies[0].stresses[0].yy, 0.0);
  EXPECT_NE(explain(scene, built).find("method: plane stress, 0.002 m thick"), std::string::npos);
}

TEST(SceneGeometry, PlaneStressRefusesWhatItDoesNotHave) {
  EXPECT_EQ(refusal(plane_scene()), "no error");
  expect_refused(plane_scene("area: 1\n"), "7", "area: only a line has an area across it");
  expect_refused(plane_scene("gravity: [0, -1]\n", ", initial: geostatic"), "6",
                 "bodies.plate.initial: a plate with free faces cannot hold soil at rest; use plane_strain or solid");
  expect_refused(plane_scene("", ", initial: {stress: {yy: 1}}"), "6", "bodies.plate.initial.stress.yy: unknown key");
  const std::string reason =
      " in plane stress: a sheet of fluid with free faces carries no pressure; use plane_strain or solid";
  expect_refused(plane_scene("", "", "law: newtonian_fluid, bulk_modulus: 1 MPa"), "6",
                 "bodies.plate.material: material 'sheet' (newtonian_fluid)" + reason);
  expect_refused(plane_scene("", "", "law: ideal_gas, pressure: 1 bar, temperature: 300"), "6",
                 "bodies.plate.material: material 'sheet' (ideal_gas)" + reason);
}

TEST(SceneGeometry, ParticlesACell) {
  const auto scene = [](const std::string& geometry, int particles) {
    const bool solid = geometry == "solid";
    const std::string low = solid ? "[0, 0, 0]" : "[0, 0]", high = solid ? "[1, 1, 1]" : "[1, 1]";
    return "geometry: " + geometry + "\ngrid: {cell: 0.5, min: " + low + ", max: " + high +
           "}\nmethod: {particles_per_cell: " + std::to_string(particles) +
           "}\nmaterials: [{name: m, density: 1, law: neo_hookean, young: 1, poisson: 0}]\n" +
           "bodies: [{name: b, material: m, shape: {box: {min: " + low + ", max: " + high + "}}}]\n";
  };
  for (const int particles : {1, 4, 9, 16, 25}) {
    EXPECT_EQ(build(parse_scene(scene("plane_stress", particles), "")).bodies[0].positions.size(), 4U * particles);
  }
  for (const int particles : {1, 8, 27}) {
    EXPECT_EQ(build(parse_scene(scene("solid", particles), "")).bodies[0].positions.size(), 8U * particles);
  }
  expect_refused(scene("solid", 9), "3",
                 "method.particles_per_cell: 9 is not possible; a solid scene has 1, 8 or 27 particles a cell");
  expect_refused(scene("plane_stress", 8), "3",
                 "method.particles_per_cell: 8 is not possible; a planar scene has 1, 4, 9, 16 or 25 particles a cell");
}

// Definitions made in code are refused for the same reasons.
TEST(SceneGeometry, TheSimulationRefusesTheSame) {
  const auto refused = [](SimulationDefinition definition) -> std::string {
    try {
      Simulation simulation(std::move(definition), {1});
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  SimulationDefinition plate = build(parse_scene(plane_scene(), "plate.yaml"));
  plate.materials[0].law = NewtonianFluidDefinition{1e6, 7.0, 0.0, true};
  EXPECT_NE(refused(plate).find("body 'plate': material 'sheet' (newtonian_fluid) in plane stress"), std::string::npos)
      << refused(plate);
  plate = build(parse_scene(plane_scene(), "plate.yaml"));
  plate.bodies[0].stresses.assign(plate.bodies[0].positions.size(), {0.0, 5.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_NE(refused(plate).find("cannot have yy = 5 Pa in plane stress"), std::string::npos) << refused(plate);
  plate = build(parse_scene(plane_scene("gravity: [0, -1]\n"), "plate.yaml"));
  plate.bodies[0].geostatic = GeostaticDefinition{};
  EXPECT_NE(refused(plate).find("a plate with free faces cannot hold soil at rest"), std::string::npos)
      << refused(plate);
  SimulationDefinition line = build(parse_scene(line_scene(), "line.yaml"));
  line.area = 0.0;
  EXPECT_EQ(refused(line), "area must be positive");
}

}  // namespace scene_geometry_test
}  // namespace mpm
