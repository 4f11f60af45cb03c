#include "mpm_ros/lead/order.hpp"

#include "mpm/ranks/lists.hpp"

namespace mpm_ros {

void tell(mpm::Communicator& ranks, const Order& order) { ranks.of_first(mpm::bytes_of(Order::to_cbor(order))); }

Order hear(mpm::Communicator& ranks) { return Order::from_cbor(mpm::list_of<std::uint8_t>(ranks.of_first({}))); }

}  // namespace mpm_ros
