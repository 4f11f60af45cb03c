// A run at a sync point as an HDF5 file: a run that is resumed from it continues to the bit like one that was never
// stopped.
//
//   save_checkpoint("run.h5", simulation, {scene.path, scene.text, {}});
//   …
//   Simulation again(build(scene), {threads, isa, false});
//   load_checkpoint("run.h5", again, scene.text);
//
// A file is written under another name and renamed when it is complete, so the named file is always complete: the new
// one or the previous one. It contains the scene's text, so it is enough to resume the run. It is not compressed,
// because the numbers of a moving run hardly shrink, and compressing takes many times as long as writing
// (doc/checkpoints.md). Weak: it fits only the version of the layout that wrote it; files of other versions are
// refused.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "mpm/math/error.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {

/// A checkpoint that cannot be written or read, or from which this run cannot be resumed. what() names the file and the
/// remedy.
class CheckpointError : public Error {
 public:
  using Error::Error;
};

/// Data that the caller adds to a checkpoint.
struct CheckpointLabel {
  std::string scene_path;
  std::string scene_text;
  std::string failure;  ///< reason why the run has failed; empty if it has not
};

/// Description of a checkpoint, stored in it.
struct CheckpointAbout {
  std::string format;         ///< kCheckpointFormat
  std::uint32_t version = 0;  ///< version of the layout
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
inline constexpr std::uint32_t kCheckpointVersion = 13;

/// Serialises the state of a run that is outside the Simulation.
using SerialiseMore = std::function<void(StateArchive&)>;

/// Returns the description that was stored. @throws CheckpointError; an existing file of that name is not changed then.
CheckpointAbout save_checkpoint(const std::string& path, Simulation& simulation, const CheckpointLabel& label,
                                const SerialiseMore& more = {});
/// First line that differs between two texts that are not the same, in words.
std::string text_difference(const std::string& here, const std::string& there);
/// @throws CheckpointError for a file that is not a checkpoint, or of another version
CheckpointAbout read_checkpoint(const std::string& path);
/// Difference, in words, between the text of a checkpoint's scene and the scene that is to go on from there; empty
/// where it can.
using SceneDifference = std::function<std::string(const std::string& recorded)>;
/// `scene_text`: the scene from which `simulation` was built. `difference`: what counts as another one; any other text,
/// unless it is given. Metrics that the recorded run had go on, others begin. @throws CheckpointError for a file that
/// is not a checkpoint, is damaged, belongs to another version, scene, instruction set or precision, or to a run that
/// failed, or lacks what a metric of this run needs. If the file is damaged or a metric is refused, the simulation must
/// not go on; otherwise it is not changed.
CheckpointAbout load_checkpoint(const std::string& path, Simulation& simulation, const std::string& scene_text,
                                const SerialiseMore& more = {}, const SceneDifference& difference = {});

}  // namespace mpm
