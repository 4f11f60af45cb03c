// Nodes at which materials of several velocity fields act on each other by the laws of pairs, and the passes of a step
// over them: laws act on v^{n+1}; while strain is updated a pair that was held stays held, as step/coulomb.hpp
// explains; XPIC's increments lose their held components. What is a node, a pair and its normal is found by others
// (contact/material_contact.hpp, crack/crack_contact.hpp).
// Source: Nairn, GIMP notes 3.2; method reference 8.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/contact/node_contact.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// Length around the axis that contact on a section at this place represents [m]; 1 in scenes that are not
/// axisymmetric.
double around_axis(GeometryKind geometry, const GridLayout& layout, const Vec3& position);

class ContactNodes {
 public:
  /// One velocity field at a node.
  struct Member {
    int field;
    NodeRef ref;
    double mass;
    int group;  ///< index among the node's materials; fields that share one velocity are one material
  };
  struct PairOfNode {
    NodePair state;
    int rule;     ///< number of the law
    bool turned;  ///< a belongs to the second body
    int fields;   ///< identifies the pair at its node from step to step
  };
  struct Node {
    Vec3 position;
    std::uint64_t id;  ///< HeldNodes::id
    int first_member, members, first_pair, pairs, groups;
  };
  /// Some nodes, with their members, materials and pairs: those of a block, for example.
  struct Block {
    std::vector<Node> nodes;
    std::vector<Member> members;
    std::vector<NodeMaterial> materials;  ///< as gathered; groups of a node lie together, at its first member's place
    std::vector<PairOfNode> pairs;
    void clear() {
      nodes.clear();
      members.clear();
      materials.clear();
      pairs.clear();
    }
  };

  ContactNodes(Fields& fields, int threads) : fields_(fields), threads_(threads) {}

  /// To be filled when momentum has been gathered; blocks share no node.
  std::vector<Block> blocks;

  /// The directions in which a pair was held when momentum was updated last.
  PairHold held(std::uint64_t node, int fields) const;

  void strain(double dt);
  void update(double dt);
  /// XPIC and FMPM: of Grid::increment.
  void filter(double dt);
  /// Module::share_memory
  void share_memory(Communicator& ranks);
  void serialise(StateArchive& archive);

 private:
  enum class Pass { strain, update, filter };
  struct Held {
    std::uint64_t node;
    int fields;
    PairHold hold;
  };
  /// One node's materials and pairs, for the solver.
  struct Scratch {
    std::vector<NodeMaterial> materials;
    std::vector<NodePair> pairs;
    std::vector<Vec3> velocities, accelerations;  ///< velocities and accelerations of the materials before contact
    std::vector<Vec3> gathered;                   ///< velocities of the materials as the step began, before
  };

  /// Copies the node's materials, with the velocities of `velocity(grid)`, and its pairs as the pass needs them.
  template <class FieldOf>
  void load(Pass pass, const Block& block, const Node& node, double dt, FieldOf&& velocity, Scratch& scratch) const;
  /// Applies the pass to the node's velocities in `velocity(grid)`.
  template <class FieldOf>
  void hold(Pass pass, Block& block, const Node& node, double dt, FieldOf&& velocity, Scratch& scratch);
  template <class FieldOf>
  void hold_nodes(Pass pass, double dt, FieldOf&& velocity);
  void update_node(Block& block, const Node& node, double dt, Scratch& scratch);
  void keep_held();
  /// Sorts held_ and removes what is there twice.
  void put_in_order();

  Fields& fields_;
  int threads_;
  std::vector<Held> held_;  ///< nodes and fields held, in ascending order of node and fields
};

}  // namespace mpm
