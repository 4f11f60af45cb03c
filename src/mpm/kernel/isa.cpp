#include "mpm/kernel/isa.hpp"

#include <fmt/core.h>

namespace mpm {
namespace {

constexpr Isa kAll[] = {Isa::plain, Isa::avx2, Isa::avx512};

}  // namespace

const char* isa_name(Isa isa) {
  switch (isa) {
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
    case Isa::plain:
      break;
  }
  return "plain";
}

std::optional<Isa> find_isa(const std::string& name) {
  for (const Isa isa : kAll) {
    if (name == isa_name(isa)) return isa;
  }
  return std::nullopt;
}

bool isa_available(Isa isa) {
#if defined(MPM_PLAIN_KERNELS)
  if (isa == Isa::plain) return true;
#endif
#if defined(MPM_AVX2_KERNELS)
  if (isa == Isa::avx2) return __builtin_cpu_supports("x86-64-v3");
#endif
#if defined(MPM_AVX512_KERNELS)
  if (isa == Isa::avx512) return __builtin_cpu_supports("x86-64-v4");
#endif
  return false;
}

Isa best_isa() {
  std::optional<Isa> best;
  for (const Isa isa : kAll) {
    if (isa_available(isa)) best = isa;
  }
  if (best) return *best;
  throw IsaError(
      "this build has kernels for another machine alone; build it on this one, or with -DMPM_KERNELS=machine, which "
      "adds those that "
      "any machine can run");
}

Isa choose_isa(const std::string& name) {
  if (name.empty() || name == "auto") return best_isa();
  const std::optional<Isa> isa = find_isa(name);
  if (isa && isa_available(*isa)) return *isa;
  std::string there;
  for (const Isa other : kAll) {
    if (isa_available(other)) there += (there.empty() ? "" : ", ") + std::string(isa_name(other));
  }
  throw IsaError(fmt::format(isa ? "this machine, or this build (-DMPM_KERNELS=all has them all), does not have the "
                                   "instruction set '{}'; it has {}"
                                 : "there is no instruction set '{}'; this machine has {}",
                             name, there));
}

}  // namespace mpm
