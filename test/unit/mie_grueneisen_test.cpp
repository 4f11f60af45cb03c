// Mie-Grueneisen pressure: its Hugoniot, tension, the isentrope, and compression past the pole of its formula.
// Constants: Nairn & Guilkey (2015), Table I.
#include "mpm/material/mie_grueneisen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mpm {
namespace mie_grueneisen_test {

struct Metal {
  const char* name;
  double density;  // [kg/m^3]
  MieGrueneisenDefinition constants;
};
const std::vector<Metal> kMetals = {{"tungsten", 17600.0, {3980.0, 1.24, 1.54}},
                                    {"steel", 7850.0, {3574.0, 1.92, 1.69}}};

/// rho0 C0^2 [Pa]
double stiffness(const Metal& metal) {
  return metal.density * metal.constants.sound_speed * metal.constants.sound_speed;
}
double hugoniot(const Metal& metal, double eta) {
  return stiffness(metal) * eta / std::pow(1.0 - metal.constants.hugoniot_slope * eta, 2.0);
}

TEST(MieGrueneisen, GivesTheHugoniotBack) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    for (double part = 0.05; part < 0.8; part += 0.05) {
      const double eta = part / metal.constants.hugoniot_slope, expected = hugoniot(metal, eta);
      const double energy = expected * eta / (2.0 * metal.density);
      EXPECT_NEAR(eos.pressure(1.0 - eta, energy), expected, 1e-12 * expected)
          << metal.name << ' ' << eta;  // round-off
    }
  }
}

// exact-solutions 17: tungsten into steel at 1.70 km/s gives an interface velocity of 1.10500 km/s and 49.405 GPa.
TEST(MieGrueneisen, HasTheShockOfTungstenIntoSteel) {
  const double speeds[] = {1700.0 - 1105.0,
                           1105.0};  // speed of the material behind the shock, in tungsten and in steel
  for (std::size_t k = 0; k < 2; ++k) {
    const Metal& metal = kMetals[k];
    const double shock = metal.constants.sound_speed + metal.constants.hugoniot_slope * speeds[k];
    const double eta = speeds[k] / shock;
    const double pressure =
        MieGrueneisen(metal.constants, metal.density).pressure(1.0 - eta, 0.5 * speeds[k] * speeds[k]);  // e = u_p^2/2
    EXPECT_NEAR(pressure, 49.405e9, 0.001e9) << metal.name;  // the digits quoted
  }
}

TEST(MieGrueneisen, IsLinearInTension) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    for (const double j : {1.0, 1.01, 1.3, 4.0}) {
      const double expected = stiffness(metal) * (1.0 - j) + metal.constants.gamma0 * metal.density * 2e4;
      EXPECT_NEAR(eos.pressure(j, 2e4), expected, 1e-12 * stiffness(metal)) << metal.name << ' ' << j;  // round-off
    }
  }
}

/// Pressure at eta on the isentrope from rest [Pa]: dp/d(eta) = p_c' + gamma0 p with p_c = p at e = 0, by Runge-Kutta's
/// fourth order; p_c' = rho0 C0^2 (1 + (S - gamma0) eta) / (1 - S eta)^3, or rho0 C0^2 in tension.
double isentrope(const Metal& metal, double eta) {
  const double s = metal.constants.hugoniot_slope, gamma = metal.constants.gamma0;
  const auto slope = [&](double x, double p) {
    const double cold = x < 0.0 ? 1.0 : (1.0 + (s - gamma) * x) / std::pow(1.0 - s * x, 3.0);
    return stiffness(metal) * cold + gamma * p;
  };
  constexpr int kSteps = 2000;
  const double h = eta / kSteps;
  double p = 0.0;
  for (int n = 0; n < kSteps; ++n) {
    const double x = n * h;
    const double a = slope(x, p), b = slope(x + 0.5 * h, p + 0.5 * h * a), c = slope(x + 0.5 * h, p + 0.5 * h * b);
    p += h / 6.0 * (a + 2.0 * b + 2.0 * c + slope(x + h, p + h * c));
  }
  return p;
}

struct State {
  double pressure = 0.0, energy = 0.0;
};
State followed(const MieGrueneisen& eos, double from, double to, int steps, State state) {
  const auto at = [&](int n) { return from + (to - from) * n / steps; };
  for (int n = 0; n < steps; ++n) eos.advance(at(n), at(n + 1), 0.0, state.pressure, state.energy);
  return state;
}

TEST(MieGrueneisen, FollowsTheIsentropeToSecondOrder) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    for (const double eta : {0.3, -0.2}) {
      const double expected = isentrope(metal, eta);
      const double coarse = followed(eos, 1.0, 1.0 - eta, 100, {}).pressure - expected;
      const double fine = followed(eos, 1.0, 1.0 - eta, 200, {}).pressure - expected;
      EXPECT_LT(std::abs(fine), 1e-4 * std::abs(expected)) << metal.name << ' ' << eta;  // (0.3/200)^2, a factor 40
      EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.01) << metal.name << ' ' << eta;
    }
  }
}

// The trapezoidal rule is reversible, so a cycle leaves no residue.
TEST(MieGrueneisen, ClosesACycle) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    State state = followed(eos, 1.0, 0.7, 50, {});
    const double most = state.pressure;
    state = followed(eos, 0.7, 1.2, 80, state);
    state = followed(eos, 1.2, 0.7, 80, state);
    EXPECT_NEAR(state.pressure, most, 1e-12 * most);  // round-off of 160 steps
    state = followed(eos, 0.7, 1.0, 50, state);
    EXPECT_NEAR(state.pressure, 0.0, 1e-12 * most) << metal.name;
    EXPECT_NEAR(state.energy, 0.0, 1e-12 * most / metal.density) << metal.name;
  }
}

// At constant volume all heat becomes pressure: dp = gamma0 rho0 de. At constant pressure it is divided.
TEST(MieGrueneisen, IsPressedByHeat) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    State state = followed(eos, 1.0, 0.9, 10, {});
    const State before = state;
    eos.advance(0.9, 0.9, 1e5, state.pressure, state.energy);
    const double gained = metal.constants.gamma0 * metal.density * 1e5;
    EXPECT_NEAR(state.pressure - before.pressure, gained, 1e-12 * before.pressure);
    EXPECT_NEAR(state.energy - before.energy, 1e5, 1e-12 * state.energy);
    // First law over a step with heat and a change of volume, with the mean of the pressures at its ends.
    const State hot = state;
    eos.advance(0.9, 0.93, 2e5, state.pressure, state.energy);
    const double work = 0.5 * (hot.pressure + state.pressure) * 0.03 / metal.density;
    EXPECT_NEAR(state.energy - hot.energy, 2e5 - work, 1e-12 * hot.energy);
    EXPECT_NEAR(eos.pressure(0.93, state.energy), state.pressure, 1e-12 * hot.pressure);
    EXPECT_NEAR(eos.energy(0.93, state.pressure), state.energy, 1e-11 * stiffness(metal) / metal.density);
  }
}

TEST(MieGrueneisen, WarmsAlongTheIsentrope) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    // dT/T = -gamma0 dJ: the same in one step and in two.
    EXPECT_NEAR(eos.isentropic_heating(1.0, 0.8), std::exp(0.2 * metal.constants.gamma0), 1e-15);
    EXPECT_NEAR(eos.isentropic_heating(1.0, 0.9) * eos.isentropic_heating(0.9, 0.8), eos.isentropic_heating(1.0, 0.8),
                1e-15);
  }
}

TEST(MieGrueneisen, BulkModulusIsThatOfTheIsentrope) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    const double pole = 1.0 - 1.0 / metal.constants.hugoniot_slope;
    for (const double j : {0.7, 0.9, 0.99, 1.05, 1.3, 0.5 * pole}) {  // the last one is past the formula
      const State state = followed(eos, 1.0, j, 1000, {});
      constexpr double h = 1e-6;
      State up = state, down = state;
      eos.advance(j, j + h, 0.0, up.pressure, up.energy);
      eos.advance(j, j - h, 0.0, down.pressure, down.energy);
      const double expected = -j * (up.pressure - down.pressure) / (2.0 * h);
      EXPECT_NEAR(eos.bulk(j, state.pressure), expected, 1e-7 * expected) << metal.name << ' ' << j;  // 1e-16 p/(h K)
    }
    EXPECT_EQ(eos.bulk(3.0, -stiffness(metal)),
              0.0);  // gamma0 p is larger than the stiffness: the speed is zero, not imaginary
  }
}

TEST(MieGrueneisen, GoesOnStraightBeyondItsFormula) {
  for (const Metal& metal : kMetals) {
    const MieGrueneisen eos(metal.constants, metal.density);
    const double end = MieGrueneisen::kLargestCompression / metal.constants.hugoniot_slope, h = 1e-5;
    const auto cold = [&](double eta) { return eos.pressure(1.0 - eta, 0.0); };
    // By hand, at S eta = 0.8: (1 - 0.8)^-2 = 25.
    const double expected = stiffness(metal) * end * (1.0 - 0.5 * metal.constants.gamma0 * end) * 25.0;
    EXPECT_NEAR(cold(end), expected, 1e-12 * expected);
    const double before = (cold(end) - cold(end - h)) / h, after = (cold(end + h) - cold(end)) / h;
    // The backward difference is too small by half of h times the curvature, at most 3 S / 0.2 of the slope.
    EXPECT_NEAR(before, after, 20.0 * h * metal.constants.hugoniot_slope * after);
    EXPECT_NEAR((cold(1.0) - cold(end)) / (1.0 - end), after, 1e-8 * after);  // round-off of a difference over h
    for (const double j : {1e-300, 1e-6, 0.01, 0.1, 0.479, 0.48, 0.5, 1.0, 10.0, 1e6}) {
      for (const double energy : {-1e6, 0.0, 1e8}) {
        const double pressure = eos.pressure(j, energy);
        EXPECT_TRUE(std::isfinite(pressure)) << j;
        EXPECT_TRUE(std::isfinite(eos.bulk(j, pressure)) && eos.bulk(j, pressure) >= 0.0) << j;
      }
    }
  }
}

}  // namespace mie_grueneisen_test
}  // namespace mpm
