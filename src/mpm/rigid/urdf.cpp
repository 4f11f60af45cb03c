#include "mpm/rigid/urdf.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "mpm/math/nearest.hpp"
#include "mpm/rigid/compound.hpp"

namespace mpm {

namespace {

/// Hears what urdfdom has to say while it lives, in place of the terminal.
class Complaints final : public console_bridge::OutputHandler {
 public:
  Complaints() { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }
  /// The first one, in one line.
  std::string first() const {
    std::string line = first_.empty() ? "it is not a URDF" : first_;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
  }

 private:
  std::string first_;
};

/// A path without its scheme; a relative one starts at `folder`.
std::string file_of(const std::string& uri, const std::filesystem::path& folder) {
  const std::string scheme = "file://";
  if (uri.compare(0, scheme.size(), scheme) == 0) return uri.substr(scheme.size());
  if (uri.find("://") != std::string::npos) return resolve_resource(uri);
  return std::filesystem::path(uri).is_relative() ? (folder / uri).string() : uri;
}

urdf::ModelInterfaceSharedPtr read_model(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::error_code ignored;
  if (!stream || !std::filesystem::is_regular_file(path, ignored)) throw RigidError("no such file");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const Complaints complaints;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    throw RigidError(fmt::format("cannot be read as a URDF: {}", error.what()));
  }
  if (!model) throw RigidError(fmt::format("cannot be read as a URDF: {}", complaints.first()));
  return model;
}

Vec3 to_vec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {to_vec3(pose.position), Quat(r.w, r.x, r.y, r.z).normalized()};
}

std::unique_ptr<Surface> surface_of(const urdf::Geometry& geometry, const std::filesystem::path& folder,
                                    double thinnest) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return make_sphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::BOX:
      return make_box(to_vec3(static_cast<const urdf::Box&>(geometry).dim));
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return make_cylinder(cylinder.radius, cylinder.length);
    }
    default: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      TriangleMesh loaded = load_mesh(file_of(mesh.filename, folder));
      const Vec3 scale = to_vec3(mesh.scale);
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

}  // namespace

std::unique_ptr<Surface> load_urdf_link(const std::string& path, const std::string& link, double thinnest) try {
  const std::string file = file_of(path, {});
  const urdf::ModelInterfaceSharedPtr model = read_model(file);
  const urdf::LinkConstSharedPtr found = model->getLink(link);
  if (!found) {
    throw RigidError(fmt::format("it has no link '{}'; {}", link, suggest(link, links_with_collision(*model))));
  }
  if (found->collision_array.empty()) {
    throw RigidError(fmt::format("link '{}' has no collision geometry; links that have: {}", link,
                                 fmt::join(links_with_collision(*model), ", ")));
  }
  std::vector<PlacedSurface> parts;
  for (const urdf::CollisionSharedPtr& collision : found->collision_array) {
    const std::size_t number = parts.size() + 1;
    if (!collision->geometry) throw RigidError(fmt::format("link '{}': collision {} has no geometry", link, number));
    try {
      parts.push_back({surface_of(*collision->geometry, std::filesystem::path(file).parent_path(), thinnest),
                       to_pose(collision->origin)});
    } catch (const RigidError& error) {
      throw RigidError(fmt::format("link '{}': collision {}: {}", link, number, error.what()));
    }
  }
  return make_compound(std::move(parts));
} catch (const RigidError& error) {
  throw RigidError(fmt::format("{}: {}", path, error.what()));
}

}  // namespace mpm
