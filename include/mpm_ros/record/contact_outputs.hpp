// Outputs of contact: forces and torques averaged since the last message, wrenches in each body's axes, as they are and
// through a low-pass, and arrows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm_ros/message/contact_average.hpp"
#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/markers.hpp"
#include "mpm_ros/message/wrench_filter.hpp"
#include "mpm_ros/record/output_sinks.hpp"

namespace mpm_ros {

class ContactOutputs {
 public:
  /// The first three must outlive it. `cutoff` of the filtered wrenches [Hz], 0: there are none. `force_scale` of
  /// arrows [m/N], 0: by the largest force met. @throws mpm::DefinitionError for a cutoff that is not below half of the
  /// sync points' rate
  ContactOutputs(mpm::Simulation& simulation, OutputSinks& sinks, const LocalFrame& frame, double cutoff,
                 double force_scale);

  /// Takes the contacts of the sync period that ended now.
  void read();
  /// Writes the average since the last call.
  void write();
  /// [ns] of the last calls, -1 before the first.
  std::int64_t read_at() const { return read_at_; }
  std::int64_t written_at() const { return written_at_; }
  /// True if nothing was read since the last write().
  bool nothing_new() const { return average_.empty(); }
  /// Contacts over the last sync period.
  const Contacts& last() const { return contacts_; }
  ContactForces message(const Contacts& contacts) const;
  /// For checkpoints: averages since the last messages.
  void serialise(mpm::StateArchive& archive);

 private:
  mpm::Simulation& simulation_;
  OutputSinks& sinks_;
  const LocalFrame& frame_;
  const double cutoff_;  // [Hz]
  std::vector<std::string> wrench_topics_;
  std::vector<std::string> filtered_topics_;
  std::vector<WrenchFilter> filters_;  // filters of each body; empty: none
  std::vector<mpm::Wrench> filtered_;  // body axes
  ForceMarkers markers_;
  Contacts contacts_;
  ContactAverage average_;
  std::int64_t read_at_ = -1;
  std::int64_t written_at_ = -1;
};

}  // namespace mpm_ros
