// All tables of keys in one place: for run_scene --keys, and for the pages, which show the same rows.
#pragma once

#include <string>
#include <vector>

#include "mpm/keys/key_table.hpp"

namespace mpm {

/// A section of scenes, or a law of `materials`, as a table.
struct KeySection {
  std::string name;  ///< path of the section, or the law's name
  std::string page;  ///< page under doc/ that shows it
  std::vector<KeyRow> rows;
};
const std::vector<KeySection>& all_keys();

/// Text of the sections whose name is `name`, or lies below it; of all where `name` is empty.
/// @throws SceneError for a name that no section has
std::string keys_text(const std::string& name);

}  // namespace mpm
