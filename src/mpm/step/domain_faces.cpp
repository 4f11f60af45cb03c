#include "mpm/step/domain_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mpm/math/dimension.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/shape/particle_domain.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm {
namespace {

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

}  // namespace

PlacedDomain DomainFaces::domain_of(const ParticleSet& set, int p) const {
  const GridLayout& grid = layout();
  const ShapeTraits& traits = traits_of(settings_.shape);
  PlacedDomain domain;
  domain.dim = grid.dim();
  for (int k = 0; k < domain.dim; ++k) {
    domain.center[k] = set.x[k][p];
    double half = set.half[k];
    if (traits.follows == Follows::stretch) {
      half = UgimpStretch<double>::half(set.domain[k][p], {half, grid.inverse_cell(k)});
    }
    half *= grid.cell(k);
    domain.d[k][k] = half;
    if (!traits.shears()) continue;
    for (int c = 0; c < domain.dim; ++c) domain.d[k][c] = set.domain[c * domain.dim + k][p] * half;
  }
  const bool ring = axisymmetric(settings_.geometry) && !set.whole_domains && !set.planar_functions;
  if (ring && traits.follows_deformation()) shrink_to_axis(domain, !traits.shears());
  if (ring && !traits.follows_deformation()) truncate_at_axis(domain);
  if (traits.shears()) keep_within_reach(domain, grid);
  return domain;
}

// In plane stress a domain that follows the deformation has the thickness that the particle has now.
double DomainFaces::across(const ParticleSet& set, int p) const {
  const bool follows =
      settings_.geometry == GeometryKind::plane_stress && traits_of(settings_.shape).follows_deformation();
  return settings_.across * (follows ? set.f[PlaneStress::kMatrix - 1][p] : 1.0);
}

FaceParts DomainFaces::parts(int set, int particle, DomainFace face) const {
  const ParticleSet& own = sets_[set];
  FaceParts parts = face_parts(settings_.geometry, domain_of(own, particle), face, across(own, particle));
  if (own.surface.empty() || own.mass == 0.0) return parts;
  // Face of a flat end has the share of the particle's place that lies in the body, where a surface cuts it.
  const double share = own.mass_of(particle) / own.mass;
  parts.area *= share;
  for (int c = 0; c < parts.corners; ++c) parts.corner[c].area *= share;
  return parts;
}

FaceParts DomainFaces::parts_of_box(int set, int particle, DomainFace face) const {
  const ParticleSet& own = sets_[set];
  PlacedDomain box;
  box.dim = layout().dim();
  for (int k = 0; k < box.dim; ++k) {
    box.center[k] = own.x[k][particle];
    box.d[k][k] = own.half[k] * layout().cell(k);
  }
  return face_parts(settings_.geometry, box, face, settings_.across);
}

namespace {

/// `find(numbers of a node)`: a FieldNode, block -1 if it is not there or carries nothing.
template <class Find>
NodeShares shares_around(const GridLayout& layout, const PlacedDomain::Vector& at, Find&& find) {
  NodeShares found;
  const int dim = layout.dim();
  std::array<int, 3> low{};
  std::array<double, 3> beyond{};
  for (int k = 0; k < dim; ++k) {
    const double cells = std::floor(layout.in_cells(k, at[k]));
    if (!(cells >= -kBlockEdge && cells < layout.last_node(k) + kBlockEdge)) return found;
    low[k] = static_cast<int>(cells);
    beyond[k] = layout.in_cells(k, at[k]) - cells;
  }
  double sum = 0.0;  // sum of the hats of nodes that carry mass: 1, but where dirac or folded splines leave one out
  for (int i = 0; i < 1 << dim; ++i) {
    std::array<int, 3> node{};
    double hat = 1.0;
    for (int k = 0; k < dim; ++k) {
      const int up = i >> k & 1;
      node[k] = low[k] + up;
      hat *= up == 1 ? beyond[k] : 1.0 - beyond[k];
    }
    if (!(hat > 0.0)) continue;
    const FieldNode own = find(node);
    if (own.ref.block < 0) continue;
    found.field[found.count] = own.field;
    found.node[found.count] = own.ref;
    found.share[found.count++] = hat;
    sum += hat;
  }
  for (int i = 0; i < found.count; ++i) found.share[i] /= sum;
  return found;
}

}  // namespace

NodeShares DomainFaces::shares(int set, int particle, const PlacedDomain::Vector& at) const {
  const ParticleSet& of = sets_[set];
  if (!of.chooses || of.side[particle] == 0) {
    return node_shares(MaterialNodes(fields_, of.field_of(particle)), at);
  }
  const auto first = of.begin.begin() + settings_.choice->grid().first_owner;
  const auto next = std::upper_bound(first, of.begin.end(), static_cast<std::uint32_t>(particle));
  const int patch = static_cast<int>(next - first) - 1;
  return shares_around(layout(), at, [&](const std::array<int, 3>& node) {
    const int field = settings_.choice->chosen_at(patch, node);
    return field < 0 ? FieldNode{} : MaterialNodes(fields_, field).find(node);
  });
}

NodeShares node_shares(const MaterialNodes& material, const PlacedDomain::Vector& at) {
  return shares_around(material.grid().layout, at, [&](const std::array<int, 3>& node) { return material.find(node); });
}

void find_places(const ParticleSet& set, std::vector<int>& place_of) {
  const auto last = std::max_element(set.id.begin(), set.id.end());
  place_of.assign(last == set.id.end() ? 0 : *last + 1 - set.first_id, -1);
  for (int p = 0; p < set.size(); ++p) place_of[set.id[p] - set.first_id] = p;
}

namespace {

/// The particle of a row that lies farthest out.
struct Outermost {
  std::array<int, 3> row;
  double place;
  std::uint32_t number;
};

/// Leaves one of each row. Where two lie as far out it is the one with the lower number.
void keep_outermost(std::vector<Outermost>& list, bool upper) {
  std::sort(list.begin(), list.end(), [](const Outermost& a, const Outermost& b) {
    return a.row != b.row ? a.row < b.row : a.number < b.number;
  });
  std::vector<Outermost> kept;
  for (const Outermost& one : list) {
    if (kept.empty() || kept.back().row != one.row) {
      kept.push_back(one);
    } else if (upper ? one.place > kept.back().place : one.place < kept.back().place) {
      kept.back() = one;
    }
  }
  list = std::move(kept);
}

}  // namespace

std::vector<std::uint32_t> outermost_particles(const ParticleSet& set, const GridLayout& layout, DomainFace face,
                                               Communicator* ranks) {
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
  if (ranks == nullptr) {
    for (const auto& [row, p] : outermost) particles.push_back(p);
  } else {
    std::vector<Outermost> list;
    for (const auto& [row, p] : outermost) list.push_back({row, along[p], set.id[p] - set.first_id});
    list = gather_list(*ranks, list);
    keep_outermost(list, face.upper);
    for (const Outermost& one : list) particles.push_back(one.number);
  }
  std::sort(particles.begin(), particles.end());
  return particles;
}

}  // namespace mpm
