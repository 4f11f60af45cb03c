#include "mpm/transport/heat_gains.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/math/dimension.hpp"

namespace mpm {
namespace {

/// A tensor of particles, to be written.
struct Stresses {
  struct Component {
    ParticleScalar& of;
    struct At {
      ParticleScalar& of;
      int p;
      void operator=(double value) const { of.set(p, value); }
    };
    At operator[](int p) const { return {of, p}; }
  };
  std::vector<ParticleScalar>& of;
  Component operator[](int c) const { return {of[c]}; }
};

/// Gives the law temperatures from outside; returns the energy that it then stores and did not before [J].
template <class OneLaw>
double write_temperatures(ParticleSet& set, const OneLaw& law, GeometryKind geometry, double reference, int first,
                          int last, const double* value) {
  if constexpr (OneLaw::kTemperature < 0) {
    return 0.0;
  } else {
    return with_geometry(geometry, [&](auto kind) {
      double sum = 0.0;
      for (int p = first; p < last; ++p) {
        const auto f = kind.load_matrix(set.f, p);
        const double j = determinant(f);
        const auto stored = [&] { return law.elastic_energy(f, full(kind.load_symmetric(set.tau, p)), j); };
        double history[OneLaw::kHistory];
        for (int h = 0; h < OneLaw::kHistory; ++h) history[h] = set.history[h][p];
        const double before = stored(), by = value[p] - reference - history[OneLaw::kTemperature];
        history[OneLaw::kTemperature] = value[p] - reference;
        const double pressed = law.warm(by, j, history);
        for (int h = 0; h < OneLaw::kHistory; ++h) set.history[h].set(p, history[h]);
        kind.store_symmetric(scale_shift(kind.load_symmetric(set.tau, p), 1.0, pressed), Stresses{set.tau}, p);
        sum += set.mass_of(p) * (stored() - before);
      }
      return sum;
    });
  }
}

}  // namespace

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

LawTemperature::LawTemperature(std::vector<ParticleSet>& sets, GeometryKind geometry,
                               const std::vector<HeatOfSet>& heat)
    : sets_(sets), geometry_(geometry) {
  for (const HeatOfSet& of : heat) {
    laws_.push_back(of.law);
    index_.push_back(temperature_index(*of.law));
    reference_.push_back(std::visit([](const auto& own) { return own.reference_temperature(); }, *of.law));
  }
}

void LawTemperature::take(int set, int first, int last, const double* value, double* gain) {
  for (int p = first; p < last; ++p) gain[p - first] += this->value(set, p) - value[p];
}

double LawTemperature::written(int set, int first, int last, const double* value) {
  ParticleSet& of = sets_[set];
  const double reference = reference_[set];
  return std::visit(
      [&](const auto& law) { return write_temperatures(of, law, geometry_, reference, first, last, value); },
      *laws_[set]);
}

}  // namespace mpm
