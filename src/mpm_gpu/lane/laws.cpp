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
TotalsPass<double> totals_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kTotals[law] : LawPasses<double, mpm::PlaneStrain>::kTotals[law];
}
TotalsPass<float> totals_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kTotals[law] : LawPasses<float, mpm::PlaneStrain>::kTotals[law];
}
AveragePass<double> average_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kAverages[law] : LawPasses<double, mpm::PlaneStrain>::kAverages[law];
}
AveragePass<float> average_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kAverages[law] : LawPasses<float, mpm::PlaneStrain>::kAverages[law];
}
RelaxPass<double> relax_pass(int dim, std::size_t law, double) {
  return dim == 3 ? LawPasses<double, mpm::Solid>::kRelaxes[law] : LawPasses<double, mpm::PlaneStrain>::kRelaxes[law];
}
RelaxPass<float> relax_pass(int dim, std::size_t law, float) {
  return dim == 3 ? LawPasses<float, mpm::Solid>::kRelaxes[law] : LawPasses<float, mpm::PlaneStrain>::kRelaxes[law];
}

}  // namespace mpm_gpu
