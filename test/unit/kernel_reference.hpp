// The passes of a step once more, the shortest way: a loop over the particles, over all 3^dim nodes of each, in double
// precision, on a dense grid. No blocks, no tiles, no registers; of the kernels it shares the shape function and the
// laws alone, both with tests of their own. Weak: slow, and a small box of nodes.
// Source: GIMP notes (2.2), (2.8), (2.14), (1.26); method reference 6.2, 7.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mpm/material/law.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm::test {

/// A particle by value; position, velocity and load along grid axes.
template <class Geometry>
struct ReferenceParticle {
  using Matrix = typename Geometry::template Matrix<double>;
  using Symmetric = typename Geometry::template Symmetric<double>;
  double x[3] = {}, next_x[3] = {}, v[3] = {}, load[3] = {};
  Matrix f = Matrix::identity();
  Symmetric tau = Symmetric::isotropic(0.0);
  double history[4] = {};
  std::uint32_t id = 0;

  /// F <- exp(du) F, and the law.
  void deform(const Law& law, const Matrix& du, double dt, int terms) {
    std::visit(
        [&](const auto& kind) {
          const Matrix df = exponential(du, terms);
          const double j_old = determinant(f);
          f = std::decay_t<decltype(kind)>::kForgetsShape ? Geometry::dilatation(j_old * determinant(df))
                                                          : product(df, f);
          kind.update(Increment<double, Matrix>{du, df, f, j_old, determinant(f), dt}, tau, history);
        },
        law);
  }
};

template <class Geometry>
struct ReferenceSet {
  double mass = 0.0;             ///< of a particle [kg]
  std::array<double, 3> half{};  ///< [cells]
  const Law* law = nullptr;      ///< outlives this
  std::vector<ReferenceParticle<Geometry>> particles;
};

struct ReferenceNode {
  double mass = 0.0;
  double momentum[3] = {}, velocity[3] = {}, force[3] = {}, load[3] = {};
};

/// Of any shape function that touches the three nearest nodes along each axis (shape/ugimp.hpp).
template <class Geometry, template <class> class Shape = Ugimp>
class Reference {
  static constexpr int kDim = Geometry::kDim;
  static constexpr int kEdge = 40, kBefore = 8;  // nodes -8 to 31 along each axis

 public:
  using Set = ReferenceSet<Geometry>;
  using Particle = ReferenceParticle<Geometry>;

  Reference(const std::array<double, 3>& origin, const std::array<double, 3>& cell)
      : origin_(origin), cell_(cell), nodes_(kDim == 3 ? kEdge * kEdge * kEdge : kEdge * kEdge) {}

  std::vector<Set> sets;

  ReferenceNode& node(const std::array<int, 3>& at) {
    int index = 0;
    for (int k = 0; k < kDim; ++k) index = index * kEdge + at[k] + kBefore;
    return nodes_.at(index);
  }
  std::vector<ReferenceNode>& nodes() { return nodes_; }

  void scatter_momentum() {
    for (ReferenceNode& n : nodes_) n = {};
    each([&](const Set& set, const Particle& p) {
      each_node(set, p, [&](ReferenceNode& n, double s, const double*) { n.mass += set.mass * s; });
    });
    gather_momentum();
  }
  /// Momentum alone, as after the motion.
  void gather_momentum() {
    for (ReferenceNode& n : nodes_) std::fill(n.momentum, n.momentum + 3, 0.0);
    each([&](const Set& set, const Particle& p) {
      each_node(set, p, [&](ReferenceNode& n, double s, const double*) {
        for (int c = 0; c < kDim; ++c) n.momentum[c] += set.mass * s * p.v[c];
      });
    });
  }
  void scatter_load() {
    for (ReferenceNode& n : nodes_) std::fill(n.load, n.load + 3, 0.0);
    each([&](const Set& set, const Particle& p) {
      each_node(set, p, [&](ReferenceNode& n, double s, const double*) {
        for (int c = 0; c < kDim; ++c) n.load[c] += set.mass * s * p.load[c];
      });
    });
  }
  void nodal_velocity(double least_mass) {
    for (ReferenceNode& n : nodes_) {
      for (int c = 0; c < kDim; ++c) n.velocity[c] = n.mass > least_mass ? n.momentum[c] / n.mass : 0.0;
    }
  }
  void nodal_update(double dt, const double* gravity, double least_mass) {
    for (ReferenceNode& n : nodes_) {
      for (int c = 0; c < kDim; ++c) {
        const bool carries = n.mass > least_mass;
        n.force[c] = carries ? n.force[c] / n.mass + gravity[c] : 0.0;
        n.velocity[c] = carries ? n.momentum[c] / n.mass + n.force[c] * dt : 0.0;
      }
    }
  }
  void strain(double dt, int terms) {
    each([&](const Set& set, Particle& p) {
      double l[kDim][kDim] = {};
      each_node(set, p, [&](ReferenceNode& n, double, const double* g) {
        for (int c = 0; c < kDim; ++c) {
          for (int k = 0; k < kDim; ++k) l[c][k] += dt * n.velocity[c] * g[k];
        }
      });
      p.deform(*set.law, Geometry::gradient(l), dt, terms);
    });
  }
  void force() {
    for (ReferenceNode& n : nodes_) std::fill(n.force, n.force + 3, 0.0);
    each([&](const Set& set, const Particle& p) {
      double columns[kDim][kDim];
      for (int k = 0; k < kDim; ++k) Geometry::column(p.tau, k, columns[k]);
      each_node(set, p, [&](ReferenceNode& n, double, const double* g) {
        for (int c = 0; c < kDim; ++c) {
          for (int k = 0; k < kDim; ++k) n.force[c] -= set.mass * columns[k][c] * g[k];
        }
      });
    });
  }
  /// Velocities, and the new positions beside the old ones: method reference 6.2, beta = `flip`.
  void move(double dt, double flip) {
    each([&](const Set& set, Particle& p) {
      double after[3] = {}, a[3] = {};
      each_node(set, p, [&](ReferenceNode& n, double s, const double*) {
        for (int c = 0; c < kDim; ++c) {
          after[c] += s * n.velocity[c];
          a[c] += s * n.force[c];
        }
      });
      for (int c = 0; c < kDim; ++c) {
        const double slip = p.v[c] - (after[c] - a[c] * dt);
        p.next_x[c] = p.x[c] + (after[c] - 0.5 * (1.0 - flip) * slip) * dt - 0.5 * a[c] * dt * dt;
        p.v[c] += a[c] * dt - (1.0 - flip) * slip;
      }
    });
  }
  void place() {
    each([&](const Set&, Particle& p) { std::copy(p.next_x, p.next_x + 3, p.x); });
  }

  template <class Visit>
  void each(Visit&& visit) {
    for (Set& set : sets) {
      for (Particle& p : set.particles) visit(set, p);
    }
  }

 private:
  // visit(node, S, grad S [1/m]) for the 3^dim nodes around a particle.
  template <class Visit>
  void each_node(const Set& set, const Particle& p, Visit&& visit) {
    int nearest[3] = {};
    double s[3][3], g[3][3];
    for (int k = 0; k < kDim; ++k) {
      const double cells = (p.x[k] - origin_[k]) / cell_[k];
      nearest[k] = static_cast<int>(std::floor(cells + 0.5));
      const Shape<double> along(cells - nearest[k], {set.half[k], 1.0 / cell_[k]});
      std::copy(along.s, along.s + 3, s[k]);
      std::copy(along.g, along.g + 3, g[k]);
    }
    for (int m = 0; m < (kDim == 3 ? 27 : 9); ++m) {
      const int of[3] = {m % 3, m / 3 % 3, m / 9};
      std::array<int, 3> at{};
      double value = 1.0, gradient[3] = {1.0, 1.0, 1.0};
      for (int k = 0; k < kDim; ++k) {
        at[k] = nearest[k] + of[k] - 1;
        value *= s[k][of[k]];
        for (int j = 0; j < kDim; ++j) gradient[j] *= j == k ? g[k][of[k]] : s[k][of[k]];
      }
      visit(node(at), value, gradient);
    }
  }

  std::array<double, 3> origin_, cell_;
  std::vector<ReferenceNode> nodes_;
};

}  // namespace mpm::test
