#include "mpm_ros/record/contact_outputs.hpp"

#include <fmt/format.h>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

/// The longest contact arrow, as a part of the domain's longest edge.
constexpr double kArrowLength = 0.25;

/// Length of the longest contact arrow [m]; axes that the scene does not have, such as the turn about an axis, do not
/// count.
double arrow_length(const mpm::SimulationDefinition& scene) {
  mpm::Vec3 size = scene.grid.max - scene.grid.min;
  for (const int axis : mpm::axes_beside(scene.geometry)) size[axis] = 0.0;
  return kArrowLength * size.maxCoeff();
}

}  // namespace

ContactOutputs::ContactOutputs(mpm::Simulation& simulation, OutputSinks& sinks, const LocalFrame& frame, double cutoff,
                               double force_scale)
    : simulation_(simulation),
      sinks_(sinks),
      frame_(frame),
      cutoff_(cutoff),
      markers_(force_scale, arrow_length(simulation.definition()), simulation.definition().grid.max.z()) {
  for (const mpm::BodyState& body : simulation.bodies()) {
    wrench_topics_.push_back(topics::of_body(body.name, topics::kWrench));
    filtered_topics_.push_back(topics::of_body(body.name, topics::kWrenchFiltered));
  }
  if (!(cutoff > 0.0)) return;
  const double period = mpm::seconds_of(simulation.sync_period());
  if (!(cutoff < 0.5 / period)) {
    throw mpm::DefinitionError(
        fmt::format("the cutoff of the filtered wrenches, {} Hz, is not below half of the rate of sync points, {} Hz; "
                    "lower it, or time.sync",
                    cutoff, 0.5 / period));
  }
  filters_.assign(wrench_topics_.size(), WrenchFilter(cutoff, period));
  filtered_.resize(wrench_topics_.size());
}

void ContactOutputs::read() {
  read_at_ = simulation_.time();
  contacts_.bodies.clear();
  for (int body = 0; body < static_cast<int>(wrench_topics_.size()); ++body) {
    contacts_.bodies.push_back(simulation_.take_contact(body));
  }
  contacts_.pairs = simulation_.take_pairs();
  average_.add(contacts_);
  if (filters_.empty()) return;
  const std::vector<mpm::BodyState> bodies = simulation_.bodies();
  for (std::size_t body = 0; body < filters_.size(); ++body) {
    filtered_[body] = filters_[body].filter(in_body_axes(contacts_.bodies[body].mean, bodies[body].pose.orientation));
  }
}

ContactForces ContactOutputs::message(const Contacts& contacts) const {
  ContactForces message;
  message.header = sinks_.header();
  for (const mpm::ContactReport& contact : contacts.bodies) message.bodies.push_back(to_message(contact));
  for (const mpm::PairReport& pair : contacts.pairs) message.pairs.push_back(to_message(pair));
  return message;
}

void ContactOutputs::write() {
  written_at_ = simulation_.time();
  const Contacts contacts = average_.take();
  const std::vector<mpm::BodyState> bodies = simulation_.bodies();
  if (sinks_.wanted(topics::kContactForces)) sinks_.put(topics::kContactForces, message(contacts));
  const auto put = [this](const std::string& topic, const std::string& body, const mpm::Wrench& wrench) {
    geometry_msgs::WrenchStamped stamped;
    stamped.header = sinks_.header(body);
    stamped.wrench = to_message(wrench);
    sinks_.put(topic, stamped);
  };
  for (std::size_t body = 0; body < contacts.bodies.size(); ++body) {
    if (!sinks_.wanted(wrench_topics_[body])) continue;
    put(wrench_topics_[body], bodies[body].name,
        in_body_axes(contacts.bodies[body].mean, bodies[body].pose.orientation));
  }
  for (std::size_t body = 0; body < filters_.size(); ++body) {
    if (sinks_.wanted(filtered_topics_[body])) put(filtered_topics_[body], bodies[body].name, filtered_[body]);
  }
  if (sinks_.wanted(topics::kForceMarkers)) {
    const std_msgs::Header header = sinks_.header();
    visualization_msgs::MarkerArray markers =
        markers_.markers(contacts.bodies, header.frame_id, header.stamp, tops_of(simulation_));
    move_to(frame_, markers);
    sinks_.put(topics::kForceMarkers, markers);
  }
}

void ContactOutputs::serialise(mpm::StateArchive& archive) {
  {
    const mpm::StateArchive::Group group(archive, "contacts");
    contacts_.serialise(archive);
  }
  {
    const mpm::StateArchive::Group group(archive, "average");
    average_.serialise(archive);
  }
  std::uint64_t filters = filters_.size();
  archive.value("filters", filters);
  // Another cutoff than when it was saved is another filter, which begins.
  double cutoff = cutoff_;
  archive.value("wrench_cutoff", cutoff);
  for (std::size_t body = 0; filters == filters_.size() && cutoff == cutoff_ && body < filters; ++body) {
    const mpm::StateArchive::Group group(archive, fmt::format("filter{}", body));
    filters_[body].serialise(archive);
  }
}

}  // namespace mpm_ros
