// An independent implementation of the passes of a step, in the shortest form: a loop over particles and all nodes of
// each, in double precision, on a dense grid, without blocks, tiles or registers. It shares only the shape functions
// and the laws with the kernels; both have their own tests. It is slow and limited to a small box of nodes. Source:
// GIMP notes (2.2), (2.8), (2.14), (1.26); method reference 6.1, 6.2, 6.6, 7.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernel_stencil.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

namespace mpm::test {

/// A particle by value; position and velocity along grid axes. `load`: what a test gives it.
template <class Geometry>
struct ReferenceParticle {
  double mass = 0.0;  ///< [kg]
  using Matrix = typename Geometry::template Matrix<double>;
  using Symmetric = typename Geometry::template Symmetric<double>;
  double x[3] = {}, next_x[3] = {}, v[3] = {}, load[3] = {};
  double damping[2] = {};    ///< rates of damping on the grid's and on its own velocity [1/s]
  double affine[3][3] = {};  ///< APIC: B [m^2/s]
  double domain[3][3] = {};  ///< F at the start of the step
  Matrix f = Matrix::identity();
  Symmetric tau = Symmetric::isotropic(0.0);
  double history[4] = {};
  double hoop_force = 0.0;  ///< for rings, the radial force of the hoop stress on all nodes, from force() [N]
  std::uint32_t id = 0;

  /// Sets F <- exp(du) F and evaluates the law.
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
  std::array<double, 3> half{};  ///< half edges of a particle's box [cells]
  const Law* law = nullptr;      ///< must outlive the set
  std::vector<ReferenceParticle<Geometry>> particles;
};

struct ReferenceNode {
  double mass = 0.0;
  double momentum[3] = {}, velocity[3] = {}, force[3] = {};
  double load[3] = {};              ///< the sum over particles of their load, weighted
  double from[3] = {}, to[3] = {};  ///< the projected velocity [m/s], and its momentum on the way back
  double mean = 0.0;                ///< mean of a trace
};

/// Momentum and energy removed by damping in a motion (mpm_kernel::Moved).
struct ReferenceDrag {
  double drag[3] = {};  ///< [N s]
  double grid_kinetic = 0.0, particle_kinetic = 0.0;
};

template <class Geometry>
class Reference {
  static constexpr int kDim = Geometry::kDim;
  static constexpr int kEdge = 40, kBefore = 8;  // nodes -8 to 31 along each axis

 public:
  using Set = ReferenceSet<Geometry>;
  using Particle = ReferenceParticle<Geometry>;

  Reference(ShapeKind shape, const ReferenceGrid& grid)
      : shape_(shape),
        grid_(grid),
        nodes_(kDim == 3   ? kEdge * kEdge * kEdge
               : kDim == 2 ? kEdge * kEdge
                           : kEdge) {}

  std::vector<Set> sets;
  bool by_point = false;  ///< rings move with the grid's radial velocity at their positions: AxisMotion::point

  ReferenceNode& node(const std::array<int, 3>& at) {
    int index = 0;
    for (int k = 0; k < kDim; ++k) index = index * kEdge + at[k] + kBefore;
    return nodes_.at(index);
  }
  std::vector<ReferenceNode>& nodes() { return nodes_; }

  /// Fixes the domains of the step and spreads mass and momentum, with the affine field of APIC if `affine`.
  void scatter_momentum(bool affine = false) {
    for (ReferenceNode& n : nodes_) n = {};
    each([&](const Set&, Particle& p) { note_domain(p); });
    each([&](const Set& set, const Particle& p) {
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double*) { n.mass += p.mass * s; });
    });
    gather_momentum(affine);
  }
  /// Spreads momentum alone, as after the motion.
  void gather_momentum(bool affine = false) {
    clear(&ReferenceNode::momentum);
    each([&](const Set& set, const Particle& p) {
      double gradient[3][3] = {};
      if (affine) affine_gradient(set, p, gradient);
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double* arm) {
        for (int c = 0; c < kDim; ++c) {
          double v = p.v[c];
          for (int k = 0; k < kDim; ++k) v += gradient[c][k] * arm[k];
          n.momentum[c] += p.mass * s * v;
        }
      });
    });
  }
  /// Sets to = sum of m S (S from).
  void project() {
    clear(&ReferenceNode::to);
    each([&](const Set& set, const Particle& p) {
      double v[3] = {};
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double*) {
        for (int c = 0; c < kDim; ++c) v[c] += s * n.from[c];
      });
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double*) {
        for (int c = 0; c < kDim; ++c) n.to[c] += p.mass * s * v[c];
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
  /// Adds the increments of XPIC (from the initial velocity) or FMPM of this order to nodal velocities, method
  /// reference 6.6.
  void add_increments(int order, bool from_start, double least_mass) {
    for (ReferenceNode& n : nodes_) {
      for (int c = 0; c < kDim; ++c) {
        const double start = n.mass > least_mass ? n.momentum[c] / n.mass : 0.0;
        n.from[c] = from_start ? start : n.velocity[c];
      }
    }
    for (int j = 1; j < order; ++j) {
      project();
      for (ReferenceNode& n : nodes_) {
        for (int c = 0; c < kDim; ++c) {
          if (n.mass > least_mass) n.from[c] -= n.to[c] / n.mass;
          n.velocity[c] += n.from[c];
        }
      }
    }
  }
  /// Strains the particles, with dilatation averaged over the grid (kernel/mean.hpp) if `average`.
  void strain(double dt, int terms, bool average = false) {
    const auto gradient = [&](const Set& set, const Particle& p) {
      Diagonal l;
      each_weight(set, p, [&](ReferenceNode& n, const NodeWeight& w) {
        for (int c = 0; c < kDim; ++c) {
          for (int k = 0; k < kDim; ++k) l.of_plane[c][k] += n.velocity[c] * w.g[k];
        }
        l.hoop += n.velocity[0] * w.t;
      });
      return l;
    };
    if (average) find_mean([&](const Set& set, const Particle& p) { return gradient(set, p).trace(); });
    each([&](const Set& set, Particle& p) {
      Diagonal l = gradient(set, p);
      if (average) l.set_trace(mean_at(set, p));
      for (auto& row : l.of_plane) {
        for (double& component : row) component *= dt;
      }
      auto du = Geometry::gradient(l.of_plane);
      if constexpr (Geometry::kHoop) du.yy = l.hoop * dt;
      p.deform(*set.law, du, dt, terms);
    });
  }
  void force(bool average = false) {
    const auto stress = [](const Particle& p) {
      Diagonal tau;
      for (int k = 0; k < kDim; ++k) Geometry::column(p.tau, k, tau.of_plane[k]);
      if constexpr (Geometry::kHoop) tau.hoop = p.tau.yy;
      return tau;
    };
    if (average) find_mean([&](const Set&, const Particle& p) { return stress(p).trace(); });
    clear(&ReferenceNode::force);
    each([&](const Set& set, Particle& p) {
      Diagonal tau = stress(p);
      if (average) tau.set_trace(mean_at(set, p));
      p.hoop_force = 0.0;
      each_weight(set, p, [&](ReferenceNode& n, const NodeWeight& w) {
        for (int c = 0; c < kDim; ++c) {
          for (int k = 0; k < kDim; ++k) n.force[c] -= p.mass * tau.of_plane[k][c] * w.g[k];
        }
        n.force[0] -= p.mass * tau.hoop * w.t;
        p.hoop_force -= p.mass * tau.hoop * w.t;
      });
    });
  }
  /// Updates velocities and computes new positions beside the old ones. kIncrement: method reference 6.2, beta =
  /// `flip`; the others: 6.6. Damping with each particle's rates: 6.1.
  ReferenceDrag move(mpm_kernel::Motion motion, double dt, double flip) {
    ReferenceDrag taken;
    each([&](const Set& set, Particle& p) {
      double after[3] = {}, a[3] = {}, b[3][3] = {};
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double* arm) {
        for (int c = 0; c < kDim; ++c) {
          after[c] += s * n.velocity[c];
          a[c] += s * n.force[c];
          for (int k = 0; k < kDim; ++k) b[c][k] += s * n.velocity[c] * arm[k];
        }
      });
      for (int c = 0; c < kDim; ++c) {
        const double old = p.v[c], seen = motion == mpm_kernel::kIncrement ? after[c] - a[c] * dt : after[c];
        const double drag = p.damping[0] * seen + p.damping[1] * old;
        taken.drag[c] += p.mass * drag * dt;
        taken.grid_kinetic += 0.5 * p.mass * seen * seen;
        taken.particle_kinetic += 0.5 * p.mass * old * old;
        if (motion == mpm_kernel::kIncrement) {
          const double slip = old - seen;
          p.next_x[c] = p.x[c] + (after[c] - 0.5 * (1.0 - flip) * slip) * dt - 0.5 * (a[c] + drag) * dt * dt;
          p.v[c] += a[c] * dt - (1.0 - flip) * slip - drag * dt;
          continue;
        }
        p.v[c] = after[c] - drag * dt;
        p.next_x[c] = p.x[c] + (motion == mpm_kernel::kAdopt ? 0.5 * (old + p.v[c]) : p.v[c]) * dt;
        if (motion == mpm_kernel::kAffine) std::copy(b[c], b[c] + 3, p.affine[c]);
      }
      if (by_point) p.next_x[0] += to_point(set, p, motion, dt) - to_mean(motion, after[0], a[0], dt);
    });
    return taken;
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

  /// Calls visit(node, S, grad S [1/m], x_i - x_p [m]) for all nodes that a particle reaches. About an axis, where S
  /// does not reproduce linear fields, the last argument is relative to the mean position of S in place of x_p.
  template <class Visit>
  void each_node(const Set& set, const Particle& p, Visit&& visit) {
    double centre[3] = {p.x[0], p.x[1], p.x[2]};
    if constexpr (Geometry::kHoop) {
      std::fill(centre, centre + kDim, 0.0);
      each_weight(set, p, [&](ReferenceNode&, const NodeWeight& w) {
        for (int k = 0; k < kDim; ++k) centre[k] += w.s * grid_.position(k, w.at[k]);
      });
    }
    each_weight(set, p, [&](ReferenceNode& n, const NodeWeight& w) {
      double arm[3] = {};
      for (int k = 0; k < kDim; ++k) arm[k] = grid_.position(k, w.at[k]) - centre[k];
      visit(n, w.s, w.g, arm);
    });
  }
  /// Calls visit(node, weight) for these nodes.
  template <class Visit>
  void each_weight(const Set& set, const Particle& p, Visit&& visit) {
    const ReferenceStencil<kDim> stencil(shape_, grid_, place_of(set, p));
    for (const NodeWeight& w : stencil.nodes()) visit(node(w.at), w);
  }
  static ReferencePlace place_of(const Set& set, const Particle& p) {
    ReferencePlace place{{p.x[0], p.x[1], p.x[2]}, set.half, {}};
    std::copy(&p.domain[0][0], &p.domain[0][0] + 9, &place.f[0][0]);
    return place;
  }
  static void note_domain(Particle& p) {
    double m[Geometry::kMatrix], *to[Geometry::kMatrix];
    for (int c = 0; c < Geometry::kMatrix; ++c) to[c] = m + c;
    Geometry::store_matrix(p.f, to, 0);
    for (int c = 0; c < kDim; ++c) std::copy(m + c * kDim, m + (c + 1) * kDim, p.domain[c]);
  }
  ShapeKind shape() const { return shape_; }
  const ReferenceGrid& grid() const { return grid_; }

 private:
  /// A gradient or a stress in the grid's axes. The hoop component is additional, and zero except in axisymmetry.
  struct Diagonal {
    static constexpr int kCount = kDim + (Geometry::kHoop ? 1 : 0);
    double of_plane[kDim][kDim] = {}, hoop = 0.0;
    double trace() const {
      double sum = Geometry::kHoop ? hoop : 0.0;
      for (int k = 0; k < kDim; ++k) sum += of_plane[k][k];
      return sum;
    }
    void set_trace(double wanted) {
      const double change = (wanted - trace()) / kCount;
      for (int k = 0; k < kDim; ++k) of_plane[k][k] += change;
      if (Geometry::kHoop) hoop += change;
    }
  };
  // Displacement of a particle by a velocity and an acceleration of the grid in move().
  static double to_mean(mpm_kernel::Motion motion, double v, double a, double dt) {
    return v * dt - (motion == mpm_kernel::kIncrement ? 0.5 * a * dt * dt : 0.0);
  }
  // Displacement along the radius, by the hat functions at the position (for products, those along the radius alone).
  double to_point(const Set& set, const Particle& p, mpm_kernel::Motion motion, double dt) {
    double v = 0.0, a = 0.0;
    each_weight(set, p, [&](ReferenceNode& n, const NodeWeight& w) {
      v += w.point * n.velocity[0];
      a += w.point * n.force[0];
    });
    return to_mean(motion, v, a, dt);
  }
  // Mean of of(set, particle) at the nodes, weighted by mass.
  template <class Of>
  void find_mean(Of&& of) {
    for (ReferenceNode& n : nodes_) n.mean = 0.0;
    each([&](const Set& set, const Particle& p) {
      const double value = of(set, p);
      each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double*) {
        n.mean += n.mass > 0.0 ? p.mass * s * value / n.mass : 0.0;
      });
    });
  }
  double mean_at(const Set& set, const Particle& p) {
    double mean = 0.0;
    each_node(set, p, [&](ReferenceNode& n, double s, const double*, const double*) { mean += s * n.mean; });
    return mean;
  }
  // B D^-1 [1/s], D = sum of S (x_i - x_p) (x_i - x_p)^T.
  void affine_gradient(const Set& set, const Particle& p, double (&gradient)[3][3]) {
    using Matrix = Eigen::Matrix<double, kDim, kDim>;
    Matrix b, d = Matrix::Zero();
    each_node(set, p, [&](ReferenceNode&, double s, const double*, const double* arm) {
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) d(c, k) += s * arm[c] * arm[k];
      }
    });
    for (int c = 0; c < kDim; ++c) {
      for (int k = 0; k < kDim; ++k) b(c, k) = p.affine[c][k];
    }
    const Matrix l = b * d.inverse();
    for (int c = 0; c < kDim; ++c) {
      for (int k = 0; k < kDim; ++k) gradient[c][k] = l(c, k);
    }
  }
  void clear(double (ReferenceNode::*field)[3]) {
    for (ReferenceNode& n : nodes_) std::fill(n.*field, n.*field + 3, 0.0);
  }

  ShapeKind shape_;
  ReferenceGrid grid_;
  std::vector<ReferenceNode> nodes_;
};

}  // namespace mpm::test
