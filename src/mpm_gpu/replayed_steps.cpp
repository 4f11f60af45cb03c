#include "mpm_gpu/replayed_steps.hpp"

namespace mpm_gpu {

void ReplayedSteps::begin(Executor& run) {
  flags_.fit(2);
  numbers_.fit(1);
  std::uint32_t* flags = flags_.data();
  Numbers* numbers = numbers_.data();
  run.for_each("gpu: checks", 1, [=](long) {
    flags[kSorts] = 0;
    flags[kGoesOn] = 1;
    *numbers = Numbers{};
  });
}

void ReplayedSteps::sorted(Executor& run, const std::uint32_t* counts, long owners_room, long blocks_room) {
  std::uint32_t* flags = flags_.data();
  Numbers* numbers = numbers_.data();
  run.for_each("gpu: checks", 1, [=](long) {
    ++numbers->sorts;
    flags[kSorts] = 0;
    if (counts[0] <= owners_room && counts[1] <= blocks_room) return;
    flags[kGoesOn] = 0;
    numbers->failure = kNoRoom;
    numbers->owners = counts[0];
    numbers->blocks = counts[1];
  });
}

void ReplayedSteps::stepped(Executor& run, const Faults* faults, const Taken* taken, const std::uint32_t* id,
                            const std::array<const double*, 3>& places) {
  struct Kernel {
    const Faults* faults;
    const Taken* taken;
    const std::uint32_t* id;
    const double* x[3];
    std::uint32_t* flags;
    Numbers* numbers;
    constexpr void operator()(long) const {
      flags[kSorts] = faults->left ? 1U : 0U;
      const bool inverted = faults->inverted != Faults::kNone;
      if (!inverted && faults->outside == Faults::kNone) {
        ++numbers->steps;
        if (taken != nullptr) numbers->taken += *taken;
        return;
      }
      // A particle outside is in no cell: nothing may be sorted or gathered any more.
      flags[kSorts] = flags[kGoesOn] = 0;
      const std::uint32_t p = inverted ? faults->inverted : faults->outside;
      numbers->failure = inverted ? kInverted : kOutside;
      numbers->id = id[p];
      for (int k = 0; k < 3; ++k) numbers->place[k] = x[k] == nullptr ? 0.0 : x[k][p];
    }
  };
  run.for_each("gpu: checks", 1,
               Kernel{faults, taken, id, {places[0], places[1], places[2]}, flags_.data(), numbers_.data()});
}

ReplayedSteps::Numbers ReplayedSteps::look(Executor& run) {
  const Numbers now = numbers_.get(0);
  Numbers* numbers = numbers_.data();
  run.for_each("gpu: checks", 1, [=](long) {
    numbers->sorts = numbers->steps = 0;
    numbers->taken = Taken{};
  });
  return now;
}

}  // namespace mpm_gpu
