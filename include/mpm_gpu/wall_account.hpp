// Account of the walls at a node in a step: the impulses that they gave, and the energy that they took, by the solver's
// own formulas (mpm/step/surface_loss.hpp) as mpm/boundary/wall.cpp uses them. For nodes on walls alone, after
// the step's passes: state of contact is kept in NodeView, and changes for the strain are found again from the
// velocities that were gathered.
#pragma once

#include "mpm/step/surface_loss.hpp"
#include "mpm_gpu/walls.hpp"

namespace mpm_gpu {

/// A vector along the grid's axes.
template <int Dim>
struct Along {
  double c[Dim];

  static Along Zero() { return {}; }
  double dot(const Along& other) const {
    double sum = 0.0;
    for (int k = 0; k < Dim; ++k) sum += c[k] * other.c[k];
    return sum;
  }
  Along& operator+=(const Along& other) {
    for (int k = 0; k < Dim; ++k) c[k] += other.c[k];
    return *this;
  }
  friend Along operator*(double factor, Along a) {
    for (int k = 0; k < Dim; ++k) a.c[k] *= factor;
    return a;
  }
  friend Along operator+(Along a, const Along& b) { return a += b; }
  friend Along operator-(const Along& a, const Along& b) { return a + -1.0 * b; }
};

template <int Dim>
struct WallAccount {
  using Vector = Along<Dim>;

  GridView grid;
  NodeView nodes;
  const double* at_end;        ///< momentum gathered at the end of the step; null with USF [N s]
  const double* moved_at_end;  ///< NodeView::moved of the end of the step
  double dt;                   ///< [s]
  double strain_at_start;      ///< part of the strain that sees the velocities of the step's start

  /// book(face, impulse by component, energy taken) for each wall at a node.
  template <class Book>
  void each(long node, Book&& book) const {
    int number[3];
    number_of_node(grid, Dim, nodes.key, node, number);
    Rubbing rubs{};
    bool begun = false;
    each_wall_at<Dim>(grid, number, [&](int face) {
      double given[Dim];
      for (int c = 0; c < Dim; ++c) {
        given[c] = of_wall(nodes.held, face, node, number, c);
        if (nodes.held_more != nullptr) given[c] += of_wall(nodes.held_more, face, node, number, c);
      }
      if (grid.faces[face] != Face::frictional) {
        book(face, given, mpm::SurfaceLoss{0.0, held_up(face, node, number)});
        return;
      }
      if (!begun) rubs = begin(node, number);
      begun = true;
      book(face, given, rubbed(face, node, rubs));
    });
  }

 private:
  /// Velocities at a node as frictional walls find them, one after another [m/s].
  struct Rubbing {
    Vector at_start, at_end, left;
  };

  Vector of(const double* field, long node, double factor) const {
    Vector vector;
    for (int c = 0; c < Dim; ++c) vector.c[c] = factor * field[c * nodes.nodes + node];
    return vector;
  }
  /// Component of an impulse that is kept in the row of a wall, or in one row for all.
  double of_wall(const double* held, int face, long node, const int* number, int c) const {
    const bool one = nodes.held_rows == 1;
    if (one && holding_face(grid, Dim, number, c) != face) return 0.0;
    return held[((one ? 0 : face / 2) * Dim + c) * nodes.nodes + node];
  }
  /// Change by contact of a velocity between two acts of a wall that always holds.
  double moved(const double* field, long node, int c) const {
    return field == nullptr ? 0.0 : field[c * nodes.nodes + node];
  }
  double held_up(int face, long node, const int* number) const {
    const double mass = nodes.mass[node];
    const bool held = nodes.hold != nullptr && held_before(nodes.hold[node], face / 2) != kFree;
    double taken = 0.0;
    for (int c = 0; c < Dim; ++c) {
      if (holding_face(grid, Dim, number, c) != face) continue;
      const double momentum = nodes.momentum[c * nodes.nodes + node];
      const mpm::AxisLoss loss = mpm::axis_loss(
          mass, momentum, mass * dt * grid.gravity[c], of_wall(nodes.held, face, node, number, c),
          strain_at_start > 0.0 ? momentum / mass + moved(nodes.moved, node, c) : 0.0, held, strain_at_start);
      taken += loss.taken;
      if (at_end != nullptr) {
        taken -= loss.at_end * (at_end[c * nodes.nodes + node] / mass + moved(moved_at_end, node, c));
      }
    }
    return taken;
  }

  /// After the walls that always hold.
  Rubbing begin(long node, const int* number) const {
    const double inverse_mass = 1.0 / nodes.mass[node];
    Rubbing now{of(nodes.momentum, node, inverse_mass), Vector::Zero(), of(nodes.left, node, 1.0)};
    if (at_end != nullptr) now.at_end = of(at_end, node, inverse_mass);
    each_wall_at<Dim>(grid, number, [&](int face) {
      if (grid.faces[face] != Face::frictional) {
        hold_part<Dim>(face, always(grid, face), now.at_start.c);
        hold_part<Dim>(face, always(grid, face), now.at_end.c);
      } else {
        now.left += -inverse_mass * of(row(face), node, 1.0);
      }
    });
    for (int c = 0; c < Dim; ++c) {
      now.at_start.c[c] += moved(nodes.moved, node, c);
      now.at_end.c[c] += moved(moved_at_end, node, c);
    }
    return now;
  }
  const double* row(int face) const { return nodes.held + face / 2 * Dim * nodes.nodes; }
  /// Change of a velocity by contact for the strain; the velocity changes.
  Vector rub(int face, Hold held, Vector& velocity) const {
    const Vector before = velocity;
    rub_for_strain<Dim>(grid, face, held, velocity.c);
    return velocity - before;
  }
  mpm::SurfaceLoss rubbed(int face, long node, Rubbing& now) const {
    const double mass = nodes.mass[node];
    const Vector start = of(nodes.momentum, node, 1.0 / mass), impulse = of(row(face), node, 1.0);
    const Hold before = held_before(nodes.hold[node], face / 2), held = held_now(nodes.hold[node], face / 2);
    Vector normal = Vector::Zero(), weight;
    normal.c[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    for (int c = 0; c < Dim; ++c) weight.c[c] = mass * dt * grid.gravity[c];
    mpm::LossAtNode<Vector> loss;
    if (strain_at_start > 0.0) {
      const Vector gathered = now.at_start;
      loss.strain(gathered, rub(face, before, now.at_start));
    } else {
      Vector gathered = start;
      loss.strain(start, rub(face, before, gathered));
    }
    now.left += 1.0 / mass * impulse;
    mpm::SurfaceLoss taken =
        loss.act({mass, normal, weight, impulse, start, now.left, before != kFree, strain_at_start});
    if (at_end != nullptr) {
      const Vector gathered = now.at_end;
      taken += loss.strain(gathered, rub(face, held, now.at_end));
    }
    return taken;
  }
};

}  // namespace mpm_gpu
