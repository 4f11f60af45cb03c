#include "contact_on_host.hpp"

#include <algorithm>
#include <utility>

#include "mpm/contact/point_search.hpp"

namespace mpm {
namespace {

/// A set of the same body without particles, which has what contact reads.
ParticleSet without_particles(const ParticleSet& set) {
  ParticleSet empty;
  empty.name = set.name;
  empty.mass = set.mass;
  empty.half = set.half;
  empty.lowest = set.lowest;
  empty.highest = set.highest;
  empty.first_id = set.first_id;
  empty.field = empty.far_field = set.field;
  empty.precision = set.precision;
  empty.x.resize(set.x.size());
  empty.v.assign(set.v.size(), ParticleScalar(set.precision));
  empty.f.assign(set.f.size(), ParticleScalar(set.precision));
  empty.surface.assign(set.surface.size(), ParticleScalar(set.precision));
  empty.history.assign(set.history.size(), ParticleScalar(set.precision));
  return empty;
}

}  // namespace

ContactOnHost::ContactOnHost(const std::vector<RigidBody>& bodies, const Modules& modules, Fields fields,
                             const std::vector<ParticleSet>& sets)
    : bodies_(bodies), modules_(modules), fields_(std::move(fields)), context_{fields_, 0.0} {
  const GridLayout& layout = fields_.front()->layout;
  reach_ = PointSearch::reach(sets, layout);
  for (const RigidBody& body : bodies) reach_ = std::max(reach_, (1.0 + body.reach()) * layout.smallest_cell());
  for (const ParticleSet& set : sets) sets_.push_back(without_particles(set));
}

void ContactOnHost::begin_step(const StepContext& context) {
  context_.dt = context.dt;
  context_.start = context.start;
  context_.strain_at_start = context.strain_at_start;
  bounds_.clear();
  for (const RigidBody& body : bodies_) bounds_.push_back(body.world_bounds().grown(reach_));
}

bool ContactOnHost::near(const Vec3& place, double radius) const {
  const Vec3 half = Vec3::Constant(radius);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    SurfacePoint point;
    if (bounds_[b].intersects({place - half, place + half}) &&
        bodies_[b].surface().within(bodies_[b].pose().to_body(place), radius + reach_, point)) {
      return true;
    }
  }
  return false;
}

}  // namespace mpm
