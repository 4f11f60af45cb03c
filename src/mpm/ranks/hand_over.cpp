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

void pack(ParticleSet& set, const std::vector<int>& leaving, Communicator::Bytes& bytes) {
  const std::uint64_t count = leaving.size();
  put(bytes, &count, 1);
  each_column(set, [&](auto& values) {
    for (const int p : leaving) put(bytes, values.data() + p, 1);
  });
}

/// A parcel that is read from its beginning to its end.
struct Unpacking {
  const Communicator::Bytes& bytes;
  std::size_t at = 0;
  std::uint64_t count = 0;  ///< of the particles of the set at hand

  template <class T>
  void take(T* values, std::size_t count) {
    if (count == 0) return;
    std::memcpy(values, bytes.data() + at, count * sizeof(T));
    at += count * sizeof(T);
  }
};

/// Those that come, parcel by parcel, take the places of those that leave; others at the end move into what is left of
/// these, or are followed by what has no place yet. So what stays is not moved, where nearly all stay. `places`: of
/// those that leave, ascending.
void replace(ParticleSet& set, const std::vector<int>& places, std::vector<Unpacking>& coming) {
  std::size_t arriving = 0;
  for (Unpacking& parcel : coming) {
    parcel.take(&parcel.count, 1);
    arriving += parcel.count;
  }
  const std::size_t before = set.id.size(), leaving = places.size(), size = before - leaving + arriving;
  std::vector<std::size_t> moved;  // what stays, from beyond the end that will be
  for (std::size_t p = size; p < before; ++p) {
    if (!std::binary_search(places.begin(), places.end(), static_cast<int>(p))) moved.push_back(p);
  }
  each_column(set, [&](auto& values) {
    values.extend(std::max(size, before));
    auto place = places.begin();
    std::size_t end = before;
    for (Unpacking& parcel : coming) {
      for (std::uint64_t i = 0; i < parcel.count; ++i) {
        parcel.take(values.data() + (place != places.end() ? static_cast<std::size_t>(*place++) : end++), 1);
      }
    }
    for (const std::size_t p : moved) values[static_cast<std::size_t>(*place++)] = values[p];
    values.extend(size);
  });
  set.fit_scratch();
}

}  // namespace

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

void HandOver::find_leaving(const ParticleSet& set, Leaving& leaving) const {
  leaving.all.clear();
  leaving.to.assign(ranks_.size(), {});
  std::uint64_t last = ~std::uint64_t{0};
  int owner = ranks_.rank();  // of the last one; neighbours are in the same block mostly
  for (int p = 0; p < set.size(); ++p) {
    const auto key = block_of(set, layout_, p);
    if (!key) continue;
    if (*key != last) {
      last = *key;
      owner = territory_.owner(*key);
    }
    if (owner == ranks_.rank()) continue;
    leaving.all.push_back(p);
    leaving.to[owner].push_back(p);
  }
}

void HandOver::cut(const std::vector<ParticleSet>& sets) {
  territory_.cut(load(sets), [this](double* numbers, int count) { ranks_.sum(numbers, count); });
  ++divisions_;
}

void HandOver::divide(std::vector<ParticleSet>& sets) {
  cut(sets);
  send(sets);
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

void HandOver::hand_over(std::vector<ParticleSet>& sets) {
  divide_anew_if_due(sets);
  send(sets);
}

void HandOver::send(std::vector<ParticleSet>& sets) {
  std::vector<Leaving> leaving(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) find_leaving(sets[s], leaving[s]);
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    std::size_t count = 0;
    for (const Leaving& one : leaving) count += one.to[rank].size();
    if (count == 0) continue;
    parcels.push_back({rank, {}});
    for (std::size_t s = 0; s < sets.size(); ++s) pack(sets[s], leaving[s].to[rank], parcels.back().bytes);
    handed_over_ += count;
  }
  const std::vector<Communicator::Parcel> arrived = ranks_.deliver(parcels);
  if (parcels.empty() && arrived.empty()) return;
  std::vector<Unpacking> coming;
  for (const Communicator::Parcel& parcel : arrived) coming.push_back({parcel.bytes});
  for (std::size_t s = 0; s < sets.size(); ++s) replace(sets[s], leaving[s].all, coming);
}

}  // namespace mpm
