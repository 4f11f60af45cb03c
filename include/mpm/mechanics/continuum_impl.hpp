// Continuum: see continuum.hpp. Included by the files that instantiate it, one a geometry.
#pragma once

#include <algorithm>
#include <atomic>

#include "mpm/mechanics/block_kernels.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace mpm {

template <class Geometry, template <class> class Shape>
class Continuum final : public Mechanics {
  using Kernels = BlockKernels<Geometry, Shape>;
  static constexpr int kDim = Geometry::kDim;

 public:
  Continuum(std::vector<ParticleSet>& sets, const std::vector<Law>& laws, const ContinuumSettings& settings)
      : sets_(sets), laws_(laws), settings_(settings) {}

  void scatter_momentum(StepContext& context) override {
    failed_.reset();
    needs_sort_.store(false, std::memory_order_relaxed);
    clear({&context.grid.mass, &context.grid.momentum}, context.grid);
    each_owner(context.grid, [&](const typename Kernels::Block& block, int owner, const int* neighbours) {
      typename Kernels::MassMomentumTile tile;
      tile.clear();
      each_set(owner,
               [&](ParticleSet& set, int begin, int end) { Kernels::scatter_momentum(block, set, begin, end, tile); });
      tile.add_to(context.grid.momentum, neighbours, 0);
      tile.add_to(context.grid.mass, neighbours, kDim);
    });
    velocity_from_momentum(context.grid);
  }

  void strain_and_force(StepContext& context, double dt) override {
    clear({&context.grid.force}, context.grid);
    each_owner(context.grid, [&](const typename Kernels::Block& block, int owner, const int* neighbours) {
      typename Kernels::VectorTile velocity, force;
      velocity.load(context.grid.velocity, neighbours, 0);
      force.clear();
      each_set(owner, [&](ParticleSet& set, int begin, int end) {
        update_strain(block, set, begin, end, velocity, dt);
        Kernels::scatter_force(block, set, begin, end, force);
      });
      force.add_to(context.grid.force, neighbours, 0);
    });
  }

  void update_momentum(StepContext& context) override {
    Grid& grid = context.grid;
    const double dt = context.dt;
    each_node(grid, [&](int block, int node, double inverse_mass) {
      for (int c = 0; c < kDim; ++c) {
        const double gravity = settings_.gravity[grid.layout.axis(c)];
        const double a = inverse_mass > 0.0 ? grid.force.at(block, c, node) * inverse_mass + gravity : 0.0;
        grid.velocity.at(block, c, node) = grid.momentum.at(block, c, node) * inverse_mass + a * dt;
        grid.force.at(block, c, node) = a;
      }
    });
  }

  void move_particles(StepContext& context) override {
    each_owner(context.grid, [&](const typename Kernels::Block& block, int owner, const int* neighbours) {
      typename Kernels::MotionTile motion;
      load_motion(context.grid, neighbours, motion);
      each_set(owner, [&](ParticleSet& set, int begin, int end) {
        note_reach(Kernels::gather_motion(block, set, begin, end, motion, context.dt, settings_.flip, set.x));
      });
    });
  }

  void move_and_regather(StepContext& context) override {
    clear({&context.grid.momentum}, context.grid);
    each_owner(context.grid, [&](const typename Kernels::Block& block, int owner, const int* neighbours) {
      typename Kernels::MotionTile motion;
      typename Kernels::VectorTile momentum;
      load_motion(context.grid, neighbours, motion);
      momentum.clear();
      each_set(owner, [&](ParticleSet& set, int begin, int end) {
        note_reach(Kernels::gather_motion(block, set, begin, end, motion, context.dt, settings_.flip, set.next_x));
        Kernels::scatter_velocity(block, set, begin, end, momentum);
      });
      momentum.add_to(context.grid.momentum, neighbours, 0);
    });
    velocity_from_momentum(context.grid);
  }

  void strain_and_place(StepContext& context, double dt) override {
    each_owner(context.grid, [&](const typename Kernels::Block& block, int owner, const int* neighbours) {
      typename Kernels::VectorTile velocity;
      velocity.load(context.grid.velocity, neighbours, 0);
      each_set(owner,
               [&](ParticleSet& set, int begin, int end) { update_strain(block, set, begin, end, velocity, dt); });
    });
    for (ParticleSet& set : sets_) set.x.swap(set.next_x);
  }

  std::optional<ParticleRef> failed() const override { return failed_; }
  bool needs_sort() const override { return needs_sort_.load(std::memory_order_relaxed); }

 private:
  template <class Pass>
  void each_owner(const Grid& grid, Pass&& pass) {
    Kernels::each_owner(grid, settings_.threads, pass);
  }

  template <class Pass>
  void each_set(int owner, Pass&& pass) {
    for (ParticleSet& set : sets_) {
      const int begin = static_cast<int>(set.begin[owner]), end = static_cast<int>(set.begin[owner + 1]);
      if (begin < end) pass(set, begin, end);
    }
  }

  // pass(block, node, 1 / mass), with 0 for a node that no particle touches.
  template <class Pass>
  void each_node(Grid& grid, Pass&& pass) {
    const int nodes = grid.layout.nodes_per_block();
#pragma omp parallel for schedule(static) num_threads(settings_.threads)
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < nodes; ++n) pass(b, n, grid.carries(b, n) ? 1.0 / grid.mass.at(b, 0, n) : 0.0);
    }
  }

  void clear(std::initializer_list<NodalField*> fields, const Grid& grid) {
    for (NodalField* field : fields) {
      const int count = field->components() * grid.layout.nodes_per_block();
#pragma omp parallel for schedule(static) num_threads(settings_.threads)
      for (int b = 0; b < grid.blocks.size(); ++b) std::fill_n(field->block(b), count, 0.0);
    }
  }

  void velocity_from_momentum(Grid& grid) {
    each_node(grid, [&](int block, int node, double inverse_mass) {
      for (int c = 0; c < kDim; ++c) {
        grid.velocity.at(block, c, node) = grid.momentum.at(block, c, node) * inverse_mass;
      }
    });
  }

  static void load_motion(const Grid& grid, const int* neighbours, typename Kernels::MotionTile& tile) {
    tile.load(grid.velocity, neighbours, 0);
    tile.load(grid.force, neighbours, kDim);
  }

  void update_strain(const typename Kernels::Block& block, ParticleSet& set, int begin, int end,
                     const typename Kernels::VectorTile& velocity, double dt) {
    std::visit(
        [&](const auto& law) {
          typename Kernels::Gradients gradients;
          for (int first = begin; first < end; first += Kernels::kChunk) {
            const int count = std::min(end - first, Kernels::kChunk);
            Kernels::gather_gradient(block, set, first, count, velocity, gradients);
            const int bad = Kernels::update_stress(law, set, first, count, gradients, dt, settings_.gradient_terms);
            if (bad < count) note_failure(set, first + bad);
          }
        },
        laws_[&set - sets_.data()]);
  }

  void note_reach(bool within) {
    if (!within) needs_sort_.store(true, std::memory_order_relaxed);
  }

  void note_failure(const ParticleSet& set, int p) {
#pragma omp critical(mpm_failure)
    {
      if (!failed_ || set.id[p] < sets_[failed_->set].id[failed_->index]) {
        failed_ = ParticleRef{static_cast<int>(&set - sets_.data()), p};
      }
    }
  }

  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  ContinuumSettings settings_;
  std::optional<ParticleRef> failed_;
  std::atomic<bool> needs_sort_{false};
};

}  // namespace mpm
