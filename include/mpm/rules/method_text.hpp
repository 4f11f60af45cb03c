// A method in words, as scenes spell it: for --explain, summaries and reports.
#pragma once

#include <string>

#include "mpm/definition/definition.hpp"

namespace mpm {

/// "usf", "usl", "usavg"
std::string update_name(UpdateScheme update);

/// "flip", "pic", "flip 0.99", "apic", "xpic 2", "fmpm 3"
std::string transfer_text(const Transfer& transfer);

/// "grid 5 1/s in the force, pic 0.01 a step"; empty without damping.
std::string damping_text(const DampingDefinition& damping);

/// "ugimp, usavg, flip, double precision, 2 terms of the deformation's exponential", and what else was asked for.
std::string method_text(const MethodDefinition& method);

}  // namespace mpm
