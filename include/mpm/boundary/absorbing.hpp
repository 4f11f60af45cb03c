// A face of the domain that lets waves out: dashpots on its nodes, a traction -rho c_p v_n - rho c_s v_t on the face.
// A plane wave that comes straight at it is absorbed but for what the grid itself makes of it; at an angle of incidence
// theta part of it comes back, (1 - cos theta) / (1 + cos theta) of a wave with one speed.
//
// A node of the face stands for half a cell of material, m = phi rho A h with phi = 1/2 (other values for splines), so
// its dashpot is rho c A = m c / (phi h): a rate, the same for whole nodes and for those at the edge of a body. It acts
// on the mean of the velocities before and after the step, which is stable for any step and of second order:
// v' = ((1 - r/2) v + a dt) / (1 + r/2) with r = c dt / (phi h).
//
// Nodes beyond the face, which material reaches as it gives way by d cells, move with the face's: alone, a node with
// mass d^2/2 under a force d would fly off and strain what it holds. With M beyond and T in all, d^2 / (1 + 2d) = M /
// T, and phi + d stands in the place of phi.
//
// Of a wave with the wave number k a lattice of such masses and springs sends back tan^2(k h / 4): 0.6 % of one of 20
// cells, 2.5 % of one of 10.
//
// Over several ranks a node of the face and those beyond it may lie in blocks of which a rank has some alone. It has
// the face's then for its neighbours only, and gathers from none of its nodes; what it does to them does not count.
// Speeds are means over the particles of all ranks, and held forces are told to all once. Weak: a mean of several
// materials is that of the last sort, or of the last meeting of ranks (ranks/halo.hpp).
//
// Weak: speeds are those of the undeformed material and do not follow what stiffens; material that flows or shears
// plastically absorbs by its elastic constants. Dashpots give way to a load that stays: the body creeps through the
// face at the speed sigma / (rho c). `hold` keeps the forces of the start as they are, for ground that stands under its
// weight.
// Source: Lysmer & Kuhlemeyer (1969); mass in place of area and the mean velocity are ours.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mpm/grid/node_choice.hpp"
#include "mpm/material/definition.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Speeds of small elastic waves in the undeformed material [m/s].
struct ElasticWaves {
  double pressure = 0.0;  ///< c_p; in plane stress that of a plate
  double shear = 0.0;     ///< c_s; 0 in a fluid
};
ElasticWaves elastic_waves(const MaterialDefinition& material, GeometryKind geometry);

/// Mass of a node on a face over that of a cell, rho A h, where the body's particles fill the lattice up to the face.
double face_mass(ShapeKind shape, int particles_per_direction);

/// Particles near cracks, which give to several fields and are listed in none of them.
struct ParticlesNearCracks {
  const NodeChoice* choice = nullptr;       ///< null without cracks
  std::vector<std::uint8_t> gives_to = {};  ///< for each set, 1 if its particles give to the face's field
};

class Absorbing final : public FieldStage {
 public:
  /// `face`: 2 * grid axis, + 1 for the upper one; `name` as in scenes ("x_min"). `waves`: of each set, which outlive
  /// this. `phi`: face_mass(). `hold`: the forces that the face's nodes need at the first step are held for good.
  /// `ranks`: null on one process.
  Absorbing(int face, const std::string& name, const std::vector<ParticleSet>& sets, std::vector<ElasticWaves> waves,
            double phi, bool hold, Communicator* ranks, ParticlesNearCracks near_cracks);

  std::string name() const override { return account_.name; }
  Ranks ranks(Hook) const override { return {Rank::absorbing}; }
  void share_memory(Communicator& ranks) override;

  void momentum_gathered(FieldContext& context) override;
  void before_strain(FieldContext& context) override;
  void momentum_updated(FieldContext& context) override;
  void velocity_found(FieldContext& context) override;
  void increment_found(FieldContext& context) override;
  void grid_advanced(FieldContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void energies(EnergyReport& report) const override { report.add("load_work", NamedEnergy::Kind::work, work_); }
  void serialise(StateArchive& archive) override;

 private:
  struct Node {
    NodeRef ref;
    std::uint64_t column;  ///< id_on_face()
    bool beyond;
  };
  /// A node of the face and those beyond it: nodes_ from `first` on.
  struct Column {
    int first, count;
    ElasticWaves waves;  ///< wave speeds of the material there
    bool whole = true;   ///< true if this rank has all of its nodes that may carry material
    bool counts = true;  ///< true if sums count it here
  };
  /// Sums over particles at the face, by mass.
  struct WaveSum {
    std::uint64_t column = 0;
    double mass = 0.0, pressure = 0.0, shear = 0.0;
    WaveSum& operator+=(const WaveSum& other) {
      mass += other.mass;
      pressure += other.pressure;
      shear += other.shear;
      return *this;
    }
  };
  static constexpr std::uint64_t kAllColumns = ~std::uint64_t{0};
  /// Load of a column.
  struct Load {
    double mass = 0.0, beyond = 0.0;  ///< in all; of it beyond the face [kg]
    Vec3 velocity = Vec3::Zero();     ///< mean [m/s]
    Vec3 acceleration = Vec3::Zero();
  };
  Load load_of(const Grid& grid, const Column& column, const NodalField& velocity) const;
  /// Gives the nodes of every column their mean.
  void tie(const Grid& grid, NodalField& velocity) const;
  void find_nodes(const Grid& grid);
  void find_waves(const Grid& grid);
  void find_counted(const Grid& grid);
  /// Sums over this rank's particles at the face.
  std::vector<WaveSum> sum_waves(const Grid& grid) const;
  std::uint64_t id_on_face(const GridLayout& layout, std::array<int, 3> node) const;

  int face_;
  const std::vector<ParticleSet>& sets_;
  std::vector<ElasticWaves> waves_;
  double phi_;
  bool hold_;
  Communicator* ranks_;
  ParticlesNearCracks near_cracks_;
  std::vector<Node> nodes_;
  std::vector<Column> columns_;
  std::unordered_map<std::uint64_t, Vec3> held_;  ///< accelerations, by column [m/s^2]
  bool started_ = false, held_by_all_ = false;
  bool counted_ = false;          ///< true if columns_ say what counts here
  std::uint64_t generation_ = 0;  ///< generation of the block table that nodes_ was made from
  ImpulseAccount account_;
  Vec3 given_ = Vec3::Zero();  ///< in this step [N s]
  double work_ = 0.0;          ///< on the material since the start; negative [J]
};

}  // namespace mpm
