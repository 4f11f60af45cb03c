#include "mpm/pace/kept_costs.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "mpm/math/build_info.hpp"
#include "mpm/math/byte_hash.hpp"

namespace mpm::pace {

namespace fs = std::filesystem;

namespace {

constexpr const char* kHeader =
    "key,step_seconds,steps_per_second,steps,threads,particles,when,awake,touched,rehearsed";

struct Row {
  std::string key;
  KeptCost kept;
};

std::optional<Row> parse(std::string line) {
  for (char& c : line) c = c == ',' ? ' ' : c;
  std::istringstream words(line);
  Row row;
  KeptCost& kept = row.kept;
  words >> row.key >> kept.cost.step_seconds >> kept.cost.steps_per_second >> kept.cost.steps >> kept.threads >>
      kept.particles >> kept.when >> kept.cost.awake >> kept.cost.touched >> kept.cost.rehearsed;
  const auto good = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!words || !good(kept.cost.step_seconds) || !good(kept.cost.steps_per_second) || kept.threads < 1)
    return std::nullopt;
  return row;
}

std::vector<Row> read_rows(const std::string& path) {
  std::vector<Row> rows;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return rows;  // a pipe would keep us waiting
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != kHeader) return rows;
  while (std::getline(file, line)) {
    if (auto row = parse(line)) rows.push_back(std::move(*row));
  }
  return rows;
}

/// The library, or the program that it is linked into, by the time at which it was built.
std::string build_of_library() {
  Dl_info info;
  struct stat about {};
  if (dladdr(kHeader, &info) == 0 || info.dli_fname == nullptr || stat(info.dli_fname, &about) != 0) return {};
  return fmt::format("{}.{:09}", about.st_mtim.tv_sec, about.st_mtim.tv_nsec);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("model name", 0) == 0) return line;
  }
  return {};
}

}  // namespace

std::optional<KeptCost> KeptCosts::find(const std::string& key, std::int64_t now) const {
  std::optional<KeptCost> found;
  for (const Row& row : read_rows(path_)) {
    const bool fresh = row.kept.when <= now && now - row.kept.when <= kLifetime;
    if (row.key == key && fresh) found = row.kept;
  }
  return found;
}

bool KeptCosts::keep(const std::string& key, const KeptCost& kept) const {
  if (path_.empty()) return false;
  std::vector<Row> rows;
  for (Row& row : read_rows(path_)) {
    if (row.key != key) rows.push_back(std::move(row));
  }
  rows.push_back({key, kept});
  std::error_code error;
  if (fs::exists(path_, error) && !fs::is_regular_file(path_, error)) return false;
  fs::create_directories(fs::path(path_).parent_path(), error);
  const std::string fresh = fmt::format("{}.{}", path_, getpid());
  std::ofstream file(fresh);
  file << kHeader << "\n";
  for (std::size_t i = rows.size() > kMost ? rows.size() - kMost : 0; i < rows.size(); ++i) {
    const KeptCost& of = rows[i].kept;
    file << fmt::format("{},{:.6g},{:.9g},{},{},{},{},{:.4g},{:d},{:.3g}\n", rows[i].key, of.cost.step_seconds,
                        of.cost.steps_per_second, of.cost.steps, of.threads, of.particles, of.when, of.cost.awake,
                        of.cost.touched, of.cost.rehearsed);
  }
  file.close();
  if (file) fs::rename(fresh, path_, error);
  if (file && !error) return true;
  std::remove(fresh.c_str());
  return false;
}

std::string kept_costs_path() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache != nullptr && *cache == '/') return std::string(cache) + "/mpm_ros/step_costs.csv";
  if (home != nullptr && *home == '/') return std::string(home) + "/.cache/mpm_ros/step_costs.csv";
  return {};
}

std::string cost_key(const std::string& scene_text, Isa isa, int threads) {
  const std::string all = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", build_version(), build_of_library(), processor(),
                                      sysconf(_SC_NPROCESSORS_ONLN), isa_name(isa), threads, scene_text);
  ByteHash hash;
  hash.add(all.data(), all.size());
  return fmt::format("{:016x}", hash.value());
}

std::int64_t wall_time() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace mpm::pace
