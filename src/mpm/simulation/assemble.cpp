// From a definition to a run: checks it, has the particles made (particle_start.hpp), and puts the list of modules
// together.
#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "axial_motion.hpp"
#include "mpm/boundary/wall.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/block_probe.hpp"
#include "mpm/mechanics/nodal_volumes.hpp"
#include "mpm/mechanics/scalar_transfers.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/modules/with_precision.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/rules/implicit_rules.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/rigid_rules.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/rules/transport_work.hpp"
#include "mpm/simulation/threads.hpp"
#include "mpm/start/initial.hpp"
#include "mpm/start/particle_start.hpp"
#include "state.hpp"
#include "velocity_fields.hpp"

namespace mpm {

const std::array<const char*, 6> kWallNames = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

namespace {

constexpr int kMostThreads = 1024;

void check(const SimulationDefinition& d, const RunKind& run) {
  if (d.time.sync <= 0) throw DefinitionError("time.sync must be a positive number of nanoseconds");
  if (const auto fault = keys_fault(d)) throw DefinitionError(fmt::format("{}: {}", fault->key, fault->text));
  if (const auto fault = method_fault(d.method, d.geometry)) {
    throw DefinitionError(fmt::format("method.{}: {}", fault->key, fault->text));
  }
  if (const auto fault = feature_fault(d, run)) {
    throw DefinitionError(fmt::format("{}: {}", fault->key, fault->text));
  }
  if (const auto fault = implicit_fault(d)) {
    throw DefinitionError(fmt::format("{}: {}", fault->key, fault->text));
  }
  if (d.method.particles_per_direction < 1) throw DefinitionError("at least one particle along a cell's edge");
  if (planar(d.geometry) && !(d.thickness > 0.0)) throw DefinitionError("thickness must be positive");
  if (d.geometry == GeometryKind::line && !(d.area > 0.0)) throw DefinitionError("area must be positive");
  if (!d.gravity.allFinite()) throw DefinitionError("gravity is not finite");
  for (int axis = 0; axis < 3; ++axis) {
    const bool lower = d.walls[2 * axis].kind == WallKind::periodic;
    if (lower != (d.walls[2 * axis + 1].kind == WallKind::periodic)) {
      throw DefinitionError(fmt::format("one face along {} is periodic, the other is not; make both so", "xyz"[axis]));
    }
    if (lower && axis == 0 && axisymmetric(d.geometry)) {
      throw DefinitionError("an axisymmetric scene is not periodic along r; use z, or make it plane_strain");
    }
  }
  if (const auto fault = axis_fault(d)) throw DefinitionError(fmt::format("{}: {}", fault->key, fault->text));
}

void project(FreeDefinition& free, GeometryKind geometry) {
  for (const int axis : axes_beside(geometry)) {
    free.present[axis] = false;
    free.velocity.linear[axis] = free.centre[axis] = free.wrench.force[axis] = 0.0;
  }
  if (axisymmetric(geometry)) {
    free.present[0] = false;
    free.velocity.linear.x() = free.wrench.force.x() = 0.0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    free.present[3 + axis] = turns_about(geometry, axis);
    if (!free.present[3 + axis]) free.velocity.angular[axis] = free.wrench.torque[axis] = 0.0;
  }
  for (int k = 0; k < 6; ++k) free.axes[k] = free.axes[k] && free.present[k];
}

template <class Begin>
void begin_on_device(const Begin& begin) {
  try {
    begin();
  } catch (const Error& error) {
    throw DeviceError(error.what());
  }
}

// Leaves only what is along the grid's axes.
void project(SimulationDefinition& definition) {
  const GeometryKind geometry = definition.geometry;
  for (const int axis : axes_beside(geometry)) {
    definition.gravity[axis] = 0.0;
    for (RigidBodyDefinition& body : definition.rigid_bodies) body.velocity[axis] = Function();
    for (BodyForceDefinition& load : definition.body_forces) load.acceleration[axis] = Function();
    for (ParticleForceDefinition& load : definition.particle_forces) load.force[axis] = Function();
    for (TractionDefinition& load : definition.tractions) {
      if (!load.follows) load.value[axis] = Function();
    }
  }
  for (RigidBodyDefinition& body : definition.rigid_bodies) {
    body.pose = projected(body.pose, geometry, body);
    for (int axis = 0; axis < 3; ++axis) {
      if (!turns_about(geometry, axis)) body.rotation_rate[axis] = Function();
    }
    if (body.free) project(*body.free, geometry);
    // A solve has one velocity at a node.
    if (definition.method.update == UpdateScheme::implicit) body.sides = Sides::one;
  }
}

}  // namespace

Twist projected(const Twist& twist, GeometryKind geometry, const RigidBodyDefinition& body) {
  if (axisymmetric(geometry)) return axial_twist(twist, body);
  Twist kept = twist;
  for (const int axis : axes_beside(geometry)) kept.linear[axis] = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!turns_about(geometry, axis)) kept.angular[axis] = 0.0;
  }
  return kept;
}

Pose projected(const Pose& pose, GeometryKind geometry, const RigidBodyDefinition& body) {
  if (geometry == GeometryKind::solid) return pose;
  if (axisymmetric(geometry)) return axial_pose(pose, body);
  if (geometry == GeometryKind::line) return {{pose.position.x(), 0.0, 0.0}, Quat::Identity()};
  const Quat& q = pose.orientation;
  const double about_y = std::hypot(q.w(), q.y());
  if (!(about_y >= 1e-3 * q.norm())) {
    throw RigidError(
        fmt::format("rigid body '{}': its pose is turned over in a planar scene; turn it about y only", body.name));
  }
  const double scale = q.norm() / about_y;
  return {{pose.position.x(), 0.0, pose.position.z()}, Quat(q.w() * scale, 0.0, q.y() * scale, 0.0)};
}

// A transfer can make the largest stable step smaller than a cell over the wave speed.
std::string step_warning(const SimulationDefinition& definition) {
  const Transfer& transfer = definition.method.transfer;
  const double most = stable_cfl(transfer);
  // It limits the motion of tools alone in implicit steps.
  if (definition.time.cfl <= most || definition.method.update == UpdateScheme::implicit) return {};
  const bool affine = transfer.kind == TransferKind::apic;
  return fmt::format("time.cfl is {:g}: with {} steps that long may be unstable; use at most {:g}", definition.time.cfl,
                     affine ? "apic" : fmt::format("fmpm {}", transfer.order), most);
}

std::unique_ptr<ScalarTransfer> RunParts::make_transfer(ShapeKind shape) {
  return with_precision(definition.method.precision, [&](auto zero) {
    return make_scalar_transfer(kernel_table<decltype(zero)>(shape, definition.geometry, isa), fields, sets, threads,
                                choice, halo);
  });
}

std::unique_ptr<BlockProbe> RunParts::make_probe() {
  const MethodDefinition& method = definition.method;
  return with_precision(method.precision, [&](auto zero) {
    return make_block_probe(kernel_table<decltype(zero)>(method.shape, definition.geometry, isa), fields, sets, laws,
                            method.average_dilatation, threads);
  });
}

VolumeSurvey& RunParts::volumes() {
  if (services.volumes) return *services.volumes;
  std::vector<double> densities;
  for (const DeformableBody& body : definition.bodies) densities.push_back(find_material(definition, body).density);
  services.volumes = make_volume_survey(make_transfer(definition.method.shape), fields, sets, std::move(densities),
                                        definition.geometry, threads, choice);
  return *services.volumes;
}

void Simulation::State::add_modules(const std::vector<AddModules>& of_caller, bool on_device) {
  const MethodDefinition& method = definition.method;
  for (ParticleSet& set : sets) prepare(set, method.shape, method.transfer);
  bodies.reserve(definition.rigid_bodies.size());
  for (const RigidBodyDefinition& body : definition.rigid_bodies) bodies.emplace_back(body);
  for (const RobotDefinition& robot : definition.robots) {
    robots.push_back(std::make_unique<Robot>(robot, definition.gravity, bodies));
  }
  if (ranks) {
    over = std::make_unique<OverRanks>(*ranks, layout(), bodies);
    if (!ranks->first()) modules.leave_shared_to_first();
  }
  RunParts parts{definition,
                 field_map,
                 fields,
                 sets,
                 laws,
                 bodies,
                 robots,
                 choice.get(),
                 ranks.get(),
                 over ? &over->halo() : nullptr,
                 threads,
                 isa,
                 modules,
                 services,
                 warnings,
                 notes,
                 [this]() -> const EnergyReport& { return find_totals().energy; },
                 interrupt};
  // An implicit step solves all contacts itself, on a grid of its own.
  if (on_device && (!bodies.empty() || definition.method.update == UpdateScheme::implicit)) {
    host_contact = std::make_unique<ContactOnHost>(bodies, modules, make_fields(definition, field_map.count()), sets);
    parts.near_bodies = &host_contact->sets();
    parts.fields_near_bodies = &host_contact->fields();
  }
  for (const ShippedModules& shipped : shipped_modules()) shipped.add(parts);
  for (const AddModules& add : of_caller) add(parts);
  if (on_device && parts.sleep != nullptr) {
    rest_on_host = std::make_unique<RestOnHost>(*parts.sleep, modules, fields, sets, device);
  }
  for (Module* module : modules.list()) {
    if (auto* reporter = dynamic_cast<ContactReporter*>(module)) reporters.push_back(reporter);
  }

  ContinuumSettings settings;
  settings.transfer = method.transfer;
  settings.average_dilatation = method.average_dilatation;
  if (axisymmetric(definition.geometry)) settings.axis_motion = method.axis.motion;
  settings.gradient_terms = method.gradient_terms;
  settings.gravity = definition.gravity;
  settings.threads = threads;
  settings.damping = parts.damping;
  settings.choice = choice.get();
  settings.halo = parts.halo;
  with_precision(method.precision, [&](auto zero) {
    const auto kernels = kernel_table<decltype(zero)>(method.shape, definition.geometry, isa);
    mechanics = make_mechanics(kernels, fields, sets, laws, settings);
    sorter = std::make_unique<Sorter>(threads, kernel_grouping(kernels), choice.get());
  });
}

Simulation::Simulation(SimulationDefinition given, SimulationOptions options) : state_(std::make_unique<State>()) {
  State& s = *state_;
  const RunKind run{options.ranks ? options.ranks->size() : 1, options.device.has_value()};
  agree<DefinitionError>(options.ranks.get(), [&] { check(given, run); });
  if (options.device && !options.modules.empty()) {
    throw DefinitionError(
        "steps on a graphics processor do not reach modules of the program; run it with --device cpu");
  }
  if (options.threads > kMostThreads) {
    throw DefinitionError(
        fmt::format("{} threads are asked for; at most {} can be had, and more than the machine's {} "
                    "gain nothing (0: as many as are of use)",
                    options.threads, kMostThreads, omp_get_num_procs()));
  }
  s.asked_to_stop = std::move(options.stop);
  s.interrupt = std::move(options.interrupt);
  s.settling = std::move(options.settling);
  s.profile = options.profile;
  s.ranks = std::move(options.ranks);
  s.definition = std::move(given);
  s.warnings = s.definition.warnings;
  Transfer& transfer = s.definition.method.transfer;
  const bool filters = transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm;
  if (filters && transfer.order == 1) transfer = {TransferKind::flip, 0.0, 1};  // the first order is PIC
  if (transfer.flip == 1.0) transfer.mixed = transfer.every = 1;                // and with FLIP alone nothing mixes
  const SimulationDefinition& definition = s.definition;
  std::size_t count = 0;
  std::vector<std::string> materials;
  for (const DeformableBody& body : definition.bodies) {
    count += whole_of(body);
    materials.push_back(body.material);
  }
  if (const std::string slow = transport_warning(definition, materials); !slow.empty()) s.warnings.push_back(slow);
  s.threads = options.threads > 0 ? options.threads : useful_threads(count);
  s.isa = choose_isa(options.isa ? isa_name(*options.isa) : "");
  project(s.definition);
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    const std::string fault = rigid_fault(definition, body);
    if (!fault.empty()) throw DefinitionError(fmt::format("rigid body '{}': {}", body.name, fault));
  }
  s.field_map = field_map(definition);
  s.fields = make_fields(definition, s.field_map.count());
  s.choice = make_choice(s.field_map, s.fields);
  const GridLayout& layout = s.layout();
  if (s.ranks) leave_own(s.definition, *s.ranks, layout);

  const bool geostatic = std::any_of(definition.bodies.begin(), definition.bodies.end(),
                                     [](const DeformableBody& body) { return body.geostatic.has_value(); });
  if (geostatic) add_geostatic_stress(s.definition, s.ranks.get(), s.warnings);
  const std::string during = "the run was put together";
  const std::function<bool()> interrupt = s.ranks ? nullptr : s.interrupt;  // ranks stop together only
  StopCheck check_stop(interrupt, during, 1), check_particle(interrupt, during);
  std::uint32_t next_id = 0;
  s.sets.reserve(definition.bodies.size());
  for (DeformableBody& body : s.definition.bodies) {
    check_stop();
    const MaterialDefinition& material = find_material(definition, body);
    s.laws.push_back(make_law(material));
    s.sets.push_back(make_set(definition, body, material, s.laws.back(), layout, next_id, s.ranks.get(), s.warnings,
                              check_particle));
    if (!body.filling.empty()) s.notes.push_back(fmt::format("body '{}': {}", body.name, body.filling));
    ParticleSet& set = s.sets.back();
    const int number = static_cast<int>(s.sets.size()) - 1;
    set.field = s.field_map.field(number, 0);
    set.far_field = s.field_map.field(number, 1);
    set.chooses = s.field_map.across(number) > 0;
    if (set.chooses) set.far_field = s.choice->number();
    if (set.far_field != set.field) set.side.assign(set.id.size(), 0);
    s.sizes.push_back(whole_of(body));
    next_id += static_cast<std::uint32_t>(s.sizes.back());
    s.total_mass += total_mass(set, body, s.ranks.get());
    if (!geostatic) forget_particles(body);
  }
  if (s.sets.empty()) throw DefinitionError("there is no deformable body, so nothing to simulate; add one to 'bodies'");
  if (geostatic && options.settle && !definition.bed) s.settle();  // its ends would slide
  for (DeformableBody& body : s.definition.bodies) forget_particles(body);

  if (const std::string warning = step_warning(definition); !warning.empty()) s.warnings.push_back(warning);
  for (const MaterialDefinition& material : definition.materials) {
    if (const std::string warning = material_warning(definition.geometry, material); !warning.empty()) {
      s.warnings.push_back(warning);
    }
  }
  check_stop();
  s.add_modules(options.modules, options.device.has_value());
  check_stop();

  const double lightest = least_mass(s.sets, s.ranks.get());
  for (auto& grid : s.fields) grid->least_mass = 1e-30 * lightest;
  for (std::size_t f = 0; s.host_contact && f < s.fields.size(); ++f) {
    s.host_contact->fields()[f]->least_mass = 1e-30 * lightest;
  }
  s.gravity.name = "gravity";
  if (s.over) s.over->divide(s.sets);
  s.sort(0.0);
  if (s.services.bed != nullptr) s.begin_bed();
  if (s.over) s.over->warn_of_idle(s.sets, s.warnings);
  StepContext start{s.fields, 0.0};
  s.modules.act(Hook::run_begun, start);
  if (options.device) {
    begin_on_device([&] {
      s.hand_to_device(*options.device);
      s.survey_material();  // its first kernels
    });
  }
  s.material_limit = s.previous_limit = s.survey_material();
  s.initial_momentum = s.momentum();
  s.watch_energy(0.0, s.material_limit);
  s.foreign_modules = !options.modules.empty();
  s.rates.resize(definition.metrics.size());
  std::vector<double> unused;
  std::vector<NamedNumber> reported;
  const auto names_number = [](const MetricDefinition& metric) { return !metric.number.empty(); };
  if (std::any_of(definition.metrics.begin(), definition.metrics.end(), names_number)) reported = numbers();
  for (const MetricDefinition& metric : definition.metrics) {
    if (is_wrench(metric)) s.wrenches.resize(s.bodies.size());
    const auto is_it = [&](const NamedNumber& number) { return number.name == metric.number; };
    if (names_number(metric) && std::none_of(reported.begin(), reported.end(), is_it)) {
      statistic_of(metric, unused);  // throws, for the run has no such number
    }
    if (find_body(metric.body) >= 0 || !metric.number.empty() || !metric.formula.empty()) continue;
    if (needs_start({metric.field})) keep_start();
    s.check_field(metric.field);
  }
  sample_metrics();
}

}  // namespace mpm
