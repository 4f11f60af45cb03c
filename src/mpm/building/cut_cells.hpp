// Places of a body's lattice that its curved surface cuts: the round side of a disk, a sphere or a cylinder, and the
// ground under a terrain. Full places would be a staircase, with steps of half a particle's width and flats that a tool
// meets all at once.
//
// A particle whose place is cut has the volume of what lies in the body there, at that volume's centre. A place whose
// own centre is outside has a particle, too, where a tenth of it or more lies in the body. Less than that goes to the
// particle beside it: one across a face before one across an edge before one across a corner, of these the nearest to
// the part's centre, and in equal shares to those that are equally near. So volume, centre and second moments are those
// of the shape. A particle is lighter than a tenth of a whole one only where its place's centre lies in a ridge as
// thin. The distance of its centre from the surface is kept beside it, for contact. Private to this folder.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "body_lattice.hpp"
#include "mpm/math/stopped.hpp"

namespace mpm {

/// A particle as a body is filled with it.
struct FilledPlace {
  Vec3 centre;           ///< [m]
  double part = 1.0;     ///< its volume (about an axis the area of its section) over that of a whole place
  double surface = 1.0;  ///< distance of the curved surface over the reach of a whole place; 1 away from it
};

constexpr std::int64_t kLowestPlace = -1024, kMostPlaces = std::int64_t{1} << 21;  ///< along an axis

/// One number for a place of a lattice.
inline std::int64_t place_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  return (i - kLowestPlace) + kMostPlaces * ((j - kLowestPlace) + kMostPlaces * (k - kLowestPlace));
}
/// The place that has this number.
inline std::array<std::int64_t, 3> place_number(std::int64_t key) {
  return {key % kMostPlaces + kLowestPlace, key / kMostPlaces % kMostPlaces + kLowestPlace,
          key / (kMostPlaces * kMostPlaces) + kLowestPlace};
}

class CutCells {
 public:
  CutCells() = default;
  /// Finds none for a body whose surface meets its lattice. @throws StoppedError
  CutCells(const Region& region, const Scene& scene, const std::array<Lattice, 3>& lattices, StopCheck& check_stop);
  bool empty() const { return cut_.empty(); }
  /// True of a place that has a particle though its centre may lie outside.
  bool holds(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return !cut_.empty() && cut_.count(place_key(i, j, k)) > 0;
  }
  /// The particle at a place that has one.
  FilledPlace at(const Vec3& centre, std::int64_t i, std::int64_t j, std::int64_t k) const {
    const auto found = cut_.empty() ? cut_.end() : cut_.find(place_key(i, j, k));
    return found == cut_.end() ? FilledPlace{centre} : found->second;
  }

 private:
  std::unordered_map<std::int64_t, FilledPlace> cut_;  ///< by place_key()
};

}  // namespace mpm
