// The instruction sets that the kernels are compiled for. Results of two sets differ in the last bits, since sums are
// grouped differently and some fuse products and sums; on one set they do not depend on the machine or the number of
// threads.
#pragma once

#include <optional>
#include <string>

#include "mpm/math/error.hpp"

namespace mpm {

enum class Isa { plain, avx2, avx512 };

/// "plain", "avx2", "avx512".
const char* isa_name(Isa isa);
/// Nothing for a name that is none.
std::optional<Isa> find_isa(const std::string& name);
/// True if this machine has it, and this build too.
bool isa_available(Isa isa);

/// An instruction set that is not known, or not there. what() lists those that are.
class IsaError : public Error {
 public:
  using Error::Error;
};

/// The widest one available. @throws IsaError where the build has none that this machine has
Isa best_isa();
/// By name; "auto" or an empty one: the widest one available. @throws IsaError
Isa choose_isa(const std::string& name);

}  // namespace mpm
