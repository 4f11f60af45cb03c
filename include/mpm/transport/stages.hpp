// A diffusion equation c dT/dt = Q(T) on nodes over an update that may be longer than explicit steps allow: one stage
// of Euler's method where that is stable, else the Runge-Kutta-Legendre method of second order, whose s stages reach
// (s^2 + s - 2) / 4 stable steps: three stages 2.5, 9 stages 22, where as many short steps would cost 22.
//
// What is advanced is the content E that has come to each node, T = T_0 + E / c: then the content of all nodes grows by
// what the sources give, to round-off, also where values are held.
// Source: C. D. Meyer, D. S. Balsara, T. D. Aslam (2014), J. Comput. Phys. 257, 594-626, section 2.2 (RKL2).
#pragma once

#include <algorithm>
#include <cstddef>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/loop/loop.hpp"

namespace mpm {

/// Number of stages for an update of `ratio` stable steps: 1, or an odd number from 3 on, which damps the shortest
/// waves.
int stages_for(double ratio);
/// The same number for any ratio, to within 2.
double stages_needed(double ratio);

class Stages {
 public:
  explicit Stages(int nodes_per_block)
      : nodes_(nodes_per_block),
        flow_(1, nodes_per_block),
        first_(1, nodes_per_block),
        now_(1, nodes_per_block),
        before_(1, nodes_per_block),
        values_(1, nodes_per_block) {}

  /// `flow(value, to)` sets `to` to Q of the values [content/s], sources among it; `hold(value, part)` sets the values
  /// that are prescribed once this part of `dt` has gone by. `start`: T_0 of the nodes of `blocks` blocks, `capacity`:
  /// c; nodes that have `least` of it or less keep their value until the end. Sets `content` to E after `dt`.
  /// `between()` is called before each stage but the first; it may throw.
  template <class Flow, class Hold, class Between>
  void advance(int blocks, int threads, double dt, int stages, const NodalField& start, const NodalField& capacity,
               double least, Flow&& flow, Hold&& hold, NodalField& content, Between&& between);
  template <class Flow, class Hold>
  void advance(int blocks, int threads, double dt, int stages, const NodalField& start, const NodalField& capacity,
               double least, Flow&& flow, Hold&& hold, NodalField& content) {
    advance(blocks, threads, dt, stages, start, capacity, least, flow, hold, content, [] {});
  }

 private:
  /// b_j of the method.
  static double part(int j) {
    if (j < 2) return 1.0 / 3.0;
    return (static_cast<double>(j) * j + j - 2.0) / (2.0 * j * (j + 1.0));
  }

  int nodes_;  ///< nodes of a block
  NodalField flow_, first_, now_, before_, values_;
};

template <class Flow, class Hold, class Between>
void Stages::advance(int blocks, int threads, double dt, int stages, const NodalField& start,
                     const NodalField& capacity, double least, Flow&& flow, Hold&& hold, NodalField& content,
                     Between&& between) {
  const auto nodes = static_cast<std::ptrdiff_t>(blocks) * nodes_;
  content.resize(blocks);
  flow(start, stages == 1 ? content : first_);
  double* to = content.data();
  if (stages == 1) {
    for_all("transport: stages", threads, nodes, [=](std::ptrdiff_t i) { to[i] *= dt; });
    return;
  }
  now_.resize(blocks);
  before_.resize(blocks);
  values_.resize(blocks);
  const double whole = 4.0 / (static_cast<double>(stages) * stages + stages - 2.0);
  const double *from = start.block(0), *c = capacity.block(0), *q0 = first_.block(0);
  double *e1 = now_.data(), *e2 = before_.data(), *t = values_.data();
  for_all("transport: stages", threads, nodes, [&](std::ptrdiff_t i) {
    e2[i] = 0.0;
    e1[i] = part(1) * whole * dt * q0[i];
    t[i] = from[i] + (c[i] > least ? e1[i] / c[i] : 0.0);
  });
  for (int j = 2; j <= stages; ++j) {
    between();
    // The values are those of stage j - 1, at this part of the update.
    hold(values_, j == 2 ? part(1) * whole : 0.25 * ((j - 1.0) * (j - 1.0) + (j - 1.0) - 2.0) * whole);
    flow(values_, flow_);
    const double mu = (2.0 * j - 1.0) / j * part(j) / part(j - 1);
    const double nu = -(j - 1.0) / j * part(j) / part(j - 2);
    const double weight = mu * whole * dt, first = -(1.0 - part(j - 1)) * weight;
    const double* q = flow_.data();
    for_all("transport: stages", threads, nodes, [=](std::ptrdiff_t i) {
      const double next = mu * e1[i] + nu * e2[i] + weight * q[i] + first * q0[i];
      e2[i] = e1[i];
      e1[i] = next;
      t[i] = from[i] + (c[i] > least ? next / c[i] : 0.0);
    });
  }
  std::copy(e1, e1 + nodes, to);
}

}  // namespace mpm
