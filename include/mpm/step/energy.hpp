// Energies of a run by name: a list to which the material and each module add their own.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpm {

struct NamedEnergy {
  /// stored: in the material now. dissipated: by the material, or where it slides, since the start. work: done on the
  /// material since the start. of_bodies: of free rigid bodies now. at_bodies: work on free rigid bodies since the
  /// start, or lost where they meet the material.
  enum class Kind { stored, dissipated, work, of_bodies, at_bodies };
  std::string name;
  Kind kind = Kind::stored;
  double value = 0.0;  ///< [J]
};

class EnergyReport {
 public:
  using Kind = NamedEnergy::Kind;

  /// Takes all values back and keeps the names, so that the same energies can be added again without allocating.
  void begin_again() {
    for (NamedEnergy& energy : list_) energy.value = 0.0;
    closed_ = true;
  }
  /// Adds an energy [J]; values of one name are summed.
  void add(std::string_view name, Kind kind, double value) {
    const double counted = weight_ * value;
    const auto same = std::find_if(list_.begin(), list_.end(), [&](const NamedEnergy& e) { return e.name == name; });
    if (same == list_.end()) {
      list_.push_back({std::string(name), kind, counted});
    } else {
      same->value += counted;
    }
  }
  /// Sets how many times counts what is added from here on: 0 on ranks that know what another one reports.
  void weigh(double weight) { weight_ = weight; }
  /// Replaces the values, in the order of list(), by sums over ranks.
  void replace(const std::vector<double>& values) {
    for (std::size_t i = 0; i < list_.size(); ++i) list_[i].value = values[i];
  }
  /// The energy of this name [J]; 0 if there is none.
  double of(std::string_view name) const {
    const auto found = std::find_if(list_.begin(), list_.end(), [&](const NamedEnergy& e) { return e.name == name; });
    return found == list_.end() ? 0.0 : found->value;
  }
  /// In the order in which they were added.
  const std::vector<NamedEnergy>& list() const { return list_; }

  double sum(Kind kind) const {
    double sum = 0.0;
    for (const NamedEnergy& energy : list_) sum += energy.kind == kind ? energy.value : 0.0;
    return sum;
  }
  /// Energy stored in the material [J].
  double total() const { return sum(Kind::stored); }
  /// Energy stored in the material, and of free rigid bodies [J].
  double whole() const { return total() + sum(Kind::of_bodies); }

  /// Energy that the material stores and has dissipated, less the work done on it [J]. It does not change in a run
  /// whose energy is all accounted for.
  double balance() const { return sum(Kind::stored) + sum(Kind::dissipated) - sum(Kind::work); }
  /// Says that the run loses energy which no part of it counts, so that the balance has no meaning.
  void leave_open() { closed_ = false; }
  bool closed() const { return closed_; }

 private:
  std::vector<NamedEnergy> list_;
  double weight_ = 1.0;
  bool closed_ = true;
};

}  // namespace mpm
