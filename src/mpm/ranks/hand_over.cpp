#include "mpm/ranks/hand_over.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <unordered_map>

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

template <class T>
void put(Communicator::Bytes& bytes, const T* values, std::size_t count) {
  const auto* from = reinterpret_cast<const std::byte*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(T));
}

}  // namespace

std::size_t room_for_particles(std::size_t particles) {
  std::size_t step = 1024;
  while (16 * step < particles) step *= 2;
  return (particles / step + 2) * step;
}

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

void HandOver::pack(ParticleSet& set, const Part& leaving, Communicator::Bytes& bytes) {
  const std::uint64_t runs = leaving.runs.size();
  put(bytes, &runs, 1);
  put(bytes, leaving.runs.data(), leaving.runs.size());
  each_column(set, [&](auto& values) {
    for (const int p : leaving.particles) put(bytes, values.data() + p, 1);
  });
}

void HandOver::replace(ParticleSet& set, const Part& staying, std::vector<Unpacking>& coming) {
  constexpr std::size_t kHere = 0;  // others by the number of the parcel, and one
  struct Piece {
    std::uint64_t key;
    std::size_t from, count;
  };
  std::vector<Piece> pieces;
  std::size_t size = staying.particles.size();
  for (const Run& run : staying.runs) pieces.push_back({run.key, kHere, run.count});
  for (std::size_t i = 0; i < coming.size(); ++i) {
    std::uint64_t count = 0;
    coming[i].take(&count, 1);
    std::vector<Run> runs(count);
    coming[i].take(runs.data(), runs.size());
    for (const Run& run : runs) {
      pieces.push_back({run.key, i + 1, run.count});
      size += run.count;
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.key < b.key; });
  const auto make_room = [size](auto& values) {
    values.resize(room_for_particles(size));
    values.resize(size);
  };
  each_column(set, [&](auto& values) {
    auto& merged = room_.of(values);
    make_room(merged);
    auto* to = merged.data();
    auto next = staying.particles.begin();
    for (const Piece& piece : pieces) {
      if (piece.from != kHere) {
        coming[piece.from - 1].take(to, piece.count);
        to += piece.count;
        continue;
      }
      const auto end = next + static_cast<std::ptrdiff_t>(piece.count);
      if (static_cast<std::uint64_t>(end[-1] - *next) + 1 == piece.count) {  // none of them has left
        to = std::copy_n(values.data() + *next, piece.count, to);
        next = end;
      }
      while (next != end) *to++ = values[*next++];
    }
    values.swap(merged);
  });
  set.begin.clear();
  for (PaddedArray<double>& scalar : set.next_x) make_room(scalar);
  for (ParticleScalar& scalar : set.domain) scalar.visit(make_room);
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
    for (int p = 0; p < set.size(); ++p) {
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
    std::array<int, 3> block = middle;
    int rest = s;
    for (int k = layout_.dim() - 1; k >= 0; --k, rest /= 3) block[k] += rest % 3 - 1;
    known->second = territory_.owner(layout_.key(block)) == ranks_.rank();
  }
  return known->second;
}

bool HandOver::are_around(const ParticleSet& set, int begin, int end, std::uint64_t key) const {
  constexpr double kHalf = 0.49;  // of a cell, a little less, so that round-off takes in nothing
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
  leaving.staying = {};
  leaving.staying.particles.reserve(set.size());
  leaving.to.assign(ranks_.size(), {});
  std::uint64_t last = ~std::uint64_t{0};
  int owner = ranks_.rank();  // of the last one; neighbours are in the same block mostly
  std::size_t sorted = 0;     // into which block, by its number
  const std::size_t blocks = set.begin.empty() ? 0 : std::min(owners.size(), set.begin.size() - 1);
  for (int p = 0; p < set.size(); ++p) {
    while (sorted < blocks && static_cast<std::uint32_t>(p) >= set.begin[sorted + 1]) ++sorted;
    if (sorted < blocks && static_cast<std::uint32_t>(p) == set.begin[sorted]) {  // most blocks stay whole
      const int end = static_cast<int>(set.begin[sorted + 1]);
      const std::uint64_t place = owners[sorted] % layout_.keys();
      if (is_inside(place) && are_around(set, p, end, place)) {
        leaving.staying.runs.push_back({owners[sorted], static_cast<std::uint64_t>(end - p)});
        for (; p < end; ++p) leaving.staying.particles.push_back(p);
        --p;
        continue;
      }
    }
    const auto key = block_of(set, layout_, p);
    if (key && *key != last) {
      last = *key;
      owner = territory_.owner(*key);
    }
    Part& part = !key || owner == ranks_.rank() ? leaving.staying : leaving.to[owner];
    const std::uint64_t was = sorted < blocks ? owners[sorted] : ~std::uint64_t{0};
    part.particles.push_back(p);
    if (part.runs.empty() || part.runs.back().key != was) part.runs.push_back({was, 0});
    ++part.runs.back().count;
  }
}

void HandOver::cut(const std::vector<ParticleSet>& sets) {
  territory_.cut(load(sets), [this](double* numbers, int count) { ranks_.sum(numbers, count); });
  inside_.clear();
  ++divisions_;
}

void HandOver::divide(std::vector<ParticleSet>& sets) {
  cut(sets);
  send(sets, {});
}

void HandOver::divide_anew_if_due(const std::vector<ParticleSet>& sets) {
  double own = 0.0;
  for (const ParticleSet& set : sets) own += set.size();
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
    for (const Leaving& one : leaving) count += one.to[rank].particles.size();
    if (count == 0) continue;
    parcels.push_back({rank, {}});
    for (std::size_t s = 0; s < sets.size(); ++s) pack(sets[s], leaving[s].to[rank], parcels.back().bytes);
    handed_over_ += count;
  }
  const std::vector<Communicator::Parcel> arrived = ranks_.deliver(parcels);
  if (parcels.empty() && arrived.empty()) return;
  std::vector<Unpacking> coming;
  for (const Communicator::Parcel& parcel : arrived) coming.push_back({parcel.bytes});
  for (std::size_t s = 0; s < sets.size(); ++s) replace(sets[s], leaving[s].staying, coming);
}

}  // namespace mpm
