#include "mpm_ros/csv/csv_tables.hpp"

#include <algorithm>

namespace mpm_ros {
namespace {

const std::string kNone;  // an empty cell

void close_if_open(std::optional<CsvWriter>& writer) {
  if (writer) writer->close();
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

void ContactForcesCsv::add(double time, const std::vector<mpm::ContactReport>& bodies) {
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]"};
    for (const mpm::ContactReport& body : bodies) {
      const std::string& name = body.body;
      add_vector_columns(columns, name + " f", "N");
      add_vector_columns(columns, name + " t", "N m");
      add_vector_columns(columns, name + " peak f", "N");
      add_vector_columns(columns, name + " peak t", "N m");
      add_vector_columns(columns, name + " impulse ", "N s");
      columns.push_back(name + " interval [s]");
      columns.push_back(name + " nodes [1]");
      columns.push_back(name + " pressing [N]");
      add_vector_columns(columns, name + " friction ", "N");
      add_vector_columns(columns, name + " cop ", "m");
      columns.push_back(name + " contact area [m^2]");
      columns.push_back(name + " friction energy [J]");
      if (!axisymmetric_) continue;
      columns.push_back(name + " per radian r [N/rad]");
      columns.push_back(name + " per radian z [N/rad]");
    }
    writer_.emplace(path_, columns);
  }
  *writer_ << time;
  for (const mpm::ContactReport& body : bodies) {
    *writer_ << body.mean.force << body.mean.torque << body.peak.force << body.peak.torque << body.impulse
             << body.interval << static_cast<std::uint64_t>(std::max(body.nodes, 0)) << body.pressing << body.friction
             << body.centre_of_pressure() << body.area << body.friction_energy;
    if (axisymmetric_) *writer_ << body.per_radian.x() << body.per_radian.z();
  }
  writer_->end_row();
}

void ContactForcesCsv::close() { close_if_open(writer_); }

void ContactPairsCsv::add(double time, const std::vector<mpm::PairReport>& pairs) {
  if (pairs.empty()) return;
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]"};
    for (const mpm::PairReport& pair : pairs) {
      const std::string& name = pair.name;
      add_vector_columns(columns, name + " f", "N");
      add_vector_columns(columns, name + " friction ", "N");
      add_vector_columns(columns, name + " impulse ", "N s");
      columns.push_back(name + " interval [s]");
      columns.push_back(name + " nodes [1]");
      columns.push_back(name + " pressing [N]");
      add_vector_columns(columns, name + " cop ", "m");
      columns.push_back(name + " contact area [m^2]");
      columns.push_back(name + " friction energy [J]");
      columns.push_back(name + " interface energy [J]");
    }
    writer_.emplace(path_, columns);
  }
  *writer_ << time;
  for (const mpm::PairReport& pair : pairs) {
    *writer_ << pair.force << pair.friction << pair.impulse << pair.interval
             << static_cast<std::uint64_t>(std::max(pair.nodes, 0)) << pair.pressing << pair.centre << pair.area
             << pair.friction_energy << pair.interface_energy;
  }
  writer_->end_row();
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

void SolverStateCsv::add(const mpm::SolverState& state, double real_time_factor) {
  if (!writer_) {
    std::vector<std::string> columns = {"time [s]",   "steps [1]",     "dt [s]",      "dt min [s]",
                                        "dt max [s]", "particles [1]", "returned [1]"};
    for (const char* kind : {"kinetic", "elastic", "plastic", "potential", "friction", "pair friction", "interface"}) {
      columns.push_back(std::string("energy ") + kind + " [J]");
    }
    columns.emplace_back("contact work [J]");
    columns.emplace_back("load work [J]");
    add_vector_columns(columns, "momentum ", "N s");
    for (const mpm::NamedImpulse& impulse : state.audit.impulses) {
      impulses_.push_back(impulse.name);
      add_vector_columns(columns, "impulse " + impulse.name + " ", "N s");
    }
    for (const char* last : {"momentum exchanged [N s]", "momentum error [1]", "min j [1]", "real-time factor [1]"}) {
      columns.emplace_back(last);
    }
    writer_.emplace(path_, columns);
  }
  const mpm::StepReport& step = state.step;
  const mpm::EnergyReport& energy = state.energy;
  *writer_ << static_cast<double>(state.time) / 1e9 << step.steps << step.dt_last << step.dt_min << step.dt_max
           << state.particles << state.number("returned") << energy.of("kinetic") << energy.of("elastic")
           << energy.of("plastic") << energy.of("potential") << energy.of("friction") << energy.of("pair_friction")
           << energy.of("interface") << energy.of("contact_work") << energy.of("load_work") << state.audit.momentum;
  const std::vector<mpm::NamedImpulse>& impulses = state.audit.impulses;
  for (const std::string& name : impulses_) {
    const auto named = [&name](const mpm::NamedImpulse& impulse) { return impulse.name == name; };
    const auto found = std::find_if(impulses.begin(), impulses.end(), named);
    *writer_ << (found == impulses.end() ? mpm::Vec3(mpm::Vec3::Zero()) : found->impulse);
  }
  *writer_ << state.audit.exchanged << state.audit.residual << state.min_j << real_time_factor;
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
    for (const ParticleColumn& column : columns) writer << column.values[i];
    writer.end_row();
  }
  writer.close();
  index_ << file << time << static_cast<std::uint64_t>(ids.size());
  index_.end_row();
}

void ParticlesCsv::close() { index_.close(); }

}  // namespace mpm_ros
