#include "study/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

#include "study/counted_work.hpp"

namespace mpm::study {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

choice::MethodChoice reference_method() {
  return choice::choose(ShapeKind::ugimp, UpdateScheme::usf, {TransferKind::flip, 1.0, 2});
}

SimulationDefinition define(const Suite& suite, const choice::MethodChoice& choice,
                            const Discretisation& discretisation) {
  SimulationDefinition definition = suite.definition(choice.method, discretisation);
  definition.method.particles_per_direction = discretisation.particles_per_direction;
  return definition;
}

}  // namespace

/// The definition without body forces, stepped for its time alone, and begun anew where the run ends.
class Runner::Twin {
 public:
  explicit Twin(SimulationDefinition definition) : definition_(std::move(definition)) {
    definition_.body_forces.clear();
    end_ = nanoseconds_of(definition_.time.end);
    advance();  // memory is allocated, caches are warm
  }

  /// Steps for at least `slice` [s] of processor time; that time a step.
  double seconds_per_step(double slice) {
    double spent = 0.0;
    std::uint64_t steps = 0;
    while (spent < slice || steps == 0) {
      const auto [time, count] = advance();
      spent += time;
      steps += count;
    }
    return spent / static_cast<double>(steps);
  }

 private:
  std::pair<double, std::uint64_t> advance() {
    if (!simulation_ || simulation_->time() >= end_) simulation_.emplace(definition_, SimulationOptions{1});
    const std::uint64_t before = simulation_->state().step.steps;
    const double start = processor_time();
    simulation_->advance();
    const double spent = processor_time() - start;
    return {spent, simulation_->state().step.steps - before};
  }

  SimulationDefinition definition_;
  std::int64_t end_ = 0;
  std::optional<Simulation> simulation_;
};

Runner::Runner(CostSettings settings) : settings_(settings) {}
Runner::~Runner() = default;

Cost Runner::cost(const Suite& suite, const choice::MethodChoice& choice, const Discretisation& discretisation) {
  // The Courant number is of no consequence for the cost of a step.
  const std::string place =
      fmt::format("{} {} {}", suite.name, discretisation.cells, discretisation.particles_per_direction);
  if (place != place_) {
    place_ = place;
    reference_.reset();
    costs_.clear();
  }
  const auto known = costs_.find(choice.label);
  if (known != costs_.end()) return known->second;
  Cost cost;
  try {
    if (!reference_) {
      reference_ = std::make_unique<Twin>(define(suite, reference_method(), discretisation));
      std::vector<double> seconds;
      for (int turn = 0; turn < 2 * settings_.turns; ++turn) {
        seconds.push_back(reference_->seconds_per_step(settings_.slice));
      }
      reference_seconds_ = median(seconds);
    }
    Twin twin(define(suite, choice, discretisation));
    std::vector<double> ratios;
    for (int turn = 0; turn < settings_.turns; ++turn) {
      const double reference = reference_->seconds_per_step(settings_.slice);
      ratios.push_back(twin.seconds_per_step(settings_.slice) / reference);
    }
    cost.relative = median(ratios);
    cost.seconds_per_step = cost.relative * reference_seconds_;
  } catch (const PhysicsError&) {
    reference_.reset();  // it may be the one that failed: what does so even without load has no cost to speak of
  }
  costs_[choice.label] = cost;
  return cost;
}

Row Runner::run(const Suite& suite, const choice::MethodChoice& choice, const Discretisation& discretisation) {
  const int dim = static_cast<int>(axes_of(suite.geometry).size());
  Row row;
  row.suite = suite.name;
  row.method = choice.label;
  row.shape = shape_name(choice.method.shape);
  row.update = kUpdateNames[static_cast<int>(choice.method.update)];
  row.transfer = choice::transfer_label(choice.method.transfer);
  row.precision = precision_name(choice.method.precision);
  row.geometry = geometry_name(suite.geometry);
  row.cells = discretisation.cells;
  row.particles_per_cell = static_cast<int>(std::lround(std::pow(discretisation.particles_per_direction, dim)));
  row.cfl = discretisation.cfl;
  row.error_measure = suite.measure_text;
  try {
    SimulationDefinition definition = define(suite, choice, discretisation);
    const std::int64_t end = nanoseconds_of(definition.time.end);
    Simulation simulation(std::move(definition), SimulationOptions{1});
    row.particles = simulation.particles();
    const std::unique_ptr<ErrorMeasure> measure = suite.measure();
    measure->look(simulation);
    while (simulation.time() < end) {
      simulation.advance();
      row.steps = simulation.state().step.steps;
      measure->look(simulation);
    }
    row.error = measure->error();
    row.status = "ok";
  } catch (const DefinitionError& error) {
    row.status = "refused";
    row.message = error.what();
  } catch (const PhysicsError& error) {
    row.status = "failed";
    row.message = error.what();
  }
  if (row.status == "refused") return row;
  const double particle_steps = static_cast<double>(row.particles) * static_cast<double>(row.steps);
  row.work = particle_steps * counted_work(choice.method, dim);
  const Cost measured = cost(suite, choice, discretisation);
  row.cpu_seconds = measured.seconds_per_step * static_cast<double>(row.steps);
  row.relative_cost = measured.relative;
  row.cost = measured.relative * particle_steps;
  return row;
}

}  // namespace mpm::study
