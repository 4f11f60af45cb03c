// The input and output of the program material_driver.
#include "mpm/sections/material_driver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mpm/material/path_driver.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {
namespace material_driver_test {

const char* const kSand =
    "{law: mohr_coulomb, density: 1600, young: 10 MPa, poisson: 0.3, friction_angle: 30 deg, dilation_angle: 5 deg}";

std::vector<std::vector<std::string>> table(const MaterialDriverOptions& options) {
  std::ostringstream out;
  drive_material(options, out);
  std::istringstream in(out.str());
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

double last(const std::vector<std::vector<std::string>>& rows, const std::string& column) {
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    if (rows[0][i] == column) return std::stod(rows.back().at(i));
  }
  ADD_FAILURE() << "no column " << column;
  return NAN;
}

/// A file that is removed at the end of the test.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& text)
      : path((std::filesystem::temp_directory_path() /
              ("path_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv"))
                 .string()) {
    std::ofstream(path) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  std::string path;
};

std::string error_of(const MaterialDriverOptions& options) {
  try {
    std::ostringstream out;
    drive_material(options, out);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

// 100 kPa confining pressure, phi = 30 degrees: 300 kPa axial stress (exact-solutions 24), with units in the options.
// Ten digits are printed.
TEST(MaterialDriver, PrintsATriaxialTest) {
  MaterialDriverOptions options;
  options.material = kSand;
  options.path = "triaxial";
  options.confining = "1 bar";
  options.strain = "-8%";
  options.rate = "2 1/s";
  options.steps = 20;
  const auto rows = table(options);
  ASSERT_EQ(rows.size(), 1U + 1U + 20U + 20U);  // header, start, confining, axial
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_NEAR(last(rows, "szz [Pa]"), -300e3, 1e-3);
  EXPECT_NEAR(last(rows, "sxx [Pa]"), -100e3, 1e-3);
  EXPECT_NEAR(last(rows, "p [Pa]"), 500e3 / 3.0, 1e-3);
  EXPECT_NEAR(last(rows, "mises [Pa]"), 200e3, 1e-3);
  const auto ezz = std::find(rows[0].begin(), rows[0].end(), "ezz [1]") - rows[0].begin();
  const double confined = std::stod(rows[1 + 20][ezz]);
  EXPECT_LT(confined, 0.0);
  EXPECT_NEAR(last(rows, "ezz [1]") - confined, -0.08, 1e-11);  // beyond the strain of the pressure
  EXPECT_NEAR(last(rows, "time [s]"), 2.0 * 0.08 / 2.0, 1e-10);
  EXPECT_GT(last(rows, "plastic_strain [1]"), 0.05);
  EXPECT_GT(last(rows, "wave_speed [m/s]"), 0.0);
}

// Without a grid the width of a shear band has to be said. Then the strength ends at that of 20 degrees, Kp = 2.0396.
TEST(MaterialDriver, SoftensSoilInABandThatIsGiven) {
  MaterialDriverOptions options;
  const std::string sand =
      "{law: mohr_coulomb, density: 1600, young: 10 MPa, poisson: 0.3, friction_angle: 30 deg, softening_slip: 1 mm, "
      "residual_friction_angle: 20 deg";
  options.material = sand + "}";
  options.path = "triaxial";
  options.strain = "-20%";
  EXPECT_NE(error_of(options).find("add shear_band"), std::string::npos);
  options.material = sand + ", shear_band: 2 cm}";
  EXPECT_NEAR(last(table(options), "szz [Pa]"), -203960.6, 1.0);
}

// A piece of soil that dilates alike has no band: without a grid and without shear_band its dilation ends at the volume
// of dilation_limit, with shear_band at the rise over it. 0.3 %: elastic volume under 300 kPa along the axis.
TEST(MaterialDriver, EndsDilationInABandThatIsGiven) {
  MaterialDriverOptions options;
  const std::string sand =
      "{law: mohr_coulomb, density: 1600, young: 60 MPa, poisson: 0.3, friction_angle: 30 deg, dilation_angle: 20 deg";
  options.path = "triaxial";
  options.strain = "-20%";
  options.material = sand + "}";
  EXPECT_NEAR(last(table(options), "j [1]"), 1.1, 0.003);
  options.material = sand + ", shear_band: 2 cm}";
  EXPECT_NEAR(last(table(options), "j [1]"), 1.05, 0.003);
  options.material = sand + ", dilation_rise: 1 mm}";
  EXPECT_NE(error_of(options).find("add shear_band"), std::string::npos);
}

// Critical state at 100 kPa on the sides, M = 1: p = 150 kPa, q = 150 kPa, so 250 kPa along the axis; 0.2 %: its
// approach.
TEST(MaterialDriver, DrivesClayToItsCriticalState) {
  MaterialDriverOptions options;
  options.material =
      "{law: cam_clay, density: 1700, lambda: 0.2, kappa: 0.04, M: 1, void_ratio: 1, poisson: 0.3, "
      "preconsolidation_pressure: 100 kPa}";
  options.path = "triaxial";
  options.strain = "-250%";
  options.steps = 500;
  EXPECT_NEAR(last(table(options), "szz [Pa]"), -250e3, 0.002 * 250e3);
}

TEST(MaterialDriver, TakesAMaterialFromAScene) {
  MaterialDriverOptions options;
  options.scene = "blade_in_soil";
  options.material = "sand";
  EXPECT_EQ(read_driven_material(options).name, "sand");
  options.material = "sandy";
  options.path = "volumetric";
  const std::string text = error_of(options);
  EXPECT_NE(text.find("blade_in_soil.yaml: materials: no material 'sandy'; did you mean 'sand'?"), std::string::npos)
      << text;
}

TEST(MaterialDriver, RefusesMaterialsAsAScene) {
  MaterialDriverOptions options;
  options.path = "volumetric";
  options.material = "{law: neo_hookean, density: 1000, young: 1 MPa, poison: 0.3}";
  EXPECT_EQ(error_of(options), "MATERIAL:1: materials.material.poison: unknown key 'poison'; did you mean 'poisson'?");
  options.material = "{law: neo_hookean, density: 1000, young: 1 m, poisson: 0.3}";
  EXPECT_EQ(error_of(options).find("MATERIAL:1: materials.material.young: "), 0U) << error_of(options);
  options.material = "{law: neo_hookean, density: 1000";
  EXPECT_EQ(error_of(options).find("MATERIAL:1: not YAML: "), 0U) << error_of(options);
  for (const char* text :
       {"sand", "", "{}, {}", "]", "a: [b", "{law: neo_hookean, density: 1, young: 1, poisson: 0.6}"}) {
    options.material = text;
    EXPECT_EQ(error_of(options).find("MATERIAL"), 0U) << text << ": " << error_of(options);
  }
}

// Strain along z, stress along x and shear are as in the file, in the file's units.
TEST(MaterialDriver, FollowsAFile) {
  const TemporaryFile file(
      "# by hand\n"
      "t [ms], ezz [%], sxx [kPa], gxz\n"
      "0, 0, 0, 0\n"
      "\n"
      "500, -1, -50, 0.02\n"
      "1000, -2, -50, 0\n");
  MaterialDriverOptions options;
  options.material = "{law: linear_elastic, density: 1000, young: 10 MPa, poisson: 0.3}";
  options.path_file = file.path;
  options.steps = 4;
  const StrainPath path = read_driven_path(options);
  ASSERT_EQ(path.size(), 2U);
  EXPECT_DOUBLE_EQ(path[0].duration, 0.5);
  EXPECT_EQ(path[0].control[2], Control::strain);
  EXPECT_EQ(path[0].control[0], Control::stress);
  EXPECT_EQ(path[0].control[4], Control::simple_shear);
  EXPECT_DOUBLE_EQ(path[0].target[2], -0.01);
  EXPECT_DOUBLE_EQ(path[0].target[0], -50e3);
  EXPECT_DOUBLE_EQ(path[0].target[4], 0.02);
  const auto rows = table(options);
  ASSERT_EQ(rows.size(), 2U + 8U);
  EXPECT_NEAR(last(rows, "sxx [Pa]"), -50e3, 1e-4);
  EXPECT_NEAR(last(rows, "ezz [1]"), -0.02, 2e-6);  // sheared to 0.02 and back: logarithmic strain to its square / 2 %
  EXPECT_NEAR(last(rows, "time [s]"), 1.0, 1e-10);
}

std::string file_error(const std::string& text) {
  const TemporaryFile file(text);
  try {
    read_path_file(file.path, 10);
  } catch (const PathError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find(file.path + ":"), 0U) << what;
    return what.substr(file.path.size() + 1);
  }
  return "";
}

TEST(MaterialDriver, RefusesFilesByTheirLine) {
  EXPECT_EQ(file_error(""), "0: no header; write one, such as t, ezz, sxx, syy");
  EXPECT_EQ(file_error("ezz, t\n"), "1: the first column is 'ezz'; it must be the time, t");
  EXPECT_EQ(file_error("t\n"), "1: no column beside t; write strains or stresses, such as ezz, sxx");
  EXPECT_EQ(file_error("t, ezx\n").find("1: unknown column 'ezx'; "), 0U);
  EXPECT_EQ(file_error("t, \n").find("1: unknown column ''; "), 0U);
  EXPECT_EQ(file_error("t, gxx\n").find("1: unknown column 'gxx'; "), 0U);
  EXPECT_EQ(file_error("t, ezz, szz\n"), "1: 'szz': the component zz has a column already; strain it or stress it");
  EXPECT_EQ(file_error("t, szz [m]\n"), "1: 'szz' is in m; write a pressure");
  EXPECT_EQ(file_error("t, szz [kPa\n"), "1: 'szz [kPa': a unit stands in brackets, as in sxx [kPa]");
  EXPECT_EQ(file_error("t, ezz\n"), "1: no row after t = 0; write one for the end of each leg");
  EXPECT_EQ(file_error("t, ezz\n1\n"), "2: 1 cells under 2 columns");
  EXPECT_EQ(file_error("t, ezz\n1, nan\n"), "2: ezz: 'nan' is not a finite number; units stand in the header");
  EXPECT_EQ(file_error("t, ezz\n1, 5 m\n"), "2: ezz: '5 m' is not a finite number; units stand in the header");
  EXPECT_EQ(file_error("t, ezz\n0, 0.1\n").find("2: at t = 0 the material is at rest"), 0U);
  EXPECT_EQ(file_error("t, ezz\n1, 0.1\n1, 0.2\n"), "3: t = 1 s is not after 1 s; rows go forward in time");
  EXPECT_EQ(file_error("t, ezz\n-1, 0.1\n"), "2: t = -1 s is not after 0 s; rows go forward in time");
}

const char* const kElastic = "{law: linear_elastic, density: 2000, young: 10 MPa, poisson: 0.2}";

// At a held volume heat presses with E alpha dT / (1 - 2 nu) in all directions; ten digits are printed, and the stretch
// is 1 + alpha dT, whose logarithm is less by a part of 2.5e-4.
TEST(MaterialDriver, HeatsAHeldMaterial) {
  MaterialDriverOptions options;
  options.material = kElastic;
  options.path = "uniaxial_strain";
  options.strain = "1e-14";
  options.heating = "50 K";
  options.expansion = "1e-5";
  EXPECT_NEAR(last(table(options), "szz [Pa]"), -10e6 * std::log1p(5e-4) / 0.6, 0.01);
  options.expansion.clear();
  EXPECT_EQ(error_of(options), "--heating and --expansion go together");
}

// Undrained: p = -Q ln J beside the skeleton's stress. Confined by stress drained, then sheared undrained: with Q = 240
// times the bulk modulus the material keeps its volume but for p / Q, so p is a third of the axial stress less 0.4 %.
TEST(MaterialDriver, ClosesThePores) {
  MaterialDriverOptions options;
  options.material = kElastic;
  options.path = "uniaxial_strain";
  options.strain = "-0.001";
  options.storage = "1e-9";
  auto rows = table(options);
  const double skeleton = 10e6 * 0.8 / (1.2 * 0.6) * 1e-3;
  EXPECT_NEAR(last(rows, "pore_pressure [Pa]"), 1e6, 1e-3);
  EXPECT_NEAR(last(rows, "szz [Pa]"), -1e6 - skeleton, 1e-3 * skeleton);
  options.biot = "0.5";
  rows = table(options);
  EXPECT_NEAR(last(rows, "pore_pressure [Pa]"), 0.5e6, 1e-3);
  EXPECT_NEAR(last(rows, "szz [Pa]"), -0.25e6 - skeleton, 1e-3 * skeleton);
  options.biot.clear();
  options.path = "triaxial";
  rows = table(options);
  const double bulk = 10e6 / (3.0 * 0.6), deviator = -100e3 - last(rows, "szz [Pa]");
  EXPECT_NEAR(last(rows, "sxx [Pa]"), -100e3, 1e-3);
  EXPECT_NEAR(last(rows, "pore_pressure [Pa]"), deviator / 3.0 * 1e9 / (1e9 + bulk), 1e-4 * deviator);
  options.biot = "1.5";
  EXPECT_EQ(error_of(options), "--biot: 1.5; it lies in (0, 1]");
  options.storage.clear();
  options.biot = "1";
  EXPECT_EQ(error_of(options), "--biot is of water in pores; add --storage");
}

TEST(MaterialDriver, RefusesOptionsThatDoNotFit) {
  MaterialDriverOptions options;
  options.material = kSand;
  EXPECT_EQ(error_of(options).find("give one path: a name of uniaxial_strain, "), 0U);
  options.path_file = "/no/such.csv";
  EXPECT_EQ(error_of(options), "/no/such.csv: no such file; check the path");
  options.rate = "1";
  EXPECT_EQ(error_of(options), "a path from a file has its own strains, stresses and times; give --steps alone");
  options.path_file.clear();
  options.path = "triaxial";
  options.confining = "1 m";
  EXPECT_EQ(error_of(options).find("--confining: "), 0U) << error_of(options);
}

// The rows before a failure of the law are printed.
TEST(MaterialDriver, KeepsTheRowsBeforeAFailure) {
  MaterialDriverOptions options;
  options.material =
      "{law: mohr_coulomb, density: 1600, young: 10 MPa, poisson: 0.3, friction_angle: 0, cohesion: 1 kPa}";
  options.path = "creep";
  options.stress = "-3 kPa";  // the material carries 2 kPa
  options.steps = 30;
  std::ostringstream out;
  EXPECT_THROW(drive_material(options, out), PathFailure);
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 20);  // header, start, and the steps up to 2 kPa
}

}  // namespace material_driver_test
}  // namespace mpm
