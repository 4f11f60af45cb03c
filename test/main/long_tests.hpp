// List of the long cases: `scripts/test --full` alone runs them.
#pragma once

#include <string>

/// True if a case belongs to the long ones: its suite's name, after the prefix of an instantiation, begins with "Full",
/// or a row of test/full.md names it as `Suite.Case`, or the source file that it is in.
bool long_test(const std::string& suite, const std::string& name, const std::string& file);
