// The methods that are charted, and their names.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/math/error.hpp"

namespace mpm::choice {

/// A method or suite that there is not, or a table that is none.
class ChoiceError : public Error {
 public:
  using Error::Error;
};

struct MethodChoice {
  std::string label;  ///< "cpdi/usavg/fmpm2"
  MethodDefinition method;
};

/// "flip", "flip0.99", "pic", "xpic2", "fmpm3", "apic".
std::string transfer_label(const Transfer& transfer);
/// "shape/update/transfer", and "/single" for that precision.
MethodChoice choose(ShapeKind shape, UpdateScheme update, const Transfer& transfer,
                    Precision precision = Precision::float64);

/// Every shape function with each update and FLIP; every transfer with uGIMP and CPDI; the pairs that other codes are
/// known for; single precision. The first is uGIMP/USF/FLIP, which costs are relative to.
std::vector<MethodChoice> charted_methods();
/// The part of them for costly problems: each shape function, each update and each transfer once.
std::vector<MethodChoice> main_methods();
/// @throws ChoiceError for a label that is not among charted_methods(), with the nearest that is before all of them
MethodChoice find_method(const std::string& label);

}  // namespace mpm::choice
