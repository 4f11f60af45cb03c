#include "mpm/mechanics/scalar_transfers.hpp"

#include <algorithm>
#include <numeric>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/mechanics/kernel_views.hpp"
#include "mpm/ranks/of_all.hpp"

namespace mpm {
namespace {

constexpr const char *kToGrid = "transfer: particles to nodes", *kToParticles = "transfer: nodes to particles",
                     *kDiffusion = "transfer: diffusion";

/// T is the precision of the particles.
template <class T>
class ScalarTransferOf final : public ScalarTransfer {
 public:
  ScalarTransferOf(const mpm_kernel::KernelTable<T>& kernels, Fields& fields, std::vector<ParticleSet>& sets,
                   int threads, NodeChoice* choice, Halo* halo)
      : kernels_(kernels),
        fields_(fields),
        sets_(sets),
        threads_(threads),
        choice_(choice),
        halo_(halo),
        own_{NodalField(1, fields.front()->layout.nodes_per_block()),
             NodalField(fields.front()->layout.dim(), fields.front()->layout.nodes_per_block())},
        flow_(1, fields.front()->layout.nodes_per_block()) {}

  void gather(int field, const NodalField& from, const Taken& to, const Marks* only) override {
    each_taking(field, from, to, only, [&](const mpm_kernel::BlockView& block, const NodalField& source) {
      kernels_.gather(view_, block, views_.data(), arrays_.data(), count(), source.components(), source.block(0));
    });
  }

  void gradient(int field, const NodalField& from, const Taken& to, const Marks* only) override {
    each_taking(field, from, to, only, [&](const mpm_kernel::BlockView& block, const NodalField& source) {
      kernels_.gradient(view_, block, views_.data(), arrays_.data(), count(), source.block(0));
    });
  }

  void slopes(int field, const NodalField& from, const Taken& to) override {
    each_taking(field, from, to, nullptr, [&](const mpm_kernel::BlockView& block, const NodalField& source) {
      kernels_.slopes(view_, block, views_.data(), arrays_.data(), count(), source.block(0));
    });
  }

  void slope_lead(const Taken& to) override {
    const auto at = [&](Grid& grid) {
      look_at(grid);
      for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(to[s].begin(), to[s].end(), arrays_[s].to);
      each_owner_at_once(kToParticles, grid, threads_, [&](const mpm_kernel::BlockView& block) {
        kernels_.slope_lead(view_, block, views_.data(), arrays_.data(), count());
      });
    };
    for (const auto& field : fields_) at(*field);
    if (choice_ != nullptr && choice_->patches() > 0) at(choice_->grid());
  }

  void spread(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    each_giving(field, of, to, only, [&](const mpm_kernel::BlockView& block, NodalField& sink) {
      kernels_.spread(view_, block, views_.data(), arrays_.data(), count(), sink.components(), weight == Weight::mass,
                      sink.data());
    });
  }

  void spread_gradient(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    spread_by_gradient(field, of, weight, to, only);
  }

  void spread_gradient_sum(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) override {
    spread_by_gradient(field, of, weight, to, only);
  }

  void diffuse(int field, const Given& conducts, const NodalField& from, NodalField& to) override {
    give_own(field, conducts, to, nullptr, [&](const mpm_kernel::BlockView& block, NodalField& sink) {
      kernels_.diffuse(view_, block, views_.data(), arrays_.data(), count(), from.block(0), sink.data());
    });
    if (!chosen_from(field)) add_of_others(halo_, field, to);  // else diffuse_chosen() has more to give
  }

  void diffuse_chosen(const Given& conducts, const std::vector<NodalField>& from,
                      std::vector<NodalField>& to) override {
    if (choice_ == nullptr) return;
    if (choice_->patches() > 0) diffuse_in_patches(conducts, from, to);
    for (const int field : choice_->chosen()) add_of_others(halo_, field, to[field]);
  }

  void spread_of_block(int field, int owner, const Given& of, Weight weight, NodalField& around) override {
    give_around(field, owner, of, around, [&](const mpm_kernel::BlockView& block) {
      kernels_.spread(view_, block, views_.data(), arrays_.data(), count(), around.components(), weight == Weight::mass,
                      around.data());
    });
  }

  void spread_gradient_of_block(int field, int owner, const Given& of, Weight weight, NodalField& around) override {
    give_around(field, owner, of, around, [&](const mpm_kernel::BlockView& block) {
      kernels_.spread_gradient(view_, block, views_.data(), arrays_.data(), count(), around.components(),
                               weight == Weight::mass, around.data());
    });
  }

  void gradient_of_block(int field, int owner, const NodalField& from, const Taken& to) override {
    Grid& grid = *fields_[field];
    look_at(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(to[s].begin(), to[s].end(), arrays_[s].to);
    kernels_.gradient(view_, view_of(grid, owner), views_.data(), arrays_.data(), count(), from.block(0));
  }

 private:
  // pass(block), whose neighbours are the blocks of `around`.
  template <class Pass>
  void give_around(int field, int owner, const Given& of, NodalField& around, Pass&& pass) {
    Grid& grid = *fields_[field];
    look_at(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(of[s].begin(), of[s].end(), arrays_[s].from);
    const int blocks = neighbours_of(grid.layout.dim());
    std::array<int, 27> places{};
    std::iota(places.begin(), places.end(), 0);
    around.resize(blocks);
    std::fill_n(around.data(), around.size(), 0.0);
    mpm_kernel::BlockView block = view_of(grid, owner);
    block.neighbours = places.data();
    pass(block);
  }

  void diffuse_in_patches(const Given& conducts, const std::vector<NodalField>& from, std::vector<NodalField>& to) {
    Grid& patches = choice_->grid();
    NodalField &source = own_[0], &sink = flow_;
    source.resize(patches.blocks.size());
    sink.resize(patches.blocks.size());
    // Nodes that stand for none are read with no weight.
    const std::ptrdiff_t numbers =
        static_cast<std::ptrdiff_t>(patches.blocks.size()) * patches.layout.nodes_per_block();
    std::fill_n(source.data(), numbers, 0.0);
    std::fill_n(sink.data(), numbers, 0.0);
    for (const int field : choice_->chosen()) choice_->take(from[field], field, source);
    look_at(patches);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(conducts[s].begin(), conducts[s].end(), arrays_[s].from);
    each_owner_at_once(kDiffusion, patches, threads_, [&](const mpm_kernel::BlockView& block) {
      kernels_.diffuse(view_, block, views_.data(), arrays_.data(), count(), source.block(0), sink.data());
    });
    for (const int field : choice_->chosen()) choice_->give(sink, field, to[field]);
  }

  int count() const { return static_cast<int>(views_.size()); }
  bool chosen_from(int field) const {
    return choice_ != nullptr &&
           std::find(choice_->chosen().begin(), choice_->chosen().end(), field) != choice_->chosen().end();
  }
  bool chosen(int field) const { return choice_ != nullptr && choice_->patches() > 0 && chosen_from(field); }

  // Fields and particles may have been sorted or swapped since the last call.
  void look_at(Grid& grid) {
    view_ = view_of(grid);
    views_.clear();
    for (ParticleSet& set : sets_) views_.push_back(view_of(set, kernels_, grid.first_owner));
    arrays_.assign(sets_.size(), {});
  }

  // pass(block, field to take from)
  template <class Pass>
  void each_taking(int field, const NodalField& from, const Taken& to, const Marks* only, Pass&& pass) {
    Grid& grid = *fields_[field];
    look_at(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(to[s].begin(), to[s].end(), arrays_[s].to);
    each_owner_at_once(kToParticles, grid, threads_, [&](const mpm_kernel::BlockView& block) {
      if (only == nullptr || (*only)[grid.blocks.owner_block(block.owner)] != 0) pass(block, from);
    });
    if (!chosen(field)) return;

    // Sum over the fields for a patch: of the first in the array itself, of others through memory beside.
    Grid& patches = choice_->grid();
    NodalField& own = own_[from.components() > 1];
    own.resize(patches.blocks.size());
    choice_->clear(own);
    choice_->take(from, field, own);
    look_at(patches);
    beside_.resize(sets_.size());
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      for (int k = 0; k < 3; ++k) {
        if (to[s][k] == nullptr) continue;
        if (sets_[s].field != field) beside_[s][k].resize(sets_[s].id.size());
        arrays_[s].to[k] = sets_[s].field == field ? to[s][k] : beside_[s][k].data();
      }
    }
    each_owner_at_once(kToParticles, patches, threads_, [&](const mpm_kernel::BlockView& block) { pass(block, own); });
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const ParticleSet& set = sets_[s];
      for (int k = 0; k < 3 && set.field != field; ++k) {
        if (to[s][k] == nullptr) continue;
        for (std::uint32_t p = set.begin[patches.first_owner]; p < set.begin.back(); ++p) {
          to[s][k][p] += beside_[s][k][p];
        }
      }
    }
  }

  // The kernel tells the two apart by the number of components, which on a line is one for both, as the sum is.
  void spread_by_gradient(int field, const Given& of, Weight weight, NodalField& to, const Marks* only) {
    each_giving(field, of, to, only, [&](const mpm_kernel::BlockView& block, NodalField& sink) {
      kernels_.spread_gradient(view_, block, views_.data(), arrays_.data(), count(), sink.components(),
                               weight == Weight::mass, sink.data());
    });
  }

  // pass(block, field to add to) for those whose particles give to what is wanted, which begins with zero. Without
  // particles that choose their fields.
  template <class Pass>
  void give_own(int field, const Given& of, NodalField& to, const Marks* only, Pass&& pass) {
    Grid& grid = *fields_[field];
    look_at(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(of[s].begin(), of[s].end(), arrays_[s].from);
    to.resize(grid.blocks.size());
    if (only != nullptr) {
      find_givers(grid, *only, giving_);
      find_taking(grid);
    }
    const std::ptrdiff_t numbers = static_cast<std::ptrdiff_t>(to.components()) * grid.layout.nodes_per_block();
    for_blocks(kToGrid, grid, threads_, [&](int b) {
      if (only == nullptr || taking_[b] != 0 || (*only)[b] != 0) std::fill_n(to.block(b), numbers, 0.0);
    });
    each_owner(kToGrid, grid, threads_, [&](const mpm_kernel::BlockView& block) {
      if (only == nullptr || giving_[block.owner] != 0) pass(block, to);
    });
  }

  template <class Pass>
  void each_giving(int field, const Given& of, NodalField& to, const Marks* only, Pass&& pass) {
    give_own(field, of, to, only, pass);
    if (chosen(field)) give_of_patches(field, of, to, only, pass);
    add_of_others(halo_, field, to);
  }

  template <class Pass>
  void give_of_patches(int field, const Given& of, NodalField& to, const Marks* only, Pass&& pass) {
    Grid& patches = choice_->grid();
    NodalField& own = own_[to.components() > 1];
    own.resize(patches.blocks.size());
    const std::ptrdiff_t numbers = static_cast<std::ptrdiff_t>(to.components()) * patches.layout.nodes_per_block();
    std::fill_n(own.data(), numbers * patches.blocks.size(), 0.0);
    look_at(patches);
    for (std::size_t s = 0; s < sets_.size(); ++s) std::copy(of[s].begin(), of[s].end(), arrays_[s].from);
    if (only != nullptr) choice_->find_givers(field, *only, giving_);
    each_owner_at_once(kToGrid, patches, threads_, [&](const mpm_kernel::BlockView& block) {
      if (only == nullptr || giving_[block.owner] != 0) pass(block, own);
    });
    choice_->give(own, field, to);
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
  NodeChoice* choice_;
  Halo* halo_;
  std::array<NodalField, 2> own_;  ///< values of the patches, of one component and of one along each axis
  NodalField flow_;                ///< flow of the patches
  std::vector<std::array<PaddedArray<double>, 3>> beside_;
  mpm_kernel::GridView view_{};
  std::vector<mpm_kernel::SetView<T>> views_;
  std::vector<mpm_kernel::ParticleArrays> arrays_;
  Marks giving_, taking_;  ///< marks of owners and of blocks, if only some are wanted
};

}  // namespace

template <class T>
std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                                     std::vector<ParticleSet>& sets, int threads, NodeChoice* choice,
                                                     Halo* halo) {
  return std::make_unique<ScalarTransferOf<T>>(kernels, fields, sets, threads, choice, halo);
}

template std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<double>&, Fields&,
                                                              std::vector<ParticleSet>&, int, NodeChoice*, Halo*);
template std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<float>&, Fields&,
                                                              std::vector<ParticleSet>&, int, NodeChoice*, Halo*);

}  // namespace mpm
