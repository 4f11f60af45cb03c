#include "mpm_ros/run/run_scene_files.hpp"

#include <fmt/format.h>

#include <fstream>

#include "mpm/math/json_text.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/terrain/ground_map.hpp"
#include "mpm/terrain/height_file.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/record/together.hpp"
#include "mpm_ros/run/run_scene_options.hpp"
#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {

void RunSceneFiles::try_all() {
  if (!options_.out.empty()) choose_folder();
  try_file("--summary", options_.summary);
  if (!options_.terrain.empty()) ground_at_end(scene_);
  if (first()) try_file("--terrain", options_.terrain);
  try_folder("--csv", options_.csv);
  try_folder("--vtk", options_.vtk);
}

void RunSceneFiles::open(Run& run) {
  mpm::Communicator* ranks = options_.ranks.get();
  options_.vtk = mpm::text_of_all(ranks, options_.vtk);
  together<mpm::SceneError>(ranks, [&] {
    if (!options_.csv.empty()) {
      const bool axisymmetric = mpm::axisymmetric(scene_.definition.geometry);
      csv_ = std::make_unique<Leavable<CsvSink>>(options_.csv, stamps_, axisymmetric);
      run.add(*csv_);
    }
    if (options_.vtk.empty()) return;
    vtk_ = std::make_unique<Leavable<VtkSink>>(options_.vtk, stamps_, ranks);
    run.add(*vtk_);
  });
}

// A folder of its own, and in it all that was not given a place.
void RunSceneFiles::choose_folder() {
  options_.out = make_run_folder(options_.out, scene_.definition.name);
  const auto place = [this](std::string& path, const char* name) {
    if (path.empty()) path = options_.out + "/" + name;
  };
  place(options_.bag, "run.bag");
  place(options_.csv, "csv");
  place(options_.vtk, "vtk");
  place(options_.summary, "summary.json");
  std::ofstream text(options_.out + "/scene.yaml");
  text << scene_.text << "\n";
  if (!text.flush()) throw mpm::SceneError(fmt::format("--out: {}/scene.yaml cannot be written", options_.out));
}

void RunSceneFiles::close_csv() {
  if (csv_ && !csv_->left_out()) csv_->close();
}

void RunSceneFiles::close_vtk() {
  if (vtk_ && !vtk_->left_out()) vtk_->close();
}

bool RunSceneFiles::write_summary(const RunSummary& summary, std::ostream& err) const {
  if (options_.summary.empty()) return true;
  try {
    write_whole(options_.summary, mpm::json_text(summary.json(), 2) + "\n");
    return true;
  } catch (const MachineError& error) {
    err << "run_scene: --summary " << error.what() << "\n";
    return false;
  }
}

bool RunSceneFiles::write_terrain(const mpm::Simulation& simulation, std::ostream& out, std::ostream& err) const {
  if (options_.terrain.empty()) return true;
  const mpm::GroundOutput ground = ground_at_end(scene_);
  const mpm::SimulationDefinition& definition = simulation.definition();
  mpm::GroundMap map(simulation, ground.of);
  const mpm::HeightGrid& heights =
      map.read(simulation, mpm::ground_raster(definition.grid, definition.geometry, ground.resolution));
  if (!first()) return true;
  try {
    mpm::write_height_tiff(options_.terrain, heights);
  } catch (const mpm::SceneError& error) {
    err << "run_scene: --terrain " << error.what() << "\n";
    return false;
  }
  out << "  ground in " << options_.terrain << "\n";
  return true;
}

}  // namespace mpm_ros
