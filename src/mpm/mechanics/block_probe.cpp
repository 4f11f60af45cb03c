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
              const std::vector<Law>& laws, bool averaged, int threads)
      : kernels_(kernels),
        fields_(fields),
        sets_(sets),
        laws_(laws),
        averaged_(averaged),
        threads_(threads),
        dim_(fields.front()->layout.dim()),
        nodes_(fields.front()->layout.nodes_per_block()),
        places_(neighbours_of(dim_)),
        mass_(places_.size() * nodes_),
        momentum_(mass_.size() * dim_),
        force_(mass_.size() * dim_),
        stress_(averaged ? mass_.size() : 0),
        pressure_(stress_.size()),
        means_(averaged ? fields.size() : 0, NodalField(1, nodes_)) {
    std::iota(places_.begin(), places_.end(), 0);
  }

  // As Continuum does for its forces.
  void find_means() override {
    for (std::size_t f = 0; f < means_.size(); ++f) {
      Grid& grid = *fields_[f];
      NodalField& mean = means_[f];
      look_at(grid);
      mean.resize(grid.blocks.size());
      std::fill_n(mean.data(), mean.size(), 0.0);
      const mpm_kernel::GridView view = view_of(grid);
      const int count = static_cast<int>(views_.size());
      each_owner("sleep: means to the grid", grid, threads_, [&](const mpm_kernel::BlockView& block) {
        kernels_.spread_mean[true](view, block, views_.data(), count, mean.data());
      });
      for (int b = 0; b < grid.blocks.size(); ++b) {
        for (int n = 0; n < nodes_; ++n) {
          double& one = mean.at(b, 0, n);
          one = grid.carries(b, n) ? one / grid.mass.at(b, 0, n) : 0.0;
        }
      }
      for (const Grid::MeanAtRest& rests : grid.means_at_rest) {
        const double mass = grid.mass.at(rests.node.block, 0, rests.node.node);
        double& one = mean.at(rests.node.block, 0, rests.node.node);
        one = (mass * one + rests.stress) / (mass + rests.mass);
      }
    }
  }

  void find_forces(int field, int owner, BlockForces& result) override {
    Grid& grid = *fields_[field];
    look_at(grid);
    for (std::vector<double>* values : {&mass_, &momentum_, &force_, &stress_})
      std::fill(values->begin(), values->end(), 0.0);
    mpm_kernel::GridView view = view_of(grid);
    view.mass = mass_.data();
    view.momentum = momentum_.data();
    view.velocity = nullptr;
    view.force = force_.data();
    mpm_kernel::BlockView block = view_of(grid, owner);
    block.neighbours = places_.data();
    const int count = static_cast<int>(views_.size());
    kernels_.scatter_momentum[0](view, block, views_.data(), count);
    if (averaged_) {
      const int* around = grid.blocks.neighbours(owner);
      for (std::size_t b = 0; b < places_.size(); ++b) {
        std::copy_n(means_[field].block(around[b]), nodes_,
                    pressure_.begin() + static_cast<std::ptrdiff_t>(b) * nodes_);
      }
      kernels_.spread_mean[true](view, block, views_.data(), count, stress_.data());
    }
    kernels_.force(view, block, views_.data(), count, averaged_ ? pressure_.data() : nullptr);
    take_tile(result);
  }

  double fastest(int set, int first, int last, double cell) override {
    const mpm_kernel::SetView<T> view = view_of<T>(sets_[set], laws_[set], kernels_);
    return view.law_kernels->survey(view, first, last, cell).rate;
  }

 private:
  void look_at(const Grid& grid) {
    views_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      views_.push_back(view_of<T>(sets_[s], laws_[s], kernels_, grid.first_owner));
    }
  }

  // The tile's nodes, of the blocks around.
  void take_tile(BlockForces& result) const {
    each_tile_node(dim_, [&](int t, int block, int node) {
      const std::size_t at = static_cast<std::size_t>(block) * nodes_ + node;
      result.mass[t] = static_cast<float>(mass_[at]);
      if (averaged_) result.stress[t] = static_cast<float>(stress_[at]);
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
  bool averaged_;
  int threads_, dim_, nodes_;
  std::vector<int> places_;  ///< places of the 3^dim blocks that stand in for the grid
  std::vector<double> mass_, momentum_, force_;
  std::vector<double> stress_,
      pressure_;                   ///< stresses of the block, and means of all at its nodes, where they are averaged
  std::vector<NodalField> means_;  ///< mean stress at the nodes of each field, over the initial density [J/kg]
  std::vector<mpm_kernel::SetView<T>> views_;
};

}  // namespace

template <class T>
std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                             std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                             bool averaged, int threads) {
  return std::make_unique<KernelProbe<T>>(kernels, fields, sets, laws, averaged, threads);
}

template std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<double>&, Fields&,
                                                      std::vector<ParticleSet>&, const std::vector<Law>&, bool, int);
template std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<float>&, Fields&,
                                                      std::vector<ParticleSet>&, const std::vector<Law>&, bool, int);

}  // namespace mpm
