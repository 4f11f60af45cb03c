// Prints the widest instruction set that kernels can be compiled for and this machine has, or nothing:
// src/mpm/kernel/kernels.cmake asks.
#include <cstdio>

int main() {
  if (__builtin_cpu_supports("x86-64-v4")) {
    std::fputs("avx512", stdout);
  } else if (__builtin_cpu_supports("x86-64-v3")) {
    std::fputs("avx2", stdout);
  }
  return 0;
}
