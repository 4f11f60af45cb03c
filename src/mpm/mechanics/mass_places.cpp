#include "mpm/mechanics/mass_places.hpp"

#include <utility>

namespace mpm {
namespace {

class MassPlaces final : public Stage {
 public:
  MassPlaces(std::unique_ptr<ScalarTransfer> transfer, Fields& fields, std::vector<ParticleSet>& sets, NearBall near)
      : transfer_(std::move(transfer)), fields_(fields), sets_(sets), near_(std::move(near)) {}

  std::string name() const override { return "mass_places"; }
  Ranks ranks(Hook) const override { return {Rank::mass_centre}; }

  void momentum_gathered(StepContext&) override {
    places_.assign(sets_.size(), {});
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      for (std::size_t k = 0; k < sets_[s].x.size(); ++k) places_[s][k] = sets_[s].x[k].data();
    }
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      find_near(*fields_[f]);
      transfer_->spread(static_cast<int>(f), places_, ScalarTransfer::Weight::mass, fields_[f]->place, &is_near_);
    }
  }

 private:
  void find_near(const Grid& grid) {
    const GridLayout& layout = grid.layout;
    is_near_.assign(grid.blocks.size(), 0);
    for (int number = 0; number < grid.blocks.size(); ++number) {
      const std::array<int, 3>& block = grid.blocks.block(number);
      const Vec3 low = layout.node_position(block, 0);
      const Vec3 high = layout.node_position(block, layout.nodes_per_block() - 1);
      is_near_[number] = near_(0.5 * (low + high), 0.5 * (high - low).norm()) ? 1 : 0;
    }
  }

  std::unique_ptr<ScalarTransfer> transfer_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  NearBall near_;
  ScalarTransfer::Given places_;
  ScalarTransfer::Marks is_near_;  ///< blocks of the field at work
};

}  // namespace

std::unique_ptr<Stage> make_mass_places(std::unique_ptr<ScalarTransfer> transfer, Fields& fields,
                                        std::vector<ParticleSet>& sets, NearBall near) {
  return std::make_unique<MassPlaces>(std::move(transfer), fields, sets, std::move(near));
}

}  // namespace mpm
