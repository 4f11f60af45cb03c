// The suite of forces on tools: a slow tool in soil or clay whose force is known, exactly or between bounds.
//
// A problem writes the text of a scene (doc/scene.md), so that a row is what a user gets: keys that it leaves out have
// their defaults, and any other key can be set beside it. Cells count across the tool's depth or width, where their
// size decides about the force. Weak: the force is the mean over a stretch of the way, on which soil
// heaves; what that adds is in the answers to the first order, where it is known.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "study/limit_loads.hpp"

namespace mpm::study::tool_force {

class Measure;

/// Numbers that the scene of a problem is written with.
struct Setup {
  double cells = 8.0;    ///< across the depth or width; blades take halves, too
  std::string law = {};  ///< "mohr_coulomb", "drucker_prager/plane_strain" with its match; the problem's own when empty
};

/// Kind of answer that is known for the force.
enum class Known {
  exact,
  bounds,   ///< it lies between two values
  estimate  ///< no bounds are close: an estimate below, the load of associated flow above
};

struct Problem {
  std::string name;         ///< "blade_flat"
  std::string title;        ///< title of a chart
  std::string text;         ///< statement of what is computed, in a sentence or two
  std::string answer_text;  ///< statement of what is known and its source
  Known known = Known::exact;
  Bounds answer;                ///< mean force along `push`, of the whole tool [N]
  bool grows = false;           ///< in proportion to the travel; `answer` is that at travel = `length`
  double whole = 1.0;           ///< tools that a scene stands for: 2 where a half is modelled
  Vec3 push = Vec3::UnitX();    ///< direction in which the tool is driven
  Vec3 free = Vec3::Zero();     ///< direction in which a smooth tool bears nothing; zero where there is none
  double length = 0.0;          ///< depth or width that cells count across [m]
  double from = 0.0, to = 0.0;  ///< travel over `length` on which the force is averaged
  bool moves_on = false;        ///< the tool passes cells: its force is followed over the travel of one, for the ripple
  double speed = 0.0;           ///< speed of the tool [m/s]
  double ramp = 0.0;            ///< time in which it reaches it [s]
  double wave_speed = 0.0;      ///< wave speed of the material, elastic [m/s]
  std::string law = "drucker_prager/plane_strain";  ///< law of the soil, unless another is asked for
  bool quick = false;                               ///< the short suite runs it
  std::array<bool, 2> has_places = {};              ///< it can be moved within a cell along x, along z
  double finest = 24.0;                             ///< most cells of the long suite, where a run takes minutes
  Box pressed;                                      ///< box where pressure is looked at, from the tool's origin [m]
  /// Text of its scene. @throws StudyError for a setup that it cannot have
  std::function<std::string(const Problem&, const Setup&)> scene;
  /// Measure that is compared with `answer` in a run on so many cells, where it is not the force on a slow tool; `from`
  /// and `to` are then times [s]. The problem outlives it.
  std::function<std::unique_ptr<Measure>(const Problem&, double)> measure = {};

  const std::string& law_of(const Setup& setup) const { return setup.law.empty() ? law : setup.law; }
  /// Travel at which a run ends, over `length`.
  double last(double cells) const;
  /// Time at which the tool has travelled that far [s].
  double time_of(double travel) const;
};

/// All of them, in the order of the document.
const std::vector<Problem>& problems();
/// @throws StudyError that lists the names there are
const Problem& find_problem(const std::string& name);

/// Text of a material: density and constants of `law`, which is a law's name and, after a stroke, its `match`; it
/// dilates without end, as exact limit loads assume. Angles in degrees, stress in Pa.
std::string soil_material(const std::string& law, double density, double young, double poisson, double friction,
                          double dilation, double cohesion);
/// Text of `time`: an end that the tool reaches, and a sync period for at least twenty looks on the way of a cell and
/// on the stretch of the mean.
std::string time_section(const Problem& problem, const Setup& setup);
/// Expression of the tool's speed, for `motion`.
std::string speed_expression(const Problem& problem);
/// Speed of a pressure wave in elastic material [m/s].
double elastic_wave(double density, double young, double poisson);

std::vector<Problem> blades();
std::vector<Problem> footings();
std::vector<Problem> walls();
std::vector<Problem> clay_tools();
std::vector<Problem> slopes();
std::vector<Problem> drags();

}  // namespace mpm::study::tool_force
