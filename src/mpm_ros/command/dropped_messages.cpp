#include "mpm_ros/command/dropped_messages.hpp"

#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>

namespace mpm_ros {

void DroppedMessages::look() {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port)) return;
  // On this machine: the name that others know it by need not lead here.
  XmlRpc::XmlRpcClient client("127.0.0.1", static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  const bool answered = client.execute("getBusStats", request, response) && !client.isFault();
  client.close();
  // Status, a text, the answer.
  if (answered && response.getType() == XmlRpc::XmlRpcValue::TypeArray && response.size() == 3) read(response[2]);
}

void DroppedMessages::read(const XmlRpc::XmlRpcValue& statistics) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    XmlRpc::XmlRpcValue subscriptions = XmlRpc::XmlRpcValue(statistics)[1];
    for (int i = 0; i < subscriptions.size(); ++i) {
      if (!counts_(subscriptions[i][0])) continue;
      XmlRpc::XmlRpcValue& connections = subscriptions[i][1];
      for (int c = 0; c < connections.size(); ++c) {
        // Number, bytes, messages, dropped ones.
        std::uint64_t& dropped = dropped_[static_cast<int>(connections[c][0])];
        dropped = std::max(dropped, static_cast<std::uint64_t>(static_cast<int>(connections[c][3])));
      }
    }
  } catch (const XmlRpc::XmlRpcException&) {
    // Another roscpp that tells otherwise: what is not told is not counted.
  }
}

std::uint64_t DroppedMessages::count() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& [connection, dropped] : dropped_) sum += dropped;
  return sum;
}

}  // namespace mpm_ros
