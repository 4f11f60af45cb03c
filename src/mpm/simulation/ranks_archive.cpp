#include "ranks_archive.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

constexpr const char* kRanks = "ranks_written";
constexpr const char* kParts = "parts/";

/// Of one number [bytes].
std::size_t size_of(StateArchive::Number number) {
  switch (number) {
    case StateArchive::Number::uint8:
      return 1;
    case StateArchive::Number::float32:
    case StateArchive::Number::int32:
    case StateArchive::Number::uint32:
      return 4;
    case StateArchive::Number::float64:
    case StateArchive::Number::int64:
    case StateArchive::Number::uint64:
      return 8;
  }
  return 0;
}

/// visit(a pointer to that type) for the type of numbers.
template <class Visit>
void with_type(StateArchive::Number number, Visit&& visit) {
  switch (number) {
    case StateArchive::Number::float32:
      return visit(static_cast<float*>(nullptr));
    case StateArchive::Number::float64:
      return visit(static_cast<double*>(nullptr));
    case StateArchive::Number::int32:
      return visit(static_cast<std::int32_t*>(nullptr));
    case StateArchive::Number::int64:
      return visit(static_cast<std::int64_t*>(nullptr));
    case StateArchive::Number::uint8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case StateArchive::Number::uint32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case StateArchive::Number::uint64:
      return visit(static_cast<std::uint64_t*>(nullptr));
  }
}

}  // namespace

RanksWriter::RanksWriter(Communicator& ranks, const std::string& path) : ranks_(ranks) {
  std::uint64_t size = ranks.size();
  attempt([&] {
    file_ = std::make_unique<Hdf5Writer>(path);
    file_->value(kRanks, size);
  });
}

template <class Do>
void RanksWriter::attempt(Do&& act) {
  if (!ranks_.first() || !failure_.empty()) return;
  try {
    act();
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

void RanksWriter::values(const std::string& name, Number number, void* data, std::size_t count) {
  if (merge() == Merge::same) {
    attempt([&] { file_->array(name, number, data, count); });
    return;
  }
  std::vector<std::uint64_t> parts = gather_list(ranks_, std::vector<std::uint64_t>{count});
  const std::uint64_t all = std::accumulate(parts.begin(), parts.end(), std::uint64_t{0});
  const std::uint64_t before = std::accumulate(parts.begin(), parts.begin() + ranks_.rank(), std::uint64_t{0});
  const std::size_t size = size_of(number);
  attempt([&] {
    file_->begin(name, number, all);
    file_->array(kParts + name, Number::uint64, parts.data(), parts.size());
  });
  // Piece by piece, each from all ranks that have some of it.
  for (std::uint64_t first = 0; first < all; first += kHdf5Chunk) {
    const std::uint64_t last = std::min<std::uint64_t>(all, first + kHdf5Chunk);
    const std::uint64_t from = std::clamp(first, before, before + count), to = std::clamp(last, before, before + count);
    const auto* own = static_cast<const std::byte*>(data) + (from - before) * size;
    std::vector<Communicator::Parcel> parcels;
    if (!ranks_.first() && from < to) parcels.push_back({0, Communicator::Bytes(own, own + (to - from) * size)});
    const std::vector<Communicator::Parcel> arrived = ranks_.deliver(parcels);
    if (!ranks_.first()) continue;
    piece_.assign(own, own + (to - from) * size);
    for (const Communicator::Parcel& parcel : arrived) {  // in the order of ranks
      piece_.insert(piece_.end(), parcel.bytes.begin(), parcel.bytes.end());
    }
    attempt([&] { file_->piece(name, number, piece_.data(), first, last - first); });
  }
}

void RanksWriter::close() {
  attempt([&] { file_->close(); });
  const std::vector<char> own(failure_.begin(), failure_.end());
  const std::vector<char> reason = gather_list(ranks_, own);
  if (!reason.empty()) throw CheckpointError(std::string(reason.begin(), reason.end()));
}

RanksReader::RanksReader(const Communicator* ranks, const std::string& path)
    : file_(path), rank_(ranks == nullptr ? 0 : ranks->rank()), here_(ranks == nullptr ? 1 : ranks->size()), there_(1) {
  if (!file_.has(kRanks)) return;
  std::uint64_t size = 1;
  file_.value(kRanks, size);
  if (size < 1 || size > 1'000'000) {
    throw CheckpointError(
        fmt::format("checkpoint {}: the file is damaged: it says that {} ranks wrote it", path, size));
  }
  there_ = static_cast<int>(size);
}

std::vector<std::uint64_t> RanksReader::parts_of(const std::string& name) {
  const std::string of_parts = kParts + name;
  std::vector<std::uint64_t> parts(there_, 0);
  if (there_ == 1) {
    parts[0] = file_.count(name);
  } else {
    file_.array(of_parts, Number::uint64, parts.data(), parts.size());
  }
  return parts;
}

std::pair<std::uint64_t, std::uint64_t> RanksReader::share_of(const std::vector<std::uint64_t>& parts) const {
  const std::uint64_t all = std::accumulate(parts.begin(), parts.end(), std::uint64_t{0});
  const std::uint64_t row = share_row(), rows = all / row;
  const std::uint64_t begin = rows * rank_ / here_, end = rows * (rank_ + 1) / here_;
  return {begin * row, (end - begin) * row};
}

std::size_t RanksReader::stored(const std::string& name) {
  if (merge() == Merge::same) return file_.count(name);
  const std::vector<std::uint64_t> parts = parts_of(name);
  if (!merging()) return parts[rank_];
  if (merge() == Merge::share) return share_of(parts).second;
  return merge() == Merge::join ? std::accumulate(parts.begin(), parts.end(), std::uint64_t{0}) : parts.front();
}

void RanksReader::values(const std::string& name, Number number, void* data, std::size_t count) {
  const bool whole = there_ == 1 && here_ == 1;
  if (whole || merge() == Merge::same || (merge() == Merge::join && merging())) {
    file_.array(name, number, data, count);
    return;
  }
  const std::vector<std::uint64_t> parts = parts_of(name);
  if (!merging()) {
    const std::uint64_t first = std::accumulate(parts.begin(), parts.begin() + rank_, std::uint64_t{0});
    file_.part(name, number, data, first, count);
    return;
  }
  if (merge() == Merge::share) {
    file_.part(name, number, data, share_of(parts).first, count);
    return;
  }
  // Sums: as many numbers of each rank.
  with_type(number, [&](auto* type) {
    using Type = std::remove_pointer_t<decltype(type)>;
    std::vector<Type> all(std::accumulate(parts.begin(), parts.end(), std::uint64_t{0}));
    file_.array(name, number, all.data(), all.size());
    auto* sums = static_cast<Type*>(data);
    std::fill_n(sums, count, Type{});
    if (merge() == Merge::part && rank_ > 0) return;
    for (std::size_t i = 0; i < all.size() && count > 0; ++i) {
      sums[i % count] = static_cast<Type>(sums[i % count] + all[i]);
    }
  });
}

}  // namespace mpm
