// Contact of rigid bodies with soil in an implicit step: points on the bodies' own surfaces, each a row of the solve.
//
// A row binds the velocity of the soil at its point, interpolated from the nodes of its cell, to that of the body:
// no approach, Coulomb friction. Points lie half a cell apart, and none nearer than kClearance cells to a convex edge:
// a row binds the nodes around it, so that a body acts about half a cell further out than its outermost points lie. A
// point is in contact where the nodes around it carry at least kPresent of the soil's density. The impulse of a row
// begins the next step's solve, less where the nodes have become lighter. The velocity of a free body is an unknown,
// too, which each of its rows changes: they are solved one after another, after all others. Particles that a step has
// left inside a body are put back on its surface.
//
// Weak: between two points of an edge the place of the edge within a cell shows (8 % of the force with 4 cells of
// depth). Source: derived and calibrated for this project; doc/implicit.md has the forces.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/contact/contact_ledger.hpp"
#include "mpm/contact/free_bodies.hpp"
#include "mpm/implicit/held_impulses.hpp"
#include "mpm/implicit/soil_grid.hpp"
#include "mpm/implicit/surface_samples.hpp"
#include "mpm/kernel/soil_cells.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/rigid/contact_law.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

struct ToolRowSettings {
  GeometryKind geometry = GeometryKind::solid;
  double across = 1.0;         ///< thickness of a plane [m]
  double least_density = 0.0;  ///< density of the soil, at the start [kg/m^3]
  int threads = 1;
  Vec3 gravity = Vec3::Zero();  ///< acts on free bodies [m/s^2]
  BodyContactSettings meeting;  ///< contact of tools with each other and with walls
};

/// The tool on which soil presses most.
struct ToolPressure {
  double mean = 0.0;      ///< mean of the impulses' magnitudes over the area of the points that press [Pa]
  std::int32_t body = 0;  ///< its number
};

template <class T>
class ToolRows {
 public:
  using Row = mpm_kernel::ContactRow<T>;
  using Node = mpm_kernel::SoilNode<T>;

  /// Bodies and grid outlive this. `laws`: of each body, with all soil.
  ToolRows(std::vector<RigidBody*> bodies, std::vector<ContactLaw> laws, const SoilGrid& grid,
           const ToolRowSettings& settings);

  /// Finds the rows of the step from `start` [s] on, with the impulses that they begin with, and gives these to the
  /// nodes.
  /// @throws FunctionError for a law of contact that is not possible
  void find(std::vector<Node>& nodes, double start, double dt);
  /// True if there are bodies, which may have rows.
  bool any() const { return !bodies_.empty(); }
  /// Forgets the rows of the last step; blocks have none until find().
  void clear() {
    rows_.clear();
    begin_.assign(grid_.grid().blocks.size() + 1, 0);
  }
  Row* rows(int block) { return rows_.data() + begin_[block]; }
  int count(int block) const { return begin_[block + 1] - begin_[block]; }
  /// Number of the rows of all blocks, which follow each other; those of free bodies come after them.
  int bound() const { return begin_.back(); }
  /// Finds the numbers of the nodes of the rows of free bodies, in this step, ascending.
  void free_nodes(std::vector<int>& numbers) const;
  /// Solves the rows of free bodies, whose velocities change with each, and what they do to each other.
  void meet_free(const mpm_kernel::SweepTable<T>& table, std::vector<Node>& nodes);
  /// Looks whether the joints of robots act as assumed (FreeBodies::settle()).
  bool settle();
  /// SweepTable::extrapolate() of the rows of free bodies, and of these.
  void extrapolate_free(double factor);
  /// Sum of the impulses' magnitudes [N s].
  double pressed() const;
  /// The largest mean pressure on the points of a body in contact at the start of the step, of a body that has moved
  /// far the less [Pa]: the stiffness of the soil shows while it is loaded, over the first kShort cells, and seldom
  /// when what fails has failed before.
  double pressure_to_resolve() const { return pressure_; }
  /// In the last step.
  const ToolPressure& pressure() const { return most_; }
  const std::string& name(int body) const { return bodies_[body]->name(); }
  /// Books the impulses, with the nodes as they are now, gives free bodies the velocities that they have left them, and
  /// keeps them for the next step.
  void finish(const std::vector<Node>& nodes, double dt);
  void energies(EnergyReport& report) const { free_.energies(report); }
  /// @throws RigidError when the body overlaps others that it collides with
  void check_overlaps(const RigidBody& body) const { free_.check_overlaps(body); }
  /// Adds what rows give to the components of velocity that are held.
  void add_to_held(HeldImpulses& held) const;

  /// Forgets the forces on a body that has been put elsewhere.
  void forget(const RigidBody& body);
  std::vector<ContactLedger>& ledgers() { return ledgers_; }
  const std::vector<ContactLedger>& ledgers() const { return ledgers_; }
  void serialise(StateArchive& archive);

 private:
  void meet_each_other();
  /// Finds the pressure to resolve.
  void look_at_loads(double dt);
  /// Load on a body at the start of a step.
  struct Load {
    double impulse = 0.0, area = 0.0;  ///< sums of points that press [N s], [m^2]
    Vec3 velocity = Vec3::Zero();      ///< velocity of the body there, times the impulses
  };
  /// Data of a row beside those that sweeps need.
  struct Place {
    int body, sample, block;
    Vec3 at;                                ///< [m]
    double area;                            ///< [m^2]
    double own;                             ///< the largest answer of its nodes along an axis [1/kg]
    double weight[mpm_kernel::kCellNodes];  ///< weights of its nodes, whether a wall holds them or not
    Vec3 prescribed;  ///< part of the soil's velocity there by nodes that are held, which the row's leaves out [m/s]
  };
  /// Part of a row's impulse that a held component of velocity takes.
  struct HeldPart {
    int row, node;
    std::uint8_t holder, axis;
    double weight;
  };
  /// Force of each point of a body in the last step.
  struct Kept {
    std::vector<double> force;  ///< three numbers each [N]
    std::vector<double> own;    ///< Row::own [1/kg]
    void clear();
  };
  /// Width of what lies at `at` across the x-z plane: the thickness, or a turn [m]; in space 1.
  double across(const Vec3& at) const;
  /// Finds the cell of a point, its nodes and their weights. Returns whether there is soil enough for contact.
  bool find_soil(const Vec3& at, const std::vector<Node>& nodes, Row& row, Place& place) const;
  /// Fills the row's weights and the velocity that held nodes prescribe. Returns by how much an impulse along each axis
  /// changes the velocity at the point [1/kg].
  Vec3 bind_nodes(const std::vector<Node>& nodes, Row& row, Place& place) const;
  /// The impulse of the last step, less where nodes have become lighter; `own`: Row::own.
  Vec3 first_impulse(int body, int sample, const Vec3& normal, const FrictionLaw& law, double own, double dt) const;
  /// Makes the row of a point. Returns false where there is none.
  bool make(int body, int sample, const std::vector<Node>& nodes, const FrictionLaw& law, double dt, Row& row,
            Place& place) const;

  std::vector<RigidBody*> bodies_;
  std::vector<ContactLaw> laws_;
  const SoilGrid& grid_;
  ToolRowSettings settings_;
  std::vector<std::vector<SurfaceSample>> samples_;  ///< samples of each body
  FreeBodies free_;
  BodyContact* meeting_ = nullptr;  ///< meeting of tools with each other in this step; null where none may meet
  std::vector<ContactLedger> ledgers_;
  std::vector<Kept> kept_;
  std::vector<Row> rows_;
  std::vector<Place> places_;
  // Row of every point, if it touches soil.
  std::vector<Row> found_;
  std::vector<Place> found_places_;
  std::vector<std::uint8_t> touches_;
  std::vector<HeldPart> held_;
  std::vector<int> begin_, next_;
  std::vector<double> areas_;  ///< area of each body
  std::vector<Load> loads_;    ///< load of each body
  std::vector<Vec3> travels_;  ///< travel of each body where it meets soil, the last kLong cells of it at the most [m]
  double pressure_ = 0.0;      ///< to resolve [Pa]
  std::vector<double> press_;  ///< sum of the magnitudes of each body's impulses [N s]
  ToolPressure most_;
};

}  // namespace mpm
