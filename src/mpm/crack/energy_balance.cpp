#include "mpm/crack/energy_balance.hpp"

#include <algorithm>

namespace mpm {

EnergyBalance::Speed EnergyBalance::look(double area, const BodyEnergies& energies, const FractureConstants& constants,
                                         double wave_speed) {
  const double start = constants.speed * wave_speed, least = 0.5 * start;
  if (speed_ == 0.0) speed_ = start;
  Speed now{true, speed_, 0.0, 0.0};
  const Record& then = grown_[0];
  if (known_ < 2 || !(area > then.area)) return now;
  const bool given = constants.surface_energy > 0.0 && constants.surface_energy < 0.5 * constants.j_ic;
  const double faces = given ? 2.0 * constants.surface_energy : constants.j_ic;
  const double plastic = energies.plastic - then.energies.plastic;
  const double released = -(energies.potential - then.energies.potential + plastic) / (area - then.area);
  now.released = released;
  now.excess = released - constants.plastic_part * plastic / (area - then.area) - faces;
  now.speed = std::clamp(speed_ + constants.gain * now.excess, 0.5 * speed_, wave_speed);
  if (now.speed <= least) {
    now.speed = least;
    now.grows = now.excess >= 0.0;
  }
  speed_ = now.speed;
  if (!now.grows) *this = {};
  return now;
}

void EnergyBalance::grown(double area, const BodyEnergies& energies) {
  grown_[0] = grown_[1];
  grown_[1] = {area, energies};
  known_ = std::min(known_ + 1, 2);
}

void EnergyBalance::serialise(StateArchive& archive) {
  archive.value("speed", speed_);
  archive.value("known", known_);
  archive.column("area", grown_, &Record::area);
  archive.column("potential", grown_, [](Record& record) -> double& { return record.energies.potential; });
  archive.column("plastic", grown_, [](Record& record) -> double& { return record.energies.plastic; });
}

}  // namespace mpm
