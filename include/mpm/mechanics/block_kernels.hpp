// What happens to the particles of one block, one pass a function. A step (USF) is, for every block of every colour,
//
//   scatter_momentum    tile of m, m v        <-  particles' mass and velocity, by S
//   gather_gradient     grad v of a chunk     <-  tile of v, by G
//   (the law)           F, tau of the chunk   <-  grad v dt
//   scatter_force       tile of f             <-  -m tau G                          GIMP notes (1.26)
//   gather_motion       v, x of the particles <-  tile of v and a, by S             GIMP notes (2.15), (2.16)
//
// USAVG adds scatter_velocity and a second gather_gradient and law with half the time step each; loads on particles add
// scatter_load.
// Particles of one body and one block are a chunk at a time, [begin, begin + count) of its arrays.
#pragma once

#include <array>
#include <type_traits>

#include "mpm/material/increment.hpp"
#include "mpm/math/exponential.hpp"
#include "mpm/mechanics/stencil.hpp"

namespace mpm {

template <class Geometry, template <class> class Shape>
struct BlockKernels {
  static constexpr int kDim = Geometry::kDim;
  static constexpr int kChunk = 64;
  static constexpr double kSlack = 1e-6;  ///< [cells]
  using Weights = Stencil<kDim, Shape>;
  using MassMomentumTile = Tile<kDim, kDim + 1>;
  using VectorTile = Tile<kDim, kDim>;
  using MotionTile = Tile<kDim, 2 * kDim>;  ///< velocity, acceleration

  /// Velocity gradients of a chunk, as stored components.
  struct Gradients {
    double l[kDim][kDim][kChunk];
  };

  struct Block {
    const GridLayout& layout;
    std::array<int, 3> corner;  ///< node numbers of the tile's lower corner
  };

  /// pass(block, owner, its neighbours) for every block that holds particles, a colour after the other.
  template <class Pass>
  static void each_owner(const Grid& grid, int threads, Pass&& pass) {
    const BlockTable& blocks = grid.blocks;
    for (int colour = 0; colour < blocks.colours(); ++colour) {
      const std::vector<int>& owners = blocks.owners_of_colour(colour);
      const int count = static_cast<int>(owners.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
      for (int i = 0; i < count; ++i) {
        const int owner = owners[i];
        Block block{grid.layout, {}};
        for (int k = 0; k < kDim; ++k) {
          block.corner[k] = blocks.block(blocks.owner_block(owner))[k] * kBlockEdge - kTileMargin;
        }
        pass(block, owner, blocks.neighbours(owner));
      }
    }
  }

  /// Momentum [N s] and, last, mass [kg].
  static void scatter_momentum(const Block& block, const ParticleSet& set, int begin, int end, MassMomentumTile& tile) {
    const auto v = velocities(set);
    for (int p = begin; p < end; ++p) {
      const Weights w(block.layout, set, block.corner, p);
      double value[kDim + 1];
      for (int c = 0; c < kDim; ++c) value[c] = set.mass * v[c][p];
      value[kDim] = set.mass;
      scatter_values<kDim + 1>(w, value, tile.data);
    }
  }

  /// Momentum alone [N s].
  static void scatter_velocity(const Block& block, const ParticleSet& set, int begin, int end, VectorTile& tile) {
    const auto v = velocities(set);
    for (int p = begin; p < end; ++p) {
      const Weights w(block.layout, set, block.corner, p);
      double value[kDim];
      for (int c = 0; c < kDim; ++c) value[c] = set.mass * v[c][p];
      scatter_values<kDim>(w, value, tile.data);
    }
  }

  /// grad v [1/s] of a chunk: sum of v_i (x) G_ip; GIMP notes (2.2).
  static void gather_gradient(const Block& block, const ParticleSet& set, int begin, int count, const VectorTile& tile,
                              Gradients& gradients) {
    for (int q = 0; q < count; ++q) {
      const Weights w(block.layout, set, block.corner, begin + q);
      double l[kDim][kDim] = {};
      w.each_row([&](int first, double s, const double* across) {
        double plain[kDim] = {}, along[kDim] = {};
        for (int n = 0; n < 3; ++n) {
          for (int c = 0; c < kDim; ++c) {
            plain[c] += w.s[kDim - 1][n] * tile.data[first + n][c];
            along[c] += w.g[kDim - 1][n] * tile.data[first + n][c];
          }
        }
        for (int c = 0; c < kDim; ++c) {
          for (int k = 0; k < kDim - 1; ++k) l[c][k] += across[k] * plain[c];
          l[c][kDim - 1] += s * along[c];
        }
      });
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) gradients.l[c][k][q] = l[c][k];
      }
    }
  }

  /// Deformation gradient and stress of a chunk. Returns the first place whose J is not positive, or count.
  template <class LawType>
  static int update_stress(const LawType& law, ParticleSet& set, int begin, int count, const Gradients& gradients,
                           double dt, int terms) {
    double* f[Geometry::kMatrix];
    double* tau[Geometry::kSymmetric];
    double* history[LawType::kHistory + 1];
    for (int c = 0; c < Geometry::kMatrix; ++c) f[c] = set.f[c].template data<double>() + begin;
    for (int c = 0; c < Geometry::kSymmetric; ++c) tau[c] = set.tau[c].template data<double>() + begin;
    for (int c = 0; c < LawType::kHistory; ++c) history[c] = set.history[c].template data<double>() + begin;
    int bad = count;
    for (int q = 0; q < count; ++q) {
      double l[kDim][kDim];
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) l[c][k] = gradients.l[c][k][q] * dt;
      }
      const auto du = Geometry::gradient(l);
      const auto old = Geometry::load_matrix(f, q);
      const auto df = exponential(du, terms);
      const double j_old = determinant(old);
      auto now = product(df, old);
      if constexpr (LawType::kForgetsShape) now = Geometry::dilatation(j_old * determinant(df));
      const double j = determinant(now);
      auto stress = Geometry::load_symmetric(tau, q);
      double scalars[LawType::kHistory + 1];
      for (int c = 0; c < LawType::kHistory; ++c) scalars[c] = history[c][q];
      law.update(Increment<double, std::decay_t<decltype(du)>>{du, df, now, j_old, j, dt}, stress, scalars);
      for (int c = 0; c < LawType::kHistory; ++c) history[c][q] = scalars[c];
      Geometry::store_matrix(now, f, q);
      Geometry::store_symmetric(stress, tau, q);
      if (!(j > 0.0) && bad == count) bad = q;
    }
    return bad;
  }

  /// Internal force [N] from tau [J/kg].
  static void scatter_force(const Block& block, const ParticleSet& set, int begin, int end, VectorTile& tile) {
    const double* tau[Geometry::kSymmetric];
    for (int c = 0; c < Geometry::kSymmetric; ++c) tau[c] = set.tau[c].template data<double>();
    for (int p = begin; p < end; ++p) {
      const Weights w(block.layout, set, block.corner, p);
      const auto stress = Geometry::load_symmetric(tau, p);
      double column[kDim][kDim];
      for (int k = 0; k < kDim; ++k) {
        Geometry::column(stress, k, column[k]);
        for (int c = 0; c < kDim; ++c) column[k][c] *= -set.mass;
      }
      w.each_row([&](int first, double s, const double* across) {
        double plain[kDim], along[kDim];
        for (int c = 0; c < kDim; ++c) {
          plain[c] = 0.0;
          for (int k = 0; k < kDim - 1; ++k) plain[c] += across[k] * column[k][c];
          along[c] = s * column[kDim - 1][c];
        }
        for (int n = 0; n < 3; ++n) {
          for (int c = 0; c < kDim; ++c) {
            tile.data[first + n][c] += w.s[kDim - 1][n] * plain[c] + w.g[kDim - 1][n] * along[c];
          }
        }
      });
    }
  }

  /// External force [N] from an acceleration [m/s^2] of each particle of the set: sum of m b S_ip, GIMP notes (1.27).
  static void scatter_load(const Block& block, const ParticleSet& set, const std::vector<std::vector<double>>& b,
                           int begin, int end, VectorTile& tile) {
    for (int p = begin; p < end; ++p) {
      const Weights w(block.layout, set, block.corner, p);
      double value[kDim];
      for (int c = 0; c < kDim; ++c) value[c] = set.mass * b[c][p];
      scatter_values<kDim>(w, value, tile.data);
    }
  }

  /// Velocity of the particles in place, position into `x_new`. `flip`: FLIP fraction.
  /// Returns false when a particle has left the reach of the block or the place where it may be, or is not finite.
  static bool gather_motion(const Block& block, ParticleSet& set, int begin, int end, const MotionTile& tile, double dt,
                            double flip, std::vector<PaddedArray<double>>& x_new) {
    double* v[kDim];
    for (int c = 0; c < kDim; ++c) v[c] = set.v[c].template data<double>();
    bool within = true;
    for (int p = begin; p < end; ++p) {
      const Weights w(block.layout, set, block.corner, p);
      double motion[2 * kDim] = {};
      w.each_row([&](int first, double s, const double*) {
        double row[2 * kDim] = {};
        for (int n = 0; n < 3; ++n) {
          for (int c = 0; c < 2 * kDim; ++c) row[c] += w.s[kDim - 1][n] * tile.data[first + n][c];
        }
        for (int c = 0; c < 2 * kDim; ++c) motion[c] += s * row[c];
      });
      for (int c = 0; c < kDim; ++c) {
        const double velocity = motion[c], acceleration = motion[kDim + c];
        const double slip = (1.0 - flip) * (v[c][p] - (velocity - acceleration * dt));
        const double x = set.x[c][p] + dt * (velocity - 0.5 * slip - 0.5 * dt * acceleration);
        v[c][p] += acceleration * dt - slip;
        x_new[c][p] = x;
        // The nearest node must keep a neighbour on each side in the tile; the slack covers rounding to that node.
        const double cells = block.layout.in_cells(c, x), in_tile = cells - block.corner[c];
        within = within && in_tile >= 0.5 + kSlack && in_tile <= kTileEdge - 1.5 - kSlack && cells >= set.lowest[c] &&
                 cells <= set.highest[c];
      }
    }
    return within;
  }

 private:
  static std::array<const double*, kDim> velocities(const ParticleSet& set) {
    std::array<const double*, kDim> v;
    for (int c = 0; c < kDim; ++c) v[c] = set.v[c].template data<double>();
    return v;
  }

  template <int Components>
  static void scatter_values(const Weights& w, const double (&value)[Components], double (*data)[Components]) {
    w.each_row([&](int first, double s, const double*) {
      double row[Components];
      for (int c = 0; c < Components; ++c) row[c] = s * value[c];
      for (int n = 0; n < 3; ++n) {
        for (int c = 0; c < Components; ++c) data[first + n][c] += w.s[kDim - 1][n] * row[c];
      }
    });
  }
};

}  // namespace mpm
