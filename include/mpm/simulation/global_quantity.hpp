// Numbers of a run over time by name: means of a body's stress, strain, velocity and displacement, energies, contact
// force, counters. Names are those of NairnMPM's GlobalArchive, in any case ("sxx", "sRR", "Kinetic Energy"), so that
// its input has its place here; doc/watching.md lists them. SI, where that manual has mm, MPa and %.
//
// A mean counts every particle alike, as the scene's metrics do. About an axis forces and energies are those of the
// whole body; contactr alone is of a radian, for what points outwards cancels around the axis.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// What a scene asks for.
struct GlobalQuantity {
  std::string name;  ///< as given
  std::string body;  ///< deformable; of a contact force rigid; empty: all
};

/// Names that quantities have, in lower case, with their units.
std::vector<std::pair<std::string, std::string>> global_quantity_names();
/// Why there is no such quantity: the nearest name, or the feature that is not built yet; or that it is of no single
/// body. Empty when all is well. Whether its body is there is not looked at.
std::string problem_of(const GlobalQuantity& quantity);
/// Whether its body, if it names one, is a rigid one.
bool of_rigid_body(const GlobalQuantity& quantity);

class Simulation;
class StateArchive;

class GlobalQuantities {
 public:
  /// The simulation stands at its start and outlives this. @throws DefinitionError for a name or a body that is not
  /// there
  GlobalQuantities(Simulation& simulation, const std::vector<GlobalQuantity>& chosen);

  bool empty() const { return terms_.empty(); }
  /// "sxx of soil", "kinetic energy", …
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& units() const { return units_; }
  /// Where the simulation stands. A contact force is the mean since the last call, and 0 in the first one.
  const std::vector<double>& read();
  /// For checkpoints: since when forces are averaged. Of other quantities than these nothing is taken on.
  void serialise(StateArchive& archive);

 private:
  /// One quantity: which it is, and of what.
  struct Term {
    int quantity;               ///< in the table; negative: a number of a module, by its name
    std::vector<int> fields;    ///< columns of the particle fields that it looks at
    std::size_t first, last;    ///< ids of the particles
    std::vector<int> contacts;  ///< rigid bodies
    double impulse;             ///< of them at the last call [N s]
  };
  double value_of(Term& term, const std::string& name, double interval) const;
  /// Of modules.
  double number(const std::string& name) const;
  double mean(const Term& term) const;
  double sum(const Term& term) const;
  /// On the bodies, along an axis; from the material, since the start [N s].
  double contact_impulse(const Term& term, int axis) const;

  const Simulation& simulation_;
  std::vector<Term> terms_;
  std::vector<std::string> fields_;
  std::vector<std::string> names_, units_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> values_;
  double last_ = -1.0;  ///< [s] of the last call
};

}  // namespace mpm
