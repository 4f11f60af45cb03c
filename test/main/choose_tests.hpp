// Choice of the cases of a test program that run, by its arguments; the rest is GoogleTest's.
#pragma once

/// Reads what GoogleTest left of the arguments: --file=NAME, only the cases of the source file NAME_test.cpp. Long
/// cases (test/full.md) run if MPM_FULL is in the environment. Sets GoogleTest's filter, unless one was given. Returns
/// 0, or the exit code to end with: 77 ("skipped") where all cases are long, 2 for an argument that is not known or a
/// file without cases.
int choose_tests(int argc, char** argv);
