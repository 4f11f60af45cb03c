// Errors that `target` promises of the force on a tool against those of a run: eight tools that the table of errors was
// not measured with, by their law, their angle of friction, their shape, their cells or their place on the grid.
// Cost: 12 s.
#include <gtest/gtest.h>

#include <string>

#include "mpm/advice/target_choice.hpp"
#include "mpm/math/build_info.hpp"
#include "study/tool_force/run.hpp"

namespace target_promises_test {

using mpm::pace::Ground;
using mpm::pace::ToolUse;
namespace tool_force = mpm::study::tool_force;

struct Promised {
  const char* problem;
  ToolUse use;
  Ground ground;
  double cells;
  const char* place;
  const char* law;
  double most;  ///< that may be promised: a table of large errors would hold what it says
};

const Promised kRuns[] = {
    {"blade_flat", ToolUse::blade, Ground::sand, 5.0, "beside=0.3,0.6", "law=mohr_coulomb", 0.15},
    {"blade_chisel", ToolUse::blade, Ground::sand, 7.0, "beside=0.6,0.4", "law=mohr_coulomb", 0.12},
    {"blade_rough", ToolUse::blade, Ground::sand, 5.0, "beside=0.15,0.35", "law=mohr_coulomb", 0.15},
    {"drag_plate", ToolUse::blade, Ground::sand, 5.0, "beside=0.7,0.1", "law=drucker_prager/plane_strain", 0.15},
    {"strip_nc_20", ToolUse::plate, Ground::sand, 6.0, "beside=0,0.3", "law=drucker_prager/plane_strain", 0.15},
    {"strip_nq_20", ToolUse::plate, Ground::sand, 6.0, "beside=0,0.7", "law=mohr_coulomb", 0.15},
    {"strip_clay_smooth", ToolUse::plate, Ground::clay, 6.0, "beside=0,0.5", "law=mohr_coulomb", 0.5},
    {"disc_clay_smooth", ToolUse::plate, Ground::clay, 8.0, "beside=0,0.3", "law=mohr_coulomb", 0.35},
};

TEST(TargetPromises, AreKeptByToolsThatTheTableDoesNotKnow) {
  const mpm::Scene scene = mpm::load_scene(mpm::source_folder() + "/config/scenes/wheel_in_sand.yaml", {});
  const mpm::pace::ForceErrors errors = mpm::load_force_errors(scene);
  for (const Promised& run : kRuns) {
    SCOPED_TRACE(run.problem);
    mpm::pace::Discretisation one;
    one.cell = mpm::Vec3::Constant(1.0 / run.cells);
    one.along = 2;
    one.cfl = 0.5;
    one.update = mpm::UpdateScheme::usavg;
    const auto promised = errors.of(one, {run.use, run.ground, 1.0}, mpm::GeometryKind::plane_strain);
    ASSERT_TRUE(promised);
    EXPECT_LT(promised->total(), run.most);
    const auto row = tool_force::run_row(tool_force::find_problem(run.problem), run.cells, {run.law, run.place}, {});
    ASSERT_EQ(row.status, "ok") << row.message;
    EXPECT_LT(row.error, promised->total()) << row.over_exact << " over exact";
    RecordProperty(run.problem, std::to_string(row.error) + " of " + std::to_string(promised->total()));
  }
}

}  // namespace target_promises_test
