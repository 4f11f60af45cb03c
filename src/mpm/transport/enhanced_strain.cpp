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

/// Number of parts for which the distances to slopes are found once. What is slow beside its waves moves in so many
/// steps by a small part of a cell.
constexpr int kGoodFor = 4;

template <class T>
double component(const Symmetric3<T>& of, int a, int b) {
  if (a == b) return a == 0 ? of.xx : a == 1 ? of.yy : of.zz;
  return a + b == 1 ? of.xy : a + b == 2 ? of.xz : of.yz;
}

}  // namespace

EnhancedStrain::EnhancedStrain(const TransportParts& parts, std::vector<const TransportedField*> expanding,
                               std::unique_ptr<ScalarTransfer> transfer)
    : parts_(parts),
      dim_(parts.fields.front()->layout.dim()),
      expanding_(std::move(expanding)),
      transfer_(std::move(transfer)),
      gradients_(parts.sets.size()),
      given_(parts.sets.size()),
      taken_(parts.sets.size()) {
  const GridLayout& layout = parts_.fields.front()->layout;
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    masses_.emplace_back(1, layout.nodes_per_block());
    numbers_.emplace_back(1, layout.nodes_per_block());
    places_.emplace_back(dim_, layout.nodes_per_block());
  }
  for (ParticleSet& set : parts_.sets) {
    constexpr std::pair<const char*, const char*> kNumbers[kKinds] = {{"free_strain_slope_", "1/m"},
                                                                      {"slope_lead_", "m"},
                                                                      {"free_strain_slope_given_", "1/m"},
                                                                      {"free_strain_slope_left_", "1/m"},
                                                                      {"slope_of_places_", "1"}};
    if (set.free_strain >= 0) set.enhanced_strain = static_cast<int>(set.brought.size());
    for (int n = 0; n < kKinds * dim_ && set.free_strain >= 0; ++n) {
      const auto& [name, unit] = kNumbers[n / dim_];
      set.bring(std::string(name) + "xyz"[layout.axis(n % dim_)], unit);
    }
    seen_.push_back(set.brought.size());
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
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    for (int k = 0; k < dim_; ++k) gradients_[s][k].resize(parts_.sets[s].id.size());
  }
  find_masses();
  if (masses_moved_) find_slopes_of_places();
  masses_moved_ = false;
  for (std::size_t i = 0; i < expanding_.size(); ++i) add_slopes(i);
}

void EnhancedStrain::find_masses() {
  if (!parts_.sleeps) return;  // the grid has them
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) given_[s] = {gradients_[s][0].data()};
  each_group([&](ParticleSet&, std::size_t s, int first, int last) {
    std::fill(gradients_[s][0].data() + first, gradients_[s][0].data() + last, 1.0);
  });
  spread(masses_);
}

void EnhancedStrain::find_slopes_of_places() {
  const GridLayout& layout = parts_.fields.front()->layout;
  each_group([&](ParticleSet& set, std::size_t s, int first, int last) {
    for (int k = 0; k < dim_; ++k) {
      for (int p = first; p < last; ++p) gradients_[s][k][p] = set.x[k][p] - layout.origin(k);
    }
  });
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    taken_[s] = {};
    for (int k = 0; k < dim_; ++k) {
      given_[s][k] = gradients_[s][k].data();
      if (set.free_strain >= 0) taken_[s][k] = numbers(set, of_places, k);
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
    double* before = set.brought[seen_[s] + quantity].values.data();
    for (int p = first; p < last; ++p) {
      changes[p] = values[p] - before[p];
      before[p] = values[p];
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
    const double* values = field.values(static_cast<int>(s)).data();
    for (int k = 0; k < dim_ && by_one != 0.0; ++k) {
      const double *gradient = gradients_[s][k].data(), *places = numbers(set, of_places, k);
      double* slope = numbers(set, slope_left, k);
      for (int p = first; p < last; ++p) {
        const double over = layout.periodic(k) ? 1.0 : places[p];
        const double stretch = 1.0 + by_one * (values[p] - field.definition().reference);
        if (over > kLeastSlope) slope[p] += by_one * gradient[p] / (over * stretch);
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
      const double mass = parts_.sleeps ? masses_[f].at(b, 0, n) : grid.mass.at(b, 0, n);
      for (int c = 0; c < numbers[f].components(); ++c) {
        double& number = numbers[f].at(b, c, n);
        number = mass > 0.0 && grid.carries(b, n) ? number / mass : 0.0;
      }
    });
  }
}

void EnhancedStrain::find_leads() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    taken_[s] = {};
    for (int k = 0; k < dim_ && set.free_strain >= 0; ++k) taken_[s][k] = numbers(set, lead, k);
  }
  transfer_->slope_lead(taken_);
}

template <class Slopes>
double EnhancedStrain::half_work(Slopes&& slopes) {
  const GridLayout& layout = parts_.fields.front()->layout;
  double work = 0.0;
  with_geometry(parts_.geometry, [&](auto kind) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      ParticleSet& set = parts_.sets[s];
      if (set.free_strain < 0) continue;
      const auto slope_of = slopes(set);
      std::array<const double*, 3> leads{};
      for (int k = 0; k < dim_; ++k) leads[k] = numbers(set, lead, k);
      const auto add = [&](int first, int last, double& sum) {
        for (int p = first; p < last; ++p) {
          const auto tau = full(kind.load_symmetric(set.tau, p));
          double by_mass = 0.0;
          for (int i = 0; i < dim_; ++i) {
            const double slope = slope_of(p, i);
            for (int j = 0; j < dim_; ++j) {
              const double off = slope * leads[j][p];
              by_mass += component(tau, layout.axis(i), layout.axis(j)) * (i == j ? -off : off);
            }
          }
          sum += 0.5 * set.mass_of(p) * by_mass;
        }
      };
      work = sum_groups("transport: enhanced strain", set, parts_.threads, sums_, work, add);
    }
  });
  return work;
}

double EnhancedStrain::give(double part) {
  if (parts_given_++ % kGoodFor == 0) find_leads();
  return half_work([&](ParticleSet& set) {
    std::array<double*, 3> slopes{}, next{}, unbooked{};
    for (int k = 0; k < dim_; ++k) {
      slopes[k] = numbers(set, slope_left, k);
      next[k] = numbers(set, slope_next, k);
      unbooked[k] = numbers(set, given_slope, k);
    }
    return [=](int p, int i) {
      const double now = part * slopes[i][p];
      slopes[i][p] -= now;
      next[i][p] += now;
      unbooked[i][p] += now;
      return now;
    };
  });
}

double EnhancedStrain::book() {
  return half_work([&](ParticleSet& set) {
    std::array<double*, 3> unbooked{};
    for (int k = 0; k < dim_; ++k) unbooked[k] = numbers(set, given_slope, k);
    return [=](int p, int i) { return std::exchange(unbooked[i][p], 0.0); };
  });
}

}  // namespace mpm
