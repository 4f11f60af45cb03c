#include "mpm/crack/field_jumps.hpp"

#include <algorithm>

#include "mpm/crack/crossing.hpp"

namespace mpm {
namespace {

constexpr double kNearTip = 4.0;  ///< besides the growth, from a tip to nodes whose pairs it may change [cells]
constexpr double kAtNode = 0.1;   ///< [cells]

}  // namespace

void FieldJumps::move(const std::vector<Vec2>& tips, const std::vector<DividedNode>& nodes, double dt) {
  next_.clear();
  if (!tips.empty()) {
    const GridLayout& layout = fields_.front()->layout;
    const Vec2 reach = (kNearTip + growth_) * Vec2(layout.cell(0), layout.cell(1));
    for (const DividedNode& node : nodes) {
      const bool near = std::any_of(tips.begin(), tips.end(), [&](const Vec2& tip) {
        return ((node.place - tip).cwiseAbs().array() <= reach.array()).all();
      });
      if (!near) continue;
      const auto velocity = [&](int f) -> Vec2 {
        const NodalField& of = fields_[node.first + f]->velocity;
        return {of.at(node.ref[f].block, 0, node.ref[f].node), of.at(node.ref[f].block, 1, node.ref[f].node)};
      };
      const auto carries = [&](int f) {
        return node.ref[f].block >= 0 && fields_[node.first + f]->carries(node.ref[f].block, node.ref[f].node);
      };
      Opened opened{node, node.first, node.place, {}, {}};
      opened.opening.fill(Vec2::Zero());
      opened.known[0] = carries(0);
      if (!opened.known[0]) continue;
      const Opened* before = find_opened(node.first, node.place);
      for (int f = 1; f < FieldLabels::kFields; ++f) {
        opened.known[f] = carries(f);
        if (!opened.known[f]) continue;
        CracksBetween between{{}, f == 3 ? 2 : 1};
        between.across = f == 3 ? node.both : std::array<AcrossCrack, 2>{node.single[f - 1], AcrossCrack{}};
        const int was = before == nullptr ? -1 : before->field_of(between);
        if (was >= 0 && before->known[was]) opened.opening[f] = before->opening[was];
        opened.opening[f] += dt * (velocity(f) - velocity(0));
      }
      next_.push_back(opened);
    }
  }
  opened_.swap(next_);
}

const FieldJumps::Opened* FieldJumps::find_opened(int first, const Vec2& place) const {
  const double near = kAtNode * fields_.front()->layout.smallest_cell();
  const auto found = std::find_if(opened_.begin(), opened_.end(), [&](const Opened& one) {
    return one.first == first && (one.place - place).cwiseAbs().maxCoeff() < near;
  });
  return found == opened_.end() ? nullptr : &*found;
}

FieldJumps::Jump FieldJumps::find(int first, const Vec2& particle, const Vec2& node, const CracksBetween& now,
                                  const std::vector<std::uint8_t>& heeded) const {
  CracksBetween before = now;
  bool changed = false;
  for (const Growth& growth : growths_) {
    if (heeded[growth.crack] == 0) continue;
    const Crossing found = find_crossing(growth.line.data(), static_cast<int>(growth.line.size()), particle, node);
    if (!found.crosses) continue;
    before.toggle({growth.crack, found.above});
    changed = true;
  }
  const Opened* opened = changed ? find_opened(first, node) : nullptr;
  if (opened == nullptr) return {};
  const int from = opened->field_of(before), to = opened->field_of(now);
  if (from < 0 || to < 0 || from == to || !opened->known[from] || !opened->known[to]) return {};
  return {1 + FieldLabels::kFields * from + to, opened->opening[to] - opened->opening[from]};
}

void FieldJumps::serialise(StateArchive& archive) {
  archive.rows("growths", growths_);
  for (std::size_t g = 0; g < growths_.size(); ++g) {
    const StateArchive::Group group(archive, "growth_" + std::to_string(g));
    archive.value("crack", growths_[g].crack);
    archive.list("line", growths_[g].line);
  }
  archive.rows("opened", opened_);
  archive.column("first", opened_, &Opened::first);
  archive.column("place", opened_, &Opened::place);
  for (std::size_t f = 0; f < FieldLabels::kFields; ++f) {
    const std::string at = "_" + std::to_string(f);
    archive.column("known" + at, opened_, [f](Opened& one) -> bool& { return one.known[f]; });
    archive.column("opening" + at, opened_, [f](Opened& one) -> Vec2& { return one.opening[f]; });
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string at = "_" + std::to_string(k);
    archive.column("single" + at, opened_, [k](Opened& one) -> int& { return one.single[k].crack; });
    archive.column("single_above" + at, opened_, [k](Opened& one) -> bool& { return one.single[k].above; });
    archive.column("both" + at, opened_, [k](Opened& one) -> int& { return one.both[k].crack; });
    archive.column("both_above" + at, opened_, [k](Opened& one) -> bool& { return one.both[k].above; });
  }
}

}  // namespace mpm
