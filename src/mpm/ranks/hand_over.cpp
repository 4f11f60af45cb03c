#include "mpm/ranks/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <unordered_map>

#include "mpm/particles/permute.hpp"

namespace mpm {
namespace {

constexpr double kUneven = 1.1;  ///< imbalance from which the grid is divided anew
constexpr double kWorse = 1.02;  ///< times what the last division left: blocks cannot be divided

/// The key of the block that a particle lies in; none if it lies outside its set's bounds.
std::optional<std::uint64_t> block_of(const ParticleSet& set, const GridLayout& layout, int p) {
  std::array<int, 3> block{};
  for (int k = 0; k < layout.dim(); ++k) {
    const double cells = layout.in_cells(k, set.x[k][p]);
    if (!(cells >= set.lowest[k] && cells <= set.highest[k])) return std::nullopt;
    block[k] = GridLayout::nearest(cells) / kBlockEdge;
  }
  return layout.key(block);
}

/// visit(array) for all that a particle carries from step to step, one array after another.
template <class Visit>
void each_column(ParticleSet& set, Visit&& visit) {
  visit(set.id);
  set.each_scalar(visit);
  if (set.far_field != set.field) visit(set.side);  // it may be empty, where all particles are elsewhere
}

/// Appends the values at some places.
template <class T>
void put(Communicator::Bytes& bytes, const T* values, const std::vector<std::uint32_t>& places) {
  std::size_t at = bytes.size();
  bytes.resize(at + places.size() * sizeof(T));
  for (const std::uint32_t place : places) {
    std::memcpy(bytes.data() + at, values + place, sizeof(T));
    at += sizeof(T);
  }
}

template <class T>
void put_all(Communicator::Bytes& bytes, const T* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(T));
}

/// visit(span) for places in sequence, as spans.
template <class Visit>
void each_span_of(const std::uint32_t* places, std::size_t count, Visit&& visit) {
  for (std::size_t i = 0; i < count;) {
    const std::size_t first = i++;
    while (i < count && places[i] == places[i - 1] + 1) ++i;
    visit(ParticleOrder::Span{places[first], static_cast<std::uint32_t>(i - first)});
  }
}

}  // namespace

/// A parcel that is read from its beginning to its end.
struct HandOver::Unpacking {
  const Communicator::Bytes& bytes;
  std::size_t at = 0;

  template <class T>
  void take(T* values, std::size_t count) {
    if (count == 0) return;
    std::memcpy(values, bytes.data() + at, count * sizeof(T));
    at += count * sizeof(T);
  }
};

void HandOver::pack(ParticleSet& set, const Part& part, Communicator::Bytes& bytes) {
  const std::uint64_t runs = part.runs.size();
  put_all(bytes, &runs, 1);
  put_all(bytes, part.runs.data(), part.runs.size());
  each_column(set, [&](auto& values) { put(bytes, values.data(), part.places); });
}

void HandOver::take_in(ParticleSet& set, Leaving& leaving, std::vector<Unpacking>& coming, ParticleOrder& order) {
  order.begin_anew(set);
  std::vector<std::vector<Run>> runs;
  std::vector<std::size_t> counts;
  std::size_t all = 0;
  for (Unpacking& parcel : coming) {
    std::uint64_t count = 0;
    parcel.take(&count, 1);
    runs.emplace_back(count);
    parcel.take(runs.back().data(), count);
    counts.push_back(0);
    for (const Run& run : runs.back()) counts.back() += run.count;
    all += counts.back();
  }
  std::vector<std::uint32_t>& places = leaving.left;  // places of those that come; beyond the end if too few have left
  for (auto place = static_cast<std::uint32_t>(set.size()); places.size() < all; ++place) places.push_back(place);
  const std::size_t size = all == 0 ? 0 : std::size_t{places[all - 1]} + 1;
  each_column(set, [&](auto& values) {
    if (size > values.size()) values.extend(size, room_for_particles(size));
    auto place = places.begin();
    for (std::size_t i = 0; i < coming.size(); ++i) {
      for (std::size_t p = 0; p < counts[i]; ++p) coming[i].take(values.data() + *place++, 1);
    }
  });
  std::vector<Piece>& pieces = leaving.staying;
  const std::uint32_t* place = places.data();
  for (const std::vector<Run>& of_one : runs) {
    for (const Run& run : of_one) {
      each_span_of(place, run.count, [&](ParticleOrder::Span span) { pieces.push_back({run.key, span}); });
      place += run.count;
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.key < b.key; });
  for (const Piece& piece : pieces) order.add(piece.span);
}

void HandOver::settle(std::vector<ParticleSet>& sets) {
  PermuteScratch scratch;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleOrder& order = orders_[s];
    sets[s].begin.clear();
    if (order.is_as_in_memory(sets[s])) {
      sets[s].fit_scratch();  // particles may have come at the end
      continue;
    }
    permute(sets[s], order.places().data(), order, room_for_particles(order.count()), scratch, 1);
    orders_[s].be_as_in_memory(sets[s]);
  }
}

std::vector<std::uint64_t> owner_keys(const Fields& fields) {
  std::vector<std::uint64_t> keys;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const BlockTable& blocks = fields[f]->blocks;
    for (int owner = 0; owner < blocks.owners(); ++owner) {
      keys.push_back(f * blocks.layout().keys() + blocks.key(blocks.owner_block(owner)));
    }
  }
  return keys;
}

Territory::Load HandOver::load(const std::vector<ParticleSet>& sets) const {
  std::unordered_map<std::uint64_t, std::uint64_t> particles;
  for (const ParticleSet& set : sets) {
    for (int p = 0; p < set.awake(); ++p) {
      if (const auto key = block_of(set, layout_, p)) ++particles[*key];
    }
  }
  Territory::Load list(particles.begin(), particles.end());
  std::sort(list.begin(), list.end());
  return list;
}

bool HandOver::is_inside(std::uint64_t key) {
  const auto [known, added] = inside_.try_emplace(key, true);
  if (!added) return known->second;
  const std::array<int, 3> middle = layout_.block(key);
  for (int s = 0; s < neighbours_of(layout_.dim()) && known->second; ++s) {
    known->second = territory_.owner(layout_.key(neighbour_of(middle, s, layout_.dim()))) == ranks_.rank();
  }
  return known->second;
}

bool HandOver::are_around(const ParticleSet& set, int begin, int end, std::uint64_t key) const {
  constexpr double kHalf = 0.49;  // half a cell, a little less, so that round-off takes in nothing
  const std::array<int, 3> block = layout_.block(key);
  bool around = true;
  for (int k = 0; k < layout_.dim(); ++k) {
    const double low = (block[k] - 1) * kBlockEdge - kHalf, high = (block[k] + 2) * kBlockEdge - 1 + kHalf;
    const double* x = set.x[k].data();
    for (int p = begin; p < end; ++p) {
      const double cells = layout_.in_cells(k, x[p]);
      around = around && cells > low && cells < high;
    }
  }
  return around;
}

void HandOver::find_leaving(const ParticleSet& set, const std::vector<std::uint64_t>& owners, Leaving& leaving) {
  leaving.to.assign(ranks_.size(), {});
  std::uint64_t last = ~std::uint64_t{0};
  int owner = ranks_.rank();  // owner of the last one; neighbours are in the same block mostly
  const auto find_in = [&](std::uint32_t begin, std::uint32_t end, std::uint64_t was) {
    for (std::uint32_t p = begin; p < end; ++p) {
      const auto key = block_of(set, layout_, static_cast<int>(p));
      if (key && *key != last) {
        last = *key;
        owner = territory_.owner(*key);
      }
      if (!key || owner == ranks_.rank()) continue;
      if (begin < p) leaving.staying.push_back({was, {begin, p - begin}});
      begin = p + 1;
      leaving.left.push_back(p);
      Part& part = leaving.to[owner];
      part.places.push_back(p);
      if (part.runs.empty() || part.runs.back().key != was) part.runs.push_back({was, 0});
      ++part.runs.back().count;
    }
    if (begin < end) leaving.staying.push_back({was, {begin, end - begin}});
  };
  const std::size_t blocks = set.begin.empty() ? 0 : std::min(owners.size(), set.begin.size() - 1);
  for (std::size_t sorted = 0; sorted < blocks; ++sorted) {
    const std::uint32_t begin = set.begin[sorted], end = set.begin[sorted + 1];
    const std::uint64_t place = owners[sorted] % layout_.keys();
    if (begin < end && is_inside(place) && are_around(set, begin, end, place)) {  // most blocks stay whole
      leaving.staying.push_back({owners[sorted], {begin, end - begin}});
    } else {
      find_in(begin, end, owners[sorted]);
    }
  }
  const std::uint32_t rest = blocks == 0 ? 0 : set.begin[blocks];
  find_in(rest, static_cast<std::uint32_t>(set.awake()), ~std::uint64_t{0});  // that have not been sorted
}

void HandOver::cut(const std::vector<ParticleSet>& sets) {
  territory_.cut(load(sets), [this](double* numbers, int count) { ranks_.sum(numbers, count); });
  inside_.clear();
  ++divisions_;
}

void HandOver::divide(std::vector<ParticleSet>& sets) {
  for (ParticleSet& set : sets) set.begin.clear();  // forgets blocks, which may be others' for particles from elsewhere
  after_cut_ = 1.0;
  just_divided_ = false;
  cut(sets);
  send(sets, {});
  settle(sets);
}

void HandOver::divide_anew_if_due(const std::vector<ParticleSet>& sets) {
  double own = 0.0;
  for (const ParticleSet& set : sets) own += set.awake();
  double most = own;
  ranks_.largest(&most, 1);
  const double all = ranks_.sum(own);
  imbalance_ = all > 0.0 ? most * ranks_.size() / all : 1.0;
  if (just_divided_) after_cut_ = imbalance_;
  just_divided_ = false;
  if (imbalance_ <= kUneven || imbalance_ <= kWorse * after_cut_) return;
  cut(sets);
  just_divided_ = true;
}

void HandOver::hand_over(std::vector<ParticleSet>& sets, const std::vector<std::uint64_t>& owners) {
  divide_anew_if_due(sets);
  send(sets, owners);
}

void HandOver::send(std::vector<ParticleSet>& sets, const std::vector<std::uint64_t>& owners) {
  std::vector<Leaving> leaving(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) find_leaving(sets[s], owners, leaving[s]);
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    std::size_t count = 0;
    for (const Leaving& one : leaving) count += one.to[rank].places.size();
    if (count == 0) continue;
    parcels.push_back({rank, {}});
    for (std::size_t s = 0; s < sets.size(); ++s) pack(sets[s], leaving[s].to[rank], parcels.back().bytes);
    handed_over_ += count;
  }
  const std::vector<Communicator::Parcel> arrived = ranks_.deliver(parcels);
  std::vector<Unpacking> coming;
  for (const Communicator::Parcel& parcel : arrived) coming.push_back({parcel.bytes});
  orders_.resize(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) take_in(sets[s], leaving[s], coming, orders_[s]);
}

}  // namespace mpm
