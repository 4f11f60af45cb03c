// Heat where surfaces meet: friction, and conduction between a tool and the material that it touches, or between two
// bodies of different velocity fields. Contact tells of each place at which it acted in a step, before the particles
// move; what it says of friction is the very energy that it books as lost.
//
// What contact finds after the momentum has been updated (with USAVG and USL, the second look at friction) is given in
// the next step.
//
// A tool has a given temperature, or a heat capacity and the temperature that it has come to. Of friction's heat a part
// goes to the material and the rest to the tool; between two bodies it is shared in proportion to their effusivity,
// sqrt(K rho C), as at two half spaces that meet (H. S. Carslaw, J. C. Jaeger (1959), Conduction of Heat in
// Solids, 2.15).
//
// Conduction between surfaces may be fast against what a node can take. Each node therefore comes nearer to what it
// touches as it would by itself in the time of the step, by exp(-h A t / c), which is the explicit h A t where that is
// small, and never overshoots. Of two that both change, h A t counts over both their capacities. A touch gives each of
// its nodes the heat of that node's own temperature, so that a light node at the edge of a body does not go beyond the
// tool's temperature while heavier ones behind it are still cold.
//
// Beside a crack each node of a touch is in the velocity field that the touched material has there, so that no heat
// crosses the crack.
//
// Weak: over several ranks, friction at a wall or between two bodies whose place no longer has material when it is to
// be given is lost; one process gives it at the next place.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/transport/definition.hpp"
#include "mpm/transport/nodal_source.hpp"

namespace mpm {

/// A tool's heat since the start.
struct ToolHeat {
  ToolHeatDefinition definition;
  double temperature = 0.0;    ///< now, where it has a capacity [K]
  double to_material = 0.0;    ///< conducted into the material [J]
  double from_friction = 0.0;  ///< kept of friction [J]
};

class SurfaceHeat final : public NodalSource, public HeatSink {
 public:
  /// `effusivities`: of each velocity field [W s^0.5/(m^2 K)]. `tools`: of each of `bodies`, in their order; those
  /// without heat have no conductance. `pairs`: conductance of each pair of fields [W/(m^2 K)], fields x fields.
  SurfaceHeat(const Fields& fields, const std::vector<RigidBody>& bodies, std::vector<double> effusivities,
              std::vector<ToolHeat> tools, std::vector<double> pairs, const Communicator* ranks = nullptr);

  void touch(const RigidBody& tool, const MaterialNodes& material, const Vec3& place, double area, double friction,
             double dt) override;
  void rub(const RigidBody* tool, const Grid& grid, std::uint64_t node, double friction, double dt) override;
  void meet(const Grid& one, const Grid& other, std::uint64_t node, double area, double friction, double dt) override;

  void give(std::vector<NodalQuantity>& nodes, double start, double dt) override;
  void accounts(std::vector<ContentAccount>& list) const override;
  bool pending() const override { return !touches_.empty() || !meetings_.empty(); }
  void serialise(StateArchive& archive) override;
  const std::vector<ToolHeat>& tools() const { return tools_; }
  /// Heat of friction that contact has told of and that goes to the material, and to tools, in the next step [J].
  double waiting() const;
  /// Now, or at a time [s] where it is given [K].
  double tool_temperature(int tool, double time) const;

 private:
  /// By name, since blocks may change their places until heat is given.
  struct Share {
    int field;
    std::uint64_t node;  ///< HeldNodes::id
    double share;
  };
  struct Touch {
    int tool, first, count;  ///< range of shares_; tool negative: none with heat
    double area, friction, dt;
    bool by_tool;  ///< true if, over several ranks, all of them know of it
  };
  struct Meeting {
    int field, other_field;
    std::uint64_t node;
    double area, friction, dt;
  };
  int field_of(const Grid& grid) const;
  int tool_of(const RigidBody* body) const;
  /// A block of -1: no material is there any more.
  NodeRef find(int field, std::uint64_t node) const;
  NodeRef find(const Share& share) const { return find(share.field, share.node); }
  /// True if a touch, or a meeting at this node, counts to sums here.
  bool counts(const Touch& touch) const;
  bool counts(int field, NodeRef node) const { return fields_[field]->counts(node.block); }
  /// Adds up conductance times time of all that touches at each node, and at each tool that has a capacity [J/K].
  void load();
  /// Number of time constants of the exchange at a node that go by in this update.
  double constants(const std::vector<NodalQuantity>& nodes, int field, const NodeRef& ref) const;
  /// Sum of a touch's shares in nodes where there is material.
  double whole_of(const Touch& touch) const;
  void give(const Touch& touch, std::vector<NodalQuantity>& nodes, double start, double dt);
  void give(const Meeting& meeting, std::vector<NodalQuantity>& nodes, double dt);

  const Fields& fields_;
  const std::vector<RigidBody>& bodies_;
  std::vector<double> effusivities_;
  std::vector<ToolHeat> tools_;
  std::vector<double> pairs_;
  const Communicator* ranks_;  ///< communicator of a run over several ranks; else null
  std::vector<Share> shares_;
  std::vector<Touch> touches_;
  std::vector<Meeting> meetings_;
  std::vector<NodalField> loads_;   ///< load of each field, at the nodes that are touched in this update [J/K]
  std::vector<double> tool_loads_;  ///< load of each tool [J/K]
  double kept_ = 0.0;               ///< heat of friction where no material is any more: for the next place [J]
  double rubbed_ = 0.0, given_ = 0.0;
  ContentAccount friction_, conducted_;
};

}  // namespace mpm
