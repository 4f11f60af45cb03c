#include "mpm_ros/node/node_parameters.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <utility>

#include "mpm/kernel/isa.hpp"

namespace mpm_ros {

namespace {

void emit(YAML::Emitter& out, XmlRpc::XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      out << static_cast<bool>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      out << static_cast<int>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      out << static_cast<double>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeArray:
      out << YAML::Flow << YAML::BeginSeq;
      for (int i = 0; i < value.size(); ++i) emit(out, value[i]);
      out << YAML::EndSeq;
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      out << YAML::DoubleQuoted << static_cast<std::string>(value);
      break;
    default:
      out << YAML::DoubleQuoted << value.toXml();
  }
}

std::string to_yaml(const ParameterValues& values) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  for (const auto& [name, value] : values) {
    out << YAML::Key << name << YAML::Value;
    emit(out, value);
  }
  out << YAML::EndMap;
  return out.c_str();
}

void check_isa(const std::string& isa) {
  try {
    mpm::choose_isa(isa);
  } catch (const mpm::IsaError& error) {
    throw ParameterError(fmt::format("parameter ~isa: {}", error.what()));
  }
}

/// diagnostic_updater reads it by itself, and takes no text for a number.
void check_diagnostic_period(ParameterReader& reader) {
  const XmlRpc::XmlRpcValue* value = reader.find("diagnostic_period");
  if (value == nullptr) return;
  double period = 1.0;
  reader.read("diagnostic_period", period, 0.0);
  if (value->getType() == XmlRpc::XmlRpcValue::TypeString)
    ParameterReader::fail("diagnostic_period", "is text to ROS; write it with a point, such as 1.0");
}

}  // namespace

ParameterValues fetch_parameters(const ros::NodeHandle& private_node) {
  ParameterValues values;
  XmlRpc::XmlRpcValue all;
  if (!private_node.getParam(private_node.getNamespace(), all)) return values;
  if (all.getType() != XmlRpc::XmlRpcValue::TypeStruct) return values;
  for (auto& [name, value] : all) values.emplace(name, value);
  return values;
}

NodeParameters read_parameters(const ParameterValues& values, std::vector<std::string>& warnings) {
  NodeParameters parameters;
  ParameterReader reader(values);
  reader.read("scene", parameters.scene);
  reader.read_overrides("set", parameters.set);
  reader.read<Pacing>("pacing", parameters.pacing,
                      {{"real_time", Pacing::real_time}, {"free", Pacing::free}, {"lockstep", Pacing::lockstep}});
  reader.read("real_time_factor", parameters.real_time_factor, 0.0, true);
  reader.read("threads", parameters.threads, 0);
  reader.read("isa", parameters.isa);
  check_isa(parameters.isa);
  reader.read("device", parameters.device.word);
  reader.read("record", parameters.record);
  reader.read<std::string>("record_compression", parameters.record_compression,
                           {{"none", "none"}, {"lz4", "lz4"}, {"bz2", "bz2"}});
  reader.read("record_folder", parameters.record_folder);
  reader.read("record_split_size", parameters.record_split_size, 0.0);
  reader.read("record_split_duration", parameters.record_split_duration, 0.0);
  reader.read("record_required", parameters.record_required);
  reader.read("resume", parameters.resume);
  reader.read("checkpoint_on_failure", parameters.checkpoint_on_failure);
  reader.read("commands", parameters.commands);
  reader.read("command_timeout", parameters.command_timeout, 0.0);
  reader.read<OnTimeout>("on_timeout", parameters.on_timeout,
                         {{"hold", OnTimeout::hold}, {"stop", OnTimeout::stop}, {"error", OnTimeout::error}});
  const std::vector<std::pair<std::string, StampUse>> uses{{"stamp", StampUse::stamp}, {"latest", StampUse::latest}};
  reader.read<StampUse>("tf_time", parameters.tf_time, uses);
  reader.read<StampUse>("command_time", parameters.command_time, uses);
  reader.read("world_frame", parameters.world_frame);
  reader.read("publish_clock", parameters.publish_clock);
  reader.read("clock_rate", parameters.clock_rate, 0.0);
  reader.read<ResetTime>("reset_time", parameters.reset_time,
                         {{"continue", ResetTime::resume}, {"zero", ResetTime::zero}});
  double particle_rate = 0.0;
  reader.read("particle_rate", particle_rate, 0.0, true);
  if (reader.given("particle_rate")) parameters.particle_rate = particle_rate;
  double particle_first = 0.0;
  reader.read("particle_first", particle_first, 0.0);
  if (reader.given("particle_first")) parameters.particle_first = particle_first;
  std::vector<std::string> fields;
  if (reader.read_words("particle_fields", fields)) parameters.particle_fields = fields;
  int stride = 1;
  reader.read("particle_stride", stride, 1);
  if (reader.given("particle_stride")) parameters.particle_stride = stride;
  reader.read("particle_region", parameters.particle_region);
  reader.read("wrench_rate", parameters.wrench_rate, 0.0);
  reader.read("wrench_cutoff", parameters.wrench_cutoff, 0.0);
  reader.read("force_scale", parameters.force_scale, 0.0);
  reader.read("state_hash", parameters.state_hash);
  parameters.keep_alive = parameters.pacing == Pacing::lockstep;
  reader.read("keep_alive", parameters.keep_alive);
  reader.read("start_paused", parameters.start_paused);

  if (parameters.scene.empty()) {
    throw ParameterError("parameter ~scene is not given; pass a shipped scene's name or a path, _scene:=blade_in_soil");
  }
  // tf2 knows no names that begin with a slash; those of tf, its predecessor, did.
  if (parameters.world_frame[0] == '/') parameters.world_frame.erase(0, 1);
  if (parameters.world_frame.empty()) throw ParameterError("parameter ~world_frame is empty; it must name a frame");
  check_diagnostic_period(reader);
  for (const std::string& line : reader.unknown()) warnings.push_back(line);
  parameters.text = to_yaml(values);
  return parameters;
}

void look_for_device(NodeParameters& parameters, const std::function<mpm::FoundDevice()>& find, int ranks) {
  parameters.device.find = find;
  try {
    mpm::check_device(parameters.device, ranks);
  } catch (const mpm::DeviceError& error) {
    throw ParameterError(fmt::format("parameter ~device: {}: {}", parameters.device.word, error.what()));
  }
}

}  // namespace mpm_ros
