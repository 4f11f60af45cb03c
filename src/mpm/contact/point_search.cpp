// Where the material's surface is near a body: the search of PointContact, a block of particles at a time.
#include <algorithm>
#include <cmath>

#include "mpm/contact/particle_reach.hpp"
#include "mpm/contact/point_contact.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr double kBeyondBlock = 1.5;  ///< nodes that a particle may be beyond its block, and a half
constexpr double kWatched = 0.1;      ///< cells: a point this near is held if it comes nearer in this step

// 1 where the nearest place of the body is a sharp edge or corner, 0 over a face, between them on what is rounded: how
// much the normal turns along the surface, by a step to either side, over how much it turns about an edge. An edge
// divides what it meets, as a particle cannot: its centre decides on which side of an edge it is, and a blade does not
// press down what it has cut off.
double edge_part(const RigidBody& body, GeometryKind geometry, const Vec3& centre, const SurfacePoint& at,
                 double step) {
  if (!(at.distance > 0.0) || geometry == GeometryKind::line) return 0.0;
  const Vec3 place = body.pose().to_body(centre);
  const Vec3 across = dimensions(geometry) == 3 ? Vec3(at.normal.unitOrthogonal()) : Vec3(Vec3::UnitY());
  const auto turned = [&](const Vec3& along) {
    const double one = (body.surface().at(place + step * along).normal - at.normal).norm();
    return one == 0.0 ? 0.0 : std::min(one, (body.surface().at(place - step * along).normal - at.normal).norm());
  };
  double most = turned(across.cross(at.normal).normalized());
  if (dimensions(geometry) == 3) most = std::max(most, turned(across));
  return std::min(most * at.distance / step, 1.0);
}

}  // namespace

void PointContact::find_blocks(const GridLayout& layout, double band) {
  // A block's particles have not left it by more than a node.
  Vec3 half = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    half[layout.axis(k)] = (0.5 * (kBlockEdge - 1) + kBeyondBlock) * layout.cell(k);
  }
  const double reach = half.norm() + band;
  near_.clear();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const BlockTable& blocks = fields_[f]->blocks;
    for (int owner = 0; owner < blocks.owners(); ++owner) {
      const std::array<int, 3>& block = blocks.block(blocks.owner_block(owner));
      const Vec3 middle =
          0.5 * (layout.node_position(block, 0) + layout.node_position(block, layout.nodes_per_block() - 1));
      const bool near = std::any_of(bodies_.begin(), bodies_.end(), [&](const RigidBody* body) {
        SurfacePoint point;
        return body->surface().within(body->pose().to_body(middle), reach, point);
      });
      if (near) near_.push_back({static_cast<int>(f), owner});
    }
  }
}

template <class Geometry>
void PointContact::find_points_in(const StepContext& context) {
  const GridLayout& layout = context.layout();
  const double watched = kWatched * layout.smallest_cell();
  // From a particle's centre, which may be stretched to three times its box; in a step neither material nor tool moves
  // by more than a cell.
  double band = 0.0;
  for (const ParticleSet& set : sets_) {
    for (int k = 0; k < layout.dim(); ++k) band = std::max(band, 3.0 * set.half[k] * layout.cell(k));
  }
  band += layout.smallest_cell();
  find_blocks(layout, band);
  while (of_block_.size() < near_.size()) of_block_.emplace_back();
  const int count = static_cast<int>(near_.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(settings_.threads)
  for (int i = 0; i < count; ++i) {
    of_block_[i].clear();
    const int owner = fields_[near_[i].field]->first_owner + near_[i].owner;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const ParticleSet& set = sets_[s];
      const int end = static_cast<int>(set.group[set.group_begin[owner + 1]]);
      for (int p = static_cast<int>(set.group[set.group_begin[owner]]); p < end; ++p) {
        Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
        for (int k = 0; k < layout.dim(); ++k) {
          centre[layout.axis(k)] = set.x[k][p];
          velocity[layout.axis(k)] = set.v[k][p];
        }
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
          const RigidBody& body = *bodies_[b];
          SurfacePoint surface;
          if (!body.surface().within(body.pose().to_body(centre), band, surface)) continue;
          Point point;
          point.normal = body.pose().orientation * surface.normal;
          double reach = particle_reach<Geometry>(set, layout, p, point.normal);
          const double closing = (body.velocity_at(centre) - velocity).dot(point.normal) * context.dt;
          const double seen_from = watched + std::max(closing, 0.0);
          if (surface.distance - reach > seen_from) continue;
          const double half_width = reach;
          reach *= 1.0 - edge_part(body, settings_.geometry, centre, surface, 0.5 * reach);
          point.gap = surface.distance - reach;
          if (point.gap > seen_from) continue;
          point.place = centre - reach * point.normal;
          point.velocity = body.velocity_at(point.place);
          point.body = static_cast<int>(b);
          point.field = near_[i].field;
          point.law = static_cast<int>(b * sets_.size() + s);
          point.particle = set.id[p];
          double volume = stretch_of_section<Geometry>(set, p) * settings_.across;
          for (int k = 0; k < layout.dim(); ++k) volume *= 2.0 * set.half[k] * layout.cell(k);
          if (axisymmetric(settings_.geometry)) volume *= kTurn * centre.x();
          point.area = volume / (2.0 * half_width);
          of_block_[i].push_back(point);
        }
      }
    }
  }
}

void PointContact::find_points(const StepContext& context) {
  with_geometry(settings_.geometry, [&](auto kind) { find_points_in<decltype(kind)>(context); });
}

}  // namespace mpm
