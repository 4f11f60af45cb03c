// Places of the material of a velocity field at divided nodes: its displacement since the start, or its mean place. For
// contact between the faces of cracks, which asks for them only where faces may touch.
//
// Each particle says by its own gradient where material at the node would be: u_i = sum m S (u_p + H_p (x_i - x_p)) /
// sum m S, with H = I - F^-1, so that the strain between particles and node does not count as an opening. Source: crack
// reference 2.6; method reference 8.4.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class SidePlaces {
 public:
  /// Fields and sets outlive this object; sets have their start_x. `patches`: of particles that choose their fields.
  SidePlaces(std::unique_ptr<ScalarTransfer> transfer, const Fields& fields, const Grid& patches,
             const std::vector<ParticleSet>& sets);

  /// Call it in each step before survey().
  void begin_step() { filled_ = false; }
  /// On the marked blocks of a field. `displacements`, `places`: which are asked for.
  void survey(int field, const std::vector<std::uint8_t>& marked, bool displacements, bool places);
  /// At a node of a marked block with this place and mass, along the grid's axes [m].
  Vec2 displacement(int field, NodeRef node, const Vec2& place, double mass) const;
  /// Mean place [m].
  Vec2 place(int field, NodeRef node, double mass) const;

 private:
  /// Numbers of a set's particles: u - H x, H row by row.
  struct Numbers {
    std::array<PaddedArray<double>, 2> offset;
    std::array<std::array<PaddedArray<double>, 2>, 2> slope;
  };
  void fill(std::size_t set, std::uint32_t first, std::uint32_t last);
  template <class Number>
  void spread(int field, NodalField& to, const std::vector<std::uint8_t>& marked, Number&& number);

  std::unique_ptr<ScalarTransfer> transfer_;
  const Fields& fields_;
  const Grid& patches_;
  const std::vector<ParticleSet>& sets_;
  std::vector<Numbers> numbers_;
  std::vector<std::vector<NodalField>> sums_;  ///< [field]: offset, both rows of the slope, places
  std::vector<std::uint8_t> givers_;
  ScalarTransfer::Given given_;
  bool filled_ = false;  ///< those that choose, in this step
};

}  // namespace mpm
