// Sources of private parameters, so that none of an earlier run holds in silence. `_pacing:=lockstep` on a command
// line is written to the parameter server by roscpp, where it would stay for every later node of the same name: the
// names are noted before, and deleted as soon as the node has read them, which also holds for a node that is killed
// afterwards.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/node/node_parameters.hpp"

namespace mpm_ros {

class ParameterSources {
 public:
  /// The command line as main() gets it, before ros::init() takes its part away.
  ParameterSources(int argc, const char* const* argv);

  /// Source of each of `values`, in one line. `node`: name of the node, "/simulator". Empty when there are none.
  std::string text(const ParameterValues& values, const std::string& node) const;

  /// True if some of `values` may be left from an earlier run: they were neither on the command line nor set by who
  /// started this node under a name, as roslaunch does.
  bool doubtful(const ParameterValues& values) const;

  /// Deletes from the parameter server what the command line wrote there. Does not wait for a master that is gone.
  void forget() const;

 private:
  bool on_command_line(const std::string& name) const;

  std::vector<std::string> names_;  ///< "pacing" of "_pacing:=lockstep"
  bool launched_ = false;           ///< has an argument __name:=
};

/// Forgets at the end of a scope, whatever ended it: while the parameters are read.
class ForgetParameters {
 public:
  explicit ForgetParameters(const ParameterSources& sources) : sources_(sources) {}
  ~ForgetParameters() { sources_.forget(); }
  ForgetParameters(const ForgetParameters&) = delete;
  ForgetParameters& operator=(const ForgetParameters&) = delete;

 private:
  const ParameterSources& sources_;
};

}  // namespace mpm_ros
