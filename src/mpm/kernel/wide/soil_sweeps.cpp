// The sweeps of the implicit step, a cell's eight nodes in the lanes of a register.
#include "mpm/kernel/soil_cells.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

using mpm_kernel::ContactRow;
using mpm_kernel::kCellNodes;
using mpm_kernel::kLodeSteps;
using mpm_kernel::SoilBlock;
using mpm_kernel::SoilCell;
using mpm_kernel::SoilLaw;
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

/// Velocities and inverse masses of a cell's nodes, a node a lane.
template <class T>
struct Corners {
  Eight<T> x, y, z, m;
};

template <class T>
Corners<T> load(const SoilNode<T>* nodes, const int* n) {
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
void store(SoilNode<T>* nodes, const int* n, const Corners<T>& c) {
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

/// Lane k of the result: the sum of the lanes of v[k].
template <class T>
Eight<T> sums(const Eight<T>* v) {
  const auto two = [](Eight<T> a, Eight<T> b) {
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
           __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  };
  const auto four = [](Eight<T> ab, Eight<T> cd) {
    return __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13) +
           __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
  };
  const Eight<T> e = four(two(v[0], v[1]), two(v[2], v[3])), f = four(two(v[4], v[5]), two(v[6], v[7]));
  return __builtin_shufflevector(e, f, 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(e, f, 4, 5, 6, 7, 12, 13, 14, 15);
}

/// Rate of the cell's strain, mapped, from the velocities of its nodes; two numbers more are 0.
template <class T>
void rate(const SoilCell<T>& cell, const Corners<T>& c, T (&e)[8]) {
  const Eight<T> bx = load(cell.gradient[0]), by = load(cell.gradient[1]), bz = load(cell.gradient[2]), none = bx - bx;
  const Eight<T> parts[8] = {bx * c.x,            by * c.y,            bz * c.z, by * c.z + bz * c.y,
                             bx * c.z + bz * c.x, bx * c.y + by * c.x, none,     none};
  const Eight<T> s = sums<T>(parts);
  const T xx = s[0], yy = s[1], zz = s[2];
  e[0] = T(kRoot3) * (xx + yy + zz);
  e[1] = T(kRoot2) * (xx - yy);
  e[2] = T(kRoot6) * (T(2) * zz - xx - yy);
  e[3] = T(kRoot2) * s[3];
  e[4] = T(kRoot2) * s[4];
  e[5] = T(kRoot2) * s[5];
  e[6] = e[7] = T(0);
}

/// What a change `d` of the cell's stress does to the velocities of its nodes.
template <class T>
void spread(const SoilCell<T>& cell, const SoilMask<T>* masks, const T* d, Corners<T>& c) {
  const Eight<T> bx = load(cell.gradient[0]), by = load(cell.gradient[1]), bz = load(cell.gradient[2]);
  const T p = T(kRoot3) * d[0], q = T(kRoot6) * d[2], f = cell.push;
  const T sx = f * (p + T(kRoot2) * d[1] - q), sy = f * (p - T(kRoot2) * d[1] - q), sz = f * (p + T(2) * q);
  const T yz = f * T(kRoot2) * d[3], xz = f * T(kRoot2) * d[4], xy = f * T(kRoot2) * d[5];
  Eight<T> x = c.m * (bx * sx + by * xy + bz * xz), y = c.m * (bx * xy + by * sy + bz * yz);
  Eight<T> z = c.m * (bx * xz + by * yz + bz * sz);
  if (cell.mask >= 0) {
    const SoilMask<T>& mask = masks[cell.mask];
    x *= load(mask.free[0]);
    y *= load(mask.free[1]);
    z *= load(mask.free[2]);
  }
  c.x += x;
  c.y += y;
  c.z += z;
}

template <class T>
constexpr T kStill = T(1e-12);  ///< a rate below which there is no direction [1/s]

/// Place in the tables for a stress of the direction -b.
template <class T>
struct LodePlace {
  int k;
  T part;
  T at(const T* table) const { return table[k] + part * (table[k + 1] - table[k]); }
};

template <class T>
LodePlace<T> lode_place(const T* b, T bt) {
  const T r2 = T(kRoot2), r6 = T(kRoot6);
  const T xx = -(r2 * b[1] - r6 * b[2]), yy = r2 * b[1] + r6 * b[2], zz = -T(2) * r6 * b[2];
  const T yz = -r2 * b[3], xz = -r2 * b[4], xy = -r2 * b[5];
  const T j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const T q = bt * r2;
  // 3 sqrt(3) / 2 J3 / J2^(3/2), with r compression positive: 1 in triaxial compression.
  const T sine = std::min(T(1), std::max(T(-1), T(2.598076211353316) * j3 / (q * q * q)));
  const T place = (sine + T(1)) * T(kLodeSteps / 2);
  const int k = static_cast<int>(place);
  return {k, place - static_cast<T>(k)};
}

template <class T>
void solve(const SoilLaw<T>& law, T own_n, T own_t, T left, T dilates, const T* b, T* r) {
  T bt = T(0);
  for (int k = 1; k < 6; ++k) bt += b[k] * b[k];
  bt = std::sqrt(bt);
  const LodePlace<T> place = bt > kStill<T> ? lode_place(b, bt) : LodePlace<T>{0, T(0)};
  const auto between = [&](const T* peak, const T* residual) {
    const T last = place.at(residual);
    return last + left * (place.at(peak) - last);
  };
  const T strength = between(law.strength, law.residual_strength), slope = between(law.slope, law.residual_slope);
  const T theta = dilates * place.at(law.dilation);
  T rn = -b[0] / own_n;
  const T least = std::max(law.least, slope > T(0) ? -strength / slope : law.least);
  T s = T(1) / own_t;  // r_T = -s b_T
  const T kept = strength + slope * rn;  // what it bears if its volume stays
  if (bt > own_t * kept) {
    const T gamma = slope * theta / own_n, base = kept + gamma * bt;
    if (base <= T(0)) {
      s = T(0);
      rn = least;
    } else {
      const T alpha = std::max(T(0), (bt - kept * own_t) / base);
      s = T(1) / (own_t + alpha);
      rn += theta * alpha * s * bt / own_n;
    }
  }
  if (rn < least) {
    rn = least;
    const T most = std::max(T(0), strength + slope * least);
    s = bt > own_t * most ? most / std::max(bt, kStill<T>) : T(1) / own_t;
  }
  r[0] = rn;
  for (int k = 1; k < 6; ++k) r[k] = -s * b[k];
}

template <class T>
double relax(SoilCell<T>& cell, const SoilLaw<T>* laws, const SoilMask<T>* masks, SoilNode<T>* nodes) {
  Corners<T> corners = load(nodes, cell.node);
  T b[8], r[6], d[8];
  rate(cell, corners, b);
  b[0] += cell.shift[0] - cell.weight_n * cell.stress[0];
  for (int k = 1; k < 6; ++k) b[k] += cell.shift[k] - cell.weight_t * cell.stress[k];
  solve(laws[cell.law], cell.own_n, cell.own_t, cell.left, cell.dilates, b, r);
  for (int k = 0; k < 6; ++k) {
    d[k] = r[k] - cell.stress[k];
    cell.stress[k] = r[k];
  }
  T shear = T(0);
  for (int k = 1; k < 6; ++k) shear += d[k] * d[k];
  spread(cell, masks, d, corners);
  store(nodes, cell.node, corners);
  return static_cast<double>(cell.push * (cell.own_n * d[0] * d[0] + cell.own_t * shear));
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
  for (int i = 0; i < block.cell_count; ++i) {
    const SoilCell<T>& cell = block.cells[i];
    Corners<T> corners = load(nodes, cell.node);
    spread(cell, block.masks, cell.stress, corners);
    store(nodes, cell.node, corners);
  }
}

template <class T>
double sweep(const SoilBlock<T>& block, const SoilLaw<T>* laws, SoilNode<T>* nodes, bool backwards) {
  double change = 0.0;
  if (backwards) {
    for (int i = block.cell_count; i-- > 0;) change += relax(block.cells[i], laws, block.masks, nodes);
  } else {
    for (int i = 0; i < block.cell_count; ++i) change += relax(block.cells[i], laws, block.masks, nodes);
  }
  return change;
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
void flow(const SoilCell<T>& cell, const SoilLaw<T>& law, const SoilNode<T>* nodes, T dt, T* e, T* shear, T* opening) {
  T rates[8], plastic[6];
  rate(cell, load(nodes, cell.node), rates);
  std::copy(rates, rates + 6, e);
  T sum = T(0);
  for (int k = 0; k < 6; ++k) {
    plastic[k] = e[k] + cell.shift[k] + (k == 0 ? law.compliance_n : law.compliance_t) / dt * cell.stress[k];
    if (k > 0) sum += plastic[k] * plastic[k];
  }
  *shear = std::sqrt(sum);
  const T dilation = *shear > kStill<T> ? cell.dilates * lode_place(plastic, *shear).at(law.dilation) : T(0);
  *opening = plastic[0] - cell.closing - dilation * *shear;
}

}  // namespace

const mpm_kernel::SweepFamily& soil_sweeps() {
  static constexpr mpm_kernel::SweepFamily kFamily{{&push<double>, &sweep<double>, &meet<double>, &flow<double>, &solve<double>},
                                                   {&push<float>, &sweep<float>, &meet<float>, &flow<float>, &solve<float>}};
  return kFamily;
}

}  // namespace mpm
