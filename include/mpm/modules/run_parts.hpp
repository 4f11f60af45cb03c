// The parts of a run from which its modules are made. A physics adds its modules by one function, which looks at the
// definition and adds none if the scene does not name it. The shipped functions are in one list
// (src/mpm/modules/shipped_modules.cpp); a caller can add more (SimulationOptions).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/grid/field_map.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/implicit/sweep_budget.hpp"
#include "mpm/kernel/isa.hpp"
#include "mpm/material/law.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/robot/robot.hpp"
#include "mpm/step/block_probe.hpp"
#include "mpm/step/modules.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

class DampingControl;
class FollowingBed;
class HeatSink;
class RestPartner;
class PointContact;
class Sleep;
class StressAverage;
class ToolSides;
class TransportedField;

/// Objects that modules share with each other or with the run, each made when the first module asks for it.
struct Services {
  std::unique_ptr<VolumeSurvey> volumes;
  std::unique_ptr<SweepBudget> budget;  ///< budget of the scene; null without one
  FollowingBed* bed = nullptr;          ///< module of ground that follows bodies; null without one
};

/// All parts but the lists of text outlive the modules.
struct RunParts {
  const SimulationDefinition& definition;
  const FieldMap& map;
  Fields& fields;                               ///< without blocks yet
  std::vector<ParticleSet>& sets;               ///< one for each body of the definition; not sorted yet
  const std::vector<Law>& laws;                 ///< one for each set
  std::vector<RigidBody>& bodies;               ///< one for each rigid body of the definition
  std::vector<std::unique_ptr<Robot>>& robots;  ///< one for each of the definition
  NodeChoice* choice;                           ///< choice of fields by particles near cracks; null without cracks
  Communicator* ranks;                          ///< communicator of a run over several ranks; else null, as `halo` is
  Halo* halo;
  int threads;
  Isa isa;
  Modules& modules;  ///< modules are added here
  Services& services;
  std::vector<std::string>&warnings, &notes;  ///< one line each
  /// Finds the energies of the run, between two steps; what it returns holds until they are found again.
  std::function<const EnergyReport&()> energies;
  const std::function<bool()>& interrupt;  ///< as in SimulationOptions

  // Modules that later ones in the list need; null if the scene does not have them.
  const ToolSides* sides = nullptr;
  DampingControl* damping = nullptr;
  HeatSink* heat = nullptr;
  TransportedField* temperature = nullptr;
  PointContact* at_points = nullptr;  ///< contact of tools at points
  Sleep* sleep = nullptr;
  StressAverage* stress_average = nullptr;
  /// Particles near rigid bodies where a device takes the steps (step/device.hpp); else null, and all sets are looked
  /// through.
  const std::vector<ParticleSet>* near_bodies = nullptr;
  Fields* fields_near_bodies = nullptr;          ///< the same of nodes
  std::vector<RestPartner*> rest_partners = {};  ///< modules that act on material at rest, which sleep asks

  const GridLayout& layout() const { return fields.front()->layout; }
  /// Fields in which rigid bodies meet material.
  Fields& contact_fields() const { return fields_near_bodies != nullptr ? *fields_near_bodies : fields; }
  VolumeSurvey& volumes();
  /// Makes an object that transfers a module's numbers between particles and nodes, by this shape function and in the
  /// run's precision.
  std::unique_ptr<ScalarTransfer> make_transfer(ShapeKind shape);
  /// Makes an object that asks what one block gives to the grid, in the run's method and precision.
  std::unique_ptr<BlockProbe> make_probe();
  /// Adds one stage for each field: make() returns a new one.
  template <class Make>
  void add_in_fields(Make&& make) {
    for (int f = 0; f < map.count(); ++f) modules.add_in_field(make(), f);
  }
};

}  // namespace mpm
