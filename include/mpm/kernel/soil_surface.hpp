// Strength and flow of the soil in a cell: the stress for which a rate of strain fulfils the law, in closed form, at
// the Lode angle and rate that the sweep before has found (soil_cells.hpp, where the law and its source stand). Weak:
// at an angle and a rate that still change, a sweep is not yet on the surface.
#pragma once

#include <initializer_list>

#include "mpm/kernel/soil_lanes.hpp"

namespace mpm::soil {

template <class T>
constexpr T kStill = T(1e-12);  ///< a rate below which there is no direction [1/s]

/// Largest and smallest principal deviators over sqrt(J2): their difference and sum, for a deviator of the direction
/// -b, compression positive, of the length bt.
template <class T>
struct Extremes {
  Register<T> difference, sum;

  Extremes(const Register<T> (&b)[6], Register<T> bt) {
    const Register<T> over = static_cast<T>(1) / (largest<T>(bt, all<T>(kStill<T>)) * static_cast<T>(kOverRoot2));
    const Register<T> d = static_cast<T>(kOverRoot2) * b[1] * over, q = static_cast<T>(kOverRoot6) * b[2] * over;
    const Register<T> xx = d - q, yy = -d - q, zz = q + q, g = static_cast<T>(kOverRoot2) * over;
    const Register<T> yz = g * b[3], xz = g * b[4], xy = g * b[5];  // tension positive, as b itself
    const Register<T> j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // cos(3 a) of the Lode angle a in [0, 60 degrees]; cos(a) = cos(2/3 acos(t)) with t = cos(3 a / 2), a polynomial to
    // 2e-7.
    const Register<T> cosine = least_of<T>(all<T>(1), largest<T>(all<T>(-1), static_cast<T>(2.598076211353316) * j3));
    const Register<T> t = square_root<T>(static_cast<T>(0.5) * (static_cast<T>(1) + cosine));
    Register<T> c = all<T>(-0.002103491008);
    for (const double next : {0.01050175359, -0.02639974934, 0.05147476334, -0.1108054709, 0.5773319021, 0.500000186}) {
      c = c * t + static_cast<T>(next);
    }
    const Register<T> s = square_root<T>(largest<T>(Register<T>{}, static_cast<T>(1) - c * c));
    constexpr double kScale = 1.1547005383792515;
    difference = static_cast<T>(kScale) * (static_cast<T>(1.5) * c + static_cast<T>(0.8660254037844386) * s);
    sum = static_cast<T>(kScale) * (static_cast<T>(0.5) * c - static_cast<T>(0.8660254037844386) * s);
  }
  /// 1 / k; where `lode` is 0, 1.
  Register<T> per_shear(Register<T> sine, Register<T> lode) const {
    const Register<T> k = static_cast<T>(0.5) * (difference + sum * sine);
    return static_cast<T>(1) / (static_cast<T>(1) + lode * (k - static_cast<T>(1)));
  }
};

/// Finds strength, slope and theta at the Lode angle of the direction -b.
template <class T>
inline __attribute__((always_inline)) void find_surface(Group<T>& group, const Register<T> (&b)[6], Register<T> bt) {
  const Extremes<T> extremes(b, bt);
  const Register<T> lode = load(group.lode), sine = load(group.sine), dilation = load(group.dilation);
  const Register<T> factor = static_cast<T>(1.4142135623730951) * extremes.per_shear(sine, lode);
  store(group.strength, factor * load(group.cohesion));
  store(group.slope, static_cast<T>(kOverRoot3) * factor * sine);
  store(group.theta,
        static_cast<T>(0.816496580927726) * load(group.dilates) * dilation * extremes.per_shear(dilation, lode));
}

/// Finds the slope of mu(I) at the rate that follows from |b_T|, own_t and r_N.
template <class T>
inline __attribute__((always_inline)) void find_slope_at_rate(Group<T>& group, Register<T> bt, Register<T> own_t,
                                                              Register<T> rn) {
  constexpr T kRoot2 = static_cast<T>(1.4142135623730951);
  const Register<T> none{}, still = all<T>(kStill<T>), pressed = largest<T>(rn, still),
                            over_t = static_cast<T>(1) / own_t;
  const Register<T> p = static_cast<T>(kOverRoot3) * pressed, rise = kRoot2 * group.friction_rise * p;
  const Register<T> least = kRoot2 * load(group.sine) * p;
  const Register<T> b = static_cast<T>(kOverRoot2) * group.reference_rate * square_root<T>(p);
  // G y^2 + (G b + rise - S) y - S b = 0, S the excess over the strength at rest and G = 1 / own_t, y the rate.
  const Register<T> excess = largest<T>(none, bt * over_t - least);
  const Register<T> half = over_t * b + rise - excess;
  const Register<T> both = square_root<T>(half * half + static_cast<T>(4) * over_t * excess * b);
  // Two forms of the same root, each without a difference of large numbers where it is used.
  const Register<T> y = half > none ? static_cast<T>(2) * excess * b / largest<T>(both + half, still)
                                    : static_cast<T>(0.5) * own_t * (both - half);
  store(group.slope, (least + rise * y / largest<T>(y + b, still)) / pressed);
}

template <class T>
Register<T> length(const Register<T> (&b)[6]) {
  Register<T> sum = b[1] * b[1] + b[2] * b[2];
  for (int k = 3; k < 6; ++k) sum += b[k] * b[k];
  return square_root<T>(sum);
}

/// The stress r for which e = w r + b, with the law; `bt`: |b_T|.
template <class T>
inline __attribute__((always_inline)) void solve(const Group<T>& group, Register<T> own_n, Register<T> own_t,
                                                 Register<T> theta, const Register<T> (&b)[6], Register<T> bt,
                                                 Register<T> (&r)[6]) {
  const Register<T> strength = load(group.strength), slope = load(group.slope), none{}, still = all<T>(kStill<T>);
  const Register<T> over_n = static_cast<T>(1) / own_n, over_t = static_cast<T>(1) / own_t;
  const Register<T> apex = slope > none ? -strength / largest<T>(slope, still) : load(group.least);
  const Register<T> least = largest<T>(apex, load(group.least));
  const Register<T> alone = -b[0] * over_n;           // r_N if the volume stays
  const Register<T> kept = strength + slope * alone;  // and what it bears then
  const Register<T> base = kept + slope * theta * over_n * bt;
  const Register<T> excess = bt - kept * own_t;
  const Truth<T> slides = excess > none, parts = slides && (base <= none);
  // s = 1 / (own_t + alpha) with alpha = excess / base.
  const Register<T> part = base / largest<T>(own_t * base + excess, still);
  const Register<T> slid = alone + theta * over_n * bt * (static_cast<T>(1) - own_t * part);
  Register<T> s = slides ? part : over_t;
  Register<T> rn = slides ? slid : alone;
  const Truth<T> limited = parts || (rn < least);
  const Register<T> most = largest<T>(none, strength + slope * least);
  const Register<T> short_s = least_of<T>(over_t, most / largest<T>(bt, still));
  rn = limited ? least : rn;
  s = limited ? short_s : s;
  r[0] = rn;
  for (int k = 1; k < 6; ++k) r[k] = -s * b[k];
}

template <class T>
void project(Group<T>& group) {
  Register<T> b[6], r[6];
  for (int k = 0; k < 6; ++k) b[k] = -load(group.stress[k]);
  const Register<T> bt = length<T>(b);
  find_surface(group, b, bt);
  // The rate of the last step is not known here: it may have had any.
  if (group.friction_rise > T(0)) {
    constexpr double kSlope = 1.4142135623730951 * kOverRoot3;
    store(group.slope, static_cast<T>(kSlope) * (load(group.sine) + group.friction_rise));
  }
  solve(group, all<T>(1), all<T>(1), Register<T>{}, b, bt, r);
  for (int k = 0; k < 6; ++k) store(group.stress[k], r[k]);
}

}  // namespace mpm::soil
