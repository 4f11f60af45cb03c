#include "mpm/rigid/urdf.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "mpm/math/nearest.hpp"
#include "mpm/rigid/compound.hpp"
#include "urdf_text.hpp"

namespace mpm {

namespace {

std::unique_ptr<Surface> surface_of(const urdf::Geometry& geometry, const std::filesystem::path& folder,
                                    double thinnest) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return make_sphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::BOX:
      return make_box(urdf_vector(static_cast<const urdf::Box&>(geometry).dim));
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return make_cylinder(cylinder.radius, cylinder.length);
    }
    default: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      TriangleMesh loaded = load_mesh(urdf_path(mesh.filename, folder));
      const Vec3 scale = urdf_vector(mesh.scale);
      if (!scale.allFinite() || (scale.array() == 0.0).any())
        throw RigidError(fmt::format("{}: its scale has a zero, or is not finite", mesh.filename));
      for (Vec3& vertex : loaded.vertices) vertex = vertex.cwiseProduct(scale);
      return make_mesh(loaded, thinnest);
    }
  }
}

/// Links that can be a body.
std::vector<std::string> links_with_collision(const urdf::ModelInterface& model) {
  std::vector<std::string> names;
  for (const auto& [name, link] : model.links_) {
    if (!link->collision_array.empty()) names.push_back(name);
  }
  return names;
}

[[noreturn]] void refuse_link(const UrdfText& urdf, const std::string& what) {
  throw RigidError(what + (urdf.has_xacro() ? fmt::format("; the file holds elements of xacro: {}", kExpand) : ""));
}

}  // namespace

std::unique_ptr<Surface> load_urdf_link(const std::string& path, const std::string& link, double thinnest) try {
  const std::string file = urdf_path(path, {});
  const UrdfText urdf(file, {"visual", "inertial"});
  const Complaints complaints;
  const urdf::ModelInterfaceSharedPtr model = urdf.parse(complaints);
  const urdf::LinkConstSharedPtr found = model->getLink(link);
  const std::vector<std::string> others = links_with_collision(*model);
  if (!found) {
    refuse_link(urdf, fmt::format("it has no link '{}'; {}", link,
                                  others.empty() ? "none has collision geometry" : suggest(link, others)));
  }
  const std::vector<int> written = urdf.collisions_of(link);
  const auto start = [&](std::size_t i) {
    const std::string name = i < written.size() ? attribute_of(urdf.element(written[i]), "name") : "";
    const std::string line = i < written.size() ? fmt::format("line {}: ", urdf.element(written[i]).line) : "";
    return fmt::format("{}link '{}': collision {}{}: ", line, link, i + 1, name.empty() ? "" : " '" + name + "'");
  };
  const std::size_t read = found->collision_array.size();
  if (read != written.size()) {
    const std::string reason = complaints.about(link);
    if (reason.find("${") != std::string::npos)
      throw RigidError(fmt::format("{}{}; this is left of xacro: {}", start(read), reason, kExpand));
    refuse_link(urdf, start(read) + reason + "; write a box, sphere, cylinder or mesh");
  }
  if (read == 0) {
    refuse_link(urdf,
                fmt::format("link '{}' has no collision geometry; {}", link,
                            others.empty() ? "none has" : fmt::format("links that have: {}", fmt::join(others, ", "))));
  }
  std::vector<PlacedSurface> parts;
  for (std::size_t i = 0; i < read; ++i) {
    const urdf::Collision& collision = *found->collision_array[i];
    try {
      if (!collision.geometry) throw RigidError("it has no geometry");
      if (const std::string surplus = urdf.surplus_of(written[i]); !surplus.empty()) throw RigidError(surplus);
      parts.push_back({surface_of(*collision.geometry, std::filesystem::path(file).parent_path(), thinnest),
                       urdf_pose(collision.origin)});
    } catch (const RigidError& error) {
      throw RigidError(start(i) + error.what());
    }
  }
  return make_compound(std::move(parts));
} catch (const RigidError& error) {
  throw RigidError(fmt::format("{}: {}", path, error.what()));
}

}  // namespace mpm
