// The fit of the domains of neighbouring particles. Particles start on a lattice, where four domains meet at a corner;
// each has its own F and computes the corner from its own position, x + F R. In a uniform deformation the four agree.
// In any other they differ by the nonlinear part, and by every error in x and F. Domains are whole here, without the
// limit that keeps them in reach (kernel/domain.hpp).
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

/// Position of a particle in the plane [m], and its deformation.
struct Placed {
  Eigen::Vector2d x;
  Eigen::Matrix2d f;
};

struct Fit {
  double parted = 0.0;   ///< largest distance between the positions of a shared corner in two domains [m]
  double tangled = 0.0;  ///< part of the domains that are not convex, with corners at the mean of four positions
};

class LatticeCorners {
 public:
  /// `start`: positions of the lattice, `spacing` [m] apart; corners that four particles inside share are evaluated.
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
        // For the first of the four the corner is the upper right one, for the third the lower left one.
        seen[n] = one.x + one.f * (half_ * Eigen::Vector2d(1 - 2 * kSide[n][0], 1 - 2 * kSide[n][1]));
        for (int m = 0; m < n; ++m) fit.parted = std::max(fit.parted, (seen[n] - seen[m]).norm());
      }
      mean[c] = 0.25 * (seen[0] + seen[1] + seen[2] + seen[3]);
    }
    std::size_t tangled = 0;
    for (const auto& four : domains_) {
      bool right = true;  // counter-clockwise at each corner: the bilinear map onto it has a positive Jacobian
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

  /// The particles at `place` and to its right, upper right and above, if all exist.
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
  std::vector<Four> corners_;  // particles that share each corner, counter-clockwise
  std::vector<Four> domains_;  // corners of each domain, counter-clockwise
};

}  // namespace stability
