#include "mpm/contact/point_contact.hpp"

#include <algorithm>

namespace mpm {
namespace {

constexpr double kTouching = 1e-2;   ///< cells: a point this near counts to the area
constexpr double kWeakening = 1e-3;  ///< cells of sliding over which friction falls from that at rest
constexpr double kAtRest = 1e-6;     ///< cells: what slides by less in a step is at rest, and what is this near adheres
constexpr int kJointRounds = 8;      ///< solutions at most, after joints have begun to slide, stop or give way

Vec3 along_surface(const Vec3& velocity, const Vec3& normal) { return velocity - velocity.dot(normal) * normal; }

}  // namespace

PointContact::PointContact(std::vector<RigidBody*> bodies, const std::vector<ParticleSet>& sets, Fields& fields,
                           std::vector<ContactLaw> laws, const PointContactSettings& settings)
    : bodies_(std::move(bodies)),
      surfaces_(bodies_.begin(), bodies_.end()),
      sets_(sets),
      fields_(fields),
      heat_(settings.heat),
      laws_(std::move(laws)),
      laws_now_(laws_.size()),
      cell_(fields.front()->layout.smallest_cell()),
      with_pairs_(settings.with_pairs),
      gravity_(settings.gravity),
      search_(surfaces_, sets, fields, settings.geometry, settings.across, settings.threads, settings.ranks,
              settings.choice),
      solver_(fields, surfaces_, settings.geometry, settings.shape, settings.sharp_edges, settings.threads),
      free_(bodies_, settings.gravity, settings.meeting) {
  for (const RigidBody* body : bodies_) ledgers_.emplace_back(*body, axisymmetric(settings.geometry));
}

void PointContact::momentum_gathered(StepContext& context) {
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    laws_now_[i] = laws_[i].in_step(context.start, context.dt, [&] {
      return "'" + bodies_[i / sets_.size()]->name() + "' with '" + sets_[i % sets_.size()].name + "'";
    });
  }
  free_.find_meetings(context.dt);
  const std::vector<ContactPoint>& found = search_.find(context.dt);
  solver_.connect(found);
  contacts_.clear();
  if (solver_.points().empty()) return;
  solver_.load(&Grid::velocity);
  for (PointSolver::Point& point : solver_.points()) {
    const PointMemory::Entry* memory = memory_.find(found[point.found]);
    contacts_.push_back(recall(found[point.found], memory, point, context.dt));
    if (memory == nullptr || context.strain_at_start < 1.0) continue;
    const Contact& contact = contacts_.back();
    const double before = -0.5 * context.dt * memory->force.dot(contact.first.slip);  // by the end of that step
    ledgers_[contact.found->body].add_loss({0.0, before});
  }
}

PointContact::Contact PointContact::recall(const ContactPoint& found, const PointMemory::Entry* memory,
                                           PointSolver::Point& point, double dt) const {
  const FrictionLaw& law = laws_now_[found.law];
  Contact contact;
  contact.found = &found;
  // Keeps the overlap of what comes under a surface from beside it, or starts there.
  const double known = memory != nullptr && !point.at_edge ? memory->overlap : found.gap;
  contact.overlap = std::min(std::max(known, found.gap), 0.0);
  contact.gap = found.gap - contact.overlap;
  const Vec3 seen = solver_.velocity_at(point), carried = solver_.carried_at(point);
  contact.before = seen - point.velocity;
  if (memory != nullptr) contact.before += along_surface(memory->slip - contact.before, point.normal);
  contact.cut = seen - carried;
  contact.first.slip = carried - point.velocity;
  contact.gained = -carried - dt * gravity_;
  const bool held = memory != nullptr && memory->hold != Hold::free;
  if (held) {
    point.hold = memory->hold;
    contact.slid = memory->slid;
    contact.start = memory->force * dt;
    // The normal may have turned: what begins the sweeps pulls nowhere.
    if (!(law.adhesion > 0.0)) contact.start += std::max(-contact.start.dot(point.normal), 0.0) * point.normal;
  }
  point.motion = free_.motion(found.body);
  point.allowed = allowed_velocity(contact.gap, cell_, dt);
  point.adhesion = held || contact.gap <= kAtRest * cell_ ? law.adhesion * found.area * dt : 0.0;
  const double weakened = std::min(contact.slid / (kWeakening * cell_), 1.0);
  point.friction = law.at_rest() + weakened * (law.coefficient - law.at_rest());
  point.sticks = law.stick;
  return contact;
}

void PointContact::clear_impulses() {
  for (PointSolver::Point& point : solver_.points()) point.impulse.setZero();
}

void PointContact::before_strain(StepContext& context) {
  if (contacts_.empty()) return;
  solver_.load(&Grid::velocity);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const PointSolver::Point& point = solver_.points()[i];
    Contact& contact = contacts_[i];
    (contact.acted ? contact.last : contact.first).slip = solver_.carried_at(point) - point.velocity;
  }
  clear_impulses();
  const bool free = free_.any();
  if (free) {
    free_.begin_trial();
    solver_.find_compliance_with_bodies();
  }
  solver_.solve(Pass::strain, free, free ? free_.begin_meeting() : nullptr);
  if (free) free_.end_trial();
  solver_.store(&Grid::velocity);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const PointSolver::Point& point = solver_.points()[i];
    Contact& contact = contacts_[i];
    End& end = contact.acted ? contact.last : contact.first;
    end.change = solver_.carried_at(point) - point.velocity - end.slip;
    end.impulse = point.impulse;
    if (!contact.acted) continue;
    ledgers_[contact.found->body].add_loss({0.0, lost(contact, end, 1.0 - context.strain_at_start)});
  }
}

double PointContact::lost(const Contact& contact, const End& end, double strain) {
  return strain * (contact.gained.dot(end.impulse) - contact.impulse.dot(end.change)) -
         0.5 * contact.impulse.dot(end.slip);
}

void PointContact::begin_impulses() {
  std::vector<PointSolver::Point>& points = solver_.points();
  for (std::size_t i = 0; i < points.size(); ++i) points[i].impulse = contacts_[i].start;
}

void PointContact::forces_gathered(StepContext& context) {
  if (!with_pairs_) return;
  begin_impulses();
  solver_.add_impulses(&Grid::force, 1.0 / context.dt);
}

void PointContact::momentum_updated(StepContext& context) {
  memory_.clear();
  const bool free = free_.any();
  BodyContact* meeting = nullptr;
  if (free) {
    free_.predict(context.dt);
    solver_.find_compliance_with_bodies();
    meeting = free_.begin_meeting();
  }
  std::vector<PointSolver::Point>& points = solver_.points();
  if (!contacts_.empty() || meeting != nullptr) {
    solver_.load(&Grid::velocity);
    begin_impulses();
    if (with_pairs_) {
      solver_.push_bodies();  // the nodes have them already
    } else {
      solver_.push_all();
    }
    solver_.solve(Pass::step, free, meeting);
    for (int round = 0; free && round < kJointRounds && free_.settle(); ++round) {
      solver_.find_compliance_with_bodies();
      solver_.solve(Pass::step, free, free_.same_meeting());
    }
    solver_.store(&Grid::velocity);
    solver_.store(&Grid::force, 1.0 / context.dt);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    PointSolver::Point& point = points[i];
    Contact& contact = contacts_[i];
    // Counts the work of an impulse on a free body with the mean velocity, as that on the material.
    const Vec3 mean = point.motion != nullptr ? point.motion->mean_velocity_at(point.place) : point.velocity;
    if (point.motion != nullptr) point.velocity = point.motion->velocity_at(point.place);
    const Vec3 seen = solver_.velocity_at(point), carried = solver_.carried_at(point);
    const Vec3 slip = seen - point.velocity;
    const Vec3 mean_slip = 0.5 * (contact.before + slip);
    give(i, mean, mean_slip);
    const double cut = point.impulse.dot(0.5 * (contact.cut + seen - carried));
    cut_ += cut;
    contact.impulse = point.impulse;
    contact.gained += carried;
    contact.acted = true;
    const double held = lost(contact, contact.first, context.strain_at_start);
    // As the ledger counts it: the impulse along the surface.
    const double friction = -along_surface(point.impulse, point.normal).dot(mean_slip);
    ledgers_[contact.found->body].add_loss({0.0, held - friction - cut});
    if (heat_ != nullptr && (point.hold != Hold::free || contact.gap <= kTouching * cell_)) {
      heat_->touch(*bodies_[contact.found->body], solver_.nodes_of(*contact.found), point.place, contact.found->area,
                   friction, context.dt);
    }
    const Vec3 along = along_surface(slip, point.normal);
    // Material that has come to rest has friction at rest again.
    const double slid = along.norm() * context.dt;
    contact.slid = slid < kAtRest * cell_ ? 0.0 : contact.slid + slid;
    memory_.add({PointMemory::id_of(*contact.found), point.impulse / context.dt, along, contact.slid, contact.overlap,
                 point.hold});
  }
  memory_.close();
  if (meeting != nullptr) free_.take_meetings(true);
  if (free) free_.finish();
}

void PointContact::velocity_found(StepContext&) {
  if (contacts_.empty()) return;
  solver_.load(&Grid::increment);
  clear_impulses();
  solver_.solve(Pass::held, false);
  solver_.store(&Grid::increment);
}

void PointContact::increment_found(StepContext&) {
  if (contacts_.empty()) return;
  const bool free = free_.any();
  solver_.load(&Grid::increment);
  clear_impulses();
  BodyContact* meeting = nullptr;
  if (free) {
    free_.begin_increment();
    meeting = free_.begin_meeting();
  }
  solver_.solve(Pass::increment, free, meeting);
  solver_.store(&Grid::increment);
  if (free) free_.end_increment();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    PointSolver::Point& point = solver_.points()[i];
    if (point.motion != nullptr) point.velocity = point.motion->velocity_at(point.place);
    give(i, point.velocity, Vec3::Zero());
  }
  if (meeting != nullptr) free_.take_meetings(false);
  if (free) free_.finish();
  // The work of the increments' impulses at edges is done at the velocities of the step.
  solver_.load(&Grid::velocity);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const PointSolver::Point& point = solver_.points()[i];
    cut_ += point.impulse.dot(0.5 * (contacts_[i].cut + solver_.velocity_at(point) - solver_.carried_at(point)));
  }
}

void PointContact::give(std::size_t i, const Vec3& velocity, const Vec3& mean_slip) {
  const PointSolver::Point& point = solver_.points()[i];
  const int body = contacts_[i].found->body;
  ledgers_[body].give({point.impulse, point.normal, point.place - bodies_[body]->pose().position, velocity, mean_slip});
  free_.take(body, point.impulse, point.place, point.normal, mean_slip);
}

void PointContact::grid_advanced(StepContext& context) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    int held = 0;
    double area = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const Contact& contact = contacts_[i];
      if (contact.found->body != static_cast<int>(b)) continue;
      const bool holds = solver_.points()[i].hold != Hold::free;
      if (holds) ++held;
      if (holds || contact.gap <= kTouching * cell_) area += contact.found->area;
    }
    ledgers_[b].end_step(context.dt, held, area);
  }
}

void PointContact::accounts(std::vector<ImpulseAccount>& list) const {
  for (const ContactLedger& ledger : ledgers_) list.push_back(ledger.account());
}

void PointContact::energies(EnergyReport& report) const {
  for (const ContactLedger& ledger : ledgers_) ledger.energies(report);
  report.add("cutting", NamedEnergy::Kind::dissipated, cut_);
  free_.energies(report);
}

ContactLedger* PointContact::ledger_of(const RigidBody& body) {
  const auto own = [&](const ContactLedger& ledger) { return &ledger.body() == &body; };
  const auto found = std::find_if(ledgers_.begin(), ledgers_.end(), own);
  return found == ledgers_.end() ? nullptr : &*found;
}

void PointContact::body_put(const RigidBody& body) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b] == &body) memory_.forget(static_cast<int>(b));
  }
}

void PointContact::serialise(StateArchive& archive) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const StateArchive::Group group(archive, "body_" + std::to_string(b));
    ledgers_[b].serialise(archive);
  }
  memory_.serialise(archive);
  free_.serialise(archive);
  archive.value("cut", cut_);
}

}  // namespace mpm
