// Lists of plain numbers, or of structures of them, as bytes that ranks send to each other.
#pragma once

#include <cstring>
#include <type_traits>
#include <vector>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

template <class T>
Communicator::Bytes bytes_of(const std::vector<T>& list) {
  static_assert(std::is_trivially_copyable_v<T>);
  Communicator::Bytes bytes(list.size() * sizeof(T));
  if (!list.empty()) std::memcpy(bytes.data(), list.data(), bytes.size());
  return bytes;
}

template <class T>
std::vector<T> list_of(const Communicator::Bytes& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> list(bytes.size() / sizeof(T));
  if (!list.empty()) std::memcpy(list.data(), bytes.data(), list.size() * sizeof(T));
  return list;
}

/// The lists of all ranks, one after another in the order of ranks. Collective.
template <class T>
std::vector<T> gather_list(Communicator& ranks, const std::vector<T>& own) {
  std::vector<T> all;
  for (const Communicator::Bytes& bytes : ranks.gather(bytes_of(own))) {
    const std::vector<T> part = list_of<T>(bytes);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// Sends what each rank has for each other one, by rank; what is for itself stays. Returns what has come, by rank.
/// Collective.
template <class T>
std::vector<std::vector<T>> exchange(Communicator& ranks, std::vector<std::vector<T>> by_rank) {
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (rank == ranks.rank() || by_rank[rank].empty()) continue;
    parcels.push_back({rank, bytes_of(by_rank[rank])});
    by_rank[rank] = {};
  }
  for (const Communicator::Parcel& parcel : ranks.deliver(parcels)) by_rank[parcel.rank] = list_of<T>(parcel.bytes);
  return by_rank;
}

}  // namespace mpm
