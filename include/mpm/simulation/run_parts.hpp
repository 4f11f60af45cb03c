// What the modules of a run are made from, while it is put together: a physics adds its modules by one function, which
// looks at the definition and adds none where the scene does not name it. Those that are shipped stand in one list
// (src/mpm/simulation/shipped_modules.cpp); a caller can hand in more (SimulationOptions).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mpm/grid/field_map.hpp"
#include "mpm/kernel/isa.hpp"
#include "mpm/material/law.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/simulation/definition.hpp"
#include "mpm/step/modules.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

class DampingControl;
class ToolSides;

/// What the kernels do for modules, each made when the first asks for it.
struct Services {
  std::unique_ptr<VolumeSurvey> volumes;
};

/// All but the lists of text outlive the modules.
struct RunParts {
  const SimulationDefinition& definition;
  const FieldMap& map;
  Fields& fields;                  ///< without blocks yet
  std::vector<ParticleSet>& sets;  ///< of each body of the definition; not sorted yet
  const std::vector<Law>& laws;    ///< of each set
  std::vector<RigidBody>& bodies;  ///< of each rigid body of the definition
  int threads;
  Isa isa;
  Modules& modules;  ///< to be added to
  Services& services;
  std::vector<std::string>&warnings, &notes;  ///< one line each

  // What one physics has for those that come later in the list; null where the scene does not name it.
  const ToolSides* sides = nullptr;
  DampingControl* damping = nullptr;

  const GridLayout& layout() const { return fields.front()->layout; }
  VolumeSurvey& volumes();
  /// Moves a module's own numbers between particles and nodes, by this shape function in the run's precision.
  std::unique_ptr<ScalarTransfer> make_transfer(ShapeKind shape);
  /// A stage of each field: make() returns a new one.
  template <class Make>
  void add_in_fields(Make&& make) {
    for (int f = 0; f < map.count(); ++f) modules.add_in_field(make(), f);
  }
};

}  // namespace mpm
