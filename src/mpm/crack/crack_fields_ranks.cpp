// Material near cracks over several ranks: which blocks all of them have, and how they agree on the fields of nodes.
//
// A rank finds what its own particles have across cracks at a node, and takes the fields 1 and 2 as it comes upon it.
// All nodes of all ranks are put together then, in the order in which one process comes upon them: that of the blocks
// in which particles were the first to have them. Where a rank had taken another field for the same, it makes its
// patches again. With one crack a node has one such field, and this does not happen but where ways cross on both sides
// at one node. Weak: of two that are found in one block the order is that of its particles, which may be another one
// over other numbers of ranks; it decides where a third one does not fit.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

/// A divided node as ranks send it; of two numbers for a crack the second says whether it is above. `found`: by which
/// block's particles, of fields 1, 2 and 3.
struct SentNode {
  std::uint64_t block, found[3];
  double place[2], normal[4];
  std::int32_t first, node;
  std::int32_t single[2][2], both[2][2];
};

/// Label that one rank has found across one crack at a node.
struct Label {
  std::uint64_t found;
  int field;  ///< there
  AcrossCrack across;
  Vec2 normal;
};

/// Labels that all ranks have found at a node.
struct Labels {
  Vec2 place;
  std::vector<Label> single;
  std::uint64_t found = 0;  ///< both
  std::array<AcrossCrack, 2> both{};
};

AcrossCrack received(const std::int32_t (&sent)[2]) { return {sent[0], sent[1] != 0}; }

void send(const AcrossCrack& across, std::int32_t (&to)[2]) {
  to[0] = across.crack;
  to[1] = across.above ? 1 : 0;
}

void add(const SentNode& sent, Labels& labels) {
  labels.place = Vec2(sent.place[0], sent.place[1]);
  for (int f = 0; f < 2; ++f) {
    const AcrossCrack across = received(sent.single[f]);
    if (across.crack < 0) continue;
    labels.single.push_back({sent.found[f], f, across, Vec2(sent.normal[2 * f], sent.normal[2 * f + 1])});
  }
  const std::array<AcrossCrack, 2> both{received(sent.both[0]), received(sent.both[1])};
  if (both[0].crack < 0 || (labels.both[0].crack >= 0 && labels.found <= sent.found[2])) return;
  labels.found = sent.found[2];
  labels.both = both;
}

/// Gives the fields of a node to what has been found first; `fields`: how many it has beside field 0.
DividedNode divided(Labels& labels, int fields) {
  DividedNode node;
  node.place = labels.place;
  node.both = labels.both;
  std::stable_sort(labels.single.begin(), labels.single.end(), [](const Label& a, const Label& b) {
    return std::tie(a.found, a.field) < std::tie(b.found, b.field);
  });
  for (const Label& label : labels.single) {
    for (int slot = 0; slot < std::min(fields, 2); ++slot) {
      if (node.single[slot].crack >= 0 && !(node.single[slot] == label.across)) continue;
      node.single[slot] = label.across;
      node.normal[slot] += label.normal;
      break;
    }
  }
  return node;
}

bool alike(const FieldLabels& own, const FieldLabels& of_all) {
  for (int f = 0; f < 2; ++f) {
    if (own.single[f].crack >= 0 && !(own.single[f] == of_all.single[f])) return false;
  }
  return own.both[0].crack < 0 || own.both == of_all.both;
}

}  // namespace

bool CrackFields::near(const std::array<int, 3>& block, double cells) const {
  const GridLayout& layout = choice_.grid().layout;
  const int reach = static_cast<int>(std::ceil(cells / kBlockEdge));
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const std::uint64_t key = layout.key({block[0] + i, block[1] + j, 0});
      if (std::binary_search(listed_.begin(), listed_.end(), key)) return true;
    }
  }
  return false;
}

void CrackFields::note_found(const DividedNode& node, int slot) {
  if (ranks_ == nullptr) return;
  found_in_.resize(nodes_.size());
  found_in_[&node - nodes_.data()][slot - 1] = choice_.blocks()[tile_.block];
}

bool CrackFields::share_nodes() {
  found_in_.resize(nodes_.size());
  std::vector<SentNode> own;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const DividedNode& node = nodes_[n];
    SentNode sent{};
    sent.block = choice_.field(node.first).blocks.key(node.ref[0].block);
    std::copy(found_in_[n].begin(), found_in_[n].end(), sent.found);
    sent.first = node.first;
    sent.node = node.ref[0].node;
    for (int k = 0; k < 2; ++k) {
      sent.place[k] = node.place[k];
      sent.normal[k] = node.normal[0][k];
      sent.normal[2 + k] = node.normal[1][k];
      send(node.single[k], sent.single[k]);
      send(node.both[k], sent.both[k]);
    }
    own.push_back(sent);
  }
  std::map<std::tuple<int, std::uint64_t, int>, Labels> of_all;
  for (const SentNode& sent : gather_list(*ranks_, own)) add(sent, of_all[{sent.first, sent.block, sent.node}]);
  const std::vector<DividedNode> before = nodes_;
  forget_nodes();
  found_in_.clear();
  for (auto& [at, labels] : of_all) {
    const auto& [first, block, local] = at;
    DividedNode node = divided(labels, across_[first]);
    node.first = first;
    for (int f = 0; f < DividedNode::kFields; ++f) {
      const int number = f <= across_[first] ? choice_.field(first + f).blocks.find(block) : -1;
      node.ref[f] = {number, number < 0 ? 0 : local};
    }
    node_at(first, node.ref[0]) = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  }
  return !std::all_of(before.begin(), before.end(), [this](const DividedNode& node) {
    return alike(node, nodes_[node_at(node.first, node.ref[0])]);
  });
}

}  // namespace mpm
