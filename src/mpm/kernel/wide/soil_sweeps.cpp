// The sweeps of the implicit step, eight cells at once.
#include <algorithm>
#include <cmath>

#include "mpm/kernel/soil_cells.hpp"
#include "mpm/kernel/soil_lanes.hpp"

namespace mpm {

// soil_particles.cpp
template <class T>
mpm_kernel::SoilPasses<T> soil_passes(mpm_kernel::CellKind kind);
// soil_contacts.cpp
template <class T>
void meet_contacts(const mpm_kernel::SoilBlock<T>& block, mpm_kernel::SoilNode<T>* nodes);
template <class T>
void touch_contact(mpm_kernel::ContactRow<T>& row, mpm_kernel::SoilNode<T>* nodes);

namespace {

using mpm_kernel::CellKind;
using mpm_kernel::kCellNodes;
using mpm_kernel::kGroupCells;
using mpm_kernel::kOverRoot2;
using mpm_kernel::kOverRoot3;
using mpm_kernel::kOverRoot6;
using mpm_kernel::SoilBlock;
using mpm_kernel::SoilFlow;
using mpm_kernel::SoilGroup;
using mpm_kernel::SoilMask;
using mpm_kernel::SoilNode;
using mpm_kernel::SoilPlaces;

// In rings a node's gradient along y is its hoop function, the mean of N / r; in planes it is none, and what follows
// from motion along y is left out.

/// Rates of strain, mapped, from the velocities of the nodes.
template <class T, CellKind Kind>
inline __attribute__((always_inline)) void rate(const SoilGroup<T>& group, const GroupNodes<T, Kind>& nodes,
                                                Eight<T> (&e)[6]) {
  // Sums of even and odd nodes apart, so that half as many sums wait for each other.
  Eight<T> part[2][6] = {};
  for (int n = 0; n < nodes.kCount; ++n) {
    const Eight<T> x = load(group.gradient[0][n]), y = load(group.gradient[1][n]), z = load(group.gradient[2][n]);
    const Corners<T>& v = nodes.of[n];
    Eight<T>(&sums)[6] = part[n % 2];
    sums[0] += x * v.x;
    if constexpr (Kind != CellKind::plane) sums[1] += y * (Kind == CellKind::rings ? v.x : v.y);
    sums[2] += z * v.z;
    if constexpr (Kind == CellKind::space) sums[3] += y * v.z + z * v.y;
    sums[4] += x * v.z + z * v.x;
    if constexpr (Kind == CellKind::space) sums[5] += x * v.y + y * v.x;
  }
  Eight<T> whole[6];
  for (int i = 0; i < 6; ++i) whole[i] = part[0][i] + part[1][i];
  const auto& [xx, yy, zz, yz, xz, xy] = whole;
  e[0] = static_cast<T>(kOverRoot3) * (xx + yy + zz);
  e[1] = static_cast<T>(kOverRoot2) * (xx - yy);
  e[2] = static_cast<T>(kOverRoot6) * (zz + zz - xx - yy);
  e[3] = static_cast<T>(kOverRoot2) * yz;
  e[4] = static_cast<T>(kOverRoot2) * xz;
  e[5] = static_cast<T>(kOverRoot2) * xy;
}

/// Changes the velocities of the nodes by changes `d` of the stresses.
template <class T, CellKind Kind>
inline __attribute__((always_inline)) void spread(const SoilGroup<T>& group, const SoilMask<T>* masks,
                                                  const Eight<T> (&d)[6], GroupNodes<T, Kind>& nodes) {
  const Eight<T> f = load(group.push);
  const Eight<T> p = static_cast<T>(kOverRoot3) * d[0], q = static_cast<T>(kOverRoot6) * d[2],
                 h = static_cast<T>(kOverRoot2) * d[1];
  const Eight<T> sx = f * (p + h - q), sy = f * (p - h - q), sz = f * (p + q + q);
  const Eight<T> g = f * static_cast<T>(kOverRoot2), yz = g * d[3], xz = g * d[4], xy = g * d[5];
  for (int n = 0; n < nodes.kCount; ++n) {
    const Eight<T> bx = load(group.gradient[0][n]), by = load(group.gradient[1][n]), bz = load(group.gradient[2][n]);
    Corners<T>& v = nodes.of[n];
    Eight<T> x = bx * sx + bz * xz, y{}, z = bx * xz + bz * sz;
    if constexpr (Kind == CellKind::rings) x += by * sy;
    if constexpr (Kind == CellKind::space) {
      x += by * xy;
      y = v.m * (bx * xy + by * sy + bz * yz);
      z += by * yz;
    }
    x *= v.m;
    z *= v.m;
    if (group.mask >= 0) {
      const SoilMask<T>& mask = masks[group.mask];
      x *= load(mask.free[0][n]);
      if constexpr (Kind == CellKind::space) y *= load(mask.free[1][n]);
      z *= load(mask.free[2][n]);
    }
    v.x += x;
    if constexpr (Kind == CellKind::space) v.y += y;
    v.z += z;
  }
}

/// Answer of a cell's rate of strain to its own stress: sum over nodes and axes of w w^T / m, where w are the numbers
/// that a velocity along the axis gives to e. What stands for it, a number for e_N and one for e_T, must not be less in
/// any direction: sweeps would make energy where a node is light.
template <class T>
class CellAnswer {
 public:
  void add(const Eight<T> (&w)[6], Eight<T> im) {
    int at = 0;
    for (int i = 0; i < 6; ++i) {
      const Eight<T> scaled = im * w[i];
      for (int j = 0; j <= i; ++j) w_[at++] += scaled * w[j];
    }
  }
  /// By the coupling more than that of e_N alone.
  Eight<T> normal() const { return w_[0] + coupling(); }
  /// Gershgorin's bound of the largest eigenvalue of the part for e_T, and the coupling.
  Eight<T> shear() const {
    Eight<T> most{};
    for (int i = 1; i < 6; ++i) {
      Eight<T> sum{};
      for (int j = 1; j < 6; ++j) {
        const Eight<T> one = entry(i, j);
        sum += largest<T>(one, -one);
      }
      most = largest<T>(most, sum);
    }
    return most + coupling();
  }

 private:
  Eight<T> entry(int i, int j) const { return i < j ? w_[j * (j + 1) / 2 + i] : w_[i * (i + 1) / 2 + j]; }
  Eight<T> coupling() const {
    Eight<T> sum{};
    for (int i = 1; i < 6; ++i) sum += entry(i, 0) * entry(i, 0);
    return root<T>(sum);
  }

  Eight<T> w_[21] = {};
};

template <class T, CellKind Kind>
void prepare(SoilGroup<T>& group, const SoilPlaces<T>& places, const SoilNode<T>* nodes, const SoilMask<T>* mask) {
  const Eight<T> x = load(places.mean[0]), y = load(places.mean[1]), z = load(places.mean[2]);
  const Eight<T> xy = load(places.mean[3]), xz = load(places.mean[4]), yz = load(places.mean[5]), none{};
  constexpr bool plane = Kind != CellKind::space;
  const T r2 = static_cast<T>(kOverRoot2), r3 = static_cast<T>(kOverRoot3), r6 = static_cast<T>(kOverRoot6);
  CellAnswer<T> answer;
  for (int e = 0; e < kCellNodes; ++e) {
    if (plane && e >= kCellNodes / 2) {
      for (int k = 0; k < 3; ++k) store(group.gradient[k][e], none);
      continue;
    }
    // Hat functions along the axes: a + s x, a = 1 and s = -1 at the lower node, 0 and 1 at the upper one; 1 along y in
    // a plane.
    const bool up[3] = {(e & 1) != 0, !plane && (e & 2) != 0, (e >> (plane ? 1 : 2) & 1) != 0};
    T a[3], s[3];
    for (int k = 0; k < 3; ++k) {
      s[k] = up[k] ? T(1) : T(-1);
      a[k] = up[k] ? T(0) : T(1);
    }
    if (plane) s[1] = T(0), a[1] = T(1);
    const T* h = places.inverse_cell;
    const Eight<T> gx = s[0] * h[0] * (a[1] * a[2] + (a[2] * s[1]) * y + (a[1] * s[2]) * z + (s[1] * s[2]) * yz);
    Eight<T> gy = s[1] * h[1] * (a[0] * a[2] + (a[2] * s[0]) * x + (a[0] * s[2]) * z + (s[0] * s[2]) * xz);
    if constexpr (Kind == CellKind::rings) {
      gy = (a[0] * a[2]) * load(places.over_radius[0]) + (a[2] * s[0]) * load(places.over_radius[1]) +
           (a[0] * s[2]) * load(places.over_radius[2]) + (s[0] * s[2]) * load(places.over_radius[3]);
    }
    const Eight<T> gz = s[2] * h[2] * (a[0] * a[1] + (a[1] * s[0]) * x + (a[0] * s[1]) * y + (s[0] * s[1]) * xy);
    store(group.gradient[0][e], gx);
    store(group.gradient[1][e], gy);
    store(group.gradient[2][e], gz);
    Eight<T> im;
    for (int l = 0; l < kGroupCells; ++l) im[l] = nodes[group.node[e][l]].inverse_mass;
    const auto free = [&](int axis) { return mask != nullptr ? im * load(mask->free[axis][e]) : im; };
    if constexpr (Kind == CellKind::rings) {
      answer.add({r3 * (gx + gy), r2 * (gx - gy), -r6 * (gx + gy), none, r2 * gz, none}, free(0));
      answer.add({r3 * gz, none, (r6 + r6) * gz, none, r2 * gx, none}, free(2));
    } else {
      answer.add({r3 * gx, r2 * gx, -r6 * gx, none, r2 * gz, r2 * gy}, free(0));
      answer.add({r3 * gy, -r2 * gy, -r6 * gy, r2 * gz, none, r2 * gx}, free(1));
      answer.add({r3 * gz, none, (r6 + r6) * gz, r2 * gy, r2 * gx, none}, free(2));
    }
  }
  const Eight<T> push = load(group.push);
  store(group.weight_n, push * answer.normal());
  store(group.weight_t, push * answer.shear());
}

/// Part of the strength from which on a stress lies on the surface, whose Lode angle is found anew after each sweep.
constexpr double kFlows = 0.95;

template <class T>
constexpr T kStill = T(1e-12);  ///< a rate below which there is no direction [1/s]

/// Largest and smallest principal deviators over sqrt(J2): their difference and sum, for a deviator of the direction
/// -b, compression positive, of the length bt.
template <class T>
struct Extremes {
  Eight<T> difference, sum;

  Extremes(const Eight<T> (&b)[6], Eight<T> bt) {
    const Eight<T> over = static_cast<T>(1) / (largest<T>(bt, all<T>(kStill<T>)) * static_cast<T>(kOverRoot2));
    const Eight<T> d = static_cast<T>(kOverRoot2) * b[1] * over, q = static_cast<T>(kOverRoot6) * b[2] * over;
    const Eight<T> xx = d - q, yy = -d - q, zz = q + q, g = static_cast<T>(kOverRoot2) * over;
    const Eight<T> yz = g * b[3], xz = g * b[4], xy = g * b[5];  // tension positive, as b itself
    const Eight<T> j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // cos(3 a) of the Lode angle a in [0, 60 degrees]; cos(a) = cos(2/3 acos(t)) with t = cos(3 a / 2), a polynomial to
    // 2e-7.
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

/// Finds strength, slope and theta at the Lode angle of the direction -b.
template <class T>
inline __attribute__((always_inline)) void find_surface(SoilGroup<T>& group, const Eight<T> (&b)[6], Eight<T> bt) {
  const Extremes<T> extremes(b, bt);
  const Eight<T> lode = load(group.lode), sine = load(group.sine), dilation = load(group.dilation);
  const Eight<T> factor = static_cast<T>(1.4142135623730951) * extremes.per_shear(sine, lode);
  store(group.strength, factor * load(group.cohesion));
  store(group.slope, static_cast<T>(kOverRoot3) * factor * sine);
  store(group.theta,
        static_cast<T>(0.816496580927726) * load(group.dilates) * dilation * extremes.per_shear(dilation, lode));
}

/// Finds the slope of mu(I) at the rate that follows from |b_T|, own_t and r_N.
template <class T>
inline __attribute__((always_inline)) void find_slope_at_rate(SoilGroup<T>& group, Eight<T> bt, Eight<T> own_t,
                                                              Eight<T> rn) {
  constexpr T kRoot2 = static_cast<T>(1.4142135623730951);
  const Eight<T> none{}, still = all<T>(kStill<T>), pressed = largest<T>(rn, still), over_t = static_cast<T>(1) / own_t;
  const Eight<T> p = static_cast<T>(kOverRoot3) * pressed, rise = kRoot2 * group.friction_rise * p;
  const Eight<T> least = kRoot2 * load(group.sine) * p;
  const Eight<T> b = static_cast<T>(kOverRoot2) * group.reference_rate * root<T>(p);
  // G y^2 + (G b + rise - S) y - S b = 0, S the excess over the strength at rest and G = 1 / own_t, y the rate.
  const Eight<T> excess = largest<T>(none, bt * over_t - least);
  const Eight<T> half = over_t * b + rise - excess;
  const Eight<T> both = root<T>(half * half + static_cast<T>(4) * over_t * excess * b);
  // Two forms of the same root, each without a difference of large numbers where it is used.
  const Eight<T> y = half > none ? static_cast<T>(2) * excess * b / largest<T>(both + half, still)
                                 : static_cast<T>(0.5) * own_t * (both - half);
  store(group.slope, (least + rise * y / largest<T>(y + b, still)) / pressed);
}

template <class T>
Eight<T> length(const Eight<T> (&b)[6]) {
  Eight<T> sum = b[1] * b[1] + b[2] * b[2];
  for (int k = 3; k < 6; ++k) sum += b[k] * b[k];
  return root<T>(sum);
}

/// The stress r for which e = w r + b, with the law; `bt`: |b_T|.
template <class T>
inline __attribute__((always_inline)) void solve(const SoilGroup<T>& group, Eight<T> own_n, Eight<T> own_t,
                                                 Eight<T> theta, const Eight<T> (&b)[6], Eight<T> bt,
                                                 Eight<T> (&r)[6]) {
  const Eight<T> strength = load(group.strength), slope = load(group.slope), none{}, still = all<T>(kStill<T>);
  const Eight<T> over_n = static_cast<T>(1) / own_n, over_t = static_cast<T>(1) / own_t;
  const Eight<T> apex = slope > none ? -strength / largest<T>(slope, still) : load(group.least);
  const Eight<T> least = largest<T>(apex, load(group.least));
  const Eight<T> alone = -b[0] * over_n;           // r_N if the volume stays
  const Eight<T> kept = strength + slope * alone;  // and what it bears then
  const Eight<T> base = kept + slope * theta * over_n * bt;
  const Eight<T> excess = bt - kept * own_t;
  const Truth<T> slides = excess > none, parts = slides && (base <= none);
  // s = 1 / (own_t + alpha) with alpha = excess / base.
  const Eight<T> part = base / largest<T>(own_t * base + excess, still);
  const Eight<T> slid = alone + theta * over_n * bt * (static_cast<T>(1) - own_t * part);
  Eight<T> s = slides ? part : over_t;
  Eight<T> rn = slides ? slid : alone;
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
  const Eight<T> bt = length<T>(b);
  find_surface(group, b, bt);
  // The rate of the last step is not known here: it may have had any.
  if (group.friction_rise > T(0)) {
    constexpr double kSlope = 1.4142135623730951 * kOverRoot3;
    store(group.slope, static_cast<T>(kSlope) * (load(group.sine) + group.friction_rise));
  }
  solve(group, all<T>(1), all<T>(1), Eight<T>{}, b, bt, r);
  for (int k = 0; k < 6; ++k) store(group.stress[k], r[k]);
}

template <class T, CellKind Kind>
inline __attribute__((always_inline)) void relax(SoilGroup<T>& group, const SoilMask<T>* masks, SoilNode<T>* nodes,
                                                 Eight<T>& size, Eight<T>& change) {
  GroupNodes<T, Kind> corners(group, nodes);
  Eight<T> b[6], r[6];
  rate(group, corners, b);
  const Eight<T> weight_n = load(group.weight_n), weight_t = load(group.weight_t);
  for (int k = 0; k < 6; ++k) b[k] += load(group.shift[k]) - (k == 0 ? weight_n : weight_t) * load(group.stress[k]);
  const Eight<T> bt = length<T>(b);
  const Eight<T> own_n = weight_n + load(group.compliance_n), own_t = weight_t + load(group.compliance_t);
  solve(group, own_n, own_t, load(group.theta), b, bt, r);
  const Eight<T> push = load(group.push);
  for (int k = 0; k < 6; ++k) {
    const Eight<T> found = r[k], weight = push * (k == 0 ? own_n : own_t);
    r[k] -= load(group.stress[k]);
    store(group.stress[k], found);
    size += weight * found * found;
    change += weight * r[k] * r[k];
  }
  spread(group, masks, r, corners);
  for (int e = 0; e < corners.kCount; ++e) store(nodes, group.node[e], corners.of[e]);
  find_surface(group, b, bt);
  if (group.friction_rise > T(0)) find_slope_at_rate(group, bt, own_t, load(group.stress[0]));
}

template <class T, CellKind Kind>
void push(const SoilBlock<T>& block, SoilNode<T>* nodes) {
  for (int i = 0; i < block.group_count; ++i) {
    const SoilGroup<T>& group = block.groups[i];
    GroupNodes<T, Kind> corners(group, nodes);
    Eight<T> r[6];
    for (int k = 0; k < 6; ++k) r[k] = load(group.stress[k]);
    spread(group, block.masks, r, corners);
    for (int e = 0; e < corners.kCount; ++e) store(nodes, group.node[e], corners.of[e]);
  }
}

template <class T, CellKind Kind>
mpm_kernel::SweepChange sweep(const SoilBlock<T>& block, SoilNode<T>* nodes, bool backwards) {
  Eight<T> size{}, change{};
  for (int i = 0; i < block.group_count; ++i) {
    SoilGroup<T>& group = block.groups[backwards ? block.group_count - 1 - i : i];
    relax<T, Kind>(group, block.masks, nodes, size, change);
  }
  mpm_kernel::SweepChange sum{0.0, 0.0};
  for (int l = 0; l < kGroupCells; ++l) {
    sum.size += static_cast<double>(size[l]);
    sum.change += static_cast<double>(change[l]);
  }
  return sum;
}

/// `now` goes on by `factor` times its change, and `before` becomes what it was: so many numbers, a multiple of Of.
template <class Of, class T>
inline __attribute__((always_inline)) void go_on(T* now, T* before, int count, T factor) {
  constexpr int kWidth = sizeof(Of) / sizeof(T);
  for (int i = 0; i < count; i += kWidth) {
    Of& value = *reinterpret_cast<Of*>(now + i);
    Of& last = *reinterpret_cast<Of*>(before + i);
    const Of was = value;
    if (factor != T(0)) value += factor * (was - last);
    last = was;
  }
}

template <class T>
void extrapolate(const SoilBlock<T>& block, SoilNode<T>* nodes, SoilNode<T>* before, int count, T factor) {
  for (int i = 0; i < block.group_count; ++i) {
    SoilGroup<T>& group = block.groups[i];
    go_on<Eight<T>>(group.stress[0], group.before[0], 6 * kGroupCells, factor);
  }
  // With the inverse masses, which do not change. A block has a multiple of two nodes.
  go_on<Eight<T>>(nodes->v, before->v, 4 * count, factor);
  for (int i = 0; i < block.row_count; ++i) go_on<T>(block.rows[i].impulse, block.rows[i].before, 3, factor);
  for (int i = 0; i < block.wall_count; ++i) go_on<T>(block.walls[i].impulse, block.walls[i].before, 3, factor);
}

template <class T, CellKind Kind>
void flow(const SoilGroup<T>& group, const SoilNode<T>* nodes, SoilFlow<T>& out) {
  const GroupNodes<T, Kind> corners(group, nodes);
  Eight<T> e[6], plastic[6], shear{};
  rate(group, corners, e);
  const Eight<T> compliance_n = load(group.compliance_n), compliance_t = load(group.compliance_t);
  for (int k = 0; k < 6; ++k) {
    store(out.rate[k], e[k]);
    plastic[k] = e[k] + load(group.shift[k]) + (k == 0 ? compliance_n : compliance_t) * load(group.stress[k]);
    if (k > 0) shear += plastic[k] * plastic[k];
  }
  shear = root<T>(shear);
  // Below the surface what elasticity does not account for is work that sweeps have left, and no flow.
  Eight<T> r[6];
  for (int k = 0; k < 6; ++k) r[k] = load(group.stress[k]);
  const Eight<T> bears = load(group.strength) + load(group.slope) * r[0], none{};
  store(out.shear, length<T>(r) >= static_cast<T>(kFlows) * bears ? shear : none);
  store(out.opening, plastic[0] - load(group.closing) - load(group.theta) * shear);
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) {
      Eight<T> sum{};
      for (int n = 0; n < corners.kCount; ++n) {
        if (Kind == CellKind::rings && (a == 1) != (k == 1)) break;
        const Corners<T>& v = corners.of[n];
        sum += load(group.gradient[k][n]) * (a == 0 || (Kind == CellKind::rings && a == 1) ? v.x : a == 1 ? v.y : v.z);
      }
      store(out.gradient[3 * a + k], sum);
    }
  }
}

template <class T, CellKind Kind>
mpm_kernel::SweepTable<T> table() {
  return {&prepare<T, Kind>, &project<T>,       &push<T, Kind>, &sweep<T, Kind>,     &extrapolate<T>,
          &meet_contacts<T>, &touch_contact<T>, &flow<T, Kind>, soil_passes<T>(Kind)};
}

}  // namespace

const mpm_kernel::SweepFamily& soil_sweeps() {
  static const mpm_kernel::SweepFamily kFamily{
      {table<double, CellKind::space>(), table<double, CellKind::plane>(), table<double, CellKind::rings>()},
      {table<float, CellKind::space>(), table<float, CellKind::plane>(), table<float, CellKind::rings>()}};
  return kFamily;
}

}  // namespace mpm
