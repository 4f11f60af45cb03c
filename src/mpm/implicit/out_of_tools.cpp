#include "mpm/implicit/out_of_tools.hpp"

#include <algorithm>
#include <atomic>

#include "mpm/grid/each_share.hpp"

namespace mpm {

bool OutOfTools::put(std::vector<ParticleSet>& sets, Grid& grid, int threads) const {
  std::atomic<bool> far{false};
  for (const RigidBody* body : bodies_) {
    grid.shares.at_once("implicit: particles out of tools", threads, [&](int owner) {
      for (ParticleSet& set : sets) {
        if (put(*body, set, grid, owner)) far.store(true, std::memory_order_relaxed);
      }
    });
  }
  return far;
}

bool OutOfTools::put(const RigidBody& body, ParticleSet& set, Grid& grid, int owner) const {
  const int dim = layout_.dim(), place = grid.first_owner + owner;
  const std::array<int, 3>& block = grid.blocks.block(grid.blocks.owner_block(owner));
  const Box bounds = body.world_bounds();
  bool far = false;
  for (std::uint32_t p = set.begin[place]; p < set.begin[place + 1]; ++p) {
    double x[3] = {};
    for (int k = 0; k < dim; ++k) x[k] = set.x[k][p];
    if (!move_out(body, bounds, set, x)) continue;
    for (int k = 0; k < dim; ++k) {
      set.x[k][p] = x[k];
      const int node = GridLayout::nearest(layout_.in_cells(k, x[k])) - kBlockEdge * block[k];
      if (node < 0 || node >= kBlockEdge) grid.loose[owner] = 1;
      far = far || node < -1 || node > kBlockEdge;
    }
  }
  return far;
}

bool OutOfTools::put(const ParticleSet& set, double (&x)[3]) const {
  bool lay = false;
  for (const RigidBody* body : bodies_) lay = move_out(*body, body->world_bounds(), set, x) || lay;
  return lay;
}

bool OutOfTools::near(const Vec3& place, double half) const {
  const Vec3 to_face = Vec3::Constant(half);
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const RigidBody* body) {
    return body->world_bounds().intersects({place - to_face, place + to_face});
  });
}

bool OutOfTools::move_out(const RigidBody& body, const Box& bounds, const ParticleSet& set, double (&x)[3]) const {
  const int dim = layout_.dim();
  const Pose& pose = body.pose();
  Vec3 at = Vec3::Zero();
  bool inside = true;
  for (int k = 0; k < dim; ++k) {
    const int axis = layout_.axis(k);
    at[axis] = x[k];
    inside = inside && at[axis] > bounds.min[axis] && at[axis] < bounds.max[axis];
  }
  SurfacePoint point;
  if (!inside || !body.surface().within(pose.orientation.conjugate() * (at - pose.position), 0.0, point)) return false;
  const Vec3 out = pose.orientation * point.normal;
  for (int k = 0; k < dim; ++k) {
    const double moved = x[k] - point.distance * out[layout_.axis(k)], cells = layout_.in_cells(k, moved);
    if (cells > set.lowest[k] && cells < set.highest[k]) x[k] = moved;
  }
  return true;
}

}  // namespace mpm
