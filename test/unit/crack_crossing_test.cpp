// Test of which ways cross a crack, in whole numbers, where every coincidence is exact: ways through crack points,
// along segments, nodes on segments. Source of the rule: crack reference 1.2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mpm/crack/crossing.hpp"

namespace mpm::test {
namespace crack_crossing_test {

using Whole = long long;
struct Spot {
  Whole x = 0, z = 0;
  bool operator==(const Spot& other) const { return x == other.x && z == other.z; }
};
using Spots = std::vector<Spot>;

Vec2 at(const Spot& spot) { return {static_cast<double>(spot.x), static_cast<double>(spot.z)}; }
std::vector<Vec2> at(const Spots& spots) {
  std::vector<Vec2> points;
  for (const Spot& spot : spots) points.push_back(at(spot));
  return points;
}

Whole area(const Spot& p, const Spot& q, const Spot& r) {
  return (q.x - p.x) * (r.z - p.z) - (q.z - p.z) * (r.x - p.x);
}

bool on_segment(const Spot& a, const Spot& b, const Spot& p) {
  return area(a, b, p) == 0 && (a.x - p.x) * (b.x - p.x) + (a.z - p.z) * (b.z - p.z) <= 0;
}

/// True if a point that is not on the closed chain is inside it, by even and odd. The ray goes far along (1000, 1), so
/// that it meets no other spot of a lattice of less than 1000 spots: each segment is met properly or not at all.
bool inside(const Spots& closed, const Spot& p) {
  const Spot far{p.x + 1000 * 1000, p.z + 1000};
  bool odd = false;
  for (std::size_t k = 0; k + 1 < closed.size(); ++k) {
    const Spot &c = closed[k], &e = closed[k + 1];
    const bool apart = (area(p, far, c) > 0) != (area(p, far, e) > 0);
    odd ^= apart && (area(c, e, p) > 0) != (area(c, e, far) > 0);
  }
  return odd;
}

bool on_chain(const Spots& chain, const Spot& p) {
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    if (on_segment(chain[k], chain[k + 1], p)) return true;
  }
  return false;
}

bool through_point(const Spots& chain, const Spot& p, const Spot& i) {
  return std::any_of(chain.begin(), chain.end(), [&](const Spot& c) { return on_segment(p, i, c); });
}

/// True if a point of a chain is a corner.
bool on_corner(const Spots& corners, const Spots& chain) {
  return std::any_of(chain.begin(), chain.end(),
                     [&](const Spot& c) { return std::find(corners.begin(), corners.end(), c) != corners.end(); });
}

/// True if a segment of a chain lies on the line through p and i.
bool runs_along(const Spots& chain, const Spot& p, const Spot& i) {
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    if (area(p, i, chain[k]) == 0 && area(p, i, chain[k + 1]) == 0) return true;
  }
  return false;
}

/// True if a segment of a chain lies on the line through an edge between corners.
bool along_edge(const Spots& corners, const Spots& chain) {
  for (std::size_t j = 0; j + 1 < corners.size(); ++j) {
    if (runs_along(chain, corners[j], corners[j + 1])) return true;
  }
  return false;
}

/// The rule that does not count a way through a crack point: what the half-open one replaces.
bool crosses_properly(const Spots& chain, const Spot& p, const Spot& i) {
  bool odd = false;
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const Spot &c = chain[k], &e = chain[k + 1];
    odd ^= area(p, i, c) * area(p, i, e) < 0 && area(c, e, p) * area(c, e, i) < 0;
  }
  return odd;
}

class Dice {
 public:
  explicit Dice(unsigned seed) : numbers_(seed) {}
  Whole whole(Whole from, Whole to) {
    return from + static_cast<Whole>(numbers_() % static_cast<unsigned long>(to - from + 1));
  }
  double real() { return static_cast<double>(numbers_()) / 4294967296.0; }

 private:
  std::mt19937 numbers_;  // the same numbers on every machine
};

/// Any closed chain of spots from 1 to 6: it may cross and touch itself.
Spots any_closed(Dice& dice) {
  Spots chain;
  const Whole points = dice.whole(3, 8);
  while (static_cast<Whole>(chain.size()) < points) {
    const Spot next{dice.whole(1, 6), dice.whole(1, 6)};
    if (chain.empty() || !(next == chain.back())) chain.push_back(next);
  }
  if (!(chain.front() == chain.back())) chain.push_back(chain.front());
  return chain;
}

/// A closed chain of even spots that does not cross itself, counter-clockwise around (8, 8); empty if there is none.
Spots simple_closed(Dice& dice) {
  Spots chain;
  for (int k = 0; k < 9; ++k) {
    const Spot next{2 * dice.whole(0, 8), 2 * dice.whole(0, 8)}, middle{8, 8};
    const bool usable = !(next == middle) && std::none_of(chain.begin(), chain.end(), [&](const Spot& one) {
      return area(middle, one, next) == 0 && (one.x - 8) * (next.x - 8) + (one.z - 8) * (next.z - 8) > 0;
    });
    if (usable) chain.push_back(next);
  }
  const auto angle = [](const Spot& s) {
    return std::atan2(static_cast<double>(s.z - 8), static_cast<double>(s.x - 8));
  };
  std::sort(chain.begin(), chain.end(), [&](const Spot& a, const Spot& b) { return angle(a) < angle(b); });
  chain.push_back(chain.front());
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    if (area({8, 8}, chain[k], chain[k + 1]) <= 0) return {};
  }
  return chain;
}

Spots lattice(Whole from, Whole to, Whole step = 1) {
  Spots spots;
  for (Whole x = from; x <= to; x += step) {
    for (Whole z = from; z <= to; z += step) spots.push_back({x, z});
  }
  return spots;
}

// The experiment of crack reference 1.2: closed chains whose points and edges are hit. Parity must tell inside from
// outside for every pair; the rule without coincidences must fail, else the experiment shows nothing.
TEST(CrackCrossing, TellsInsideFromOutsideInEveryCoincidence) {
  Dice dice(1);
  int coincidences = 0, wrong = 0, wrong_without = 0;
  for (int n = 0; n < 250; ++n) {
    const Spots chain = any_closed(dice);
    const std::vector<Vec2> line = at(chain);
    Spots free;
    std::vector<bool> is_inside;
    for (const Spot& spot : lattice(0, 7)) {
      if (on_chain(chain, spot)) continue;
      free.push_back(spot);
      is_inside.push_back(inside(chain, spot));
    }
    for (std::size_t p = 0; p < free.size(); ++p) {
      for (std::size_t i = 0; i < free.size(); ++i) {
        const bool apart = is_inside[p] != is_inside[i];
        coincidences += through_point(chain, free[p], free[i]);
        const Vec2 particle = at(free[p]), node = at(free[i]);
        wrong += find_crossing(line.data(), static_cast<int>(line.size()), particle, node).crosses != apart;
        wrong_without += crosses_properly(chain, free[p], free[i]) != apart;
      }
    }
  }
  EXPECT_GT(coincidences, 50000);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(wrong_without, 1000);
}

// Inside a chain that runs counter-clockwise is above. A node on a segment belongs to the side above, whatever particle
// asks. Not asked: particles on the continuation of the node's segment (header), and, for the side of the particle,
// ways through crack points, where the crossing nearest to the node may be one that only touches.
TEST(CrackCrossing, TellsTheSideAndPutsNodesOnTheCrackAbove) {
  Dice dice(2);
  int chains = 0, crossings = 0, on_crack = 0, wrong_side = 0, wrong_on_crack = 0;
  while (chains < 150) {
    const Spots chain = simple_closed(dice);
    if (chain.empty()) continue;
    ++chains;
    const std::vector<Vec2> line = at(chain);
    const int points = static_cast<int>(line.size());
    Spots free;
    for (const Spot& spot : lattice(-1, 17, 2)) free.push_back(spot);
    for (const Spot& spot : lattice(0, 16, 2)) free.push_back(spot);
    free.erase(std::remove_if(free.begin(), free.end(), [&](const Spot& s) { return on_chain(chain, s); }), free.end());
    for (const Spot& p : free) {
      const bool particle_inside = inside(chain, p);
      for (int n = 0; n < 10; ++n) {
        const Spot& i = free[static_cast<std::size_t>(dice.whole(0, static_cast<Whole>(free.size()) - 1))];
        const Crossing found = find_crossing(line.data(), points, at(p), at(i));
        if (!found.crosses || through_point(chain, p, i)) continue;
        ++crossings;
        wrong_side += found.above != particle_inside;
      }
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Spot middle{(chain[k].x + chain[k + 1].x) / 2, (chain[k].z + chain[k + 1].z) / 2};
        if (area(chain[k], chain[k + 1], p) == 0) continue;
        ++on_crack;
        wrong_on_crack += find_crossing(line.data(), points, at(p), at(middle)).crosses != !particle_inside;
      }
    }
  }
  EXPECT_GT(crossings, 10000);
  EXPECT_GT(on_crack, 10000);
  EXPECT_EQ(wrong_side, 0);
  EXPECT_EQ(wrong_on_crack, 0);
}

// In coordinates that double precision does not hold exactly, a node on the crack is above or below by rounding, but
// all particles must agree on it: else the first one found decides what its field is. Not asked: ways along a segment
// (header).
TEST(CrackCrossing, GivesANodeOnTheCrackOneSideForAllParticles) {
  Dice dice(6);
  const auto inexact = [](const Spot& spot) { return Vec2(0.7 + 0.1 * at(spot)[0], 0.3 + 0.1 * at(spot)[1]); };
  int above = 0, below = 0, in_two_minds = 0;
  for (int n = 0; n < 200; ++n) {
    const Spots chain = simple_closed(dice);
    if (chain.empty()) continue;
    std::vector<Vec2> line;
    for (const Spot& spot : chain) line.push_back(inexact(spot));
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const Spot middle{(chain[k].x + chain[k + 1].x) / 2, (chain[k].z + chain[k + 1].z) / 2};
      int found_above = 0, found_below = 0;
      for (const Spot& p : lattice(-1, 17, 2)) {
        if (on_chain(chain, p) || runs_along(chain, p, middle)) continue;
        const bool crosses =
            find_crossing(line.data(), static_cast<int>(line.size()), inexact(p), inexact(middle)).crosses;
        ++(crosses != inside(chain, p) ? found_above : found_below);  // inside is above
      }
      above += found_above > 0;
      below += found_below > 0;
      in_two_minds += found_above > 0 && found_below > 0;
    }
  }
  EXPECT_GT(above, 100);
  EXPECT_GT(below, 100);
  EXPECT_EQ(in_two_minds, 0);
}

/// An open chain that turns little, so that most ways cross it once, some several times.
std::vector<Vec2> open_chain(Dice& dice) {
  std::vector<Vec2> line{{0.0, 4.0}};
  for (int k = 0; k < 8; ++k) line.push_back(line.back() + Vec2(dice.real() - 0.1, 3.0 * dice.real() - 1.5));
  return line;
}

// By symmetry: walked in the other direction, or seen in a mirror, left is right. Points in general position.
TEST(CrackCrossing, IsTheSameForAReversedAndAMirroredChain) {
  Dice dice(3);
  int crossings = 0, several = 0;
  std::vector<Meeting> met;
  for (int n = 0; n < 4000; ++n) {
    const std::vector<Vec2> line = open_chain(dice);
    std::vector<Vec2> reversed(line.rbegin(), line.rend()), mirrored = line;
    for (Vec2& point : mirrored) point[0] = -point[0];
    const Vec2 particle(4.0 * dice.real(), 8.0 * dice.real()), node(4.0 * dice.real(), 8.0 * dice.real());
    const int points = static_cast<int>(line.size());
    const Crossing found = find_crossing(line.data(), points, particle, node);
    const Crossing back = find_crossing(reversed.data(), points, particle, node);
    const Crossing mirror = find_crossing(mirrored.data(), points, {-particle[0], particle[1]}, {-node[0], node[1]});
    ASSERT_EQ(back.crosses, found.crosses);
    ASSERT_EQ(mirror.crosses, found.crosses);
    const int meetings = find_meetings(line.data(), points, particle, node, met);
    ASSERT_EQ(meetings % 2 == 1, found.crosses);
    if (!found.crosses) continue;
    ++crossings;
    several += meetings > 1;
    // The last one met is the nearest to the node.
    EXPECT_EQ(found.segment, met.back().segment);
    EXPECT_EQ(back.segment, points - 2 - found.segment);
    EXPECT_EQ(mirror.segment, found.segment);
    EXPECT_NE(back.above, found.above);
    EXPECT_NE(mirror.above, found.above);
    // Round-off of sums of at most 8 segments of length below 2.
    EXPECT_LT((back.normal + found.normal).norm(), 1e-14);
    EXPECT_LT((mirror.normal + Vec2(-found.normal[0], found.normal[1])).norm(), 1e-14);
  }
  EXPECT_GT(crossings, 500);
  EXPECT_GT(several, 10);
}

// A line from (0, 0) to (4, 0) with points at whole numbers, and ways of length 1 near it; met at 0.05, near at 0.25.
TEST(CrackCrossing, FindsWhatAWayComesNear) {
  const std::vector<Vec2> line{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}};
  const auto approach = [&](const Vec2& a, const Vec2& b) {
    return find_approach(line.data(), static_cast<int>(line.size()), a, b, 0.05, 0.25);
  };
  const auto expect_met = [](const LineApproach& found, double along, const Vec2& place) {
    ASSERT_TRUE(found.found);
    EXPECT_NEAR(found.along, along, 1e-15);
    EXPECT_NEAR((found.place - place).norm(), 0.0, 1e-15);
  };
  expect_met(approach({1.5, 0.5}, {1.5, -0.5}), 0.5, {1.5, 0});   // crosses
  expect_met(approach({-0.5, 0}, {0.5, 0}), 0.5, {0, 0});         // head on, which crosses nothing
  expect_met(approach({-0.5, 0.2}, {0.5, 0.2}), 0.5, {0, 0});     // past its end, aside
  expect_met(approach({1.5, 1.2}, {1.5, 0.2}), 1.0, {1.5, 0});    // ends short of it
  expect_met(approach({1.5, 0.04}, {1.5, 1.04}), 0.0, {1.5, 0});  // has met it when it begins
  EXPECT_FALSE(approach({-0.5, 0.3}, {0.5, 0.3}).found);          // past it, too far aside
  EXPECT_FALSE(approach({1.5, 1.3}, {1.5, 0.3}).found);           // ends too far from it
  EXPECT_FALSE(approach({1.5, 0.1}, {1.5, 1.1}).found);           // begins near it and goes away
  EXPECT_FALSE(approach({-0.1, 0}, {-1.1, 0}).found);             // the same from its end
}

TEST(CrackCrossing, GivesTheNormalFromAboveToBelow) {
  const std::vector<Vec2> line{{0, 0}, {2, 0}, {4, 1}};
  const Crossing down = find_crossing(line.data(), 3, {1, 1}, {1, -1});
  EXPECT_TRUE(down.crosses);
  EXPECT_TRUE(down.above);
  EXPECT_EQ(down.segment, 0);
  EXPECT_EQ(down.normal, Vec2(0, -2));  // (e_z - c_z, c_x - e_x): downwards, as long as the segment
  const Crossing up = find_crossing(line.data(), 3, {3, -1}, {3, 2});
  EXPECT_TRUE(up.crosses);
  EXPECT_FALSE(up.above);
  EXPECT_EQ(up.segment, 1);
  EXPECT_EQ(up.normal, Vec2(1, -2));
}

// Crack reference 1.2: a way that passes beyond the tip does not cross; one exactly through it is decided by the rule,
// by which the tip counts as left of the way.
TEST(CrackCrossing, EndsAtTheTip) {
  const std::vector<Vec2> line{{0, 0}, {1, 0}, {2, 0}};
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(find_crossing(line.data(), 3, {1.75, sign}, {1.75, -sign}).crosses);
    EXPECT_FALSE(find_crossing(line.data(), 3, {2.25, sign}, {2.25, -sign}).crosses);
    EXPECT_FALSE(find_crossing(line.data(), 3, {-0.25, sign}, {-0.25, -sign}).crosses);
    // Through a point between two segments: once, from either side.
    EXPECT_TRUE(find_crossing(line.data(), 3, {1.0, sign}, {1.0, -sign}).crosses);
  }
  // Downwards the rest of the chain lies to the right, upwards to the left, where the tip counts to be.
  EXPECT_TRUE(find_crossing(line.data(), 3, {2, 1}, {2, -1}).crosses);
  EXPECT_FALSE(find_crossing(line.data(), 3, {2, -1}, {2, 1}).crosses);
  // Along the chain, on it and before it: all of them count as above.
  EXPECT_FALSE(find_crossing(line.data(), 3, {-1, 0}, {1, 0}).crosses);
  EXPECT_FALSE(find_crossing(line.data(), 3, {1, 0}, {1, 0}).crosses);
  EXPECT_FALSE(find_crossing(line.data(), 3, {1, 1}, {1, 0}).crosses);
  EXPECT_TRUE(find_crossing(line.data(), 3, {1, -1}, {1, 0}).crosses);
}

TEST(CrackMeetings, LieWhereTheWaysMeetInTheirOrder) {
  // A zigzag around z = 0 that the way along z = 0 meets in the middle of each segment, from its end to its start.
  const std::vector<Vec2> line{{0, 1}, {1, -1}, {2, 1}, {3, -1}};
  std::vector<Meeting> met;
  ASSERT_EQ(find_meetings(line.data(), 4, {4, 0}, {-1, 0}, met), 3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(met[k].segment, 2 - k);
    EXPECT_DOUBLE_EQ(met[k].along, (4.0 - (2.5 - k)) / 5.0);
    EXPECT_DOUBLE_EQ(met[k].along_segment, 0.5);
  }
  EXPECT_EQ(find_meetings(line.data(), 4, {4, 2}, {-1, 2}, met), 0);
  EXPECT_TRUE(met.empty());

  Dice dice(4);
  int several = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::vector<Vec2> chain = open_chain(dice);
    const Vec2 a(4.0 * dice.real(), 8.0 * dice.real()), b(4.0 * dice.real(), 8.0 * dice.real());
    several += find_meetings(chain.data(), static_cast<int>(chain.size()), a, b, met) > 1;
    double before = 0.0;
    for (const Meeting& one : met) {
      EXPECT_GE(one.along, before);
      before = one.along;
      const Vec2 on_way = a + one.along * (b - a), from = chain[one.segment], to = chain[one.segment + 1];
      // Round-off of places below 10, grown where way and segment are nearly parallel.
      const double sine = std::abs(double_area(a, b, b + (to - from))) / ((b - a).norm() * (to - from).norm());
      EXPECT_LT((on_way - (from + one.along_segment * (to - from))).norm(), 1e-14 / sine);
    }
  }
  EXPECT_GT(several, 10);
}

// Around a rectangle of grid lines with one end of the chain inside and one outside, the chain is met an odd number of
// times, whatever crack points lie on the lines and whatever nodes on the crack: none is lost or counted twice. With
// both ends outside, or both inside, an even number. Not asked: crack points on its corners, segments along its edges
// (header).
TEST(CrackMeetings, AroundAContourAreOddWithOneTipInside) {
  Dice dice(5);
  const Spots corners{{2, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 2}};
  Spots nodes;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    for (Whole n = 0; n < 4; ++n) {
      const Spot &from = corners[k], &to = corners[k + 1];
      nodes.push_back({from.x + (to.x - from.x) / 4 * n, from.z + (to.z - from.z) / 4 * n});
    }
  }
  nodes.push_back(corners.front());
  int touching = 0, odd = 0, wrong = 0;
  std::vector<Meeting> met;
  for (int n = 0; n < 20000; ++n) {
    Spots chain;
    while (chain.size() < 5) {
      const Spot next{dice.whole(0, 8), dice.whole(0, 8)};
      if (chain.empty() || !(next == chain.back())) chain.push_back(next);
    }
    if (on_chain(corners, chain.front()) || on_chain(corners, chain.back())) continue;
    if (on_corner(corners, chain) || along_edge(corners, chain)) continue;
    const std::vector<Vec2> line = at(chain);
    int meetings = 0;
    bool touches = false;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      meetings += find_meetings(line.data(), 5, at(nodes[k]), at(nodes[k + 1]), met);
      touches = touches || on_chain(chain, nodes[k]) || through_point(chain, nodes[k], nodes[k + 1]);
    }
    const bool ends_apart = inside(corners, chain.front()) != inside(corners, chain.back());
    touching += touches;
    odd += ends_apart;
    wrong += (meetings % 2 == 1) != ends_apart;
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(odd, 2000);
  EXPECT_EQ(wrong, 0);
}

}  // namespace crack_crossing_test
}  // namespace mpm::test
