// Impulses and energies that walls, gravity and mean stresses give and take: sums of the nodes in a step, and over
// steps.
#pragma once

#include <array>

#include "mpm_gpu/wall_account.hpp"

namespace mpm_gpu {

/// Impulses on the material [N s], along the grid's axes, and energies taken from it [J], since the start.
struct Impulses {
  /// The wall at a face of the domain, 2 * axis, + 1 for the upper one.
  struct OfFace {
    double impulse[3] = {}, exchanged = 0.0;  ///< exchanged: sum over steps of the size of a step's impulse
    double friction = 0.0, held = 0.0;        ///< taken by friction; of motion that is held up
  };
  double gravity[3] = {};
  OfFace face[6] = {};
  double averaged = 0.0;  ///< taken by mean stresses

  Impulses& operator+=(const Impulses& other) {
    for (int c = 0; c < 3; ++c) gravity[c] += other.gravity[c];
    for (int f = 0; f < 6; ++f) {
      for (int c = 0; c < 3; ++c) face[f].impulse[c] += other.face[f].impulse[c];
      face[f].exchanged += other.face[f].exchanged;
      face[f].friction += other.face[f].friction;
      face[f].held += other.face[f].held;
    }
    averaged += other.averaged;
    return *this;
  }

  /// Impulse of all walls.
  std::array<double, 3> walls() const {
    std::array<double, 3> sum{};
    for (const OfFace& one : face) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += one.impulse[k];
    }
    return sum;
  }
};

/// Sums of the nodes in a step.
struct SumsOfNodes {
  struct OfFace {
    double given[3];
    mpm::SurfaceLoss loss;
  };
  OfFace face[6];
  double mass, averaged;
  constexpr SumsOfNodes& operator+=(const SumsOfNodes& other) {
    for (int f = 0; f < 6; ++f) {
      for (int k = 0; k < 3; ++k) face[f].given[k] += other.face[f].given[k];
      face[f].loss += other.face[f].loss;
    }
    mass += other.mass;
    averaged += other.averaged;
    return *this;
  }
};
/// A node's part of them, of which most have no wall.
template <int Dim>
struct SumsOfNode {
  const WallAccount<Dim>* walls;
  long node;
  bool carries;
  friend constexpr SumsOfNodes& operator+=(SumsOfNodes& sum, const SumsOfNode& one) {
    const NodeView& nodes = one.walls->nodes;
    if (nodes.averaged != nullptr) sum.averaged += nodes.averaged[one.node];
    if (!one.carries) return sum;
    sum.mass += nodes.mass[one.node];
    one.walls->each(one.node, [&](int face, const double* given, const mpm::SurfaceLoss& loss) {
      for (int k = 0; k < Dim; ++k) sum.face[face].given[k] += given[k];
      sum.face[face].loss += loss;
    });
    return sum;
  }
};
/// Adds a step of `dt` [s] to the sums over steps.
template <int Dim>
struct AddImpulses {
  const SumsOfNodes* step;
  Impulses* sums;
  double gravity[3], dt;

  void operator()(long) const {
    for (int c = 0; c < Dim; ++c) sums->gravity[c] += step->mass * gravity[c] * dt;
    for (int f = 0; f < 2 * Dim; ++f) {
      const auto& [given, loss] = step->face[f];
      Impulses::OfFace& face = sums->face[f];
      double square = 0.0;
      for (int c = 0; c < Dim; ++c) {
        face.impulse[c] += given[c];
        square += given[c] * given[c];
      }
      face.exchanged += __builtin_sqrt(square);
      face.friction += loss.friction;
      face.held += loss.held;
    }
    sums->averaged += step->averaged;
  }
};

}  // namespace mpm_gpu
