// Mesh files of all formats, and package:// paths.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "mesh_shapes.hpp"
#include "mpm/rigid/mesh_topology.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace mesh_file_test {

namespace fs = std::filesystem;

class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mpm_mesh_test_" + std::to_string(std::random_device{}()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("CMAKE_PREFIX_PATH");
    fs::remove_all(folder_);
  }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  /// Expects the box 2 x 3 x 4 about the origin, which every format must give.
  static void expect_box(const TriangleMesh& mesh, double scale = 1.0) {
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 24.0 * scale * scale * scale);
    EXPECT_EQ(make_mesh(mesh)->bounds().max, scale * Vec3(1.0, 1.5, 2.0));
  }
  static std::string message(const std::string& path) {
    try {
      load_mesh(path);
    } catch (const RigidError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }
  const TriangleMesh box_ = box_mesh({-1.0, -1.5, -2.0}, {1.0, 1.5, 2.0});
  fs::path folder_;
};

std::string ascii_stl(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& triangle : mesh.triangles) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const int v : triangle) text << "  vertex " << mesh.vertices[v].transpose() << "\n";
    text << " endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  return text.str();
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string text(80, ' ');
  const auto put = [&](const auto& value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0F);  // normal: the reader computes it
    for (const int v : triangle) {
      for (int i = 0; i < 3; ++i) put(static_cast<float>(mesh.vertices[v][i]));
    }
    put(static_cast<std::uint16_t>(0));
  }
  return text;
}

/// COLLADA text with the given unit [m] and up axis; the box belongs to a node that is moved by (10, 20, 30) units.
std::string collada(const TriangleMesh& mesh, const std::string& unit, const std::string& up) {
  std::ostringstream positions, indices;
  for (const Vec3& vertex : mesh.vertices) positions << vertex.transpose() << " ";
  for (const auto& [i, j, k] : mesh.triangles) indices << i << " " << j << " " << k << " ";
  std::ostringstream text;
  text
      << R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter=")"
      << unit << R"("/><up_axis>)" << up << R"(</up_axis></asset><library_geometries><geometry id="g"><mesh>)"
      << R"(<source id="p"><float_array id="a" count=")" << 3 * mesh.vertices.size() << R"(">)" << positions.str()
      << R"(</float_array><technique_common><accessor source="#a" count=")" << mesh.vertices.size()
      << R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>)"
      << R"(</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
      << R"(<triangles count=")" << mesh.triangles.size() << R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)"
      << indices.str()
      << R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">)"
      << R"(<node id="n"><translate>10 20 30</translate><instance_geometry url="#g"/></node></visual_scene>)"
      << R"(</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  return text.str();
}

TEST_F(MeshFile, Stl) {
  expect_box(load_mesh(write("ascii.stl", ascii_stl(box_))));
  expect_box(load_mesh(write("binary.stl", binary_stl(box_))));
  expect_box(load_mesh(write("scaled.stl", binary_stl(box_)), 0.5), 0.5);
}

TEST_F(MeshFile, ObjWithSquares) {
  std::ostringstream text;
  for (const Vec3& vertex : box_.vertices) text << "v " << vertex.transpose() << "\n";
  text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  expect_box(load_mesh(write("box.obj", text.str())));
}

TEST_F(MeshFile, ColladaKeepsItsAxesAndAppliesItsUnitAndNodes) {
  for (const char* up : {"Z_UP", "Y_UP"}) {
    const TriangleMesh mesh = load_mesh(write("box.dae", collada(box_, "0.5", up)));
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_NEAR(signed_volume(mesh), 3.0, 1e-5) << up;  // (1/2)^3 of 24, in single precision about (5, 10, 15)
    const Box bounds = make_mesh(mesh)->bounds();
    EXPECT_LT((bounds.center() - Vec3(5.0, 10.0, 15.0)).norm(), 1e-5) << up;
    EXPECT_LT((bounds.size() - Vec3(1.0, 1.5, 2.0)).norm(), 1e-5) << up;
  }
}

TEST_F(MeshFile, Unreadable) {
  const std::string missing = (folder_ / "none.stl").string();
  EXPECT_EQ(message(missing), missing + ": no such file; check the path");
  const std::string strange = write("notes.txt", "not a mesh");
  EXPECT_TRUE(starts_with(message(strange), strange + ": cannot be read as a mesh")) << message(strange);
  EXPECT_NE(message(write("broken.stl", "solid broken\nfacet")), "");
  EXPECT_NE(message(write("empty.obj", "# nothing\n")), "");
  EXPECT_THROW(load_mesh(write("box.stl", binary_stl(box_)), 0.0), RigidError);
}

// A pipe keeps its reader waiting, a device has no end, and a parser that calls itself has a stack.
TEST_F(MeshFile, WhatIsNoFileOrTooDeepIsRefused) {
  const std::string pipe = (folder_ / "pipe.stl").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message(pipe), pipe + ": it is a device, a pipe or a socket; name a regular file");
  EXPECT_NE(message(folder_.string()).find("it is a folder"), std::string::npos);
  // Also where a mesh names it: the materials of an OBJ.
  ASSERT_EQ(mkfifo((folder_ / "pipe.mtl").c_str(), 0600), 0);
  std::ostringstream text;
  text << "mtllib pipe.mtl\n";
  for (const Vec3& vertex : box_.vertices) text << "v " << vertex.transpose() << "\n";
  text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  expect_box(load_mesh(write("named.obj", text.str())));
  std::string nodes = collada(box_, "1", "Z_UP"), open, close;
  for (int i = 0; i < 50000; ++i) open += "<node>", close += "</node>";
  nodes.insert(nodes.find("<node id"), open);
  nodes.insert(nodes.find("</visual_scene>"), close);
  EXPECT_NE(message(write("deep.dae", nodes)).find("more than 200 deep"), std::string::npos);
  EXPECT_NE(message(write("deep.gltf", "{\"nodes\": " + std::string(50000, '['))).find("more than 200 deep"),
            std::string::npos);
}

// A sphere of 32,768 triangles; STL repeats every vertex six times. Half a second at most.
TEST_F(MeshFile, ManyTrianglesAreReadInTimeOfTheirNumber) {
  const TriangleMesh sphere = sphere_mesh(0.5, 6);
  const TriangleMesh read = load_mesh(write("sphere.stl", binary_stl(sphere)));
  EXPECT_EQ(read.vertices.size(), 16386U);  // Euler: 2 more than half of the triangles
  EXPECT_EQ(read.triangles.size(), 32768U);
  const auto surface = make_mesh(read);
  EXPECT_NEAR(surface->at({0.0, 0.0, 0.7}).distance, 0.2, 1e-6);
  EXPECT_NEAR(surface->thickness(), 1.0, 1e-2);
  TriangleMesh huge;
  huge.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  huge.triangles.assign(2000001, {0, 1, 2});
  EXPECT_THROW(join_equal_vertices(huge), RigidError);
}

TEST_F(MeshFile, Packages) {
  const auto manifest = [](const std::string& name) { return "<package><name> " + name + " </name></package>"; };
  // A package that is itself an entry of the path, one among others, one in a folder with another name, one nested.
  write("ws/alone/package.xml", manifest("tools"));
  write("ws/src/more_tools/package.xml", manifest("more_tools"));
  write("ws/src/folder/package.xml", manifest("renamed"));
  write("ws/src/stack/deep_tools/package.xml", manifest("deep_tools"));
  write("install/share/installed/package.xml", manifest("installed"));
  const std::string box = binary_stl(box_);
  for (const char* package :
       {"ws/alone", "ws/src/more_tools", "ws/src/folder", "ws/src/stack/deep_tools", "install/share/installed"}) {
    write(std::string(package) + "/meshes/box.stl", box);
  }
  setenv("ROS_PACKAGE_PATH", ((folder_ / "ws/alone").string() + ":/nowhere:" + (folder_ / "ws/src").string()).c_str(),
         1);
  setenv("CMAKE_PREFIX_PATH", (folder_ / "install").c_str(), 1);
  const auto expected = [&](const std::string& package) { return (folder_ / package / "meshes/box.stl").string(); };
  EXPECT_EQ(resolve_resource("package://tools/meshes/box.stl"), expected("ws/alone"));
  EXPECT_EQ(resolve_resource("package://more_tools/meshes/box.stl"), expected("ws/src/more_tools"));
  EXPECT_EQ(resolve_resource("package://renamed/meshes/box.stl"), expected("ws/src/folder"));
  EXPECT_EQ(resolve_resource("package://deep_tools/meshes/box.stl"), expected("ws/src/stack/deep_tools"));
  EXPECT_EQ(resolve_resource("package://installed/meshes/box.stl"), expected("install/share/installed"));
  EXPECT_EQ(resolve_resource("meshes/box.stl"), "meshes/box.stl");
  expect_box(load_mesh("package://tools/meshes/box.stl"));
  EXPECT_TRUE(starts_with(message("package://nobody/box.stl"), "package://nobody/box.stl: no package 'nobody' on "));
  EXPECT_NE(message("package://tools/box.stl").find("has no file box.stl"), std::string::npos);
  EXPECT_NE(message("package://tools").find("write package://NAME/"), std::string::npos);
}

}  // namespace mesh_file_test
}  // namespace mpm
