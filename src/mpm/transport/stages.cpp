#include "mpm/transport/stages.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kEuler = 0.25;  ///< part of a stable step: in a longer one Euler's method errs more than stages cost

}  // namespace

double stages_needed(double ratio) {
  return ratio > kEuler ? std::ceil(0.5 * (std::sqrt(9.0 + 16.0 * ratio) - 1.0)) : 1.0;
}

int stages_for(double ratio) {
  if (!(ratio > kEuler)) return 1;
  int stages = static_cast<int>(stages_needed(ratio));
  stages = std::max(3, stages);
  return stages % 2 == 1 ? stages : stages + 1;
}

}  // namespace mpm
