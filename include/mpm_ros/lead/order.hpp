// Orders by which the first of several ranks leads the others, where it alone hears what is to be done: it reads
// topics, services, bags and the wall's clock. Between two orders the others wait, and take no processor meanwhile. All
// ranks then do the same, each with its part of the material.
//
//   first rank:   tell(ranks, {{"do", "advance"}, …}); run.advance();
//   the others:   for (;;) obey(hear(ranks));
//
// An order is a JSON object whose "do" says what is to be done. It travels as CBOR, which keeps every bit of a number.
#pragma once

#include <ros/serialization.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "mpm/ranks/communicator.hpp"

namespace mpm_ros {

using Order = nlohmann::json;

/// On the first rank, while the others hear().
void tell(mpm::Communicator& ranks, const Order& order);
/// On the others.
Order hear(mpm::Communicator& ranks);

/// A message, or a list of messages, as a value in an order.
template <class Message>
Order packed(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return Order::binary(std::move(bytes));
}
template <class Message>
Message unpacked(const Order& value) {
  std::vector<std::uint8_t> bytes = value.get_binary();
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  Message message;
  ros::serialization::deserialize(stream, message);
  return message;
}

}  // namespace mpm_ros
