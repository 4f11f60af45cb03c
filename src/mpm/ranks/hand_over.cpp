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

}  // namespace

std::size_t room_for_particles(std::size_t particles) {
  std::size_t step = 1024;
  while (16 * step < particles) step *= 2;
  return (particles / step + 2) * step;
}

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

void HandOver::replace(ParticleSet& set, const std::vector<int>& staying, std::vector<Unpacking>& coming) {
  std::vector<std::uint64_t> counts(coming.size());
  std::size_t size = staying.size();
  for (std::size_t i = 0; i < coming.size(); ++i) {
    coming[i].take(&counts[i], 1);
    size += counts[i];
  }
  const auto make_room = [size](auto& values) {
    values.resize(room_for_particles(size));
    values.resize(size);
  };
  each_column(set, [&](auto& values) {
    auto& kept = room_.of(values);
    make_room(kept);
    auto* to = kept.data();
    for (const int p : staying) *to++ = values[p];
    for (std::size_t i = 0; i < coming.size(); ++i) {
      coming[i].take(to, counts[i]);
      to += counts[i];
    }
    values.swap(kept);
  });
  for (PaddedArray<double>& scalar : set.next_x) make_room(scalar);
  for (ParticleScalar& scalar : set.domain) scalar.visit(make_room);
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

void HandOver::find_leaving(const ParticleSet& set, Leaving& leaving) const {
  leaving.staying.clear();
  leaving.to.assign(ranks_.size(), {});
  std::uint64_t last = ~std::uint64_t{0};
  int owner = ranks_.rank();  // of the last one; neighbours are in the same block mostly
  for (int p = 0; p < set.size(); ++p) {
    const auto key = block_of(set, layout_, p);
    if (key && *key != last) {
      last = *key;
      owner = territory_.owner(*key);
    }
    (!key || owner == ranks_.rank() ? leaving.staying : leaving.to[owner]).push_back(p);
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
  for (std::size_t s = 0; s < sets.size(); ++s) replace(sets[s], leaving[s].staying, coming);
}

}  // namespace mpm
