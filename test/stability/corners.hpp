// How well the domains of neighbouring particles fit together. Particles start on a lattice, where four domains meet at
// a corner; each carries its own F, and finds the corner from its own place: x + F R. In a uniform deformation the four
// find one point. In any other they part by what is beyond the linear, and by every error in x and F.
// The domains are whole here: without the cut that keeps them in reach (kernel/domain.hpp).
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scenes.hpp"

namespace stability {

/// Where a particle is, in the plane [m], and how it is deformed.
struct Placed {
  Eigen::Vector2d x;
  Eigen::Matrix2d f;
};

struct Fit {
  double parted = 0.0;   ///< largest distance of the places where two domains see the corner that they share [m]
  double tangled = 0.0;  ///< part of the domains whose corners, means of what the four see, are no convex quadrilateral
};

class LatticeCorners {
 public:
  /// `start`: places of the lattice, `spacing` [m] apart; the corners that four particles inside share are looked at.
  LatticeCorners(const std::vector<Vec3>& start, double spacing, const std::function<bool(const Vec3&)>& inside)
      : half_(0.5 * spacing) {
    Places particle_at, corner_at;
    for (std::size_t p = 0; p < start.size(); ++p) {
      if (!inside(start[p])) continue;
      particle_at[{std::lround(start[p].x() / spacing - 0.5), std::lround(start[p].z() / spacing - 0.5)}] = p;
    }
    for (const auto& [place, particle] : particle_at) {
      if (const auto four = square(particle_at, place)) {
        corner_at[place] = corners_.size();
        corners_.push_back(*four);
      }
    }
    for (const auto& [place, corner] : corner_at) {
      if (const auto four = square(corner_at, place)) domains_.push_back(*four);
    }
  }

  Fit fit(const std::vector<Placed>& particles) const {
    Fit fit;
    std::vector<Eigen::Vector2d> mean(corners_.size());
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      std::array<Eigen::Vector2d, 4> seen;
      for (int n = 0; n < 4; ++n) {
        const Placed& one = particles[corners_[c][n]];
        // Seen from the first of the four the corner is the upper right one, from the third the lower left one.
        seen[n] = one.x + one.f * (half_ * Eigen::Vector2d(1 - 2 * kSide[n][0], 1 - 2 * kSide[n][1]));
        for (int m = 0; m < n; ++m) fit.parted = std::max(fit.parted, (seen[n] - seen[m]).norm());
      }
      mean[c] = 0.25 * (seen[0] + seen[1] + seen[2] + seen[3]);
    }
    std::size_t tangled = 0;
    for (const auto& four : domains_) {
      bool right = true;  // counter-clockwise at each corner: the bilinear map onto it has a Jacobian above 0
      for (int n = 0; n < 4; ++n) {
        const Eigen::Vector2d a = mean[four[(n + 1) % 4]] - mean[four[n]];
        const Eigen::Vector2d b = mean[four[(n + 3) % 4]] - mean[four[n]];
        right = right && a.x() * b.y() - a.y() * b.x() > 0.0;
      }
      if (!right) ++tangled;
    }
    fit.tangled = static_cast<double>(tangled) / static_cast<double>(domains_.size());
    return fit;
  }

 private:
  using Places = std::map<std::pair<long, long>, std::size_t>;
  using Four = std::array<std::size_t, 4>;

  /// What is at `place` and its neighbours to the right, above both and above, when all are there.
  static std::optional<Four> square(const Places& at, const std::pair<long, long>& place) {
    Four four{};
    for (int n = 0; n < 4; ++n) {
      const auto found = at.find({place.first + kSide[n][0], place.second + kSide[n][1]});
      if (found == at.end()) return {};
      four[n] = found->second;
    }
    return four;
  }

  static constexpr int kSide[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  double half_;
  std::vector<Four> corners_;  // particles that share each, counter-clockwise
  std::vector<Four> domains_;  // corners of each, counter-clockwise
};

}  // namespace stability
