#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "mpm/ranks/lists.hpp"
#include "ranks_promises.hpp"

namespace mpm {
namespace {

using Bytes = Communicator::Bytes;
using Parcel = Communicator::Parcel;
using Source = Communicator::Source;

/// A number of a rank, of very different size from one rank and place to the next: their sum depends on the order.
double number(int rank, int i) { return std::ldexp(i % 3 == 1 ? -1.1 : 1.3, (rank * 23 + i * 7) % 59); }

void sums_are_added_in_the_order_of_ranks(Communicator& ranks) {
  for (const int count : {0, 1, 3, 100'000}) {  // the last one goes in several parts over MPI
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(number(ranks.rank(), i));
    ranks.sum(numbers.data(), count);
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
      double expected = 0.0;
      for (int rank = 0; rank < ranks.size(); ++rank) expected += number(rank, i);
      wrong += numbers[i] != expected;
    }
    EXPECT_EQ(wrong, 0) << "of " << count;
  }
  EXPECT_EQ(ranks.sum(ranks.rank() + 1.0), 0.5 * ranks.size() * (ranks.size() + 1));
}

void the_largest_is_that_of_all_ranks(Communicator& ranks) {
  const int last = ranks.size() - 1;
  const double infinite = std::numeric_limits<double>::infinity();
  double numbers[] = {-1.0 - ranks.rank(), 2.0 * ranks.rank(), -infinite,
                      ranks.rank() == last ? std::nan("") : infinite};
  ranks.largest(numbers, 4);
  EXPECT_EQ(numbers[0], -1.0);
  EXPECT_EQ(numbers[1], 2.0 * last);
  EXPECT_EQ(numbers[2], -infinite);
  EXPECT_TRUE(std::isnan(numbers[3]));
  EXPECT_TRUE(ranks.any(ranks.rank() == last));
  EXPECT_FALSE(ranks.any(false));
}

/// Bytes that tell who sends them to whom; of some pairs none.
Bytes bytes_for(int from, int to, std::size_t times) {
  Bytes bytes(((from * 5 + to * 3) % 4) * times);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(from * 31 + to * 7 + i % 101);
  return bytes;
}

void gathered_bytes_come_in_the_order_of_ranks(Communicator& ranks) {
  for (const std::size_t times : {0, 1, 1000, 300'000}) {
    const std::vector<Bytes> all = ranks.gather(bytes_for(ranks.rank(), 1, times));
    ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks.size()));
    for (int rank = 0; rank < ranks.size(); ++rank) EXPECT_TRUE(all[rank] == bytes_for(rank, 1, times)) << rank;
  }
}

void all_hear_the_first(Communicator& ranks) {
  for (const std::size_t times : {0, 1, 1000, 300'000}) {
    const Bytes told = ranks.of_first(bytes_for(ranks.rank(), 1, times));
    EXPECT_TRUE(told == bytes_for(0, 1, times)) << times << " on " << ranks.rank();
  }
}

void parcels_arrive_whole_in_the_order_of_senders(Communicator& ranks) {
  const int self = ranks.rank();
  // Not every rank sends to every other, and not in both directions.
  const auto sends = [](int from, int to) { return from != to && (2 * from + to) % 3 != 0; };
  for (const std::size_t times : {0, 1, 85, 86, 256, 300'000}) {  // parcels of 256 bytes, of a byte less and more
    std::vector<Parcel> parcels;
    for (int to = ranks.size() - 1; to >= 0; --to) {
      if (sends(self, to)) parcels.push_back({to, bytes_for(self, to, times)});
    }
    const std::vector<Parcel> arrived = ranks.deliver(parcels);
    std::size_t next = 0;
    for (int from = 0; from < ranks.size(); ++from) {
      if (!sends(from, self)) continue;
      ASSERT_LT(next, arrived.size());
      EXPECT_EQ(arrived[next].rank, from);
      EXPECT_TRUE(arrived[next].bytes == bytes_for(from, self, times)) << from << " to " << self << ", " << times;
      ++next;
    }
    EXPECT_EQ(next, arrived.size());
  }
  EXPECT_TRUE(ranks.deliver({}).empty());
}

void values_are_placed_on_the_first_rank(Communicator& ranks) {
  // The middle rank has none, and nobody has the last place.
  constexpr std::uint64_t kEach = 100;
  const int none = ranks.size() / 2;
  const std::uint64_t places = kEach * static_cast<std::uint64_t>(ranks.size()) + 1;
  std::vector<double> own, all;
  std::vector<std::uint64_t> at;
  for (std::uint64_t i = 0; i < kEach && ranks.rank() != none; ++i) {
    at.push_back((kEach - 1 - i) * static_cast<std::uint64_t>(ranks.size()) + static_cast<std::uint64_t>(ranks.rank()));
    own.push_back(0.5 * static_cast<double>(at.back()));
  }
  if (ranks.first()) all.assign(places, -1.0);
  ranks.place(own, at, all.data(), all.size());
  for (std::uint64_t i = 0; i < places && ranks.first(); ++i) {
    const bool has = i + 1 < places && i % static_cast<std::uint64_t>(ranks.size()) != static_cast<std::uint64_t>(none);
    EXPECT_EQ(all[i], has ? 0.5 * static_cast<double>(i) : -1.0) << i;
  }
}

/// Rows of a rank's array: the first rank has none.
int rows_of(int rank) { return 3 * rank; }

double entry(int rank, int row, int i, int round) { return 1e6 * rank + 1e3 * row + i + 0.25 * round; }

std::vector<double> array_of(int rank, int numbers, int round) {
  std::vector<double> rows;
  for (int row = 0; row < rows_of(rank); ++row) {
    for (int i = 0; i < numbers; ++i) rows.push_back(entry(rank, row, i, round));
  }
  return rows;
}

void expect_copies(const std::vector<Source>& sources, const std::vector<double>& to, int numbers, int round) {
  int wrong = 0;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (int i = 0; i < numbers; ++i) {
      wrong += to[s * numbers + i] != entry(sources[s].rank, sources[s].row, i, round);
    }
  }
  EXPECT_EQ(wrong, 0) << numbers << " numbers, round " << round;
}

void copies_follow_their_sources(Communicator& ranks) {
  // Own rows, rows twice, in no order; the last rank wants none.
  std::vector<Source> sources;
  for (int rank = ranks.size() - 1; rank >= 0 && ranks.rank() < ranks.size() - 1; --rank) {
    for (int row = 0; row < rows_of(rank); row += 2) sources.push_back({rank, row});
    if (rows_of(rank) > 0) sources.push_back({rank, 0});
  }
  const auto copies = ranks.make_copies(rows_of(ranks.rank()), sources);
  int round = 0;
  for (const int numbers : {1, 4, 192, 4, 1}) {
    std::vector<double> from = array_of(ranks.rank(), numbers, ++round), to(sources.size() * numbers);
    copies->begin(from.data(), to.data(), numbers);
    copies->end(from.data(), to.data(), numbers);
    expect_copies(sources, to, numbers, round);
  }
}

void two_plans_can_be_under_way(Communicator& ranks) {
  const int next = (ranks.rank() + 1) % ranks.size();
  std::vector<Source> up, down;
  for (int row = 0; row < rows_of(next); ++row) up.push_back({next, row});
  for (int row = rows_of(next) - 1; row >= 0; --row) down.push_back({next, row});
  const auto one = ranks.make_copies(rows_of(ranks.rank()), up), two = ranks.make_copies(rows_of(ranks.rank()), down);
  const std::vector<double> a = array_of(ranks.rank(), 5, 1), b = array_of(ranks.rank(), 7, 2);
  std::vector<double> to_one(up.size() * 5), to_two(down.size() * 7);
  one->begin(a.data(), to_one.data(), 5);
  two->begin(b.data(), to_two.data(), 7);
  one->end(a.data(), to_one.data(), 5);
  two->end(b.data(), to_two.data(), 7);
  expect_copies(up, to_one, 5, 1);
  expect_copies(down, to_two, 7, 2);
}

}  // namespace

std::vector<RanksPromise> communicator_promises() {
  return {{"SumsAreAddedInTheOrderOfRanks", sums_are_added_in_the_order_of_ranks},
          {"TheLargestIsThatOfAllRanks", the_largest_is_that_of_all_ranks},
          {"GatheredBytesComeInTheOrderOfRanks", gathered_bytes_come_in_the_order_of_ranks},
          {"AllHearTheFirst", all_hear_the_first},
          {"ParcelsArriveWholeInTheOrderOfSenders", parcels_arrive_whole_in_the_order_of_senders},
          {"ValuesArePlacedOnTheFirstRank", values_are_placed_on_the_first_rank},
          {"CopiesFollowTheirSources", copies_follow_their_sources},
          {"TwoPlansCanBeUnderWay", two_plans_can_be_under_way}};
}

}  // namespace mpm
