#include "mpm/sections/all_keys.hpp"

#include <fmt/format.h>

#include "mpm/bed/bed_keys.hpp"
#include "mpm/crack/crack_keys.hpp"
#include "mpm/material/law_keys.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/pace/target_keys.hpp"
#include "mpm/rigid/rigid_keys.hpp"
#include "mpm/robot/robot_keys.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sleep/sleep_keys.hpp"
#include "mpm/step/damping_keys.hpp"
#include "mpm/transport/transport_keys.hpp"
#include "mpm/volumes/volume_keys.hpp"

namespace mpm {
namespace {

template <class T>
KeySection section_of(const KeyTable<T>& table, const char* page) {
  return {table.section(), page, table.page()};
}

std::vector<KeySection> make_sections() {
  std::vector<KeySection> sections = {
      section_of(time_keys(), "scene/time.md"),         section_of(method_keys(), "method_keys.md"),
      section_of(auto_keys(), "method_keys.md"),        section_of(axis_keys(), "axisymmetric.md"),
      section_of(damping_keys(), "method_keys.md"),     section_of(feedback_keys(), "method_keys.md"),
      section_of(material_keys(), "scene/materials.md")};
  each_law([&](const auto& law) {
    sections.push_back(section_of(law_keys<std::decay_t<decltype(law)>>(), "scene/materials.md"));
  });
  const std::vector<KeySection> others = {section_of(body_keys(), "scene/bodies.md"),
                                          section_of(rigid_body_keys(), "rigid_bodies.md"),
                                          section_of(geostatic_keys(), "scene/bodies.md"),
                                          section_of(free_keys(), "free_bodies.md"),
                                          section_of(collide_keys(), "free_bodies.md"),
                                          section_of(limit_keys(), "rigid_bodies.md"),
                                          section_of(robot_keys(), "robots.md"),
                                          section_of(base_keys(), "robots.md"),
                                          section_of(joint_keys(), "robots.md"),
                                          section_of(sensor_keys(), "robots.md"),
                                          section_of(contact_law_keys(), "scene/contact.md"),
                                          section_of(contact_keys(), "scene/contact.md"),
                                          section_of(quantity_keys(), "transport.md"),
                                          section_of(heat_keys(), "transport.md"),
                                          section_of(tool_heat_keys(), "transport.md"),
                                          section_of(cracks_keys(), "scene/cracks.md"),
                                          section_of(crack_keys(), "scene/cracks.md"),
                                          section_of(face_keys(), "scene/cracks.md"),
                                          section_of(contour_keys(), "scene/cracks.md"),
                                          section_of(growth_keys(), "scene/cracks.md"),
                                          section_of(traction_law_keys(), "scene/cracks.md"),
                                          section_of(fracture_keys(), "scene/cracks.md"),
                                          section_of(sleep_keys(), "scene/sleep.md"),
                                          section_of(output_keys(), "scene/output.md"),
                                          section_of(pace::target_keys(), "scene/target.md")};
  sections.insert(sections.end(), others.begin(), others.end());
  sections.push_back(section_of(ground_keys(), "scene/output.md"));
  sections.push_back(section_of(volume_keys(), "scene/volumes.md"));
  sections.push_back(section_of(bed_keys(), "scene/follow.md"));
  return sections;
}

}  // namespace

const std::vector<KeySection>& all_keys() {
  static const std::vector<KeySection> sections = make_sections();
  return sections;
}

std::string keys_text(const std::string& name) {
  std::string text;
  std::vector<std::string> names;
  for (const KeySection& section : all_keys()) {
    names.push_back(section.name);
    if (!name.empty() && section.name != name && section.name.rfind(name + ".", 0) != 0) continue;
    text += fmt::format("{}{} (doc/{})\n\n{}", text.empty() ? "" : "\n", section.name, section.page,
                        markdown(section.rows));
  }
  if (text.empty()) throw SceneError(fmt::format("--keys: no section '{}'; {}", name, suggest(name, names)));
  return text;
}

}  // namespace mpm
