#include "mpm/rules/feature_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/transport/pore_water.hpp"

namespace mpm {
namespace {

using Found = std::optional<std::string>;

Found found_if(bool has) { return has ? Found("") : std::nullopt; }

template <class List, class Test>
Found named_in(const List& list, Test&& test) {
  const auto found = std::find_if(list.begin(), list.end(), test);
  return found == list.end() ? std::nullopt : Found(fmt::format("'{}'", found->name));
}

Found wall_of(const SimulationDefinition& d, WallKind kind) {
  for (std::size_t w = 0; w < d.walls.size(); ++w) {
    if (d.walls[w].kind == kind) return kWallNames[w];
  }
  return std::nullopt;
}

/// The material of a body; before bodies are built there is none.
Found oblique_biot(const SimulationDefinition& d) {
  const QuantityDefinition* pores = d.transport.find(Transported::pore_pressure);
  if (pores == nullptr) return std::nullopt;
  for (std::size_t m = 0; m < std::min(d.materials.size(), pores->materials.size()); ++m) {
    const auto is_of = [&](const DeformableBody& body) { return body.material == d.materials[m].name; };
    if (is_isotropic(pores->materials[m].biot) || std::none_of(d.bodies.begin(), d.bodies.end(), is_of)) continue;
    return fmt::format("'{}'", d.materials[m].name);
  }
  return std::nullopt;
}

Found periodic_axis(const SimulationDefinition& d) {
  const Found face = wall_of(d, WallKind::periodic);
  return face ? Found(face->substr(0, 1)) : face;
}

bool in_pair(const SimulationDefinition& d, const std::string& tool) {
  const auto& pairs = d.contact.pairs;
  return std::any_of(pairs.begin(), pairs.end(), [&](const PairDefinition& pair) { return pair.second == tool; });
}

/// A body that has a law with another one, for which they have velocity fields of their own.
Found body_with_law(const SimulationDefinition& d) {
  for (const PairDefinition& pair : d.contact.pairs) {
    const auto is_tool = [&](const auto& body) { return body.name == pair.second; };
    if (std::none_of(d.rigid_bodies.begin(), d.rigid_bodies.end(), is_tool)) return fmt::format("'{}'", pair.first);
  }
  return named_in(d.bodies, [&](const DeformableBody& body) { return body.field != d.bodies.front().field; });
}

/// True for more than one constant friction. A tool that is filled with particles is met as another body is.
bool has_law(const SimulationDefinition& d, const RigidBodyDefinition& tool) {
  if (tool.particles) return false;
  return in_pair(d, tool.name) || tool.friction.static_coefficient >= 0.0 || tool.friction.adhesion != 0.0;
}

Found cut_body(const SimulationDefinition& d) {
  return named_in(d.bodies, [](const auto& body) { return !body.parts.empty() || !body.surfaces.empty(); });
}

bool any_load(const SimulationDefinition& d) {
  return !d.body_forces.empty() || !d.particle_forces.empty() || !d.tractions.empty();
}

bool uses_present_place(const Function& function) {
  const std::vector<std::string> names = names_in_expression(function.text());
  return function.uses_place() && std::any_of(names.begin(), names.end(), [](const std::string& name) {
           return name == "x" || name == "y" || name == "z";
         });
}

/// True for a load whose value at a particle does not stay what it is at the start, or depends on time and differs
/// between particles. The place at the start goes around periodic axes.
bool any_load_of_place(const SimulationDefinition& d) {
  const bool around = wall_of(d, WallKind::periodic).has_value();
  const auto of_place = [around](const std::array<Function, 3>& value) {
    const auto any = [&](auto is) { return std::any_of(value.begin(), value.end(), is); };
    const bool of_start = any([](const Function& f) { return f.uses_place(); });
    return any(uses_present_place) || (of_start && (around || any([](const Function& f) { return f.uses_time(); })));
  };
  return std::any_of(d.body_forces.begin(), d.body_forces.end(),
                     [&](const auto& load) { return of_place(load.acceleration); }) ||
         std::any_of(d.particle_forces.begin(), d.particle_forces.end(),
                     [&](const auto& load) { return of_place(load.force); });
}

/// True for a traction on faces that turn or stretch, or that differs between them.
bool any_traction_of_place(const SimulationDefinition& d) {
  return std::any_of(d.tractions.begin(), d.tractions.end(), [&](const TractionDefinition& traction) {
    return traction.follows || d.method.shape != ShapeKind::ugimp ||
           std::any_of(traction.value.begin(), traction.value.end(), [](const Function& f) { return f.uses_place(); });
  });
}

/// Words and key of a feature, and how it is found.
struct Entry {
  Feature feature;
  const char* name;
  const char* key;
  Found (*find)(const SimulationDefinition&, const RunKind&);
};

using D = const SimulationDefinition&;
using R = const RunKind&;

// In the order of Feature.
constexpr std::array<Entry, kFeatures> kEntries = {{
    {Feature::absorbing_faces, "absorbing faces", "boundaries",
     [](D d, R) { return wall_of(d, WallKind::absorbing); }},
    {Feature::apic, "apic", "method.transfer",
     [](D d, R) { return found_if(d.method.transfer.kind == TransferKind::apic); }},
    {Feature::average_dilatation, "averaged dilatation", "method.average_dilatation",
     [](D d, R) { return found_if(d.method.average_dilatation); }},
    {Feature::average_stress, "averaged stress", "method.average_stress",
     [](D d, R) { return found_if(d.method.average_stress.value_or(false)); }},
    {Feature::axisymmetric, "an axisymmetric scene", "geometry",
     [](D d, R) { return found_if(axisymmetric(d.geometry)); }},
    {Feature::body_laws, "laws of contact between deformable bodies", "contact.pairs",
     [](D d, R) { return body_with_law(d); }},
    {Feature::collisions, "rigid bodies that collide", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto& body) { return body.collide.has_value(); }); }},
    {Feature::conditions, "velocity conditions", "boundaries.conditions",
     [](D d, R) { return found_if(!d.conditions.empty()); }},
    {Feature::conditions_beside_contact, "velocity conditions beside rigid bodies, frictional walls or implicit steps",
     "boundaries.conditions",
     [](D d, R) {
       const bool contact = !d.rigid_bodies.empty() || wall_of(d, WallKind::frictional).has_value() ||
                            d.method.update == UpdateScheme::implicit;
       return found_if(!d.conditions.empty() && contact);
     }},
    {Feature::contact_at_nodes, "contact at nodes", "contact.method",
     [](D d, R) { return found_if(d.contact.method == ContactMethod::nodes); }},
    {Feature::cracks, "cracks", "cracks", [](D d, R) { return found_if(d.cracks.any()); }},
    {Feature::cut_particles, "particles cut by a curved surface", "bodies", [](D d, R) { return cut_body(d); }},
    {Feature::damping, "damping", "method.damping", [](D d, R) { return found_if(d.method.damping.any()); }},
    {Feature::damping_of_place, "damping that depends on the place", "method.damping",
     [](D d, R) {
       const DampingDefinition& damping = d.method.damping;
       return found_if(damping.grid.uses_place() || damping.particle.uses_place() || damping.pic.uses_place());
     }},
    {Feature::device, "steps on a graphics processor", "--device", [](D, R run) { return found_if(run.device); }},
    {Feature::divided_bodies, "bodies that a tool divides", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto& body) { return !body.divides.empty(); }); }},
    {Feature::following_ground, "ground that follows bodies", "terrain",
     [](D d, R) { return found_if(d.bed.has_value()); }},
    {Feature::free_bodies, "free bodies", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto& body) { return body.free.has_value(); }); }},
    {Feature::frictional_walls, "frictional walls", "boundaries",
     [](D d, R) { return wall_of(d, WallKind::frictional); }},
    {Feature::implicit_steps, "implicit steps", "method.update",
     [](D d, R) { return found_if(d.method.update == UpdateScheme::implicit); }},
    {Feature::leaving, "particles that leave the grid", "grid.leave",
     [](D d, R) { return found_if(d.grid.leave_limit > 0); }},
    {Feature::line, "a line", "geometry", [](D d, R) { return found_if(d.geometry == GeometryKind::line); }},
    {Feature::loads, "loads", "loads",
     [](D d, R) { return found_if(any_load(d)); }},
    {Feature::loads_beside_cut, "loads beside particles cut by a curved surface", "loads",
     [](D d, R) {
       return any_load(d) ? cut_body(d) : std::nullopt;
     }},
    {Feature::loads_of_place, "loads that depend on the present place, or on that at the start beside time or a periodic axis", "loads",
     [](D d, R) { return found_if(any_load_of_place(d)); }},
    {Feature::oblique_biot, "a Biot coefficient that differs between directions", "transport.pore_pressure",
     [](D d, R) { return oblique_biot(d); }},
    {Feature::own_laws, "a law of the user's program", "materials",
     [](D d, R) {
       const auto is_own = [](const auto& m) { return std::holds_alternative<UserLawDefinition>(m.law); };
       return named_in(d.materials, is_own);
     }},
    {Feature::particle_damping, "damping of the particles' velocity", "method.damping",
     [](D d, R) { return found_if(d.method.damping.in_update()); }},
    {Feature::particle_tools, "rigid bodies made of particles", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto& body) { return body.particles; }); }},
    {Feature::periodic_axes, "periodic axes", "boundaries", [](D d, R) { return periodic_axis(d); }},
    {Feature::plane_stress, "plane stress", "geometry",
     [](D d, R) { return found_if(d.geometry == GeometryKind::plane_stress); }},
    {Feature::point_particles, "particles that are points (dirac)", "method.shape",
     [](D d, R) { return found_if(traits_of(d.method.shape).point()); }},
    {Feature::pore_pressure, "water in pores", "transport.pore_pressure",
     [](D d, R) { return found_if(d.transport.find(Transported::pore_pressure) != nullptr); }},
    {Feature::ranks, "several processes", "method.update", [](D, R run) { return found_if(run.ranks > 1); }},
    {Feature::rigid_bodies, "rigid bodies", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto&) { return true; }); }},
    {Feature::rings, "a ring that opens", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [](const auto& body) { return body.inner_radius > 0.0; }); }},
    {Feature::robots, "robots", "robots",
     [](D d, R) { return named_in(d.robots, [](const auto&) { return true; }); }},
    {Feature::sheared_boxes, "boxes that shear (cpdi, qcpdi)", "method.shape",
     [](D d, R) { return found_if(traits_of(d.method.shape).shears()); }},
    {Feature::sleep, "sleep", "sleep", [](D d, R) { return found_if(d.sleep.has_value()); }},
    {Feature::sleep_damping, "damping of what falls asleep", "sleep.damping",
     [](D d, R) { return found_if(d.sleep && d.sleep->damping > 0.0); }},
    {Feature::solid, "a solid scene", "geometry", [](D d, R) { return found_if(d.geometry == GeometryKind::solid); }},
    {Feature::thin_tools, "thin tools, whose sides have velocity fields of their own", "rigid_bodies",
     [](D d, R) {
       // With implicit steps the sides share nodes unless the scene says otherwise.
       const bool shared = d.method.update == UpdateScheme::implicit;
       return named_in(d.rigid_bodies, [&](const auto& body) {
         return shared || !body.surface ? body.sides == Sides::two : has_sides(body, d.geometry, d.smallest_cell());
       });
     }},
    {Feature::tool_heat, "heat that a tool exchanges", "transport.temperature.tools",
     [](D d, R) {
       const QuantityDefinition* heat = d.transport.find(Transported::temperature);
       return heat == nullptr || heat->tools.empty() ? std::nullopt : Found(fmt::format("'{}'", heat->tools[0].body));
     }},
    {Feature::tool_laws, "a tool's adhesion, friction at rest or law of its own with a body", "rigid_bodies",
     [](D d, R) { return named_in(d.rigid_bodies, [&](const auto& body) { return has_law(d, body); }); }},
    {Feature::tractions_of_place,
     "tractions that follow a face or depend on the place, or with another shape than ugimp", "loads",
     [](D d, R) { return found_if(any_traction_of_place(d)); }},
    {Feature::transport, "transport", "transport", [](D d, R) { return found_if(!d.transport.quantities.empty()); }},
    {Feature::volumes, "volumes that count material", "volumes", [](D d, R) { return found_if(!d.volumes.empty()); }},
}};

constexpr bool in_order() {
  for (int i = 0; i < kFeatures; ++i) {
    if (kEntries[i].feature != static_cast<Feature>(i)) return false;
  }
  return true;
}
static_assert(in_order());

const Entry& entry(Feature feature) { return kEntries[static_cast<std::size_t>(feature)]; }

constexpr const char* kOneOut = "leave one of the two out";
constexpr const char* kExplicit = "leave it out, or use method.update: usavg";
constexpr const char* kOnCpu = "run it with --device cpu";
constexpr const char* kNoKernel = "there are no kernels for that yet";

}  // namespace

const std::vector<FeatureRule>& feature_rules() {
  static const std::vector<FeatureRule> kRules = {
      {Feature::following_ground, Feature::absorbing_faces, "absorbing faces know the particles that they began with",
       "write fixed or slip"},
      {Feature::following_ground, Feature::average_dilatation, "ground is made without the averages of its neighbours",
       kOneOut},
      {Feature::following_ground, Feature::body_laws, "the ground is the only deformable body",
       "make the others rigid"},
      {Feature::following_ground, Feature::conditions,
       "conditions move material where the ground ends, which stays at rest", kOneOut},
      {Feature::following_ground, Feature::cracks, "ground that is made knows no crack", kOneOut},
      {Feature::following_ground, Feature::damping, "damping keeps numbers of the particles that it began with",
       "leave it out, or write sleep.damping"},
      {Feature::following_ground, Feature::divided_bodies, "ground that is made knows no side of a tool",
       "leave divides out"},
      {Feature::following_ground, Feature::leaving,
       "what leaves is remembered by numbers of particles, which go on growing",
       "leave it out, and close the faces with walls"},
      {Feature::following_ground, Feature::line, "ground lies on x and y", "use plane_strain"},
      {Feature::following_ground, Feature::loads, "ground is made as it rests under gravity alone", kOneOut},
      {Feature::following_ground, Feature::particle_tools, "their particles do not know ground that is made",
       "leave out normals: particles"},
      {Feature::following_ground, Feature::periodic_axes, "columns of ground do not go on across their faces",
       "write faces such as x_min: slip"},
      {Feature::following_ground, Feature::plane_stress, "ground lies on x and y", "use plane_strain"},
      {Feature::following_ground, Feature::ranks, "ground is made and put away in one process", "start one process"},
      {Feature::following_ground, Feature::transport,
       "ground that is made and put away has no temperature, solute or water", kOneOut},
      {Feature::cracks, Feature::line, "a crack is a line in a plane",
       "write geometry: plane_strain, plane_stress or axisymmetric"},
      {Feature::cracks, Feature::solid, "a crack is a line in a plane, and would be a surface here",
       "write geometry: plane_strain, plane_stress or axisymmetric"},
      {Feature::cracks, Feature::implicit_steps, "implicit steps have one velocity at a node", kExplicit},
      {Feature::average_dilatation, Feature::line, "a line has one strain, and nothing in it locks", "leave it out"},
      {Feature::average_dilatation, Feature::plane_stress, "the thickness follows there, and nothing locks",
       "leave it out, or use plane_strain"},
      {Feature::average_stress, Feature::line, "a line has one strain, and nothing in it locks", "leave it out"},
      {Feature::average_stress, Feature::plane_stress, "the thickness follows there, and nothing locks",
       "leave it out, or use plane_strain"},
      {Feature::apic, Feature::point_particles,
       "apic needs the inverse of sum S (x_i - x_p)(x_i - x_p), which a point on a line of the grid does not have",
       "use another shape, such as ugimp, or transfer {xpic: 2}"},
      {Feature::particle_damping, Feature::apic,
       "apic keeps a part of the motion in a matrix that this damping does not reach",
       "use {grid: 20 1/s, placement: force}, with feedback of the grid, or transfer flip"},
      {Feature::absorbing_faces, Feature::pore_pressure,
       "the faces absorb the waves of dry material, and those of wet material are faster",
       "make the face slip or fixed, farther away"},
      {Feature::pore_pressure, Feature::plane_stress, "a law there has no effective stress across the plate",
       "write geometry: plane_strain"},
      {Feature::average_dilatation, Feature::oblique_biot, "the mean of a cell has one coefficient for all directions",
       kOneOut},
      {Feature::collisions, Feature::contact_at_nodes, "contact at nodes does not move a body",
       "leave out contact.method, or write points"},
      {Feature::collisions, Feature::particle_tools,
       "such a body is met by its particles, which other tools do not see", "leave out normals: particles"},
      {Feature::collisions, Feature::line, "bodies of a line meet in one point", "write geometry: plane_strain"},
      {Feature::free_bodies, Feature::contact_at_nodes, "contact at nodes does not move a body",
       "leave out contact.method, or write points"},
      {Feature::free_bodies, Feature::particle_tools, "a free body is met at points of the material's surface",
       "leave out normals: particles"},
      {Feature::free_bodies, Feature::rings, "a ring that opens is not rigid", "write another shape"},
      {Feature::robots, Feature::contact_at_nodes, "contact at nodes does not move a link",
       "leave out contact.method, or write points"},
      {Feature::robots, Feature::periodic_axes, "links do not go around", "write faces such as x_min: slip"},
      {Feature::robots, Feature::ranks, "the joints of a robot are solved in one process", "start one process"},
      {Feature::tool_laws, Feature::contact_at_nodes, "contact at nodes has one constant friction for a tool",
       "leave out contact.method, or write points"},
      {Feature::tool_heat, Feature::contact_at_nodes, "at nodes no area of contact is known",
       "leave out contact.method, or write points"},
      {Feature::line, Feature::implicit_steps, "implicit steps are made for solid, plane_strain and axisymmetric",
       "use method.update: usavg"},
      {Feature::plane_stress, Feature::implicit_steps,
       "implicit steps are made for solid, plane_strain and axisymmetric", "use method.update: usavg"},
      {Feature::average_dilatation, Feature::implicit_steps,
       "implicit steps have one stress in a cell, which does not lock", "leave it out"},
      {Feature::average_stress, Feature::implicit_steps, "implicit steps have one stress in a cell as it is",
       "leave it out"},
      {Feature::absorbing_faces, Feature::implicit_steps, "implicit steps have no waves to absorb",
       "write fixed or slip"},
      {Feature::particle_tools, Feature::implicit_steps, "implicit steps meet bodies at points of their surface",
       "leave normals: particles out"},
      {Feature::divided_bodies, Feature::implicit_steps,
       "implicit steps have one velocity at a node, so that nothing is divided",
       "leave divides out, or use method.update: usavg"},
      {Feature::thin_tools, Feature::implicit_steps, "with implicit steps the two sides of a body share nodes",
       "write sides: one"},
      {Feature::contact_at_nodes, Feature::implicit_steps, "implicit steps meet bodies at points of their surface",
       "leave it out"},
      {Feature::damping, Feature::implicit_steps, "implicit steps have none", "leave it out"},
      {Feature::body_laws, Feature::implicit_steps, "with implicit steps bodies move as one where they meet",
       "leave the pair out, or use method.update: usavg"},
      {Feature::sleep_damping, Feature::implicit_steps, "implicit steps have no such damping", kExplicit},
      {Feature::transport, Feature::implicit_steps, "implicit steps do not have transport yet", kExplicit},
      {Feature::leaving, Feature::implicit_steps, "implicit steps do not let particles leave yet", kExplicit},
      {Feature::ranks, Feature::implicit_steps, "implicit steps run in one process",
       "start one process, or write method.update: usavg, also where method: auto has chosen them"},
      {Feature::device, Feature::ranks, "such a processor takes the steps of one process",
       "start one process, or run it with --device cpu"},
      {Feature::device, Feature::axisymmetric, kNoKernel, kOnCpu},
      {Feature::device, Feature::plane_stress, kNoKernel, kOnCpu},
      {Feature::device, Feature::line, kNoKernel, kOnCpu},
      {Feature::device, Feature::point_particles, kNoKernel, "use another shape, such as ugimp, or --device cpu"},
      {Feature::device, Feature::sheared_boxes, kNoKernel, "use another shape, such as ugimp, or --device cpu"},
      {Feature::device, Feature::average_dilatation, kNoKernel, kOnCpu},
      {Feature::device, Feature::own_laws, "its code is not in the kernels of such a processor", kOnCpu},
      {Feature::device, Feature::body_laws, "all bodies are in one velocity field there", kOnCpu},
      {Feature::device, Feature::absorbing_faces, kNoKernel, kOnCpu},
      {Feature::device, Feature::following_ground, kNoKernel, kOnCpu},
      {Feature::device, Feature::transport, kNoKernel, kOnCpu},
      {Feature::device, Feature::cracks, kNoKernel, kOnCpu},
      {Feature::device, Feature::volumes, kNoKernel, kOnCpu},
      {Feature::device, Feature::particle_tools, "contact is not found from volumes there yet", kOnCpu},
      {Feature::device, Feature::thin_tools, "all material is in one velocity field there",
       "write sides: one for the tool, or run it with --device cpu"},
      {Feature::device, Feature::conditions_beside_contact, "conditions do not act after contact there yet", kOnCpu},
      {Feature::device, Feature::damping_of_place, "it would be read for each node and particle in each step", kOnCpu},
      {Feature::device, Feature::loads_of_place, "they would be read for each particle in each step", kOnCpu},
      {Feature::device, Feature::loads_beside_cut, "loads know particles of one mass there", kOnCpu},
      {Feature::device, Feature::tractions_of_place, "there are no kernels for such faces yet", kOnCpu}};
  return kRules;
}

const char* feature_name(Feature feature) { return entry(feature).name; }
const char* feature_key(Feature feature) { return entry(feature).key; }

std::optional<std::string> find_feature(Feature feature, const SimulationDefinition& definition, const RunKind& run) {
  return entry(feature).find(definition, run);
}

std::string BrokenRule::why() const {
  const auto named = [](const std::string& by) { return by.empty() ? by : " (" + by + ")"; };
  return fmt::format("{}{} and {}{} do not go together: {}", feature_name(rule->feature), named(who),
                     feature_name(rule->beside), named(who_beside), rule->reason);
}

std::optional<BrokenRule> broken_rule(const SimulationDefinition& definition, const RunKind& run,
                                      std::optional<Feature> coming) {
  const auto find = [&](Feature feature) {
    return feature == coming ? Found("") : find_feature(feature, definition, run);
  };
  for (const FeatureRule& rule : feature_rules()) {
    const Found own = find(rule.feature);
    if (!own) continue;
    if (const Found other = find(rule.beside)) return BrokenRule{&rule, *own, *other};
  }
  return {};
}

std::optional<MethodFault> feature_fault(const SimulationDefinition& definition, const RunKind& run,
                                         std::optional<Feature> coming) {
  const auto broken = broken_rule(definition, run, coming);
  if (!broken) return {};
  return MethodFault{feature_key(broken->rule->feature), broken->why() + "; " + broken->rule->remedy};
}

}  // namespace mpm
