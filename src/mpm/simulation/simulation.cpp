#include "mpm/simulation/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "state.hpp"

namespace mpm {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kAtTool = 4.0;  ///< cells: what goes wrong nearer to a rigid body than this is told with its name

/// "0.4 cells from rigid body 'blade', ..." of the moving one nearest to a point; empty when none is within kAtTool
/// cells.
std::string tool_at(const std::vector<RigidBody>& bodies, const Vec3& point, double cell) {
  const RigidBody* nearest = nullptr;
  double least = kAtTool;
  for (const RigidBody& body : bodies) {
    if (body.twist().linear.isZero(0.0) && body.twist().angular.isZero(0.0)) continue;
    const double cells = body.surface().at(body.pose().to_body(point)).distance / cell;
    if (!(cells <= least)) continue;
    least = cells;
    nearest = &body;
  }
  if (nearest == nullptr) return {};
  return fmt::format("{} rigid body '{}', so look first at how it moves and how far it presses, or ",
                     least <= 0.0 ? "inside" : fmt::format("{:.2g} cells from", least), nearest->name());
}

}  // namespace

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const SimulationDefinition& Simulation::definition() const { return state_->definition; }
int Simulation::threads() const { return state_->threads; }
std::string Simulation::isa() const { return isa_name(state_->isa); }
std::vector<std::string> Simulation::warnings() const { return state_->warnings; }
std::vector<std::string> Simulation::notes() const { return state_->notes; }
std::int64_t Simulation::time() const { return state_->time; }
std::int64_t Simulation::sync_period() const { return state_->definition.time.sync; }

void Simulation::State::fail(const std::string& what, ParticleRef particle, double now,
                             const std::string& remedy) const {
  const ParticleSet& set = sets[particle.set];
  Vec3 position = Vec3::Zero();
  for (int k = 0; k < layout().dim(); ++k) position[layout().axis(k)] = set.x[k][particle.index];
  const std::string tool = position.allFinite() ? tool_at(bodies, position, layout().smallest_cell()) : std::string();
  throw PhysicsError(fmt::format(
      "{}: particle {} of body '{}' after step {} (t = {:.6g} s) at ({:.6g}, {:.6g}, {:.6g}) m; {}{}", what,
      set.id[particle.index], set.name, steps.steps, now, position.x(), position.y(), position.z(), tool, remedy));
}

void Simulation::State::sort(double now) {
  const std::vector<Module*>& list = modules.list();
  for (Module* module : list) module->before_sort();
  auto outside = sorter->sort(sets, fields);
  if (!outside) return;
  if (std::any_of(list.begin(), list.end(), [](Module* module) { return module->put_back(); })) {
    outside = sorter->sort(sets, fields);
    if (!outside) return;
  }
  for (const Module* module : list) {
    const auto fault = module->why_outside(layout(), sets[outside->set], outside->index);
    if (fault) fail(fault->what, *outside, now, fault->remedy);
  }
  fail("a particle is outside the domain or not finite", *outside, now,
       "enlarge grid.min/grid.max, close that face with a wall in 'boundaries', or lower time.cfl if the run blew up");
}

void Simulation::State::step(double start, double dt) {
  for (RigidBody& body : bodies) body.begin_step(start, dt);
  StepContext context{fields, dt, start};
  constexpr std::array kSchedules = {&step_usf, &step_usl, &step_usavg};  // in the order of UpdateScheme
  kSchedules[static_cast<int>(definition.method.update)](*mechanics, modules, context);
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
  const auto asks = [](const Module* module) { return module->needs_sort(); };
  const std::vector<Module*>& list = modules.list();
  if (mechanics->needs_sort() || std::any_of(list.begin(), list.end(), asks)) sort(start + dt);
}

void Simulation::State::run_period() {
  limit = step_limit();
  const double period = static_cast<double>(definition.time.sync) * kNanosecond;
  const double count = std::max(1.0, std::ceil(period / limit.dt - 1e-9));
  if (!(limit.dt > 0.0) || !(count <= kMostSteps)) {
    throw PhysicsError(
        fmt::format("the time step fell to {:.3g} s at t = {:.6g} s, limited by the {}: look for what "
                    "runs away, or lower time.sync when such steps are meant",
                    limit.dt, time * kNanosecond, limit.text()));
  }
  const int number = static_cast<int>(count);
  const double start = static_cast<double>(time) * kNanosecond, dt = period / number;
  for (int k = 0; k < number; ++k) {
    step(start + k * dt, dt);
    if (asked_to_stop && k + 1 < number && asked_to_stop()) {
      throw StoppedError(fmt::format("stopped within a sync period, {} of {} steps after t = {:.6g} s", k + 1, number,
                                     time * kNanosecond));
    }
  }
  time += definition.time.sync;
  for (Module* module : modules.list()) module->at_sync(time);

  // What accelerated or stiffened within the period was not known at its start: a wave may not have outrun a cell.
  previous_limit = material_limit;
  material_limit = survey_material();
  if (!(dt * definition.time.cfl <= material_limit.dt)) {
    throw PhysicsError(
        fmt::format("the time step {:.3g} s was above the limit {:.3g} s that the {} set in the period "
                    "before t = {:.6g} s; lower time.sync, time.cfl or time.step",
                    dt, material_limit.dt / definition.time.cfl, material_limit.text(), time * kNanosecond));
  }
}

void Simulation::advance() {
  State& s = *state_;
  if (s.failed) throw PhysicsError("the run has failed and cannot go on; start it again");
  const auto started = std::chrono::steady_clock::now();
  s.failed = true;  // until the period is done
  try {
    s.run_period();
  } catch (const ModuleError& error) {
    throw PhysicsError(error.what());
  } catch (const RigidError& error) {
    throw PhysicsError(fmt::format("{} (in the sync period from t = {:.6g} s)", error.what(), s.time * kNanosecond));
  } catch (const FunctionError& error) {
    throw PhysicsError(fmt::format("motion of a rigid body, or a law of contact, at t = {:.6g} s: {}",
                                   s.time * kNanosecond, error.what()));
  }
  s.failed = false;
  s.wall += std::chrono::steady_clock::now() - started;
  sample_metrics();
}

int Simulation::find_body(const std::string& name) const {
  for (std::size_t b = 0; b < state_->bodies.size(); ++b) {
    if (state_->bodies[b].name() == name) return static_cast<int>(b);
  }
  return -1;
}

void Simulation::command_velocity(int body, const Twist& twist) {
  state_->bodies.at(body).command_velocity(
      projected(twist, state_->definition.geometry, state_->bodies.at(body).definition()));
}

void Simulation::command_pose(int body, const Pose& target, std::int64_t arrival) {
  const Pose applied = projected(target, state_->definition.geometry, state_->bodies.at(body).definition());
  state_->bodies.at(body).command_pose(applied, state_->time, arrival);
}

void Simulation::apply_wrench(int body, const Wrench& wrench) {
  const GeometryKind geometry = state_->definition.geometry;
  Wrench kept = wrench;
  for (const int axis : axes_beside(geometry)) kept.force[axis] = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!turns_about(geometry, axis)) kept.torque[axis] = 0.0;
  }
  state_->bodies.at(body).apply_wrench(kept);
}

std::vector<FreeBodyReport> Simulation::free_bodies() const {
  std::vector<FreeBodyReport> list;
  for (const RigidBody& body : state_->bodies) {
    if (const FreeMotion* free = body.free_motion())
      list.push_back(free->report(body.name(), state_->definition.gravity));
  }
  return list;
}

std::vector<BodyState> Simulation::bodies() const {
  std::vector<BodyState> list;
  for (const RigidBody& body : state_->bodies) {
    const double mass = body.free_motion() != nullptr ? body.free_motion()->definition().mass : 0.0;
    list.push_back({body.name(), body.pose(), body.twist(), body.drive(), mass});
  }
  return list;
}

const RigidBody& Simulation::rigid_body(int body) const { return state_->bodies.at(body); }

ContactReport Simulation::take_contact(int body) {
  const RigidBody& of = state_->bodies.at(body);
  for (ContactReporter* reporter : state_->reporters) {
    ContactLedger* ledger = reporter->ledger_of(of);
    if (ledger != nullptr) return ledger->read(static_cast<double>(state_->time) * kNanosecond);
  }
  throw DefinitionError(fmt::format("rigid body '{}' has no contact with the material", of.name()));
}

std::vector<PairReport> Simulation::take_pairs() {
  std::vector<PairReport> reports;
  for (ContactReporter* reporter : state_->reporters) {
    reporter->read_pairs(static_cast<double>(state_->time) * kNanosecond, reports);
  }
  return reports;
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
