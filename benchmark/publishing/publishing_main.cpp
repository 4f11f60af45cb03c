// The cost of publishing and recording relative to stepping: 20,000 particles of soil under a moving blade, once with
// everything published and recorded at 30 Hz of simulated time, and once with contact forces, bodies and state at every
// sync point.
//
// Recording writes a bag, in memory if /dev/shm exists. Publishing serialises each message once, as a publisher does
// for its subscribers. Stepping and output are timed separately within one run, because the load of the machine varies
// more between runs than the output costs. The program writes one JSON array; ratios are relative to the time of
// stepping.
#include <fmt/format.h>
#include <ros/serialization.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/record/bag_recorder.hpp"
#include "mpm_ros/record/run_outputs.hpp"

namespace {

// 20 x 10 x 12.5 cells of 8 particles, as soft as speed_soil_3d: stiffer soil takes more steps between messages.
const char* const kScene = R"(
geometry: solid
grid: {cell: 0.01, min: [0, 0, 0], max: [0.2, 0.1, 0.2]}
time: {end: 1, sync: SYNC}
gravity: [0, 0, -9.81]
method: {update: usavg, shape: ugimp}
materials:
  - {name: sand, law: drucker_prager, density: 1500, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg, cohesion: 0}
bodies:
  - {name: soil, material: sand, shape: {box: {min: [0, 0, 0], max: [0.2, 0.1, 0.125]}}}
rigid_bodies:
  - name: blade
    shape: {box: {size: [0.02, 0.08, 0.06]}}
    pose: {position: [0.05, 0.05, 0.16]}
    motion: {velocity: [0.1, 0, -0.05]}
boundaries: {all: slip}
)";

/// Processor time of all threads [s].
double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Serialises each message that it receives, as a publisher with a subscriber does.
class Serialiser : public mpm_ros::MessageSink {
 public:
  bool wants(const std::string&) const override { return true; }
  void put(const std::string&, const ros::Time&, const mpm_ros::RunInfo& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const visualization_msgs::MarkerArray& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const mpm_ros::ContactForces& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const geometry_msgs::WrenchStamped& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const mpm_ros::BodyStates& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const mpm_ros::SolverState& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const mpm_ros::GlobalQuantities& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const tf2_msgs::TFMessage& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const sensor_msgs::PointCloud2& m) override { pack(m); }
  void put(const std::string&, const ros::Time&, const mpm_ros::Command& m) override { pack(m); }

 private:
  template <class Message>
  void pack(const Message& message) {
    ros::serialization::serializeMessage(message);
  }
};

struct Case {
  std::string name, sync;
  double wrench_period;  ///< [s]; 0: at every sync point
};

nlohmann::ordered_json run(const Case& what, int threads, double duration, const std::string& folder) {
  std::string text = kScene;
  text.replace(text.find("SYNC"), 4, what.sync);
  const mpm::Scene scene = mpm::parse_scene(text, "publishing.yaml");
  mpm::Simulation simulation(mpm::build(scene), mpm::SimulationOptions{threads});
  mpm_ros::OutputOptions options = mpm_ros::output_options(scene);
  options.particles.fields = {"vx", "vy", "vz", "sxx", "szz", "p", "mises", "ep"};
  options.particle_period = 1.0 / 30.0;
  options.wrench_period = what.wrench_period;
  const std::string bag = folder + "/mpm_publishing.bag";
  mpm_ros::BagRecorder recorder(bag);
  Serialiser serialiser;
  const mpm_ros::Stamps stamps;
  mpm_ros::RunOutputs outputs(simulation, stamps, options);
  outputs.add(recorder);
  outputs.add(serialiser);
  outputs.begin(mpm_ros::run_info(scene, simulation, stamps, ""));
  double stepping = 0.0, output = 0.0;
  const auto end = static_cast<std::int64_t>(duration * 1e9);
  while (simulation.time() < end) {
    const double start = now();
    simulation.advance();
    const double between = now();
    outputs.sync(simulation.time() >= end, 1.0);
    stepping += between - start;
    output += now() - between;
  }
  recorder.close();
  nlohmann::ordered_json result;
  result["name"] = what.name;
  result["particles"] = simulation.particles();
  result["threads"] = simulation.threads();
  result["isa"] = simulation.isa();
  result["steps"] = simulation.state().step.steps;
  result["steps_per_cloud"] = static_cast<double>(simulation.state().step.steps) / (30.0 * duration);
  result["stepping_seconds"] = stepping;
  result["output_seconds"] = output;
  result["ratio"] = output / stepping;
  result["bag_bytes"] = std::filesystem::file_size(bag);
  std::filesystem::remove(bag);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  int threads = 1;
  double duration = 0.2;
  CLI::App app("What publishing and recording cost beside stepping.");
  app.add_option("--threads", threads, "of stepping and of reading particles")->capture_default_str();
  app.add_option("--duration", duration, "[s] simulated, a multiple of 0.1")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const std::string folder = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : ".";
  try {
    nlohmann::ordered_json results;
    results.push_back(run({"all at 30 Hz", "0.003333333", 1.0 / 30.0}, threads, duration, folder));
    results.push_back(run({"clouds at 30 Hz, the rest at 300 Hz", "0.003333333", 0.0}, threads, duration, folder));
    std::cout << results.dump(2) << "\n";
  } catch (const std::exception& error) {
    std::cerr << "publishing: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
