#include "ranks_archive.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "mpm/math/output_file.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

constexpr const char* kRanks = "ranks_written";
constexpr const char* kParts = "parts/";

/// Count of numbers that have one checksum and are written at once: no more than HDF5's cache of a chunk holds (1 MiB),
/// and so few that each rank has some chunks to write, but not fewer than are worth a write.
constexpr std::uint64_t kMostChunk = 1 << 16, kLeastChunk = 1 << 10, kChunksEach = 4;

std::uint64_t quotient_up(std::uint64_t number, std::uint64_t by) { return (number + by - 1) / by; }

/// An array of all ranks in chunks, which are written by the rank in whose part they begin; an array of one chunk is
/// written by the first rank.
class Chunks {
 public:
  explicit Chunks(const std::vector<std::uint64_t>& parts) : begins_{0} {
    for (const std::uint64_t part : parts) begins_.push_back(begins_.back() + part);
    const std::uint64_t least = quotient_up(all(), kMostChunk), most = std::max<std::uint64_t>(1, all() / kLeastChunk);
    const std::uint64_t chunks = std::clamp(kChunksEach * parts.size(), least, most);
    size_ = 2 * std::max<std::uint64_t>(1, quotient_up(all(), 2 * chunks));
  }
  std::uint64_t all() const { return begins_.back(); }
  std::uint64_t size() const { return size_; }
  bool one() const { return all() <= size_; }
  /// The first number of a rank; of that after the last rank: all.
  std::uint64_t begin(int rank) const { return begins_[rank]; }
  /// The first chunk that a rank writes, or a later one does.
  std::uint64_t first(int rank) const { return one() ? (rank == 0 ? 0 : 1) : quotient_up(begins_[rank], size_); }
  int writer(std::uint64_t chunk) const {
    if (one()) return 0;
    return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), chunk * size_) - begins_.begin()) - 1;
  }

 private:
  std::vector<std::uint64_t> begins_;
  std::uint64_t size_ = 2;  ///< even, as the checksum is of pairs of bytes
};

/// Size of one number [bytes].
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
  std::vector<std::uint64_t> made;
  on_first([&] {
    file_ = std::make_unique<Hdf5Writer>(path);
    file_->value(kRanks, size);
    made = {inode_of(path)};
  });
  made = gather_list(ranks, made);
  if (made.empty()) return;
  attempt([&] { chunks_ = std::make_unique<ChunkWriter>(path, made.front()); });
}

template <class Do>
void RanksWriter::attempt(Do&& act) {
  if (!failure_.empty()) return;
  try {
    act();
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

template <class Do>
void RanksWriter::on_first(Do&& act) {
  if (ranks_.first()) attempt(act);
}

void RanksWriter::values(const std::string& name, Number number, void* data, std::size_t count) {
  if (merge() == Merge::same) {
    on_first([&] { file_->array(name, number, data, count); });
    return;
  }
  std::vector<std::uint64_t> parts = gather_list(ranks_, std::vector<std::uint64_t>{count});
  on_first([&] { file_->array(kParts + name, Number::uint64, parts.data(), parts.size()); });
  write_chunks(name, number, parts, data);
}

void RanksWriter::write_chunks(const std::string& name, Number number, const std::vector<std::uint64_t>& parts,
                               const void* data) {
  const Chunks chunks(parts);
  const std::size_t size = size_of(number);
  const int rank = ranks_.rank();
  const std::uint64_t begin = chunks.begin(rank), end = chunks.begin(rank + 1);
  const std::uint64_t first = chunks.first(rank), last = chunks.first(rank + 1);
  const auto own = [&](std::uint64_t at) { return static_cast<const std::byte*>(data) + (at - begin) * size; };

  std::vector<std::uint64_t> places;
  if (!chunks.one()) {
    on_first([&] { places = file_->places(name, number, chunks.all(), chunks.size()); });
    places = gather_list(ranks_, places);
    if (places.empty()) return;  // the first rank has failed
  }
  // Parts of a chunk that begins before this rank's part.
  std::vector<Communicator::Parcel> parcels;
  const std::uint64_t until = std::min(end, first * chunks.size());
  if (begin < until) {
    parcels.push_back({chunks.writer(begin / chunks.size()), Communicator::Bytes(own(begin), own(until))});
  }
  const std::vector<Communicator::Parcel> arrived = ranks_.deliver(parcels);
  for (std::uint64_t chunk = first; chunk < last; ++chunk) {
    const std::uint64_t from = chunk * chunks.size(), to = from + chunks.size();
    if (!chunks.one() && to <= end) {
      attempt([&] { chunks_->write(places[chunk], own(from), chunks.size() * size); });
      continue;
    }
    chunk_.assign(own(from), own(end));
    for (const Communicator::Parcel& parcel : arrived) {  // in the order of ranks
      chunk_.insert(chunk_.end(), parcel.bytes.begin(), parcel.bytes.end());
    }
    if (chunks.one()) {
      attempt([&] { file_->array(name, number, chunk_.data(), chunks.all()); });
    } else {
      chunk_.resize(chunks.size() * size);  // fills the rest of the last one with zeros
      attempt([&] { chunks_->write(places[chunk], chunk_.data(), chunk_.size()); });
    }
  }
}

void RanksWriter::close() {
  attempt([&] {
    if (chunks_) chunks_->close();
  });
  on_first([&] { file_->close(); });
  const std::string reason = first_text(ranks_, failure_);
  if (!reason.empty()) throw CheckpointError(reason);
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
