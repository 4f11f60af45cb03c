// Reads the private parameters of a program by name, each checked for its type and range, and knows afterwards which
// names nobody asked for. Text that says a number, a list or a truth counts as what it says (parameter_text.hpp).
#pragma once

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm_ros/node/parameter_text.hpp"

namespace mpm_ros {

/// A parameter that is missing, of the wrong type or out of range. what() is one line that names it.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using ParameterValues = std::map<std::string, XmlRpc::XmlRpcValue>;

/// A result keeps its value where the parameter is not given. All throw ParameterError.
class ParameterReader {
 public:
  explicit ParameterReader(const ParameterValues& values) : values_(values) {}

  void read(const std::string& name, std::string& result);
  void read(const std::string& name, bool& result);
  /// Finite, and in [min, infinity), or above min where `open`.
  void read(const std::string& name, double& result, double min, bool open = false);
  void read(const std::string& name, int& result, int min);
  /// A list of words, or one text of them. False when it is not given.
  bool read_words(const std::string& name, std::vector<std::string>& result);
  /// A list of changes to a scene, or one text of them.
  void read_overrides(const std::string& name, std::vector<std::string>& result);
  /// [xmin, ymin, zmin, xmax, ymax, zmax]
  void read(const std::string& name, std::optional<mpm::Box>& result);
  template <typename Choice>
  void read(const std::string& name, Choice& result, const std::vector<std::pair<std::string, Choice>>& choices);

  bool given(const std::string& name) const { return values_.count(name) > 0; }
  /// The parameter, to be read by the caller; null when it is not given.
  const XmlRpc::XmlRpcValue* find(const std::string& name);
  /// A line for each parameter that nobody asked for.
  std::vector<std::string> unknown() const;
  [[noreturn]] static void fail(const std::string& name, const std::string& problem);

 private:
  static std::string text(const std::string& name, const XmlRpc::XmlRpcValue& value);
  static std::string one_of(const std::string& given, const std::vector<std::string>& names);

  const ParameterValues& values_;
  std::vector<std::string> known_;
};

template <typename Choice>
void ParameterReader::read(const std::string& name, Choice& result,
                           const std::vector<std::pair<std::string, Choice>>& choices) {
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
  fail(name, one_of(given, names));
}

}  // namespace mpm_ros
