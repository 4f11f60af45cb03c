#include "mpm/implicit/soil_cells.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/grid/each_share.hpp"
#include "mpm/math/dimension.hpp"

namespace mpm {
namespace {

constexpr double kRoot2 = 0.70710678118654752, kRoot3 = 0.57735026918962576, kRoot6 = 0.40824829046386302;
constexpr double kDensest = 0.02;     ///< logarithmic volume: the most that is remembered of soil that is too dense
constexpr double kGivenBack = 0.2;    ///< part of it that soil which is too dense gives back in a step
constexpr double kThinnest = 1e-9;    ///< part of a box: a piece that is thinner is none
constexpr double kMostStrain = 0.2;   ///< of volume, that a step may give a particle

/// r, compression positive, of a stress that is tension positive.
void map_stress(const Symmetric3<double>& s, double scale, double (&r)[6]) {
  const double xx = -scale * s.xx, yy = -scale * s.yy, zz = -scale * s.zz;
  r[0] = kRoot3 * (xx + yy + zz);
  r[1] = kRoot2 * (xx - yy);
  r[2] = kRoot6 * (2.0 * zz - xx - yy);
  r[3] = -scale * s.yz / kRoot2;
  r[4] = -scale * s.xz / kRoot2;
  r[5] = -scale * s.xy / kRoot2;
}

/// The way back.
Symmetric3<double> tensor_of(const double* r) {
  const double p = kRoot3 * r[0], q = kRoot6 * r[2], d = kRoot2 * r[1];
  return {-(p + d - q), -(p - d - q), -(p + 2.0 * q), -kRoot2 * r[3], -kRoot2 * r[4], -kRoot2 * r[5]};
}

/// Typed arrays of a set's particles.
template <class Geometry, class T>
struct SoilParticles {
  explicit SoilParticles(ParticleSet& set) {
    for (int i = 0; i < Geometry::kMatrix; ++i) f[i] = set.f[i].template data<T>();
    for (int i = 0; i < Geometry::kSymmetric; ++i) tau[i] = set.tau[i].template data<T>();
    strain = set.history[DruckerPrager::kPlasticStrain].template data<T>();
    opening = set.history[DruckerPrager::kOpening].template data<T>();
    work = set.history[DruckerPrager::kPlasticWork].template data<T>();
  }
  static_assert(DruckerPrager::kOpening == MohrCoulomb::kOpening && DruckerPrager::kPlasticWork == MohrCoulomb::kPlasticWork &&
                DruckerPrager::kPlasticStrain == MohrCoulomb::kPlasticStrain);

  Matrix3<double> gradient(int p) const { return in_double(full(Geometry::load_matrix(f, p))); }
  Symmetric3<double> stress(int p) const { return in_double(full(Geometry::load_symmetric(tau, p))); }
  void set_gradient(int p, const Matrix3<double>& m) const {
    if constexpr (Geometry::kDim == 3) {
      Geometry::store_matrix(Matrix3<T>{T(m.xx), T(m.xy), T(m.xz), T(m.yx), T(m.yy), T(m.yz), T(m.zx), T(m.zy), T(m.zz)}, f, p);
    } else {
      Geometry::store_matrix(MatrixPlane<T>{T(m.xx), T(m.xz), T(m.zx), T(m.zz), T(m.yy)}, f, p);
    }
  }
  void set_stress(int p, const Symmetric3<double>& s) const {
    if constexpr (Geometry::kDim == 3) {
      Geometry::store_symmetric(Symmetric3<T>{T(s.xx), T(s.yy), T(s.zz), T(s.yz), T(s.xz), T(s.xy)}, tau, p);
    } else {
      Geometry::store_symmetric(SymmetricPlane<T>{T(s.xx), T(s.zz), T(s.xz), T(s.yy)}, tau, p);
    }
  }

  std::array<T*, Geometry::kMatrix> f;
  std::array<T*, Geometry::kSymmetric> tau;
  T *strain, *opening, *work;

 private:
  template <class U>
  static Matrix3<double> in_double(const Matrix3<U>& m) {
    return {double(m.xx), double(m.xy), double(m.xz), double(m.yx), double(m.yy), double(m.yz), double(m.zx), double(m.zy), double(m.zz)};
  }
  template <class U>
  static Symmetric3<double> in_double(const Symmetric3<U>& s) {
    return {double(s.xx), double(s.yy), double(s.zz), double(s.yz), double(s.xz), double(s.xy)};
  }
};

/// The pieces into which a particle's box is cut: cell along each axis, counted from the block's first, part of the box,
/// and the middle, in cells from the lower corner of the cell.
template <int Dim>
struct Pieces {
  int count = 0;
  std::array<int, 3> cell[1 << Dim];
  double part[1 << Dim];
  double middle[1 << Dim][3];
};

template <int Dim>
Pieces<Dim> pieces_of(const ParticleSet& set, std::uint32_t p, const GridLayout& layout, const std::array<int, 3>& first) {
  int number[Dim], at[Dim][2];
  double part[Dim][2], middle[Dim][2];
  for (int k = 0; k < Dim; ++k) {
    constexpr int kShift = 64;
    const double x = layout.in_cells(k, set.x[k][p]) - kBlockEdge * first[k], half = set.half[k];
    const double low = x - half, high = x + half;
    const int i = static_cast<int>(low + kShift) - kShift, j = static_cast<int>(high + kShift) - kShift;
    const double above = (high - j) / (2.0 * half);
    number[k] = 1;
    at[k][0] = i;
    part[k][0] = 1.0;
    middle[k][0] = x - i;
    if (j != i && above > kThinnest && above < 1.0 - kThinnest) {
      number[k] = 2;
      at[k][1] = j;
      part[k][0] = 1.0 - above;
      part[k][1] = above;
      middle[k][0] = 0.5 * (low + j) - i;
      middle[k][1] = 0.5 * (high - j);
    } else if (j != i && above >= 1.0 - kThinnest) {
      at[k][0] = j;
      middle[k][0] = x - j;
    }
  }
  Pieces<Dim> all;
  const auto add = [&](const std::array<int, 3>& which) {
    const int n = all.count++;
    all.part[n] = 1.0;
    for (int k = 0; k < Dim; ++k) {
      all.cell[n][k] = at[k][which[k]];
      all.part[n] *= part[k][which[k]];
      all.middle[n][k] = middle[k][which[k]];
    }
  };
  for (int a = 0; a < number[0]; ++a) {
    for (int b = 0; b < number[1]; ++b) {
      if constexpr (Dim == 3) {
        for (int c = 0; c < number[2]; ++c) add({a, b, c});
      } else {
        add({a, b, 0});
      }
    }
  }
  return all;
}

/// The block around an owner in which a cell lies, as neighbours() numbers them, and its number inside.
template <int Dim>
std::pair<int, int> place_of(const std::array<int, 3>& cell) {
  int neighbour = 0, local = 0;
  for (int k = 0; k < Dim; ++k) {
    const int at = std::clamp(cell[k], -kBlockEdge, 2 * kBlockEdge - 1), step = at < 0 ? 0 : at < kBlockEdge ? 1 : 2;
    neighbour = 3 * neighbour + step;
    local = kBlockEdge * local + at - kBlockEdge * (step - 1);
  }
  return {neighbour, local};
}

/// exp(a) f, to the second order.
Matrix3<double> strained(const Matrix3<double>& f, const Matrix3<double>& a) {
  const Matrix3<double> s = product(a, a);
  return product(Matrix3<double>{1.0 + a.xx + 0.5 * s.xx, a.xy + 0.5 * s.xy, a.xz + 0.5 * s.xz, a.yx + 0.5 * s.yx,
                  1.0 + a.yy + 0.5 * s.yy, a.yz + 0.5 * s.yz, a.zx + 0.5 * s.zx, a.zy + 0.5 * s.zy,
                  1.0 + a.zz + 0.5 * s.zz},
                 f);
}

/// How a cell's rate of strain answers to its own stress: sum over nodes and axes of w w^T / m, where w are the numbers
/// that a velocity along the axis gives to e. What each cell takes for it, a number for e_N and one for e_T, must not be less
/// in any direction, or sweeps make energy where a node is light.
class CellAnswer {
 public:
  /// `g`: gradient of a node's shape function [1/m]; `im`: 1 / mass along each axis, 0 where it is held [1/kg].
  void add(const double (&g)[3], const double (&im)[3]) {
    const double x = g[0], y = g[1], z = g[2];
    add({kRoot3 * x, kRoot2 * x, -kRoot6 * x, 0.0, kRoot2 * z, kRoot2 * y}, im[0]);
    add({kRoot3 * y, -kRoot2 * y, -kRoot6 * y, kRoot2 * z, 0.0, kRoot2 * x}, im[1]);
    add({kRoot3 * z, 0.0, 2.0 * kRoot6 * z, kRoot2 * y, kRoot2 * x, 0.0}, im[2]);
  }
  double normal() const { return w_[0][0] + coupling(); }
  /// Gershgorin's bound of the largest eigenvalue, and the coupling.
  double shear() const {
    double most = 0.0;
    for (int i = 1; i < 6; ++i) {
      double sum = 0.0;
      for (int j = 1; j < 6; ++j) sum += std::abs(w_[std::max(i, j)][std::min(i, j)]);
      most = std::max(most, sum);
    }
    return most + coupling();
  }

 private:
  void add(const std::array<double, 6>& w, double im) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) w_[i][j] += im * w[i] * w[j];
    }
  }
  double coupling() const {
    double sum = 0.0;
    for (int i = 1; i < 6; ++i) sum += w_[i][0] * w_[i][0];
    return std::sqrt(sum);
  }

  double w_[6][6] = {};
};

/// Of a cell, by its number in its block: whether its numbers along the axes are odd.
int colour(int number, int dim) {
  int bits = 0;
  for (int k = 0; k < dim; ++k, number /= kBlockEdge) bits |= (number & 1) << k;
  return bits;
}

/// A lane without a cell: that of the first one, which moves nothing.
template <class T>
void copy_without_soil(mpm_kernel::SoilGroup<T>& group, int lane, int no_node) {
  for (auto& axis : group.gradient) {
    for (auto& node : axis) node[lane] = T(0);
  }
  for (auto& node : group.node) node[lane] = no_node;
  for (int i = 0; i < 6; ++i) group.stress[i][lane] = group.shift[i][lane] = T(0);
  for (auto* numbers : {&group.weight_n, &group.weight_t, &group.compliance_n, &group.compliance_t, &group.sine, &group.cohesion,
                        &group.dilation, &group.dilates, &group.least, &group.lode, &group.closing}) {
    (*numbers)[lane] = (*numbers)[0];
  }
  group.push[lane] = T(0);
}

/// Calls visit(Solid()) or visit(PlaneStrain()).
template <class Visit>
void in_space_or_plane(GeometryKind geometry, Visit&& visit) {
  if (geometry == GeometryKind::solid) {
    visit(Solid());
  } else {
    visit(PlaneStrain());
  }
}

/// Calls visit(law) with the law of soil.
template <class Visit>
void with_soil(const Law& law, Visit&& visit) {
  if (const auto* drucker = std::get_if<DruckerPrager>(&law)) visit(*drucker);
  if (const auto* mohr = std::get_if<MohrCoulomb>(&law)) visit(*mohr);
}

}  // namespace

template <class T>
SoilCells<T>::SoilCells(std::vector<SoilBody> bodies, const SoilGrid& grid, GeometryKind geometry, int threads)
    : bodies_(std::move(bodies)), grid_(grid), geometry_(geometry), threads_(threads) {
  least_density_ = bodies_.front().soil.density;
  for (const SoilBody& body : bodies_) least_density_ = std::min(least_density_, body.soil.density);
}

// A particle's box lies in the blocks around its owner.
template <class T>
void SoilCells<T>::rebuild() {
  const Grid& grid = grid_.grid();
  blocks_ = grid.blocks.size();
  slots_.assign(bodies_.size() * blocks_, -1);
  const int per_block = grid.layout.nodes_per_block();
  std::size_t used = 0;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const std::uint32_t* begin = &bodies_[body].set->begin[grid.first_owner];
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      if (begin[owner] == begin[owner + 1]) continue;
      for (int n = 0; n < grid.blocks.neighbour_count(); ++n) {
        int& place = slot(static_cast<int>(body), grid.blocks.neighbours(owner)[n]);
        if (place >= 0) continue;
        place = static_cast<int>(used);
        used += per_block;
      }
    }
  }
  if (used > sums_.size()) sums_.resize(used + used / 16);
  if (sums_.size() > lane_of_.size()) lane_of_.resize(sums_.size());
  begin_.resize(blocks_ + 1);
  held_.resize(std::max<std::size_t>(held_.size(), blocks_));
  masks_.resize(held_.size());
}

template <class T>
template <class Geometry>
void SoilCells<T>::gather_block(int body, int owner) {
  const Grid& grid = grid_.grid();
  ParticleSet& set = *bodies_[body].set;
  const SoilParticles<Geometry, T> particles(set);
  const ImplicitSoil& soil = bodies_[body].soil;
  const int place = grid.first_owner + owner;
  const std::array<int, 3>& first = grid.blocks.block(grid.blocks.owner_block(owner));
  for (std::uint32_t p = set.begin[place]; p < set.begin[place + 1]; ++p) {
    const int at = static_cast<int>(p);
    const double j = determinant(particles.gradient(at));
    const double whole = set.mass_of(at) * j / soil.density;
    double r[6];
    map_stress(particles.stress(at), soil.density / j, r);
    const double opening = particles.opening[at];
    const double left = soil.fall.falls() ? soil.fall.left(static_cast<double>(particles.strain[at])) : 1.0;
    const double dilates = opening > 0.0 ? 0.0 : left * soil.dilation_end.left(j);
    const auto pieces = pieces_of<Geometry::kDim>(set, p, grid.layout, first);
    for (int n = 0; n < pieces.count; ++n) {
      const auto [neighbour, local] = place_of<Geometry::kDim>(pieces.cell[n]);
      Sums& sums = sums_[slot(body, grid.blocks.neighbours(owner)[neighbour]) + local];
      const double v = whole * pieces.part[n];
      double m[3] = {pieces.middle[n][0], 0.0, pieces.middle[n][1]};
      if constexpr (Geometry::kDim == 3) m[1] = pieces.middle[n][1], m[2] = pieces.middle[n][2];
      sums.volume += v;
      sums.place[0] += v * m[0];
      sums.place[1] += v * m[1];
      sums.place[2] += v * m[2];
      sums.place[3] += v * m[0] * m[1];
      sums.place[4] += v * m[0] * m[2];
      sums.place[5] += v * m[1] * m[2];
      for (int i = 0; i < 6; ++i) sums.stress[i] += v * r[i];
      sums.opening += v * opening;
      sums.left += v * left;
      sums.dilates += v * dilates;
    }
  }
}

template <class T>
void SoilCells<T>::gather(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt) {
  const Grid& grid = grid_.grid();
  const int bodies = static_cast<int>(bodies_.size()), per_block = grid.layout.nodes_per_block();
  const auto each_slot = [&](int block, auto&& visit) {
    for (int body = 0; body < bodies; ++body) {
      if (const int at = slot(body, block); at >= 0) visit(body, at);
    }
  };
  grid_.shares().at_once(threads_, [&](int block) {
    each_slot(block, [&](int, int at) { std::fill_n(sums_.begin() + at, per_block, Sums{}); });
  });
  in_space_or_plane(geometry_, [&](auto kind) {
    grid.shares.by_colour(threads_, [&](int owner) {
      for (int body = 0; body < bodies; ++body) gather_block<decltype(kind)>(body, owner);
    });
  });
  grid_.shares().at_once(threads_, [&](int block) {
    int groups = 0;
    each_slot(block, [&](int, int at) {
      std::array<int, 8> cells{};
      for (int n = 0; n < per_block; ++n) cells[colour(n, grid.layout.dim())] += sums_[at + n].volume > 0.0;
      for (const int count : cells) groups += (count + mpm_kernel::kGroupCells - 1) / mpm_kernel::kGroupCells;
    });
    begin_[block + 1] = groups;
  });
  begin_[0] = 0;
  for (int block = 0; block < blocks_; ++block) begin_[block + 1] += begin_[block];
  const std::size_t size = begin_[blocks_];
  if (size > groups_.capacity()) {
    groups_.reserve(size + size / 8);
    motion_.reserve(mpm_kernel::kGroupCells * (size + size / 8));
  }
  groups_.resize(size);
  motion_.resize(mpm_kernel::kGroupCells * size);
  grid_.shares().at_once(threads_, [&](int block) { make_groups(table, nodes, dt, block); });
}

template <class T>
void SoilCells<T>::make_groups(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt, int block) {
  held_[block].clear();
  masks_[block].clear();
  int next = begin_[block];
  if (next == begin_[block + 1]) return;
  const int dim = grid_.grid().layout.dim(), per_block = grid_.grid().layout.nodes_per_block();
  const auto finish = [&](mpm_kernel::SoilMask<T>& mask, int lanes) {
    Group& group = groups_[next];
    for (int lane = lanes; lane < mpm_kernel::kGroupCells; ++lane) copy_without_soil(group, lane, grid_.nodes());
    if (group.mask == 0) {
      group.mask = static_cast<int>(masks_[block].size());
      masks_[block].push_back(mask);
    }
    table.project(group);
    ++next;
  };
  for (int body = 0; body < static_cast<int>(bodies_.size()); ++body) {
    const int at = slot(body, block);
    if (at < 0) continue;
    for (int c = 0; c < 1 << dim; ++c) {
      mpm_kernel::SoilMask<T> mask;
      int lanes = 0;
      for (int n = 0; n < per_block; ++n) {
        if (colour(n, dim) != c || !(sums_[at + n].volume > 0.0)) continue;
        if (lanes == 0) {
          std::fill_n(&mask.free[0][0][0], sizeof(mask) / sizeof(T), T(1));
          groups_[next].mask = -1;
        }
        std::array<int, 3> local{};
        for (int k = dim - 1, rest = n; k >= 0; --k, rest /= kBlockEdge) local[k] = rest % kBlockEdge;
        make_cell(sums_[at + n], body, block, local, nodes, dt, next, lanes, mask);
        lane_of_[at + n] = mpm_kernel::kGroupCells * next + lanes;
        if (++lanes == mpm_kernel::kGroupCells) {
          finish(mask, lanes);
          lanes = 0;
        }
      }
      if (lanes > 0) finish(mask, lanes);
    }
  }
}

template <class T>
void SoilCells<T>::make_cell(const Sums& sums, int body, int block, const std::array<int, 3>& local, const std::vector<Node>& nodes,
                             double dt, int number, int lane, mpm_kernel::SoilMask<T>& mask) {
  Group& group = groups_[number];
  const GridLayout& layout = grid_.grid().layout;
  const int dim = layout.dim(), corners = 1 << dim;
  const double per_volume = 1.0 / sums.volume;
  double mean[6];
  for (int i = 0; i < 6; ++i) mean[i] = per_volume * sums.place[i];
  const double& x = mean[0];
  const double& y = mean[1];
  const double& z = mean[2];
  const double inverse[3] = {layout.inverse_cell(0), dim == 3 ? layout.inverse_cell(1) : 0.0, layout.inverse_cell(dim - 1)};
  CellAnswer answer;
  for (int e = 0; e < mpm_kernel::kCellNodes; ++e) {
    for (int a = 0; a < 3; ++a) group.gradient[a][e][lane] = T(0);
    if (e >= corners) {
      group.node[e][lane] = grid_.nodes();
      continue;
    }
    const int node = grid_.corner(block, local, e);
    group.node[e][lane] = node;
    // Hat functions along the axes: a + s x, a = 1 and s = -1 at the lower node, 0 and 1 at the upper one; 1 along y in
    // a plane.
    const bool up[3] = {(e & 1) != 0, dim == 3 && (e & 2) != 0, (e >> (dim - 1) & 1) != 0};
    double s[3], a[3];
    for (int k = 0; k < 3; ++k) {
      s[k] = up[k] ? 1.0 : -1.0;
      a[k] = up[k] ? 0.0 : 1.0;
    }
    if (dim == 2) s[1] = 0.0, a[1] = 1.0;
    const double g[3] = {
        s[0] * inverse[0] * (a[1] * a[2] + a[2] * s[1] * y + a[1] * s[2] * z + s[1] * s[2] * mean[5]),
        s[1] * inverse[1] * (a[0] * a[2] + a[2] * s[0] * x + a[0] * s[2] * z + s[0] * s[2] * mean[4]),
        s[2] * inverse[2] * (a[0] * a[1] + a[1] * s[0] * x + a[0] * s[1] * y + s[0] * s[1] * mean[3])};
    double im[3];
    for (int k = 0; k < 3; ++k) {
      group.gradient[k][e][lane] = static_cast<T>(g[k]);
      im[k] = nodes[node].inverse_mass;
      const std::uint8_t wall = grid_.holder(node, k);
      if (wall == SoilGrid::kFree) continue;
      im[k] = 0.0;
      mask.free[k][e][lane] = T(0);
      group.mask = 0;
      held_[block].push_back({number, lane, wall, static_cast<std::uint8_t>(k), {g[0], g[1], g[2]}});
    }
    answer.add(g, im);
  }
  const ImplicitSoil& soil = bodies_[body].soil;
  const double push = dt * sums.volume, opening = per_volume * sums.opening, left = per_volume * sums.left;
  group.push[lane] = static_cast<T>(push);
  group.weight_n[lane] = static_cast<T>(push * answer.normal());
  group.weight_t[lane] = static_cast<T>(push * answer.shear());
  group.compliance_n[lane] = static_cast<T>(soil.compliance_n / dt);
  group.compliance_t[lane] = static_cast<T>(soil.compliance_t / dt);
  group.sine[lane] = static_cast<T>(soil.sine.at(left));
  group.cohesion[lane] = static_cast<T>(soil.cohesion.at(left));
  group.dilation[lane] = static_cast<T>(soil.dilation);
  group.dilates[lane] = static_cast<T>(per_volume * sums.dilates);
  group.least[lane] = static_cast<T>(soil.least);
  group.lode[lane] = soil.follows_lode ? T(1) : T(0);
  group.closing[lane] = static_cast<T>(kRoot3 * (opening > 0.0 ? opening : kGivenBack * opening) / dt);
  for (int i = 0; i < 6; ++i) {
    const double r = per_volume * sums.stress[i];
    group.stress[i][lane] = static_cast<T>(r);
    group.shift[i][lane] = static_cast<T>(-(i == 0 ? soil.compliance_n : soil.compliance_t) / dt * r);
  }
  group.shift[0][lane] += group.closing[lane];
}

template <class T>
void SoilCells<T>::add_to_walls(std::array<std::array<double, 3>, 6>& walls) const {
  for (int block = 0; block < blocks_; ++block) {
    for (const HeldEntry& held : held_[block]) {
      const Group& group = groups_[held.group];
      double r[6];
      for (int i = 0; i < 6; ++i) r[i] = static_cast<double>(group.stress[i][held.lane]);
      const Symmetric3<double> s = tensor_of(r);
      const double* g = held.gradient;
      const double rows[3] = {s.xx * g[0] + s.xy * g[1] + s.xz * g[2], s.xy * g[0] + s.yy * g[1] + s.yz * g[2],
                              s.xz * g[0] + s.yz * g[1] + s.zz * g[2]};
      walls[held.wall][held.axis] -= static_cast<double>(group.push[held.lane]) * rows[held.axis];  // tension is positive in s
    }
  }
}

template <class T>
void SoilCells<T>::find_motion(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, int number) {
  const Group& group = groups_[number];
  mpm_kernel::SoilFlow<T> flow;
  table.flow(group, nodes.data(), flow);
  for (int lane = 0; lane < mpm_kernel::kGroupCells; ++lane) {
    Motion& motion = motion_[mpm_kernel::kGroupCells * number + lane];
    for (int i = 0; i < 9; ++i) motion.gradient[i] = static_cast<double>(flow.gradient[i][lane]);
    motion.power = 0.0;
    for (int i = 0; i < 6; ++i) {
      motion.stress[i] = static_cast<double>(group.stress[i][lane]);
      motion.power -= motion.stress[i] * static_cast<double>(flow.rate[i][lane]);
    }
    motion.shear = static_cast<double>(flow.shear[lane]);
    motion.opening = static_cast<double>(flow.opening[lane]);
  }
}

template <class T>
template <class Geometry, class LawType>
void SoilCells<T>::take_block(int body, const LawType& law, int owner, double dt) {
  const Grid& grid = grid_.grid();
  ParticleSet& set = *bodies_[body].set;
  const SoilParticles<Geometry, T> particles(set);
  const double density = bodies_[body].soil.density;
  const int place = grid.first_owner + owner;
  const std::array<int, 3>& first = grid.blocks.block(grid.blocks.owner_block(owner));
  for (std::uint32_t p = set.begin[place]; p < set.begin[place + 1]; ++p) {
    const int at = static_cast<int>(p);
    double l[9] = {}, r[6] = {}, opening = 0.0, shear = 0.0, power = 0.0;
    const auto pieces = pieces_of<Geometry::kDim>(set, p, grid.layout, first);
    for (int n = 0; n < pieces.count; ++n) {
      const auto [neighbour, local] = place_of<Geometry::kDim>(pieces.cell[n]);
      const Motion& motion = motion_[lane_of_[slot(body, grid.blocks.neighbours(owner)[neighbour]) + local]];
      const double part = pieces.part[n];
      for (int i = 0; i < 9; ++i) l[i] += part * motion.gradient[i];
      for (int i = 0; i < 6; ++i) r[i] += part * motion.stress[i];
      opening += part * motion.opening;
      shear += part * motion.shear;
      power += part * motion.power;
    }
    const double trace = l[0] + l[4] + l[8], most = kMostStrain / dt;
    if (std::abs(trace) > most) {
      const double excess = (trace - std::copysign(most, trace)) / Geometry::kDim;
      l[0] -= excess;
      l[8] -= excess;
      if (Geometry::kDim == 3) l[4] -= excess;
    }
    for (double& one : l) one *= dt;
    const Matrix3<double> step{l[0], l[1], l[2], l[3], l[4], l[5], l[6], l[7], l[8]};
    const Matrix3<double> f = particles.gradient(at), grown = strained(f, step);
    const double j_old = determinant(f), j = determinant(grown);
    const Symmetric3<double> stress = scale_shift(rotate(tensor_of(r), step), j / density, 0.0);
    const auto energy = [&](const Symmetric3<double>& s, double volume) { return law.elastic_energy(f, s, volume); };
    const double stored = energy(stress, j) - energy(particles.stress(at), j_old);
    particles.set_gradient(at, grown);
    particles.set_stress(at, stress);
    particles.work[at] += static_cast<T>(dt * power * j_old / density - stored);
    particles.strain[at] += static_cast<T>(dt * shear / kRoot2);
    particles.opening[at] = static_cast<T>(std::max(-kDensest, particles.opening[at] + dt * opening / kRoot3));
  }
}

template <class T>
void SoilCells<T>::take(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt) {
  grid_.shares().at_once(threads_, [&](int block) {
    for (int group = begin_[block]; group < begin_[block + 1]; ++group) find_motion(table, nodes, group);
  });
  in_space_or_plane(geometry_, [&](auto kind) {
    grid_.grid().shares.at_once(threads_, [&](int owner) {
      for (int body = 0; body < static_cast<int>(bodies_.size()); ++body) {
        with_soil(*bodies_[body].law,
                  [&](const auto& law) { this->template take_block<decltype(kind)>(body, law, owner, dt); });
      }
    });
  });
}

template class SoilCells<double>;
template class SoilCells<float>;

}  // namespace mpm
