// Helpers that tests of a crack's chain share: motions of all its points.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "mpm/crack/chain.hpp"

namespace mpm::test {
namespace crack_chain_test {

inline constexpr std::array<CrackEnd, 2> kTips{CrackEnd::tip, CrackEnd::tip};
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Move = Chain::Move;
using Motions = std::vector<SurfaceMotion>;

inline Motions all(const Chain& chain, const SurfaceMotion& motion) { return Motions(chain.points().size(), motion); }

/// Moves the surfaces by displacements, in one second from rest.
inline void displace(Chain& chain, const std::vector<Vec2>& above, const std::vector<Vec2>& below) {
  Motions up, down;
  for (const Vec2& way : above) up.push_back({way, Vec2::Zero(), true});
  for (const Vec2& way : below) down.push_back({way, Vec2::Zero(), true});
  ASSERT_EQ(chain.move(up.data(), down.data(), nullptr, 1.0, Move::average, kInfinity), 0);
}

}  // namespace crack_chain_test
}  // namespace mpm::test
