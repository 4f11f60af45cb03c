// Files that run_scene writes beside the recording: tables, files for ParaView, the summary, the ground at the end, and
// the folder that holds all of them. Each place is tried before the run; one that cannot go on leaves the others be.
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/record/run_scene_csv.hpp"
#include "mpm_ros/record/run_scene_vtk.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "mpm_ros/run/run_scene_summary.hpp"

namespace mpm_ros {

class RunSceneFiles {
 public:
  /// All outlive this object. `options`: those of this rank, which get the places that --out chooses.
  RunSceneFiles(RunSceneOptions& options, const mpm::Scene& scene, const Stamps& stamps)
      : options_(options), scene_(scene), stamps_(stamps) {}

  /// Tries the files, so that one that cannot be is told of before the run. Nothing is replaced yet: a run that does
  /// not come to its start leaves what an earlier one wrote. @throws mpm::SceneError
  void try_all();
  /// Opens sinks if there is something to write. Files for ParaView on all ranks, in the folder that the first one
  /// has. @throws mpm::SceneError on all ranks
  void open(Run& run);

  /// The tables, or the files for ParaView, get no more.
  void leave_out_csv() { csv_->leave_out(); }
  void leave_out_vtk() { vtk_->leave_out(); }
  /// @throws CsvError
  void close_csv();
  /// @throws VtkError
  void close_vtk();

  /// At the end. Whether there was nothing to write or it found room; why it did not goes to `err`.
  bool write_summary(const RunSummary& summary, std::ostream& err) const;
  /// The ground is read on all ranks, and written by the first.
  bool write_terrain(const mpm::Simulation& simulation, std::ostream& out, std::ostream& err) const;

 private:
  /// A sink that gets no more once it is left out.
  template <typename Sink>
  class Leavable : public Sink {
   public:
    using Sink::Sink;
    void leave_out() { left_out_ = true; }
    bool left_out() const { return left_out_; }
    bool wants(const std::string& topic) const override { return !left_out_ && Sink::wants(topic); }

   private:
    bool left_out_ = false;
  };

  void choose_folder();
  bool first() const { return !options_.ranks || options_.ranks->first(); }

  RunSceneOptions& options_;
  const mpm::Scene& scene_;
  const Stamps& stamps_;
  std::unique_ptr<Leavable<CsvSink>> csv_;
  std::unique_ptr<Leavable<VtkSink>> vtk_;
};

}  // namespace mpm_ros
