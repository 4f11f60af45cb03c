// Memory of another process, for tests that it stays flat.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <fstream>
#include <string>

/// Resident memory of a process [kB].
inline double memory_of(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6));
  }
  ADD_FAILURE() << "no memory is reported for process " << pid;
  return 0.0;
}
