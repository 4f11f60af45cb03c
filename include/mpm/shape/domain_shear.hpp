// The shear of a particle's domain, and its limit. Gradients of CPDI are differences between corners over the height of
// a domain. Corners of a domain that leans lie cells apart, where a hat is no longer linear between them, and what is
// left of it is divided by the height. So the longest stable step falls with the shear, which no speed of waves shows:
// from 1.5 times the step in which a wave crosses a cell (simple shear of 2, four particles a cell) to 0.48 (4), 0.34
// (6), 0.17 (10) and less for what a tool tears into threads, where runs blew up within ten steps. Points of qCPDI lose
// as much three times later. Stretch alone does not matter, however thin a domain gets.
//
// A domain that leans too far is set up until it leans by the limit. It keeps its longest edge and its volume, and
// changes continuously with F. The sums that a shape function must have are those of any parallelogram.
// Weak: beyond the limit domains do not tile a body that is sheared evenly, which pushes particles about. How far a
// domain leans depends on how its box lies: at 45 degrees to the shear half as much leans as far.
#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace mpm {

/// Largest shear of a domain: how far it leans over its longest edge, over its height. A larger one would cost all of a
/// run steps as short as the most torn of its particles asks for; at 6 the domains of a body in even simple shear, at
/// 30 degrees to the grid, ceased to tile from 4.3 on.
constexpr double kDomainShear = 9.0;

/// Part of a cell that a wave may cross in a step with CPDI's domains of this shear, at most `cfl`. What is stable was
/// measured as 1.5 / shear or more, for the longest domains; a step may exceed its limit by a factor of sqrt(2) before
/// it is shortened (simulation/advance.cpp). Up to a shear of 3 a part of 0.5 is stable.
inline double courant_of_shear(double cfl, double shear) {
  const double most = 1.06 / shear;
  return shear > 3.0 && most < cfl ? most : cfl;
}

/// Squares of the product of a domain's edges, and of its volume: the first is 1 + s^2 times the second at a shear s.
/// `d`: half vectors (shape/particle_domain.hpp) [cells], of which it does not matter which axis is which.
template <class T, int Dim>
std::pair<T, T> squared_edges_and_volume(const T (&d)[Dim][Dim]) {
  static_assert(2 <= Dim && Dim <= 3, "a domain that can be sheared");
  T edges(1.0), volume(0.0);
  for (const auto& vector : d) {
    T square(0.0);
    for (const T& component : vector) square += component * component;
    edges = edges * square;
  }
  if constexpr (Dim == 2) {
    volume = d[0][0] * d[1][1] - d[0][1] * d[1][0];
  } else {
    volume = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) + d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  }
  return {edges, volume * volume};
}

/// True of a domain that leans beyond the limit (a truth value, or one a lane), false of one that is not finite.
template <class T, int Dim>
auto leans_too_far(const T (&d)[Dim][Dim]) {
  const auto [edges, volume] = squared_edges_and_volume(d);
  return edges > volume * T(1.0 + kDomainShear * kDomainShear);
}

/// Sets up a domain that leans too far. Its second edge leans over the longest by b times its height, its third over
/// both by c. What remains of both is the part t with (1 + t^2 b^2) (1 + t^2 c^2) = 1 + kDomainShear^2.
template <int Dim>
void set_up(double (&d)[Dim][Dim]) {
  using Vector = std::array<double, Dim>;
  const auto dot = [](const Vector& a, const Vector& b) {
    double sum = 0.0;
    for (int c = 0; c < Dim; ++c) sum += a[c] * b[c];
    return sum;
  };
  std::array<Vector, Dim> edge, upright;
  std::array<int, Dim> order{};  // the longest edge first
  for (int k = 0; k < Dim; ++k) {
    for (int c = 0; c < Dim; ++c) edge[k][c] = d[k][c];
    order[k] = k;
    for (int i = k; i > 0 && dot(edge[order[i]], edge[order[i]]) > dot(edge[order[i - 1]], edge[order[i - 1]]); --i) {
      std::swap(order[i], order[i - 1]);
    }
  }
  double sum = 0.0, product = 1.0;  // sum and product of b^2 and c^2
  for (int n = 0; n < Dim; ++n) {
    const Vector& own = edge[order[n]];
    Vector& height = upright[n] = own;
    for (int k = 0; k < n; ++k) {
      const double along = dot(own, upright[k]) / dot(upright[k], upright[k]);
      for (int c = 0; c < Dim; ++c) height[c] -= along * upright[k][c];
    }
    if (n == 0) continue;
    const double lean = dot(own, own) / dot(height, height) - 1.0;
    sum += lean;
    product *= lean;
  }
  if (Dim == 2) product = 0.0;
  constexpr double kWanted = kDomainShear * kDomainShear;
  const double part = std::sqrt(2.0 * kWanted / (sum + std::sqrt(sum * sum + 4.0 * product * kWanted)));
  for (int n = 1; n < Dim; ++n) {
    for (int c = 0; c < Dim; ++c) d[order[n]][c] = upright[n][c] + part * (edge[order[n]][c] - upright[n][c]);
  }
}

}  // namespace mpm
