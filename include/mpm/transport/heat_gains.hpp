// Heat that arises in the material itself: the part of plastic work that becomes heat (Taylor and Quinney's), the heat
// of compression, and the temperature that a law has of its own.
//
//   plastic work    dT = beta dW / C_v, W by mass, as the law books it
//   compression     dT = -3 K alpha T dJ / (rho0 C_v), GIMP notes (6.35), (6.36) with M = 3 K alpha I
//   own law         dT of history, for Johnson-Cook and ideal gas, which heat themselves; conduction is written back,
//                   so that there is one temperature and nothing is heated twice; stress follows at once, and what the
//                   law then stores is work on it
#pragma once

#include <vector>

#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/transport/local_gain.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {

/// Constants of each set.
struct HeatOfSet {
  const Law* law;
  TransportMaterial material;
  double density = 0.0;  ///< initial [kg/m^3]
  double bulk = 0.0;     ///< [Pa]; 0: the law has no constant bulk modulus
};

class PlasticHeat final : public LocalGain {
 public:
  /// Gives the sets a number to remember the work that has become heat.
  PlasticHeat(std::vector<ParticleSet>& sets, std::vector<HeatOfSet> heat);
  std::string name() const override { return "plastic work"; }
  bool acts_on(int set) const override { return work_[set] >= 0; }
  void take(int set, int first, int last, const double* value, double* gain) override;
  bool any() const;

 private:
  std::vector<ParticleSet>& sets_;
  std::vector<HeatOfSet> heat_;
  std::vector<int> work_;            ///< index in history; negative: none
  std::vector<std::size_t> booked_;  ///< place in ParticleSet::brought
};

class CompressionHeat final : public LocalGain {
 public:
  CompressionHeat(std::vector<ParticleSet>& sets, GeometryKind geometry, std::vector<HeatOfSet> heat);
  std::string name() const override { return "compression"; }
  bool acts_on(int set) const override { return heat_[set].bulk * heat_[set].material.expansion != 0.0; }
  void take(int set, int first, int last, const double* value, double* gain) override;

 private:
  std::vector<ParticleSet>& sets_;
  GeometryKind geometry_;
  std::vector<HeatOfSet> heat_;
  std::vector<std::size_t> last_;  ///< place of J at the last look in ParticleSet::brought
};

class LawTemperature final : public LocalGain {
 public:
  LawTemperature(std::vector<ParticleSet>& sets, GeometryKind geometry, const std::vector<HeatOfSet>& heat);
  std::string name() const override { return "law"; }
  bool acts_on(int set) const override { return index_[set] >= 0; }
  void take(int set, int first, int last, const double* value, double* gain) override;
  double written(int set, int first, int last, const double* value) override;
  bool gives_energy() const override { return true; }
  /// Temperature of a particle, as the law has it [K].
  double value(int set, int p) const { return sets_[set].history[index_[set]][p] + reference_[set]; }

 private:
  std::vector<ParticleSet>& sets_;
  GeometryKind geometry_;
  std::vector<const Law*> laws_;
  std::vector<int> index_;         ///< index of the temperature in history; negative: none
  std::vector<double> reference_;  ///< [K]
};

/// Index of a law's temperature in its history, or negative.
int temperature_index(const Law& law);

}  // namespace mpm
