// Updates longer than one explicit step can take: the stages themselves on a chain of nodes, whose solution is known,
// and a slab of a good conductor.
//
// A chain of N cells with its ends held at 0 and the capacity c of each node has the modes sin(m pi i / N), which decay
// as exp(-a t), a = (4 k / c) sin^2(m pi / 2 N). Source: C. D. Meyer, D. S. Balsara, T. D. Aslam (2014), J. Comput.
// Phys. 257, 594-626: RKL2 is of second order, and stable up to (s^2 + s - 2) / 4 steps of 2 / (largest a).
#include <fmt/core.h>

#include "mpm/math/constants.hpp"
#include "mpm/transport/stages.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace transport_stages_test {

using mpm::kPi;
constexpr int kNodes = 33;                             // nodes of the chain, its ends held
constexpr double kCapacity = 2.0, kLink = 3.0;         // capacity of a node, and link between two
constexpr double kStable = kCapacity / (4.0 * kLink);  // half of the longest stable step, as (6.32)

struct Chain {
  std::vector<double> value;
  double given = 0.0;  ///< content that came to the nodes between, over that of the start
};

Chain advance(std::vector<double> value, double dt, int steps) {
  mpm::Stages stages(kNodes);
  mpm::NodalField start(1, kNodes), capacity(1, kNodes), content(1, kNodes);
  for (mpm::NodalField* one : {&start, &capacity, &content}) one->resize(1);
  for (int i = 0; i < kNodes; ++i) capacity.at(0, 0, i) = kCapacity;
  const auto flow = [](const mpm::NodalField& of, mpm::NodalField& to) {
    to.resize(1);
    for (int i = 0; i < kNodes; ++i) to.at(0, 0, i) = 0.0;
    for (int i = 0; i + 1 < kNodes; ++i) {
      const double q = kLink * (of.at(0, 0, i) - of.at(0, 0, i + 1));
      to.at(0, 0, i) -= q;
      to.at(0, 0, i + 1) += q;
    }
  };
  const auto hold = [](mpm::NodalField& of, auto...) { of.at(0, 0, 0) = of.at(0, 0, kNodes - 1) = 0.0; };
  Chain chain{std::move(value), 0.0};
  for (int n = 0; n < steps; ++n) {
    for (int i = 0; i < kNodes; ++i) start.at(0, 0, i) = chain.value[i];
    hold(start);
    stages.advance(1, 1, dt, mpm::stages_for(dt / kStable), start, capacity, 0.0, flow, hold, content);
    for (int i = 0; i < kNodes; ++i) {
      chain.value[i] = start.at(0, 0, i) + content.at(0, 0, i) / kCapacity;
      chain.given += content.at(0, 0, i);
    }
  }
  return chain;
}

std::vector<double> mode(int m) {
  std::vector<double> value;
  for (int i = 0; i < kNodes; ++i) value.push_back(std::sin(m * kPi * i / (kNodes - 1)));
  return value;
}

double rate(int m) { return 4.0 * kLink / kCapacity * std::pow(std::sin(0.5 * m * kPi / (kNodes - 1)), 2); }

TEST(TransportStages, AreOfSecondOrder) {
  Page page("transport", "transport_stages", "Stages of an update");
  page.problem(
          "A chain of 32 cells between ends that are held, in its second mode, over 160 times the step (6.32) that "
          "one stage can take, in 1 to 16 updates.")
      .exact("Each mode decays as exp(-at), a = (4k/c) sin²(mπ/2N).",
             "the difference equation; method: Meyer, Balsara, Aslam, J. Comput. Phys. 257 (2014)");
  const double whole = 160.0 * kStable, exact = std::exp(-rate(2) * whole);
  Numbers ratios, errors;
  for (const int steps : {1, 2, 4, 8, 16}) {
    const Chain chain = advance(mode(2), whole / steps, steps);
    ratios.push_back(160.0 / steps);
    errors.push_back(std::abs(chain.value[8] - exact));
  }
  page.report("order, updates of 80 to 40 steps of one stage", order_of_convergence(errors[1], errors[2]), "");
  for (std::size_t i = 3; i < errors.size(); ++i) {
    page.near(fmt::format("order, updates of {:.0f} to {:.0f} steps of one stage", ratios[i - 1], ratios[i]),
              order_of_convergence(errors[i - 1], errors[i]), 2.0, 0.1, "");
  }
  page.near("decay in 16 updates of 10 steps", advance(mode(2), 10.0 * kStable, 16).value[8], exact, 0.002, "");
  page.figure()
      .panel("Error of the mode", "update / step of one stage", "error")
      .log_x()
      .log_y()
      .order(2.0)
      .points("RKL2", ratios, errors);
  // The shortest wave that the chain has is damped in updates of any length.
  for (const double ratio : {2.0, 10.0, 60.0, 300.0}) {
    const Chain chain = advance(mode(kNodes - 2), ratio * kStable, 1);
    double most = 0.0;
    for (const double value : chain.value) most = std::max(most, std::abs(value));
    page.below(fmt::format("shortest wave after one update of {:.0f} steps", ratio), most, 1.0, "of the start");
  }
  page.meaning("An update may be as long as the mechanics wants: its stages are second order in time and stable.");
}

// A good conductor, whose step (6.32) is 1/20 and 1/5 of that of the mechanics, against steps that need no stages.
TEST(TransportStages, SlabOfAGoodConductor) {
  Page page("transport", "good_conductor", "A good conductor in the steps of the mechanics");
  page.problem(
          "The slab of the series in 20 cells, with the first mode sin(πx/L) at the start, in steps of the "
          "mechanics of 5 and 20 times the step (6.32), beside steps of a quarter of it.")
      .exact("T = sin(πx/L) exp(-π²Dt/L²), at D t / L² = 0.1.", "the heat equation")
      .scene("conduction_slab");
  const double stable = 0.0625;  // [s]: cell^2 / (4 D)
  const double end = 10.0;
  std::vector<double> middles;
  for (const double ratio : {0.25, 5.0, 20.0}) {
    mpm::Simulation simulation =
        start("conduction_slab",
              {"grid.cell=0.005", "transport.temperature.initial='sin(pi*x/0.1)'", "materials.slab.young=1e-6",
               "time.sync=1.25", fmt::format("time.step={:.17g}", ratio * stable)},
              1);
    run_until(simulation, end);
    expect_balance(simulation, "temperature");
    const Numbers x = field(simulation, "x"), t = field(simulation, "temperature");
    double with = 0.0, own = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      const double shape = std::sin(kPi * x[p] / 0.1);
      with += shape * t[p];
      own += shape * shape;
    }
    middles.push_back(with / own);
  }
  const double exact = std::exp(-kPi * kPi * 0.1);
  page.near("amplitude, steps of 1/4 of (6.32)", middles[0], exact, 0.005, "K");
  page.near("amplitude, 5 times (6.32)", middles[1], middles[0], 0.002, "K");
  page.near("amplitude, 20 times (6.32)", middles[2], middles[0], 0.002, "K");
  page.meaning("Stages give the answer of short steps, at the cost of two passes over particles and nodes each.");
}

}  // namespace transport_stages_test
}  // namespace verification
