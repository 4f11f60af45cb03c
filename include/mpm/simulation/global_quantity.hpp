// Numbers of a run over time by name: means of a body's stress, strain, velocity and displacement, energies, contact
// force, counters. Names are those of NairnMPM's GlobalArchive, in any case ("sxx", "sRR", "Kinetic Energy"), so that
// its input can be used here; doc/watching.md lists them. Units are SI, where that manual has mm, MPa and %.
//
// A mean weights all particles equally, as the scene's metrics do. About an axis forces and energies are those of the
// whole body; only contactr is that of one radian, because radial components cancel around the axis.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// A quantity that a scene asks for.
struct GlobalQuantity {
  std::string name;  ///< as given
  std::string body;  ///< a deformable body, or a rigid one for a contact force; empty: all
};

/// Names that quantities have, in lower case, with their units.
std::vector<std::pair<std::string, std::string>> global_quantity_names();
/// Those of them that are numbers which modules report.
std::vector<std::string> reported_number_names();
/// Reason why there is no such quantity (the nearest name, or the feature that is not built yet), or why it cannot be
/// that of one body. Empty for a valid quantity. Whether the body exists is not checked.
std::string problem_of(const GlobalQuantity& quantity);
/// True if its body, if it names one, is a rigid one.
bool of_rigid_body(const GlobalQuantity& quantity);

class Simulation;
class StateArchive;

class GlobalQuantities {
 public:
  /// The simulation has to be at its start and must outlive this object. @throws DefinitionError for an unknown name or
  /// body
  GlobalQuantities(Simulation& simulation, const std::vector<GlobalQuantity>& chosen);

  bool empty() const { return terms_.empty(); }
  /// "sxx of soil", "kinetic energy", …
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& units() const { return units_; }
  /// The particle fields that they are computed from.
  const std::vector<std::string>& fields() const { return fields_; }
  /// The values at the simulation's present time. A contact force is the mean since the last call, and 0 in the first.
  const std::vector<double>& read();
  /// Writes or reads the begin of the averages of forces, for checkpoints. A list of other quantities is not resumed.
  void serialise(StateArchive& archive);

 private:
  /// One quantity, and the particles or bodies of which it is computed.
  struct Term {
    int quantity;               ///< index in the table; negative: a number of a module, found by its name
    std::vector<int> fields;    ///< columns of the particle fields that it needs
    std::size_t first, last;    ///< ids of the particles
    std::vector<int> contacts;  ///< rigid bodies
    double impulse;             ///< on these bodies at the last call [N s]
  };
  double value_of(Term& term, const std::string& name, double interval) const;
  /// A number of modules, by its name.
  double number(const std::string& name) const;
  double mean(const Term& term) const;
  double sum(const Term& term) const;
  /// Impulse of the material on the bodies along an axis, since the start [N s].
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
