#include "mpm/transport/heat_gains.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

int temperature_index(const Law& law) {
  return std::visit([](const auto& own) { return own.kTemperature; }, law);
}

PlasticHeat::PlasticHeat(std::vector<ParticleSet>& sets, std::vector<HeatOfSet> heat)
    : sets_(sets), heat_(std::move(heat)), booked_(sets.size(), 0) {
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const bool heats_itself = temperature_index(*heat_[s].law) >= 0;
    const int index = std::visit([](const auto& own) { return own.kPlasticWork; }, *heat_[s].law);
    work_.push_back(heats_itself || heat_[s].material.heat_fraction == 0.0 ? -1 : index);
    if (work_[s] >= 0) booked_[s] = sets_[s].bring("work_as_heat", "J/kg");
  }
}

bool PlasticHeat::any() const {
  return std::any_of(work_.begin(), work_.end(), [](int index) { return index >= 0; });
}

void PlasticHeat::take(int set, int first, int last, const double* value, double* gain) {
  const TransportMaterial& material = heat_[set].material;
  double* booked = sets_[set].brought[booked_[set]].values.data();
  sets_[set].history[work_[set]].visit([&](const auto& work) {
    for (int p = first; p < last; ++p) {
      const double now = static_cast<double>(work[p]);
      gain[p - first] += material.heat_fraction * (now - booked[p]) / material.capacity(value[p]);
      booked[p] = now;
    }
  });
}

CompressionHeat::CompressionHeat(std::vector<ParticleSet>& sets, GeometryKind geometry, std::vector<HeatOfSet> heat)
    : sets_(sets), geometry_(geometry), heat_(std::move(heat)), last_(sets.size(), 0) {
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    if (!acts_on(static_cast<int>(s))) continue;
    last_[s] = sets_[s].bring("heated_volume", "1");
    find_volume_ratios(sets_[s], geometry_, 0, sets_[s].size(), sets_[s].brought[last_[s]].values.data());
  }
}

void CompressionHeat::take(int set, int first, int last, const double* value, double* gain) {
  const HeatOfSet& heat = heat_[set];
  double* before = sets_[set].brought[last_[set]].values.data();
  for (int p = first; p < last; ++p) {
    double j = 1.0;
    find_volume_ratios(sets_[set], geometry_, p, p + 1, &j);
    const double rate = 3.0 * heat.bulk * heat.material.expansion / (heat.density * heat.material.capacity(value[p]));
    gain[p - first] += value[p] * std::expm1(rate * (before[p] - j));  // dT / T = -rate dJ
    before[p] = j;
  }
}

LawTemperature::LawTemperature(std::vector<ParticleSet>& sets, const std::vector<HeatOfSet>& heat) : sets_(sets) {
  for (const HeatOfSet& of : heat) {
    index_.push_back(temperature_index(*of.law));
    reference_.push_back(std::visit([](const auto& own) { return own.reference_temperature(); }, *of.law));
  }
}

void LawTemperature::take(int set, int first, int last, const double* value, double* gain) {
  for (int p = first; p < last; ++p) gain[p - first] += this->value(set, p) - value[p];
}

void LawTemperature::written(int set, int first, int last, const double* value) {
  ParticleScalar& excess = sets_[set].history[index_[set]];
  for (int p = first; p < last; ++p) excess.set(p, value[p] - reference_[set]);
}

}  // namespace mpm
