#include "mpm/crack/tip_heating.hpp"

#include <cmath>

namespace mpm {

TipHeating::TipHeating(double part, const std::vector<int>& cracks, const CrackFields& chosen, const Fields& fields,
                       bool counts)
    : part_(part), chosen_(chosen), fields_(fields), counts_(counts), heats_(cracks.size()), kept_(cracks.size(), 0.0) {
  std::size_t most = 0;
  for (const int crack : cracks) {
    groups_.push_back(chosen_.groups(crack));
    most += 4 * DividedNode::kFields * groups_.back().size();
  }
  shares_.reserve(most);
  account_.name = "crack tips";
}

void TipHeating::heat(int tip, const Vec2& place, double dt) {
  const double heat = heats_[tip].take(dt) * dt + kept_[tip];
  kept_[tip] = 0.0;
  if (heat == 0.0) return;
  const GridLayout& layout = fields_.front()->layout;
  std::array<int, 2> low{};
  Vec2 beyond;
  for (int k = 0; k < 2; ++k) {
    const double cells = layout.in_cells(k, place[k]);
    low[k] = static_cast<int>(std::floor(cells));
    beyond[k] = cells - low[k];
  }
  const std::size_t first = shares_.size();
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const std::array<int, 2> node{low[0] + (i & 1), low[1] + (i >> 1)};
    const double hat = ((i & 1) != 0 ? beyond[0] : 1.0 - beyond[0]) * ((i >> 1) != 0 ? beyond[1] : 1.0 - beyond[1]);
    const std::size_t of_node = shares_.size();
    double mass = 0.0;
    for (const int group : groups_[tip]) {
      chosen_.each_field(group, node, [&](int field, NodeRef ref) {
        const Grid& grid = *fields_[field];
        if (!grid.carries(ref.block, ref.node)) return;
        shares_.push_back({field, ref, grid.mass.at(ref.block, 0, ref.node)});
        mass += shares_.back().heat;
      });
    }
    for (std::size_t s = of_node; s < shares_.size(); ++s) shares_[s].heat *= hat / mass;
    if (shares_.size() > of_node) sum += hat;
  }
  if (!(sum > 0.0)) {
    shares_.resize(first);
    kept_[tip] = heat;
    return;
  }
  for (std::size_t s = first; s < shares_.size(); ++s) shares_[s].heat *= heat / sum;
  if (counts_) account_.add(heat);
}

void TipHeating::give(std::vector<NodalQuantity>& nodes, double, double dt) {
  for (const Share& share : shares_) {
    nodes[share.field].source.at(share.node.block, 0, share.node.node) += share.heat / dt;
  }
  shares_.clear();
}

void TipHeating::serialise(StateArchive& archive) {
  for (std::size_t t = 0; t < heats_.size(); ++t) {
    const StateArchive::Group group(archive, "tip_" + std::to_string(t));
    heats_[t].serialise(archive);
    archive.value("kept", kept_[t]);
  }
  archive.sum("given", account_.given);
  archive.sum("exchanged", account_.exchanged);
}

}  // namespace mpm
