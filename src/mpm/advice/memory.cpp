#include "mpm/advice/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "mpm/math/dimension.hpp"

namespace mpm {

double usable_memory() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  // Control groups, version 2 and 1; "max" is not a number.
  for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(path);
    double limit = 0.0;
    if (file >> limit && limit > 0.0) bytes = std::min(bytes, limit);
  }
  // `ulimit -v` and `ulimit -d`.
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

double least_bytes_of_particle(const MethodDefinition& method, GeometryKind geometry) {
  const int dim = dimensions(geometry);
  const int carried = with_geometry(geometry, [](auto kind) { return kind.kMatrix + kind.kSymmetric; });
  const double real = method.precision == Precision::float32 ? 4.0 : 8.0;
  const double positions = 8.0 * dim * (strains_after_motion(method.update) ? 2 : 1);
  // As in mechanics/continuum.hpp: the domain at the start of a step, and APIC's matrix.
  int kept = traits_of(method.shape).stored(dim);
  if (method.transfer.kind == TransferKind::apic) kept += dim * dim;
  if (axisymmetric(geometry)) kept += 1;  // mass of the ring
  const double id = 4.0;
  // As in step/sorter.hpp; groups take one place each when they consist of one particle.
  const double sorter = (method.precision == Precision::float32 ? 29.0 : 25.0) + 4.0;
  // As in grid/nodal_fields.hpp: mass and three vectors.
  const double node = 8.0 * (1 + 3 * dim);
  return positions + real * (dim + carried + kept) + id + sorter + node / std::pow(method.particles_per_direction, dim);
}

}  // namespace mpm
