// `method: auto`: chooses the method that measured best in the study for problems like the scene. A scene without
// `method` gets this choice too.
//
// The scene's expected strain, turn and contact (expected_motion.hpp, or the keys of method.auto) select suites of the
// study that resemble it:
//
// - strain up to 2 %: bar_small, and square_small or cube_small, - more strain: square_large or cube_large; in a line
// bar_crossing, - a turn of 10 degrees: rotation, vortex, - contact: plate_compression, sliding_block, - bodies that
// move or meet: colliding_disks,
//
// and the rule of choice/preference.hpp chooses among the methods measured in them. 2 % is the geometric mean of the
// strains of the two problems, 0.3 % and 16 %; a box that does not turn is wrong by 1 - cos 10 deg = 1.5 % at 10
// degrees. A cube counts only where a method reaches the required error on it: its grids are coarse, and the square's
// motion is the same along each axis.
//
// Not chosen, unless the scene names them: dirac, because any motion through the grid makes its forces jump; and where
// material flows, other shapes than ugimp and other transfers than flip, because the study's problems are elastic. A
// shape, update or transfer that the scene names is kept. Soil with slow tools takes implicit steps, which the study
// does not have (implicit_choice.hpp). Without a table of measurements the choice is ugimp, usavg, flip.
#pragma once

#include <optional>
#include <string>

#include "mpm/choice/preference.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// The part of `method` in a scene that concerns the choice.
struct AutoMethod {
  std::optional<double> strain, turn;  ///< largest expected [-], [rad]; without a value it is estimated from the scene
  choice::Budget budget{0.01, {}};
  bool keep_shape = false, keep_update = false, keep_transfer = false;  ///< named in the scene
  bool names_transfer = false;  ///< keep_transfer, and not because of the material
  bool names_more = false;      ///< a strain, a turn or a budget, which the study of explicit steps answers
};

/// A table of measurements, or the reason why there is none.
struct MethodCostsFile {
  choice::MethodCosts costs;
  std::string path;
  std::string fault;  ///< empty when the table was read
};

/// Loads the file named by the environment variable MPM_ROS_METHOD_COSTS, else config/method_costs.csv of the package.
MethodCostsFile load_method_costs();
/// Loads the file at `path`. Does not throw: a missing or damaged file is reported in MethodCostsFile::fault.
MethodCostsFile load_method_costs(const std::string& path);

/// Sets shape, update and transfer of the scene's method, whose other sections must have been read, and adds to
/// Scene::choices the choice and the numbers behind it.
void choose_method(const AutoMethod& asked, const MethodCostsFile& file, Scene& scene);

}  // namespace mpm
