// Particles that an implicit step has left inside a rigid body, on a device: those near bodies are copied to the host,
// which puts them out as it does its own, and their places back. Weak: of the blocks near bodies all places are copied.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/implicit/out_of_tools.hpp"
#include "mpm/implicit/soil_cells.hpp"
#include "mpm_gpu/near_copies.hpp"
#include "mpm_gpu/soil_map.hpp"

namespace mpm_gpu {

template <class T>
class NearTools {
 public:
  /// `out` and `bodies` outlive this object.
  NearTools(const mpm::OutOfTools& out, const mpm::SoilBodies& bodies, const mpm::GridLayout& layout);

  /// Puts particles out, as they are after `step`, in whose sort `map` and the blocks of `grid` were found. Returns
  /// true if any lay in a body.
  bool put_out(Executor& run, const Step<T>& step, const SoilMap<T>& map, const mpm::Grid& grid);

 private:
  const mpm::OutOfTools& out_;
  const mpm::SoilBodies& bodies_;
  const mpm::GridLayout layout_;
  double half_;  ///< half edge of the cube around a block in which its particles are at a step's end [m]
  NearCopies<T> copies_;
  std::vector<std::int32_t> blocks_;
  std::vector<std::uint32_t> ranges_, particles_, ids_;
  std::vector<std::size_t> ends_;  ///< places where the particles of each set end
  std::vector<double> surfaces_, places_;
};

}  // namespace mpm_gpu
