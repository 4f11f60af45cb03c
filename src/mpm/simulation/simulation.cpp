#include "mpm/simulation/simulation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/volumes/volumes.hpp"
#include "state.hpp"

namespace mpm {
namespace {

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

/// Advice on what to change first if the method is one that is known to fail (doc/methods.md, doc/contact.md).
std::string known_to_fail(const SimulationDefinition& definition) {
  const ShapeTraits& shape = traits_of(definition.method.shape);
  std::string text;
  if (shape.shears()) {
    text += fmt::format(
        "take method.shape: ugimp where material is sheared far, since the corners of {}'s domains run "
        "apart there; or ",
        shape.name);
  }
  if (definition.contact.normals.method == NormalMethod::own) {
    text += "take contact.normals: average, since 'own' keeps neither momentum nor energy; or ";
  }
  return text;
}

BodyState state_of(const RigidBody& body) {
  const double mass = body.free_motion() != nullptr ? body.free_motion()->definition().mass : 0.0;
  return {body.name(), body.pose(), body.twist(), body.drive(), mass};
}

}  // namespace

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const SimulationDefinition& Simulation::definition() const { return state_->definition; }
int Simulation::threads() const { return state_->threads; }
Communicator* Simulation::ranks() const { return state_->ranks.get(); }
bool Simulation::on_any_rank(bool own) const { return any_of_all(state_->ranks.get(), own); }
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
  throw PhysicsError(
      fmt::format("{}: particle {} of body '{}' after step {} (t = {:.6g} s) at ({:.6g}, {:.6g}, {:.6g}) m; {}{}{}",
                  what, set.id[particle.index], set.name, steps.steps, now, position.x(), position.y(), position.z(),
                  tool, known_to_fail(definition), remedy));
}

std::optional<ParticleRef> Simulation::State::sort_particles() {
  if (!over) return sorter->sort(sets, fields);
  over->hand_over(sets, fields);
  auto outside = sorter->sort(sets, fields, &over->orders());
  if (outside) over->settle(sets, *outside);
  return outside;
}

void Simulation::State::check_together(const std::function<void()>& check) { agree<PhysicsError>(ranks.get(), check); }

void Simulation::State::sort_here(double now) {
  const std::vector<Module*>& list = modules.list();
  for (Module* module : list) module->before_sort();
  const auto anywhere = [this](bool own) { return any_of_all(ranks.get(), own); };
  auto outside = sort_particles();
  if (anywhere(outside.has_value())) {
    bool back = false;
    for (Module* module : list) back = ((outside || over) && module->put_back()) || back;
    if (!anywhere(outside && !back)) outside = sort_particles();
    check_together([&] {
      if (!outside) return;
      for (const Module* module : list) {
        const auto fault = module->why_outside(layout(), sets[outside->set], outside->index);
        if (fault) fail(fault->what, *outside, now, fault->remedy);
      }
      fail("a particle is outside the domain or not finite", *outside, now,
           fmt::format("enlarge grid.min/grid.max, close that face with a wall in 'boundaries', or lower {} if the run "
                       "blew up",
                       definition.method.update == UpdateScheme::implicit ? "time.step" : "time.cfl"));
    });
  }
  if (!over) return;
  over->meet(fields);
  if (choice) choice->find_places();
  for (Module* module : list) module->share_memory(*ranks);
}

void Simulation::State::meet_again() {
  for (auto& grid : fields) {
    std::vector<std::uint64_t> owners;
    std::vector<std::uint32_t> particles;
    for (int owner = 0; owner < grid->blocks.owners(); ++owner) {
      owners.push_back(grid->blocks.key(grid->blocks.owner_block(owner)));
      particles.push_back(0);
      for (const ParticleSet& set : sets) {
        const auto begin = set.begin.begin() + grid->first_owner + owner;
        particles.back() += begin[1] - begin[0];
      }
    }
    const std::vector<std::uint8_t> loose = std::move(grid->loose);
    grid->rebuild(owners, threads, particles);  // without the blocks that others gave to
    grid->loose = loose;
  }
  mechanics->blocks_renewed();
  over->meet(fields);
  if (choice) choice->find_places();
  for (Module* module : modules.list()) module->share_memory(*ranks);
}

std::vector<VolumeReport> Simulation::volumes() const {
  for (const Module* module : state_->modules.list()) {
    if (const auto* volumes = dynamic_cast<const Volumes*>(module)) return volumes->reports();
  }
  return {};
}

const SweepBudget* Simulation::budget() const { return state_->services.budget.get(); }

void Simulation::repeat_cuts(const std::vector<CutStep>& steps) {
  if (SweepBudget* budget = state_->services.budget.get()) budget->repeat(steps);
}

int Simulation::find_body(const std::string& name) const {
  for (std::size_t b = 0; b < state_->bodies.size(); ++b) {
    if (state_->bodies[b].name() == name) return static_cast<int>(b);
  }
  return -1;
}

int Simulation::find_commanded(const std::string& name) const {
  const std::vector<BodyState> all = commanded();
  const auto found = std::find_if(all.begin(), all.end(), [&](const BodyState& one) { return one.name == name; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

RigidBody& Simulation::State::commanded(int index) {
  auto place = static_cast<std::size_t>(index);
  if (place < bodies.size()) return bodies[place];
  place -= bodies.size();
  for (const auto& robot : robots) {
    RigidBody* base = robot->base_motion();
    if (base != nullptr && place-- == 0) return *base;
  }
  throw std::out_of_range("no rigid body and no base of a robot has this index");
}

void Simulation::command_velocity(int body, const Twist& twist) {
  RigidBody& of = state_->commanded(body);
  of.command_velocity(projected(twist, state_->definition.geometry, of.definition()));
}

void Simulation::command_pose(int body, const Pose& target, std::int64_t arrival) {
  RigidBody& of = state_->commanded(body);
  of.command_pose(projected(target, state_->definition.geometry, of.definition()), state_->time, arrival);
}

void Simulation::apply_wrench(int body, const Wrench& wrench) {
  const GeometryKind geometry = state_->definition.geometry;
  Wrench kept = wrench;
  for (const int axis : axes_beside(geometry)) kept.force[axis] = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!turns_about(geometry, axis)) kept.torque[axis] = 0.0;
  }
  state_->commanded(body).apply_wrench(kept);
}

std::vector<FreeBodyReport> Simulation::free_bodies() const {
  std::vector<FreeBodyReport> list;
  for (const RigidBody& body : state_->bodies) {
    if (const FreeMotion* free = body.free_motion())
      list.push_back(free->report(body.name(), state_->definition.gravity));
  }
  return list;
}

std::vector<RobotReport> Simulation::robots() const {
  std::vector<RobotReport> list;
  for (const auto& robot : state_->robots) list.push_back(robot->report());
  return list;
}

int Simulation::find_robot(const std::string& name) const {
  for (std::size_t r = 0; r < state_->robots.size(); ++r) {
    if (state_->robots[r]->name() == name) return static_cast<int>(r);
  }
  return -1;
}

int Simulation::find_joint(int robot, const std::string& joint) const {
  return state_->robots.at(robot)->find_joint(joint);
}

void Simulation::command_joints(int robot, const std::vector<int>& joints, const std::vector<double>& values,
                                std::int64_t arrival) {
  const State& s = *state_;
  Robot& of = *s.robots.at(robot);
  const std::int64_t end = std::max(arrival, s.time + s.definition.time.sync);
  for (std::size_t k = 0; k < joints.size(); ++k) of.check_command(joints[k], values[k]);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    of.command(joints[k], values[k], seconds_of(s.time), seconds_of(end));
  }
}

void Simulation::follow_trajectory(int robot, const std::vector<int>& joints,
                                   std::vector<std::vector<JointKnot>> knots) {
  Robot& of = *state_->robots.at(robot);
  const double now = seconds_of(state_->time);
  for (std::size_t k = 0; k < joints.size(); ++k) of.check_trajectory(joints[k], knots[k], now);
  for (std::size_t k = 0; k < joints.size(); ++k) of.follow(joints[k], std::move(knots[k]), now);
}

std::vector<BodyState> Simulation::bodies() const {
  std::vector<BodyState> list;
  for (const RigidBody& body : state_->bodies) list.push_back(state_of(body));
  return list;
}

std::vector<BodyState> Simulation::commanded() const {
  std::vector<BodyState> list = bodies();
  for (const auto& robot : state_->robots) {
    if (const RigidBody* base = robot->base_motion()) list.push_back(state_of(*base));
  }
  return list;
}

const RigidBody& Simulation::rigid_body(int body) const { return state_->commanded(body); }

ContactReport Simulation::take_contact(int body) {
  const RigidBody& of = state_->bodies.at(body);
  for (ContactReporter* reporter : state_->reporters) {
    ContactLedger* ledger = reporter->ledger_of(of);
    if (ledger != nullptr) return ledger->read(seconds_of(state_->time));
  }
  throw DefinitionError(fmt::format("rigid body '{}' has no contact with the material", of.name()));
}

std::vector<PairReport> Simulation::take_pairs() {
  std::vector<PairReport> reports;
  for (ContactReporter* reporter : state_->reporters) {
    reporter->read_pairs(seconds_of(state_->time), reports);
  }
  return reports;
}

std::uint64_t Simulation::particles() const {
  return std::accumulate(state_->sizes.begin(), state_->sizes.end(), std::uint64_t{0});
}

std::pair<std::uint64_t, std::uint64_t> Simulation::body_ids(const std::string& body) const {
  for (std::size_t s = 0; s < state_->sets.size(); ++s) {
    const ParticleSet& set = state_->sets[s];
    if (set.name == body) return {set.first_id, set.first_id + state_->sizes[s]};
  }
  throw DefinitionError(fmt::format("no deformable body is called '{}'", body));
}

}  // namespace mpm
