// `method: auto`: the method that the study's figures prefer for what the scene is like. What a scene without `method`
// gets.
//
// The scene's numbers (expected_motion.hpp, or the keys of method.auto) choose suites of the study that look like it:
//
// - strain up to 2 %: bar_small, and square_small or cube_small,
// - more strain: square_large or cube_large; of a line bar_crossing,
// - a turn of 10 degrees: rotation, vortex,
// - contact: plate_compression, sliding_block,
// - bodies that move or meet: colliding_disks,
//
// and among the methods that were measured there the rule of study/preference.hpp chooses. 2 % is the geometric middle
// of the two problems' strains, 0.3 % and 16 %; a box that does not turn is wrong by 1 - cos 10 deg = 1.5 % at 10
// degrees. A cube counts only where a method comes below the error asked for on it: its grids are coarse, and the
// square's motion is the same along each axis.
//
// Not chosen, unless the scene names them: dirac, for any motion through the grid makes its forces jump; and where
// material flows, other shapes than ugimp and transfers than flip, for the study's problems are elastic.
// What the scene says of shape, update or transfer is kept. Without a table of figures: ugimp, usavg, flip.
#pragma once

#include <optional>
#include <string>

#include "mpm/scene/scene.hpp"
#include "mpm/study/preference.hpp"

namespace mpm {

/// What a scene says under `method`, where it leaves the choice.
struct AutoMethod {
  std::optional<double> strain, turn;  ///< largest expected [-], [rad]; the scene's own numbers without them
  study::Budget budget{0.01, {}};
  bool keep_shape = false, keep_update = false, keep_transfer = false;  ///< said beside `auto`
};

/// A table, or why there is none.
struct MethodCostsFile {
  study::MethodCosts costs;
  std::string path;
  std::string fault;  ///< empty when it was read
};

/// The file that the environment variable MPM_ROS_METHOD_COSTS names, else config/method_costs.csv of the package.
MethodCostsFile load_method_costs();
/// Never throws: a file that is missing or damaged is a fault.
MethodCostsFile load_method_costs(const std::string& path);

/// Sets shape, update and transfer of the scene's method, all else of which is read, and says in Scene::choices what
/// was chosen and by which numbers.
void choose_method(const AutoMethod& asked, const MethodCostsFile& file, Scene& scene);

}  // namespace mpm
