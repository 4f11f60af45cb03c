#include "mpm/crack/side_places.hpp"

#include "mpm/mechanics/kernel_views.hpp"

namespace mpm {

SidePlaces::SidePlaces(std::unique_ptr<ScalarTransfer> transfer, const Fields& fields, const Grid& patches,
                       const std::vector<ParticleSet>& sets)
    : transfer_(std::move(transfer)),
      fields_(fields),
      patches_(patches),
      sets_(sets),
      numbers_(sets.size()),
      sums_(fields.size(), std::vector<NodalField>(4, NodalField(2, fields.front()->layout.nodes_per_block()))) {}

void SidePlaces::fill(std::size_t s, std::uint32_t first, std::uint32_t last) {
  const ParticleSet& set = sets_[s];
  Numbers& to = numbers_[s];
  for (std::uint32_t p = first; p < last; ++p) {
    const double xx = set.f[0][p], xz = set.f[1][p], zx = set.f[2][p], zz = set.f[3][p];
    const double d = xx * zz - xz * zx;
    const double h[2][2] = {{1.0 - zz / d, xz / d}, {zx / d, 1.0 - xx / d}};
    for (int c = 0; c < 2; ++c) {
      to.offset[c][p] = set.x[c][p] - set.start_x[c][p] - h[c][0] * set.x[0][p] - h[c][1] * set.x[1][p];
      for (int k = 0; k < 2; ++k) to.slope[c][k][p] = h[c][k];
    }
  }
}

template <class Number>
void SidePlaces::spread(int field, NodalField& to, const std::vector<std::uint8_t>& marked, Number&& number) {
  given_.assign(sets_.size(), {});
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    for (std::size_t k = 0; k < 2; ++k) given_[s][k] = number(s, k).data();
  }
  transfer_->spread(field, given_, ScalarTransfer::Weight::mass, to, &marked);
}

void SidePlaces::survey(int field, const std::vector<std::uint8_t>& marked, bool displacements, bool places) {
  const Grid& grid = *fields_[field];
  if (displacements) {
    find_givers(grid, marked, givers_);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const ParticleSet& set = sets_[s];
      Numbers& numbers = numbers_[s];
      if (numbers.offset[0].size() != set.id.size()) {
        for (auto* list : {&numbers.offset, &numbers.slope[0], &numbers.slope[1]}) {
          for (PaddedArray<double>& of : *list) of.assign(set.id.size(), 0.0);
        }
      }
      for (int o = 0; o < grid.blocks.owners(); ++o) {
        const std::uint32_t* begin = set.begin.data() + grid.first_owner + o;
        if (givers_[o] != 0) fill(s, begin[0], begin[1]);
      }
      if (!filled_) fill(s, set.begin[patches_.first_owner], set.begin.back());
    }
    filled_ = true;
    std::vector<NodalField>& sums = sums_[field];
    spread(
        field, sums[0], marked, [&](std::size_t s, std::size_t k) -> auto& { return numbers_[s].offset[k]; });
    for (std::size_t c = 0; c < 2; ++c) {
      spread(
          field, sums[1 + c], marked, [&](std::size_t s, std::size_t k) -> auto& { return numbers_[s].slope[c][k]; });
    }
  }
  if (places) {
    spread(
        field, sums_[field][3], marked, [&](std::size_t s, std::size_t k) -> auto& { return sets_[s].x[k]; });
  }
}

Vec2 SidePlaces::displacement(int field, NodeRef node, const Vec2& place, double mass) const {
  const std::vector<NodalField>& sums = sums_[field];
  Vec2 sum;
  for (int c = 0; c < 2; ++c) {
    sum[c] = sums[0].at(node.block, c, node.node);
    for (int k = 0; k < 2; ++k) sum[c] += sums[1 + c].at(node.block, k, node.node) * place[k];
  }
  return sum / mass;
}

Vec2 SidePlaces::place(int field, NodeRef node, double mass) const {
  const NodalField& sums = sums_[field][3];
  return Vec2(sums.at(node.block, 0, node.node), sums.at(node.block, 1, node.node)) / mass;
}

}  // namespace mpm
