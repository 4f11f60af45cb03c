// A scene with one tool, for tests of tools.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// A scene with the tool on line 2; `rest` are more keys of the tool.
inline std::string scene(const std::string& geometry, const std::string& shape, const std::string& rest = "") {
  const std::string low = geometry == "solid" ? "[0, 0, 0]" : geometry == "line" ? "0" : "[0, 0]";
  const std::string high = geometry == "solid" ? "[1, 1, 1]" : geometry == "line" ? "1" : "[1, 1]";
  return "geometry: " + geometry + "\nrigid_bodies: [{name: tool, shape: {" + shape + "}" +
         (rest.empty() ? "" : ", " + rest) + "}]\ngrid: {cell: 0.1, min: " + low + ", max: " + high +
         "}\nmaterials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n" +
         "bodies: [{name: block, material: soft, shape: {box: {min: " + low + ", max: " + high + "}}}]\n";
}

inline RigidBodyDefinition tool(const std::string& geometry, const std::string& shape, const std::string& rest = "") {
  return parse_scene(scene(geometry, shape, rest), "good.yaml").definition.rigid_bodies.at(0);
}

inline void expect_refused(const std::string& text, const std::string& where, const std::string& what) {
  const std::string start = "bad.yaml:2: rigid_bodies.tool." + where + ": ";
  try {
    parse_scene(text, "bad.yaml");
    FAIL() << "taken: " << text;
  } catch (const SceneError& error) {
    const std::string found = error.what();
    EXPECT_EQ(found.substr(0, start.size()), start) << found;
    EXPECT_NE(found.find(what), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

}  // namespace mpm
