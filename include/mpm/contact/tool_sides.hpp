// One velocity field for each side of a thin tool: the material of a divided body that lies on side 1 of a tool has a
// field of its own (grid/field_map.hpp). Where the two fields share a node and the tool is not between them, beyond its
// tip and beside it, they are one continuum: the node has one momentum, one force and one velocity for both, as if
// there were one field, to round-off (SideGlue). Where the tool is between them they do not interact; contact with the
// tool acts on each (contact/rigid_contact.hpp). The tool is between them if the line from one mass centre to the other
// meets it.
//
// Particles change sides only by the sort, which is asked for when tool and material near it have moved a part of a
// cell against each other. A change of sides changes nothing else: the particle keeps its state, and the two fields
// move as one where it happens. A particle whose centre is in the tool or hardly outside keeps its side, since it is
// pressed against the tool and has not passed it.
//
// In bodies that cracks divide a tool is told from a crack by its number (crack/tool_cuts.hpp): their particles have no
// side here, and nothing is joined.
//
// Over several ranks each labels its own particles, which keep their side when they go to another rank, and joins the
// nodes that it has: where ranks share a node they have both fields there, with the same bits.
//
// Weak: with several thin tools the nearest one decides on which side a particle lies, whether or not it names the body
// (RigidBodyDefinition::divides says which bodies are divided at all); between two tools nearer to each other than
// three cells there is one field. Averages of volume changes over the grid are taken on each side.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/grid/field_map.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class ToolSides final : public Module {
 public:
  /// `layout`, `map` and `sets` must outlive this object. `map` says which bodies are divided, and the fields of their
  /// sides.
  ToolSides(const GridLayout& layout, const FieldMap& map, std::vector<ParticleSet>& sets, int threads)
      : layout_(layout), map_(map), sets_(sets), threads_(threads) {}

  std::string name() const override { return "tool_sides"; }

  /// Adds a thin tool. `body` must outlive this object, which owns the result.
  const ThinTool& add(const RigidBody& body, GeometryKind geometry) { return tools_.emplace_back(body, geometry); }
  const std::deque<ThinTool>& tools() const { return tools_; }
  /// The thin tool that a body is, or null.
  const ThinTool* find(const RigidBody& body) const;
  const FieldMap& map() const { return map_; }

  /// Finds the side of every particle of the divided bodies, before a sort.
  void before_sort() override;
  /// Adds the distance that a tool and material near it have moved against each other [m].
  void add_travel(double travel) { travelled_ += travel; }
  /// True if sides may have changed.
  bool needs_sort() const override;
  /// True if a tool lies between the mass centres of two fields at a node. Needs Grid::place.
  bool apart(const Grid& first, NodeRef of_first, const Grid& second, NodeRef of_second) const;
  /// True if a ball around a world point is so near to a tool that particles in it may be on side 1 or in its contact.
  bool near(const Vec3& point, double radius) const;
  /// Writes or reads its state, for checkpoints.
  /// Gives all sides anew, as at the start.
  void body_put(const RigidBody& body) override;
  void serialise(StateArchive& archive) override;

 private:
  const GridLayout& layout_;
  const FieldMap& map_;
  std::vector<ParticleSet>& sets_;
  int threads_;
  std::deque<ThinTool> tools_;
  bool labelled_ = false;
  bool kept_ = false;       ///< sides are those of a checkpoint until the sort after it
  double travelled_ = 0.0;  ///< since sides were given [m]
};

/// Makes one continuum of the two fields of each divided body where no thin tool is between them: before other stages,
/// and again after them for the forces they added and the velocities they changed on one side alone. Needs Grid::place.
class SideGlue final : public Stage {
 public:
  /// Both must outlive the stage.
  SideGlue(ToolSides& sides, Fields& fields) : sides_(sides), fields_(fields) {}

  std::string name() const override { return "sides"; }
  Ranks ranks(Hook hook) const override;

  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext&) override { share(&Grid::velocity); }
  void forces_gathered(StepContext&) override { part(&Grid::force); }
  void momentum_updated(StepContext&) override;
  void velocity_found(StepContext&) override { share(&Grid::increment); }
  void increment_found(StepContext&) override { share(&Grid::increment); }

 private:
  /// A node at which the two fields are one continuum.
  struct Node {
    std::array<int, 2> field;
    NodeRef ref[2];
    double part[2];  ///< parts of the node's mass
  };
  void find_nodes(const std::array<int, 2>& sides);
  void watch(const Grid& grid, double dt);
  /// Gives both fields their mean by mass.
  void share(NodalField Grid::*field);
  /// Gives each field its part, by mass, of the sum.
  void part(NodalField Grid::*field);

  ToolSides& sides_;
  Fields& fields_;
  std::vector<Node> nodes_;
};

}  // namespace mpm
