#include "mpm/mechanics/face_tractions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mpm/math/dimension.hpp"
#include "mpm/shape/particle_domain.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm {
namespace {

constexpr int kMostNodes = 8;  ///< of a cell

bool deforms(ShapeKind shape) { return shape == ShapeKind::cpdi || shape == ShapeKind::qcpdi; }

void keep_within_reach(PlacedDomain& domain, const GridLayout& layout) {
  double reach = kDomainReach;
  for (int c = 0; c < domain.dim; ++c) {
    double along = 0.0;
    for (int k = 0; k < domain.dim; ++k) along += std::abs(domain.d[k][c]) * layout.inverse_cell(c);
    reach = std::max(reach, along);
  }
  for (auto& vector : domain.d) {
    for (double& component : vector) component *= kDomainReach / reach;
  }
}

/// Block along an axis that a node is in, and its place there; nodes may be as far as a block before the first.
int block_along(int node) { return (node + kBlockEdge) / kBlockEdge - 1; }

}  // namespace

FaceTractions::FaceTractions(const TractionSettings& settings, Fields& fields, const std::vector<ParticleSet>& sets,
                             std::vector<TractionTerm> terms)
    : settings_(settings), fields_(fields), sets_(sets), terms_(std::move(terms)) {
  const int dim = dimensions(settings.geometry);
  std::size_t corners = 0, largest = 0;
  places_.resize(terms_.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    places_[i].resize(terms_[i].particles.size());
    corners += terms_[i].particles.size() << (dim - 1);
    largest = std::max(largest, static_cast<std::size_t>(sets_[terms_[i].set].size()));
  }
  place_of_.resize(largest);
  loads_.reserve(corners << dim);
  account_.name = "traction";
}

void FaceTractions::find_places() {
  int found = -1;  // the set that place_of_ is of
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const ParticleSet& set = sets_[terms_[i].set];
    if (terms_[i].set != found) {
      for (int p = 0; p < set.size(); ++p) place_of_[set.id[p] - set.first_id] = p;
      found = terms_[i].set;
    }
    for (std::size_t n = 0; n < places_[i].size(); ++n) places_[i][n] = place_of_[terms_[i].particles[n]];
  }
}

PlacedDomain FaceTractions::domain_of(const ParticleSet& set, int p, const GridLayout& layout) const {
  PlacedDomain domain;
  domain.dim = layout.dim();
  for (int k = 0; k < domain.dim; ++k) {
    domain.center[k] = set.x[k][p];
    double half = set.half[k];
    if (settings_.shape == ShapeKind::ugimp_stretch) {
      half = UgimpStretch<double>::half(set.domain[k][p], {half, layout.inverse_cell(k)});
    }
    half *= layout.cell(k);
    domain.d[k][k] = half;
    if (!deforms(settings_.shape)) continue;
    for (int c = 0; c < domain.dim; ++c) domain.d[k][c] = set.domain[c * domain.dim + k][p] * half;
  }
  const bool ring = axisymmetric(settings_.geometry) && !set.whole_domains && !set.planar_functions;
  if (ring && follows_deformation(settings_.shape)) shrink_to_axis(domain, settings_.shape == ShapeKind::ugimp_stretch);
  if (ring && !follows_deformation(settings_.shape)) truncate_at_axis(domain);
  if (deforms(settings_.shape)) keep_within_reach(domain, layout);
  return domain;
}

// In plane stress a domain that follows the deformation has the thickness that the particle has now.
double FaceTractions::across(const ParticleSet& set, int p) const {
  const bool follows = settings_.geometry == GeometryKind::plane_stress && follows_deformation(settings_.shape);
  return settings_.across * (follows ? set.f[PlaneStress::kMatrix - 1][p] : 1.0);
}

Vec3 FaceTractions::value_at(const TractionTerm& term, const FaceParts& parts, int p,
                             const StepContext& context) const {
  const GridLayout& layout = context.layout();
  const ParticleSet& set = sets_[term.set];
  const double half = 0.5 * context.dt;
  Vec3 place = Vec3::Zero(), start = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    place[axis] = parts.middle[k] + half * set.v[k][p];
    if (set.start_x.empty()) continue;
    start[axis] = set.start_x[k][p] + (k == term.face.axis ? term.face.side() * set.half[k] * layout.cell(k) : 0.0);
  }
  std::array<double, 3> given{};
  for (int i = 0; i < 3; ++i) {
    try {
      given[i] = term.value[i](context.start + half, place, start);
    } catch (const FunctionError& error) {
      throw LoadError(fmt::format("traction on '{}' at particle {}: {}", set.name, set.id[p], error.what()));
    }
  }
  Vec3 traction = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    traction[axis] = term.follows
                         ? -given[0] * parts.outward[k] + given[1] * parts.along[0][k] + given[2] * parts.along[1][k]
                         : given[axis];
  }
  return traction;
}

void FaceTractions::spread(const ParticleSet& set, int p, const PlacedDomain::Vector& at, const Vec3& force) {
  const int field = set.field_of(p);
  const Grid& grid = *fields_[field];
  const GridLayout& layout = grid.layout;
  const int dim = layout.dim();
  std::array<int, 3> low{};
  std::array<double, 3> beyond{};
  bool inside = true;
  for (int k = 0; k < dim; ++k) {
    const double cells = std::floor(layout.in_cells(k, at[k]));
    inside = inside && cells >= -kBlockEdge && cells < layout.last_node(k) + kBlockEdge;
    low[k] = inside ? static_cast<int>(cells) : 0;
    beyond[k] = layout.in_cells(k, at[k]) - cells;
  }
  std::array<NodeRef, kMostNodes> nodes{};
  std::array<double, kMostNodes> hats{};
  double sum = 0.0;  // of the hats of nodes that carry mass: 1, but where dirac or folded splines leave one out
  for (int i = 0; inside && i < 1 << dim; ++i) {
    std::array<int, 3> block{};
    int local = 0;
    double hat = 1.0;
    for (int k = 0; k < dim; ++k) {
      const int up = i >> k & 1, node = low[k] + up;
      block[k] = block_along(node);
      local = local * kBlockEdge + node - block[k] * kBlockEdge;
      hat *= up == 1 ? beyond[k] : 1.0 - beyond[k];
    }
    nodes[i] = {hat > 0.0 ? grid.blocks.find(layout.key(block)) : -1, local};
    if (nodes[i].block < 0 || !grid.carries(nodes[i].block, local)) continue;
    hats[i] = hat;
    sum += hat;
  }
  if (!(sum > 0.0)) {
    throw LoadError(fmt::format(
        "traction on '{}': a corner of particle {} lies where no material is on the grid; the particle is stretched "
        "too far: use a coarser grid.cell, or a smaller load",
        set.name, set.id[p]));
  }
  for (int i = 0; i < 1 << dim; ++i) {
    if (hats[i] > 0.0) loads_.push_back({field, nodes[i], force * (hats[i] / sum)});
  }
}

void FaceTractions::forces_gathered(StepContext& context) {
  const std::uint64_t generation =
      context.fields.front()->blocks.generation();  // of all fields: they are rebuilt together
  if (generation_ != generation) {
    find_places();
    generation_ = generation;
  }
  loads_.clear();
  Vec3 impulse = Vec3::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const TractionTerm& term = terms_[i];
    const ParticleSet& set = sets_[term.set];
    for (const int p : places_[i]) {
      const PlacedDomain domain = domain_of(set, p, context.layout());
      const FaceParts parts = face_parts(settings_.geometry, domain, term.face, across(set, p));
      const Vec3 traction = value_at(term, parts, p, context);
      impulse += traction * (parts.area * context.dt);
      for (int a = 0; a < parts.corners; ++a) {
        spread(set, p, parts.corner[a].at, traction * parts.corner[a].area);
      }
    }
  }
  for (const NodalLoad& load : loads_) {
    Grid& grid = *fields_[load.field];
    add_nodal_vector(grid.force, grid.layout, load.node, load.force);
  }
  account_.add(impulse);
}

void FaceTractions::momentum_updated(StepContext& context) {
  double power = 0.0;
  for (const NodalLoad& load : loads_) {
    const Grid& grid = *fields_[load.field];
    // The displacement of a particle in the step: v^{n+1} dt - a dt^2 / 2, GIMP notes (2.16).
    const Vec3 v = nodal_vector(grid.velocity, grid.layout, load.node);
    const Vec3 a = nodal_vector(grid.force, grid.layout, load.node);
    power += load.force.dot(v - 0.5 * context.dt * a);
  }
  work_ += power * context.dt;
}

std::vector<std::uint32_t> outermost_particles(const ParticleSet& set, const GridLayout& layout, DomainFace face) {
  std::map<std::array<int, 3>, std::uint32_t> outermost;
  const auto& along = set.x[face.axis];
  for (std::uint32_t p = 0; p < static_cast<std::uint32_t>(set.size()); ++p) {
    std::array<int, 3> row{};
    for (int k = 0; k < layout.dim(); ++k) {
      if (k == face.axis) continue;
      row[k] = static_cast<int>(std::floor(layout.in_cells(k, set.x[k][p]) / (2.0 * set.half[k])));
    }
    const auto [first, added] = outermost.emplace(row, p);
    if (!added && (face.upper ? along[p] > along[first->second] : along[p] < along[first->second])) first->second = p;
  }
  std::vector<std::uint32_t> particles;
  for (const auto& [row, p] : outermost) particles.push_back(p);
  std::sort(particles.begin(), particles.end());
  return particles;
}

}  // namespace mpm
