#include "mpm/mechanics/body_force.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <limits>
#include <string>

#include "mpm/mechanics/kernel_views.hpp"

namespace mpm {
namespace {

/// T is the precision of the particles.
template <class T>
class ParticleLoad final : public BodyForce {
  /// Particles whose sum is made in one go, so that it does not depend on the number of threads.
  static constexpr int kGroup = 1024;

 public:
  ParticleLoad(const mpm_kernel::KernelTable<T>& kernels, std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
               const std::vector<BodyForceTerm>& terms, int threads)
      : kernels_(kernels),
        dim_(static_cast<int>(sets.front().x.size())),
        sets_(sets),
        laws_(laws),
        threads_(threads),
        nodal_(dim_, nodes_of_block(dim_)) {
    account_.name = "body_force";
    for (const BodyForceTerm& term : terms) {
      Term own{term.set, {}};
      for (int thread = 0; thread < threads; ++thread) {
        own.copies.push_back(
            {term.acceleration[0].own_copy(), term.acceleration[1].own_copy(), term.acceleration[2].own_copy()});
      }
      terms_.push_back(std::move(own));
    }
    values_.resize(sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (acts_on(s)) values_[s].assign(dim_, PaddedArray<double>(sets[s].size(), 0.0));
    }
    int groups = 1;
    for (const ParticleSet& set : sets) groups = std::max(groups, (set.size() + kGroup - 1) / kGroup);
    sums_.resize(groups);
    faults_.resize(threads);
  }

  void forces_gathered(StepContext& context) override {
    Grid& grid = context.grid;
    evaluate(context);
    nodal_.resize(grid.blocks.size());
    const int count = dim_ * grid.layout.nodes_per_block();
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int b = 0; b < grid.blocks.size(); ++b) std::fill_n(nodal_.block(b), count, 0.0);
    const mpm_kernel::GridView view = view_of(grid);
    views_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      views_.push_back(view_of<T>(sets_[s], laws_[s], kernels_.laws));
      for (std::size_t k = 0; k < values_[s].size(); ++k) views_.back().load[k] = values_[s][k].data();
    }
    each_owner(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      kernels_.scatter_load(view, block, views_.data(), static_cast<int>(views_.size()), nodal_.data());
    });
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int b = 0; b < grid.blocks.size(); ++b) {
      double* force = grid.force.block(b);
      const double* load = nodal_.block(b);
      for (int n = 0; n < count; ++n) force[n] += load[n];
    }
  }

  void momentum_updated(StepContext& context) override {
    const Grid& grid = context.grid;
    const int count = dim_ * grid.layout.nodes_per_block();
    double power = 0.0;
    for (int b = 0; b < grid.blocks.size(); ++b) {
      const double *load = nodal_.block(b), *v = grid.velocity.block(b), *a = grid.force.block(b);
      // The displacement of a particle in the step: v^{n+1} dt - a dt^2 / 2, GIMP notes (2.16).
      for (int n = 0; n < count; ++n) power += load[n] * (v[n] - 0.5 * context.dt * a[n]);
    }
    work_ += power * context.dt;
  }

  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  double work() const override { return work_; }

 private:
  struct Term {
    std::optional<int> set;
    std::vector<std::array<Function, 3>> copies;  ///< of each thread: an expression holds one evaluation at a time
  };
  /// A value that is not there, of the particle with the smallest id that a thread has met.
  struct Fault {
    std::uint32_t id = std::numeric_limits<std::uint32_t>::max();
    std::string text;
  };

  bool acts_on(std::size_t set) const {
    return std::any_of(terms_.begin(), terms_.end(),
                       [&](const Term& term) { return !term.set || *term.set == static_cast<int>(set); });
  }

  // Acceleration of every particle, and the impulse that it is.
  void evaluate(const StepContext& context) {
    const GridLayout& layout = context.grid.layout;
    Vec3 impulse = Vec3::Zero();
    for (Fault& fault : faults_) fault = {};
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (values_[s].empty()) continue;
      const ParticleSet& set = sets_[s];
      const int groups = (set.size() + kGroup - 1) / kGroup;
#pragma omp parallel num_threads(threads_)
      {
        const int thread = omp_get_thread_num();
#pragma omp for schedule(static)
        for (int g = 0; g < groups; ++g) {
          sums_[g] = Vec3::Zero();
          const int end = std::min(set.size(), (g + 1) * kGroup);
          for (int p = g * kGroup; p < end; ++p) sums_[g] += at_particle(context, s, p, thread);
        }
      }
      for (int g = 0; g < groups; ++g) impulse += sums_[g] * (set.mass * context.dt);
    }
    const auto fault =
        std::min_element(faults_.begin(), faults_.end(), [](const Fault& a, const Fault& b) { return a.id < b.id; });
    if (!fault->text.empty()) throw LoadError(fault->text);
    Vec3 along = Vec3::Zero();  // no momentum along axes that the grid does not have
    for (int k = 0; k < dim_; ++k) along[layout.axis(k)] = impulse[layout.axis(k)];
    account_.add(along);
  }

  Vec3 at_particle(const StepContext& context, std::size_t s, int p, int thread) {
    const GridLayout& layout = context.grid.layout;
    const ParticleSet& set = sets_[s];
    const double half = 0.5 * context.dt;
    Vec3 place = Vec3::Zero(), start = Vec3::Zero(), b = Vec3::Zero();
    for (int k = 0; k < dim_; ++k) {
      place[layout.axis(k)] = set.x[k][p] + half * set.v[k][p];
      if (!set.start_x.empty()) start[layout.axis(k)] = set.start_x[k][p];
    }
    for (Term& term : terms_) {
      if (term.set && *term.set != static_cast<int>(s)) continue;
      for (int k = 0; k < dim_; ++k) {
        const int axis = layout.axis(k);
        try {
          b[axis] += term.copies[thread][axis](context.start + half, place, start);
        } catch (const FunctionError& error) {
          Fault& fault = faults_[thread];
          if (set.id[p] >= fault.id) continue;
          fault = {set.id[p], fmt::format("body force on '{}', along {}: {}", set.name, "xyz"[axis], error.what())};
        }
      }
    }
    for (int k = 0; k < dim_; ++k) values_[s][k][p] = b[layout.axis(k)];
    return b;
  }

  mpm_kernel::KernelTable<T> kernels_;
  int dim_;
  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  int threads_;
  std::vector<Term> terms_;
  std::vector<std::vector<PaddedArray<double>>> values_;  ///< acceleration of each set's particles, by axis [m/s^2]
  std::vector<mpm_kernel::SetView<T>> views_;
  NodalField nodal_;  ///< load of each node in this step [N]
  std::vector<Vec3> sums_;
  std::vector<Fault> faults_;
  ImpulseAccount account_;
  double work_ = 0.0;
};

}  // namespace

template <class T>
std::unique_ptr<BodyForce> make_body_force(const mpm_kernel::KernelTable<T>& kernels, std::vector<ParticleSet>& sets,
                                           const std::vector<Law>& laws, const std::vector<BodyForceTerm>& terms,
                                           int threads) {
  return std::make_unique<ParticleLoad<T>>(kernels, sets, laws, terms, threads);
}

template std::unique_ptr<BodyForce> make_body_force(const mpm_kernel::KernelTable<double>&, std::vector<ParticleSet>&,
                                                    const std::vector<Law>&, const std::vector<BodyForceTerm>&, int);
template std::unique_ptr<BodyForce> make_body_force(const mpm_kernel::KernelTable<float>&, std::vector<ParticleSet>&,
                                                    const std::vector<Law>&, const std::vector<BodyForceTerm>&, int);

}  // namespace mpm
