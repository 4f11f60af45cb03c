#include "mpm/contact/body_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/touch_points.hpp"

namespace mpm {
namespace {

constexpr double kNear = 1e-2;         ///< cells: the least distance within which a point may touch in a step
constexpr double kLookDepth = 1e-3;    ///< part of the body's size
constexpr double kMostOverlap = 0.01;  ///< at the start, part of the smaller body's size

bool meets(const RigidBody& one, const RigidBody& two) {
  const auto excepts = [](const RigidBody& body, const RigidBody& other) {
    const auto& names = body.definition().collide->except;
    return std::find(names.begin(), names.end(), other.name()) != names.end();
  };
  return one.definition().collide && two.definition().collide && !excepts(one, two) && !excepts(two, one);
}

/// Box of a body's bounds in the frame of another pose, or without end.
Box box_around(const RigidBody& body, const Pose& frame) {
  const Box bounds = body.surface().bounds();
  Box box;
  if (!bounds.min.allFinite() || !bounds.max.allFinite()) {
    return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) != 0 ? bounds.max.x() : bounds.min.x(),
                  (corner & 2) != 0 ? bounds.max.y() : bounds.min.y(),
                  (corner & 4) != 0 ? bounds.max.z() : bounds.min.z());
    box.add(frame.to_body(body.pose().to_world(at)));
  }
  return box;
}

bool can_move(const RigidBody& body) { return body.free_motion() != nullptr || body.link_motion() != nullptr; }

}  // namespace

BodyContact::BodyContact(const std::vector<RigidBody*>& bodies, const BodyContactSettings& settings)
    : bodies_(bodies), settings_(settings), touching_(bodies.size()) {
  const int count = static_cast<int>(bodies_.size());
  for (int b = 0; b < count; ++b) {
    const RigidBody& body = *bodies_[b];
    if (!body.definition().collide) continue;
    Body& own = touching_[b];
    own.points = touch_points(body.surface(), planar(settings_.geometry));
    Box box;
    std::stable_sort(own.points.begin(), own.points.end(),
                     [](const TouchPoint& a, const TouchPoint& b) { return a.place.x() < b.place.x(); });
    for (const TouchPoint& point : own.points) {
      own.largest = std::max(own.largest, point.radius);
      own.reach = std::max(own.reach, point.place.norm() + point.radius);
      box.add(point.place - Vec3::Constant(point.radius));
      box.add(point.place + Vec3::Constant(point.radius));
    }
    if (!own.points.empty()) own.size = box.size().norm();
    const double friction = body.definition().collide->friction;
    for (int other = 0; other < b; ++other) {
      if (!meets(body, *bodies_[other]) || !(can_move(body) || can_move(*bodies_[other]))) continue;
      pairs_.push_back({b, other, std::min(friction, bodies_[other]->definition().collide->friction)});
    }
    if (!can_move(body)) continue;
    for (std::size_t w = 0; w < settings_.walls.size(); ++w) {
      pairs_.push_back(
          {b, -1 - static_cast<int>(w), std::min(friction, settings_.walls[w].friction.value_or(friction))});
    }
  }
  check_overlaps();
}

template <class Found>
void BodyContact::look(int body, int other, double margin, Found&& found) const {
  const Pose& pose = bodies_[body]->pose();
  if (other < 0) {
    const BodyWall& wall = settings_.walls[-1 - other];
    if (pose.position.dot(wall.normal) - wall.place > touching_[body].reach + margin) return;
    for (const TouchPoint& point : touching_[body].points) {
      const Vec3 place = pose.to_world(point.place);
      const double gap = place.dot(wall.normal) - wall.place - point.radius;
      if (gap <= margin) found(Vec3(place - point.radius * wall.normal), gap, wall.normal);
    }
    return;
  }
  const RigidBody& met = *bodies_[other];
  if (!bodies_[body]->world_bounds().grown(margin).intersects(met.world_bounds())) return;
  const Quat back = met.pose().orientation.conjugate();
  const Mat3 turn = (back * pose.orientation).toRotationMatrix();
  const Vec3 shift = back * (pose.position - met.pose().position);
  // A corner looks from a little inside its body: where it lies on an edge of the other one, it then sees the face that
  // the body lies on.
  const double depth = kLookDepth * touching_[body].size;
  const Box near = box_around(met, pose).grown(margin + depth + touching_[body].largest);
  const auto& points = touching_[body].points;
  const auto first = std::lower_bound(points.begin(), points.end(), near.min.x(),
                                      [](const TouchPoint& point, double x) { return point.place.x() < x; });
  for (auto at_point = first; at_point != points.end() && at_point->place.x() <= near.max.x(); ++at_point) {
    const TouchPoint& point = *at_point;
    if (!near.contains(point.place)) continue;
    SurfacePoint at;
    const Vec3 inward = turn * (depth * point.inward);
    if (!met.surface().within(turn * point.place + shift + inward, margin + depth + point.radius, at)) continue;
    const double gap = at.distance - at.normal.dot(inward) - point.radius;
    if (gap > margin) continue;
    const Vec3 normal = met.pose().orientation * at.normal;
    found(Vec3(pose.to_world(point.place) - point.radius * normal), gap, normal);
  }
}

void BodyContact::check_overlaps(const RigidBody* with) const {
  for (const Pair& pair : pairs_) {
    if (with != nullptr && with != bodies_[pair.body] && (pair.other < 0 || with != bodies_[pair.other])) continue;
    double least = touching_[pair.body].size, deepest = 0.0;
    const auto note = [&](const Vec3&, double gap, const Vec3&) { deepest = std::min(deepest, gap); };
    look(pair.body, pair.other, 0.0, note);
    if (pair.other >= 0) {
      look(pair.other, pair.body, 0.0, note);
      const double size = touching_[pair.other].size;
      if (size > 0.0) least = least > 0.0 ? std::min(least, size) : size;
    }
    if (-deepest <= kMostOverlap * least) continue;
    const std::string other =
        pair.other < 0 ? "the wall " + settings_.walls[-1 - pair.other].name : "'" + bodies_[pair.other]->name() + "'";
    throw RigidError(fmt::format(
        "'{}' and {} overlap by {:.3g} m, and are to collide; put them apart{}", bodies_[pair.body]->name(), other,
        -deepest,
        pair.other < 0 ? ", or leave collide out" : ", or name one in collide: {except: [...]} of the other"));
  }
}

double BodyContact::speed(int body) const {
  const Twist& twist = bodies_[body]->twist();
  return twist.linear.norm() + twist.angular.norm() * touching_[body].reach;
}

// Speeds of all bodies count: one that is hit in this step may be as fast as the one that hits it.
double BodyContact::margin(double dt) const {
  double fastest = 0.0, gained = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b]->definition().collide) continue;
    fastest = std::max(fastest, speed(static_cast<int>(b)));
    gained = std::max(gained, bodies_[b]->motion().unprescribed_acceleration(settings_.gravity));
  }
  return std::max(kNear * settings_.cell, 2.0 * dt * (fastest + dt * gained));
}

void BodyContact::find(double dt) {
  rows_.clear();
  const double near = margin(dt);
  for (const Pair& pair : pairs_) find(pair, near, dt);
}

void BodyContact::find(const Pair& pair, double margin, double dt) {
  const bool moved = bodies_[pair.body]->dynamic_motion() != nullptr ||
                     (pair.other >= 0 && bodies_[pair.other]->dynamic_motion() != nullptr);
  if (!moved) return;
  look(pair.body, pair.other, margin, [&](const Vec3& place, double gap, const Vec3& normal) {
    add(pair.body, pair.other, place, gap, normal, pair.friction, dt);
  });
  if (pair.other < 0) return;
  look(pair.other, pair.body, margin, [&](const Vec3& place, double gap, const Vec3& normal) {
    add(pair.other, pair.body, place, gap, normal, pair.friction, dt);
  });
}

void BodyContact::add(int body, int other, const Vec3& place, double gap, const Vec3& normal, double friction,
                      double dt) {
  Row row;
  row.body = body;
  row.other = other;
  row.place = place;
  row.normal = normal;
  row.friction = friction;
  row.allowed = allowed_velocity(gap, settings_.cell, dt);
  row.motion = bodies_[body]->dynamic_motion();
  row.velocity = row.motion == nullptr ? bodies_[body]->velocity_at(place) : Vec3(Vec3::Zero());
  if (other >= 0) {
    row.other_motion = bodies_[other]->dynamic_motion();
    if (row.other_motion == nullptr) row.velocity -= bodies_[other]->velocity_at(place);
  }
  rows_.push_back(row);
}

void BodyContact::begin() {
  for (Row& row : rows_) row.impulse.setZero();
  find_compliance();
}

void BodyContact::find_compliance() {
  for (Row& row : rows_) {
    Mat3 lift = Mat3::Zero();
    if (row.motion != nullptr) lift += row.motion->compliance_at(row.place);
    if (row.other_motion != nullptr) lift += row.other_motion->compliance_at(row.place);
    if (row.motion != nullptr && row.other_motion != nullptr) {
      const LinkMotion *link = bodies_[row.body]->link_motion(), *other = bodies_[row.other]->link_motion();
      if (link != nullptr && other != nullptr && &link->robot() == &other->robot()) {
        lift -= link->compliance_by(*other, row.place) + other->compliance_by(*link, row.place);
      }
    }
    const double across = row.normal.dot(lift * row.normal);
    row.with_body[0] = across;
    row.with_body[1] = lift.trace() - across;  // the sum of the two principal values
  }
}

Vec3 BodyContact::slip(const Row& row, bool with_prescribed) const {
  Vec3 slip = with_prescribed ? row.velocity : Vec3(Vec3::Zero());
  if (row.motion != nullptr) slip += row.motion->velocity_at(row.place);
  if (row.other_motion != nullptr) slip -= row.other_motion->velocity_at(row.place);
  return slip;
}

double BodyContact::loss_of(const Row& row) const {
  Vec3 mean = row.velocity;
  if (row.motion != nullptr) mean += row.motion->mean_velocity_at(row.place);
  if (row.other_motion != nullptr) mean -= row.other_motion->mean_velocity_at(row.place);
  return -row.impulse.dot(mean);
}

template <ContactPass Kind>
double BodyContact::relax(Row& row) {
  if (Kind == ContactPass::increment && !is_bound<Kind>(row)) return 0.0;
  // Joints that do not give way, or axes that are not free: no impulse changes anything.
  if (!(row.with_body[0] > 0.0)) return 0.0;
  const double along = std::max(row.with_body[1], row.with_body[0] * 1e-12);
  const Vec3 impulse = next_impulse<Kind>(row, slip(row, Kind != ContactPass::increment), row.with_body[0], along);
  const Vec3 change = impulse - row.impulse;
  if (change.isZero(0.0)) return 0.0;
  row.impulse = impulse;
  if (row.motion != nullptr) row.motion->push(change, row.place);
  if (row.other_motion != nullptr) row.other_motion->push(-change, row.place);
  return change.norm() * row.with_body[0];
}

SweepProgress BodyContact::sweep(ContactPass pass, bool back) {
  conjugate_->begin(rows_);
  SweepProgress progress;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[back ? rows_.size() - 1 - i : i];
    const double moved = pass == ContactPass::step     ? relax<ContactPass::step>(row)
                         : pass == ContactPass::strain ? relax<ContactPass::strain>(row)
                                                       : relax<ContactPass::increment>(row);
    progress.largest = std::max(progress.largest, moved);
    progress.scale = std::max(progress.scale, row.impulse.norm() * row.with_body[0]);
  }
  return progress;
}

void BodyContact::go_on(double change_of_all) {
  conjugate_->go_on(rows_, change_of_all, [](Row& row, const Vec3& more) {
    row.impulse += more;
    if (row.motion != nullptr) row.motion->push(more, row.place);
    if (row.other_motion != nullptr) row.other_motion->push(-more, row.place);
  });
}

}  // namespace mpm
