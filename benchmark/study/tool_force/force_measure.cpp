#include "study/tool_force/force_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace mpm::study::tool_force {
namespace {

constexpr int kLooks = 5;            ///< at pressure, spread over the stretch of the mean
constexpr std::size_t kFewest = 3;   ///< particles of a cell whose scatter counts
constexpr double kNothing = 0.01;    ///< part of the mean pressure: a particle that carries none
constexpr std::size_t kCurve = 200;  ///< points of a curve

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

void PressureScatter::add(const std::vector<Vec3>& places, const std::vector<double>& pressure, double cell) {
  std::map<std::array<long, 3>, std::vector<double>> cells;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::array<long, 3> index;
    for (int axis = 0; axis < 3; ++axis) index[axis] = std::lround(std::floor(places[i][axis] / cell));
    cells[index].push_back(pressure[i]);
  }
  if (places.empty()) return;
  for (const auto& entry : cells) {
    const std::vector<double>& values = entry.second;
    if (values.size() < kFewest) continue;
    const double middle = mean(values);
    double squares = 0.0;
    for (const double value : values) squares += (value - middle) * (value - middle);
    deviations_ += std::sqrt(squares / static_cast<double>(values.size()));
    means_ += middle;
  }
  const double limit = kNothing * mean(pressure);
  unloaded_ +=
      static_cast<double>(std::count_if(pressure.begin(), pressure.end(), [limit](double p) { return p < limit; }));
  particles_ += static_cast<double>(pressure.size());
}

double ripple(const std::vector<double>& travel, const std::vector<double>& force, double from, double stretch) {
  constexpr int kParts = 10;
  std::vector<double> sums(kParts, 0.0), counts(kParts, 0.0);
  for (std::size_t i = 0; i < travel.size(); ++i) {
    const double part = (travel[i] - from) / stretch * kParts;
    if (part < 0.0 || part >= kParts) continue;
    sums[static_cast<int>(part)] += force[i];
    counts[static_cast<int>(part)] += 1.0;
  }
  if (std::find(counts.begin(), counts.end(), 0.0) != counts.end()) return kUnknown;
  double middle = 0.0, slope = 0.0, squares = 0.0;
  for (int k = 0; k < kParts; ++k) middle += sums[k] / counts[k] / kParts;
  for (int k = 0; k < kParts; ++k) {
    const double place = k - 0.5 * (kParts - 1);
    slope += place * sums[k] / counts[k];
    squares += place * place;
  }
  slope /= squares;
  double least = 0.0, most = 0.0;
  for (int k = 0; k < kParts; ++k) {
    const double rest = sums[k] / counts[k] - middle - slope * (k - 0.5 * (kParts - 1));
    least = std::min(least, rest);
    most = std::max(most, rest);
  }
  return 0.5 * (most - least) / std::abs(middle);
}

ForceMeasure::ForceMeasure(const Problem& problem, double cells)
    : problem_(problem), cells_(cells), next_scatter_(problem.from) {}

void ForceMeasure::look(Simulation& simulation) {
  const double place = simulation.rigid_body(0).pose().position.dot(problem_.push);
  const Vec3 force = simulation.take_contact(0).mean.force;
  if (!begun_) {
    start_ = place;
    begun_ = true;
    return;
  }
  travel_.push_back(std::abs(place - start_) / problem_.length);
  const double scale = problem_.whole / (problem_.grows ? travel_.back() : 1.0);
  force_.push_back(-scale * force.dot(problem_.push));
  lift_.push_back(scale * force.dot(problem_.free));
  check_speed(simulation, problem_.wave_speed, values_);
  if (travel_.back() >= next_scatter_ && next_scatter_ <= problem_.to) look_at_particles(simulation);
}

void ForceMeasure::look_at_particles(const Simulation& simulation) {
  next_scatter_ += (problem_.to - problem_.from) / (kLooks - 1);
  places_.assign(simulation.particles(), Vec3::Zero());
  for (const int axis : axes_of(simulation.definition().geometry)) {
    simulation.particle_field(std::string(1, "xyz"[axis]), values_);
    for (std::size_t i = 0; i < values_.size(); ++i) places_[i][axis] = values_[i];
  }
  simulation.particle_field("p", values_);
  const Vec3 origin = simulation.rigid_body(0).pose().position;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vec3 from_tool = places_[i] - origin;
    if ((from_tool.array() < problem_.pressed.min.array()).any()) continue;
    if ((from_tool.array() > problem_.pressed.max.array()).any()) continue;
    places_[chosen] = places_[i] - simulation.definition().grid.min;  // cells are the grid's
    values_[chosen++] = values_[i];
  }
  places_.resize(chosen);
  values_.resize(chosen);
  scatter_.add(places_, values_, simulation.definition().grid.cell.x());
}

void ForceMeasure::report(ForceRow& row) const {
  double force = 0.0, lift = 0.0, count = 0.0;
  for (std::size_t i = 0; i < travel_.size(); ++i) {
    if (travel_[i] < problem_.from || travel_[i] > problem_.to) continue;
    force += force_[i];
    lift += lift_[i];
    count += 1.0;
  }
  if (count > 0.0) {
    compare(force / count, row);
    if (problem_.free.norm() > 0.0) row.lift = lift / force;
  }
  if (problem_.moves_on) row.ripple = ripple(travel_, force_, problem_.from, 1.0 / cells_);
  row.scatter = scatter_.scatter();
  row.unloaded = scatter_.unloaded();
  const std::size_t stride = 1 + travel_.size() / kCurve;
  for (std::size_t first = 0; first + stride <= travel_.size(); first += stride) {
    double way = 0.0, sum = 0.0;
    for (std::size_t i = first; i < first + stride; ++i) {
      way += travel_[i];
      sum += force_[i];
    }
    row.curve.emplace_back(way / static_cast<double>(stride), sum / static_cast<double>(stride) / row.answer.upper);
  }
}

}  // namespace mpm::study::tool_force
