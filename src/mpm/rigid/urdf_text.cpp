#include "urdf_text.hpp"

#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "mpm/math/input_file.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace {

constexpr int kDeepestElement = 100;              ///< elements in each other; a robot has some ten
constexpr std::size_t kMostUrdfBytes = 16 << 20;  ///< bytes of a file

bool of_xacro(const XmlElement& element) { return element.name.compare(0, 6, "xacro:") == 0; }

}  // namespace

void Complaints::log(const std::string& text, console_bridge::LogLevel level, const char*, int) {
  if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
  texts_.push_back(text);
  std::replace(texts_.back().begin(), texts_.back().end(), '\n', ' ');
}

std::string Complaints::about(const std::string& link) const {
  std::string reason;
  for (const std::string& text : texts_) {
    const bool ends = text.find(" element for Link [") != std::string::npos;
    if (reason.empty()) reason = text;
    if (ends && text.find("[" + link + "]") != std::string::npos) return reason;
    if (ends) reason.clear();
  }
  return "urdfdom cannot read it";
}

std::string urdf_path(const std::string& uri, const std::filesystem::path& folder) {
  const std::string scheme = "file://";
  if (uri.compare(0, scheme.size(), scheme) == 0) return uri.substr(scheme.size());
  if (uri.find("://") != std::string::npos) return resolve_resource(uri);
  return std::filesystem::path(uri).is_relative() ? (folder / uri).string() : uri;
}

Vec3 urdf_vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose urdf_pose(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  const Pose result{urdf_vector(pose.position), Quat(r.w, r.x, r.y, r.z).normalized()};
  if (!result.position.allFinite() || !result.orientation.coeffs().allFinite())
    throw RigidError("its origin is not finite");
  return result;
}

UrdfText::UrdfText(const std::string& path, const std::vector<std::string>& unread) {
  if (const std::string refused = read_input(path, text_); !refused.empty()) throw RigidError(refused);
  if (text_.size() > kMostUrdfBytes) {
    throw RigidError(fmt::format("it has {} MB, and a URDF {} MB at most; write meshes to files of their own",
                                 text_.size() >> 20, kMostUrdfBytes >> 20));
  }
  elements_ = outline_of_xml(text_, kDeepestElement);
  for (const XmlElement& element : elements_) {
    if (std::find(unread.begin(), unread.end(), element.name) != unread.end()) blank_out(element);
  }
}

std::vector<int> UrdfText::children_of(int parent) const {
  std::vector<int> children;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (elements_[i].parent == parent) children.push_back(static_cast<int>(i));
  }
  return children;
}

std::vector<int> UrdfText::collisions_of(const std::string& link) const {
  std::vector<int> collisions;
  for (const int child : children_of(find("link", link))) {
    if (of_xacro(element(child))) {
      throw RigidError(fmt::format("link '{}': line {}: {} is of xacro; {}", link, element(child).line,
                                   element(child).name, kExpand));
    }
    if (element(child).name == "collision") collisions.push_back(child);
  }
  return collisions;
}

bool UrdfText::has_xacro() const { return std::any_of(elements_.begin(), elements_.end(), of_xacro); }

std::string UrdfText::line_of(const std::string& kind, const std::string& name) const {
  const int found = find(kind, name);
  return found < 0 ? "" : fmt::format("line {}: ", element(found).line);
}

std::string UrdfText::surplus_of(int collision) const {
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

urdf::ModelInterfaceSharedPtr UrdfText::parse(const Complaints& complaints) const {
  urdf::ModelInterfaceSharedPtr model;
  std::string reason;
  try {
    model = urdf::parseURDF(text_);
    if (!model) reason = complaints.first();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (model) return model;
  if (has_xacro()) reason += fmt::format("; it holds elements of xacro: {}", kExpand);
  throw RigidError(fmt::format("cannot be read as a URDF: {}", reason));
}

int UrdfText::find(const std::string& kind, const std::string& name) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const XmlElement& one = elements_[i];
    if (one.name == kind && one.parent >= 0 && element(one.parent).parent < 0 && attribute_of(one, "name") == name)
      return static_cast<int>(i);
  }
  return -2;
}

void UrdfText::blank_out(const XmlElement& element) {
  for (std::size_t i = element.begin; i < element.end; ++i) {
    if (text_[i] != '\n') text_[i] = ' ';
  }
}

}  // namespace mpm
