#include "mpm_ros/node/node_parameters.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <utility>

#include "mpm/kernel/isa.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/math/nearest.hpp"

namespace mpm_ros {

namespace {

/// Reads values by name and remembers which names it was asked for.
class Reader {
 public:
  explicit Reader(const ParameterValues& values) : values_(values) {}

  void read(const std::string& name, std::string& result) {
    if (const XmlRpc::XmlRpcValue* value = find(name)) result = text(name, *value);
  }

  void read(const std::string& name, bool& result) {
    const XmlRpc::XmlRpcValue* value = find(name);
    if (value == nullptr) return;
    if (value->getType() != XmlRpc::XmlRpcValue::TypeBoolean) fail(name, "must be true or false");
    result = static_cast<bool>(XmlRpc::XmlRpcValue(*value));
  }

  /// Finite, and in [min, infinity), or above min where `open`.
  void read(const std::string& name, double& result, double min, bool open = false) {
    const XmlRpc::XmlRpcValue* value = find(name);
    if (value == nullptr) return;
    XmlRpc::XmlRpcValue copy(*value);
    if (value->getType() == XmlRpc::XmlRpcValue::TypeInt) {
      result = static_cast<int>(copy);
    } else if (value->getType() == XmlRpc::XmlRpcValue::TypeDouble) {
      result = static_cast<double>(copy);
    } else {
      fail(name, "must be a number");
    }
    const bool inside = open ? result > min : result >= min;
    if (!inside || !(result < mpm::kInfinity)) {
      fail(name, fmt::format("is {}; it must be finite and {} {}", result, open ? "above" : "at least", min));
    }
  }

  void read(const std::string& name, int& result, int min) {
    const XmlRpc::XmlRpcValue* value = find(name);
    if (value == nullptr) return;
    if (value->getType() != XmlRpc::XmlRpcValue::TypeInt) fail(name, "must be a whole number");
    result = static_cast<int>(XmlRpc::XmlRpcValue(*value));
    if (result < min) fail(name, fmt::format("is {}; it must be at least {}", result, min));
  }

  /// A list of texts, or one text with commas or spaces between.
  bool read(const std::string& name, std::vector<std::string>& result) {
    const XmlRpc::XmlRpcValue* value = find(name);
    if (value == nullptr) return false;
    result.clear();
    if (value->getType() == XmlRpc::XmlRpcValue::TypeArray) {
      XmlRpc::XmlRpcValue list(*value);
      for (int i = 0; i < list.size(); ++i) result.push_back(text(name, list[i]));
    } else {
      std::string item;
      for (const char c : text(name, *value) + ",") {
        if (c != ',' && c != ' ' && c != '[' && c != ']') {
          item.push_back(c);
        } else if (!item.empty()) {
          result.push_back(std::exchange(item, {}));
        }
      }
    }
    return true;
  }

  /// [xmin, ymin, zmin, xmax, ymax, zmax]
  void read(const std::string& name, std::optional<mpm::Box>& result) {
    const XmlRpc::XmlRpcValue* value = find(name);
    if (value == nullptr) return;
    XmlRpc::XmlRpcValue list(*value);
    if (list.getType() != XmlRpc::XmlRpcValue::TypeArray || list.size() != 6) {
      fail(name, "must be six numbers, [xmin, ymin, zmin, xmax, ymax, zmax]");
    }
    double corners[6];
    for (int i = 0; i < 6; ++i) {
      const auto type = list[i].getType();
      if (type == XmlRpc::XmlRpcValue::TypeInt) {
        corners[i] = static_cast<int>(list[i]);
      } else if (type == XmlRpc::XmlRpcValue::TypeDouble) {
        corners[i] = static_cast<double>(list[i]);
      } else {
        fail(name, fmt::format("has something else than a number at place {}", i + 1));
      }
    }
    result = mpm::Box{{corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]}};
    if (result->empty() || !result->min.allFinite() || !result->max.allFinite()) {
      fail(name, "is empty or not finite; write [xmin, ymin, zmin, xmax, ymax, zmax]");
    }
  }

  template <typename Choice>
  void read(const std::string& name, Choice& result, const std::vector<std::pair<std::string, Choice>>& choices) {
    std::string given;
    read(name, given);
    if (given.empty()) return;
    std::vector<std::string> names;
    for (const auto& [choice, value] : choices) {
      if (choice == given) {
        result = value;
        return;
      }
      names.push_back(choice);
    }
    fail(name, fmt::format("is '{}'; it must be one of {}", given, fmt::join(names, ", ")));
  }

  bool given(const std::string& name) const { return values_.count(name) > 0; }
  const std::vector<std::string>& known() const { return known_; }

 private:
  [[noreturn]] static void fail(const std::string& name, const std::string& problem) {
    throw ParameterError(fmt::format("parameter ~{} {}", name, problem));
  }

  const XmlRpc::XmlRpcValue* find(const std::string& name) {
    known_.push_back(name);
    const auto entry = values_.find(name);
    return entry == values_.end() ? nullptr : &entry->second;
  }

  static std::string text(const std::string& name, const XmlRpc::XmlRpcValue& value) {
    if (value.getType() != XmlRpc::XmlRpcValue::TypeString) fail(name, "must be text; put it in quotes");
    return static_cast<std::string>(XmlRpc::XmlRpcValue(value));
  }

  const ParameterValues& values_;
  std::vector<std::string> known_;
};

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
  Reader reader(values);
  reader.read("scene", parameters.scene);
  reader.read("set", parameters.set);
  reader.read<Pacing>("pacing", parameters.pacing,
                      {{"real_time", Pacing::real_time}, {"free", Pacing::free}, {"lockstep", Pacing::lockstep}});
  reader.read("real_time_factor", parameters.real_time_factor, 0.0, true);
  reader.read("threads", parameters.threads, 0);
  reader.read("isa", parameters.isa);
  check_isa(parameters.isa);
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
  if (reader.read("particle_fields", fields)) parameters.particle_fields = fields;
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
  for (const auto& [name, value] : values) {
    // diagnostic_updater reads its period itself.
    if (name == "diagnostic_period") continue;
    const std::vector<std::string>& known = reader.known();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    warnings.push_back(
        fmt::format("parameter ~{} is not known and has no effect; {}", name, mpm::suggest(name, known)));
  }
  parameters.text = to_yaml(values);
  return parameters;
}

}  // namespace mpm_ros
