#include "mpm/rigid/urdf.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "mpm/math/input_file.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/rigid/compound.hpp"
#include "xml_outline.hpp"

namespace mpm {

namespace {

constexpr int kDeepestElement = 100;              ///< elements in each other; a robot has some ten
constexpr std::size_t kMostUrdfBytes = 16 << 20;  ///< bytes of a file
const char* const kExpand = "expand it first: xacro robot.xacro > robot.urdf";

/// Hears what urdfdom has to say while it lives, in place of the terminal.
class Complaints final : public console_bridge::OutputHandler {
 public:
  Complaints() { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    texts_.push_back(text);
    std::replace(texts_.back().begin(), texts_.back().end(), '\n', ' ');
  }
  std::string first() const { return texts_.empty() ? "it is not a URDF" : texts_.front(); }
  /// The first one about a link at which reading it stopped: urdfdom ends with one that names the link.
  std::string about(const std::string& link) const {
    std::string reason;
    for (const std::string& text : texts_) {
      const bool ends = text.find(" element for Link [") != std::string::npos;
      if (reason.empty()) reason = text;
      if (ends && text.find("[" + link + "]") != std::string::npos) return reason;
      if (ends) reason.clear();
    }
    return "urdfdom cannot read it";
  }

 private:
  std::vector<std::string> texts_;
};

/// A path without its scheme; a relative one starts at `folder`.
std::string file_of(const std::string& uri, const std::filesystem::path& folder) {
  const std::string scheme = "file://";
  if (uri.compare(0, scheme.size(), scheme) == 0) return uri.substr(scheme.size());
  if (uri.find("://") != std::string::npos) return resolve_resource(uri);
  return std::filesystem::path(uri).is_relative() ? (folder / uri).string() : uri;
}

bool of_xacro(const XmlElement& element) { return element.name.compare(0, 6, "xacro:") == 0; }

/// The text of a URDF, and what urdfdom does not tell of it: urdfdom stops reading a link at an element that it cannot
/// read, and gives the link without those that follow.
class UrdfText {
 public:
  explicit UrdfText(const std::string& path) {
    if (const std::string refused = read_input(path, text_); !refused.empty()) throw RigidError(refused);
    if (text_.size() > kMostUrdfBytes) {
      throw RigidError(fmt::format("it has {} MB, and a URDF {} MB at most; write meshes to files of their own",
                                   text_.size() >> 20, kMostUrdfBytes >> 20));
    }
    elements_ = outline_of_xml(text_, kDeepestElement);
    // Visuals and inertias are of no use here. One that cannot be read would hide the collisions behind it.
    for (const XmlElement& element : elements_) {
      if (element.name == "visual" || element.name == "inertial") blank_out(element);
    }
  }

  const std::string& text() const { return text_; }

  /// The elements directly in another one; in none, for -1.
  std::vector<int> children_of(int parent) const {
    std::vector<int> children;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      if (elements_[i].parent == parent) children.push_back(static_cast<int>(i));
    }
    return children;
  }
  const XmlElement& element(int place) const { return elements_[static_cast<std::size_t>(place)]; }

  /// The collision elements of a link. @throws RigidError for what xacro would have to expand
  std::vector<int> collisions_of(const std::string& link) const {
    std::vector<int> collisions;
    for (const int child : children_of(find_link(link))) {
      if (of_xacro(element(child))) {
        throw RigidError(fmt::format("link '{}': line {}: {} is of xacro; {}", link, element(child).line,
                                     element(child).name, kExpand));
      }
      if (element(child).name == "collision") collisions.push_back(child);
    }
    return collisions;
  }
  bool has_xacro() const { return std::any_of(elements_.begin(), elements_.end(), of_xacro); }

  /// Two shapes in one element, of which urdfdom reads the first.
  std::string surplus_of(int collision) const {
    for (const int geometry : children_of(collision)) {
      if (element(geometry).name != "geometry") continue;
      const std::vector<int> shapes = children_of(geometry);
      if (shapes.size() > 1) {
        return fmt::format("its geometry holds {} and {}; write a collision element for each", element(shapes[0]).name,
                           element(shapes[1]).name);
      }
    }
    return {};
  }

 private:
  int find_link(const std::string& name) const {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const XmlElement& link = elements_[i];
      if (link.name == "link" && link.parent >= 0 && element(link.parent).parent < 0 &&
          attribute_of(link, "name") == name)
        return static_cast<int>(i);
    }
    return -2;  // no element has it for its parent
  }

  void blank_out(const XmlElement& element) {
    for (std::size_t i = element.begin; i < element.end; ++i) {
      if (text_[i] != '\n') text_[i] = ' ';
    }
  }

  std::string text_;
  std::vector<XmlElement> elements_;
};

urdf::ModelInterfaceSharedPtr parse(const UrdfText& urdf, const Complaints& complaints) {
  urdf::ModelInterfaceSharedPtr model;
  std::string reason;
  try {
    model = urdf::parseURDF(urdf.text());
    if (!model) reason = complaints.first();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (model) return model;
  if (urdf.has_xacro()) reason += fmt::format("; it holds elements of xacro: {}", kExpand);
  throw RigidError(fmt::format("cannot be read as a URDF: {}", reason));
}

Vec3 to_vec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  const Pose result{to_vec3(pose.position), Quat(r.w, r.x, r.y, r.z).normalized()};
  if (!result.position.allFinite() || !result.orientation.coeffs().allFinite())
    throw RigidError("its origin is not finite");
  return result;
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

[[noreturn]] void refuse_link(const UrdfText& urdf, const std::string& what) {
  throw RigidError(what + (urdf.has_xacro() ? fmt::format("; the file holds elements of xacro: {}", kExpand) : ""));
}

}  // namespace

std::unique_ptr<Surface> load_urdf_link(const std::string& path, const std::string& link, double thinnest) try {
  const std::string file = file_of(path, {});
  const UrdfText urdf(file);
  const Complaints complaints;
  const urdf::ModelInterfaceSharedPtr model = parse(urdf, complaints);
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
                       to_pose(collision.origin)});
    } catch (const RigidError& error) {
      throw RigidError(start(i) + error.what());
    }
  }
  return make_compound(std::move(parts));
} catch (const RigidError& error) {
  throw RigidError(fmt::format("{}: {}", path, error.what()));
}

}  // namespace mpm
