// The particles of one deformable body: structure of arrays, one material, equal mass, kept sorted by grid block.
//
// What a body's scene does not need is not stored: history exists as its law asks for it, the second position only when
// the update scheme updates strain after the motion, the place at the start only when a load is a function of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mpm {

struct ParticleSet {
  std::string name;                           ///< of the body
  double mass = 0.0;                          ///< of a particle [kg]
  std::array<double, 3> half{};               ///< half of a particle's box along each grid axis [cells]
  std::array<double, 3> lowest{}, highest{};  ///< where a centre may be along each grid axis [cells]
  std::uint32_t first_id = 0;                 ///< ids run from here

  std::vector<std::uint32_t> id;         ///< within the whole run
  std::vector<std::vector<double>> x;    ///< position, along grid axes [m]
  std::vector<std::vector<double>> v;    ///< velocity [m/s]
  std::vector<std::vector<double>> f;    ///< deformation gradient, stored components
  std::vector<std::vector<double>> tau;  ///< Kirchhoff stress over initial density [J/kg]; GIMP notes (1.24)
  std::vector<std::vector<double>> history;
  std::vector<std::vector<double>> start_x;  ///< position at the start of the run [m]
  std::vector<std::vector<double>> next_x;   ///< position at the end of the step, when strain is updated after motion

  /// First particle of each owner block, and one past the last particle.
  std::vector<std::uint32_t> begin;

  int size() const { return static_cast<int>(id.size()); }
  /// Calls `visit(std::vector<double>&)` for every stored scalar but next_x.
  template <class Visit>
  void each_scalar(Visit&& visit) {
    for (auto* group : {&x, &v, &f, &tau, &history, &start_x}) {
      for (auto& scalar : *group) visit(scalar);
    }
  }
};

}  // namespace mpm
