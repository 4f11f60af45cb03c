// The loops over the parts of BlockShares, for files that are compiled with OpenMP.
#pragma once

#include <omp.h>

#include "mpm/grid/block_shares.hpp"

namespace mpm {

template <class Visit>
void BlockShares::at_once(int threads, Visit&& visit) const {
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int part = 0; part < parts(); ++part) {
    for (int owner = begin_[part]; owner < begin_[part + 1]; ++owner) visit(owner);
  }
}

template <class Visit>
void BlockShares::by_colour(int threads, Visit&& visit) const {
  for (int part = 0; part < parts(); ++part) done_[part].colours.store(0, std::memory_order_relaxed);
#pragma omp parallel num_threads(threads)
  {
    const int first = omp_get_thread_num(), step = omp_get_num_threads();
    for (int colour = 0; colour < colours_; ++colour) {
      for (int part = first; part < parts(); part += step) {
        const int* of_colour = &runs_[2 * (part * colours_ + colour)];
        if (of_colour[0] != of_colour[1]) wait_for_others(part, colour);
        for (int i = of_colour[0]; i < of_colour[1]; ++i) visit(order_[i]);
        done_[part].colours.store(colour + 1, std::memory_order_release);
        for (int i = of_colour[1]; i < of_colour[2]; ++i) visit(order_[i]);
      }
    }
  }
}

}  // namespace mpm
