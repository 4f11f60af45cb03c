#include "study/measures.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::study {
namespace {

class DisplacementError final : public ErrorMeasure {
 public:
  DisplacementError(GeometryKind geometry, Motion motion, double length)
      : axes_(axes_of(geometry)), motion_(std::move(motion)), length_(length) {}

  void look(Simulation& simulation) override {
    const std::vector<Vec3> places = places_of(simulation);
    if (start_.empty()) start_ = places;
    const double time = seconds_of(simulation.time());
    double squares = 0.0;
    for (std::size_t p = 0; p < places.size(); ++p) squares += (places[p] - motion_(time, start_[p])).squaredNorm();
    worst_ = std::max(worst_, std::sqrt(squares / static_cast<double>(places.size())));
  }
  double error() const override { return worst_ / length_; }

 private:
  std::vector<Vec3> places_of(const Simulation& simulation) {
    std::vector<Vec3> places(simulation.particles(), Vec3::Zero());
    for (const int axis : axes_) {
      simulation.particle_field(std::string(1, "xyz"[axis]), values_);
      for (std::size_t p = 0; p < places.size(); ++p) places[p][axis] = values_[p];
    }
    return places;
  }

  std::vector<int> axes_;
  Motion motion_;
  double length_;
  std::vector<Vec3> start_;
  std::vector<double> values_;
  double worst_ = 0.0;
};

class EnergyDrift final : public ErrorMeasure {
 public:
  void look(Simulation& simulation) override {
    const double energy = simulation.state().energy.total();
    if (start_ == 0.0) start_ = energy;
    worst_ = std::max(worst_, std::abs(energy / start_ - 1.0));
  }
  double error() const override { return worst_; }

 private:
  double start_ = 0.0, worst_ = 0.0;
};

}  // namespace

std::unique_ptr<ErrorMeasure> displacement_error(GeometryKind geometry, Motion motion, double length) {
  return std::make_unique<DisplacementError>(geometry, std::move(motion), length);
}

std::unique_ptr<ErrorMeasure> energy_drift() { return std::make_unique<EnergyDrift>(); }

}  // namespace mpm::study
