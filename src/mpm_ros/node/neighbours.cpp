#include "mpm_ros/node/neighbours.hpp"

#include <fmt/format.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcException.h>

namespace mpm_ros {

namespace {

/// A call of the master without roscpp. False where it does not answer, or refuses.
bool call_master(const char* method, const XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcClient client(ros::master::getHost().c_str(), static_cast<int>(ros::master::getPort()), "/");
  XmlRpc::XmlRpcValue response;
  const bool answered = client.execute(method, request, response) && !client.isFault();
  client.close();
  if (!answered || response.getType() != XmlRpc::XmlRpcValue::TypeArray || response.size() != 3) return false;
  answer = response[2];
  return static_cast<int>(response[0]) == 1;
}

}  // namespace

Neighbours Neighbours::ask() {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  ros::master::execute("getSystemState", request, response, state, false);
  return Neighbours(state);
}

std::vector<std::string> Neighbours::nodes(int kind, const std::string& name) const {
  std::vector<std::string> found;
  try {
    XmlRpc::XmlRpcValue state(state_);
    if (state.getType() != XmlRpc::XmlRpcValue::TypeArray || state.size() <= kind) return found;
    XmlRpc::XmlRpcValue& entries = state[kind];
    for (int i = 0; i < entries.size(); ++i) {
      if (static_cast<std::string>(entries[i][0]) != name) continue;
      XmlRpc::XmlRpcValue& nodes = entries[i][1];
      for (int n = 0; n < nodes.size(); ++n) found.push_back(nodes[n]);
    }
  } catch (const XmlRpc::XmlRpcException&) {
    found.clear();
  }
  return found;
}

std::string taken_service(const Neighbours& neighbours, const std::string& self,
                          const std::vector<std::string>& services,
                          const std::function<bool(const std::string&)>& alive) {
  for (const std::string& service : services) {
    for (const std::string& node : neighbours.providers(service)) {
      if (node == self || !alive(service)) continue;
      return fmt::format(
          "the node {} offers the service {} already, which this one would take from it; start this one in a namespace "
          "of its own, such as __ns:=mpm_2",
          node, service);
    }
  }
  return {};
}

std::string second_clock(const Neighbours& neighbours, const std::string& self, const std::string& clock) {
  for (const std::string& node : neighbours.publishers(clock)) {
    if (node == self) continue;
    return fmt::format(
        "the node {} publishes {} too, and time would jump between its clock and this one's: start one of them with "
        "_publish_clock:=false, or each under a master of its own",
        node, clock);
  }
  return {};
}

void forget_node(const std::string& name) {
  XmlRpc::XmlRpcValue request, state, ignored;
  request[0] = ros::this_node::getName();
  if (!call_master("getSystemState", request, state)) return;
  XmlRpc::XmlRpcValue lookup, uri;
  lookup[0] = ros::this_node::getName();
  lookup[1] = name;
  const bool known = call_master("lookupNode", lookup, uri);
  const char* const methods[] = {"unregisterPublisher", "unregisterSubscriber", "unregisterService"};
  for (int kind = 0; known && kind < 3; ++kind) {
    for (int i = 0; i < state[kind].size(); ++i) {
      XmlRpc::XmlRpcValue& nodes = state[kind][i][1];
      for (int n = 0; n < nodes.size(); ++n) {
        if (static_cast<std::string>(nodes[n]) != name) continue;
        XmlRpc::XmlRpcValue entry, service;
        entry[0] = name;
        entry[1] = state[kind][i][0];
        entry[2] = uri;
        if (kind == 2) {  // by its own address
          XmlRpc::XmlRpcValue which;
          which[0] = name;
          which[1] = state[kind][i][0];
          if (!call_master("lookupService", which, service)) continue;
          entry[2] = service;
        }
        call_master(methods[kind], entry, ignored);
      }
    }
  }
  XmlRpc::XmlRpcValue parameters;
  parameters[0] = ros::this_node::getName();
  parameters[1] = name;
  call_master("deleteParam", parameters, ignored);
}

}  // namespace mpm_ros
