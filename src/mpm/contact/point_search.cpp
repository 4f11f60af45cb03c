#include "mpm/contact/point_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "mpm/contact/particle_reach.hpp"
#include "mpm/loop/loop.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr double kBeyondBlock = 1.5;  ///< nodes that a particle may be beyond its block, and a half
constexpr double kMostStretch = 3.0;  ///< times its box: farther a particle does not reach from its centre
constexpr double kWatched = 0.1;      ///< cells: a point this near is held if it comes nearer in this step
constexpr std::uint32_t kGroups = 8;  ///< groups of particles that are looked at together first
constexpr int kWorthALook = 4;        ///< particles, from which on a ball around them is asked about first

// 1 where the nearest place of the body is a sharp edge or corner, 0 over a face, between them on what is rounded: how
// much the normal turns along the surface, by a step to either side, over how much it turns about an edge. An edge
// divides what it meets, as a particle cannot: its centre decides on which side of an edge it is, and a blade does not
// press down what it has cut off.
double edge_part(const RigidBody& body, GeometryKind geometry, const Vec3& centre, const SurfacePoint& at,
                 double step) {
  if (!(at.distance > 0.0 && step > 0.0) || geometry == GeometryKind::line) return 0.0;
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

/// The farthest that a particle reaches from its centre [m].
double farthest_reach(const std::vector<ParticleSet>& sets, const GridLayout& layout) {
  double farthest = 0.0;
  for (const ParticleSet& set : sets) {
    const double most = kMostStretch * (set.surface.empty() ? 1.0 : kMostSurface);
    for (int k = 0; k < layout.dim(); ++k) farthest = std::max(farthest, most * set.half[k] * layout.cell(k));
  }
  return farthest;
}

/// A point as ranks send it.
struct SentPoint {
  std::uint64_t block;  ///< key of the one that the particle was sorted into
  std::int32_t body, field, law, chooser;
  std::uint32_t particle;
  std::array<double, 3> place, normal, velocity, centre;
  double gap, area;
};

std::array<double, 3> numbers_of(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }
Vec3 vector_of(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

SentPoint sent(const ContactPoint& point, std::uint64_t block) {
  return {block,
          point.body,
          point.field,
          point.law,
          point.chooser,
          point.particle,
          numbers_of(point.place),
          numbers_of(point.normal),
          numbers_of(point.velocity),
          numbers_of(point.centre),
          point.gap,
          point.area};
}

ContactPoint received(const SentPoint& sent) {
  return {sent.body,
          sent.field,
          sent.law,
          sent.particle,
          vector_of(sent.place),
          vector_of(sent.normal),
          vector_of(sent.velocity),
          vector_of(sent.centre),
          sent.chooser,
          sent.gap,
          sent.area};
}

}  // namespace

void PointSearch::find_jobs(double band) {
  const GridLayout& layout = fields_.front()->layout;
  // A block's particles have not left it by more than a node.
  Vec3 half = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    half[layout.axis(k)] = (0.5 * (kBlockEdge - 1) + kBeyondBlock) * layout.cell(k);
  }
  const double reach = half.norm() + band;
  jobs_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const RigidBody& body = *bodies_[b];
    const Box bounds = body.world_bounds().grown(band);
    const int kinds = static_cast<int>(fields_.size()) + (choice_ != nullptr ? 1 : 0);
    for (int f = 0; f < kinds; ++f) {
      const BlockTable& blocks = grid_of(f).blocks;
      for (int owner = 0; owner < blocks.owners(); ++owner) {
        const std::array<int, 3>& block = blocks.block(blocks.owner_block(owner));
        const Vec3 middle =
            0.5 * (layout.node_position(block, 0) + layout.node_position(block, layout.nodes_per_block() - 1));
        SurfacePoint point;
        if (!bounds.intersects({middle - half, middle + half}) ||
            !body.surface().within(body.pose().to_body(middle), reach, point)) {
          continue;
        }
        jobs_.push_back({f, owner, static_cast<int>(b)});
      }
    }
  }
}

bool PointSearch::near(const RigidBody& body, const ParticleSet& set, int begin, int end, double band) const {
  const GridLayout& layout = fields_.front()->layout;
  Vec3 middle = Vec3::Zero();
  double squared = 0.0;
  for (int k = 0; k < layout.dim(); ++k) {
    const double* x = set.x[k].data();
    double low = x[begin], high = x[begin];
    for (int p = begin + 1; p < end; ++p) {
      low = std::min(low, x[p]);
      high = std::max(high, x[p]);
    }
    middle[layout.axis(k)] = 0.5 * (low + high);
    squared += 0.25 * (high - low) * (high - low);
  }
  SurfacePoint point;
  // A little more than the ball, so that round-off leaves nothing out.
  return body.surface().within(body.pose().to_body(middle), 1.000001 * std::sqrt(squared) + band, point);
}

template <class Geometry>
void PointSearch::search(const Job& job, double dt, double farthest, std::vector<ContactPoint>& found) const {
  const GridLayout& layout = fields_.front()->layout;
  const double band =
      farthest + layout.smallest_cell();  // in a step neither material nor tool moves by more than a cell
  const double watched = kWatched * layout.smallest_cell();
  const RigidBody& body = *bodies_[job.body];
  const bool of_patch = job.field == static_cast<int>(fields_.size());
  const auto look_at = [&](std::size_t s, int p) {
    const ParticleSet& set = sets_[s];
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
    for (int k = 0; k < layout.dim(); ++k) centre[layout.axis(k)] = set.x[k][p];
    SurfacePoint surface;
    for (int k = 0; k < layout.dim(); ++k) velocity[layout.axis(k)] = set.v[k][p];
    const Vec3 approach = dt * (body.velocity_at(centre) - velocity);
    // Farther away nothing passes the tests that follow; a little more, so that round-off leaves nothing out.
    const double at_most = std::min(band, 1.000001 * (farthest + watched + approach.norm()));
    if (!body.surface().within(body.pose().to_body(centre), at_most, surface)) return;
    ContactPoint point;
    point.normal = body.pose().orientation * surface.normal;
    const double closing = approach.dot(point.normal);
    const double seen_from = watched + std::max(closing, 0.0);
    if (surface.distance - farthest > seen_from) return;
    const double box = particle_reach<Geometry>(set, layout, p, point.normal);
    const double half_width = set.surface.empty() ? box : box * set.surface[0][p];
    if (surface.distance - half_width > seen_from) return;
    const double reach = half_width * (1.0 - edge_part(body, geometry_, centre, surface, 0.5 * half_width));
    point.gap = surface.distance - reach;
    if (point.gap > seen_from) return;
    point.place = centre - reach * point.normal;
    point.velocity = body.velocity_at(point.place);
    point.body = job.body;
    point.field = of_patch ? set.field : job.field;
    point.centre = centre;
    point.chooser = of_patch ? static_cast<int>(s) : -1;
    point.law = static_cast<int>(job.body * sets_.size() + s);
    point.particle = set.id[p];
    double volume = stretch_of_section<Geometry>(set, p) * across_;
    for (int k = 0; k < layout.dim(); ++k) volume *= 2.0 * set.half[k] * layout.cell(k);
    if (axisymmetric(geometry_)) volume *= kTurn * centre.x();
    point.area = volume / (2.0 * box);
    found.push_back(point);
  };
  const int owner = grid_of(job.field).first_owner + job.owner;
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const ParticleSet& set = sets_[s];
    const auto clear = [&](std::uint32_t first, std::uint32_t last) {  // true if groups are out of reach
      const int begin = static_cast<int>(set.group[first]), end = static_cast<int>(set.group[last]);
      return end - begin >= kWorthALook && !near(body, set, begin, end, band);
    };
    const std::uint32_t last = set.group_begin[owner + 1];
    for (std::uint32_t first = set.group_begin[owner]; first < last; first += kGroups) {
      const std::uint32_t next = std::min(first + kGroups, last);
      if (clear(first, next)) continue;
      for (std::uint32_t g = first; g < next; ++g) {
        if (clear(g, g + 1)) continue;
        for (std::uint32_t p = set.group[g]; p < set.group[g + 1]; ++p) look_at(s, static_cast<int>(p));
      }
    }
  }
}

double PointSearch::reach(const std::vector<ParticleSet>& sets, const GridLayout& layout) {
  return farthest_reach(sets, layout) + layout.smallest_cell();
}

template <class Geometry>
void PointSearch::find_in(double dt) {
  const double farthest = farthest_reach(sets_, fields_.front()->layout);
  find_jobs(reach(sets_, fields_.front()->layout));
  while (of_job_.size() < jobs_.size()) of_job_.emplace_back();
  const int count = static_cast<int>(jobs_.size());
  for_unlike("contact: search of points", threads_, count, [&](int i) {
    of_job_[i].clear();
    search<Geometry>(jobs_[i], dt, farthest, of_job_[i]);
  });
  points_.clear();
  if (ranks_ != nullptr) return gather();
  for (int i = 0; i < count; ++i) points_.insert(points_.end(), of_job_[i].begin(), of_job_[i].end());
}

// A block's particles are on one rank and in the order of one process, so points are in its order, too.
void PointSearch::gather() {
  std::vector<SentPoint> own;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    const BlockTable& blocks = grid_of(jobs_[i].field).blocks;
    const std::uint64_t block = blocks.key(blocks.owner_block(jobs_[i].owner));
    for (const ContactPoint& point : of_job_[i]) own.push_back(sent(point, block));
  }
  std::vector<SentPoint> all = gather_list(*ranks_, own);
  const auto place = [](const SentPoint& point) {  // patches come after fields, by block alone
    const bool patch = point.chooser >= 0;
    return std::make_tuple(point.body, patch, patch ? 0 : point.field, point.block);
  };
  std::stable_sort(all.begin(), all.end(), [&](const SentPoint& a, const SentPoint& b) { return place(a) < place(b); });
  for (const SentPoint& one : all) points_.push_back(received(one));
}

const std::vector<ContactPoint>& PointSearch::find(double dt) {
  with_geometry(geometry_, [&](auto kind) { find_in<decltype(kind)>(dt); });
  return points_;
}

}  // namespace mpm
