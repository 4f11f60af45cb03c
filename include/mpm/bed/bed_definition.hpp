// Definition of ground that is there only around the bodies that it follows, and of who knows what all of it is like.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Particles of some ground.
struct GroundParticles {
  std::vector<Vec3> positions;   ///< centres [m]
  std::vector<double> parts;     ///< part of a whole place that each has; empty where no surface cuts places
  std::vector<double> surfaces;  ///< as DeformableBody::surfaces; empty with `parts`
};

/// All of the ground as it is at the start, asked for a part at a time.
class GroundSource {
 public:
  virtual ~GroundSource() = default;
  /// Adds the particles whose centres may lie in `bounds` along x and y, and few others.
  virtual void add(const Box& bounds, GroundParticles& ground) const = 0;
  /// True if a surface cuts places anywhere: then all particles have parts and surfaces.
  virtual bool cuts() const = 0;
  /// The lattice on which the particles lie: centre i along an axis is at origin + (i + 1/2) spacing [m]; the spacing
  /// is 0 along axes that the grid does not have.
  virtual Vec3 origin() const = 0;
  virtual Vec3 spacing() const = 0;
  virtual double bottom() const = 0;  ///< lowest point [m]
  virtual double top() const = 0;     ///< highest point [m]
};

struct BedDefinition {
  std::vector<std::string> follow;             ///< rigid bodies around which the ground is there
  double within = 0.0;                         ///< distance from their origins, along x and y [m]
  std::shared_ptr<const GroundSource> source;  ///< made when the bodies are filled
};

}  // namespace mpm
