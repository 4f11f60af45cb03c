#include "mpm/transport/face_flux.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/transport/transported_field.hpp"

namespace mpm {
namespace {

/// Into the body, of content by area and time.
double flux(const FluxDefinition& of, double given, double there) {
  if (of.kind == FluxDefinition::Kind::convection) return of.coefficient * (given - there);
  if (of.kind == FluxDefinition::Kind::given) return given;
  return of.coefficient * kStefanBoltzmann * (std::pow(given, 4) - std::pow(there, 4));
}

}  // namespace

FaceFlux::FaceFlux(const FaceSettings& settings, const Fields& fields, const std::vector<ParticleSet>& sets,
                   std::vector<FluxTerm> terms)
    : faces_(settings, fields, sets), fields_(fields), sets_(sets), terms_(std::move(terms)), halo_(settings.halo) {
  fed_.resize(sets.size());
  for (const FluxTerm& term : terms_) {
    accounts_.push_back({term.definition.name, 0.0, 0.0});
    std::vector<char>& fed = fed_[term.set];
    for (const std::uint32_t id : term.particles) {
      if (id >= fed.size()) fed.resize(id + 1, 0);
      fed[id] = 1;
    }
  }
  if (halo_ != nullptr) own_.assign(fields.size(), NodalField(1, faces_.layout().nodes_per_block()));
}

// Over several ranks the sources of this one are kept apart until all have theirs.
NodalField& FaceFlux::source_of(int field, std::vector<NodalQuantity>& nodes) {
  return halo_ == nullptr ? nodes[field].source : own_[field];
}

void FaceFlux::begin_own() {
  for (std::size_t f = 0; f < own_.size(); ++f) {
    own_[f].resize(fields_[f]->blocks.size());
    std::fill_n(own_[f].data(), own_[f].size(), 0.0);
  }
}

void FaceFlux::add_own(std::vector<NodalQuantity>& nodes) {
  for (std::size_t f = 0; f < own_.size(); ++f) {
    halo_->add(static_cast<int>(f), own_[f]);
    for (std::size_t i = 0; i < own_[f].size(); ++i) nodes[f].source.data()[i] += own_[f].data()[i];
  }
}

void FaceFlux::give(std::vector<NodalQuantity>& nodes, double start, double dt) {
  begin_own();
  int found = -1;  // the set that place_of_ is of
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const FluxTerm& term = terms_[i];
    const ParticleSet& set = sets_[term.set];
    if (found != term.set) find_places(set, place_of_);
    found = term.set;
    double content = 0.0;
    for (const std::uint32_t id : term.particles) {
      const int p = id < place_of_.size() ? place_of_[id] : -1;
      if (p < 0 || p >= set.awake()) continue;  // on another rank, or asleep
      const FaceParts parts = faces_.parts(term.set, p, term.face);
      Vec3 middle = Vec3::Zero();
      for (int k = 0; k < faces_.layout().dim(); ++k) middle[faces_.layout().axis(k)] = parts.middle[k];
      double given = 0.0;
      try {
        given = term.definition.value(start + 0.5 * dt, middle);
      } catch (const FunctionError& error) {
        throw TransportError(fmt::format("flux '{}' at particle {} of '{}': {}", term.definition.name, set.id[p],
                                         set.name, error.what()));
      }
      for (int a = 0; a < parts.corners; ++a) {
        const NodeShares shares = faces_.shares(term.set, p, parts.corner[a].at);
        if (shares.count == 0) {
          throw TransportError(
              fmt::format("flux '{}': a corner of particle {} of '{}' lies where no material is on the grid; it is "
                          "stretched too far",
                          term.definition.name, set.id[p], set.name));
        }
        double there = 0.0;
        for (int n = 0; n < shares.count; ++n) {
          there += shares.share[n] * nodes[shares.field[n]].value.at(shares.node[n].block, 0, shares.node[n].node);
        }
        const double rate = parts.corner[a].area * flux(term.definition, given, there);
        for (int n = 0; n < shares.count; ++n) {
          source_of(shares.field[n], nodes).at(shares.node[n].block, 0, shares.node[n].node) += shares.share[n] * rate;
        }
        content += rate * dt;
      }
    }
    accounts_[i].add(content);
  }
  add_own(nodes);
}

bool FaceFlux::feeds(const RestingBlock& block) const {
  bool any = false;
  block.each(sets_, [&](std::size_t s, int p) {
    const std::uint32_t id = sets_[s].id[p] - sets_[s].first_id;
    any = any || (id < fed_[s].size() && fed_[s][id] != 0);
  });
  return any;
}

double FaceFlux::conductance(double most) const {
  double largest = 0.0;
  for (const FluxTerm& term : terms_) largest = std::max(largest, surface_conductance(term.definition, most));
  return largest;
}

void FaceFlux::accounts(std::vector<ContentAccount>& list) const {
  list.insert(list.end(), accounts_.begin(), accounts_.end());
}

void FaceFlux::serialise(StateArchive& archive) {
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    archive.sum("given_" + std::to_string(i), accounts_[i].given);
    archive.sum("exchanged_" + std::to_string(i), accounts_[i].exchanged);
  }
}

}  // namespace mpm
