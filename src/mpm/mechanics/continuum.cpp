#include "mpm/mechanics/continuum.hpp"

#include "mpm/mechanics/instances.hpp"

namespace mpm {

std::unique_ptr<Mechanics> make_mechanics(int dim, std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                          const ContinuumSettings& settings) {
  return dim == 3 ? make_solid_ugimp(sets, laws, settings) : make_plane_strain_ugimp(sets, laws, settings);
}

std::unique_ptr<BodyForce> make_body_force(int dim, const std::vector<ParticleSet>& sets,
                                           const std::vector<BodyForceTerm>& terms, int threads) {
  return dim == 3 ? make_solid_ugimp_load(sets, terms, threads) : make_plane_strain_ugimp_load(sets, terms, threads);
}

const char* kernel_isa() {
#if defined(__AVX512F__)
  return "avx512";
#elif defined(__AVX2__)
  return "avx2";
#else
  return "x86-64";
#endif
}

}  // namespace mpm
