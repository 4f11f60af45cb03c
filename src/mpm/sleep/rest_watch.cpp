#include "mpm/sleep/rest_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "mpm/loop/loop.hpp"
#include "mpm/ranks/lists.hpp"

namespace mpm {

void RestWatch::follow(const Fields& fields, double now) {
  before_.swap(entries_);
  entries_.clear();
  auto old = before_.begin();
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const BlockTable& blocks = fields[f]->blocks;
    for (int owner = 0; owner < blocks.owners(); ++owner) {
      RestWatchEntry entry;
      entry.field = static_cast<int>(f);
      entry.key = blocks.key(blocks.owner_block(owner));
      entry.begun = now;
      const auto is_before = [&](const RestWatchEntry& one) {
        return std::tie(one.field, one.key) < std::tie(entry.field, entry.key);
      };
      while (old != before_.end() && is_before(*old)) ++old;
      const bool known = old != before_.end() && old->field == entry.field && old->key == entry.key;
      entries_.push_back(known ? *old : entry);
    }
  }
}

void RestWatch::forget_rest() {
  for (RestWatchEntry& entry : entries_) entry.at_rest = false;
}

void RestWatch::put_in_order() {
  std::sort(entries_.begin(), entries_.end(), [](const RestWatchEntry& a, const RestWatchEntry& b) {
    return std::tie(a.field, a.key) < std::tie(b.field, b.key);
  });
}

void RestWatch::hand_over(Halo& halo) {
  struct Row {
    std::uint64_t key;
    double begun, fastest, mean[3], half_before[3];
    std::int32_t field;
    std::uint32_t looks;
    std::uint8_t half_at_rest, at_rest;
  };
  const auto vector = [](const double* of) { return Vec3(of[0], of[1], of[2]); };
  std::vector<std::vector<Row>> leaving(halo.ranks().size());
  const auto leaves = [&](const RestWatchEntry& e) {
    const int rank = halo.owner(e.key);
    if (rank == halo.ranks().rank()) return false;
    const Vec3 &m = e.mean, &h = e.half_before;
    leaving[rank].push_back({e.key,
                             e.begun,
                             e.fastest,
                             {m[0], m[1], m[2]},
                             {h[0], h[1], h[2]},
                             e.field,
                             e.looks,
                             e.half_at_rest,
                             e.at_rest});
    return true;
  };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), leaves), entries_.end());
  for (const std::vector<Row>& of_rank : exchange(halo.ranks(), std::move(leaving))) {
    for (const Row& row : of_rank) {
      entries_.push_back({row.field, row.key, row.begun, row.fastest, vector(row.mean), row.looks,
                          vector(row.half_before), row.half_at_rest != 0, row.at_rest != 0});
    }
  }
  put_in_order();
}

void RestWatch::look_at(RestWatchEntry& entry, int owner, const std::vector<ParticleSet>& sets, double now) {
  double fastest = 0.0, mass = 0.0;
  std::array<double, 3> momentum{};
  for (const ParticleSet& set : sets) {
    for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) {
      const double m = set.mass_of(static_cast<int>(p));
      double squared = 0.0;
      for (std::size_t k = 0; k < set.v.size(); ++k) {
        const double v = set.v[k][p];
        squared += v * v;
        momentum[k] += m * v;
      }
      mass += m;
      fastest = std::max(fastest, squared);
    }
  }
  fastest = std::sqrt(fastest);
  entry.fastest = std::max(entry.fastest, fastest);
  for (std::size_t k = 0; k < 3; ++k) entry.mean[static_cast<int>(k)] += momentum[k] / mass;
  ++entry.looks;
  entry.at_rest = entry.at_rest && fastest < speed_;
  if (now - entry.begun < half_ || entry.looks < kLeastLooks) return;
  const Vec3 mean = entry.mean / entry.looks;
  const bool still = entry.fastest < speed_ && mean.norm() < kMean * speed_;
  const bool sets_off = mean.norm() > kSeen * speed_ && mean.dot(entry.half_before) > entry.half_before.squaredNorm();
  entry.at_rest = still && entry.half_at_rest && !sets_off;
  entry.half_at_rest = still;
  entry.half_before = mean;
  entry.begun = now;
  entry.fastest = 0.0;
  entry.mean.setZero();
  entry.looks = 0;
}

void RestWatch::look(const Fields& fields, const std::vector<ParticleSet>& sets, double now, int threads) {
  for (const auto& grid : fields) {
    for_all("sleep: blocks at rest", threads, grid->blocks.owners(),
            [&, first = grid->first_owner](int owner) { look_at(entries_[first + owner], first + owner, sets, now); });
  }
}

void RestWatch::trust_all() {
  for (RestWatchEntry& entry : entries_) {
    entry.half_at_rest = true;
    entry.begun -= half_;
    entry.looks = kLeastLooks;
  }
}

void RestWatch::serialise(StateArchive& archive) {
  archive.rows("entries", entries_);
  archive.column("field", entries_, &RestWatchEntry::field);
  archive.column("key", entries_, &RestWatchEntry::key);
  archive.column("begun", entries_, &RestWatchEntry::begun);
  archive.column("fastest", entries_, &RestWatchEntry::fastest);
  archive.column("mean", entries_, &RestWatchEntry::mean);
  archive.column("looks", entries_, &RestWatchEntry::looks);
  archive.column("half_before", entries_, &RestWatchEntry::half_before);
  archive.column("half_at_rest", entries_, &RestWatchEntry::half_at_rest);
  archive.column("at_rest", entries_, &RestWatchEntry::at_rest);
  if (archive.merging()) put_in_order();
}

}  // namespace mpm
