// Data of a run around a crack's tip for the J integral: values of the material at nodes, on their own side
// of the crack and across it, and the particles inside the contour.
//
// Nodal values are means of the particles by mass and shape function, each field for itself: gradients of displacement
// (F - I), Cauchy stress, and energies by present volume.
// Weak: shape functions carry what particles know to nodes as far as they reach, so near the tip the field is smooth
// where it is singular; contours stay two cells away from it.
// Source: crack reference 4.2, 4.3.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpm/crack/contour_values.hpp"
#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/j_integral.hpp"
#include "mpm/crack/tip_physics.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/step/scalar_transfer.hpp"

namespace mpm {

/// Parts of the run; all outlive TipValues.
struct TipParts {
  const std::vector<Crack>& cracks;
  const CrackFields& chosen;
  Fields& fields;
  std::vector<ParticleSet>& sets;
  const std::vector<Law>& laws;
  std::vector<double> densities;  ///< density of each set, undeformed [kg/m^3]
  GeometryKind geometry;
  double across;  ///< thickness of a planar scene [m]
  /// Energies at nodes follow from stress, strain and velocity there, as in linear elasticity; else they are means of
  /// those of particles. Where something expands or is wet, W is that of particles in any case.
  bool grid_energy = false;
  std::vector<TipPhysics> physics = {};  ///< physics of each set; empty where nothing expands and no water is in pores
  Communicator* ranks = nullptr;         ///< communicator of a run over several ranks; else null
};

class TipValues final : public ContourSource {
 public:
  TipValues(TipParts parts, std::unique_ptr<ScalarTransfer> transfer);

  /// Finds the values on the blocks that hold nodes `low` to `high`, of the group whose field 0 is `first`, as seen
  /// from a tip of `crack`. To be called while the fields are those of a step in which momentum has been gathered.
  void gather(int first, int crack, const std::array<int, 2>& low, const std::array<int, 2>& high);
  bool find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const override;
  /// At any place near gathered nodes, of the material on the side on which `from` lies.
  bool at(const Vec2& place, const Vec2& from, ContourValues& values) const;
  /// The particles inside the path, of all ranks, with their motion; Grid::velocity and Grid::force are of the step's
  /// end.
  void find_samples(const GridLines& lines, const ContourPath& path, std::vector<AreaSample>& samples);

 private:
  /// Numbers that are carried to the nodes, in pairs.
  enum Number {
    one,
    energy,
    xx,
    xz,
    zx,
    zz,
    stress_xx,
    stress_zz,
    stress_xz,
    stress_hoop,
    kinetic,
    hoop_gradient,
    place_x,
    place_z,
    free,
    pressure,
    content,
    spare,
    kNumbers
  };

  template <class Get>
  static ContourValues values_of(Get&& number);
  /// Adds what transport does to numbers of a particle: the total stress, and its energy.
  void add_water(std::size_t set, std::uint32_t p, const Matrix3<double>& f, double j);
  /// Finds the gradients of free strain and pressure at particles.
  void find_slopes();
  void add_physics(std::size_t set, std::uint32_t p, AreaSample& sample) const;
  void fill(std::size_t set, std::uint32_t first, std::uint32_t last);
  bool values_at(int field, NodeRef ref, ContourValues& values) const;

  TipParts parts_;
  std::unique_ptr<ScalarTransfer> transfer_;
  int first_ = 0, crack_ = 0;
  std::vector<std::array<PaddedArray<double>, kNumbers>> numbers_;        ///< numbers of each set's particles
  std::vector<std::array<PaddedArray<double>, 2>> acceleration_;          ///< acceleration of each set's particles
  std::vector<std::array<std::array<PaddedArray<double>, 2>, 2>> slope_;  ///< slope of the velocity
  /// Gradients of the centres of material, and of free strain, pressure and content, where there are any.
  std::vector<std::array<std::array<PaddedArray<double>, 2>, 5>> gradients_;
  std::vector<PaddedArray<double>> traces_, energies_;  ///< tr sigma' and Psi of each set's particles
  std::vector<std::vector<NodalField>> nodal_;          ///< [field of the group][pair of numbers]
  std::vector<std::vector<std::uint8_t>> marks_;        ///< [field of the group][block]
  NodalField component_;                                ///< component of a velocity
  std::vector<std::uint8_t> givers_;
  ScalarTransfer::Given given_;
  ScalarTransfer::Taken taken_;
};

}  // namespace mpm
