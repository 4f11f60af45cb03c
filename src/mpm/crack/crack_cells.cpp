#include "mpm/crack/crack_cells.hpp"

#include "mpm/crack/crossing.hpp"

namespace mpm {
namespace {

bool within(const Vec2& place, const Vec2& low, const Vec2& high) {
  return (place.array() >= low.array()).all() && (place.array() < high.array()).all();
}

}  // namespace

Vec2 CrackCells::corner(const std::array<int, 3>& cell) const {
  Vec2 place;
  for (int k = 0; k < 2; ++k) place[k] = layout_.origin(k) + layout_.cell(k) * (kBlockEdge * block_[k] + cell[k]);
  return place;
}

void CrackCells::look_at(const std::array<int, 3>& block) {
  block_ = block;
  cuts_.clear();
  of_cell_.fill(0);
  const Vec2 edge(layout_.cell(0), layout_.cell(1));
  near_.resize(cracks_.size());
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const Chain& chain = cracks_[c].chain;
    near_[c] = {};
    if (!cracks_[c].felt) continue;
    near_[c] = part_between(chain, whole_line(chain), corner({-1, -1, 0}), corner({kBlockEdge, kBlockEdge, 0}));
  }
  const bool tools = tools_.meet(corner({-1, -1, 0}), corner({kBlockEdge, kBlockEdge, 0}));
  for (int i = 0; i < kEdge; ++i) {
    for (int j = 0; j < kEdge; ++j) {
      const Vec2 low = corner({i - 1, j - 1, 0}), high = low + edge;
      for (std::size_t c = 0; c < cracks_.size(); ++c) {
        const Chain& chain = cracks_[c].chain;
        if (near_[c].misses(low, high)) continue;
        const LinePart part = part_between(chain, near_[c], low, high);
        if (part.points < 2 || within(chain.line().front(), low, high) || within(chain.line().back(), low, high)) {
          continue;
        }
        cuts_.push_back({static_cast<int>(c), part});
      }
      for (int t = 0; tools && t < tools_.count(); ++t) {
        if (tools_.parts(t, low, high)) cuts_.push_back({static_cast<int>(cracks_.size()) + t, {}});
      }
      of_cell_[kEdge * i + j + 1] = static_cast<int>(cuts_.size());
    }
  }
}

int CrackCells::part_of(const ParticleSet& set, const std::array<int, 3>& cell, const Vec2& place) const {
  const std::size_t number = static_cast<std::size_t>(&set - sets_.data());
  const int at = kEdge * (cell[0] + 1) + cell[1] + 1;
  int part = 0, cracks = 0;
  for (int cut = of_cell_[at]; cut < of_cell_[at + 1] && cracks < kMostCracks; ++cut) {
    if (const int tool = cuts_[cut].crack - static_cast<int>(cracks_.size()); tool >= 0) {
      if (!tools_.divides(tool, number)) continue;
      if (tools_.above(tool, place)) part |= 1 << cracks;
      ++cracks;
      continue;
    }
    const Crack& crack = cracks_[cuts_[cut].crack];
    if (crack.divides[number] == 0) continue;
    const LinePart& of = cuts_[cut].part;
    if (find_crossing(crack.chain.line().data() + of.first, of.points, place, corner(cell)).crosses)
      part |= 1 << cracks;
    ++cracks;
  }
  return part;
}

}  // namespace mpm
