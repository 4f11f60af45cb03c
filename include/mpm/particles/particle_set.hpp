// The particles of one deformable body: a structure of arrays, of one material, kept sorted by grid block. All have the
// same mass, except in axisymmetric scenes, where each ring has its own, and where a curved surface cuts their places.
//
// Only what the scene needs is stored: the history variables of the law; a second position when strain is updated after
// the motion; a domain when the shape function follows the deformation; an affine matrix for APIC; the position at the
// start when a load is a function of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/particles/particle_scalar.hpp"

namespace mpm {

/// A number of each particle that a physics beside the mechanics brings.
struct NamedScalar {
  std::string name, unit;  ///< as a particle field
  PaddedArray<double> values;
};

/// The most that `ParticleSet::surface` may be.
inline constexpr double kMostSurface = 2.0;

struct ParticleSet {
  static constexpr int kRestGroup = 4096;

  std::string name;  ///< name of the body
  /// Mass of each particle where all have the same, of a whole place of the lattice where a surface cuts some; 0 of
  /// rings [kg].
  double mass = 0.0;
  std::array<double, 3> half{};                          ///< half of a particle's box along each grid axis [cells]
  std::array<double, 3> lowest{}, highest{};             ///< bounds of particle centres along each grid axis [cells]
  bool whole_domains = false, planar_functions = false;  ///< in axisymmetry: AxisRules (shape/axis_rules.hpp)
  std::uint32_t first_id = 0;                            ///< the smallest id
  /// So many particles, the last ones, take no part in steps: they are at rest, in no block and no group, and every
  /// array keeps them as they are (sleep/sleeping_blocks.hpp).
  int asleep = 0;
  /// Counts, for each kRestGroup places, of how often particles fell asleep there or changed places. Empty where
  /// nothing sleeps.
  std::vector<std::uint32_t> rest_changes;
  /// Some have fallen asleep or woken on any rank, and others changed places with them: sorts take the particles of a
  /// node in the order of their ids, which is the same on any number of ranks.
  bool sorts_by_id = false;
  int field = 0;      ///< velocity field of its particles
  int far_field = 0;  ///< velocity field of those on side 1, where a thin tool divides the body
  /// Those on side 1 are near a crack, or a tool that divides the cracked body, and choose a field at every node;
  /// far_field is the number of their patches (grid/node_choice.hpp).
  bool chooses = false;

  Precision precision = Precision::float64;  ///< precision of velocity, deformation, stress and history

  PaddedArray<std::uint32_t> id;        ///< unique within the whole run
  std::vector<PaddedArray<double>> x;   ///< position, along grid axes [m]
  std::vector<ParticleScalar> v;        ///< velocity [m/s]
  std::vector<ParticleScalar> f;        ///< deformation gradient, stored components
  std::vector<ParticleScalar> tau;      ///< Kirchhoff stress over initial density [J/kg]; GIMP notes (1.24)
  std::vector<ParticleScalar> history;  ///< history variables of the law
  std::vector<ParticleScalar> masses;   ///< one scalar where they differ: for rings and a body with cut places [kg]
  std::vector<ParticleScalar> surface;  ///< one scalar for a body with cut places: reach over that of the box
  std::vector<PaddedArray<double>> start_x;  ///< position at the start of the run [m]
  std::vector<ParticleScalar> affine;        ///< APIC: B, moment of the velocity, [component][axis] [m^2/s]
  std::vector<ParticleScalar> domain;        ///< F at the start of the step, where the shape function follows it
  std::vector<PaddedArray<double>> next_x;   ///< position at the end of the step, when strain is updated after motion
  std::vector<NamedScalar> brought;          ///< by physics beside the mechanics
  /// Place in `brought` of the strain that brings no stress; the next one is what it was when the stress was last
  /// computed (kernel/free_strain.hpp). Negative where nothing expands.
  int free_strain = -1;
  /// Place in `brought` of the slope of the free strain that the next increment is enhanced by, along each axis, and
  /// after it of the distances to the places of slopes (transport/enhanced_strain.hpp). Negative where there is none.
  int enhanced_strain = -1;
  PaddedArray<std::uint8_t> side;  ///< side of a thin tool, for a divided body: 0 or 1

  /// First particle of each owner block (the owners of all fields, field by field), and one past the last one awake.
  /// Empty before the first sort, and before the next one where particles have changed places since the last.
  std::vector<std::uint32_t> begin;
  /// First particle of each group (particles computed together, step/sorter.hpp), and one past the last one awake.
  std::vector<std::uint32_t> group;
  /// First group of each owner block, and one past the last group.
  std::vector<std::uint32_t> group_begin;

  int size() const { return static_cast<int>(id.size()); }
  int awake() const { return size() - asleep; }
  /// Field of a particle; if it chooses at every node, the one that it has on its own side.
  int field_of(int p) const { return side.empty() || side[p] == 0 || chooses ? field : far_field; }
  double mass_of(int p) const { return masses.empty() ? mass : masses[0][p]; }
  double total_mass() const {
    if (masses.empty()) return mass * size();
    double sum = 0.0;
    for (int p = 0; p < size(); ++p) sum += masses[0][p];
    return sum;
  }
  double least_mass() const {
    double least = mass_of(0);
    for (int p = 1; p < size() && !masses.empty(); ++p) least = std::min(least, mass_of(p));
    return least;
  }
  /// The least mass of a particle whose place no surface cuts [kg].
  double least_whole_mass() const { return mass > 0.0 ? mass : least_mass(); }
  /// Makes as much room as there are particles for what a step writes before it reads it.
  void fit_scratch() {
    for (PaddedArray<double>& scalar : next_x) {
      if (scalar.size() != id.size()) scalar = PaddedArray<double>(id.size());
    }
    for (ParticleScalar& scalar : domain) {
      if (scalar.size() != id.size()) scalar = ParticleScalar(precision, id.size());
    }
  }
  /// Gives the particles a number of this name, 0 to begin with. Sorting carries it, checkpoints hold it, and it is a
  /// particle field. Returns its place in `brought`.
  std::size_t bring(const std::string& number_name, const std::string& unit) {
    brought.push_back({number_name, unit, PaddedArray<double>(id.size(), 0.0)});
    return brought.size() - 1;
  }
  /// Calls visit(PaddedArray<double>&) or visit(PaddedArray<float>&) for every stored scalar but domain and next_x.
  template <class Visit>
  void each_scalar(Visit&& visit) {
    for (auto& scalar : x) visit(scalar);
    for (auto* fields : {&v, &f, &tau, &history, &masses, &surface, &affine}) {
      for (ParticleScalar& scalar : *fields) scalar.visit(visit);
    }
    for (auto& scalar : start_x) visit(scalar);
    for (NamedScalar& scalar : brought) visit(scalar.values);
  }
};

}  // namespace mpm
