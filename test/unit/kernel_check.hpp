// Every pass of a step against the reference (kernel_reference.hpp), which starts each pass from the same numbers as
// the kernels.
#pragma once

#include "kernel_compare.hpp"

namespace mpm::test {

/// FLIP, or a mixture with PIC.
inline Transfer flip(double fraction) { return {TransferKind::flip, fraction, 2}; }

/// A scene, and the passes of its step compared with those of the reference.
template <class Geometry, class T>
class Kernels : KernelComparison<Geometry, T> {
  using Base = KernelComparison<Geometry, T>;
  using Base::affine;
  using Base::average;
  using Base::check_reach;
  using Base::compare_drag;
  using Base::compare_motion;
  using Base::compare_nodes;
  using Base::compare_outgrown;
  using Base::compare_state;
  using Base::each_block;
  using Base::expect_total;
  using Base::kDim;
  using Base::name_;
  using Base::scene_;
  using Base::views;

 public:
  /// `axis`: rules of the shape function at the axis, for rings.
  Kernels(ShapeKind shape, const paths::Specimen& specimen, Places places, Isa isa, const Transfer& transfer,
          bool average_dilatation = false, const AxisRules& axis = {})
      : Base(std::string(shape_name(shape)) + ", " + specimen.material.name + ", " + name_of(places) + ", " +
                 isa_name(isa) + ", " + kTransferNames[static_cast<int>(transfer.kind)],
             shape, specimen, places, isa, settings(transfer, average_dilatation), axis),
        context_{scene_.fields, scene_.dt} {}

  /// Checks a step of either schedule, pass by pass, and the force of the present stress beside that of the strain
  /// pass.
  void check(bool regather) {
    for (ParticleSet& set : scene_.sets) {
      if (!regather) set.next_x.clear();  // particles move at once
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
    expect_total("mass", scene_.grid.mass, [](const auto& p, int) { return p.mass; });
    expect_total("momentum", scene_.grid.momentum, [](const auto& p, int c) { return p.mass * p.v[c]; });
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
    scene_.reference.force(average());  // force of the kernels' stress, whose own tolerance must not count here
    compare_nodes("force", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; });
    // The total is zero, since the sum of G over the nodes of a particle is zero (GIMP notes (1.26)), except for the
    // radial force of the hoop stress.
    expect_total("force", scene_.grid.force, [](const auto& p, int c) { return c == 0 ? p.hoop_force : 0.0; });
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
    // Nodes are double with both precisions of particles.
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
    // Compared as momentum: the round-off of a node's small mass, like that of its momentum, is relative to particles.
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
    expect_total("momentum", scene_.grid.momentum, [](const auto& p, int c) { return p.mass * p.v[c]; });
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

  /// Checks every motion without damping and with rates that are constant or functions of place, with and without the
  /// new momentum: all passes of the table that a schedule may need. The scene must have APIC, whose fields serve all.
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

  /// Checks the projection of random velocities to the particles and back.
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

  /// Checks which domains leave the tile of their block: at first, and after particles were shifted so that some do.
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
  using typename Base::GridView;

  static ContinuumSettings settings(const Transfer& transfer, bool average_dilatation) {
    ContinuumSettings settings;
    settings.average_dilatation = average_dilatation;
    settings.transfer = transfer;
    return settings;
  }
  mpm_kernel::Motion motion() const {
    if (affine()) return mpm_kernel::kAffine;
    return scene_.settings.transfer.kind == TransferKind::flip ? mpm_kernel::kIncrement : mpm_kernel::kAdopt;
  }

  NodalField zero_field() {
    NodalField field(kDim, scene_.grid.layout.nodes_per_block());
    field.resize(scene_.grid.blocks.size());
    std::fill(field.block(0), field.block(scene_.grid.blocks.size()), 0.0);
    return field;
  }
  // Does the work of the first pass of a step.
  void note_domains() {
    if (traits_of(scene_.shape).follows_deformation()) scene_.mechanics->scatter_momentum(context_);
  }

  void check_move(mpm_kernel::Motion motion, Damping damping, bool regather) {
    const std::string start = name_;
    name_ += ", motion " + std::to_string(motion) + ", damping " + std::to_string(static_cast<int>(damping)) +
             (regather ? ", regather" : "");
    std::vector<mpm_kernel::SetView<T>> sets = views();
    const double rate = 0.1 / scene_.dt, flip = 0.9;
    mpm_kernel::MoveSettings settings{scene_.dt, flip, regather};
    settings.by_point = scene_.reference.by_point;
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
    settings.damped = damping != Damping::none;
    if (damping == Damping::constant) settings.grid_damping = rate, settings.particle_damping = 2 * rate;
    scene_.read_nodes();
    NodalField& momentum = scene_.grid.momentum;
    if (regather) std::fill(momentum.block(0), momentum.block(scene_.grid.blocks.size()), 0.0);
    ReferenceDrag found;
    each_block(sets, [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      const mpm_kernel::Moved moved = scene_.kernels.move[motion](grid, block, of, count, settings);
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

  StepContext context_;
};

}  // namespace mpm::test
