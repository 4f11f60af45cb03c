// The work of the program material_driver: a material, written as in a scene, is driven along a path, and its stress
// and history are written to a table. doc/materials.md shows its use.
#pragma once

#include <ostream>
#include <string>

#include "mpm/material/definition.hpp"
#include "mpm/material/strain_path.hpp"

namespace mpm {

/// Numbers are text, in SI or with a unit ("100 kPa"); empty text means the path's default.
struct MaterialDriverOptions {
  std::string material;  ///< name in `scene`; without a scene an element of `materials`, "{law: …, density: …}"
  std::string scene;     ///< name of a shipped scene, or a path; empty: none
  std::string path;      ///< one of strain_path_names(); empty: read from `path_file`
  std::string path_file;
  std::string strain, confining, stress, rate, hold;
  /// The last leg of the path is undrained: storage 1/Q of the water in the pores [1/Pa], and Biot's coefficient, 1.
  std::string storage, biot;
  /// The last leg is heated by a temperature [K], of a material with this linear expansion [1/K].
  std::string heating, expansion;
  bool shear = false;
  int steps = 0;  ///< per leg; 0: the default, 100, or 10 from one row of a file to the next
};

/// @throws SceneError, MaterialError
MaterialDefinition read_driven_material(const MaterialDriverOptions& options);
/// @throws PathError
StrainPath read_driven_path(const MaterialDriverOptions& options);
/// A path from a CSV file: a header "t, ezz, sxx [kPa], …", then a row for the end of each leg. Columns: t; strains exx
/// … exy of the tensor; engineering simple shear gyz, gxz, gxy; stresses sxx … sxy. Components without a column are not
/// strained. @throws PathError "file:line: …"
StrainPath read_path_file(const std::string& file, int steps);
/// Writes the table to `out` step by step, so that it contains the steps before a failure of the law. @throws
/// SceneError, MaterialError, PathError (bad input), PathFailure
void drive_material(const MaterialDriverOptions& options, std::ostream& out);

}  // namespace mpm
