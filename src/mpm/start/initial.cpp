#include "mpm/start/initial.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/definition/definition.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/start/particle_start.hpp"

namespace mpm {
namespace {

constexpr double kEvenVolume = 0.01;  ///< spread of J above which one mass for all particles is worth a warning

/// `per_particle`: one for each particle, or none.
void check_count(const DeformableBody& body, std::size_t per_particle, const char* what) {
  if (per_particle == 0 || per_particle == body.positions.size()) return;
  throw DefinitionError(
      fmt::format("body '{}': {} {} for {} particles", body.name, per_particle, what, body.positions.size()));
}

/// The components of a state as a set stores them.
struct Components {
  Components(const InitialState& state, GeometryKind geometry) {
    double *f_slots[Solid::kMatrix], *tau_slots[Solid::kSymmetric];
    for (int c = 0; c < Solid::kMatrix; ++c) f_slots[c] = &f[c];
    for (int c = 0; c < Solid::kSymmetric; ++c) tau_slots[c] = &tau[c];
    const Matrix3<double>& m = state.f;
    const Symmetric3<double>& t = state.tau;
    with_geometry(geometry, [&](auto kind) {
      if constexpr (kind.kDim == 3) {
        kind.store_matrix(m, f_slots, 0);
        kind.store_symmetric(t, tau_slots, 0);
      } else {
        kind.store_matrix(MatrixPlane<double>{m.xx, m.xz, m.zx, m.zz, m.yy}, f_slots, 0);
        kind.store_symmetric(SymmetricPlane<double>{t.xx, t.zz, t.xz, t.yy}, tau_slots, 0);
      }
    });
  }
  double f[Solid::kMatrix] = {}, tau[Solid::kSymmetric] = {};
};

void store(const InitialState& state, GeometryKind geometry, ParticleSet& set, std::size_t p) {
  const Components values(state, geometry);
  for (std::size_t c = 0; c < set.f.size(); ++c) set.f[c].set(p, values.f[c]);
  for (std::size_t c = 0; c < set.tau.size(); ++c) set.tau[c].set(p, values.tau[c]);
}

/// J over particles of a body.
struct Spread {
  double least = 1.0, most = 1.0;
  double inverse = 0.0;  ///< sum of 1 / J
  /// True if no particle is strained.
  bool is_even() const { return least == 1.0 && most == 1.0; }
};

/// A sum over the particles of a body in the order of their numbers, so that it has the bits of one process: the first
/// rank gets what they have piece by piece. Collective.
double sum_in_order(Communicator& ranks, const BodyPart& part, const std::vector<double>& own) {
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;
  double sum = 0.0;
  std::size_t next = 0;
  for (std::uint64_t first = 0; first < part.whole; first += kPiece) {
    const std::uint64_t last = std::min(part.whole, first + kPiece);
    std::vector<double> values;
    std::vector<std::uint64_t> places;
    for (; next < own.size() && part.numbers[next] < last; ++next) {
      values.push_back(own[next]);
      places.push_back(part.numbers[next] - first);
    }
    std::vector<double> piece(ranks.first() ? last - first : 0);
    ranks.place(values, places, piece.data(), piece.size());
    for (const double value : piece) sum += value;
  }
  return ranks.sum(sum);  // 0 on the others
}

/// The same over all ranks. `own`: 1 / J of each particle here.
void add_up(Communicator& ranks, const BodyPart& part, const std::vector<double>& own, Spread& spread) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double ends[] = {own.empty() ? kNone : -spread.least, own.empty() ? kNone : spread.most};
  ranks.largest(ends, 2);
  spread.least = -ends[0];
  spread.most = ends[1];
  if (!spread.is_even()) spread.inverse = sum_in_order(ranks, part, own);
}

void store_everywhere(const InitialState& state, GeometryKind geometry, ParticleSet& set) {
  const Components values(state, geometry);
  for (std::size_t c = 0; c < set.f.size(); ++c) set.f[c].assign(set.f[c].size(), values.f[c]);
  for (std::size_t c = 0; c < set.tau.size(); ++c) set.tau[c].assign(set.tau[c].size(), values.tau[c]);
}

}  // namespace

void start_particles(ParticleSet& set, const DeformableBody& body, const MaterialDefinition& material,
                     GeometryKind geometry, Communicator* ranks, std::vector<std::string>& warnings,
                     StopCheck& check_stop) {
  const std::size_t n = body.positions.size();
  const InitialStates states(material, geometry);
  const bool asked = !body.stresses.empty() || !body.temperatures.empty();
  InitialState state = states.find({});
  Spread spread;
  std::vector<double> inverses;  // over several ranks
  if (!asked) store_everywhere(state, geometry, set);
  agree<DefinitionError>(ranks, [&] {
    check_count(body, body.stresses.size(), "stresses");
    check_count(body, body.temperatures.size(), "temperatures");
    for (std::size_t p = 0; p < n; ++p) {
      check_stop();
      if (asked) {
        InitialRequest request;
        if (!body.stresses.empty()) request.cauchy = body.stresses[p];
        request.yy_follows = body.yy_follows;
        if (!body.temperatures.empty()) request.temperature = body.temperatures[p];
        try {
          state = states.find(request);
        } catch (const InitialStateError& error) {
          const Vec3& place = body.positions[p];
          throw DefinitionError(fmt::format("body '{}', initial state at ({:.6g}, {:.6g}, {:.6g}) m: {}", body.name,
                                            place.x(), place.y(), place.z(), error.what()));
        }
        if (const int index = states.temperature_index(); index >= 0)
          set.history[index].set(p, state.temperature_excess);
        if (const int index = states.hardening_index(); index >= 0) set.history[index].set(p, state.hardening);
        store(state, geometry, set, p);
      }
      const double j = state.j();
      if (!set.masses.empty()) set.masses[0].set(p, set.masses[0][p] / j);
      spread.least = p == 0 ? j : std::min(spread.least, j);
      spread.most = p == 0 ? j : std::max(spread.most, j);
      spread.inverse += 1.0 / j;
      if (ranks != nullptr) inverses.push_back(1.0 / j);
    }
  });
  const bool own_masses = !set.masses.empty();
  if (own_masses && set.mass == 0.0) return;  // rings
  const std::uint64_t whole = whole_of(body);
  if (ranks != nullptr) add_up(*ranks, *body.part, inverses, spread);
  // The particles of a body have one mass, so where J varies it is their mean mass that is right. Where a surface cuts
  // some, it is that of a whole place.
  if (!spread.is_even()) set.mass *= spread.inverse / static_cast<double>(whole);
  if (!own_masses && spread.most > (1.0 + kEvenVolume) * spread.least) {
    warnings.push_back(
        fmt::format("body '{}': its initial stress strains it unevenly, J from {:.4g} to {:.4g}, but its particles "
                    "have one mass: its "
                    "density is off by as much; a stiffer material or several bodies would be closer",
                    body.name, spread.least, spread.most));
  }
}

}  // namespace mpm
