// A run at a sync point as an HDF5 file: a run that takes it on goes on to the bit like one that was never stopped.
//
//   save_checkpoint("run.h5", simulation, {scene.path, scene.text, {}});
//   …
//   Simulation again(build(scene), {threads, isa, false});
//   load_checkpoint("run.h5", again, scene.text);
//
// A file is written beside its name and renamed when it is whole: under the name there is always a whole one, or the
// one before. It holds the scene's text, so it alone is enough to go on. Not compressed: numbers of a run that moves
// hardly shrink, and packing them takes many times as long as writing (doc/checkpoints.md).
// Weak: it fits the version that wrote it; another layout of the state is another version, which is refused.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "mpm/math/error.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {

/// A checkpoint that cannot be written, read, or taken on by this run. what() names the file and the remedy.
class CheckpointError : public Error {
 public:
  using Error::Error;
};

/// What whoever saves a run says of it.
struct CheckpointLabel {
  std::string scene_path;
  std::string scene_text;
  std::string failure;  ///< why the run cannot go on; empty: it can
};

/// What a checkpoint says of itself.
struct CheckpointAbout {
  std::string format;         ///< kCheckpointFormat
  std::uint32_t version = 0;  ///< of the layout
  std::string program;        ///< version of the package that wrote it
  std::string scene;          ///< its name
  CheckpointLabel label;
  std::string geometry, method, precision, isa;
  std::uint64_t particles = 0;
  std::int64_t time = 0;         ///< simulated [ns]
  std::uint64_t state_hash = 0;  ///< Simulation::state_hash()
  std::uint64_t checksum = 0;    ///< Simulation::memory_hash()
};

inline constexpr const char* kCheckpointFormat = "mpm_ros checkpoint";
inline constexpr std::uint32_t kCheckpointVersion = 2;

/// Keeps what belongs to the run but not to the Simulation.
using SerialiseMore = std::function<void(StateArchive&)>;

/// Returns what the file then says of itself. @throws CheckpointError; then a file of that name is as it was.
CheckpointAbout save_checkpoint(const std::string& path, Simulation& simulation, const CheckpointLabel& label,
                                const SerialiseMore& more = {});
/// @throws CheckpointError for a file that is none, or of another version
CheckpointAbout read_checkpoint(const std::string& path);
/// `scene_text`: that `simulation` was built from. @throws CheckpointError for a file that is none, is damaged, of
/// another version, scene, instruction set or precision, or of a run that failed. If it is damaged, the simulation
/// cannot go on; else it is as it was.
CheckpointAbout load_checkpoint(const std::string& path, Simulation& simulation, const std::string& scene_text,
                                const SerialiseMore& more = {});

}  // namespace mpm
