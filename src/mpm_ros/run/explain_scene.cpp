// Text that `run_scene --explain` tells of a scene.
#include <fmt/format.h>

#include <utility>

#include "mpm/advice/explain.hpp"
#include "mpm/advice/feasible.hpp"
#include "mpm_ros/aim/aim.hpp"
#include "mpm_ros/run/expected_pace.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "mpm_ros/run/run_scene_options.hpp"
#include "mpm_ros/run/settling_news.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

namespace {

void explain(const mpm::Scene& scene, const RunSceneOptions& options, std::ostream& out) {
  mpm::SimulationDefinition built = mpm::build(scene, nullptr, stop_overdue);
  out << mpm::explain(scene, built);
  const mpm::DeviceChoice chosen = mpm::choose_device(options.device, built, 1);
  if (!chosen.note.empty()) out << chosen.note << "\n";
  if (chosen.maker) out << "note: what follows is timed on this processor; of the other one no forecast is made\n";
  if (!(scene.definition.time.end > 0.0)) out << "note: the scene has no end; run_scene needs --end\n";
  mpm::pace::StepTimer timer(kTimingBudget, stop_overdue);
  mpm::Simulation simulation(std::move(built),
                             {options.threads,
                              instruction_set(options),
                              true,
                              {},
                              [&timer] { return timer.after_step(); },
                              settling_news([&](const std::string& line) { out << line << std::endl; }),
                              {},
                              stop_overdue});
  // Checks what a run writes, as a run does.
  const OutputOptions output = output_options(scene);
  check_fields(output);
  const RunOutputs outputs(simulation, Stamps(), output);
  out << fmt::format("kernels: instruction set {}, {} thread{}\n", simulation.isa(), simulation.threads(),
                     simulation.threads() == 1 ? "" : "s");
  if (const std::string warning = thread_warning(options.threads); !warning.empty())
    out << "warning: " << warning << "\n";
  for (const std::string& warning : simulation.warnings()) out << "warning: " << warning << "\n";
  for (const std::string& note : simulation.notes()) out << note << "\n";
  out << std::flush << explain_pace(scene, simulation, timer, options.threads);
}

}  // namespace

void explain_scene(const RunSceneOptions& options, std::ostream& out) {
  mpm::Scene given = scene_to_run(
      options, options.from_bag.empty() ? std::nullopt
                                        : std::optional<Rerun>(read_rerun(options.from_bag, !options.resume.empty())));
  const Aim aimed = aim(std::move(given), options.threads, instruction_set(options), stop_overdue);
  const mpm::Scene& scene = aimed.scene;
  for (const std::string& line : aimed.news) out << line << "\n";
  for (const std::string& warning : aimed.warnings) out << "warning: " << warning << "\n";
  if (!aimed.table.empty()) out << "choices that were weighed:\n" << aimed.table;
  try {
    explain(scene, options, out);
  } catch (const std::bad_alloc&) {
    throw mpm::SceneError(mpm::lack_of_memory(scene));
  }
}

}  // namespace mpm_ros
