#include "mpm/simulation/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "mpm/boundary/grid_damping.hpp"
#include "mpm/boundary/wall.hpp"
#include "state.hpp"

namespace mpm {

const std::array<const char*, 6> kWallNames = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

namespace {

constexpr double kNanosecond = 1e-9;

const MaterialDefinition& find_material(const SimulationDefinition& definition, const DeformableBody& body) {
  for (const MaterialDefinition& material : definition.materials) {
    if (material.name == body.material) return material;
  }
  throw DefinitionError(fmt::format("body '{}': no material is called '{}'", body.name, body.material));
}

ParticleSet make_set(const SimulationDefinition& definition, const DeformableBody& body, const GridLayout& layout) {
  const MaterialDefinition& material = find_material(definition, body);
  if (body.positions.empty()) throw DefinitionError(fmt::format("body '{}' has no particle", body.name));
  if (!(body.particle_volume > 0.0)) {
    throw DefinitionError(
        fmt::format("body '{}': particle volume {} must be positive", body.name, body.particle_volume));
  }
  ParticleSet set(body.name, make_law(material));
  set.volume = body.particle_volume;
  set.mass = material.density * body.particle_volume;
  const int dim = layout.dim();
  const std::size_t n = body.positions.size();
  for (int k = 0; k < dim; ++k) set.half[k] = 0.5 / definition.method.particles_per_direction;
  set.id.resize(n);
  set.x.assign(dim, std::vector<double>(n));
  set.v.assign(dim, std::vector<double>(n));
  for (std::size_t p = 0; p < n; ++p) {
    for (int k = 0; k < dim; ++k) {
      set.x[k][p] = body.positions[p][layout.axis(k)];
      set.v[k][p] = body.velocities.empty() ? 0.0 : body.velocities[p][layout.axis(k)];
    }
  }
  set.f.assign(dim == 3 ? 9 : 4, std::vector<double>(n, 0.0));
  for (int k = 0; k < dim; ++k) std::fill(set.f[k * (dim + 1)].begin(), set.f[k * (dim + 1)].end(), 1.0);
  set.tau.assign(dim == 3 ? 6 : 4, std::vector<double>(n, 0.0));
  set.history.assign(history_size(set.law), std::vector<double>(n, 0.0));
  if (definition.method.update == UpdateScheme::usavg) set.next_x.assign(dim, std::vector<double>(n));
  return set;
}

void check(const SimulationDefinition& d) {
  if (d.time.sync <= 0) throw DefinitionError("time.sync must be a positive number of nanoseconds");
  if (!(d.time.cfl > 0.0 && d.time.cfl < 1.0)) {
    throw DefinitionError(fmt::format("time.cfl is {}, must lie between 0 and 1", d.time.cfl));
  }
  if (d.method.gradient_terms < 1) throw DefinitionError("method.gradient_terms must be at least 1");
  if (!(d.method.flip >= 0.0 && d.method.flip <= 1.0)) {
    throw DefinitionError(fmt::format("FLIP fraction {} must lie in [0, 1]", d.method.flip));
  }
  if (!(d.method.damping >= 0.0)) throw DefinitionError("method.damping must not be negative");
  if (d.method.particles_per_direction < 1) throw DefinitionError("at least one particle along a cell's edge");
  if (d.geometry != GeometryKind::solid && !(d.thickness > 0.0)) throw DefinitionError("thickness must be positive");
}

}  // namespace

Simulation::Simulation(const SimulationDefinition& definition, SimulationOptions options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  check(definition);
  s.definition = definition;
  s.threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  const int dim = definition.geometry == GeometryKind::solid ? 3 : 2;
  s.grid = std::make_unique<Grid>(GridLayout(dim, definition.grid.cell, definition.grid.min, definition.grid.max));
  const GridLayout& layout = s.grid->layout;

  std::uint32_t next_id = 0;
  s.sets.reserve(definition.bodies.size());
  for (const DeformableBody& body : definition.bodies) {
    s.sets.push_back(make_set(definition, body, layout));
    ParticleSet& set = s.sets.back();
    set.first_id = next_id;
    for (std::uint32_t& id : set.id) id = next_id++;
    s.total_mass += set.mass * set.size();
  }
  if (next_id == 0) throw DefinitionError("there is no deformable body, so nothing to simulate; add one to 'bodies'");
  for (DeformableBody& body : s.definition.bodies) {
    body.positions = {};
    body.velocities = {};
  }

  if (definition.method.damping > 0.0) s.stages.push_back(std::make_unique<GridDamping>(definition.method.damping));
  s.bodies.reserve(definition.rigid_bodies.size());
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    s.bodies.emplace_back(body);
    auto contact = std::make_unique<RigidContact>(s.bodies.back(), s.threads);
    s.contacts.push_back(contact.get());
    s.stages.push_back(std::move(contact));
    const double cells = body.surface->thickness() / layout.smallest_cell();
    if (cells < 3.0) {
      s.warnings.push_back(
          fmt::format("rigid body '{}' is {:.2g} cells thick where it is thinnest: material on its two sides shares "
                      "nodes and feels "
                      "each other when it is thinner than 3; use a finer grid.cell or a thicker body",
                      body.name, cells));
    }
  }
  for (int face = 0; face < 6; ++face) {
    if (definition.walls[face].kind == WallKind::none) continue;
    const int world_axis = face / 2;
    if (dim == 2 && world_axis == 1) continue;
    const int grid_axis = dim == 3 ? world_axis : world_axis / 2;
    s.stages.push_back(std::make_unique<Wall>(2 * grid_axis + face % 2, definition.walls[face], kWallNames[face]));
  }

  ContinuumSettings settings;
  settings.flip = definition.method.flip;
  settings.gradient_terms = definition.method.gradient_terms;
  settings.gravity = definition.gravity;
  settings.threads = s.threads;
  s.mechanics = make_mechanics(dim, s.sets, settings);
  s.gravity.name = "gravity";
  s.sort();
  s.initial_momentum = state().audit.momentum;
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const SimulationDefinition& Simulation::definition() const { return state_->definition; }
int Simulation::threads() const { return state_->threads; }
std::string Simulation::isa() const { return kernel_isa(); }
std::vector<std::string> Simulation::warnings() const { return state_->warnings; }
std::int64_t Simulation::time() const { return state_->time; }
std::int64_t Simulation::sync_period() const { return state_->definition.time.sync; }

void Simulation::State::fail(const std::string& what, ParticleRef particle, const std::string& remedy) const {
  const ParticleSet& set = sets[particle.set];
  Vec3 position = Vec3::Zero();
  for (int k = 0; k < grid->layout.dim(); ++k) position[grid->layout.axis(k)] = set.x[k][particle.index];
  throw PhysicsError(
      fmt::format("{}: particle {} of body '{}' in step {} (t = {:.6g} s) at ({:.6g}, {:.6g}, {:.6g}) m; {}", what,
                  set.id[particle.index], set.name, steps.steps, time * kNanosecond, position.x(), position.y(),
                  position.z(), remedy));
}

void Simulation::State::sort() {
  if (const auto outside = sorter.sort(sets, *grid)) {
    fail(
        "a particle is outside the domain or not finite", *outside,
        "enlarge grid.min/grid.max, close that face with a wall in 'boundaries', or lower time.cfl if the run blew up");
  }
}

void Simulation::State::step(double at, double dt) {
  for (RigidBody& body : bodies) body.begin_step(at, dt);
  StepContext context{*grid, steps.steps, at, dt};
  if (definition.method.update == UpdateScheme::usavg) {
    step_usavg(*mechanics, stages, context);
  } else {
    step_usf(*mechanics, stages, context);
  }
  gravity.add(definition.gravity * (total_mass * dt));
  for (RigidBody& body : bodies) body.end_step(dt);
  ++steps.steps;
  steps.dt_last = dt;
  steps.dt_min = steps.steps == 1 ? dt : std::min(steps.dt_min, dt);
  steps.dt_max = std::max(steps.dt_max, dt);
  if (const auto failed = mechanics->failed()) {
    fail("the volume ratio J is not positive", *failed,
         "lower time.cfl, use a finer grid.cell or slower tools, or soften what presses on it");
  }
  if (mechanics->needs_sort()) sort();
}

void Simulation::advance() {
  State& s = *state_;
  const auto started = std::chrono::steady_clock::now();
  const auto [limit, limited_by] = s.step_limit();
  const double period = static_cast<double>(s.definition.time.sync) * kNanosecond;
  const double count = std::max(1.0, std::ceil(period / limit - 1e-9));
  if (!(count < 1e9)) {
    throw PhysicsError(
        fmt::format("the time step fell to {:.3g} s, limited by {}: the run cannot go on; lower "
                    "time.cfl or look for the particle that runs away",
                    limit, limited_by));
  }
  const int steps = static_cast<int>(count);
  s.steps.limited_by = limit > period ? "sync period" : limited_by;
  const double start = static_cast<double>(s.time) * kNanosecond;
  const double dt = period / steps;
  for (int k = 0; k < steps; ++k) s.step(start + k * dt, dt);
  s.time += s.definition.time.sync;
  for (RigidBody& body : s.bodies) body.at_sync(s.time);
  s.wall += std::chrono::steady_clock::now() - started;
}

int Simulation::find_body(const std::string& name) const {
  for (std::size_t b = 0; b < state_->bodies.size(); ++b) {
    if (state_->bodies[b].name() == name) return static_cast<int>(b);
  }
  return -1;
}

void Simulation::command_velocity(int body, const Twist& twist) {
  Twist applied = twist;
  if (state_->grid->layout.dim() == 2) {
    applied.linear.y() = 0.0;
    applied.angular.x() = applied.angular.z() = 0.0;
  }
  state_->bodies.at(body).command_velocity(applied);
}

void Simulation::command_pose(int body, const Pose& target, std::int64_t arrival) {
  Pose applied = target;
  if (state_->grid->layout.dim() == 2) {
    // Position in the plane, and of the rotation its part about y (swing-twist): zeros stay exact zeros.
    applied.position.y() = state_->bodies.at(body).pose().position.y();
    const double length = target.orientation.norm();
    const double in_plane = std::hypot(target.orientation.w(), target.orientation.y());
    if (in_plane > 0.0) {
      applied.orientation =
          Quat(target.orientation.w() * length / in_plane, 0.0, target.orientation.y() * length / in_plane, 0.0);
    }
  }
  state_->bodies.at(body).command_pose(applied, state_->time, arrival);
}

std::vector<BodyState> Simulation::bodies() const {
  std::vector<BodyState> list;
  for (const RigidBody& body : state_->bodies) list.push_back({body.name(), body.pose(), body.twist(), body.drive()});
  return list;
}

const RigidBody& Simulation::rigid_body(int body) const { return state_->bodies.at(body); }

ContactReport Simulation::take_contact(int body) {
  return state_->contacts.at(body)->take(static_cast<double>(state_->time) * kNanosecond);
}

std::uint64_t Simulation::particles() const {
  std::uint64_t count = 0;
  for (const ParticleSet& set : state_->sets) count += set.size();
  return count;
}

std::pair<std::uint64_t, std::uint64_t> Simulation::body_ids(const std::string& body) const {
  for (const ParticleSet& set : state_->sets) {
    if (set.name == body) return {set.first_id, set.first_id + set.size()};
  }
  throw DefinitionError(fmt::format("no deformable body is called '{}'", body));
}

}  // namespace mpm
