// The loops over the parts of BlockShares, for files that are compiled with OpenMP.
#pragma once

#include "mpm/grid/block_shares.hpp"
#include "mpm/loop/loop.hpp"

namespace mpm {

template <class Visit>
void BlockShares::at_once(const char* name, int threads, Visit&& visit) const {
  for_team(name, threads, [&](const Team& team) {
    for (int part = team.thread; part < parts(); part += team.threads) {
      for (int owner = begin_[part]; owner < begin_[part + 1]; ++owner) visit(owner);
    }
  });
}

template <class Visit>
void BlockShares::by_colour(const char* name, int threads, Visit&& visit) const {
  for (int part = 0; part < parts(); ++part) done_[part].colours.store(0, std::memory_order_relaxed);
  for_team(name, threads, [&](const Team& team) {
    for (int colour = 0; colour < colours_; ++colour) {
      for (int part = team.thread; part < parts(); part += team.threads) {
        const int* of_colour = &runs_[2 * (part * colours_ + colour)];
        if (of_colour[0] != of_colour[1]) wait_for_others(part, colour);
        for (int i = of_colour[0]; i < of_colour[1]; ++i) visit(order_[i]);
        done_[part].colours.store(colour + 1, std::memory_order_release);
        for (int i = of_colour[1]; i < of_colour[2]; ++i) visit(order_[i]);
      }
    }
  });
}

}  // namespace mpm
