#include "mpm/material/norsand_energy.hpp"
#include "mpm_gpu/law_passes.hpp"

namespace mpm_gpu {

LawPass<double> law_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kPasses[law] : LawPasses<double, mpm::PlaneStrain>::kPasses[law];
}
LawPass<float> law_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kPasses[law] : LawPasses<float, mpm::PlaneStrain>::kPasses[law];
}
RatePass<double> rate_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kRates[law] : LawPasses<double, mpm::PlaneStrain>::kRates[law];
}
RatePass<float> rate_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kRates[law] : LawPasses<float, mpm::PlaneStrain>::kRates[law];
}
AveragePass<double> average_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kAverages[law] : LawPasses<double, mpm::PlaneStrain>::kAverages[law];
}
AveragePass<float> average_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kAverages[law] : LawPasses<float, mpm::PlaneStrain>::kAverages[law];
}

}  // namespace mpm_gpu
