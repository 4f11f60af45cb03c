// Functions of the standard library that a device lacks and that laws call on single numbers: overloads for the device,
// which a compiler takes there in place of the host's. For clang, after the headers that declare the host's.
#pragma once

__attribute__((device)) inline double sqrt(double x) { return __builtin_sqrt(x); }

namespace std {
__attribute__((device)) inline double sqrt(double x) { return __builtin_sqrt(x); }
// Functions of the energy of laws, which law_functions.hpp defines.
__attribute__((device)) double exp(double x);
__attribute__((device)) double log(double x);
__attribute__((device)) double pow(double x, double y);
__attribute__((device)) double cbrt(double x);
__attribute__((device)) double log1p(double x);
__attribute__((device)) double expm1(double x);
}  // namespace std
