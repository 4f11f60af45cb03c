#include "mpm/checkpoint/checkpoint.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "mpm/math/build_info.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/output_file.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/rules/method_text.hpp"
#include "ranks_archive.hpp"

namespace mpm {
namespace {

void serialise(StateArchive& archive, CheckpointAbout& about) {
  const StateArchive::Group group(archive, "about");
  archive.value("format", about.format);
  archive.value("version", about.version);
  if (about.format != kCheckpointFormat || about.version != kCheckpointVersion) return;  // the rest may be otherwise
  archive.value("program", about.program);
  archive.value("scene", about.scene);
  archive.value("scene_path", about.label.scene_path);
  archive.value("scene_text", about.label.scene_text);
  archive.value("failure", about.label.failure);
  archive.value("geometry", about.geometry);
  archive.value("method", about.method);
  archive.value("precision", about.precision);
  archive.value("isa", about.isa);
  archive.value("particles", about.particles);
  archive.value("time", about.time);
  archive.value("state_hash", about.state_hash);
  archive.value("checksum", about.checksum);
}

void serialise_run(StateArchive& archive, Simulation& simulation, const SerialiseMore& more) {
  {
    const StateArchive::Group group(archive, "simulation");
    simulation.serialise(archive);
  }
  if (!more) return;
  const StateArchive::Group group(archive, "run");
  const StateArchive::Same same(archive);
  more(archive);
}

CheckpointAbout about_of(const Simulation& simulation) {
  const SimulationDefinition& definition = simulation.definition();
  CheckpointAbout about;
  about.format = kCheckpointFormat;
  about.version = kCheckpointVersion;
  about.program = build_version();
  about.scene = definition.name;
  about.geometry = geometry_name(definition.geometry);
  about.method = method_text(definition.method);
  about.precision = precision_name(definition.method.precision);
  about.isa = simulation.isa();
  about.particles = simulation.particles();
  about.time = simulation.time();
  return about;
}

/// @throws CheckpointError
void check(const std::string& path, const CheckpointAbout& there, const CheckpointAbout& here,
           const std::string& difference) {
  const std::string start = fmt::format("checkpoint {}: ", path);
  if (!there.label.failure.empty()) {
    throw CheckpointError(fmt::format("{}it is of a run that failed and cannot go on ({}); take an earlier one", start,
                                      there.label.failure));
  }
  if (!difference.empty()) {
    throw CheckpointError(fmt::format(
        "{}it is of another scene, '{}': {}; resume with its own scene, in which output, metrics and the end "
        "of the run (--end) may change, or run this one from its start",
        start, there.scene, difference));
  }
  if (there.precision != here.precision || there.method != here.method || there.geometry != here.geometry ||
      there.particles != here.particles) {
    throw CheckpointError(fmt::format("{}it is of {} particles, {}, {}; this run has {}, {}, {}", start,
                                      there.particles, there.geometry, there.method, here.particles, here.geometry,
                                      here.method));
  }
  if (there.isa != here.isa) {
    throw CheckpointError(fmt::format(
        "{}it was made with the instruction set {}, this run has {}, which rounds otherwise; start it with --isa {} "
        "(node: _isa:={})",
        start, there.isa, here.isa, there.isa, there.isa));
  }
}

CheckpointAbout read_about(StateArchive& archive, const std::string& path) {
  CheckpointAbout about;
  serialise(archive, about);
  if (about.format != kCheckpointFormat) {
    throw CheckpointError(fmt::format("checkpoint {}: it is HDF5, but no checkpoint of mpm_ros", path));
  }
  if (about.version != kCheckpointVersion) {
    throw CheckpointError(fmt::format(
        "checkpoint {}: its layout is version {}, this program reads version {}; run it with the program that wrote it",
        path, about.version, kCheckpointVersion));
  }
  return about;
}

}  // namespace

std::string text_difference(const std::string& here, const std::string& there) {
  std::istringstream ours(here), theirs(there);
  std::string a, b;
  for (int line = 1;; ++line) {
    const bool more = static_cast<bool>(std::getline(ours, a)), other = static_cast<bool>(std::getline(theirs, b));
    if (!more && !other) return "white space at its end";
    if (!more) a = "(its end)";
    if (!other) b = "(its end)";
    if (a != b) return fmt::format("line {} is '{}' there and '{}' here", line, b, a);
  }
}

CheckpointAbout save_checkpoint(const std::string& path, Simulation& simulation, const CheckpointLabel& label,
                                const SerialiseMore& more) {
  Communicator* ranks = simulation.ranks();
  const bool writes = is_first(ranks);
  const auto check = [&](const std::string& own) {
    const std::string problem = text_of_all(ranks, own);
    if (!problem.empty()) throw CheckpointError(fmt::format("checkpoint {}: cannot be written: {}", path, problem));
  };
  check(writes ? refused_output(path) : std::string());
  CheckpointAbout about = about_of(simulation);
  about.label = label;
  about.state_hash = simulation.state_hash();
  about.checksum = simulation.memory_hash();
  const std::string part = path + ".part";
  const auto write = [&](auto&& file) {
    serialise(file, about);
    serialise_run(file, simulation, more);
    file.close();
  };
  try {
    if (ranks == nullptr) {
      write(Hdf5Writer(part));
    } else {
      write(RanksWriter(*ranks, part));
    }
  } catch (...) {
    if (writes) std::remove(part.c_str());
    throw;
  }
  std::error_code error;
  if (writes) std::filesystem::rename(part, path, error);
  if (error) std::remove(part.c_str());
  check(error ? error.message() : std::string());
  return about;
}

CheckpointAbout read_checkpoint(const std::string& path) {
  Hdf5Reader file(path);
  return read_about(file, path);
}

CheckpointAbout load_checkpoint(const std::string& path, Simulation& simulation, const std::string& scene_text,
                                const SerialiseMore& more, const SceneDifference& difference) {
  RanksReader file(simulation.ranks(), path);
  const CheckpointAbout about = read_about(file, path);
  const std::string& recorded = about.label.scene_text;
  const auto other_text = [&] { return recorded == scene_text ? "" : text_difference(scene_text, recorded); };
  CheckpointAbout here = about_of(simulation);
  if (simulation.definition().bed) here.particles = about.particles;  // they come and go
  check(path, about, here, difference ? difference(recorded) : other_text());
  try {
    serialise_run(file, simulation, more);
  } catch (const DefinitionError& error) {
    throw CheckpointError(fmt::format("checkpoint {}: {}", path, error.what()));
  }
  if (file.merging()) return about;  // in another order, which has other hashes
  if (simulation.memory_hash() != about.checksum || simulation.state_hash() != about.state_hash) {
    throw CheckpointError(
        fmt::format("checkpoint {}: what it holds is not what was saved: the file is damaged; take "
                    "an earlier one",
                    path));
  }
  return about;
}

}  // namespace mpm
