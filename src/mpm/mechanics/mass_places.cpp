#include "mpm/mechanics/mass_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/mechanics/kernel_views.hpp"

namespace mpm {
namespace {

/// T is the precision of the particles.
template <class T>
class MassPlaces final : public Stage {
 public:
  MassPlaces(const mpm_kernel::KernelTable<T>& kernels, Fields& fields, std::vector<ParticleSet>& sets,
             const std::vector<Law>& laws, NearBall near, int threads)
      : kernels_(kernels), fields_(fields), sets_(sets), laws_(laws), near_(std::move(near)), threads_(threads) {}

  std::string name() const override { return "mass_places"; }
  Ranks ranks(Hook) const override { return {Rank::mass_centre}; }

  void momentum_gathered(StepContext&) override {
    for (auto& grid : fields_) fill(*grid);
  }

 private:
  void fill(Grid& grid) {
    const GridLayout& layout = grid.layout;
    const int count = layout.dim() * layout.nodes_per_block();
    grid.place.resize(grid.blocks.size());
    find_near(grid);
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      if (is_near_[owner] == 0) continue;
      for (int i = 0; i < neighbours(layout.dim()); ++i) {
        std::fill_n(grid.place.block(grid.blocks.neighbours(owner)[i]), count, 0.0);
      }
    }
    const mpm_kernel::GridView view = view_of(grid);
    views_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      views_.push_back(view_of<T>(sets_[s], laws_[s], kernels_.laws, grid.first_owner));
      for (int k = 0; k < layout.dim(); ++k) views_.back().load[k] = sets_[s].x[k].data();
    }
    each_owner(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      if (is_near_[block.owner] == 0) return;
      kernels_.scatter_load(view, block, views_.data(), static_cast<int>(views_.size()), grid.place.data());
    });
  }

  void find_near(const Grid& grid) {
    const GridLayout& layout = grid.layout;
    is_near_.assign(grid.blocks.owners(), 0);
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      const std::array<int, 3>& block = grid.blocks.block(grid.blocks.owner_block(owner));
      const Vec3 low = layout.node_position(block, 0);
      const Vec3 high = layout.node_position(block, layout.nodes_per_block() - 1);
      is_near_[owner] = near_(0.5 * (low + high), 0.5 * (high - low).norm()) ? 1 : 0;
    }
  }
  static int neighbours(int dim) { return dim == 3 ? 27 : (dim == 2 ? 9 : 3); }

  mpm_kernel::KernelTable<T> kernels_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  NearBall near_;
  int threads_;
  std::vector<mpm_kernel::SetView<T>> views_;
  std::vector<std::uint8_t> is_near_;  ///< of each owner of the field at work
};

}  // namespace

template <class T>
std::unique_ptr<Stage> make_mass_places(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                        std::vector<ParticleSet>& sets, const std::vector<Law>& laws, NearBall near,
                                        int threads) {
  return std::make_unique<MassPlaces<T>>(kernels, fields, sets, laws, std::move(near), threads);
}

template std::unique_ptr<Stage> make_mass_places(const mpm_kernel::KernelTable<double>&, Fields&,
                                                 std::vector<ParticleSet>&, const std::vector<Law>&, NearBall, int);
template std::unique_ptr<Stage> make_mass_places(const mpm_kernel::KernelTable<float>&, Fields&,
                                                 std::vector<ParticleSet>&, const std::vector<Law>&, NearBall, int);

}  // namespace mpm
