#include "mpm/volumes/volumes.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "mpm/loop/loop.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/ranks/of_all.hpp"

namespace mpm {
namespace {

constexpr int kGroup = 4096;
constexpr int kNumbers = 7;  ///< count of a volume's sums

}  // namespace

std::vector<std::pair<std::string, std::string>> volume_numbers(const std::string& name) {
  return {{name + "_mass", "kg"}, {name + "_volume", "m^3"}, {name + "_x", "m"},        {name + "_y", "m"},
          {name + "_z", "m"},     {name + "_mass_in", "kg"}, {name + "_mass_out", "kg"}};
}

Volumes::Sums& Volumes::Sums::operator+=(const Sums& other) {
  mass += other.mass;
  volume += other.volume;
  came += other.came;
  went += other.went;
  moment += other.moment;
  return *this;
}

Volumes::Volumes(const std::vector<VolumeDefinition>& volumes, VolumeParts parts)
    : volumes_(volumes), parts_(std::move(parts)), places_(volumes.size()) {
  for (const VolumeDefinition& volume : volumes_) {
    int carrier = -1;
    for (std::size_t b = 0; b < parts_.bodies.size(); ++b) {
      if (parts_.bodies[b].name() == volume.of) carrier = static_cast<int>(b);
    }
    carriers_.push_back(carrier);
    reports_.push_back({volume.name});
  }
  for (ParticleSet& set : parts_.sets) remembers_.push_back(set.bring("in_volumes", "1"));
  count(true);
}

void Volumes::at_sync(std::int64_t /*time*/) { count(false); }

void Volumes::find_places() {
  for (std::size_t v = 0; v < volumes_.size(); ++v) {
    Pose pose = volumes_[v].pose;
    if (carriers_[v] >= 0) {
      const Pose& carrier = parts_.bodies[static_cast<std::size_t>(carriers_[v])].pose();
      pose = {carrier.to_world(pose.position), (carrier.orientation * pose.orientation).normalized()};
    }
    places_[v] = {pose, world_bounds(pose, volumes_[v].surface->bounds())};
  }
}

Vec3 Volumes::place_of(const ParticleSet& set, int particle) const {
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < parts_.layout.dim(); ++k) place[parts_.layout.axis(k)] = set.x[k][particle];
  return place;
}

void Volumes::count(const ParticleSet& set, std::size_t number, PaddedArray<double>& inside, int first, int end,
                    Sums* sums) {
  for (int p = first; p < end; ++p) {
    const Vec3 place = place_of(set, p);
    const auto before = static_cast<std::uint64_t>(inside[p]);
    std::uint64_t now = 0;
    for (std::size_t v = 0; v < volumes_.size(); ++v) {
      const std::uint64_t bit = std::uint64_t{1} << v;
      const bool in =
          places_[v].bounds.contains(place) && volumes_[v].surface->at(places_[v].pose.to_body(place)).distance <= 0.0;
      const bool was = (before & bit) != 0;
      if (!in && !was) continue;
      const double mass = set.mass_of(p);
      if (in && !was) sums[v].came += mass;
      if (!in && was) sums[v].went += mass;
      if (!in) continue;
      now |= bit;
      sums[v].mass += mass;
      sums[v].moment += mass * place;
      const double j = with_geometry(parts_.geometry, [&](auto kind) {
        return static_cast<double>(determinant(full(kind.load_matrix(set.f, p))));
      });
      sums[v].volume += mass * j / parts_.densities[number];
    }
    inside[p] = static_cast<double>(now);
  }
}

void Volumes::count(bool first) {
  find_places();
  std::vector<Sums> totals(volumes_.size());
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    PaddedArray<double>& inside = set.brought[remembers_[s]].values;
    const auto groups = static_cast<std::size_t>((set.size() + kGroup - 1) / kGroup);
    sums_.assign(groups * volumes_.size(), Sums());
    for_groups("volumes: counts", parts_.threads, set.size(), kGroup, [&](int from, int end, int group) {
      count(set, s, inside, from, end, &sums_[static_cast<std::size_t>(group) * volumes_.size()]);
    });
    for (std::size_t i = 0; i < sums_.size(); ++i) totals[i % volumes_.size()] += sums_[i];
  }
  for (std::size_t v = 0; v < volumes_.size(); ++v) {
    const Sums& own = totals[v];
    double all[kNumbers] = {own.mass, own.volume, own.came, own.went, own.moment.x(), own.moment.y(), own.moment.z()};
    add_up(parts_.ranks, all, kNumbers);
    VolumeReport& report = reports_[v];
    report.mass = all[0];
    report.volume = all[1];
    report.centre = Vec3(all[4], all[5], all[6]) / all[0];
    if (!(all[0] > 0.0)) report.centre.setConstant(std::numeric_limits<double>::quiet_NaN());
    // Rings have no place across their axis.
    if (axisymmetric(parts_.geometry) && all[0] > 0.0) report.centre.x() = 0.0;
    if (first) continue;  // material that is there at the start has not come in
    report.mass_in += all[2];
    report.mass_out += all[3];
  }
}

void Volumes::numbers(std::vector<NamedNumber>& list) const {
  for (const VolumeReport& report : reports_) {
    const double values[kNumbers] = {report.mass,       report.volume,  report.centre.x(), report.centre.y(),
                                     report.centre.z(), report.mass_in, report.mass_out};
    std::size_t k = 0;
    for (auto& [name, unit] : volume_numbers(report.name)) list.push_back({name, unit, values[k++]});
  }
}

void Volumes::serialise(StateArchive& archive) {
  const StateArchive::Same same(archive);
  archive.column("mass", reports_, &VolumeReport::mass);
  archive.column("volume", reports_, &VolumeReport::volume);
  archive.column("centre", reports_, &VolumeReport::centre);
  archive.column("mass_in", reports_, &VolumeReport::mass_in);
  archive.column("mass_out", reports_, &VolumeReport::mass_out);
}

}  // namespace mpm
