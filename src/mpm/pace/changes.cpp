#include "mpm/pace/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mpm/math/dimension.hpp"
#include "mpm/rules/method_rules.hpp"

namespace mpm::pace {

namespace {

// The least of doc/performance.md, "Whole scenes", over scenes and instruction sets, avx512 and avx2.
constexpr double kThreadsFactor = 1.2;  ///< two over one
constexpr double kSingleFactor = 1.4;   ///< single precision over double
constexpr double kUsfFactor = 1.3;      ///< USF over USAVG
constexpr const char* kTable = "doc/performance.md";
constexpr const char* kArithmetic = "number of steps";

constexpr double kWorthwhile = 1.03;  ///< less is none
constexpr double kMostCoarse = 2.0;   ///< times the cell
constexpr double kCellGrain = 0.05;   ///< by which a cell is tried larger and larger

/// Steps in a sync period, not rounded, and what a step costs over what it costs now.
struct Pace {
  double steps;
  double step_cost = 1.0;
  double cost() const { return std::max(1.0, std::ceil(steps - 1e-9)) * step_cost; }
};

/// A change with what it does to a run; the cell is chosen as large as is needed.
class Option {
 public:
  Option(Change change, double steps, double step_cost)
      : change(std::move(change)), steps_(steps), step_cost_(step_cost) {}
  virtual ~Option() = default;
  virtual Pace apply(Pace pace, double) { return {pace.steps * steps_, pace.step_cost * step_cost_}; }
  Change change;

 private:
  double steps_, step_cost_;
};

/// A larger cell; the least that reaches what is wanted. Steps are fewer with it unless the scene `holds` them.
class Coarser final : public Option {
 public:
  Coarser(const SimulationDefinition& definition, bool holds, Change given)
      : Option(std::move(given), 1.0, 1.0),
        dim_(dimensions(definition.geometry)),
        holds_(holds),
        cell_(definition.grid.cell.x()) {}
  Pace apply(Pace pace, double most) override {
    Pace coarse = pace;
    double times = 1.0;
    do {
      times = std::min(kMostCoarse, times + kCellGrain);
      coarse = {holds_ ? pace.steps : pace.steps / times, pace.step_cost / std::pow(times, dim_)};
    } while (coarse.cost() > most && times < kMostCoarse);
    change.what = fmt::format("grid.cell={:.3g}", times * cell_);
    change.factor = pace.cost() / coarse.cost();
    return coarse;
  }

 private:
  int dim_;
  bool holds_;
  double cell_;  // along x [m]
};

using Options = std::vector<std::unique_ptr<Option>>;

void add(Options& options, const std::string& what, double factor, const char* origin, const char* price) {
  if (factor < kWorthwhile) return;
  options.push_back(std::make_unique<Option>(Change{what, factor, origin, price}, 1.0, 1.0 / factor));
}

const char* origin_of(const std::optional<double>& timed) { return timed ? "timed on this scene" : kTable; }

bool allowed(const SimulationDefinition& definition, Precision precision, UpdateScheme update) {
  MethodDefinition method = definition.method;
  method.precision = precision;
  method.update = update;
  return !method_fault(method, definition.geometry);
}

/// The largest cfl that is proposed: below the largest stable one, but not below 0.7, which no transfer forbids.
double most_cfl(const MethodDefinition& method) { return stable_cfl(method.transfer) < 1.0 ? 0.7 : 0.9; }

Options options_of(const SimulationDefinition& definition, const Forecast& forecast, double steps, int threads,
                   const TimedFactors& timed) {
  const MethodDefinition& method = definition.method;
  Options options;
  if (threads > forecast.threads) {
    add(options, fmt::format("threads={}", threads), timed.threads.value_or(kThreadsFactor), origin_of(timed.threads),
        "nothing: the same bits");
  }
  if (method.precision == Precision::float64 && allowed(definition, Precision::float32, method.update)) {
    add(options, "method.precision=single", timed.single.value_or(kSingleFactor), origin_of(timed.single),
        "momentum balances to 1e-7 in place of 1e-10");
  }
  const double cfl = definition.time.cfl, most = most_cfl(method);
  const double dt = 1.0 / forecast.cost.steps_per_second;
  const bool holds = definition.time.step && dt > 0.9 * *definition.time.step;
  const double fewer = Pace{steps}.cost() / Pace{steps * cfl / most}.cost();
  if (cfl < most && !holds && fewer >= kWorthwhile) {
    options.push_back(std::make_unique<Option>(
        Change{fmt::format("time.cfl={:g}", most), fewer, kArithmetic, "margin to the largest stable step"}, cfl / most,
        1.0));
  }
  if (method.update == UpdateScheme::usavg && allowed(definition, method.precision, UpdateScheme::usf)) {
    add(options, "method.update=usf", timed.usf.value_or(kUsfFactor), origin_of(timed.usf),
        "an error of first order in the time step (doc/methods.md)");
  }
  const int dim = dimensions(definition.geometry), along = method.particles_per_direction;
  constexpr int kFewest = 2;
  if (along > kFewest) {
    add(options, fmt::format("method.particles_per_cell={:g}", std::pow(kFewest, dim)),
        std::pow(static_cast<double>(along) / kFewest, dim), "number of particles",
        "noise where particles cross cells");
  }
  options.push_back(std::make_unique<Coarser>(
      definition, holds,
      Change{"", 1.0, "particles and steps", "resolution: fewer cells across what moves (doc/methods.md)"}));
  return options;
}

/// The pace with all that are `used`.
double cost_with(const Options& options, const std::vector<bool>& used, double steps, double most) {
  Pace pace{steps};
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (used[i]) pace = options[i]->apply(pace, most);
  }
  return pace.cost();
}

}  // namespace

Plan make_plan(const SimulationDefinition& definition, const Forecast& forecast, double wanted, int threads,
               const TimedFactors& timed) {
  Plan plan;
  plan.wanted = wanted;
  const double now = forecast.real_time_factor();
  const double steps = forecast.cost.steps_per_second * kNanosecond * static_cast<double>(definition.time.sync);
  const Pace today{steps};
  plan.reaches = now;
  if (plan.enough()) return plan;
  const double most = today.cost() * now / wanted;  // that a sync period may cost
  const Options options = options_of(definition, forecast, steps, threads, timed);
  for (const auto& option : options) {
    option->apply(today, most);
    plan.changes.push_back(option->change);
  }
  std::vector<bool> used(options.size(), false);
  for (std::size_t i = 0; i < options.size() && cost_with(options, used, steps, most) > most; ++i) used[i] = true;
  // Leaves out what is not needed beside the last one. The cell is the last, and then no wider than need be.
  for (std::size_t i = used.back() ? 0 : options.size(); i-- > 0;) {
    if (!used[i]) continue;
    used[i] = false;
    used[i] = cost_with(options, used, steps, most) > most;
  }
  plan.reaches = now * today.cost() / cost_with(options, used, steps, most);
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (used[i]) plan.together.push_back(options[i]->change);
  }
  return plan;
}

std::string plan_text(const Plan& plan) {
  std::string list;
  for (std::size_t i = 0; i < plan.together.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == plan.together.size() ? " and " : ", ") + plan.together[i].what;
  }
  const bool several = plan.together.size() > 1;
  return fmt::format("{}{} would reach {}{:.2g}", list, several ? " together" : "",
                     plan.enough() ? "" : "no more than ", plan.reaches);
}

std::string plan_table(const Plan& plan, const Forecast& forecast) {
  const double now = forecast.real_time_factor();
  std::size_t what = 0, origin = 0;
  for (const Change& change : plan.changes) {
    what = std::max(what, change.what.size());
    origin = std::max(origin, change.origin.size());
  }
  std::string text = fmt::format("  {:<{}}  {:>6}  {:>7}  {:<{}}  {}\n", "each alone", what, "faster", "reaches",
                                 "factor from", std::max<std::size_t>(origin, 11), "costs");
  for (const Change& change : plan.changes) {
    text += fmt::format("  {:<{}}  {:>6.2f}  {:>7.2g}  {:<{}}  {}\n", change.what, what, change.factor,
                        now * change.factor, change.origin, std::max<std::size_t>(origin, 11), change.price);
  }
  return text + "  " + plan_text(plan) + "\n";
}

}  // namespace mpm::pace
