// The table of one geometry's laws, made of the closed list of laws (material/law.hpp).
#pragma once

#include <variant>

#include "mpm/kernel/stress.hpp"
#include "mpm/kernel/survey.hpp"
#include "mpm/material/law.hpp"

namespace mpm {

template <class Geometry, class T, class List = Law>
struct LawTable;
template <class Geometry, class T, class... Laws>
struct LawTable<Geometry, T, std::variant<Laws...>> {
  static constexpr mpm_kernel::LawKernels<T> kKernels[] = {{&Stress<Geometry, T>::template update<Laws>,
                                                            &Stress<Geometry, T>::columns,
                                                            &Survey<Geometry, T>::template fastest<Laws>}...};
};

}  // namespace mpm
