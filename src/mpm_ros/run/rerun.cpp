#include "mpm_ros/run/rerun.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>

#include "mpm_ros/lead/order.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/report/report_bag.hpp"

namespace mpm_ros {
namespace {

class Reader : public RunVisitor {
 public:
  explicit Reader(Rerun& rerun) : rerun_(rerun) {}
  void command(std::int64_t, const mpm_ros::Command& message) override { rerun_.commands.push_back(message); }
  void joint_command(std::int64_t, const JointCommand& message) override { rerun_.joint_commands.push_back(message); }
  void state_set(std::int64_t, const StateSet& message) override { rerun_.states_set.push_back(message); }
  void solver_state(std::int64_t time, const SolverState& message) override {
    if (!begin_) begin_ = time;
    rerun_.end = time;
    rerun_.failed = message.failed != 0;
    const std::size_t cuts = std::min(message.cut_steps.size(), message.cut_sweeps.size());
    for (std::size_t i = 0; i < cuts; ++i) {
      rerun_.cuts.push_back({message.cut_steps[i], static_cast<std::int32_t>(message.cut_sweeps[i])});
    }
    if (message.state_hash.empty()) return;
    rerun_.state_hash = message.state_hash;
    rerun_.hashed_at = time;
  }
  /// [ns] of the first state; none when there is no state.
  const std::optional<std::int64_t>& begin() const { return begin_; }

 private:
  Rerun& rerun_;
  std::optional<std::int64_t> begin_;
};

/// A value that the run has put beside its parameters.
template <class Value>
Value recorded(const RunInfo& info, const char* key, const Value& without) {
  try {
    const YAML::Node value = YAML::Load(info.parameters)[key];
    return value ? value.as<Value>() : without;
  } catch (const YAML::Exception&) {
    return without;
  }
}

}  // namespace

Rerun read_rerun(const std::string& path, bool resumed) {
  Rerun rerun;
  rerun.bag = path;
  RunBag bag(path, {});
  if (!bag.info() || bag.info()->scene_text.empty()) {
    throw BagError(
        fmt::format("{}: tells no scene (topic run_info); give a bag that the simulator or run_scene recorded "
                    "from its start",
                    path));
  }
  rerun.info = *bag.info();
  Reader reader(rerun);
  bag.read_states_and_commands(reader);
  if (!resumed && (rerun.info.part > 1 || reader.begin().value_or(0) > 0)) {
    throw BagError(
        fmt::format("{}: begins {} s after the run's start, and the state there is not in it; give the "
                    "recording's first part, or resume from a checkpoint",
                    path, mpm::seconds_of(reader.begin().value_or(0))));
  }
  if (rerun.end == 0 && !rerun.failed) throw BagError(path + ": the recording does not reach beyond the run's start");
  return rerun;
}

Rerun rerun_of_first(mpm::Communicator* ranks, Rerun own) {
  if (ranks == nullptr) return own;
  if (ranks->first()) {
    // Without steps that a budget cut: they are implicit, which one process makes.
    tell(*ranks, {{"bag", own.bag},
                  {"info", packed(own.info)},
                  {"commands", packed(own.commands)},
                  {"joint_commands", packed(own.joint_commands)},
                  {"states_set", packed(own.states_set)},
                  {"end", own.end},
                  {"state_hash", own.state_hash},
                  {"hashed_at", own.hashed_at},
                  {"failed", own.failed}});
    return own;
  }
  const Order told = hear(*ranks);
  own.bag = told.at("bag");
  own.info = unpacked<RunInfo>(told.at("info"));
  own.commands = unpacked<std::vector<mpm_ros::Command>>(told.at("commands"));
  own.joint_commands = unpacked<std::vector<mpm_ros::JointCommand>>(told.at("joint_commands"));
  own.states_set = unpacked<std::vector<mpm_ros::StateSet>>(told.at("states_set"));
  own.end = told.at("end");
  own.state_hash = told.at("state_hash");
  own.hashed_at = told.at("hashed_at");
  own.failed = told.at("failed");
  return own;
}

int recorded_ranks(const RunInfo& info) { return recorded(info, "ranks", 1); }
std::string recorded_device(const RunInfo& info) { return recorded<std::string>(info, "steps_by", ""); }

void RerunCheck::look(const mpm::Simulation& simulation) {
  if (!comparable() || simulation.time() != rerun_.hashed_at) return;
  hash_ = hash_text(simulation.state_hash());
}

std::string RerunCheck::verdict() const {
  const std::string when = fmt::format("at t = {:g} s", mpm::seconds_of(rerun_.hashed_at));
  if (!differences_.empty()) return fmt::format("not compared with the recording: {}", fmt::join(differences_, "; "));
  if (rerun_.state_hash.empty()) return "not compared with the recording, which was cut short and holds no state hash";
  if (hash_.empty()) return fmt::format("the run ended before the recorded state {}", when);
  if (hash_ == rerun_.state_hash) return fmt::format("state hash {} {}: equal to the recorded one", hash_, when);
  return fmt::format("state hash {} {}, but {} was recorded: this version of the package computes another run", hash_,
                     when, rerun_.state_hash);
}

}  // namespace mpm_ros
