// What the program material_driver does behind its options: a material as a scene spells it, driven along a path, to a
// table of what it carries. doc/materials.md shows its use.
#pragma once

#include <ostream>
#include <string>

#include "mpm/material/definition.hpp"
#include "mpm/material/strain_path.hpp"

namespace mpm {

/// Numbers are text, SI or with a unit ("100 kPa"); empty: the path's default.
struct MaterialDriverOptions {
  std::string material;  ///< of `scene`, by name; without a scene an element of `materials`, "{law: …, density: …}"
  std::string scene;     ///< a shipped name, or a path; empty: none
  std::string path;      ///< one of strain_path_names(); empty: `path_file`
  std::string path_file;
  std::string strain, confining, stress, rate, hold;
  bool shear = false;
  int steps = 0;  ///< a leg; 0: 100, from one row of a file to the next 10
};

/// @throws SceneError, MaterialError
MaterialDefinition read_driven_material(const MaterialDriverOptions& options);
/// @throws PathError
StrainPath read_driven_path(const MaterialDriverOptions& options);
/// A path from a CSV file: a header "t, ezz, sxx [kPa], …", then a row for the end of each leg. Columns: t; strains exx
/// … exy of the tensor; gyz, gxz, gxy engineering simple shear; stresses sxx … sxy. What has no column is not strained.
/// @throws PathError "file:line: …"
StrainPath read_path_file(const std::string& file, int steps);
/// Writes the table to `out` as it goes, so that what a law did before it failed is there.
/// @throws SceneError, MaterialError, PathError (bad input), PathFailure
void drive_material(const MaterialDriverOptions& options, std::ostream& out);

}  // namespace mpm
