// The sweeps of the implicit step, eight cells at once.
#include "mpm/kernel/soil_cells.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

using mpm_kernel::ContactRow;
using mpm_kernel::kCellNodes;
using mpm_kernel::SoilBlock;
using mpm_kernel::SoilFlow;
using mpm_kernel::SoilGroup;
using mpm_kernel::SoilMask;
using mpm_kernel::SoilNode;
using mpm_kernel::WallRow;

template <class T>
struct Lanes {
  typedef T Eight __attribute__((vector_size(8 * sizeof(T)), aligned(sizeof(T)), may_alias));
  typedef T Four __attribute__((vector_size(4 * sizeof(T)), aligned(sizeof(T)), may_alias));
};
template <class T>
using Eight = typename Lanes<T>::Eight;
template <class T>
using Four = typename Lanes<T>::Four;

constexpr double kRoot2 = 0.70710678118654752, kRoot3 = 0.57735026918962576, kRoot6 = 0.40824829046386302;

template <class T>
Eight<T> load(const T* from) {
  return *reinterpret_cast<const Eight<T>*>(from);
}
template <class T>
void store(T* to, Eight<T> v) {
  *reinterpret_cast<Eight<T>*>(to) = v;
}

/// Velocities and inverse masses of eight nodes, a node a lane.
template <class T>
struct Corners {
  Eight<T> x, y, z, m;
};

template <class T>
inline __attribute__((always_inline)) Corners<T> load(const SoilNode<T>* nodes, const int* n) {
  const auto pair = [&](int a, int b) {
    const Four<T> low = *reinterpret_cast<const Four<T>*>(nodes[n[a]].v);
    const Four<T> high = *reinterpret_cast<const Four<T>*>(nodes[n[b]].v);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Eight<T> a = pair(0, 4), b = pair(1, 5), c = pair(2, 6), d = pair(3, 7);
  const Eight<T> ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> up_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(up_ab, up_cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(up_ab, up_cd, 2, 3, 10, 11, 6, 7, 14, 15)};
}

template <class T>
inline __attribute__((always_inline)) void store(SoilNode<T>* nodes, const int* n, const Corners<T>& c) {
  const Eight<T> xy = __builtin_shufflevector(c.x, c.y, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_xy = __builtin_shufflevector(c.x, c.y, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> zm = __builtin_shufflevector(c.z, c.m, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_zm = __builtin_shufflevector(c.z, c.m, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> q[4] = {__builtin_shufflevector(xy, zm, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(xy, zm, 2, 3, 10, 11, 6, 7, 14, 15),
                         __builtin_shufflevector(up_xy, up_zm, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(up_xy, up_zm, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int k = 0; k < 4; ++k) {
    *reinterpret_cast<Four<T>*>(nodes[n[k]].v) = __builtin_shufflevector(q[k], q[k], 0, 1, 2, 3);
    *reinterpret_cast<Four<T>*>(nodes[n[k + 4]].v) = __builtin_shufflevector(q[k], q[k], 4, 5, 6, 7);
  }
}

template <class T>
using Truth = decltype(Eight<T>{} < Eight<T>{});

template <class T>
Eight<T> all(double value) {
  return Eight<T>{} + static_cast<T>(value);
}
template <class T>
Eight<T> largest(Eight<T> a, Eight<T> b) {
  return a > b ? a : b;
}
template <class T>
Eight<T> least_of(Eight<T> a, Eight<T> b) {
  return a < b ? a : b;
}
template <class T>
Eight<T> root(Eight<T> a) {
  alignas(64) T v[8];
  store(v, a);
  for (int l = 0; l < 8; ++l) v[l] = std::sqrt(v[l]);
  return load(v);
}

/// Nodes 0 to 7 of the cells of a group, a cell a lane.
template <class T>
struct GroupNodes {
  Corners<T> of[kCellNodes];

  GroupNodes(const SoilGroup<T>& group, const SoilNode<T>* nodes) {
    for (int e = 0; e < kCellNodes; ++e) of[e] = load(nodes, group.node[e]);
  }
};

/// Rates of strain, mapped, from the velocities of the nodes.
template <class T>
inline __attribute__((always_inline)) void rate(const SoilGroup<T>& group, const GroupNodes<T>& nodes, Eight<T> (&e)[6]) {
  Eight<T> xx{}, yy{}, zz{}, yz{}, xz{}, xy{};
  for (int n = 0; n < kCellNodes; ++n) {
    const Eight<T> x = load(group.gradient[0][n]), y = load(group.gradient[1][n]), z = load(group.gradient[2][n]);
    const Corners<T>& v = nodes.of[n];
    xx += x * v.x;
    yy += y * v.y;
    zz += z * v.z;
    yz += y * v.z + z * v.y;
    xz += x * v.z + z * v.x;
    xy += x * v.y + y * v.x;
  }
  e[0] = static_cast<T>(kRoot3) * (xx + yy + zz);
  e[1] = static_cast<T>(kRoot2) * (xx - yy);
  e[2] = static_cast<T>(kRoot6) * (zz + zz - xx - yy);
  e[3] = static_cast<T>(kRoot2) * yz;
  e[4] = static_cast<T>(kRoot2) * xz;
  e[5] = static_cast<T>(kRoot2) * xy;
}

/// What changes `d` of the stresses do to the velocities of the nodes.
template <class T>
inline __attribute__((always_inline)) void spread(const SoilGroup<T>& group, const SoilMask<T>* masks, const Eight<T> (&d)[6], GroupNodes<T>& nodes) {
  const Eight<T> f = load(group.push);
  const Eight<T> p = static_cast<T>(kRoot3) * d[0], q = static_cast<T>(kRoot6) * d[2], h = static_cast<T>(kRoot2) * d[1];
  const Eight<T> sx = f * (p + h - q), sy = f * (p - h - q), sz = f * (p + q + q);
  const Eight<T> g = f * static_cast<T>(kRoot2), yz = g * d[3], xz = g * d[4], xy = g * d[5];
  for (int n = 0; n < kCellNodes; ++n) {
    const Eight<T> bx = load(group.gradient[0][n]), by = load(group.gradient[1][n]), bz = load(group.gradient[2][n]);
    Corners<T>& v = nodes.of[n];
    Eight<T> x = v.m * (bx * sx + by * xy + bz * xz), y = v.m * (bx * xy + by * sy + bz * yz);
    Eight<T> z = v.m * (bx * xz + by * yz + bz * sz);
    if (group.mask >= 0) {
      const SoilMask<T>& mask = masks[group.mask];
      x *= load(mask.free[0][n]);
      y *= load(mask.free[1][n]);
      z *= load(mask.free[2][n]);
    }
    v.x += x;
    v.y += y;
    v.z += z;
  }
}

template <class T>
constexpr T kStill = T(1e-12);  ///< a rate below which there is no direction [1/s]

/// Largest and smallest principal deviators over sqrt(J2): their difference and sum, for a deviator of the direction -b,
/// compression positive, of the length bt.
template <class T>
struct Extremes {
  Eight<T> difference, sum;

  Extremes(const Eight<T> (&b)[6], Eight<T> bt) {
    const Eight<T> over = static_cast<T>(1) / (largest<T>(bt, all<T>(kStill<T>)) * static_cast<T>(kRoot2));
    const Eight<T> d = static_cast<T>(kRoot2) * b[1] * over, q = static_cast<T>(kRoot6) * b[2] * over;
    const Eight<T> xx = d - q, yy = -d - q, zz = q + q, g = static_cast<T>(kRoot2) * over;
    const Eight<T> yz = g * b[3], xz = g * b[4], xy = g * b[5];  // tension positive, as b itself
    const Eight<T> j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // cos(3 a) of the Lode angle a in [0, 60 degrees]; cos(a) = cos(2/3 acos(t)) with t = cos(3 a / 2), a polynomial to 2e-7.
    const Eight<T> cosine = least_of<T>(all<T>(1), largest<T>(all<T>(-1), static_cast<T>(2.598076211353316) * j3));
    const Eight<T> t = root<T>(static_cast<T>(0.5) * (static_cast<T>(1) + cosine));
    Eight<T> c = all<T>(-0.002103491008);
    for (const double next : {0.01050175359, -0.02639974934, 0.05147476334, -0.1108054709, 0.5773319021, 0.500000186}) {
      c = c * t + static_cast<T>(next);
    }
    const Eight<T> s = root<T>(largest<T>(Eight<T>{}, static_cast<T>(1) - c * c));
    constexpr double kScale = 1.1547005383792515;
    difference = static_cast<T>(kScale) * (static_cast<T>(1.5) * c + static_cast<T>(0.8660254037844386) * s);
    sum = static_cast<T>(kScale) * (static_cast<T>(0.5) * c - static_cast<T>(0.8660254037844386) * s);
  }
  /// 1 / k; where `lode` is 0, 1.
  Eight<T> per_shear(Eight<T> sine, Eight<T> lode) const {
    const Eight<T> k = static_cast<T>(0.5) * (difference + sum * sine);
    return static_cast<T>(1) / (static_cast<T>(1) + lode * (k - static_cast<T>(1)));
  }
};

/// sqrt(2/3) dilates dilation / k.
template <class T>
Eight<T> flow_dilation(const SoilGroup<T>& group, const Extremes<T>& extremes) {
  const Eight<T> dilation = load(group.dilation);
  return static_cast<T>(0.816496580927726) * load(group.dilates) * dilation * extremes.per_shear(dilation, load(group.lode));
}

/// The stress r for which e = w r + b, with the law.
template <class T>
inline __attribute__((always_inline)) void solve(const SoilGroup<T>& group, Eight<T> own_n, Eight<T> own_t, const Eight<T> (&b)[6], bool flows, Eight<T> (&r)[6]) {
  Eight<T> bt = b[1] * b[1];
  for (int k = 2; k < 6; ++k) bt += b[k] * b[k];
  bt = root<T>(bt);
  const Extremes<T> extremes(b, bt);
  const Eight<T> sine = load(group.sine), factor = static_cast<T>(1.4142135623730951) * extremes.per_shear(sine, load(group.lode));
  const Eight<T> strength = factor * load(group.cohesion), slope = static_cast<T>(kRoot3) * factor * sine;
  const Eight<T> theta = flows ? flow_dilation(group, extremes) : Eight<T>{};
  const Eight<T> none{}, over_t = static_cast<T>(1) / own_t;
  const Eight<T> still = all<T>(kStill<T>);
  const Eight<T> apex = slope > none ? -strength / largest<T>(slope, still) : load(group.least);
  const Eight<T> least = largest<T>(apex, load(group.least));
  const Eight<T> alone = -b[0] / own_n;             // r_N if the volume stays
  const Eight<T> kept = strength + slope * alone;   // and what it bears then
  const Eight<T> base = kept + slope * theta * bt / own_n;
  const Eight<T> alpha = largest<T>(none, (bt - kept * own_t) / largest<T>(base, still));
  const Truth<T> slides = bt > own_t * kept, parts = slides && (base <= none);
  const Eight<T> part = static_cast<T>(1) / (own_t + alpha);
  Eight<T> s = slides ? part : over_t;
  Eight<T> rn = slides ? alone + theta * alpha * part * bt / own_n : alone;
  const Truth<T> limited = parts || (rn < least);
  const Eight<T> most = largest<T>(none, strength + slope * least);
  const Eight<T> short_s = least_of<T>(over_t, most / largest<T>(bt, still));
  rn = limited ? least : rn;
  s = limited ? short_s : s;
  r[0] = rn;
  for (int k = 1; k < 6; ++k) r[k] = -s * b[k];
}

template <class T>
void project(SoilGroup<T>& group) {
  Eight<T> b[6], r[6];
  for (int k = 0; k < 6; ++k) b[k] = -load(group.stress[k]);
  solve(group, all<T>(1), all<T>(1), b, false, r);
  for (int k = 0; k < 6; ++k) store(group.stress[k], r[k]);
}

template <class T>
inline __attribute__((always_inline)) void relax(SoilGroup<T>& group, const SoilMask<T>* masks, SoilNode<T>* nodes) {
  GroupNodes<T> corners(group, nodes);
  Eight<T> b[6], r[6];
  rate(group, corners, b);
  const Eight<T> weight_n = load(group.weight_n), weight_t = load(group.weight_t);
  for (int k = 0; k < 6; ++k) b[k] += load(group.shift[k]) - (k == 0 ? weight_n : weight_t) * load(group.stress[k]);
  solve(group, weight_n + load(group.compliance_n), weight_t + load(group.compliance_t), b, true, r);
  for (int k = 0; k < 6; ++k) {
    const Eight<T> found = r[k];
    r[k] -= load(group.stress[k]);
    store(group.stress[k], found);
  }
  spread(group, masks, r, corners);
  for (int e = 0; e < kCellNodes; ++e) store(nodes, group.node[e], corners.of[e]);
}

/// The impulse of Coulomb's law where an impulse l makes the velocity u + own l: no approach, no pull.
template <class T>
void coulomb(const T* u, const T* normal, T own, T friction, T* l) {
  const T un = u[0] * normal[0] + u[1] * normal[1] + u[2] * normal[2];
  const T ln = -un / own;
  if (ln <= T(0)) {
    l[0] = l[1] = l[2] = T(0);
    return;
  }
  T along = T(0);
  for (int a = 0; a < 3; ++a) {
    l[a] = -(u[a] - un * normal[a]) / own;
    along += l[a] * l[a];
  }
  const T most = friction * ln;
  const T part = friction >= T(0) && along > most * most ? most / std::sqrt(along) : T(1);
  for (int a = 0; a < 3; ++a) l[a] = part * l[a] + ln * normal[a];
}

template <class T>
void relax(ContactRow<T>& row, SoilNode<T>* nodes) {
  T u[3] = {-row.velocity[0], -row.velocity[1], -row.velocity[2]}, l[3];
  for (int e = 0; e < kCellNodes; ++e) {
    for (int a = 0; a < 3; ++a) u[a] += row.weight[a][e] * nodes[row.node[e]].v[a];
  }
  for (int a = 0; a < 3; ++a) u[a] -= row.own * row.impulse[a];
  coulomb(u, row.normal, row.own, row.friction, l);
  T d[3];
  for (int a = 0; a < 3; ++a) {
    d[a] = l[a] - row.impulse[a];
    row.impulse[a] = l[a];
  }
  for (int e = 0; e < kCellNodes; ++e) {
    SoilNode<T>& node = nodes[row.node[e]];
    for (int a = 0; a < 3; ++a) node.v[a] += node.inverse_mass * row.weight[a][e] * d[a];
  }
}

template <class T>
void relax(WallRow<T>& row, SoilNode<T>* nodes) {
  SoilNode<T>& node = nodes[row.node];
  T normal[3] = {T(0), T(0), T(0)}, u[3], l[3];
  normal[row.axis] = row.out;
  for (int a = 0; a < 3; ++a) u[a] = row.free[a] * (node.v[a] - node.inverse_mass * row.impulse[a]);
  coulomb(u, normal, node.inverse_mass, row.friction, l);
  for (int a = 0; a < 3; ++a) {
    node.v[a] += node.inverse_mass * (l[a] - row.impulse[a]);
    row.impulse[a] = l[a];
  }
}

template <class T>
void push(const SoilBlock<T>& block, SoilNode<T>* nodes) {
  for (int i = 0; i < block.group_count; ++i) {
    const SoilGroup<T>& group = block.groups[i];
    GroupNodes<T> corners(group, nodes);
    Eight<T> r[6];
    for (int k = 0; k < 6; ++k) r[k] = load(group.stress[k]);
    spread(group, block.masks, r, corners);
    for (int e = 0; e < kCellNodes; ++e) store(nodes, group.node[e], corners.of[e]);
  }
}

template <class T>
void sweep(const SoilBlock<T>& block, SoilNode<T>* nodes, bool backwards) {
  for (int i = 0; i < block.group_count; ++i) {
    relax(block.groups[backwards ? block.group_count - 1 - i : i], block.masks, nodes);
  }
}

template <class T>
void meet(const SoilBlock<T>& block, SoilNode<T>* nodes) {
  constexpr int kPasses = 2;  // rows of a body bind the same nodes
  for (int i = 0; i < block.wall_count; ++i) relax(block.walls[i], nodes);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int i = 0; i < block.row_count; ++i) relax(block.rows[i], nodes);
  }
}

template <class T>
void flow(const SoilGroup<T>& group, const SoilNode<T>* nodes, SoilFlow<T>& out) {
  const GroupNodes<T> corners(group, nodes);
  Eight<T> e[6], plastic[6], shear{};
  rate(group, corners, e);
  const Eight<T> compliance_n = load(group.compliance_n), compliance_t = load(group.compliance_t);
  for (int k = 0; k < 6; ++k) {
    store(out.rate[k], e[k]);
    plastic[k] = e[k] + load(group.shift[k]) + (k == 0 ? compliance_n : compliance_t) * load(group.stress[k]);
    if (k > 0) shear += plastic[k] * plastic[k];
  }
  shear = root<T>(shear);
  store(out.shear, shear);
  store(out.opening, plastic[0] - load(group.closing) - flow_dilation(group, Extremes<T>(plastic, shear)) * shear);
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) {
      Eight<T> sum{};
      for (int n = 0; n < kCellNodes; ++n) {
        const Corners<T>& v = corners.of[n];
        sum += load(group.gradient[k][n]) * (a == 0 ? v.x : a == 1 ? v.y : v.z);
      }
      store(out.gradient[3 * a + k], sum);
    }
  }
}

}  // namespace

const mpm_kernel::SweepFamily& soil_sweeps() {
  static constexpr mpm_kernel::SweepFamily kFamily{
      {&project<double>, &push<double>, &sweep<double>, &meet<double>, &flow<double>},
      {&project<float>, &push<float>, &sweep<float>, &meet<float>, &flow<float>}};
  return kFamily;
}

}  // namespace mpm
