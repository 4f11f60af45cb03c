// What kernels, laws and the sort are measured on: the 64,000 particles of a shipped scene in a grid of theirs.
#pragma once

#include <string>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/material/law.hpp"
#include "mpm/simulation/definition.hpp"
#include "mpm/step/sorter.hpp"

namespace bench {

/// The scene's only body, at rest in its shape, moving as the scene says; not sorted yet.
struct Block {
  /// `scene`: a shipped one; `changes`: "key.path=value". @throws mpm::SceneError
  Block(const std::string& scene, const std::vector<std::string>& changes, mpm::Precision precision);
  /// The body is of another material; particles forget what they have gone through.
  void make_of(const mpm::MaterialDefinition& material);
  /// Sorts as kernels that take `grouping` want it. @throws mpm::Error when a particle left the grid
  void sort(int threads, const mpm::Grouping& grouping);

  int dim() const { return grid.layout.dim(); }
  int particles() const { return sets.front().size(); }

  mpm::SimulationDefinition definition;
  mpm::Fields fields;  ///< one
  mpm::Grid& grid = *fields.front();
  std::vector<mpm::ParticleSet> sets;  ///< one
  mpm::Law law;
};

}  // namespace bench
