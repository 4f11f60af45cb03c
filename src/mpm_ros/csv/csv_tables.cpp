#include "mpm_ros/csv/csv_tables.hpp"

#include <algorithm>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {
namespace {

const std::string kNone;  // an empty cell

void close_if_open(std::optional<CsvWriter>& writer) {
  if (writer) writer->close();
}

/// Those of the list that have a column. A ring's force has its components along r and z alone.
template <class Report, class Message>
void add_columns(std::vector<std::string>& columns, const std::string& prefix, const Message& message,
                 const std::vector<Quantity<Report, Message>>& quantities, bool axisymmetric) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (one.column.empty() || (one.axisymmetric && !axisymmetric)) continue;
    if (one.axisymmetric) {
      for (const char* axis : {"r", "z"}) {
        columns.push_back(fmt::format("{}{}{} [{}]", prefix, one.column, axis, one.unit));
      }
    } else if (std::holds_alternative<mpm::Vec3>(one.of_message(message))) {
      add_vector_columns(columns, prefix + one.column, one.unit);
    } else {
      columns.push_back(fmt::format("{}{} [{}]", prefix, one.column, one.unit));
    }
  }
  for (const NamedValue& value : others(message, quantities)) {
    if (value.value.size() == 3) {
      add_vector_columns(columns, prefix + value.name + " ", value.unit);
    } else {
      columns.push_back(fmt::format("{}{} [{}]", prefix, value.name, value.unit));
    }
  }
}

template <class Report, class Message>
void write_numbers(CsvWriter& writer, const Message& message, const std::vector<Quantity<Report, Message>>& quantities,
                   bool axisymmetric) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (one.column.empty() || (one.axisymmetric && !axisymmetric)) continue;
    const Value value = one.of_message(message);
    if (one.axisymmetric) {
      writer << std::get<mpm::Vec3>(value).x() << std::get<mpm::Vec3>(value).z();
    } else {
      std::visit([&writer](const auto& number) { writer << number; }, value);
    }
  }
  for (const NamedValue& value : others(message, quantities)) {
    for (const double number : value.value) writer << number;
  }
}

/// One row with all of `messages`, after the header if it is the first.
template <class Report, class Message>
void add_row(std::optional<CsvWriter>& writer, const std::string& path, double time,
             const std::vector<Message>& messages, const std::vector<Quantity<Report, Message>>& quantities,
             bool axisymmetric) {
  if (!writer) {
    std::vector<std::string> columns = {"time [s]"};
    for (const Message& one : messages) add_columns(columns, one.name + " ", one, quantities, axisymmetric);
    writer.emplace(path, columns);
  }
  *writer << time;
  for (const Message& one : messages) write_numbers(*writer, one, quantities, axisymmetric);
  writer->end_row();
}

}  // namespace

std::string drive_name(mpm::Drive drive) {
  switch (drive) {
    case mpm::Drive::velocity:
      return "velocity";
    case mpm::Drive::pose:
      return "pose";
    default:
      return "functions";
  }
}

void ContactForcesCsv::add(double time, const std::vector<ContactForce>& bodies) {
  add_row(writer_, path_, time, bodies, contact_quantities(), axisymmetric_);
}

void ContactForcesCsv::close() { close_if_open(writer_); }

void ContactPairsCsv::add(double time, const std::vector<ContactPair>& pairs) {
  if (!pairs.empty()) add_row(writer_, path_, time, pairs, pair_quantities(), false);
}

void ContactPairsCsv::close() { close_if_open(writer_); }

void BodiesCsv::add(double time, const std::vector<mpm::BodyState>& bodies) {
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]"};
    for (const mpm::BodyState& body : bodies) {
      const std::string& name = body.name;
      add_vector_columns(columns, name + " ", "m");
      add_vector_columns(columns, name + " q", "1");
      columns.push_back(name + " qw [1]");
      add_vector_columns(columns, name + " v", "m/s");
      add_vector_columns(columns, name + " w", "rad/s");
      columns.push_back(name + " drive");
    }
    writer_.emplace(path_, columns);
  }
  *writer_ << time;
  for (const mpm::BodyState& body : bodies) {
    const mpm::Quat& q = body.pose.orientation;
    *writer_ << body.pose.position << mpm::Vec3(q.vec()) << q.w() << body.twist.linear << body.twist.angular
             << drive_name(body.drive);
  }
  writer_->end_row();
}

void BodiesCsv::close() { close_if_open(writer_); }

void SolverStateCsv::add(double time, const SolverState& state) {
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]"};
    add_columns(columns, "", state, state_quantities(), false);
    for (const Impulse& impulse : state.impulses) {
      impulses_.push_back(impulse.name);
      add_vector_columns(columns, "impulse " + impulse.name + " ", "N s");
    }
    writer_.emplace(path_, columns);
  }
  *writer_ << time;
  write_numbers(*writer_, state, state_quantities(), false);
  for (const std::string& name : impulses_) {
    const auto named = [&name](const Impulse& impulse) { return impulse.name == name; };
    const auto found = std::find_if(state.impulses.begin(), state.impulses.end(), named);
    *writer_ << (found == state.impulses.end() ? mpm::Vec3(mpm::Vec3::Zero()) : from_message(found->impulse));
  }
  writer_->end_row();
}

void SolverStateCsv::close() { close_if_open(writer_); }

void GlobalQuantitiesCsv::add(double time, const std::vector<std::string>& names, const std::vector<std::string>& units,
                              const std::vector<double>& values) {
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]"};
    for (std::size_t i = 0; i < names.size(); ++i) columns.push_back(fmt::format("{} [{}]", names[i], units.at(i)));
    writer_.emplace(path_, columns);
  }
  *writer_ << time;
  for (const double value : values) *writer_ << value;
  writer_->end_row();
}

void GlobalQuantitiesCsv::close() { close_if_open(writer_); }

void CracksCsv::add(double time, const Cracks& message) {
  if (message.cracks.empty()) return;
  if (!tips_) {
    std::vector<std::string> columns = {"time [s]", "crack", "end", "x [m]", "z [m]", "direction x", "direction z"};
    add_columns(columns, "", CrackTip(), tip_quantities(), false);
    columns.insert(columns.end(), {"material", "state", "growth"});
    tips_.emplace(folder_ + "/crack_tips.csv", columns);
    points_.emplace(folder_ + "/crack_points.csv",
                    std::vector<std::string>{"time [s]", "crack", "point", "x [m]", "z [m]", "above x [m]",
                                             "above z [m]", "below x [m]", "below z [m]", "normal traction [Pa]",
                                             "shear traction [Pa]", "debonded"});
  }
  for (const CrackTip& tip : message.tips) {
    *tips_ << time << tip.crack << tip.end << tip.place.x << tip.place.z << tip.direction.x << tip.direction.z;
    write_numbers(*tips_, tip, tip_quantities(), false);
    *tips_ << tip.material << tip.state << tip.growth;
    tips_->end_row();
  }
  for (const Crack& crack : message.cracks) {
    for (std::size_t k = 0; k < crack.points.size(); ++k) {
      *points_ << time << crack.name << static_cast<double>(k) << crack.points[k].x << crack.points[k].z
               << crack.above.at(k).x << crack.above.at(k).z << crack.below.at(k).x << crack.below.at(k).z
               << crack.normal_traction.at(k) << crack.shear_traction.at(k)
               << static_cast<double>(crack.debonded.at(k));
      points_->end_row();
    }
  }
}

void CracksCsv::close() {
  close_if_open(tips_);
  close_if_open(points_);
}

CommandsCsv::CommandsCsv(const std::string& folder)
    : writer_(folder + "/commands.csv",
              {"time [s]",    "body",   "kind",   "vx [m/s]", "vy [m/s]", "vz [m/s]", "wx [rad/s]", "wy [rad/s]",
               "wz [rad/s]",  "x [m]",  "y [m]",  "z [m]",    "qx [1]",   "qy [1]",   "qz [1]",     "qw [1]",
               "arrival [s]", "fx [N]", "fy [N]", "fz [N]",   "tx [N m]", "ty [N m]", "tz [N m]"}) {}

void CommandsCsv::add(const CommandRow& command) {
  writer_ << command.time << command.body << command.kind;
  const auto none = [this](int cells) {
    for (int i = 0; i < cells; ++i) writer_ << kNone;
  };
  if (command.kind == "wrench") {
    none(14);
    writer_ << command.wrench.force << command.wrench.torque;
  } else if (command.kind == "pose") {
    none(6);
    const mpm::Quat& q = command.pose.orientation;
    writer_ << command.pose.position << mpm::Vec3(q.vec()) << q.w() << command.arrival;
    none(6);
  } else {
    writer_ << command.twist.linear << command.twist.angular;
    none(14);
  }
  writer_.end_row();
}

void CommandsCsv::close() { writer_.close(); }

ParticlesCsv::ParticlesCsv(const std::string& folder)
    : folder_(folder), index_(folder + "/particles.csv", {"file", "time [s]", "particles [1]"}) {}

void ParticlesCsv::add(double time, const std::vector<std::uint32_t>& ids, const std::vector<ParticleColumn>& columns) {
  const std::string file = fmt::format("particles_{:04}.csv", count_++);
  std::vector<std::string> header = {"id [1]"};
  for (const ParticleColumn& column : columns) {
    if (column.values.size() != ids.size()) {
      throw CsvError(fmt::format("{}/{}: {} values of {} for {} particles", folder_, file, column.values.size(),
                                 column.name, ids.size()));
    }
    header.push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  CsvWriter writer(folder_ + "/" + file, header);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    writer << static_cast<std::uint64_t>(ids[i]);
    for (const ParticleColumn& column : columns) {
      if (column.fine.empty()) {
        writer << column.values[i];
      } else {
        writer << column.fine[i];
      }
    }
    writer.end_row();
  }
  writer.close();
  index_ << file << time << static_cast<std::uint64_t>(ids.size());
  index_.end_row();
}

void ParticlesCsv::close() { index_.close(); }

}  // namespace mpm_ros
