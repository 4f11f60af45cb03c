// A run that several ranks compute together and the first of them leads: the node's, which alone hears what is asked of
// it. Every call that all ranks have to make goes to the others as an order (lead/order.hpp) before it is made here;
// commands go with the next one, so that a sync period is one order. The others follow it in follow.hpp.
//
// What fails on all ranks alike, as a particle that leaves the grid does, leaves them together, and is thrown as in one
// process. What one rank alone fails at parts them: this one then closes its record and can do nothing more, and the
// program has to end all (mpm::end_all()).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mpm_ros/lead/order.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

class LedRun final : public Run {
 public:
  void begin() override;
  mpm::CheckpointAbout save(const std::string& path, const mpm::SerialiseMore& more,
                            const std::string& failure) override;
  using Run::apply;
  void apply(const AppliedCommand& command) override;
  void set_state(const mpm::StateSet& state) override;
  /// @throws mpm::RankFailure where the ranks have parted
  void advance(std::chrono::steady_clock::duration late) override;
  void finish() override;
  void fail(const std::string& reason) override;
  bool parted() const override { return parted_; }

 private:
  friend std::unique_ptr<Run> make_run(const mpm::Scene&, const RunOptions&, const Stamps&, MessageSink*);
  LedRun(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live, int number);
  void tell(const std::string& what, Order order = Order::object());
  template <class Work>
  void with_others(const Work& work);

  const int number_;  ///< number among the runs that this process has led: there may be two at a time
  std::vector<mpm_ros::Command> commands_;  ///< commands that the others do not know of yet
  bool parted_ = false;
};

/// True if it is thrown on all ranks where it is thrown on one.
bool is_alike(const std::exception& error);

/// The run of one process or, where the options have ranks, a led one; to be called on the first of them.
/// @throws as Run's constructor does
std::unique_ptr<Run> make_run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps,
                              MessageSink* live);

}  // namespace mpm_ros
