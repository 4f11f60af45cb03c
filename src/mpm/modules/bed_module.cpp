// Ground that follows bodies as a module.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/bed/following_bed.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {

void add_bed(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!definition.bed) return;
  const BedDefinition& bed = *definition.bed;
  const auto refuse = [](const std::string& what) { throw DefinitionError("terrain: " + what); };
  if (parts.sleep == nullptr) refuse("what ends the ground is asleep; write sleep: {from_start: true}");
  if (definition.geometry != GeometryKind::solid && definition.geometry != GeometryKind::plane_strain)
    refuse("ground follows bodies in solid and plane_strain scenes alone");
  if (definition.gravity.head<2>().norm() > 0.0 || !(definition.gravity.z() < 0.0))
    refuse("ground that follows bodies needs gravity down along z");
  if (definition.bodies.size() != 1)
    refuse(fmt::format("ground that follows bodies is the only deformable body, and here are {}; make the others rigid",
                       definition.bodies.size()));
  if (!definition.bodies.front().geostatic)
    refuse("ground that is made later is at rest under its weight's stress; write initial: geostatic");
  if (bed.source == nullptr || bed.follow.empty()) refuse("name the bodies that the ground follows");
  for (const std::string& name : bed.follow) {
    const auto is_it = [&](const RigidBody& body) { return body.name() == name; };
    if (std::none_of(parts.bodies.begin(), parts.bodies.end(), is_it))
      refuse(fmt::format("follow: no rigid body '{}'", name));
  }
  for (const VolumeDefinition& volume : definition.volumes) {
    if (std::find(bed.follow.begin(), bed.follow.end(), volume.of) == bed.follow.end())
      refuse(
          fmt::format("volume '{}' is of no body that the ground follows, and ground that is made in it would count as "
                      "what came in; let it move with one by of",
                      volume.name));
  }
  parts.services.bed = &parts.modules.add(
      std::make_unique<FollowingBed>(bed, BedParts{parts.sets, parts.fields, parts.bodies, *parts.sleep}));
}

}  // namespace mpm
