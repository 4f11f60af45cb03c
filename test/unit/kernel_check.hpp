// Every pass of a step against the reference (kernel_reference.hpp), which begins each pass with the numbers that the
// kernels begin it with.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "kernel_scene.hpp"
#include "mpm/mechanics/kernel_views.hpp"

namespace mpm::test {
/// How far a field is from the reference's.
struct Difference {
  double largest = 0.0, error = 0.0;
  void add(double found, double expected) {
    largest = std::max(largest, std::abs(expected));
    const double apart = std::abs(found - expected);
    error = std::isfinite(apart) ? std::max(error, apart) : std::numeric_limits<double>::infinity();
  }
};

/// Of the largest value of a field. Double: what the project promises, a thousand times what one pass needs.
/// Single: a place in a tile is a number up to 8, rounded to 2 epsilon, and weights change by 1 / (2 half) = 2.5 times
/// as much; a node sums the particles of some 20 cells, each sum rounded; together a few tens of epsilon.
template <class T>
constexpr double kTolerance = sizeof(T) == 8 ? 1e-12 : 64 * std::numeric_limits<float>::epsilon();

/// FLIP, or a mixture with PIC.
inline Transfer flip(double fraction) { return {TransferKind::flip, fraction, 2}; }

/// A scene, and the passes of its step beside the reference's.
template <class Geometry, class T>
class Kernels {
  static constexpr int kDim = Geometry::kDim;
  using Scene = KernelScene<Geometry, T>;

 public:
  Kernels(ShapeKind shape, const paths::Specimen& specimen, Places places, Isa isa, const Transfer& transfer,
          bool average_dilatation = false)
      : name_(std::string(shape_name(shape)) + ", " + specimen.material.name + ", " + name_of(places) + ", " +
              isa_name(isa) + ", " + kTransferNames[static_cast<int>(transfer.kind)]),
        scene_(shape, specimen, places, isa, settings(transfer, average_dilatation)),
        context_{scene_.grid, scene_.dt} {}

  /// A step of either schedule, pass by pass; a force of the stress as it is beside that of the strain's pass.
  void check(bool regather) {
    for (ParticleSet& set : scene_.sets) {
      if (!regather) set.next_x.clear();  // particles are placed at once
    }
    scatter_momentum();
    strain_and_force(regather ? 0.5 * scene_.dt : scene_.dt);
    internal_force();
    update_momentum();
    add_increments();
    if (regather) {
      move_and_regather();
      strain_and_place();
    } else {
      move_particles();
    }
  }

  void scatter_momentum() {
    scene_.mechanics->scatter_momentum(context_);
    scene_.reference.scatter_momentum(affine());
    compare_nodes("mass", scene_.grid.mass, [](const ReferenceNode& n, int) { return n.mass; });
    compare_nodes("momentum", scene_.grid.momentum, [](const ReferenceNode& n, int c) { return n.momentum[c]; });
    expect_total("mass", scene_.grid.mass, [](const auto& set, const auto&, int) { return set.mass; });
    expect_total("momentum", scene_.grid.momentum,
                 [](const auto& set, const auto& p, int c) { return set.mass * p.v[c]; });
    scene_.read_nodes();
    scene_.reference.nodal_velocity(scene_.grid.least_mass);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void strain_and_force(double dt) {
    scene_.read_nodes();
    scene_.mechanics->strain_and_force(context_, dt);
    EXPECT_FALSE(scene_.mechanics->failed());
    scene_.reference.strain(dt, scene_.settings.gradient_terms, average());
    compare_state();
    scene_.reference.force(
        average());  // of the kernels' stress: a stress that is off by its tolerance is another matter
    compare_nodes("force", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; });
    // Nothing pushes from outside: GIMP notes (1.26), the sum of G over the nodes of a particle is zero.
    expect_total("force", scene_.grid.force, [](const auto&, const auto&, int) { return 0.0; });
  }

  void internal_force() {
    scene_.mechanics->internal_force(context_);
    compare_nodes("force alone", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; });
  }

  void update_momentum() {
    scene_.read_nodes();
    scene_.mechanics->update_momentum(context_);
    double gravity[3] = {};
    for (int k = 0; k < kDim; ++k) gravity[k] = scene_.settings.gravity[scene_.grid.layout.axis(k)];
    scene_.reference.nodal_update(scene_.dt, gravity, scene_.grid.least_mass);
    // Nodes are double in either precision.
    compare_nodes(
        "acceleration", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; }, 1e-12);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void add_increments() {
    scene_.read_nodes();
    const Transfer& transfer = scene_.settings.transfer;
    const bool adopts = transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm;
    ASSERT_EQ(scene_.mechanics->increments(), adopts ? transfer.order - 1 : 0) << name_;
    if (!adopts) return;
    scene_.mechanics->begin_increments(context_);
    for (int n = 1; n < transfer.order; ++n) {
      scene_.mechanics->find_increment(context_);
      scene_.mechanics->add_increment(context_);
    }
    scene_.reference.add_increments(transfer.order, transfer.kind == TransferKind::xpic, scene_.grid.least_mass);
    // As momentum: what little mass a node has is rounded as its momentum is, by numbers of the size of a particle's.
    NodalField momentum = zero_field();
    scene_.each_node([&](int b, int n, const ReferenceNode& node) {
      for (int c = 0; c < kDim; ++c) momentum.at(b, c, n) = node.mass * scene_.grid.velocity.at(b, c, n);
    });
    compare_nodes("momentum with increments", momentum,
                  [](const ReferenceNode& n, int c) { return n.mass * n.velocity[c]; });
  }

  void move_particles() {
    scene_.read_nodes();
    scene_.mechanics->move_particles(context_);
    scene_.reference.move(motion(), scene_.dt, scene_.settings.transfer.flip);
    compare_motion(&ParticleSet::x);
    check_reach(&ParticleSet::x);
  }

  void move_and_regather() {
    scene_.read_nodes();
    scene_.mechanics->move_and_regather(context_);
    scene_.reference.move(motion(), scene_.dt, scene_.settings.transfer.flip);
    compare_motion(&ParticleSet::next_x);
    scene_.reference.gather_momentum(affine());
    compare_nodes("momentum", scene_.grid.momentum, [](const ReferenceNode& n, int c) { return n.momentum[c]; });
    expect_total("momentum", scene_.grid.momentum,
                 [](const auto& set, const auto& p, int c) { return set.mass * p.v[c]; });
    scene_.read_nodes();
    scene_.reference.nodal_velocity(scene_.grid.least_mass);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void strain_and_place() {
    scene_.read_nodes();
    std::vector<PaddedArray<double>> placed;
    for (const ParticleSet& set : scene_.sets) placed.push_back(set.next_x[0]);
    scene_.mechanics->strain_and_place(context_, 0.5 * scene_.dt);
    scene_.reference.strain(0.5 * scene_.dt, scene_.settings.gradient_terms, average());
    compare_state();
    compare_nodes(
        "acceleration", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; }, 0.0);
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      EXPECT_TRUE(std::equal(placed[s].begin(), placed[s].end(), scene_.sets[s].x[0].begin())) << name_;
    }
    check_reach(&ParticleSet::x);
  }

  /// Every motion with and without damping, of rates that are constant or of place, with and without the new momentum:
  /// the passes that a schedule may ask for, from the table. Of a scene with APIC, which has what all motions need.
  void check_moves() {
    scatter_momentum();
    strain_and_force(0.5 * scene_.dt);
    update_momentum();
    const std::vector<ParticleSet> start = scene_.sets;
    for (const mpm_kernel::Motion motion : {mpm_kernel::kIncrement, mpm_kernel::kAdopt, mpm_kernel::kAffine}) {
      for (const Damping damping : {Damping::none, Damping::constant, Damping::of_place}) {
        for (const bool regather : {false, true}) {
          check_move(motion, damping, regather);
          scene_.sets = start;
          scene_.read_particles();
        }
      }
    }
  }

  void scatter_load() {
    std::vector<std::vector<PaddedArray<double>>> loads;
    std::vector<mpm_kernel::SetView<T>> sets = views();
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    scene_.each_reference([](auto& p) { Reference<Geometry>::note_domain(p); });
    note_domains();
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      loads.emplace_back(kDim, PaddedArray<double>(scene_.sets[s].size()));
      if (s == 1) continue;  // the second body has no load
      for (int k = 0; k < kDim; ++k) {
        for (int p = 0; p < scene_.sets[s].size(); ++p) {
          loads[s][k][p] = scene_.reference.sets[s].particles[p].load[k] = u(scene_.random);
        }
        sets[s].load[k] = loads[s][k].data();
      }
    }
    NodalField field = zero_field();
    each_block(sets, [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      scene_.kernels.scatter_load(grid, block, of, count, field.data());
    });
    scene_.reference.scatter_load();
    compare_nodes("load", field, [](const ReferenceNode& n, int c) { return n.load[c]; });
    expect_total("load", field, [](const auto& set, const auto& p, int c) { return set.mass * p.load[c]; });
  }

  /// A field of random velocities to the particles and back.
  void project() {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    scene_.each_reference([](auto& p) { Reference<Geometry>::note_domain(p); });
    note_domains();
    NodalField from = zero_field(), to = zero_field();
    scene_.each_node([&](int b, int n, ReferenceNode& node) {
      for (int c = 0; c < kDim; ++c) from.at(b, c, n) = node.from[c] = u(scene_.random);
    });
    each_block(views(), [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      scene_.kernels.project(grid, block, of, count, from.data(), to.data());
    });
    scene_.reference.project();
    compare_nodes("projection", to, [](const ReferenceNode& n, int c) { return n.to[c]; });
  }

  /// Domains as they are now leave the tile of their block or do not; then particles are shifted, and some do.
  void check_outgrown() {
    ASSERT_NE(scene_.kernels.outgrown, nullptr);
    EXPECT_EQ(compare_outgrown(), 0) << name_;
    std::uniform_real_distribution<double> u(-0.7, 0.7);
    for (ParticleSet& set : scene_.sets) {
      for (int p = 0; p < set.size(); p += kDim == 3 ? 97 : 17) {
        for (int k = 0; k < kDim; ++k) set.x[k][p] += u(scene_.random) * scene_.grid.layout.cell(k);
      }
    }
    scene_.read_particles();
    const int outgrown = compare_outgrown();
    EXPECT_GT(outgrown, 0) << name_;
    EXPECT_LT(outgrown, scene_.grid.blocks.owners()) << name_;
  }

 private:
  enum class Damping { none, constant, of_place };
  using GridView = mpm_kernel::GridView;

  static ContinuumSettings settings(const Transfer& transfer, bool average_dilatation) {
    ContinuumSettings settings;
    settings.average_dilatation = average_dilatation;
    settings.transfer = transfer;
    return settings;
  }
  // Boxes and domains of half their size at the start: weights change twice as fast.
  double tolerance() const { return follows_deformation(scene_.shape) ? 2.0 * kTolerance<T> : kTolerance<T>; }
  bool average() const { return scene_.settings.average_dilatation; }
  bool affine() const { return scene_.settings.transfer.kind == TransferKind::apic; }
  mpm_kernel::Motion motion() const {
    if (affine()) return mpm_kernel::kAffine;
    return scene_.settings.transfer.kind == TransferKind::flip ? mpm_kernel::kIncrement : mpm_kernel::kAdopt;
  }

  std::vector<mpm_kernel::SetView<T>> views() {
    std::vector<mpm_kernel::SetView<T>> views;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      views.push_back(view_of<T>(scene_.sets[s], scene_.laws[s], scene_.kernels.laws));
    }
    return views;
  }
  // pass(grid, block, sets, how many)
  template <class Pass>
  void each_block(const std::vector<mpm_kernel::SetView<T>>& sets, Pass&& pass) {
    const GridView grid = view_of(scene_.grid);
    each_owner(scene_.grid, 1, [&](const mpm_kernel::BlockView& block) {
      pass(grid, block, sets.data(), static_cast<int>(sets.size()));
    });
  }
  NodalField zero_field() {
    NodalField field(kDim, scene_.grid.layout.nodes_per_block());
    field.resize(scene_.grid.blocks.size());
    std::fill(field.block(0), field.block(scene_.grid.blocks.size()), 0.0);
    return field;
  }
  // What the first pass of a step does.
  void note_domains() {
    if (follows_deformation(scene_.shape)) scene_.mechanics->scatter_momentum(context_);
  }

  void check_move(mpm_kernel::Motion motion, Damping damping, bool regather) {
    const std::string start = name_;
    name_ += ", motion " + std::to_string(motion) + ", damping " + std::to_string(static_cast<int>(damping)) +
             (regather ? ", regather" : "");
    std::vector<mpm_kernel::SetView<T>> sets = views();
    const double rate = 0.1 / scene_.dt, flip = 0.9;
    mpm_kernel::MoveSettings settings{scene_.dt, flip, regather};
    std::vector<PaddedArray<double>> rates;
    rates.reserve(2 * sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      for (int of = 0; of < 2; ++of) {
        rates.emplace_back(PaddedArray<double>(scene_.sets[s].size()));
        for (int p = 0; p < scene_.sets[s].size(); ++p) {
          double& one = scene_.reference.sets[s].particles[p].damping[of];
          one = damping == Damping::none ? 0.0 : (of + 1) * rate;
          if (damping == Damping::of_place) one *= std::uniform_real_distribution<double>(0.0, 1.0)(scene_.random);
          rates.back()[p] = one;
        }
        if (damping == Damping::of_place) sets[s].damping[of] = rates.back().data();
      }
    }
    if (damping == Damping::constant) settings.grid_damping = rate, settings.particle_damping = 2 * rate;
    scene_.read_nodes();
    NodalField& momentum = scene_.grid.momentum;
    if (regather) std::fill(momentum.block(0), momentum.block(scene_.grid.blocks.size()), 0.0);
    ReferenceDrag found;
    each_block(sets, [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      const mpm_kernel::Moved moved =
          scene_.kernels.move[motion][damping != Damping::none](grid, block, of, count, settings);
      for (int c = 0; c < 3; ++c) found.drag[c] += moved.drag[c];
      found.grid_kinetic += moved.grid_kinetic;
      found.particle_kinetic += moved.particle_kinetic;
    });
    const ReferenceDrag expected = scene_.reference.move(motion, scene_.dt, flip);
    if (damping != Damping::none) compare_drag(found, expected);
    compare_motion(&ParticleSet::next_x, motion == mpm_kernel::kAffine);
    if (regather) {
      scene_.reference.gather_momentum(motion == mpm_kernel::kAffine);
      compare_nodes("momentum", momentum, [](const ReferenceNode& n, int c) { return n.momentum[c]; });
    }
    name_ = start;
  }

  void compare_drag(const ReferenceDrag& found, const ReferenceDrag& expected) {
    // A sum over all particles of what each rounds: of the sum of sizes, by the inequality of Cauchy and Schwarz.
    double mass = 0.0;
    scene_.reference.each([&](const auto& set, const auto&) { mass += set.mass; });
    const double energy = expected.grid_kinetic + expected.particle_kinetic;
    for (int c = 0; c < kDim; ++c) {
      EXPECT_NEAR(found.drag[c], expected.drag[c], tolerance() * std::sqrt(2.0 * mass * energy)) << name_;
    }
    EXPECT_NEAR(found.grid_kinetic, expected.grid_kinetic, tolerance() * energy) << name_;
    EXPECT_NEAR(found.particle_kinetic, expected.particle_kinetic, tolerance() * energy) << name_;
  }

  // How many blocks have a domain that leaves their tile; those that nearly do may be counted or not.
  int compare_outgrown() {
    const double near = 8 * mpm_kernel::kTileEdge * std::numeric_limits<T>::epsilon();
    int outgrown = 0;
    each_block(views(), [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      const bool found = scene_.kernels.outgrown(grid, block, of, count);
      outgrown += found;
      double beyond = -1.0;
      for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
        const auto& begin = scene_.sets[s].begin;
        for (std::uint32_t p = begin[block.owner]; p < begin[block.owner + 1]; ++p) {
          auto particle = scene_.reference.sets[s].particles[p];
          Reference<Geometry>::note_domain(particle);
          const ReferencePlace place = Reference<Geometry>::place_of(scene_.reference.sets[s], particle);
          double d[kDim][kDim];
          reference_domain(scene_.reference.grid(), place, d);
          for (int k = 0; k < kDim; ++k) {
            const double at = scene_.grid.layout.in_cells(k, place.x[k]) - block.corner[k];
            double reach = 0.0;
            for (const auto& vector : d) reach += std::abs(vector[k]) / scene_.grid.layout.cell(k);
            beyond = std::max({beyond, reach - at, at + reach - (mpm_kernel::kTileEdge - 1)});
          }
        }
      }
      if (std::abs(beyond) > near) {
        EXPECT_EQ(found, beyond > 0.0) << name_ << " block " << block.owner;
      }
    });
    return outgrown;
  }

  template <class Value>
  void compare_nodes(const char* what, const NodalField& field, Value&& value, double allowed = -1.0) {
    if (allowed < 0.0) allowed = tolerance();
    Difference difference;
    double inside = 0.0, all = 0.0;
    scene_.each_node([&](int b, int n, const ReferenceNode& expected) {
      for (int c = 0; c < field.components(); ++c) {
        difference.add(field.at(b, c, n), value(expected, c));
        inside += std::abs(value(expected, c));
      }
    });
    for (const ReferenceNode& n : scene_.reference.nodes()) {
      for (int c = 0; c < field.components(); ++c) all += std::abs(value(n, c));
    }
    EXPECT_NEAR(inside, all, 1e-12 * all) << name_ << ": nodes of the " << what << " are not in the grid";
    EXPECT_LE(difference.error, allowed * difference.largest) << name_ << ": " << what;
  }

  // The sum over nodes against that over particles, as exact as the parts of one: each particle's weights sum to one.
  template <class Value>
  void expect_total(const char* what, const NodalField& field, Value&& of_particle) {
    for (int c = 0; c < field.components(); ++c) {
      double found = 0.0, expected = 0.0, size = 0.0;
      scene_.each_node([&](int b, int n, const ReferenceNode&) {
        found += field.at(b, c, n);
        size += std::abs(field.at(b, c, n));
      });
      scene_.reference.each([&](const auto& set, const auto& p) {
        expected += of_particle(set, p, c);
        size += std::abs(of_particle(set, p, c));
      });
      EXPECT_NEAR(found, expected, 0.1 * tolerance() * size) << name_ << ": sum of the " << what;
    }
  }

  void compare_state() {
    // The dashpot's work is the sum of three differences of what isochoric tensors of size 1 have in excess: in single
    // precision it is lost among the roundings of these, one or two epsilon each, times the stiffness.
    const double work = sizeof(T) == 4 ? 6 * std::numeric_limits<T>::epsilon() * scene_.stiffness : 0.0;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const ParticleSet& set = scene_.sets[s];
      Difference f, tau, history[mpm_kernel::kMostHistory];
      for (int p = 0; p < set.size(); ++p) {
        const auto& expected = scene_.reference.sets[s].particles[p];
        double m[Geometry::kMatrix], t[Geometry::kSymmetric];
        double *to_m[Geometry::kMatrix], *to_t[Geometry::kSymmetric];
        for (int c = 0; c < Geometry::kMatrix; ++c) to_m[c] = m + c;
        for (int c = 0; c < Geometry::kSymmetric; ++c) to_t[c] = t + c;
        Geometry::store_matrix(expected.f, to_m, 0);
        Geometry::store_symmetric(expected.tau, to_t, 0);
        for (int c = 0; c < Geometry::kMatrix; ++c) f.add(set.f[c][p], m[c]);
        for (int c = 0; c < Geometry::kSymmetric; ++c) tau.add(set.tau[c][p], t[c]);
        for (std::size_t h = 0; h < set.history.size(); ++h) history[h].add(set.history[h][p], expected.history[h]);
      }
      const std::string of = name_ + ": " + set.name;
      EXPECT_LE(f.error, tolerance() * f.largest) << of << ", F";
      EXPECT_LE(tau.error, tolerance() * tau.largest) << of << ", stress";
      for (int h = 0; h < static_cast<int>(set.history.size()); ++h) {
        const bool is_work = std::visit([&](const auto& law) { return law.kPlasticWork == h; }, scene_.laws[s]);
        EXPECT_LE(history[h].error, tolerance() * history[h].largest + (is_work ? work : 0.0))
            << of << ", history " << h;
      }
    }
    scene_.read_particles();  // the next pass begins with the kernels' numbers
  }

  void compare_motion(std::vector<PaddedArray<double>> ParticleSet::*places) { compare_motion(places, affine()); }
  void compare_motion(std::vector<PaddedArray<double>> ParticleSet::*places, bool affine) {
    Difference v, displacement, turn;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const ParticleSet& set = scene_.sets[s];
      for (int p = 0; p < set.size(); ++p) {
        auto& expected = scene_.reference.sets[s].particles[p];
        for (int k = 0; k < kDim; ++k) {
          v.add(set.v[k][p], expected.v[k]);
          displacement.add((set.*places)[k][p] - expected.x[k], expected.next_x[k] - expected.x[k]);
          expected.v[k] = set.v[k][p];
          expected.next_x[k] = (set.*places)[k][p];
          for (int j = 0; affine && j < kDim; ++j) {
            turn.add(set.affine[k * kDim + j][p], expected.affine[k][j]);
            expected.affine[k][j] = set.affine[k * kDim + j][p];
          }
        }
      }
    }
    EXPECT_GT(displacement.largest, 0.0);
    // A weighted sum over nodes rounds by the largest of them: with APIC and hat functions at a point a light node can
    // be far faster than any particle.
    double fastest = 0.0;
    if (this->affine()) {
      for (const ReferenceNode& n : scene_.reference.nodes()) {
        for (const double component : n.velocity) fastest = std::max(fastest, std::abs(component));
      }
    }
    v.largest = std::max(v.largest, fastest);
    turn.largest = std::max(turn.largest, fastest * scene_.smallest_cell());
    displacement.largest = std::max(displacement.largest, fastest * scene_.dt);
    EXPECT_LE(v.error, tolerance() * v.largest) << name_ << ": particle velocity";
    EXPECT_LE(turn.error, tolerance() * turn.largest) << name_ << ": affine field";
    // Positions, up to 3 m, are rounded.
    const double rounding = 3.0 * std::numeric_limits<double>::epsilon();
    EXPECT_LE(displacement.error, tolerance() * displacement.largest + rounding) << name_ << ": displacement";
  }

  // A block is loose when a particle is beyond it, less the kernels' slack; what lies within rounding of the limit may
  // be on either side.
  void check_reach(std::vector<PaddedArray<double>> ParticleSet::*places) {
    const double near = 8 * mpm_kernel::kTileEdge * std::numeric_limits<T>::epsilon();
    for (int owner = 0; owner < scene_.grid.blocks.owners(); ++owner) {
      const auto& block = scene_.grid.blocks.block(scene_.grid.blocks.owner_block(owner));
      double beyond = -1.0;  // how far the farthest one is beyond the limit [cells]
      for (const ParticleSet& set : scene_.sets) {
        for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) {
          for (int k = 0; k < kDim; ++k) {
            const double at = scene_.grid.layout.in_cells(k, (set.*places)[k][p]) - block[k] * kBlockEdge;
            beyond = std::max({beyond, -0.5 + mpm_kernel::kSlack - at, at - 3.5 + mpm_kernel::kSlack});
          }
        }
      }
      if (std::abs(beyond) > near) {
        EXPECT_EQ(scene_.grid.loose[owner] != 0, beyond > 0.0) << name_ << " block " << owner;
      }
    }
  }

  std::string name_;
  Scene scene_;
  StepContext context_;
};

}  // namespace mpm::test
