// rosrun mpm_ros material_driver MATERIAL [PATH]: drives one piece of material along a path of strain or stress. Wiring
// only; see mpm/sections/material_driver.hpp.
//
// Exit codes: 0 done, 1 the disk is full, 2 bad input, 3 the law failed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "mpm/material/path_driver.hpp"
#include "mpm/math/files_in_use.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm/sections/material_driver.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace {

/// Writes the table to a file, which is replaced when there is another table: on bad input it stays as it was, and a
/// law that fails leaves the steps before. Returns the exit code. @throws std::exception as drive_material() does
int drive_to(const std::string& csv, const mpm::MaterialDriverOptions& options) {
  mpm::FilesInUse files;
  files.reads("the scene", options.scene);
  files.reads("the path", options.path_file);
  files.writes("--csv", csv);
  const std::string part = mpm::behind_links(csv) + ".part";
  files.writes("--csv", part);
  std::ofstream file;
  std::string problem = mpm::refused_output(csv);
  if (problem.empty()) problem = mpm::open_output(file, part);
  if (!problem.empty()) {
    std::cerr << "material_driver: " << csv << ": cannot be written: " << problem << "\n";
    return 2;
  }
  const auto keep = [&] {
    file.close();
    if (file && std::rename(part.c_str(), mpm::behind_links(csv).c_str()) == 0) return 0;
    std::remove(part.c_str());
    std::cerr << "material_driver: " << csv << ": cannot be written; check the space on its disk\n";
    return 1;
  };
  try {
    mpm::drive_material(options, file);
    return keep();
  } catch (const mpm::PathFailure&) {
    keep();
    throw;
  } catch (...) {
    std::remove(part.c_str());
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  mpm_ros::ignore_file_limit();
  mpm::MaterialDriverOptions options;
  std::string csv;
  CLI::App app(
      "Drives one piece of material along a path of strain or stress, and prints its stress and state as CSV.");
  app.add_option("MATERIAL", options.material,
                 "'{law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}', as in a scene; with --scene a name")
      ->required();
  app.add_option("PATH", options.path,
                 "uniaxial_strain, uniaxial_stress, triaxial, simple_shear, volumetric, relaxation or creep");
  app.add_option("--scene", options.scene, "take the material from this scene: a shipped name, or a path");
  app.add_option("--path", options.path_file, "a path of your own: CSV with columns such as t, ezz, sxx [kPa], gxz");
  app.add_option("--strain", options.strain, "strain at the end (-0.01; in shear 0.01); compression is negative");
  app.add_option("--confining", options.confining, "triaxial: confining pressure (100 kPa)");
  app.add_option("--stress", options.stress, "creep: the constant stress; compression is negative");
  app.add_option("--rate", options.rate, "strain rate, in 1/s (1)");
  app.add_option("--hold", options.hold, "relaxation, creep: time at constant strain or stress, in s (1)");
  app.add_option("--storage", options.storage,
                 "the last leg is undrained, stresses are total: storage 1/Q of the water in the pores, in 1/Pa");
  app.add_option("--biot", options.biot, "with --storage: Biot's coefficient (1)");
  app.add_option("--heating", options.heating, "the last leg is heated by so many K; with --expansion");
  app.add_option("--expansion", options.expansion, "linear thermal expansion, in 1/K");
  app.add_flag("--shear", options.shear, "relaxation, creep: shear xz instead of strain along z with free sides");
  app.add_option("--steps", options.steps,
                 "steps per leg of the path (100), or from one row of a file to the next (10)")
      ->check(CLI::Range(1, 10000000));
  app.add_option("--csv", csv, "write to this file instead of the terminal");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (csv.empty()) {
      mpm::drive_material(options, std::cout);
      return 0;
    }
    return drive_to(csv, options);
  } catch (const mpm::PathFailure& error) {
    std::cerr << "material_driver: " << error.what() << "\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "material_driver: " << error.what() << "\n";
    return 2;
  }
}
