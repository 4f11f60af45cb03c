// Heat of growing tips in the run's temperature: in each step the part that is due (tip_heat.hpp) goes to the nodes of
// the cell that holds the tip, each with its share of the place, S*_i = N_i / sum of N_j over nodes with material. A
// node that the crack divides shares it out by the masses of its fields, so that both sides warm alike.
//
// Steps with heat are steps in which the temperature is updated. Heat of a tip around which no material is waits.
// Weak: the heat of a tip that moves on before it is given goes to its new place.
// Source: crack reference 5.6; GIMP notes (6.34).
#pragma once

#include <vector>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/tip_heat.hpp"
#include "mpm/transport/nodal_source.hpp"

namespace mpm {

class TipHeating final : public NodalSource {
 public:
  /// `part`: of the energy that becomes heat. `cracks`: of each tip, its crack. `chosen` and `fields` outlive this.
  /// `counts`: over several ranks, which all give the same heat, whether this one books it.
  TipHeating(double part, const std::vector<int>& cracks, const CrackFields& chosen, const Fields& fields, bool counts);

  /// A tip has grown, as TipHeat::add().
  void released(int tip, double release_rate, double front, double growth, int steps) {
    heats_[tip].add(part_, release_rate, front, growth, steps);
  }
  /// Finds the nodes that take a tip's heat in this step of length `dt` [s]; masses are on the grid.
  void heat(int tip, const Vec2& place, double dt);

  void give(std::vector<NodalQuantity>& nodes, double start, double dt) override;
  void accounts(std::vector<ContentAccount>& list) const override { list.push_back(account_); }
  bool pending() const override { return !shares_.empty(); }
  void serialise(StateArchive& archive) override;

 private:
  struct Share {
    int field;
    NodeRef node;
    double heat;  ///< [J]; a weight until all are known
  };

  double part_;
  const CrackFields& chosen_;
  const Fields& fields_;
  bool counts_;
  std::vector<TipHeat> heats_;
  std::vector<double> kept_;              ///< heat of each tip, for the next step [J]
  std::vector<std::vector<int>> groups_;  ///< for each tip, field 0 of the bodies that its crack divides
  std::vector<Share> shares_;             ///< shares of this step
  ContentAccount account_;
};

}  // namespace mpm
