// The line with which the node begins: what runs, how fast, where, and what it waits for.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mpm_ros/node/node_parameters.hpp"

namespace mpm_ros {

struct StartFacts {
  std::string scene;
  std::uint64_t particles = 0;
  Pacing pacing = Pacing::real_time;
  double real_time_factor = 1.0;  ///< asked for
  int ranks = 1;
  int threads = 1;         ///< threads of each rank
  std::string name_space;  ///< absolute: "/mpm", or "/"
  double end = 0.0;        ///< [s]; 0: none
  bool paused = false;
  bool clock = false;                                        ///< publishes /clock
  std::string commands;                                      ///< bag whose commands are replayed; empty: none
  std::vector<std::pair<std::string, std::string>> frames;   ///< frames of bodies that follow one: body, tf frame
  std::vector<std::pair<std::string, std::string>> heights;  ///< heights that came in a message: body, topic
};

/// "blade_in_soil: 40640 particles, lockstep, 2 threads, in /mpm; waits for the service /mpm/step"
std::string start_line(const StartFacts& facts);

}  // namespace mpm_ros
