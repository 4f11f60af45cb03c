// The subject on which kernels, laws and the sort are measured: the 64,000 particles of a shipped scene, in one grid.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/material/law.hpp"
#include "mpm/step/sorter.hpp"

namespace bench {

/// The scene's only body, undeformed and with the velocity that the scene gives it. It is not sorted yet.
struct Block {
  /// `scene`: a shipped one; `changes`: "key.path=value". @throws mpm::SceneError
  Block(const std::string& scene, const std::vector<std::string>& changes, mpm::Precision precision);
  /// Gives the body another material and resets deformation, stress and history of its particles.
  void make_of(const mpm::MaterialDefinition& material);
  /// Sorts the particles for kernels that work on `grouping`. @throws mpm::Error when a particle left the grid
  void sort(int threads, const mpm::Grouping& grouping);

  int dim() const { return grid.layout.dim(); }
  int particles() const { return sets.front().size(); }

  mpm::SimulationDefinition definition;
  mpm::Fields fields;  ///< one field
  mpm::Grid& grid = *fields.front();
  std::vector<mpm::ParticleSet> sets;  ///< one set
  mpm::Law law;
};

}  // namespace bench
