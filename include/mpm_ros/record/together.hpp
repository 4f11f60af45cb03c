// Work that one rank of several does alone, such as writing a file, and all have to know the end of.
#pragma once

#include <exception>

#include "mpm/ranks/communicator.hpp"

namespace mpm_ros {

/// Calls work(), in which ranks do not speak to each other. Where it throws on one rank it throws on all: there what it
/// threw, and on the others an OnOthers of which nothing is to be told. `ranks`: null for a process that is alone.
template <class OnOthers, class Work>
void together(mpm::Communicator* ranks, const Work& work) {
  if (ranks == nullptr) {
    work();
    return;
  }
  std::exception_ptr own;
  try {
    work();
  } catch (...) {
    own = std::current_exception();
  }
  if (!ranks->any(own != nullptr)) return;
  if (own) std::rethrow_exception(own);
  throw OnOthers("another rank could not go on");
}

}  // namespace mpm_ros
