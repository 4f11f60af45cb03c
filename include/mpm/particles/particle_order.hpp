// The particles of a set that are awake, in the order in which they count as lying in memory. Over several ranks
// particles go and come before a sort (ranks/hand_over.hpp): those that come take any place that is free, and the sort,
// which moves all particles anyway, reads them in this order. Until then some places may be empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpm/particles/particle_set.hpp"

namespace mpm {

class ParticleOrder {
 public:
  /// Places one after another.
  struct Span {
    std::uint32_t first, count;
  };

  /// All that are awake, as they lie in memory.
  void be_as_in_memory(const ParticleSet& set) {
    begin_anew(set);
    add({0, static_cast<std::uint32_t>(set.awake())});
  }
  /// None, for a set before particles come. What is asleep stays where it is.
  void begin_anew(const ParticleSet& set) {
    spans_.clear();
    count_ = end_ = 0;
    asleep_from_ = static_cast<std::size_t>(set.awake());
    asleep_ = static_cast<std::size_t>(set.asleep);
  }
  void add(Span span) {
    if (span.count == 0) return;
    if (!spans_.empty() && spans_.back().first + spans_.back().count == span.first) {
      spans_.back().count += span.count;
    } else {
      spans_.push_back(span);
    }
    count_ += span.count;
    end_ = std::max(end_, static_cast<std::size_t>(span.first) + span.count);
  }

  /// Number of particles in it.
  std::size_t count() const { return count_; }
  /// One past the last place in it.
  std::size_t end() const { return end_; }
  /// Place from which on those asleep lie, one after another.
  std::size_t asleep_from() const { return asleep_from_; }
  std::size_t asleep() const { return asleep_; }
  /// True if a set has no other particles and those in this order.
  bool is_as_in_memory(const ParticleSet& set) const {
    return count_ == end_ && spans_.size() <= 1 && count_ + asleep_ == set.id.size();
  }

  /// visit(first, end) for the places of particles [begin, end) of this order.
  template <class Visit>
  void each_span(std::size_t begin, std::size_t end, Visit&& visit) const {
    std::size_t number = 0;
    for (const Span& span : spans_) {
      if (number >= end) return;
      const std::size_t skip = begin > number ? std::min<std::size_t>(begin - number, span.count) : 0;
      const std::size_t take = std::min<std::size_t>(end - number, span.count);
      if (skip < take) visit(span.first + skip, span.first + take);
      number += span.count;
    }
  }
  /// The places of all, in this order.
  std::vector<std::uint32_t> places() const {
    std::vector<std::uint32_t> list;
    list.reserve(count_);
    each_span(0, count_, [&](std::size_t first, std::size_t end) {
      for (; first < end; ++first) list.push_back(static_cast<std::uint32_t>(first));
    });
    return list;
  }
  /// The number in this order of the particle at a place.
  std::size_t number_of(std::size_t place) const {
    std::size_t number = 0;
    for (const Span& span : spans_) {
      if (place >= span.first && place - span.first < span.count) return number + (place - span.first);
      number += span.count;
    }
    return number;
  }

 private:
  std::vector<Span> spans_;
  std::size_t count_ = 0, end_ = 0, asleep_from_ = 0, asleep_ = 0;
};

}  // namespace mpm
