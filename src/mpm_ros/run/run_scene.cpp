#include "mpm_ros/run/run_scene.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "mpm/math/json_text.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/aim/aim.hpp"
#include "mpm_ros/command/command_log.hpp"
#include "mpm_ros/message/progress_bar.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/record/scene_files.hpp"
#include "mpm_ros/record/together.hpp"
#include "mpm_ros/run/rerun.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_files.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"
#include "mpm_ros/run/run_scene_files.hpp"
#include "mpm_ros/run/run_scene_options.hpp"
#include "mpm_ros/run/run_scene_summary.hpp"
#include "mpm_ros/run/settling_news.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {
namespace {

/// The run with its sinks, from beginning to end.
class OfflineRun {
 public:
  OfflineRun(const RunSceneOptions& options, std::ostream& err)
      : options_(own_part(options)),
        rerun_(read(options)),
        aim_(aim_together(scene_to_run(options_, rerun_), options.threads, instruction_set(options), stop_overdue,
                          options.ranks.get())),
        scene_(aim_.scene),
        checkpoints_(options, scene_.definition.time.sync) {
    if (!(scene_.definition.time.end > 0.0)) {
      throw mpm::SceneError(
          fmt::format("{}: time.end: the scene has no end; give one with --end, or --set time.end=2", scene_.path));
    }
    check_alike(options_, scene_);
    RunOptions run_options;
    run_options.threads = options_.threads;
    run_options.ranks = options_.ranks;
    if (options_.profile) run_options.profile = &profile_;
    run_options.isa = options_.isa;
    run_options.device = options_.device;
    run_options.output = output_options(scene_);
    check_fields(run_options.output);
    run_options.stop = stop_overdue;
    run_options.settling = settling_news([&err](const std::string& line) { err << line << std::endl; });
    run_options.bag_options.compression = options_.bag_compression;
    read_split(options_.bag_split, run_options.bag_options);
    if (rerun_) choose_as_recorded(run_options);
    together<mpm::SceneError>(options_.ranks.get(), [this] {
      check_outputs(options_, scene_);
      if (!options_.resume.empty()) check_not_there(options_);
      files_.try_all();
    });
    if (!options_.bag.empty()) run_options.bag = bag_path(options_.bag, scene_.definition.name, 1);
    if (!options_.end.empty()) run_options.parameters += fmt::format("end: {:.17g}\n", scene_.definition.time.end);
    if (!options_.resume.empty()) resume_from(options_.resume, run_options);
    run_ = std::make_unique<Run>(scene_, run_options, stamps_, nullptr);
    if (rerun_ && run_->simulation().budget() != nullptr) repeat_cuts();
    if (rerun_) compare_devices();
    files_.open(*run_);
    if (!options_.resume.empty() && !options_.end.empty() && run_->simulation().time() > run_->end()) {
      throw mpm::SceneError(fmt::format("--end: '{}' is before the checkpoint's time of {:g} s; write a later one",
                                        options_.end, mpm::seconds_of(run_->simulation().time())));
    }
    commands_.skip_to(run_->simulation().time());
    if (check_ && run_->simulation().time() > rerun_->hashed_at)
      check_->differs("it goes on from a checkpoint after the recorded state");
  }

  RunSceneResult go(std::ostream& out, std::ostream& err, bool bar, const std::function<bool()>& stop_requested) {
    const mpm::Simulation& simulation = run_->simulation();
    if (!options_.resume.empty() && run_->ended()) {
      err << fmt::format("note: the checkpoint is of t = {:g} s, where the run ends already; nothing is computed\n",
                         mpm::nearest_seconds(simulation.time()));
    }
    for (const std::string& line : aim_.news) err << line << "\n";
    for (const std::string& warning : aim_.warnings) err << "warning: " << warning << "\n";
    if (const std::string warning = thread_warning(options_.threads); !warning.empty())
      err << "warning: " << warning << "\n";
    for (const std::string& warning : simulation.warnings()) err << "warning: " << warning << "\n";
    if (!run_->device_note().empty()) err << run_->device_note() << "\n";
    for (const std::string& note : simulation.notes()) err << note << "\n";
    for (std::size_t body = 0; body < scene_.commands.size(); ++body) {
      if (scene_.commands[body].frame.empty() || rerun_) continue;  // skips bodies that the recording moves
      err << fmt::format("warning: '{}' stands still: only the node follows a tf frame (drive: tf)\n",
                         mpm::commanded_names(scene_)[body]);
    }
    const mpm::SolverState start = simulation.state();
    ProgressBar progress(err, bar);
    const double end = static_cast<double>(run_->end());
    const auto where = [&] {
      return fmt::format("t = {:.4g} of {:.4g} s", mpm::nearest_seconds(simulation.time()),
                         end / mpm::kNanosecondsOfSecond);
    };
    for (const std::string& note : notes_) err << note << "\n";
    const bool shown = run_->recorder() != nullptr;
    if (const std::string note = note_on(run_->outputs().local_frame()); shown && !note.empty())
      err << "note: " << note << "\n";
    if (run_->recorder() != nullptr && run_->recorder()->replaced())
      err << "note: the recording " << run_->bag() << " is replaced\n";
    const auto began = std::chrono::steady_clock::now();
    bool failed = false, room = true;
    // Writes what else was asked for if one record cannot go on.
    const auto recorded = [&](const auto& work) {
      const auto no_room = [&](const std::exception& error) {
        progress.clear();
        err << "run_scene: " << error.what() << "\n";
        room = false;
      };
      try {
        work();
      } catch (const BagError& error) {
        no_room(error);
      } catch (const CsvError& error) {
        no_room(error);
        files_.leave_out_csv();
      } catch (const VtkError& error) {
        no_room(error);
        files_.leave_out_vtk();
      }
    };
    recorded([&] {
      try {
        if (check_) check_->look(simulation);
        run_->begin();
        while (!run_->ended() && !simulation.on_any_rank(stop_requested())) {
          for (const mpm::StateSet& state : commands_.take_states(simulation)) run_->set_state(state);
          for (const AppliedCommand& command : commands_.take(simulation)) run_->apply(command);
          for (const JointOrder& order : commands_.take_joints(simulation)) run_->apply(order, true);
          run_->advance();
          for (const std::string& warning : run_->take_warnings()) {
            progress.clear();
            err << "warning: " << warning << "\n";
          }
          checkpoints_.at_sync(*run_, err);
          if (check_) check_->look(simulation);
          progress.show(static_cast<double>(simulation.time()) / end, where);
        }
        progress.clear();
        if (run_->ended() && rerun_) {
          // The recorded run was ended in a pause in which states had been set.
          for (const mpm::StateSet& state : commands_.take_states(simulation)) run_->set_state(state);
          if (check_) check_->look(simulation);
        }
        if (!run_->ended()) {
          err << fmt::format("stopped at t = {:g} s, before the end\n", mpm::nearest_seconds(simulation.time()));
          if (check_) check_->differs("it was stopped before its end");
        }
        run_->finish();
      } catch (const mpm::StoppedError& error) {
        progress.clear();
        err << error.what() << "; the record ends at the sync point before\n";
        if (check_) check_->differs("it was stopped before its end");
        run_->finish();
      } catch (const mpm::PhysicsError& error) {
        failed = true;
        progress.clear();
        err << "run_scene: " << error.what() << "\n";
        recorded([&] { run_->fail(error.what()); });
        checkpoints_.at_failure(*run_, error.what(), err);
        if (check_ && !run_->state_lost()) check_->look(simulation);
      }
    });
    if (!room) recorded([&] { run_->finish(); });
    recorded([&] { files_.close_csv(); });
    recorded([&] { files_.close_vtk(); });
    if (run_->state_lost()) return room ? RunSceneResult::physics_failed : RunSceneResult::machine_failed;
    const RunSummary summary(scene_, simulation, start, run_->outputs().contacts(), run_->cut_short(), run_->device());
    out << summary.text();
    if (!files_.write_summary(summary, err)) room = false;
    if (!failed && !files_.write_terrain(simulation, out, err)) room = false;
    if (!run_->bag().empty()) out << "  bag " << run_->bag() << "\n";
    if (!options_.out.empty()) out << "  all in " << options_.out << "\n";
    RunSceneResult result = failed ? RunSceneResult::physics_failed : RunSceneResult::done;
    if (!room) result = RunSceneResult::machine_failed;
    if (check_ && room) {
      (check_->passed() ? out << "  " : err << "run_scene: ") << check_->verdict() << "\n";
      if (!check_->passed()) result = RunSceneResult::another_state;
    }
    if (options_.profile) {
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
      out << "where the wall time of the run went, from its first step on:\n" << profile_.table(wall.count());
    }
    if (!failed && !save_last(out, err) && result == RunSceneResult::done) result = RunSceneResult::machine_failed;
    return result;
  }

 private:
  static std::optional<Rerun> read(const RunSceneOptions& options) {
    if (options.from_bag.empty()) return std::nullopt;
    if (!options.scene.empty()) {
      throw mpm::SceneError(
          fmt::format("--from-bag {}: the bag holds its scene; leave out {}", options.from_bag, options.scene));
    }
    Rerun rerun;
    mpm::agree<BagError>(options.ranks.get(), [&] {
      if (mpm::is_first(options.ranks.get())) rerun = read_rerun(options.from_bag, !options.resume.empty());
    });
    return rerun_of_first(options.ranks.get(), std::move(rerun));
  }

  /// Instruction set and commands of the recording; what makes it another run is noted.
  void choose_as_recorded(RunOptions& run_options) {
    const RunInfo& info = rerun_->info;
    check_.emplace(*rerun_);
    commands_ = CommandLog(rerun_->commands, rerun_->joint_commands, rerun_->states_set);
    run_options.parameters = fmt::format("from_bag: {}\n", mpm::json_text(nlohmann::json(options_.from_bag)));
    notes_.push_back(fmt::format(
        "{} again: recorded with version {}, instruction set {} and {} command{}, to t = {:g} s", info.scene,
        info.version, info.isa, commands_.size(), commands_.size() == 1 ? "" : "s", mpm::seconds_of(rerun_->end)));
    const std::vector<std::string> changes = changed_files(info.files, info.scene_path);
    for (const std::string& change : changes) notes_.push_back("warning: " + change);
    if (mpm::any_of_all(options_.ranks.get(), !changes.empty())) check_->differs("a file of the scene has changed");
    const int ranks = options_.ranks ? options_.ranks->size() : 1;
    if (const int recorded = recorded_ranks(info); recorded != ranks)
      check_->differs(fmt::format("processes add up in another order: {} in place of {}", ranks, recorded));
    if (!options_.set.empty()) check_->differs("--set changes the scene");
    if (!options_.end.empty()) check_->differs("--end changes the end");
    const std::optional<mpm::Isa> recorded = mpm::find_isa(info.isa);
    if (run_options.isa == "auto" && recorded && mpm::isa_available(*recorded)) run_options.isa = info.isa;
    const std::string isa = mpm::isa_name(mpm::choose_isa(run_options.isa));
    if (isa != info.isa) check_->differs(fmt::format("instruction set {} in place of {}", isa, info.isa));
  }

  /// Sweeps end where they ended in the recording, and not by this machine's clock.
  void repeat_cuts() {
    run_->simulation().repeat_cuts(rerun_->cuts);
    notes_.push_back(fmt::format("time.budget: the sweeps of {} step{} end as recorded, whatever time they take",
                                 rerun_->cuts.size(), rerun_->cuts.size() == 1 ? "" : "s"));
  }

  void compare_devices() {
    const std::string recorded = recorded_device(rerun_->info);
    const auto named = [](const std::string& device) { return device.empty() ? "the processor" : device; };
    if (recorded != run_->device())
      check_->differs(fmt::format("steps by {} in place of {}", named(run_->device()), named(recorded)));
  }

  bool save_last(std::ostream& out, std::ostream& err) {
    try {
      checkpoints_.at_end(*run_, out);
      return true;
    } catch (const mpm::CheckpointError& error) {
      err << "run_scene: " << error.what() << "\n";
      return false;
    }
  }

  RunSceneOptions options_;
  const std::optional<Rerun> rerun_;
  const Aim aim_;
  const mpm::Scene& scene_;
  RunSceneCheckpoints checkpoints_;
  const Stamps stamps_;
  CommandLog commands_;  ///< recorded ones, to be applied again
  std::optional<RerunCheck> check_;
  std::vector<std::string> notes_;
  mpm::TimeProfile profile_;
  RunSceneFiles files_{options_, scene_, stamps_};  ///< files beside the recording
  std::unique_ptr<Run> run_;
};

}  // namespace

void list_scenes(std::ostream& out) {
  for (const auto& [name, line] : mpm::shipped_scenes()) out << fmt::format("{:<26} {}\n", name, line);
}

RunSceneResult run_scene(const RunSceneOptions& options, std::ostream& out, std::ostream& err, bool bar,
                         const std::function<bool()>& stop_requested) {
  // Lines are those of the first rank, but for why another one cannot go on.
  std::ostream nowhere(nullptr);
  const bool tells = !options.ranks || options.ranks->first();
  std::ostream& own_out = tells ? out : nowhere;
  std::ostream& own_err = tells ? err : nowhere;
  std::string reason;
  RunSceneResult result = RunSceneResult::bad_input;
  try {
    return OfflineRun(options, own_err).go(own_out, own_err, bar && tells, stop_requested);
  } catch (const mpm::StoppedError& error) {
    own_err << error.what() << "; nothing was recorded\n";
    return RunSceneResult::done;
  } catch (const mpm::PhysicsError& error) {
    reason = error.what();
    result = RunSceneResult::physics_failed;
  } catch (const mpm::RankFailure& error) {
    reason = error.what();
    result = RunSceneResult::physics_failed;
  } catch (const std::bad_alloc&) {
    reason = "there is not enough memory for this scene; use a larger grid.cell or a smaller scene";
    result = RunSceneResult::machine_failed;
  } catch (const mpm::Error& error) {
    reason = error.what();
  } catch (const BagError& error) {
    reason = error.what();
  } catch (const CsvError& error) {
    reason = error.what();
  } catch (const VtkError& error) {
    reason = error.what();
  }
  reason = "run_scene: " + reason;
  if (options.ranks) {
    if (!tells) reason = fmt::format("rank {}: {}", options.ranks->rank(), reason);
    mpm::end_all(*options.ranks, reason, static_cast<int>(result));
  } else {
    err << reason << "\n";
  }
  return result;
}

}  // namespace mpm_ros
