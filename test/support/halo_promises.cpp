// Particles of two bodies, each in a velocity field of its own, which overlap so that ranks meet at blocks that one of
// them has in the one field only. What particles give to nodes is compared with the sums of one process that has them
// all.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mpm/grid/each_share.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/ranks/lists.hpp"
#include "ranks_promises.hpp"

namespace mpm {
namespace {

constexpr int kFields = 2;
constexpr int kParticles = 500;

GridLayout layout_of(int dim, bool periodic) {
  GridLayout layout(dim, Vec3::Constant(0.1), Vec3::Zero(), Vec3(dim == 3 ? 2.4 : 4.8, 0.8, dim == 3 ? 1.2 : 2.0));
  if (periodic) layout.make_periodic(0);
  return layout;
}

struct Point {
  int field;
  std::array<double, 3> at;  ///< [cells]
  double mass;

  double velocity(int k) const { return std::sin(100.0 * mass + k); }
};

/// The bodies in a round: they move along x through the ranks. Masses differ by orders, so that the order of sums
/// shows.
std::vector<Point> material(const GridLayout& layout, int round) {
  std::vector<Point> points;
  for (int i = 0; i < kParticles; ++i) {
    Point point{i % kFields, {}, std::ldexp(1.0 + std::fmod(0.37 * i, 1.0), i % 19)};
    for (int k = 0; k < layout.dim(); ++k) {
      const double extent = 0.45 * layout.last_node(k);
      const double low = k == 0 ? 0.25 * extent * point.field + 0.3 * extent * round : 0.0;
      const double whole = std::fmod(i * (0.618 + 0.23 * k) + 0.1 * k, 1.0);
      point.at[k] = std::fmod(low + extent * whole, layout.last_node(k));
    }
    points.push_back(point);
  }
  return points;
}

std::array<int, 3> block_of(const GridLayout& layout, const Point& point) {
  std::array<int, 3> block{};
  for (int k = 0; k < layout.dim(); ++k) block[k] = GridLayout::nearest(point.at[k]) / kBlockEdge;
  return block;
}

/// visit(key, node of the block, weight) for every node that a particle gives to, by linear shape functions.
template <class Visit>
void each_weight(const GridLayout& layout, const Point& point, Visit&& visit) {
  const std::array<int, 3> owner = block_of(layout, point);
  for (int s = 0; s < neighbours_of(layout.dim()); ++s) {
    std::array<int, 3> block = owner;
    int rest = s;
    for (int k = layout.dim() - 1; k >= 0; --k, rest /= 3) block[k] += rest % 3 - 1;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      const std::array<int, 3> node = layout.node(block, n);
      double weight = 1.0;
      for (int k = 0; k < layout.dim(); ++k) weight *= std::max(0.0, 1.0 - std::abs(point.at[k] - node[k]));
      if (weight > 0.0) visit(layout.key(block), n, weight);
    }
  }
}

/// A block of a field.
struct Place {
  std::uint64_t field, key;
  bool operator<(const Place& other) const { return std::tie(field, key) < std::tie(other.field, other.key); }
  bool operator==(const Place& other) const { return field == other.field && key == other.key; }
};
using Node = std::tuple<std::uint64_t, std::uint64_t, int>;

/// Sums that nodes get from all particles: mass, and momentum along the axes.
std::map<Node, std::array<double, 4>> sums_of_one_process(const GridLayout& layout, const std::vector<Point>& points) {
  std::map<Node, std::array<double, 4>> sums;
  for (const Point& point : points) {
    each_weight(layout, point, [&](std::uint64_t key, int node, double weight) {
      std::array<double, 4>& sum = sums[{point.field, key, node}];
      sum[0] += weight * point.mass;
      for (int k = 0; k < layout.dim(); ++k) sum[k + 1] += weight * point.mass * point.velocity(k);
    });
  }
  return sums;
}

/// One rank's part of the run.
class Part {
 public:
  Part(Communicator& ranks, const GridLayout& layout)
      : ranks_(ranks),
        layout_(layout),
        territory_(layout, ranks.size()),
        halo_(ranks, territory_),
        fields_(make_fields(layout, kFields)) {}

  /// Takes its particles, and meets the others; blocks with the coordinates of a tool are everywhere.
  void meet(const std::vector<Point>& points, const Halo::Everywhere& everywhere) {
    std::map<std::uint64_t, std::uint64_t> load;
    for (const Point& point : points) ++load[layout_.key(block_of(layout_, point))];
    territory_.cut({load.begin(), load.end()}, [](double*, int) {});
    own_.clear();
    std::array<std::set<std::uint64_t>, kFields> owners;
    for (const Point& point : points) {
      const std::uint64_t key = layout_.key(block_of(layout_, point));
      if (territory_.owner(key) != ranks_.rank()) continue;
      own_.push_back(point);
      owners[point.field].insert(key);
    }
    uses_.clear();
    for (std::size_t f = 0; f < kFields; ++f) {
      Grid& grid = *fields_[f];
      grid.rebuild({owners[f].begin(), owners[f].end()});
      for (int b = 0; b < grid.blocks.size(); ++b) uses_.push_back({f, grid.blocks.key(b)});
    }
    halo_.meet(fields_, everywhere);
    check_blocks(everywhere);
  }

  void spread() {
    for (const auto& grid : fields_) {
      for (NodalField* values : {&grid->mass, &grid->momentum}) {
        std::fill_n(values->data(),
                    static_cast<std::size_t>(grid->blocks.size()) * values->components() * values->nodes_per_block(),
                    0.0);
      }
    }
    std::size_t given = 0;
    const auto give = [&](int field, const BlockShares& owners) {
      owners.by_colour("loop", 1, [&](int owner) { given += give_of(field, owner); });
    };
    for (int f = 0; f < kFields; ++f) {
      give(f, halo_.at_border(f));
      halo_.begin(f, {&fields_[f]->mass, &fields_[f]->momentum});
    }
    for (int f = 0; f < kFields; ++f) {
      give(f, halo_.inside(f));
      halo_.end(f, {&fields_[f]->mass, &fields_[f]->momentum});
    }
    EXPECT_EQ(given, own_.size()) << "owners are not either at the border or inside";
  }

  /// All nodes that this rank has hold the sums of one process, and all ranks have the same bits.
  void check_sums(const std::vector<Point>& points) const {
    const auto expected = sums_of_one_process(layout_, points);
    struct Told {
      std::uint64_t field, key, node;
      double values[4];
    };
    std::vector<Told> own;
    double worst = 0.0;
    for (std::size_t f = 0; f < kFields; ++f) {
      const Grid& grid = *fields_[f];
      for (int b = 0; b < grid.blocks.size(); ++b) {
        for (int n = 0; n < layout_.nodes_per_block(); ++n) {
          Told told{f, grid.blocks.key(b), static_cast<std::uint64_t>(n), {grid.mass.at(b, 0, n)}};
          for (int k = 0; k < layout_.dim(); ++k) told.values[k + 1] = grid.momentum.at(b, k, n);
          const auto found = expected.find({f, told.key, n});
          const std::array<double, 4> sum = found == expected.end() ? std::array<double, 4>{} : found->second;
          // Momentum may cancel; the mass bounds what was added, since speeds are at most 1 m/s.
          for (int i = 0; i < 4; ++i) {
            const double error = std::abs(told.values[i] - sum[i]);
            worst = std::max(worst, sum[0] > 0.0 ? error / sum[0] : error);
          }
          own.push_back(told);
        }
      }
    }
    EXPECT_LT(worst, 1e-14);  // some dozen numbers in another order
    std::map<Node, Told> first;
    int different = 0;
    for (const Told& told : gather_list(ranks_, own)) {
      const Node node{told.field, told.key, static_cast<int>(told.node)};
      const Told& known = first.try_emplace(node, told).first->second;
      different += std::memcmp(known.values, told.values, sizeof(told.values)) != 0;
    }
    EXPECT_EQ(different, 0) << "bits that ranks do not have alike";
    EXPECT_GE(first.size(), expected.size()) << "nodes that nobody has";
  }

  const Halo& halo() const { return halo_; }

 private:
  /// Gives to nodes what the particles of an owner have. Returns their number.
  std::size_t give_of(int field, int owner) {
    Grid& grid = *fields_[field];
    const std::array<int, 3>& place = grid.blocks.block(grid.blocks.owner_block(owner));
    std::size_t given = 0;
    for (const Point& point : own_) {
      if (point.field != field || block_of(layout_, point) != place) continue;
      ++given;
      each_weight(layout_, point, [&](std::uint64_t key, int node, double weight) {
        const int block = grid.blocks.find(key);
        grid.mass.at(block, 0, node) += weight * point.mass;
        for (int k = 0; k < layout_.dim(); ++k) {
          grid.momentum.at(block, k, node) += weight * point.mass * point.velocity(k);
        }
      });
    }
    return given;
  }

  /// A rank has the blocks that its particles reach in all fields that any rank has them in, and those of tools; each
  /// counts on one rank.
  void check_blocks(const Halo::Everywhere& everywhere) const {
    const std::vector<Place> used = gather_list(ranks_, uses_);
    std::set<std::uint64_t> own_keys;
    for (const auto& [field, key] : uses_) own_keys.insert(key);
    std::set<Place> expected, found;
    for (const auto& [field, key] : used) {
      if (own_keys.count(key) > 0 || everywhere(layout_.block(key))) expected.insert({field, key});
    }
    std::vector<Place> counted;
    for (std::size_t f = 0; f < kFields; ++f) {
      const Grid& grid = *fields_[f];
      for (int b = 0; b < grid.blocks.size(); ++b) {
        found.insert({f, grid.blocks.key(b)});
        if (grid.counts(b)) counted.push_back({f, grid.blocks.key(b)});
      }
    }
    EXPECT_EQ(found, expected);
    std::vector<Place> all = gather_list(ranks_, counted);
    std::sort(all.begin(), all.end());
    const std::set<Place> anywhere(used.begin(), used.end());
    EXPECT_EQ(all, std::vector<Place>(anywhere.begin(), anywhere.end())) << "blocks do not count once each";
  }

  Communicator& ranks_;
  const GridLayout& layout_;
  Territory territory_;
  Halo halo_;
  Fields fields_;
  std::vector<Point> own_;
  std::vector<Place> uses_;  ///< before ranks have met
};

void nodes_hold_the_sums_of_one_process(Communicator& ranks) {
  for (const auto& [dim, periodic] : {std::pair{1, false}, {2, false}, {2, true}, {3, false}}) {
    const GridLayout layout = layout_of(dim, periodic);
    Part part(ranks, layout);
    for (int round = 0; round < 3; ++round) {
      const std::vector<Point> points = material(layout, round);
      // A tool in the middle of the domain, and none in the last round.
      part.meet(points, [&](const std::array<int, 3>& block) {
        return round < 2 && std::abs(block[0] - layout.last_node(0) / (2 * kBlockEdge)) <= 1;
      });
      part.spread();
      part.check_sums(points);
    }
    const double received = static_cast<double>(part.halo().numbers_received());
    EXPECT_EQ(ranks.sum(received) > 0.0, ranks.size() > 1);
  }
}

void ranks_without_particles_take_part(Communicator& ranks) {
  const GridLayout layout = layout_of(2, false);
  std::vector<Point> points = material(layout, 0);
  points.resize(1);
  Part part(ranks, layout);
  part.meet(points, [](const std::array<int, 3>&) { return false; });
  part.spread();
  part.check_sums(points);
  part.meet({}, [](const std::array<int, 3>&) { return false; });
  part.spread();
  part.check_sums({});
}

}  // namespace

std::vector<RanksPromise> halo_promises() {
  return {{"NodesHoldTheSumsOfOneProcess", nodes_hold_the_sums_of_one_process},
          {"RanksWithoutParticlesTakePart", ranks_without_particles_take_part}};
}

}  // namespace mpm
