#include "mpm/mechanics/block_probe.hpp"

#include <algorithm>
#include <numeric>

#include "mpm/mechanics/kernel_views.hpp"

namespace mpm {
namespace {

static_assert(BlockForces::kEdge == mpm_kernel::kTileEdge && BlockForces::kMargin == mpm_kernel::kTileMargin);

template <class T>
class KernelProbe final : public BlockProbe {
 public:
  KernelProbe(const mpm_kernel::KernelTable<T>& kernels, Fields& fields, std::vector<ParticleSet>& sets,
              const std::vector<Law>& laws)
      : kernels_(kernels),
        fields_(fields),
        sets_(sets),
        laws_(laws),
        dim_(fields.front()->layout.dim()),
        nodes_(fields.front()->layout.nodes_per_block()),
        places_(neighbours_of(dim_)),
        mass_(places_.size() * nodes_),
        momentum_(mass_.size() * dim_),
        force_(mass_.size() * dim_) {
    std::iota(places_.begin(), places_.end(), 0);
  }

  void find_forces(int field, int owner, BlockForces& result) override {
    Grid& grid = *fields_[field];
    views_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      views_.push_back(view_of<T>(sets_[s], laws_[s], kernels_, grid.first_owner));
    }
    for (std::vector<double>* values : {&mass_, &momentum_, &force_}) std::fill(values->begin(), values->end(), 0.0);
    mpm_kernel::GridView view = view_of(grid);
    view.mass = mass_.data();
    view.momentum = momentum_.data();
    view.velocity = nullptr;
    view.force = force_.data();
    mpm_kernel::BlockView block = view_of(grid, owner);
    block.neighbours = places_.data();
    const int count = static_cast<int>(views_.size());
    kernels_.scatter_momentum[0](view, block, views_.data(), count);
    kernels_.force(view, block, views_.data(), count, nullptr);
    take_tile(result);
  }

  double fastest(int set, int first, int last, double cell) override {
    const mpm_kernel::SetView<T> view = view_of<T>(sets_[set], laws_[set], kernels_);
    return view.law_kernels->survey(view, first, last, cell).rate;
  }

 private:
  // The tile's nodes, of the blocks around.
  void take_tile(BlockForces& result) const {
    each_tile_node(dim_, [&](int t, int block, int node) {
      result.mass[t] = static_cast<float>(mass_[static_cast<std::size_t>(block) * nodes_ + node]);
      for (int k = 0; k < dim_; ++k) {
        const std::size_t from = (static_cast<std::size_t>(block) * dim_ + k) * nodes_ + node;
        result.force[k][t] = static_cast<float>(force_[from]);
      }
    });
  }

  mpm_kernel::KernelTable<T> kernels_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  int dim_, nodes_;
  std::vector<int> places_;  ///< places of the 3^dim blocks that stand in for the grid
  std::vector<double> mass_, momentum_, force_;
  std::vector<mpm_kernel::SetView<T>> views_;
};

}  // namespace

template <class T>
std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                             std::vector<ParticleSet>& sets, const std::vector<Law>& laws) {
  return std::make_unique<KernelProbe<T>>(kernels, fields, sets, laws);
}

template std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<double>&, Fields&,
                                                      std::vector<ParticleSet>&, const std::vector<Law>&);
template std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<float>&, Fields&,
                                                      std::vector<ParticleSet>&, const std::vector<Law>&);

}  // namespace mpm
