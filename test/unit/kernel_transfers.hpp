// Transfers of numbers beside the mechanics (step/scalar_transfer.hpp) against loops over the weights of the
// reference's functions (kernel_stencil.hpp), for particles in the places that kernels find difficult.
#pragma once

#include "kernel_compare.hpp"
#include "mpm/mechanics/scalar_transfers.hpp"

namespace mpm::test {

template <class Geometry, class T>
class KernelTransfers : KernelComparison<Geometry, T> {
  using Base = KernelComparison<Geometry, T>;
  using Base::compare_nodes;
  using Base::expect_total;
  using Base::kDim;
  using Base::name_;
  using Base::scene_;
  using Base::tolerance;
  using Particle = ReferenceParticle<Geometry>;
  using Weight = ScalarTransfer::Weight;

 public:
  /// `axis`: of rings.
  KernelTransfers(ShapeKind shape, const paths::Specimen& specimen, Places places, Isa isa, const AxisRules& axis = {})
      : Base(std::string(shape_name(shape)) + ", " + name_of(places) + ", " + isa_name(isa) + ", transfers", shape,
             specimen, places, isa, {}, axis),
        transfer_(make_scalar_transfer(scene_.kernels, scene_.fields, scene_.sets, 1)) {
    StepContext context{scene_.fields, scene_.dt};
    scene_.mechanics->scatter_momentum(context);  // domains that follow the deformation are noted
    scene_.each_reference([](auto& p) { Reference<Geometry>::note_domain(p); });
    choose_numbers();
  }

  /// Every transfer; values alone where the functions' gradients are not what they are taken for: domains that reach
  /// across an axis.
  void check(bool gradients = true) {
    check_spread(1, Weight::one);
    check_spread(kDim, Weight::mass);
    check_gather(1);
    check_gather(kDim);
    if (!gradients) return;
    check_spread_gradient(true, Weight::one);
    check_spread_gradient(false, Weight::mass);
    check_spread_gradient_sum();
    check_gradient();
  }

 private:
  // Chooses numbers of particles, in load, and of nodes, in `from`. The second body takes no part.
  void choose_numbers() {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    numbers_.resize(scene_.sets.size());
    taken_.resize(scene_.sets.size());
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const int size = scene_.sets[s].size();
      numbers_[s].assign(3, std::vector<double>(size));
      taken_[s].assign(3, std::vector<double>(size));
      for (int p = 0; p < size; ++p) {
        for (int k = 0; k < 3; ++k) {
          Particle& particle = scene_.reference.sets[s].particles[p];
          particle.load[k] = takes_part(s) ? u(scene_.random) : 0.0;
          numbers_[s][k][p] = particle.load[k];
        }
      }
    }
    for (ReferenceNode& n : scene_.reference.nodes()) {
      for (double& number : n.from) number = u(scene_.random);
    }
  }
  static bool takes_part(std::size_t s) { return s != 1; }

  ScalarTransfer::Given given(bool hoop = true) const {
    ScalarTransfer::Given all(numbers_.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
      for (int k = 0; takes_part(s) && k < (hoop ? 3 : kDim); ++k) all[s][k] = numbers_[s][k].data();
    }
    return all;
  }
  ScalarTransfer::Taken taken() {
    ScalarTransfer::Taken all(taken_.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
      for (int k = 0; takes_part(s) && k < 3; ++k) all[s][k] = taken_[s][k].data();
    }
    return all;
  }
  NodalField nodal(int components) const { return {components, scene_.grid.layout.nodes_per_block()}; }
  NodalField nodal_from(int components) {
    NodalField field = nodal(components);
    field.resize(scene_.grid.blocks.size());
    scene_.each_node([&](int b, int n, const ReferenceNode& node) {
      for (int c = 0; c < components; ++c) field.at(b, c, n) = node.from[c];
    });
    return field;
  }

  // weigh(node, weight, particle) for every pair: what a plain loop would add to the node's load.
  template <class Weigh>
  void sum(Weigh&& weigh) {
    for (ReferenceNode& n : scene_.reference.nodes()) std::fill(n.load, n.load + 3, 0.0);
    scene_.reference.each([&](const auto& set, const Particle& p) {
      scene_.reference.each_weight(set, p, [&](ReferenceNode& n, const NodeWeight& w) { weigh(n, w, p); });
    });
  }
  static double factor(Weight weight, const Particle& p) { return weight == Weight::mass ? p.mass : 1.0; }

  void check_spread(int components, Weight weight) {
    NodalField found = nodal(components);
    transfer_->spread(0, given(), weight, found);
    sum([&](ReferenceNode& n, const NodeWeight& w, const Particle& p) {
      for (int c = 0; c < components; ++c) n.load[c] += factor(weight, p) * w.s * p.load[c];
    });
    compare_nodes("spread", found, load);
    expect_total("spread", found, [&](const Particle& p, int c) { return factor(weight, p) * p.load[c]; });
  }

  void check_spread_gradient(bool hoop, Weight weight) {
    NodalField found = nodal(1);
    transfer_->spread_gradient(0, given(hoop), weight, found);
    sum([&](ReferenceNode& n, const NodeWeight& w, const Particle& p) {
      for (int k = 0; k < kDim; ++k) n.load[0] += factor(weight, p) * w.g[k] * p.load[k];
      if (Geometry::kHoop && hoop) n.load[0] += factor(weight, p) * w.t * p.load[2];
    });
    compare_nodes("spread by gradient", found, load);
    // Gradients of a particle sum to zero over its nodes.
    if (!(Geometry::kHoop && hoop)) {
      expect_total("spread by gradient", found, [](const Particle&, int) { return 0.0; });
    }
  }

  void check_spread_gradient_sum() {
    NodalField found = nodal(kDim);
    transfer_->spread_gradient_sum(0, given(), Weight::mass, found);
    sum([&](ReferenceNode& n, const NodeWeight& w, const Particle& p) {
      for (int k = 0; k < kDim; ++k) n.load[k] += p.mass * w.g[k] * p.load[0];
    });
    compare_nodes("sum of gradients", found, load);
  }

  void check_gather(int components) {
    const NodalField from = nodal_from(components);
    transfer_->gather(0, from, taken());
    compare_taken(
        "gather", components, [](const NodeWeight& w, int) { return w.s; }, [](int c) { return c; });
  }

  void check_gradient() {
    const NodalField from = nodal_from(1);
    transfer_->gradient(0, from, taken());
    const auto weight = [](const NodeWeight& w, int k) { return k == kDim ? w.t : w.g[k]; };
    compare_taken("gradient", kDim + (Geometry::kHoop ? 1 : 0), weight, [](int) { return 0; });
  }

  // taken(c) = sum over nodes of weight(w, c) times component of(c).
  template <class WeightOf, class Of>
  void compare_taken(const char* what, int components, WeightOf&& weight, Of&& of) {
    Difference difference;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const auto& set = scene_.reference.sets[s];
      for (std::size_t p = 0; p < set.particles.size(); ++p) {
        double expected[3] = {};
        scene_.reference.each_weight(set, set.particles[p], [&](const ReferenceNode& n, const NodeWeight& w) {
          for (int c = 0; takes_part(s) && c < components; ++c) expected[c] += weight(w, c) * n.from[of(c)];
        });
        for (int c = 0; c < components; ++c) difference.add(taken_[s][c][p], expected[c]);
      }
    }
    EXPECT_GT(difference.largest, 0.0) << name_;
    EXPECT_LE(difference.error, tolerance() * difference.largest) << name_ << ": " << what;
  }

  static double load(const ReferenceNode& n, int c) { return n.load[c]; }

  std::unique_ptr<ScalarTransfer> transfer_;
  std::vector<std::vector<std::vector<double>>> numbers_, taken_;  ///< [set][component][particle]
};

}  // namespace mpm::test
