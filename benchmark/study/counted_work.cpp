#include "study/counted_work.hpp"

namespace mpm::study {
namespace {

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

}  // namespace

double passes(UpdateScheme update, const Transfer& transfer) {
  const double plain = update == UpdateScheme::usf ? 4 : update == UpdateScheme::usl ? 5 : 6;
  const bool filtered = transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm;
  if (transfer.mixes()) return plain + 2.0 * (transfer.mixed - 1) / transfer.every;
  return plain + (filtered ? 2.0 * (transfer.order - 1) : 0.0);
}

int visits(ShapeKind shape, int dim) { return power(traits_of(shape).nodes, dim); }

double counted_work(const MethodDefinition& method, int dim) {
  return visits(method.shape, dim) * passes(method.update, method.transfer);
}

}  // namespace mpm::study
