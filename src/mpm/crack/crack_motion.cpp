#include "mpm/crack/crack_motion.hpp"

#include "mpm/crack/around_point.hpp"

namespace mpm {
namespace {

constexpr double kLargestMove = 0.5;  // part of a cell

Vec2 in_plane(const NodalField& field, NodeRef ref) {
  return {field.at(ref.block, 0, ref.node), field.at(ref.block, 1, ref.node)};
}

}  // namespace

CrackMotion::CrackMotion(std::vector<Crack>& cracks, const CrackFields& chosen, const Fields& fields,
                         CracksDefinition::Move by, bool prevent)
    : cracks_(cracks), chosen_(chosen), fields_(fields), by_(by), prevent_(prevent) {
  for (std::size_t c = 0; c < cracks.size(); ++c) groups_.push_back(chosen.groups(static_cast<int>(c)));
}

SurfaceMotion CrackMotion::surface(const std::vector<int>& groups, const Vec2& place, const Vec2& from) const {
  SurfaceMotion motion;
  double sum = 0.0;
  for (const int first : groups) {
    chosen_.each_node_around(first, place, from, [&](const CrackFields::NodeOfField& own, double hat) {
      const Grid& grid = *fields_[own.field];
      if (!grid.carries(own.ref.block, own.ref.node)) return;
      const double weight = hat * grid.mass.at(own.ref.block, 0, own.ref.node);
      motion.velocity += weight * in_plane(grid.velocity, own.ref);
      motion.acceleration += weight * in_plane(grid.force, own.ref);
      sum += weight;
    });
  }
  if (!(sum > 0.0)) return {};
  return {motion.velocity / sum, motion.acceleration / sum, true};
}

SurfaceMotion CrackMotion::centre(const std::vector<int>& groups, const Vec2& place) const {
  SurfaceMotion motion;
  double sum = 0.0;
  each_hat(fields_.front()->layout, place, [&](const std::array<int, 2>& node, double hat) {
    double mass = 0.0;
    Vec2 momentum = Vec2::Zero(), force = Vec2::Zero();
    for (const int first : groups) {
      chosen_.each_field(first, node, [&](int field, NodeRef ref) {
        const Grid& grid = *fields_[field];
        if (!grid.carries(ref.block, ref.node)) return;
        const double own = grid.mass.at(ref.block, 0, ref.node);
        mass += own;
        momentum += own * in_plane(grid.velocity, ref);
        force += own * in_plane(grid.force, ref);
      });
    }
    if (!(mass > 0.0)) return;
    motion.velocity += hat / mass * momentum;
    motion.acceleration += hat / mass * force;
    sum += hat;
  });
  if (!(sum > 0.0)) return {};
  return {motion.velocity / sum, motion.acceleration / sum, true};
}

void CrackMotion::move(const CrackTractions& tractions, double dt) {
  // All look before any moves: fields are those of the lines as they were.
  above_.resize(cracks_.size());
  below_.resize(cracks_.size());
  centre_.resize(cracks_.size());
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const Chain& chain = cracks_[c].chain;
    if (chain.fixed()) continue;
    const std::size_t points = chain.points().size();
    above_[c].resize(points);
    below_[c].resize(points);
    centre_[c].resize(points);
    for (std::size_t k = 0; k < points; ++k) {
      const CrackPoint& point = chain.points()[k];
      SurfaceMotion &above = above_[c][k], &below = below_[c][k];
      above = surface(groups_[c], point.above, chain.beside(static_cast<int>(k), true));
      below = surface(groups_[c], point.below, chain.beside(static_cast<int>(k), false));
      above.pulled = below.pulled = tractions.any() && tractions.law_at(static_cast<int>(c), static_cast<int>(k)) >= 0;
      if (by_ == CracksDefinition::Move::centre_of_mass) centre_[c][k] = centre(groups_[c], point.place);
    }
  }
  const double largest = kLargestMove * fields_.front()->layout.smallest_cell();
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    Chain& chain = cracks_[c].chain;
    if (chain.fixed()) continue;
    stopped_ += chain.move(above_[c].data(), below_[c].data(), centre_[c].data(), dt, by_, largest);
    if (prevent_) chain.prevent();
  }
}

}  // namespace mpm
