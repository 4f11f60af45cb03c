// A crack's chain: its ends, openings and lengths, its motion, surfaces put back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "crack_chain_check.hpp"
#include "mpm/crack/chain.hpp"
#include "mpm/crack/crossing.hpp"

namespace mpm::test {
namespace crack_chain_test {

TEST(CrackChain, LengthensExteriorEndsOnly) {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {1, 2}};
  EXPECT_EQ(Chain(points, kTips, false).line(), points);
  // By 4 times the last segment (crack reference 1.4).
  Chain chain(points, {CrackEnd::exterior, CrackEnd::exterior}, false);
  EXPECT_EQ(chain.line(), (std::vector<Vec2>{{-4, 0}, {1, 0}, {1, 10}}));
  chain.set_end(1, CrackEnd::none);
  EXPECT_EQ(chain.line(), (std::vector<Vec2>{{-4, 0}, {1, 0}, {1, 2}}));
  EXPECT_EQ(Chain({{0, 0}, {1, 0}}, {CrackEnd::exterior, CrackEnd::exterior}, false).line(),
            (std::vector<Vec2>{{-4, 0}, {5, 0}}));
  // It moves with the chain, and the list is not allocated anew.
  const Vec2* where = chain.line().data();
  displace(chain, {{1, 1}, {1, 1}, {1, 1}}, {{1, 1}, {1, 1}, {1, 1}});
  EXPECT_EQ(chain.line(), (std::vector<Vec2>{{-3, 1}, {2, 1}, {2, 3}}));
  EXPECT_EQ(chain.line().data(), where);
}

TEST(CrackChain, KnowsDirectionsAndThePartsOfPoints) {
  const Chain chain({{0, 0}, {1, 0}, {1, 3}}, kTips, false);
  EXPECT_EQ(chain.direction(0), Vec2(-1, 0));  // backwards along the chain
  EXPECT_EQ(chain.direction(1), Vec2(0, 1));
  EXPECT_LT((chain.tangent(1) - std::sqrt(0.5) * Vec2(1, 1)).norm(), 1e-15);
  EXPECT_EQ(chain.tangent_area(0), Vec2(0.5, 0));
  EXPECT_EQ(chain.tangent_area(1), Vec2(0.5, 1.5));
  EXPECT_EQ(chain.tangent_area(2), Vec2(0, 1.5));
  // On a straight chain they sum to its length (crack reference 5.4).
  const Chain straight({{0, 0}, {3, 4}, {6, 8}, {6.6, 8.8}}, kTips, false);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += straight.tangent_area(k).norm();
  EXPECT_NEAR(sum, 11.0, 1e-14);
}

TEST(CrackChain, MeasuresLengthsBetweenItsSurfaces) {
  Chain chain({{0, 0}, {1, 0}, {2, 0}, {4, 0}}, kTips, false);
  EXPECT_DOUBLE_EQ(chain.length(), 4.0);
  EXPECT_DOUBLE_EQ(chain.open_length([](int) { return false; }), 0.0);
  // Halves of its two segments: 0.5 + 1 belong to point 2, and 1 to point 3.
  EXPECT_DOUBLE_EQ(chain.open_length([](int point) { return point == 2; }), 1.5);
  EXPECT_DOUBLE_EQ(chain.open_length([](int point) { return point >= 2; }), 2.5);
  // Opened by the same on both sides the middles stay; above alone by (0, 2 x), the middles lie on z = x.
  displace(chain, {{0, 1}, {0, 1}, {0, 1}, {0, 1}}, {{0, -1}, {0, -1}, {0, -1}, {0, -1}});
  EXPECT_DOUBLE_EQ(chain.length(), 4.0);
  Chain bent({{0, 0}, {1, 0}, {2, 0}, {4, 0}}, kTips, false);
  displace(bent, {{0, 0}, {0, 2}, {0, 4}, {0, 8}}, {{0, 0}, {0, 0}, {0, 0}, {0, 0}});
  EXPECT_DOUBLE_EQ(bent.length(), 4.0 * std::sqrt(2.0));
}

// Openings of a tip: (1, 4, 1) / 6 of the three points behind it (crack reference 3.5), in its own frame.
TEST(CrackChain, AveragesTheOpeningBehindATip) {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  const std::vector<Vec2> below(4, Vec2::Zero());
  Chain chain(points, kTips, false);
  // Above minus below: (0.1, 1), (0.2, 2), (0.3, 5), (0.4, 6) at points 0 to 3.
  displace(chain, {{0.1, 1}, {0.2, 2}, {0.3, 5}, {0.4, 6}}, below);
  EXPECT_LT((chain.opening(2) - Vec2(0.3, 5)).norm(), 1e-15);  // round-off
  // At the end the left side is the one above. The points have moved, by half the openings: the end tip's direction is
  // along (1.05, 0.5), the start tip's along (-1.05, -0.5).
  const Vec2 ahead = Vec2(1.05, 0.5).normalized(), left(-ahead[1], ahead[0]);
  const Vec2 mean_end(1.2 / 6.0, 14.0 / 6.0);  // (0.3 + 4 * 0.2 + 0.1) / 6, (5 + 4 * 2 + 1) / 6
  EXPECT_LT((chain.tip_opening(1) - Vec2(mean_end.dot(left), mean_end.dot(ahead))).norm(), 1e-14);
  // At the start the left side is the one below: below minus above, in a frame turned by 180 degrees there. Seen so, an
  // opening is positive at both tips, and a slip of the upper face to the right too.
  const Vec2 back = Vec2(-1.05, -0.5).normalized(), left_back(-back[1], back[0]);
  const Vec2 mean_start(1.8 / 6.0, 28.0 / 6.0);  // (0.2 + 4 * 0.3 + 0.4) / 6, (2 + 4 * 5 + 6) / 6
  EXPECT_LT((chain.tip_opening(0) - Vec2(-mean_start.dot(left_back), -mean_start.dot(back))).norm(), 1e-14);
  EXPECT_GT(chain.tip_opening(0)[0], 0.0);
  EXPECT_GT(chain.tip_opening(1)[0], 0.0);
  // Fewer than four points: the one next to the tip.
  Chain three({{0, 0}, {1, 0}, {2, 0}}, kTips, false);
  displace(three, {{0, 0}, {0.25, 0.5}, {0, 0}}, {{0, 0}, {-0.25, -0.5}, {0, 0}});
  EXPECT_EQ(three.tip_opening(1), Vec2(1, 0.5));
  EXPECT_EQ(three.tip_opening(0), Vec2(1, 0.5));
}

// A reversed chain is the same crack: its tips change places, above and below too, and openings stay what they are.
TEST(CrackChain, HasTheSameTipOpeningsReversed) {
  const std::vector<Vec2> points{{0, 0}, {1, 0.2}, {2, 0.1}, {3, -0.3}, {4, -0.2}};
  const std::vector<Vec2> up{{0, 0}, {0.1, 0.3}, {0.2, 0.5}, {0.05, 0.3}, {0, 0}};
  const std::vector<Vec2> down{{0, 0}, {-0.1, -0.2}, {0.1, -0.4}, {0, -0.1}, {0, 0}};
  Chain chain(points, kTips, false), reversed({points.rbegin(), points.rend()}, kTips, false);
  displace(chain, up, down);
  displace(reversed, {down.rbegin(), down.rend()}, {up.rbegin(), up.rend()});
  for (const int end : {0, 1}) {
    EXPECT_LT((chain.tip_opening(end) - reversed.tip_opening(1 - end)).norm(), 1e-15) << end;
    EXPECT_LT((chain.direction(end) - reversed.direction(1 - end)).norm(), 1e-15) << end;
  }
  EXPECT_DOUBLE_EQ(chain.length(), reversed.length());
}

// x = x_0 + V t + 1/2 a t^2 in every step (crack reference 3.2), of both rules for the plane, from the first step on.
TEST(CrackChain, MovesExactlyAtConstantVelocityAndAcceleration) {
  const Vec2 before(2.0, -1.0);
  const double dt = 0.125;
  for (const Move by : {Move::average, Move::centre_of_mass}) {
    for (const Vec2& acceleration : {Vec2(0, 0), Vec2(-4.0, 8.0)}) {
      Chain chain({{0, 0}, {1, 0}, {2, 1}}, kTips, false);
      for (int step = 1; step <= 8; ++step) {
        const double t = step * dt;
        const Motions motion = all(chain, {before + t * acceleration, acceleration, true});
        ASSERT_EQ(chain.move(motion.data(), motion.data(), motion.data(), dt, by, kInfinity), 0);
        const Vec2 way = t * before + 0.5 * t * t * acceleration;
        for (const CrackPoint& point : chain.points()) {
          // Exact: all numbers are short in binary.
          EXPECT_EQ(point.place, point.start + way);
          EXPECT_EQ(point.above, point.place);
          EXPECT_EQ(point.below, point.place);
          EXPECT_EQ(point.velocity, before + t * acceleration);
        }
      }
    }
  }
}

// dt (3/2 V - 1/2 V_before - a dt) with an acceleration that is not the difference of the velocities.
TEST(CrackChain, MovesByTheThreeTermsOfThePublishedRule) {
  Chain chain({{0, 0}, {1, 0}}, kTips, false);
  const Motions first = all(chain, {{1.0, 0.0}, {0.0, 0.0}, true}),
                second = all(chain, {{3.0, 2.0}, {1.0, -1.0}, true});
  chain.move(first.data(), first.data(), nullptr, 0.5, Move::average, kInfinity);
  chain.move(second.data(), second.data(), nullptr, 0.5, Move::average, kInfinity);
  // 0.5 * 1 + 0.5 * (4.5 - 0.5 - 0.5) and 0.5 * (3 - 0 + 0.5)
  EXPECT_EQ(chain.points()[0].place, Vec2(2.25, 1.75));
}

TEST(CrackChain, MovesASideWithoutMaterialWithTheOther) {
  const SurfaceMotion up{{0.0, 1.0}, {0.0, 0.0}, true}, down{{0.0, -1.0}, {0.0, 0.0}, true}, nothing;
  Chain chain({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, kTips, false);
  const Motions above{up, nothing, nothing, up}, below{nothing, down, nothing, down}, centre{nothing, up, nothing, up};
  chain.move(above.data(), below.data(), nullptr, 0.5, Move::average, kInfinity);
  const auto expect = [&chain](int k, double of_above, double of_below, double of_place) {
    EXPECT_EQ(chain.points()[k].above, Vec2(k, of_above)) << k;
    EXPECT_EQ(chain.points()[k].below, Vec2(k, of_below)) << k;
    EXPECT_EQ(chain.points()[k].place, Vec2(k, of_place)) << k;
  };
  EXPECT_EQ(chain.points()[0].velocity, Vec2(0, 1));  // both sides have it
  expect(0, 0.5, 0.5, 0.5);
  expect(1, -0.5, -0.5, -0.5);
  expect(2, 0.0, 0.0, 0.0);
  expect(3, 0.5, -0.5, 0.0);
  // A side that meets nodes again goes on from their velocity, not from one that it did not have of them.
  const Motions all_up = all(chain, {{0.0, 2.0}, {0.0, 0.0}, true});
  chain.move(all_up.data(), all_up.data(), nullptr, 0.5, Move::average, kInfinity);
  EXPECT_EQ(chain.points()[0].above, Vec2(0, 0.5 + 0.5 * (3.0 - 0.5)));
  EXPECT_EQ(chain.points()[0].below, Vec2(0, 0.5 + 0.5 * 2.0));
  // By the centre of mass the place follows that, and rests where it finds none.
  Chain other({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, kTips, false);
  other.move(above.data(), below.data(), centre.data(), 0.5, Move::centre_of_mass, kInfinity);
  EXPECT_EQ(other.points()[0].place, Vec2(0, 0));
  EXPECT_EQ(other.points()[1].place, Vec2(1, 0.5));
  EXPECT_EQ(other.points()[3].place, Vec2(3, 0.5));
  EXPECT_EQ(other.points()[0].above, Vec2(0, 0.5));
}

TEST(CrackChain, StopsMovesThatAreTooFar) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Chain chain({{0, 0}, {1, 0}, {2, 0}}, kTips, false);
  const SurfaceMotion slow{{0.0, 1.0}, {0.0, 0.0}, true}, fast{{0.0, 5.0}, {0.0, 0.0}, true},
      broken{{nan, 0.0}, {0.0, 0.0}, true};
  const Motions above{fast, slow, broken}, below{slow, slow, slow};
  EXPECT_EQ(chain.move(above.data(), below.data(), nullptr, 1.0, Move::average, 2.0), 2);
  EXPECT_EQ(chain.points()[0].above, Vec2(0, 0));
  EXPECT_EQ(chain.points()[0].below, Vec2(0, 1));
  EXPECT_EQ(chain.points()[0].place, Vec2(0, 0.5));
  EXPECT_EQ(chain.points()[0].velocity_above, Vec2(0, 0));
  EXPECT_EQ(chain.points()[1].above, Vec2(1, 1));
  EXPECT_EQ(chain.points()[2].above, Vec2(2, 0));
  // Forgets what stopped it: the next step is that of a constant velocity.
  EXPECT_EQ(chain.move(below.data(), below.data(), nullptr, 1.0, Move::average, 2.0), 0);
  EXPECT_EQ(chain.points()[0].above, Vec2(0, 1));
}

TEST(CrackChain, DoesNotMoveIfFixed) {
  Chain chain({{0, 0}, {1, 0}}, kTips, true);
  const Motions motion = all(chain, {{1.0, 1.0}, {0.0, 0.0}, true});
  EXPECT_EQ(chain.move(motion.data(), motion.data(), motion.data(), 1.0, Move::average, 0.1), 0);
  for (const CrackPoint& point : chain.points()) {
    EXPECT_EQ(point.place, point.start);
    EXPECT_EQ(point.above, point.start);
  }
  EXPECT_EQ(chain.prevent(), 0);
}

// Crossings tell the sides of nodes from a point just off the chain, also where it bends sharply.
TEST(CrackChain, LooksFromBesideItsSurfaces) {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {1.2, 0.9}, {0.9, 0.2}};
  const Chain chain(points, kTips, false);
  for (int k = 0; k < 4; ++k) {
    for (const bool above : {true, false}) {
      const Vec2 from = chain.beside(k, above);
      for (const int segment : {k - 1, k}) {
        if (segment < 0 || segment > 2) continue;
        EXPECT_EQ(double_area(points[segment], points[segment + 1], from) > 0.0, above) << k << segment;
      }
      EXPECT_LT((from - points[k]).norm(), 1e-8);  // bound for segments not longer than 1
    }
  }
}

/// One segment's surface, above at its end point, displaced while the plane stays.
Vec2 put_back(const std::vector<Vec2>& points, int k, bool above, const Vec2& way, int expected) {
  Chain chain(points, kTips, false);
  const Motions still = all(chain, {Vec2::Zero(), Vec2::Zero(), true});
  Motions moved = still;
  moved[k].velocity = way;
  chain.move(above ? moved.data() : still.data(), above ? still.data() : moved.data(), still.data(), 1.0,
             Move::centre_of_mass, kInfinity);
  EXPECT_EQ(chain.prevent(), expected);
  EXPECT_EQ(chain.prevent(), 0);  // keeps what is put back
  return above ? chain.points()[k].above : chain.points()[k].below;
}

// Crack reference 3.4. What is put back lies on the segment to 1e-12 of its length, on its own side.
TEST(CrackChain, PutsSurfacesBack) {
  const std::vector<Vec2> straight{{0, 0}, {1, 0}, {2, 0}};
  for (const double side : {1.0, -1.0}) {
    const bool above = side > 0.0;
    const auto expect = [&](const Vec2& way, int expected, const Vec2& place) {
      for (int k = 0; k < 3; ++k) {
        const Vec2 found = put_back(straight, k, above, {way[0], side * way[1]}, expected);
        // A foot beyond an end of the chain goes to the end.
        const double x = expected == 0 ? k + place[0] : std::clamp(k + place[0], 0.0, 2.0);
        EXPECT_LT((found - Vec2(x, side * place[1])).norm(), 2e-12) << k << above;
        if (expected > 0) {
          EXPECT_GT(side * found[1], 0.0);
        }
      }
    };
    expect({0.25, 0.1}, 0, {0.25, 0.1});     // on its side
    expect({0.25, -0.1}, 1, {0.25, 0.0});    // through
    expect({-0.25, -0.1}, 1, {-0.25, 0.0});  // through, before its point
    expect({0.25, -0.9e-5}, 0, {0.25, -0.9e-5});
    expect({0.25, -1.1e-5}, 1, {0.25, 0.0});
    expect({0.0, -1.01}, 0, {0.0, -1.01});  // farther than the segment is long
    expect({0.0, -0.99}, 1, {0.0, 0.0});
  }
}

TEST(CrackChain, PutsSurfacesBackAtBends) {
  // It bends to the left by 90 degrees: above is the inner corner.
  const std::vector<Vec2> left{{-1, 0}, {0, 0}, {0, 1}};
  EXPECT_EQ(put_back(left, 1, true, {-0.25, 0.125}, 0), Vec2(-0.25, 0.125));
  EXPECT_LT((put_back(left, 1, true, {-0.25, -0.125}, 1) - Vec2(-0.25, 0)).norm(), 2e-12);
  EXPECT_LT((put_back(left, 1, true, {0.125, 0.25}, 1) - Vec2(0, 0.25)).norm(), 2e-12);
  EXPECT_LT((put_back(left, 1, true, {0.125, -0.25}, 1) - Vec2(0, 0)).norm(), 2e-12);  // around the corner
  // Outside the corner, where it is on the wrong side of the continuation of one segment only: that is its place.
  EXPECT_EQ(put_back(left, 1, false, {-0.25, -0.125}, 0), Vec2(-0.25, -0.125));
  EXPECT_EQ(put_back(left, 1, false, {0.125, 0.25}, 0), Vec2(0.125, 0.25));
  EXPECT_EQ(put_back(left, 1, false, {0.125, -0.25}, 0), Vec2(0.125, -0.25));
  // In the inner corner: to the nearer segment.
  EXPECT_LT((put_back(left, 1, false, {-0.25, 0.125}, 1) - Vec2(-0.25, 0)).norm(), 2e-12);
  EXPECT_LT((put_back(left, 1, false, {-0.125, 0.25}, 1) - Vec2(0, 0.25)).norm(), 2e-12);
  // A sharp bend to the right: straight above the corner is above, though it is right of the second segment's line.
  EXPECT_EQ(put_back({{-1, 0}, {0, 0}, {-0.5, -0.5}}, 1, true, {0, 0.25}, 0), Vec2(0, 0.25));
  EXPECT_EQ(put_back({{-0.5, -0.5}, {0, 0}, {-1, 0}}, 1, false, {0, 0.25}, 0), Vec2(0, 0.25));
  // The depth that is let be is relative: the same chain in millimetres.
  std::vector<Vec2> small = left;
  for (Vec2& point : small) point *= 1e-3;
  EXPECT_LT((put_back(small, 1, true, {-0.25e-3, -1.1e-8}, 1) - Vec2(-0.25e-3, 0)).norm(), 2e-15);
  EXPECT_LT((put_back(small, 1, true, {-0.25e-3, -0.9e-8}, 0) - Vec2(-0.25e-3, -0.9e-8)).norm(), 1e-18);  // round-off
}

}  // namespace crack_chain_test
}  // namespace mpm::test
