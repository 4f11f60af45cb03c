// Other nodes under the same master: those that do what this one is about to do, and one that has left without a word.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <functional>
#include <string>
#include <vector>

namespace mpm_ros {

/// Nodes that publish and offer topics and services, as the master's getSystemState tells it.
class Neighbours {
 public:
  /// `state`: publishers, subscribers and services, each a list of [name, [nodes]]. What is not of that form is
  /// nothing.
  explicit Neighbours(const XmlRpc::XmlRpcValue& state) : state_(state) {}
  /// As the master says now; none where it does not answer.
  static Neighbours ask();

  std::vector<std::string> publishers(const std::string& topic) const { return nodes(0, topic); }
  std::vector<std::string> providers(const std::string& service) const { return nodes(2, service); }

 private:
  std::vector<std::string> nodes(int kind, const std::string& name) const;

  XmlRpc::XmlRpcValue state_;
};

/// Reason why a node of that name should not start: another one, which is `alive` (asked of a service), offers one of
/// its services. Empty where none does.
std::string taken_service(const Neighbours& neighbours, const std::string& self,
                          const std::vector<std::string>& services,
                          const std::function<bool(const std::string&)>& alive);
/// A warning, where another node publishes the clock that this one is about to publish; else empty.
std::string second_clock(const Neighbours& neighbours, const std::string& self, const std::string& clock);

/// Takes a node that has ended off the master: its topics, services and parameters. For a child of a node that ends
/// itself; roscpp's own calls need not work any more.
void forget_node(const std::string& name);

}  // namespace mpm_ros
