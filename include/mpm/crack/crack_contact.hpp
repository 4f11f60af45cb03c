// Contact between the faces of cracks: at a node that has material of both sides of a crack, each in a velocity field
// of its own, the two act on each other by the crack's law (contact/contact_nodes.hpp), normal to the crack's segments.
// Where two cracks divide a node, so do the four parts of it, each pair with one crack between them.
//
// Faces touch if they approach and lie on each other at the step's end: by the displacements of both sides since the
// start, each carried to the node by its gradient, or by positions. Whether they do is asked with the velocities of the
// step's start and again with those of its end, so that faces which forces turn around in a step meet in that step.
// Faces that a scene lets pass through each other have no contact. Weak: a face is smeared over two cells, as bodies
// are; the four parts of a node are found with one normal a crack; pairs found late in a step may know later strains
// than the others. Source: Nairn (2003), CMES 4(6), 649-663; GIMP notes 3.2; crack reference 2.4 to 2.7.
#pragma once

#include <vector>

#include "mpm/contact/contact_nodes.hpp"
#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/side_places.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/step/heat_sink.hpp"
#include "mpm/step/stage.hpp"
#include "mpm/step/volume_survey.hpp"

namespace mpm {

class CrackContact final : public Stage {
 public:
  /// All outlive the stage. Sets remember their places at the start (start_x). `heat`: is told of friction and of what
  /// touches, or null.
  CrackContact(const std::vector<Crack>& cracks, const CrackFields& chosen, Fields& fields,
               std::unique_ptr<SidePlaces> sides, VolumeSurvey& volumes, GeometryKind geometry, int threads,
               HeatSink* heat = nullptr);

  std::string name() const override { return "crack_contact"; }
  Ranks ranks(Hook) const override { return {Rank::pair}; }

  /// Every rank has all nodes near cracks, and solves them for itself.
  bool same_on_all_ranks() const override { return true; }
  /// @throws FunctionError as ContactLaw::in_step().
  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override { nodes_.strain(context.dt); }
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override { nodes_.filter(context.dt); }
  void increment_found(StepContext& context) override { nodes_.filter(context.dt); }
  void energies(EnergyReport& report) const override;
  void serialise(StateArchive& archive) override;

  /// Taken by friction on the faces of a crack since the start [J].
  double friction_energy(int crack) const { return friction_energy_[crack]; }
  /// Stored in the interface between its faces as the last step began [J].
  double interface_energy(int crack) const { return interface_energy_[crack]; }

 private:
  void add_node(const DividedNode& node);
  /// Number that tells a pair of fields, of 0 to 3, from others at its node from step to step.
  int identity(const DividedNode& node, int above, int below) const;
  void add_pair(int crack, int above, int below, const Vec2& normal, int identity);
  void survey(const std::vector<std::uint8_t>& wanted);
  void look_at_wanted(const std::vector<std::uint8_t>& wanted, double dt);
  void look_again(double dt);
  double closing(const ContactNodes::Node& node, const NodePair& pair) const;
  void tell_of_heat(double dt) const;
  void look_at(const ContactNodes::Node& node, int pair, double dt);

  const std::vector<Crack>& cracks_;
  const CrackFields& chosen_;
  Fields& fields_;
  std::unique_ptr<SidePlaces> sides_;
  VolumeSurvey& survey_;
  GeometryKind geometry_;
  HeatSink* heat_;
  ContactNodes nodes_;
  std::vector<NodalVolumes> volumes_;
  std::vector<std::uint8_t> looked_at_;           ///< pairs that have been looked at in this step
  std::vector<std::uint8_t> late_;                ///< those that began to approach in it
  std::vector<double> apart_;                     ///< distance of faces of pairs looked at, as the step began [m]
  std::vector<std::vector<std::uint8_t>> marks_;  ///< [field][block]: where nodes of such pairs are
  std::vector<std::uint8_t> any_;                 ///< [field]: whether there are marks
  std::vector<FrictionLaw> friction_;             ///< friction of each crack, in this step
  std::vector<double> friction_energy_, interface_energy_;
  bool started_ = false;
};

}  // namespace mpm
