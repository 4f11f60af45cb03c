// The nodes that material at a place has: those of its velocity field; near a crack, at each node those of the field
// that holds the material on its side there (grid/node_choice.hpp).
#pragma once

#include <array>

#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// A node in one of the velocity fields.
struct FieldNode {
  int field = -1;  ///< none
  NodeRef ref{-1, 0};
  bool operator==(const FieldNode& other) const { return field == other.field && ref == other.ref; }
};

/// Tells which field a particle has at a node where cracks divide its body.
class SideOfCracks {
 public:
  virtual ~SideOfCracks() = default;
  /// The node, by its number along each axis, in the field that a particle of this set has there; block -1: there is
  /// none. `from`: centre of the particle [m]. Several threads may ask at once.
  virtual FieldNode node_of(int set, const Vec3& from, const std::array<int, 3>& node) const = 0;
};

class MaterialNodes {
 public:
  /// Nodes of material with one field. `fields` must outlive this object.
  MaterialNodes(const Fields& fields, int field) : fields_(fields), field_(field) {}
  /// Nodes of a particle of a set at `from` [m]: at each it has `field`, or one of those for what is across cracks.
  MaterialNodes(const Fields& fields, int field, const SideOfCracks& sides, int set, const Vec3& from)
      : fields_(fields), field_(field), sides_(&sides), set_(set), from_(from) {}

  int field() const { return field_; }
  /// The grid of `field`: its layout and walls are those of the others, too.
  const Grid& grid() const { return *fields_[field_]; }
  double mass(const FieldNode& node) const { return fields_[node.field]->mass.at(node.ref.block, 0, node.ref.node); }
  /// Place of a node [m].
  Vec3 place(const FieldNode& node) const {
    const Grid& own = *fields_[node.field];
    return own.layout.node_position(own.blocks.block(node.ref.block), node.ref.node);
  }
  /// The node by its number along each axis; its block is -1 if it carries no mass of this material.
  FieldNode find(const std::array<int, 3>& number) const;
  /// That nearest to a place [m], in the world along the grid's axes; also block -1 far out of the domain.
  FieldNode nearest(const Vec3& at) const;

 private:
  const Fields& fields_;
  int field_;
  const SideOfCracks* sides_ = nullptr;
  int set_ = -1;
  Vec3 from_ = Vec3::Zero();
};

/// True if a node may be looked up along an axis: nodes may be as far as a block beyond the domain.
bool has_nodes(const GridLayout& layout, int axis, double cells);

}  // namespace mpm
