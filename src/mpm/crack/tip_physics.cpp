#include "mpm/crack/tip_physics.hpp"

#include <cmath>

#include "mpm/transport/pore_water.hpp"

namespace mpm {

double TipPhysics::squeezed(const Matrix3<double>& f, double j) const {
  const Symmetric3<double>& b = pores.biot;
  if (is_isotropic(b)) return b.xx * std::log(j);
  return b.xx * (f.xx - 1.0) + b.yy * (f.yy - 1.0) + b.zz * (f.zz - 1.0) + b.yz * (f.yz + f.zy) + b.xz * (f.xz + f.zx) +
         b.xy * (f.xy + f.yx);
}

double TipPhysics::eigenstrain(double water, double content, double free) const {
  if (pressure < 0 || !(bulk > 0.0)) return free;
  const double b = (pores.biot.xx + pores.biot.yy + pores.biot.zz) / 3.0;
  if (!undrained) return free + b * water / (3.0 * bulk);
  const double storage = pores.capacity(0.0);
  return (bulk * free + b * content / (3.0 * storage)) / (bulk + b * b / storage);
}

ElasticConstants undrained(const ElasticConstants& drained, const TransportMaterial& pores) {
  const double b = (pores.biot.xx + pores.biot.yy + pores.biot.zz) / 3.0, shear = drained.shear_modulus();
  const double bulk = drained.youngs / (3.0 * (1.0 - 2.0 * drained.poisson)) + b * b / pores.capacity(0.0);
  ElasticConstants closed = drained;
  closed.youngs = 9.0 * bulk * shear / (3.0 * bulk + shear);
  closed.poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
  return closed;
}

bool closed(const TransportMaterial& pores) { return !(pores.conductivity.most() > 0.0); }

}  // namespace mpm
