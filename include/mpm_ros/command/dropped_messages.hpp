// Messages that came to this process and that no callback got, because more of them waited than the queue of their
// subscription holds. roscpp counts them and tells nobody but who asks by its XML-RPC interface (getBusStats).
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace mpm_ros {

class DroppedMessages {
 public:
  /// `counts`: whether the messages of a topic count.
  explicit DroppedMessages(std::function<bool(const std::string& topic)> counts) : counts_(std::move(counts)) {}

  /// Asks roscpp. Any thread but those of its XML-RPC server.
  void look();
  /// Reads the answer of getBusStats: statistics of publications, of subscriptions, of services.
  void read(const XmlRpc::XmlRpcValue& statistics);
  /// So far, of connections that have ended too.
  std::uint64_t count() const;

 private:
  const std::function<bool(const std::string&)> counts_;
  mutable std::mutex mutex_;
  std::map<int, std::uint64_t> dropped_;  // by connection, whose number no other one gets
};

}  // namespace mpm_ros
