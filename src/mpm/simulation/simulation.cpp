#include "mpm/simulation/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "mpm/boundary/grid_damping.hpp"
#include "mpm/boundary/wall.hpp"
#include "mpm/math/dimension.hpp"
#include "state.hpp"

namespace mpm {

const std::array<const char*, 6> kWallNames = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

namespace {

constexpr double kNanosecond = 1e-9;
constexpr std::size_t kParticlesPerThread = 4000;  ///< fewer do not pay for the waiting at the end of every pass
constexpr double kMostSteps = 1e7;                 ///< in a sync period; more is a run that went wrong

const MaterialDefinition& find_material(const SimulationDefinition& definition, const DeformableBody& body) {
  for (const MaterialDefinition& material : definition.materials) {
    if (material.name == body.material) return material;
  }
  throw DefinitionError(fmt::format("body '{}': no material is called '{}'", body.name, body.material));
}

ParticleSet make_set(const SimulationDefinition& definition, const DeformableBody& body, double density, const Law& law,
                     const GridLayout& layout) {
  const std::size_t n = body.positions.size();
  const std::string start = fmt::format("body '{}': ", body.name);
  if (n == 0) throw DefinitionError(start + "it has no particle");
  if (!body.velocities.empty() && body.velocities.size() != n) {
    throw DefinitionError(fmt::format("{}{} velocities for {} particles", start, body.velocities.size(), n));
  }
  if (!(body.particle_volume > 0.0) || !std::isfinite(body.particle_volume)) {
    throw DefinitionError(fmt::format("{}particle volume {} must be positive", start, body.particle_volume));
  }
  ParticleSet set;
  set.name = body.name;
  set.mass = density * body.particle_volume;
  const int dim = layout.dim();
  for (int k = 0; k < dim; ++k) {
    set.half[k] = 0.5 / definition.method.particles_per_direction;
    // Pressed against a wall, a particle comes to rest only when its box is half beyond it.
    const int face = 2 * layout.axis(k);
    set.lowest[k] = definition.walls[face].kind == WallKind::none ? 0.0 : -set.half[k];
    set.highest[k] = layout.last_node(k) + (definition.walls[face + 1].kind == WallKind::none ? 0.0 : set.half[k]);
  }
  set.id.resize(n);
  set.x.assign(dim, std::vector<double>(n));
  set.v.assign(dim, std::vector<double>(n));
  for (std::size_t p = 0; p < n; ++p) {
    for (int k = 0; k < dim; ++k) {
      const int axis = layout.axis(k);
      set.x[k][p] = body.positions[p][axis];
      set.v[k][p] = body.velocities.empty() ? 0.0 : body.velocities[p][axis];
      const double cells = layout.in_cells(k, set.x[k][p]);
      if (!(cells >= 0.0 && cells <= layout.last_node(k)) || !std::isfinite(set.v[k][p])) {
        throw DefinitionError(fmt::format("{}particle {} is outside the grid or not finite: {} = {} m, velocity {} m/s",
                                          start, p, "xyz"[axis], set.x[k][p], set.v[k][p]));
      }
    }
  }
  set.f.assign(dim == 3 ? Solid::kMatrix : PlaneStrain::kMatrix, std::vector<double>(n, 0.0));
  for (int k = 0; k < dim; ++k) std::fill(set.f[k * (dim + 1)].begin(), set.f[k * (dim + 1)].end(), 1.0);
  set.tau.assign(dim == 3 ? Solid::kSymmetric : PlaneStrain::kSymmetric, std::vector<double>(n, 0.0));
  set.history.assign(history_size(law), std::vector<double>(n, 0.0));
  if (definition.method.update == UpdateScheme::usavg) set.next_x.assign(dim, std::vector<double>(n));
  return set;
}

void check(const SimulationDefinition& d) {
  if (d.time.sync <= 0) throw DefinitionError("time.sync must be a positive number of nanoseconds");
  if (!(d.time.cfl > 0.0 && d.time.cfl < 1.0)) {
    throw DefinitionError(fmt::format("time.cfl is {}, must lie between 0 and 1", d.time.cfl));
  }
  if (d.time.step && !(*d.time.step > 0.0)) {
    throw DefinitionError(fmt::format("time.step is {}, must be positive", *d.time.step));
  }
  if (d.method.gradient_terms < 1) throw DefinitionError("method.gradient_terms must be at least 1");
  if (!(d.method.flip >= 0.0 && d.method.flip <= 1.0)) {
    throw DefinitionError(fmt::format("FLIP fraction {} must lie in [0, 1]", d.method.flip));
  }
  if (!(d.method.damping >= 0.0) || !std::isfinite(d.method.damping)) {
    throw DefinitionError(fmt::format("method.damping is {}, must be finite and not negative", d.method.damping));
  }
  if (d.method.particles_per_direction < 1) throw DefinitionError("at least one particle along a cell's edge");
  if (d.geometry != GeometryKind::solid && !(d.thickness > 0.0)) throw DefinitionError("thickness must be positive");
  if (!d.gravity.allFinite()) throw DefinitionError("gravity is not finite");
}

// What a planar scene keeps of a pose: the plane's position, and of the rotation its part about y (swing and twist), so
// that zeros stay exact zeros.
Pose planar(const Pose& pose, const std::string& body) {
  const Quat& q = pose.orientation;
  const double about_y = std::hypot(q.w(), q.y());
  if (!(about_y >= 1e-3 * q.norm())) {
    throw RigidError(
        fmt::format("rigid body '{}': its pose is turned over in a planar scene; turn it about y only", body));
  }
  const double scale = q.norm() / about_y;
  return {{pose.position.x(), 0.0, pose.position.z()}, Quat(q.w() * scale, 0.0, q.y() * scale, 0.0)};
}

void make_planar(SimulationDefinition& definition) {
  definition.gravity.y() = 0.0;
  for (RigidBodyDefinition& body : definition.rigid_bodies) {
    body.pose = planar(body.pose, body.name);
    body.velocity[1] = body.rotation_rate[0] = body.rotation_rate[2] = Function();
  }
}

}  // namespace

Simulation::Simulation(const SimulationDefinition& definition, SimulationOptions options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  check(definition);
  s.definition = definition;
  std::size_t count = 0;
  for (const DeformableBody& body : definition.bodies) count += body.positions.size();
  s.threads = options.threads > 0 ? options.threads
                                  : std::clamp(static_cast<int>(count / kParticlesPerThread), 1, omp_get_max_threads());
  const int dim = definition.geometry == GeometryKind::solid ? 3 : 2;
  if (dim == 2) make_planar(s.definition);
  s.grid = std::make_unique<Grid>(GridLayout(dim, definition.grid.cell, definition.grid.min, definition.grid.max));
  const GridLayout& layout = s.grid->layout;

  std::uint32_t next_id = 0;
  s.sets.reserve(definition.bodies.size());
  for (const DeformableBody& body : definition.bodies) {
    const MaterialDefinition& material = find_material(definition, body);
    s.laws.push_back(make_law(material));
    s.sets.push_back(make_set(definition, body, material.density, s.laws.back(), layout));
    ParticleSet& set = s.sets.back();
    set.first_id = next_id;
    for (std::uint32_t& id : set.id) id = next_id++;
    s.total_mass += set.mass * set.size();
  }
  if (s.sets.empty()) throw DefinitionError("there is no deformable body, so nothing to simulate; add one to 'bodies'");
  for (DeformableBody& body : s.definition.bodies) {
    body.positions = {};
    body.velocities = {};
  }

  if (definition.method.damping > 0.0) s.stages.push_back(std::make_unique<GridDamping>(definition.method.damping));
  s.bodies.reserve(definition.rigid_bodies.size());
  for (const RigidBodyDefinition& body : s.definition.rigid_bodies) {
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
  settings.gravity = s.definition.gravity;
  settings.threads = s.threads;
  s.mechanics = make_mechanics(dim, s.sets, s.laws, settings);
  double lightest = s.sets.front().mass;
  for (const ParticleSet& set : s.sets) lightest = std::min(lightest, set.mass);
  s.grid->least_mass = 1e-30 * lightest;
  s.sorter = std::make_unique<Sorter>(s.threads);
  s.gravity.name = "gravity";
  s.sort(0.0);
  s.material_limit = s.survey_material();
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

void Simulation::State::fail(const std::string& what, ParticleRef particle, double now,
                             const std::string& remedy) const {
  const ParticleSet& set = sets[particle.set];
  Vec3 position = Vec3::Zero();
  for (int k = 0; k < grid->layout.dim(); ++k) position[grid->layout.axis(k)] = set.x[k][particle.index];
  throw PhysicsError(fmt::format(
      "{}: particle {} of body '{}' after step {} (t = {:.6g} s) at ({:.6g}, {:.6g}, {:.6g}) m; {}", what,
      set.id[particle.index], set.name, steps.steps, now, position.x(), position.y(), position.z(), remedy));
}

void Simulation::State::sort(double now) {
  if (const auto outside = sorter->sort(sets, *grid)) {
    fail(
        "a particle is outside the domain or not finite", *outside, now,
        "enlarge grid.min/grid.max, close that face with a wall in 'boundaries', or lower time.cfl if the run blew up");
  }
}

void Simulation::State::step(double start, double dt) {
  for (RigidBody& body : bodies) body.begin_step(start, dt);
  StepContext context{*grid, dt};
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
  if (const auto particle = mechanics->failed()) {
    fail("the volume ratio J is not positive", *particle, start + dt,
         "lower time.cfl, use a finer grid.cell or slower tools, or stiffen what is crushed");
  }
  if (mechanics->needs_sort()) sort(start + dt);
}

void Simulation::State::run_period() {
  const StepLimit limit = step_limit();
  const double period = static_cast<double>(definition.time.sync) * kNanosecond;
  const double count = std::max(1.0, std::ceil(period / limit.dt - 1e-9));
  if (!(limit.dt > 0.0) || !(count <= kMostSteps)) {
    throw PhysicsError(
        fmt::format("the time step fell to {:.3g} s at t = {:.6g} s, limited by the {}: look for what "
                    "runs away, or lower time.sync when such steps are meant",
                    limit.dt, time * kNanosecond, limit.by));
  }
  const int number = static_cast<int>(count);
  const double start = static_cast<double>(time) * kNanosecond, dt = period / number;
  steps.limited_by = limit.dt > period ? "sync period" : limit.by;
  for (int k = 0; k < number; ++k) step(start + k * dt, dt);
  time += definition.time.sync;
  for (RigidBody& body : bodies) body.at_sync(time);

  // What accelerated or stiffened within the period was not known at its start: a wave may not have outrun a cell.
  material_limit = survey_material();
  if (!(dt * definition.time.cfl <= material_limit.dt)) {
    throw PhysicsError(
        fmt::format("the time step {:.3g} s was above the limit {:.3g} s that the {} set in the period "
                    "before t = {:.6g} s; lower time.sync, time.cfl or time.step",
                    dt, material_limit.dt / definition.time.cfl, material_limit.by, time * kNanosecond));
  }
}

void Simulation::advance() {
  State& s = *state_;
  if (s.failed) throw PhysicsError("the run has failed and cannot go on; start it again");
  const auto started = std::chrono::steady_clock::now();
  s.failed = true;  // until the period is done
  try {
    s.run_period();
  } catch (const FunctionError& error) {
    throw PhysicsError(fmt::format("motion of a rigid body at t = {:.6g} s: {}", s.time * kNanosecond, error.what()));
  }
  s.failed = false;
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
  const Pose applied = state_->grid->layout.dim() == 2 ? planar(target, state_->bodies.at(body).name()) : target;
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
