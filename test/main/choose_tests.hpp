// Which cases of a test program run, by its arguments; the rest is GoogleTest's.
#pragma once

/// Reads what GoogleTest left of the arguments:
///   --file=NAME   only the cases of the source file NAME_test.cpp
///   --long        only the long cases (test/full.md); without it they run if MPM_FULL is in the environment
/// and sets GoogleTest's filter, unless one was given. Returns 0, or the exit code to end with: 77 ("skipped") where no
/// case is chosen, 2 for an argument that is not known.
int choose_tests(int argc, char** argv);
