#include "mpm_ros/run/follow.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/aim/timing.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/run/led_run.hpp"

namespace mpm_ros {
namespace {

Order vector_order(const mpm::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }
mpm::Vec3 vector_of(const Order& order) {
  return {order.at(0).get<double>(), order.at(1).get<double>(), order.at(2).get<double>()};
}

/// Options that decide at which sync points all ranks read their particles, and which of them; the rest is for the
/// first, which writes.
Order output_order(const OutputOptions& output) {
  Order order = {{"fields", output.particles.fields},         {"stride", output.particles.choice.stride},
                 {"particle_period", output.particle_period}, {"particle_first", output.particle_first},
                 {"wrench_period", output.wrench_period},     {"wrench_cutoff", output.wrench_cutoff},
                 {"world_frame", output.world_frame},         {"state_hash", output.state_hash}};
  if (const auto& region = output.particles.choice.region)
    order["region"] = {vector_order(region->min), vector_order(region->max)};
  return order;
}

OutputOptions output_of(const Order& order, const mpm::Scene& scene) {
  OutputOptions output = output_options(scene);
  output.particles.fields = order.at("fields").get<std::vector<std::string>>();
  output.particles.choice.stride = order.at("stride");
  output.particles.choice.region.reset();
  if (order.contains("region"))
    output.particles.choice.region = mpm::Box{vector_of(order["region"][0]), vector_of(order["region"][1])};
  output.particle_period = order.at("particle_period");
  output.particle_first = order.at("particle_first");
  output.wrench_period = order.at("wrench_period");
  output.wrench_cutoff = order.at("wrench_cutoff");
  output.world_frame = order.at("world_frame");
  output.state_hash = order.at("state_hash");
  return output;
}

class Follower {
 public:
  explicit Follower(std::shared_ptr<mpm::Communicator> ranks) : ranks_(std::move(ranks)) {}

  void obey(const Order& order) {
    const std::string what = order.at("do");
    if (what == "time") return time_as_told(*ranks_, order);
    const int number = order.at("run");
    if (what == "make") return make(order, number);
    Run& run = *runs_.at(number).run;
    try {
      take_commands(order, run);
      if (what == "begin") runs_.erase(runs_.begin(), runs_.find(number));  // those before it are over
      obey(what, order, run);
    } catch (const std::exception& error) {
      if (!is_alike(error)) throw;  // errors of all are told by the first rank
    }
  }

 private:
  struct Followed {
    std::unique_ptr<const mpm::Scene> scene;  // for as long as its run
    std::unique_ptr<Run> run;
  };

  void make(const Order& order, int number) {
    try {
      Followed made;
      made.scene = std::make_unique<const mpm::Scene>(mpm::parse_scene(order.at("scene"), order.at("path")));
      RunOptions options;
      options.ranks = ranks_;
      options.threads = order.at("threads");
      if (options.threads == 0) options.threads = mpm::threads_of_rank(*ranks_);
      options.isa = order.at("isa");
      options.output = output_of(order.at("output"), *made.scene);
      options.resume = order.at("resume");
      if (!options.resume.empty()) options.more = [](mpm::StateArchive&) {};  // commands that wait do so on the first
      options.stop = [] { return false; };                                    // a stop comes as an order
      ros::Time origin;
      made.run = std::make_unique<Run>(*made.scene, options, Stamps(origin.fromNSec(order.at("origin"))), nullptr);
      runs_[number] = std::move(made);
    } catch (const std::exception& error) {
      mpm::fail_alike(*ranks_, fmt::format("rank {}: {}", ranks_->rank(), error.what()), exit_code_of(error));
    }
  }

  static void take_commands(const Order& order, Run& run) {
    if (!order.contains("commands")) return;
    for (const Command& command : unpacked<std::vector<Command>>(order["commands"]))
      run.apply(from_message(command, run.simulation()));
  }

  void obey(const std::string& what, const Order& order, Run& run) {
    if (what == "begin") {
      run.begin();
    } else if (what == "advance") {
      run.advance();
      run.take_warnings();
    } else if (what == "set_state") {
      run.set_state(from_message(unpacked<StateSet>(order.at("state"))));
    } else if (what == "save") {
      run.save(
          order.at("path"), [](mpm::StateArchive&) {}, order.at("failure"));
    } else if (what == "finish") {
      run.finish();
    } else if (what == "fail") {
      run.fail(order.at("reason"));
    } else {
      throw mpm::RanksError(
          fmt::format("the first rank wants '{}', which rank {} does not know: have the same version "
                      "of the package on all machines",
                      what, ranks_->rank()));
    }
  }

  const std::shared_ptr<mpm::Communicator> ranks_;
  std::map<int, Followed> runs_;  // by number: the present one, and one that is made to come after it
};

}  // namespace

int follow(const std::shared_ptr<mpm::Communicator>& ranks) {
  Follower follower(ranks);
  for (;;) {
    const Order order = hear(*ranks);
    if (order.at("do") == "end") return order.at("code");
    follower.obey(order);
  }
}

void end_following(mpm::Communicator& ranks, int code) { tell(ranks, {{"do", "end"}, {"code", code}}); }

Order order_to_make(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, int number) {
  return {{"do", "make"},
          {"run", number},
          {"scene", scene.text},
          {"path", absolute_path(scene.path)},
          {"threads", options.threads},
          {"isa", mpm::isa_name(mpm::choose_isa(options.isa))},
          {"resume", options.resume.empty() ? std::string() : absolute_path(options.resume)},
          {"origin", stamps.origin().toNSec()},
          {"output", output_order(options.output)}};
}

int exit_code_of(const std::exception& error) {
  if (dynamic_cast<const mpm::PhysicsError*>(&error) != nullptr) return 3;
  if (dynamic_cast<const mpm::RankFailure*>(&error) != nullptr) return 3;
  if (dynamic_cast<const mpm::Error*>(&error) != nullptr) return 2;
  if (dynamic_cast<const BagError*>(&error) != nullptr) return 2;
  return 1;
}

}  // namespace mpm_ros
