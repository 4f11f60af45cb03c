// The text of a URDF file on its way through urdfdom, and what urdfdom has to say. Private to this folder.
#pragma once

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mpm/rigid/motion.hpp"
#include "xml_outline.hpp"

namespace mpm {

inline constexpr const char* kExpand = "expand it first: xacro robot.xacro > robot.urdf";

/// Hears what urdfdom has to say while it lives, in place of the terminal.
class Complaints final : public console_bridge::OutputHandler {
 public:
  Complaints() { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override;
  std::string first() const { return texts_.empty() ? "it is not a URDF" : texts_.front(); }
  /// The first one about a link at which reading it stopped: urdfdom ends with one that names the link.
  std::string about(const std::string& link) const;
  bool any() const { return !texts_.empty(); }

 private:
  std::vector<std::string> texts_;
};

/// A path without its scheme; a relative one starts at `folder`.
std::string urdf_path(const std::string& uri, const std::filesystem::path& folder);

Vec3 urdf_vector(const urdf::Vector3& v);
/// @throws RigidError when it is not finite
Pose urdf_pose(const urdf::Pose& pose);

/// The text of a URDF, and what urdfdom does not tell of it: urdfdom stops reading a link at an element that it cannot
/// read, and gives the link without those that follow.
class UrdfText {
 public:
  /// Elements of the names in `unread` are blanked out: one that cannot be read would hide those behind it.
  /// @throws RigidError for a file that cannot be read
  UrdfText(const std::string& path, const std::vector<std::string>& unread);

  const std::string& text() const { return text_; }
  /// The elements directly in another one; in none, for -1.
  std::vector<int> children_of(int parent) const;
  const XmlElement& element(int place) const { return elements_[static_cast<std::size_t>(place)]; }
  /// The collision elements of a link. @throws RigidError for what xacro would have to expand
  std::vector<int> collisions_of(const std::string& link) const;
  bool has_xacro() const;
  /// Text "line N: " of the element `kind` of the robot with this name; empty without one.
  std::string line_of(const std::string& kind, const std::string& name) const;
  /// Two shapes in one element, of which urdfdom reads the first.
  std::string surplus_of(int collision) const;
  /// The model. @throws RigidError with the first of the complaints
  urdf::ModelInterfaceSharedPtr parse(const Complaints& complaints) const;

 private:
  /// The element `kind` of the robot with this name, or -2, which no element has for its parent.
  int find(const std::string& kind, const std::string& name) const;
  void blank_out(const XmlElement& element);

  std::string text_;
  std::vector<XmlElement> elements_;
};

}  // namespace mpm
