#include "wide_ops.hpp"

#include "mpm/kernel/scatter.hpp"

namespace mpm {
namespace {

template <class T>
constexpr mpm_test::WideOps<T> ops() {
  using W = Wide<T>;
  using M = WideMask<T>;
  mpm_test::WideOps<T> o{};
  o.lanes = W::kLanes;
  o.exp = [](const T* x, T* to) { exp(W::load(x)).store(to); };
  o.log = [](const T* x, T* to) { log(W::load(x)).store(to); };
  o.inverse_cbrt = [](const T* x, T* to) { inverse_cbrt(W::load(x)).store(to); };
  o.pow = [](const T* x, const T* y, T* to) { pow(W::load(x), W::load(y)).store(to); };
  o.sqrt = [](const T* x, T* to) { sqrt(W::load(x)).store(to); };
  o.abs = [](const T* x, T* to) { abs(W::load(x)).store(to); };
  o.round = [](const T* x, T* to) { round(W::load(x)).store(to); };
  o.max = [](const T* a, const T* b, T* to) { max(W::load(a), W::load(b)).store(to); };
  o.min = [](const T* a, const T* b, T* to) { min(W::load(a), W::load(b)).store(to); };
  o.select_less = [](const T* a, const T* b, T* to) {
    select(W::load(a) < W::load(b), W::load(a), -W::load(b)).store(to);
  };
  o.less = [](const T* a, const T* b) { return (W::load(a) < W::load(b)).bits(); };
  o.less_equal = [](const T* a, const T* b) { return (W::load(a) <= W::load(b)).bits(); };
  o.equal = [](const T* a, const T* b) { return equal(W::load(a), W::load(b)).bits(); };
  o.first = [](int count) { return M::first(count).bits(); };
  o.combine = [](unsigned a, unsigned b) {
    return ((M::first(static_cast<int>(a)) & !M::first(static_cast<int>(b))) | M::first(1)).bits();
  };
  o.interleave = [](const T* a, T* to) {
    constexpr int N = W::kLanes;
    mpm::interleave(to, W::load(a), W::load(a + N), W::load(a + 2 * N), W::load(a + 3 * N));
  };
  o.permute = [](const T* a, const std::int64_t* at, T* to) {
    typename W::Integers index{};
    for (int l = 0; l < W::kLanes; ++l) index[l] = static_cast<typename W::B::Bits>(at[l]);
    mpm::permute(W::load(a), index).store(to);
  };
  o.load_first = [](const T* from, int count, T* to) { W::load_first(from, count).store(to); };
  o.store_first = [](const T* from, int count, T* to) { W::load(from).store_first(to, count); };
  o.place = [](const double* x, int count, double origin, double scale, double shift, T* to) {
    W(W::B::place(x, count, origin, scale, shift)).store(to);
  };
  o.displace = [](double* x_new, const double* x, const T* displacement, int count) {
    W::B::displace(x_new, x, W::load(displacement).v, count);
  };
  return o;
}

}  // namespace

const mpm_test::WideOps<double>& wide_ops_double() {
  static constexpr mpm_test::WideOps<double> kOps = ops<double>();
  return kOps;
}
const mpm_test::WideOps<float>& wide_ops_single() {
  static constexpr mpm_test::WideOps<float> kOps = ops<float>();
  return kOps;
}

}  // namespace mpm
