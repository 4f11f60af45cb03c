// Keeps the volume of a fluid: ties J of its particles to the density that the grid sees.
//
// J of a particle is the integral of div v at its place, and nothing else holds it to the spacing of the particles.
// Motions that the nodes do not see and changes of place within a cell move one and not the other. Without tension
// nothing opposes J > 1, so errors add up to one side: water that was stirred carries pressure only when it lies far
// closer than at its initial density, and has lost 40 % of its volume in seconds. With tension the particles draw
// together, too, if more slowly.
//
// At a node the fullness c is the volume that all material has at its initial density (a solid at its present one)
// over the node's share of the domain: 1 in the interior of a fluid at rest. In a step of dt each particle of fluid
// gets
//
//   ln J  -=  (1 - exp(-kRate |grad v| dt)) ln(J c),    c = sum over i of S_ip c_i
//
// where all nodes that it reaches are kFull full at least. Where they are not, a surface is near, and less than full
// does not mean less dense: there the same is done if J c > 1, so that a particle cannot be larger than the space that
// it has, and J of a drop that flies apart has a limit. The pressure of the changed J then moves the particles apart or
// lets them together until their spacing is right. The rate is that of the flow which makes the error: a fluid at rest
// is left alone, and so is a sound wave but for a term of second order in its amplitude.
//
// It acts in one step of Clock::kEvery, for the time since it last did. kernel/volume_rule.hpp has the formulas.
// Momentum does not change; the elastic energy that particles lose by it is booked.
//
// Weak: c of a random arrangement varies by some per cent, so a surface that is stirred hard lies up to about a per
// cent too high. A cell that a tool fills in part counts as one at a surface. Beside the axis of an axisymmetric scene
// c is as inexact as the shape functions' integral there. Particles asleep are not counted.
//
// Source: relaxation of the density error as a source in continuity, as B. Kim, Y. Liu, I. Llamas, X. Jiao, J.
// Rossignac (2007), Simulation of bubbles in foam with the volume control method, ACM Trans. Graph. 26 (3), do for a
// whole region; that its rate is the velocity gradient's, and one-sided near surfaces, is this project's;
// doc/decisions.md says why.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mpm/loop/chunk_sums.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class VolumeCorrection final : public Stage {
 public:
  /// Tells in which steps it acts. A checkpoint holds it.
  struct Clock {
    static constexpr int kEvery = 4;  ///< steps
    std::uint64_t steps = 0;          ///< so far
    double waited = 0.0;              ///< since it last acted [s]

    /// Counts a step of `dt` [s]. Returns the time since it last acted where it acts in this one, else 0 [s].
    double advance(double dt) {
      waited += dt;
      return ++steps % kEvery == 0 ? std::exchange(waited, 0.0) : 0.0;
    }
  };

  /// A set of particles, all of them in the order of the run's.
  struct Body {
    ParticleSet* set;
    const Law* law;
    double density() const {
      return std::visit([](const auto& own) { return own.density(); }, *law);
    }
    bool liquid() const { return traits_of(*law).matter == Matter::liquid; }
  };

  /// All pointers outlive the stage. `transfer`: of these sets. `cell`: volume of a cell [m^3]; about an axis
  /// the product of its edges [m^2], for all of a ring counts.
  VolumeCorrection(std::vector<Body> bodies, GeometryKind geometry, ShapeKind shape, int threads,
                   std::unique_ptr<ScalarTransfer> transfer, double cell);

  std::string name() const override { return "volume_correction"; }
  Ranks ranks(Hook) const override { return {Rank::particle_stress}; }

  void momentum_gathered(StepContext& context) override;
  /// "volume correction", dissipated.
  void energies(EnergyReport& report) const override {
    report.add("volume correction", NamedEnergy::Kind::dissipated, taken_);
  }
  void serialise(StateArchive& archive) override {
    archive.sum("taken", taken_);
    archive.value("steps", clock_.steps);
    archive.value("waited", clock_.waited);
  }

  // A device that acts in its place asks when, and books the energy that particles lost since its last call [J].
  Clock& clock() { return clock_; }
  void count(double lost) { taken_ += lost; }

 private:
  /// Numbers of a body's particles, in their order.
  struct Numbers {
    PaddedArray<double> volume;                ///< over mass [m^3/kg]
    PaddedArray<double> fullness, full;        ///< c; part of the weights on nodes that are full
    PaddedArray<double> squares;               ///< |grad v|^2 [1/s^2]
    std::array<PaddedArray<double>, 3> slope;  ///< slope of a component of v [1/s]
  };

  void make_room();
  template <class Geometry>
  void find_volumes();
  void find_fullness(const Fields& fields);
  /// Part of the domain about a node, in cells; about an axis times the radius and a turn [m].
  double share(const Grid& grid, const std::array<int, 3>& node) const;
  double share_along(const Grid& grid, int axis, int node) const;
  void gather(Fields& fields);
  /// Corrects the particles of a body for the time `waited` [s]. Returns the energy that they lose [J].
  template <class Geometry, class Liquid>
  double correct(const Liquid& law, const Body& body, const Numbers& numbers, double waited);

  template <class Number>
  const ScalarTransfer::Taken& fluids_take(Number&& number);

  std::vector<Body> bodies_;
  GeometryKind geometry_;
  ShapeKind shape_;
  int threads_;
  std::unique_ptr<ScalarTransfer> transfer_;
  double cell_;
  std::vector<Numbers> numbers_;               ///< numbers of each body
  std::vector<NodalField> volume_, fullness_;  ///< volume and fullness of each field
  NodalField one_;                             ///< a component at a time
  ScalarTransfer::Given given_;
  ScalarTransfer::Taken takers_;
  ChunkSums<double> sums_;
  double taken_ = 0.0;  ///< [J]
  Clock clock_;
};

}  // namespace mpm
