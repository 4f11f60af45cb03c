#include "mpm/transport/enhanced_strain.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "visits.hpp"

namespace mpm {
namespace {

/// Least slope of the places of masses. At the edge of a body it is about a half; where all mass of the nodes around
/// lies at one place there is no slope of anything.
constexpr double kLeastSlope = 0.25;

/// The part of a stress along a world axis.
template <class Symmetric>
double along(const Symmetric& tau, int axis) {
  return axis == 0 ? tau.xx : axis == 1 ? tau.yy : tau.zz;
}

}  // namespace

EnhancedStrain::EnhancedStrain(const TransportParts& parts, std::vector<const TransportedField*> expanding,
                               std::unique_ptr<ScalarTransfer> transfer)
    : parts_(parts),
      dim_(parts.fields.front()->layout.dim()),
      expanding_(std::move(expanding)),
      transfer_(std::move(transfer)),
      gradients_(parts.sets.size()),
      of_places_(parts.sets.size()),
      leads_(parts.sets.size()),
      given_(parts.sets.size()),
      taken_(parts.sets.size()) {
  const GridLayout& layout = parts_.fields.front()->layout;
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    masses_.emplace_back(1, layout.nodes_per_block());
    numbers_.emplace_back(1, layout.nodes_per_block());
    places_.emplace_back(dim_, layout.nodes_per_block());
  }
  for (ParticleSet& set : parts_.sets) {
    if (set.free_strain < 0) continue;
    constexpr std::pair<const char*, const char*> kNumbers[kKinds] = {
        {"enhanced_strain_", "1"}, {"enhanced_strain_given_", "1"}, {"free_strain_slope_left_", "1/m"}};
    for (const auto& [name, unit] : kNumbers) {
      for (int k = 0; k < dim_; ++k) set.bring(std::string(name) + "xyz"[layout.axis(k)], unit);
    }
    for (const TransportedField* field : expanding_) {
      const TransportedTraits& of = traits_of(field->quantity());
      auto& values = set.brought[set.bring(std::string("expanded_by_") + of.name, of.unit)].values;
      std::fill_n(values.data(), set.size(), field->definition().reference);
    }
  }
}

// visit(set, its index, first and last particle of a group), at once.
template <class Visit>
void EnhancedStrain::each_group(Visit&& visit) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    for_particle_groups("transport: enhanced strain", set, kGainGroup, parts_.threads,
                        [&](int first, int last, int) { visit(set, s, first, last); });
  }
}

void EnhancedStrain::look() {
  look_at_masses();
  for (std::size_t i = 0; i < expanding_.size(); ++i) add_slopes(i);
}

void EnhancedStrain::look_at_masses() {
  const GridLayout& layout = parts_.fields.front()->layout;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    for (int k = 0; k < dim_; ++k) {
      gradients_[s][k].resize(parts_.sets[s].id.size());
      of_places_[s][k].resize(parts_.sets[s].id.size());
    }
    given_[s] = {gradients_[s][0].data()};
  }
  each_group([&](ParticleSet&, std::size_t s, int first, int last) {
    std::fill(gradients_[s][0].data() + first, gradients_[s][0].data() + last, 1.0);
  });
  spread(masses_);
  each_group([&](ParticleSet& set, std::size_t s, int first, int last) {
    for (int k = 0; k < dim_; ++k) {
      for (int p = first; p < last; ++p) gradients_[s][k][p] = set.x[k][p] - layout.origin(k);
    }
  });
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    for (int k = 0; k < dim_; ++k) {
      given_[s][k] = gradients_[s][k].data();
      taken_[s][k] = of_places_[s][k].data();
    }
  }
  spread(places_);
  over_mass(places_);
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    transfer_->slopes(static_cast<int>(f), places_[f], taken_);
  }
}

void EnhancedStrain::add_slopes(std::size_t quantity) {
  const GridLayout& layout = parts_.fields.front()->layout;
  const TransportedField& field = *expanding_[quantity];
  each_group([&](ParticleSet& set, std::size_t s, int first, int last) {
    const double* values = field.values(static_cast<int>(s)).data();
    double* changes = gradients_[s][0].data();
    double* before = set.free_strain < 0 ? nullptr : seen(set, quantity).data();
    for (int p = first; p < last; ++p) {
      changes[p] = before == nullptr ? 0.0 : values[p] - before[p];
      if (before != nullptr) before[p] = values[p];
    }
  });
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    given_[s] = {gradients_[s][0].data()};
    taken_[s] = {};
    for (int k = 0; k < dim_; ++k) taken_[s][k] = gradients_[s][k].data();
  }
  spread(numbers_);
  over_mass(numbers_);
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    transfer_->gradient(static_cast<int>(f), numbers_[f], taken_);
  }
  each_group([&](ParticleSet& set, std::size_t s, int first, int last) {
    const double by_one = field.material(static_cast<int>(s)).expansion;
    for (int k = 0; k < dim_ && by_one != 0.0; ++k) {
      const double *gradient = gradients_[s][k].data(), *of_places = of_places_[s][k].data();
      double* slope = numbers(set, slope_left, k);
      for (int p = first; p < last; ++p) {
        const double over = layout.periodic(k) ? 1.0 : of_places[p];
        if (over > kLeastSlope) slope[p] += by_one * gradient[p] / over;
      }
    }
  });
}

void EnhancedStrain::spread(std::vector<NodalField>& to) {
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    transfer_->spread(static_cast<int>(f), given_, ScalarTransfer::Weight::mass, to[f]);
  }
}

void EnhancedStrain::over_mass(std::vector<NodalField>& numbers) {
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    for_nodes("transport: enhanced strain", grid, parts_.threads, [&](int b, int n) {
      const double mass = masses_[f].at(b, 0, n);
      for (int c = 0; c < numbers[f].components(); ++c) {
        double& number = numbers[f].at(b, c, n);
        number = mass > 0.0 && grid.carries(b, n) ? number / mass : 0.0;
      }
    });
  }
}

void EnhancedStrain::find_leads() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    taken_[s] = {};
    for (int k = 0; k < dim_ && parts_.sets[s].free_strain >= 0; ++k) {
      leads_[s][k].resize(parts_.sets[s].id.size());
      taken_[s][k] = leads_[s][k].data();
    }
  }
  transfer_->slope_lead(taken_);
}

double EnhancedStrain::give(double part) {
  find_leads();
  double work = 0.0;
  with_geometry(parts_.geometry, [&](auto kind) {
    const GridLayout& layout = parts_.fields.front()->layout;
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      ParticleSet& set = parts_.sets[s];
      if (set.free_strain < 0) continue;
      work = sum_groups(
          "transport: enhanced strain", set, parts_.threads, sums_, work, [&](int first, int last, double& sum) {
            for (int k = 0; k < dim_; ++k) {
              double *slope = numbers(set, slope_left, k), *next = numbers(set, taken_next, k),
                     *unbooked = numbers(set, given, k);
              const double* lead = leads_[s][k].data();
              for (int p = first; p < last; ++p) {
                const double now = part * slope[p], strain = -now * lead[p];
                slope[p] -= now;
                next[p] += strain;
                unbooked[p] += strain;
                sum += 0.5 * set.mass_of(p) * along(kind.load_symmetric(set.tau, p), layout.axis(k)) * strain;
              }
            }
          });
    }
  });
  return work;
}

bool EnhancedStrain::waits(const ParticleSet& set, int p) const {
  for (int k = 0; k < dim_; ++k) {
    if (set.brought[place(set, taken_next * dim_ + k)].values[p] != 0.0) return true;
  }
  return false;
}

double EnhancedStrain::book(ParticleSet& set, int p, const Symmetric3<double>& tau) const {
  const GridLayout& layout = parts_.fields.front()->layout;
  double work = 0.0;
  for (int k = 0; k < dim_; ++k) {
    double& unbooked = numbers(set, given, k)[p];
    work += along(tau, layout.axis(k)) * unbooked;
    unbooked = 0.0;
  }
  return work;
}

}  // namespace mpm
