// One stress for the particles of a cell that flow: against locking and ringing of soil, clay and metal.
//
// A flow rule ties the change of volume to the shear at every particle. A cell with four or eight particles then
// forbids more motions than its nodes have: a slip band that is not parallel to the grid cannot form freely, and what
// is pushed or pressed meets too much force. So the particles of one body in a cell that flow get the mean of their
// stresses, weighted by mass, at the beginning of each step. A particle flows if its plastic strain has grown in the
// step before; one of soil must be under pressure, too. The cell then flows as an element with one stress does; what is
// elastic stays as it is. Since the elastic region is convex, the mean of admissible stresses of equal strength is
// admissible. What the particles lose of their elastic energy is booked.
//
// They also share their volume ratio J, whose sum over the mass does not change: nothing but its stress would keep a
// particle from swelling while its neighbour shrinks. Where the pressure follows from J (J2), sharing J is sharing the
// pressure: of the mean stress the deviator stays, and its pressure acts with USL alone, for one step.
//
// A cell is that between nodes. A particle that has left its block since the last sort by more than half a cell counts
// in the nearest cell of that block. Where a crack cuts a cell, each side of it has a mean of its own
// (mechanics/cell_parts.hpp): only particles near cracks are asked on which side they are.
//
// Weak: a part of the locking remains, since a band is still smeared over cells. Cells do not move with the material.
// Where few particles are left in a cell, there is less to average. With hardening the weaker particles of a cell lie
// above their own strength until the next step returns them. In water the energy `pore_pressure` counts J that is
// shared as flow. Sharing pressures alone, and not deviators, was tried: footings on clay and rough blades then meet 4
// to 12 % more force at four and eight cells. Source: an element with one stress or one pressure, J. C. Nagtegaal, D.
// M. Parks, J. R. Rice (1974), On numerically accurate finite element solutions in the fully plastic range, Comput.
// Methods Appl. Mech. Eng. 4, 153-177, who show why elements lock; that it is done to particles, and only where they
// flow, is this project's, and doc/verification.md has what it changes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mpm/grid/node_choice.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/mechanics/cell_parts.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// A set of particles whose law has kAveragesStress. It outlives the stage.
struct AveragedSet {
  ParticleSet* set;
  const Law* law;
};

class StressAverage final : public Stage {
 public:
  /// The sets outlive the stage, and are not sorted yet: each gets a number more for its particles. `halo`: where
  /// other ranks have particles in the same cells, else null.
  StressAverage(std::vector<AveragedSet> sets, GeometryKind geometry, int threads, Halo* halo = nullptr);

  /// Takes means of the parts of cells, for particles that choose a field at every node; before the first step.
  /// `choice` outlives the stage.
  void divide(const NodeChoice& choice, std::unique_ptr<CellParts> parts);

  /// Takes note of the plastic strains of the start, unless that has been done; the first step does it without a call.
  void begin();
  /// The name of the particles' plastic strains at the start of the step before (ParticleSet::brought).
  static constexpr const char* kStrainBefore = "plastic_strain_before";

  std::string name() const override { return "stress_average"; }
  Ranks ranks(Hook) const override { return {Rank::particle_stress}; }

  void momentum_gathered(StepContext& context) override;
  void count(Device& device) override;
  /// "stress averaging", dissipated.
  void energies(EnergyReport& report) const override;
  void serialise(StateArchive& archive) override {
    archive.sum("taken", taken_);
    archive.value("begun", begun_);
  }

 private:
  /// Sums over the flowing particles of a cell, weighted by mass.
  struct Cell {
    double mass = 0.0;    ///< [kg]
    double volume = 0.0;  ///< volume over that before deformation
    std::array<double, 6> stress{};
    std::uint32_t particles = 0;
    std::uint32_t step = 0;  ///< in which these are the sums
  };
  /// The cells of each set and block that may have particles of the set.
  struct Cells {
    std::uint64_t generation = 0;   ///< generation of the blocks that these are for
    std::vector<int> of_set_block;  ///< place where the cells of a set in a block begin, or -1
    std::vector<Cell> all;          ///< by the node at their lower corner, and then by part
  };
  /// Particles of a set that lie in one block, the one of this owner.
  struct Place {
    std::size_t set;
    std::uint32_t first, end;
    int owner;
    const CellParts* parts;  ///< parts of cells that they are in; null: all in the first
  };

  /// Visits every set with its number, its particles' plastic strains before, a value of their scalar type, and its
  /// law.
  template <class Visit>
  void each_set(Visit&& visit);
  /// visit(Place) for all particles of a set that choose a field at every node, from those of this field, patch by
  /// patch.
  template <class Visit>
  void each_patch(const Grid& grid, int field, std::size_t set, Visit&& visit) const;
  void find_cells(const Grid& grid, int field, Cells& cells) const;
  /// Adds flowing particles to their cells.
  template <class Geometry, class T, class LawType>
  void gather(const Place& place, const LawType& law, double* before, const Grid& grid, Cells& cells);
  /// Gives the means to flowing particles, and takes note of the plastic strains of all for the next step. Returns the
  /// energy that the particles lose [J].
  template <class Geometry, class T, class LawType>
  double share(const Place& place, const LawType& law, double* before, const Grid& grid, Cells& cells);
  template <class Geometry>
  void average(const Grid& grid, int field, Cells& cells);
  /// True if cells of this field may have more parts than one: particles choose fields from it.
  bool divides(int field) const;
  void exchange(const Grid& grid, int field, int part, Cells& cells);
  /// A part of the cell with this number along each axis, from -1, counted from the first of an owner's block.
  Cell& cell_at(const Grid& grid, int owner, const std::array<int, 3>& cell, int part, const int* of_block,
                Cells& cells) const;

  std::vector<AveragedSet> sets_;
  std::vector<std::size_t> places_;  ///< number that each set was given
  GeometryKind geometry_;
  int threads_;
  Halo* halo_;
  const NodeChoice* choice_ = nullptr;  ///< null without cracks, as `parts_` is
  std::unique_ptr<CellParts> parts_;
  int most_parts_ = 1;              ///< number that a cell may have
  std::vector<Cells> cells_;        ///< cells of each field
  std::uint32_t step_ = 0;          ///< counts, so that what an earlier step left in a cell is known as that
  std::optional<NodalField> sums_;  ///< sums that ranks exchange; none on one process
  std::vector<double> of_owner_;    ///< energy that the particles of a block lose in this step [J]
  double taken_ = 0.0;              ///< [J]
  std::uint64_t begun_ = 0;         ///< not 0 if a step has been taken
};

}  // namespace mpm
