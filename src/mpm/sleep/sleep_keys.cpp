#include "mpm/sleep/sleep_keys.hpp"

namespace mpm {

const KeyTable<SleepDefinition>& sleep_keys() {
  using Sleep = SleepDefinition;
  static const auto keys = KeyTable<Sleep>("sleep").rows(
      {number(
           "speed", &Sleep::speed, kVelocity, kPositive,
           {"a hundredth of √(gravity × cell)", "a block may fall asleep while no particle in it is faster", "5 mm/s"}),
       number("after", &Sleep::after, kTime, kPositive,
              {"√(cell / gravity)", "for which a block has to be at rest before it falls asleep", "0.05"}),
       number(
           "wake", &Sleep::wake, kVelocity, kPositive,
           {"3 `speed`", "of a wave, or of material that comes in, that wakes a block; at least `speed`", "15 mm/s"}),
       number(
           "balance", &Sleep::balance, kPlain, kPositive,
           {"", "part of the force on a block that has lost its balance, in the mean over `after`, at which it wakes",
            "0.4"}),
       number("damping", &Sleep::damping, kPlain, from_to_below(0.0, 1.0),
              {"",
               "nodes slower than 4 `speed` lose this part of the force without balance where it drives them on, and "
               "gain it where it slows them; less, the nearer they are to 4 `speed`",
               "0.3"}),
       number("temperature", &Sleep::temperature, kTemperature, kPositive,
              {"a thousandth of the range of the values that the scene gives",
               "change at the border of a block that wakes it; a block that changes by it in the time in which heat "
               "crosses it does not fall asleep",
               "0.1 K"}),
       number("concentration", &Sleep::concentration, kPlain, kPositive,
              {"as `temperature`", "the same of a concentration", "1e-3"}),
       number("pore_pressure", &Sleep::pore_pressure, kPressure, kPositive,
              {"as `temperature`", "the same of the pressure of water in pores", "50 Pa"}),
       plain("from_start", &Sleep::from_start,
             {"", "what is at rest when the run begins sleeps after the first step; for soil that starts `geostatic`",
              "true"})});
  return keys;
}

}  // namespace mpm
