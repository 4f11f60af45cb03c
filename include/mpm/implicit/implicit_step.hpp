// The implicit step of soil that is elastic and flows: velocities at the end of the step for which the stresses of all
// cells fulfil the law, and all contacts Coulomb's, so that a step may last as long as a controller's period and not as
// long as a wave takes to cross a cell.
//
// Unknown are the stresses r of cells, one each, and the impulses l of contacts. Velocities follow from them, so that
// momentum is exact whatever has been found so far:
//
//   v = v* + M^-1 (sum_c dt V B^T r + sum_k J^T l),   v* = the velocity of the transfer, with gravity and loads,
//
// and each cell is to fulfil its law with its rate of strain B v less the elastic part, contacts theirs
// (kernel/soil_cells.hpp). Blocks are swept in the order of their colours, the cells of a block in a fixed order, to
// and fro, then its contacts: Gauss-Seidel. Stresses and impulses of the step before begin it; it is by this that few
// sweeps suffice. A sweep brings stress as an elastic soil of modulus rho (h / dt)^2 would, and with momentum n of them
// as one of up to ten times n of that (sweep_momentum.hpp). The same bits for any number of threads.
//
// Weak: no waves, no rebound: an impact is plastic. Under loads near that modulus soil is soft before it fails. Volume
// is lost where soil falls and few sweeps are made. The place of a tool's edge within a cell shows (tool_rows.hpp).
// Source: G. Daviet, F. Bertails-Descoubes (2016), ACM Trans. Graph. 35(4) 102; doc/implicit.md has what it is worth.
#pragma once

#include <memory>
#include <optional>

#include "mpm/contact/contact_reporter.hpp"
#include "mpm/implicit/out_of_tools.hpp"
#include "mpm/implicit/soil_cells.hpp"
#include "mpm/implicit/soil_field.hpp"
#include "mpm/implicit/sweep_budget.hpp"
#include "mpm/implicit/tool_rows.hpp"
#include "mpm/implicit/wall_rows.hpp"
#include "mpm/kernel/isa.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

inline constexpr const char* kImplicitName = "implicit";  ///< name of the module
inline constexpr double kImplicitTravel = 0.5;            ///< cells that soil may move in a step
inline constexpr double kFastTravel = 1.0;                ///< cells that its fastest particles may move in a step
inline constexpr double kFastPart = 0.05;                 ///< part of a body's particles that these are
inline constexpr double kImplicitStep = 0.01;             ///< step of a scene that names none [s]
inline constexpr double kLongestImplicitStep = 0.1;       ///< [s]

struct ImplicitSettings {
  GeometryKind geometry = GeometryKind::solid;
  double across = 1.0;        ///< thickness of a plane [m]; else 1
  std::optional<int> sweeps;  ///< sweeps of every step; without it as many as its contacts need
  std::array<WallDefinition, 6> walls;
  int threads = 1;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  BodyContactSettings meeting;  ///< contact of rigid bodies with each other and with walls
  bool loads = false;           ///< true if forces act on nodes that are not in proportion to their mass
  Isa isa = Isa::plain;
  SweepBudget* budget = nullptr;  ///< budget of the sync period that steps are part of; null: they take their time
};

/// The solve of a step for a device that has the soil, which sees to it that grid() has the blocks that are in use.
template <class T>
class ImplicitSolve {
 public:
  virtual ~ImplicitSolve() = default;
  virtual Grid& grid() = 0;
  virtual const SoilGrid& soil_grid() const = 0;
  virtual const SoilBodies& bodies() const = 0;
  virtual ToolRows<T>& tools() = 0;
  virtual WallRows<T>& walls() = 0;
  virtual const OutOfTools& out_of_tools() const = 0;
  /// Mass that is added to that of a node [kg].
  virtual double lightest() const = 0;
  /// As ImplicitSettings::loads.
  virtual bool loads() const = 0;
  /// Lets steps move this soil from here on, in place of that of this processor; null: none until the next.
  virtual void use(SoilField<T>* field) = 0;
  /// From velocities with gravity and loads to those of the step's end.
  virtual void solve_step(double start, double dt) = 0;
};

/// A stage, reporter of contact and ImplicitSolve of the precision in one. Sets, bodies and grid outlive it. `laws`: of
/// contact, one for each tool.
struct ImplicitParts {
  SoilBodies bodies;
  std::vector<ParticleSet>* sets;
  std::vector<RigidBody*> tools;
  std::vector<ContactLaw> laws;
  Grid* grid;
};
std::unique_ptr<Stage> make_implicit_step(ImplicitParts parts, const ImplicitSettings& settings, Precision precision);

}  // namespace mpm
