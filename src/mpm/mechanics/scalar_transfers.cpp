#include "mpm/mechanics/scalar_transfers.hpp"

#include <algorithm>

#include "mpm/mechanics/kernel_views.hpp"

namespace mpm {
namespace {

/// T is the precision of the particles.
template <class T>
class ScalarTransferOf final : public ScalarTransfer {
 public:
  ScalarTransferOf(const mpm_kernel::KernelTable<T>& kernels, Fields& fields, std::vector<ParticleSet>& sets,
                   int threads)
      : kernels_(kernels), fields_(fields), sets_(sets), threads_(threads) {}

  void gather(int field, const NodalField& from, const Taken& to) override {
    Grid& grid = look_at(field);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(to[s].begin(), to[s].end(), arrays_[s].to);
    each_owner_at_once(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      kernels_.gather(view_, block, views_.data(), arrays_.data(), count(), from.components(), from.block(0));
    });
  }

  void gradient(int field, const NodalField& from, const Taken& to) override {
    Grid& grid = look_at(field);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(to[s].begin(), to[s].end(), arrays_[s].to);
    each_owner_at_once(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      kernels_.gradient(view_, block, views_.data(), arrays_.data(), count(), from.block(0));
    });
  }

  void spread(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    each_giving(field, of, to, only, [&](const mpm_kernel::BlockView& block) {
      kernels_.spread(view_, block, views_.data(), arrays_.data(), count(), to.components(), weight == Weight::mass,
                      to.data());
    });
  }

  void spread_gradient(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    spread_by_gradient(field, of, weight, to, only);
  }

  void spread_gradient_sum(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    spread_by_gradient(field, of, weight, to, only);
  }

  void diffuse(int field, const Given& conducts, const NodalField& from, NodalField& to) override {
    each_giving(field, conducts, to, nullptr, [&](const mpm_kernel::BlockView& block) {
      kernels_.diffuse(view_, block, views_.data(), arrays_.data(), count(), from.block(0), to.data());
    });
  }

 private:
  int count() const { return static_cast<int>(views_.size()); }

  // Fields and particles may have been sorted or swapped since the last call.
  Grid& look_at(int field) {
    Grid& grid = *fields_[field];
    view_ = view_of(grid);
    views_.clear();
    for (ParticleSet& set : sets_) views_.push_back(view_of(set, kernels_, grid.first_owner));
    arrays_.assign(sets_.size(), {});
    return grid;
  }

  // The kernel tells the two apart by the number of components, which on a line is one for both, as the sum is.
  void spread_by_gradient(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) {
    each_giving(field, of, to, only, [&](const mpm_kernel::BlockView& block) {
      kernels_.spread_gradient(view_, block, views_.data(), arrays_.data(), count(), to.components(),
                               weight == Weight::mass, to.data());
    });
  }

  // pass(block) for those whose particles give to what is wanted, which begins with zero.
  template <class Pass>
  void each_giving(int field, const Given& of, NodalField& to, const Marks* only, Pass&& pass) {
    Grid& grid = look_at(field);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(of[s].begin(), of[s].end(), arrays_[s].from);
    const int blocks = grid.blocks.size();
    to.resize(blocks);
    if (only != nullptr) {
      find_givers(grid, *only, giving_);
      find_taking(grid);
    }
    const std::ptrdiff_t numbers = static_cast<std::ptrdiff_t>(to.components()) * grid.layout.nodes_per_block();
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int b = 0; b < blocks; ++b) {
      if (only == nullptr || taking_[b] != 0) std::fill_n(to.block(b), numbers, 0.0);
    }
    each_owner(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      if (only == nullptr || giving_[block.owner] != 0) pass(block);
    });
  }

  // Blocks that an owner at work gives to.
  void find_taking(const Grid& grid) {
    const BlockTable& blocks = grid.blocks;
    const int span = neighbours_of(grid.layout.dim());
    taking_.assign(blocks.size(), 0);
    for (int o = 0; o < blocks.owners(); ++o) {
      for (int i = 0; i < span && giving_[o] != 0; ++i) taking_[blocks.neighbours(o)[i]] = 1;
    }
  }

  mpm_kernel::KernelTable<T> kernels_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  int threads_;
  mpm_kernel::GridView view_{};
  std::vector<mpm_kernel::SetView<T>> views_;
  std::vector<mpm_kernel::ParticleArrays> arrays_;
  Marks giving_, taking_;  ///< of owners and of blocks, where only some are wanted
};

}  // namespace

template <class T>
std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                                     std::vector<ParticleSet>& sets, int threads) {
  return std::make_unique<ScalarTransferOf<T>>(kernels, fields, sets, threads);
}

template std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<double>&, Fields&,
                                                              std::vector<ParticleSet>&, int);
template std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<float>&, Fields&,
                                                              std::vector<ParticleSet>&, int);

}  // namespace mpm
