// Flux into bodies through faces of their particles' domains: given, by convection, or by radiation. Node i takes
//   sum over the face's corners of A_a N_i(x_a) q,
// the weights of tractions (method reference 4.1 to 4.4 with q for T), so that about an axis a face is a ring that ends
// at r = 0. Convection and radiation take the value that the nodes have at the corner, at the update's start.
#pragma once

#include <vector>

#include "mpm/step/domain_faces.hpp"
#include "mpm/transport/definition.hpp"
#include "mpm/transport/nodal_source.hpp"

namespace mpm {

struct FluxTerm {
  FluxDefinition definition;
  int set = 0;
  DomainFace face;
  std::vector<std::uint32_t> particles;  ///< by id from the set's first
};

class FaceFlux final : public NodalSource {
 public:
  FaceFlux(const FaceSettings& settings, const Fields& fields, const std::vector<ParticleSet>& sets,
           std::vector<FluxTerm> terms);
  /// @throws TransportError for a flux that is not finite, or a face off the grid
  void give(std::vector<NodalQuantity>& nodes, double start, double dt) override;
  double conductance(double most) const override;
  bool feeds(const RestingBlock& block) const override;
  void accounts(std::vector<ContentAccount>& list) const override;
  void serialise(StateArchive& archive) override;

 private:
  NodalField& source_of(int field, std::vector<NodalQuantity>& nodes);
  void begin_own();
  void add_own(std::vector<NodalQuantity>& nodes);

  DomainFaces faces_;
  const Fields& fields_;
  const std::vector<ParticleSet>& sets_;
  std::vector<FluxTerm> terms_;
  std::vector<std::vector<char>>
      fed_;  ///< marks of the particles of each set that a flux acts on, by id from its first
  std::vector<ContentAccount> accounts_;
  std::vector<int> place_of_;
  Halo* halo_;
  std::vector<NodalField> own_;  ///< flux of each field, where there is a halo [content/s]
};

}  // namespace mpm
