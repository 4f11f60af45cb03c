// An elastic body in free flight, and the steps of any method, for tests of properties that hold in every scene. Rings
// fly along their axis. It is limited to one body and one law.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "kernel_stencil.hpp"
#include "kernel_tables.hpp"
#include "mpm/boundary/axis.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/step/schedule.hpp"

namespace mpm::test {

constexpr ShapeKind kAllShapes[] = {ShapeKind::dirac, ShapeKind::ugimp,    ShapeKind::ugimp_stretch, ShapeKind::cpdi,
                                    ShapeKind::qcpdi, ShapeKind::bspline2, ShapeKind::bspline3};
constexpr UpdateScheme kAllUpdates[] = {UpdateScheme::usf, UpdateScheme::usl, UpdateScheme::usavg};
constexpr Transfer kAllTransfers[] = {{TransferKind::flip, 1.0, 2},
                                      {TransferKind::flip, 0.9, 2},
                                      {TransferKind::xpic, 1.0, 3},
                                      {TransferKind::fmpm, 1.0, 2},
                                      {TransferKind::apic, 1.0, 2}};

struct StepMethod {
  ShapeKind shape = ShapeKind::ugimp;
  UpdateScheme update = UpdateScheme::usavg;
  Transfer transfer;

  std::string name() const {
    return std::string(shape_name(shape)) + ", " + kUpdateNames[static_cast<int>(update)] + ", " +
           kTransferNames[static_cast<int>(transfer.kind)] + " " +
           std::to_string(transfer.kind == TransferKind::flip ? transfer.flip : transfer.order);
  }
};

/// Calls visit(method) for every method that the geometry has.
template <class Geometry, class Visit>
void each_method(Visit&& visit) {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    for (const UpdateScheme update : kAllUpdates) {
      for (const Transfer& transfer : kAllTransfers) visit(StepMethod{shape, update, transfer});
    }
  }
}

/// A block with two particles along each axis of a cell, or the part of it for which `keep` holds.
template <class Geometry, class T = double>
class StepScene {
 public:
  static constexpr int kDim = Geometry::kDim;
  static constexpr double kCell = 0.125, kDensity = 1000.0, kStiffness = 1e5;  ///< [m], [kg/m^3], [Pa]
  using Vector = std::array<double, 3>;

  struct Body {
    int cells = kDim == 3 ? 4 : 8;  ///< cells along an edge
    double jitter = 0.2;            ///< [cells]
    /// Centre of the block [m]; rings begin at their axis.
    Vector centre{Geometry::kHoop ? 0.5 * cells * kCell : 1.5, 1.5, 1.5};
    std::function<bool(const Vector&)> keep = [](const Vector&) { return true; };
    bool walls = false;  ///< true if walls stand at the lower corner of the domain
  };

  explicit StepScene(const StepMethod& method, const Body& body = {}, int threads = 1, Isa isa = best_isa())
      : method_(method),
        kernels_(kernels_of<Geometry, T>(method.shape, isa)),
        fields(make_fields(GridLayout(kDim, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(24 * kCell)))),
        sorter_(threads, kernel_grouping(kernels_)) {
    laws_.push_back(make_law({"rubber", kDensity, NeoHookeanDefinition{{kStiffness, 0.3}}}));
    for (int k = 0; k < kDim; ++k) grid.has_wall[2 * k] = body.walls;
    fill(body);
    settings_.transfer = method.transfer;
    settings_.threads = threads;
    if (Geometry::kHoop) {
      settings_.axis_motion = AxisMotion::point;
      modules_.add_in_field(std::make_unique<Axis>(AxisGhosts::zero), 0);
    }
    sort();
    grid.least_mass = 1e-30 * set().least_mass();
    // The longitudinal wave travels kCell / 5 in a step.
    dt = 0.2 * kCell / std::sqrt(kStiffness * 0.7 / (1.3 * 0.4) / kDensity);
    mechanics = make_mechanics(kernels_, fields, sets_, laws_, settings_);
  }

  ParticleSet& set() { return sets_[0]; }
  const mpm_kernel::KernelTable<T>& kernels() const { return kernels_; }
  StepContext context() { return {fields, dt}; }

  /// Sets the velocity of each particle to v(x_p) [m/s].
  void set_velocity(const std::function<Vector(const Vector&)>& v) {
    for (int p = 0; p < set().size(); ++p) {
      const Vector at = v(place(p));
      for (int k = 0; k < kDim; ++k) set().v[k].set(p, at[k]);
    }
  }
  /// Sets B of APIC for this velocity gradient [1/s].
  void set_affine(const double (&gradient)[3][3]) {
    for (int p = 0; p < set().size(); ++p) {
      const Vector centre = mean_place(p);
      double b[kDim][kDim] = {};
      for (const NodeWeight& n : stencil(p)) {
        double arm[kDim];
        for (int k = 0; k < kDim; ++k) arm[k] = node_position(n.at[k]) - centre[k];
        for (int c = 0; c < kDim; ++c) {
          double v = 0.0;
          for (int k = 0; k < kDim; ++k) v += gradient[c][k] * arm[k];
          for (int k = 0; k < kDim; ++k) b[c][k] += n.s * v * arm[k];
        }
      }
      for (int c = 0; c < kDim * kDim; ++c) set().affine[c].set(p, b[c / kDim][c % kDim]);
    }
  }
  Vector place(int p) {
    Vector x{};
    for (int k = 0; k < kDim; ++k) x[k] = set().x[k][p];
    return x;
  }
  /// Mean position of a particle's shape function, the sum of S x_i: its own position, except for rings, whose shape
  /// function has the weight r.
  Vector mean_place(int p) {
    Vector x{};
    for (const NodeWeight& n : stencil(p)) {
      for (int k = 0; k < kDim; ++k) x[k] += n.s * node_position(n.at[k]);
    }
    return x;
  }
  /// The nodes to which the particle spreads in the next step.
  std::vector<NodeWeight> stencil(int p) {
    ReferenceGrid nodes;
    nodes.rings = Geometry::kHoop;
    for (int k = 0; k < kDim; ++k) {
      nodes.cell[k] = kCell;
      if (grid.has_wall[2 * k]) nodes.low_wall[k] = 0.0;
      if (grid.has_wall[2 * k + 1]) nodes.high_wall[k] = grid.layout.last_node(k);
    }
    ReferencePlace at{place(p), set().half, {}};
    for (int c = 0; c < kDim; ++c) {
      for (int k = 0; k < kDim; ++k) at.f[c][k] = set().f[c * kDim + k][p];
    }
    return reference_stencil<kDim>(method_.shape, nodes, at);
  }

  void step() {
    StepContext now = context();
    switch (method_.update) {
      case UpdateScheme::usf:
        step_usf(*mechanics, modules_, now);
        break;
      case UpdateScheme::usl:
        step_usl(*mechanics, modules_, now);
        break;
      case UpdateScheme::usavg:
        step_usavg(*mechanics, modules_, now);
        break;
      case UpdateScheme::implicit:
        step_implicit(*mechanics, modules_, now);
        break;
    }
    if (mechanics->failed()) throw Error("a particle of the test is crushed");
    if (mechanics->needs_sort()) sort();
  }
  void advance(int steps) {
    for (int n = 0; n < steps; ++n) step();
  }

  /// Calls visit(block, node in the block, number of the node along each axis).
  template <class Visit>
  void each_node(Visit&& visit) {
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) visit(b, n, grid.layout.node(grid.blocks.block(b), n));
    }
  }
  double node_position(int number) const { return number * kCell; }

  int sorts = 0;

 private:
  StepMethod method_;
  mpm_kernel::KernelTable<T> kernels_;

 public:
  Fields fields;
  Grid& grid = *fields.front();
  std::unique_ptr<Mechanics> mechanics;
  double dt = 0.0;  ///< [s]

 private:
  void sort() {
    if (sorter_.sort(sets_, fields)) throw Error("a particle of the test is out of place");
    ++sorts;
  }

  void fill(const Body& body) {
    sets_.emplace_back();
    ParticleSet& set = sets_.back();
    set.precision = sizeof(T) == 4 ? Precision::float32 : Precision::float64;
    set.mass = kDensity * std::pow(0.5 * kCell, kDim);
    set.half = {0.25, 0.25, 0.25};
    if (body.walls) set.lowest = {-0.25, -0.25, -0.25};
    set.highest = {24.0, 24.0, 24.0};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shake(-body.jitter * kCell, body.jitter * kCell);
    const int edge = 2 * body.cells;
    std::vector<Vector> at;
    int count = 1;
    for (int k = 0; k < kDim; ++k) count *= edge;
    for (int p = 0; p < count; ++p) {
      Vector x{};
      for (int k = 0, rest = p; k < kDim; ++k, rest /= edge) {
        x[k] = body.centre[k] + (0.5 * (rest % edge + 0.5) - 0.5 * body.cells) * kCell + shake(random);
      }
      if (body.keep(x)) at.push_back(x);
    }
    const std::size_t size = at.size();
    set.x.assign(kDim, PaddedArray<double>(size));
    if (method_.update != UpdateScheme::usf) set.next_x = set.x;
    set.v.assign(kDim, ParticleScalar(set.precision, size));
    set.f.assign(Geometry::kMatrix, ParticleScalar(set.precision, size));
    set.tau.assign(Geometry::kSymmetric, ParticleScalar(set.precision, size));
    set.id.resize(size);
    for (std::size_t p = 0; p < size; ++p) {
      set.id[p] = static_cast<std::uint32_t>(p);
      for (int k = 0; k < kDim; ++k) {
        set.x[k][p] = at[p][k];
        set.f[k * (kDim + 1)].set(p, 1.0);
      }
    }
    if constexpr (Geometry::kHoop) {
      set.masses.assign(1, ParticleScalar(set.precision, size));
      for (std::size_t p = 0; p < size; ++p) {
        set.f[4].set(p, 1.0);
        set.masses[0].set(p, set.mass * 2.0 * mpm::kPi * at[p][0]);
      }
    }
    prepare(set, method_.shape, method_.transfer);
  }

  std::vector<ParticleSet> sets_;
  std::vector<Law> laws_;
  ContinuumSettings settings_;
  Modules modules_;  ///< the condition at an axis
  Sorter sorter_;
};

}  // namespace mpm::test
