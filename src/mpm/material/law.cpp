#include "mpm/material/law.hpp"

namespace mpm {
namespace {

struct Maker {
  double density;
  Law operator()(const LinearElasticDefinition& d) const { return LinearElastic(d, density); }
  Law operator()(const NeoHookeanDefinition& d) const { return NeoHookean(d, density); }
  Law operator()(const DruckerPragerDefinition& d) const { return DruckerPrager(d, density); }
  Law operator()(const MohrCoulombDefinition& d) const { return MohrCoulomb(d, density); }
};

}  // namespace

Law make_law(const MaterialDefinition& material) {
  check(material);
  return std::visit(Maker{material.density}, material.law);
}

}  // namespace mpm
