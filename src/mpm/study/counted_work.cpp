#include "mpm/study/counted_work.hpp"

namespace mpm::study {
namespace {

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

}  // namespace

int passes(UpdateScheme update, const Transfer& transfer) {
  const int plain = update == UpdateScheme::usf ? 4 : update == UpdateScheme::usl ? 5 : 6;
  const bool filtered = transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm;
  return plain + (filtered ? 2 * (transfer.order - 1) : 0);
}

int visits(ShapeKind shape, int dim) {
  switch (shape) {
    case ShapeKind::dirac:
      return power(2, dim);
    case ShapeKind::ugimp:
    case ShapeKind::ugimp_stretch:
    case ShapeKind::bspline2:
      return power(3, dim);
    case ShapeKind::bspline3:
      return power(4, dim);
    case ShapeKind::cpdi:
      return power(4, dim);
    case ShapeKind::qcpdi:
      return power(6, dim);
  }
  return 0;
}

double counted_work(const MethodDefinition& method, int dim) {
  return static_cast<double>(visits(method.shape, dim) * passes(method.update, method.transfer));
}

}  // namespace mpm::study
