#include "mpm/material/law.hpp"

namespace mpm {
namespace {

struct Maker {
  double density;
  Law operator()(const LinearElasticDefinition& d) const { return LinearElastic(d, density); }
  Law operator()(const NeoHookeanDefinition& d) const { return NeoHookean(d, density); }
  Law operator()(const DruckerPragerDefinition& d) const { return DruckerPrager(d, density); }
  Law operator()(const MohrCoulombDefinition& d) const { return MohrCoulomb(d, density); }
  Law operator()(const J2PlasticityDefinition& d) const { return J2Plasticity(d, density); }
  Law operator()(const NewtonianFluidDefinition& d) const { return NewtonianFluid(d, density); }
  Law operator()(const IdealGasDefinition& d) const { return IdealGas(d, density); }
  Law operator()(const StandardLinearSolidDefinition& d) const { return StandardLinearSolid(d, density); }
  Law operator()(const JohnsonCookDefinition& d) const { return JohnsonCook(d, density); }
  Law operator()(const MuIDefinition& d) const { return MuI(d, density); }
  Law operator()(const CamClayDefinition& d) const { return CamClay(d, density); }
  Law operator()(const NorSandDefinition& d) const { return NorSand(d, density); }
};

}  // namespace

Law make_law(const MaterialDefinition& material) {
  check(material);
  return std::visit(Maker{material.density}, material.law);
}

}  // namespace mpm
