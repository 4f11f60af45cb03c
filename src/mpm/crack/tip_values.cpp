#include "mpm/crack/tip_values.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/kernel_views.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr int kPairs = 7, kPairsOfPhysics = 9;

/// visit(double&) for all numbers of a sample.
template <class Visit>
void each_number(AreaSample& sample, Visit&& visit) {
  ContourValues& values = sample.values;
  for (Vec2* vector : {&sample.place, &sample.acceleration, &sample.velocity, &values.centre, &sample.free_force,
                       &sample.pressure_slope, &sample.eigenstrain_slope}) {
    for (int k = 0; k < 2; ++k) visit((*vector)[k]);
  }
  for (auto* gradient : {&sample.velocity_gradient, &values.gradient}) {
    for (auto& row : *gradient) {
      for (double& number : row) visit(number);
    }
  }
  for (double* number :
       {&sample.area, &sample.density, &values.hoop_gradient, &values.xx, &values.zz, &values.xz, &values.hoop,
        &values.energy, &values.kinetic, &values.free, &values.pressure, &sample.content}) {
    visit(*number);
  }
}

/// Those of all ranks, in their order.
void gather_samples(Communicator& ranks, std::vector<AreaSample>& samples) {
  std::vector<double> numbers;
  AreaSample sample;
  std::size_t of_one = 0;
  each_number(sample, [&](double&) { ++of_one; });
  for (AreaSample& own : samples) each_number(own, [&](double& number) { numbers.push_back(number); });
  numbers = gather_list(ranks, numbers);
  samples.resize(numbers.size() / of_one);
  auto next = numbers.begin();
  for (AreaSample& one : samples) each_number(one, [&](double& number) { number = *next++; });
}

}  // namespace

TipValues::TipValues(TipParts parts, std::unique_ptr<ScalarTransfer> transfer)
    : parts_(std::move(parts)),
      transfer_(std::move(transfer)),
      numbers_(parts_.sets.size()),
      acceleration_(parts_.sets.size()),
      slope_(parts_.sets.size()),
      gradients_(parts_.physics.size()),
      traces_(parts_.physics.size()),
      energies_(parts_.physics.size()),
      nodal_(DividedNode::kFields,
             std::vector<NodalField>(parts_.physics.empty() ? kPairs : kPairsOfPhysics,
                                     NodalField(2, parts_.fields.front()->layout.nodes_per_block()))),
      marks_(DividedNode::kFields),
      component_(1, parts_.fields.front()->layout.nodes_per_block()) {}

void TipValues::gather(int first, int crack, const std::array<int, 2>& low, const std::array<int, 2>& high) {
  first_ = first;
  crack_ = crack;
  const int fields = parts_.chosen.fields_of(first);
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const auto fit = [&](PaddedArray<double>& numbers) {
      if (numbers.size() != parts_.sets[s].id.size()) numbers.assign(parts_.sets[s].id.size(), 0.0);
    };
    for (PaddedArray<double>& numbers : numbers_[s]) fit(numbers);
    if (!parts_.physics.empty()) {
      for (auto* numbers : {&traces_[s], &energies_[s]}) fit(*numbers);
    }
    const Grid& patches = parts_.chosen.patches();
    fill(s, parts_.sets[s].begin[patches.first_owner], parts_.sets[s].begin.back());
  }
  for (int f = 0; f < fields; ++f) {
    const Grid& grid = *parts_.fields[first + f];
    std::vector<std::uint8_t>& marks = marks_[f];
    marks.assign(grid.blocks.size(), 0);
    for (int i = low[0] - 1; i <= high[0] + 1; ++i) {
      for (int j = low[1] - 1; j <= high[1] + 1; ++j) {
        const NodeRef ref = parts_.chosen.find_place(first + f, {i, j});
        if (ref.block >= 0) marks[ref.block] = 1;
      }
    }
    find_givers(grid, marks, givers_);
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      for (int o = 0; o < grid.blocks.owners(); ++o) {
        const std::uint32_t* begin = parts_.sets[s].begin.data() + grid.first_owner + o;
        if (givers_[o] != 0) fill(s, begin[0], begin[1]);
      }
    }
    for (std::size_t pair = 0; pair < nodal_[f].size(); ++pair) {
      given_.assign(parts_.sets.size(), {});
      for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
        for (std::size_t k = 0; k < 2; ++k) given_[s][k] = numbers_[s][2 * pair + k].data();
      }
      transfer_->spread(first + f, given_, ScalarTransfer::Weight::mass, nodal_[f][pair], &marks);
    }
  }
}

void TipValues::fill(std::size_t s, std::uint32_t first, std::uint32_t last) {
  const ParticleSet& set = parts_.sets[s];
  auto& to = numbers_[s];
  const double density = parts_.densities[s];
  with_geometry(parts_.geometry, [&](auto kind) {
    using Geometry = decltype(kind);
    std::visit(
        [&](const auto& law) {
          using LawType = std::decay_t<decltype(law)>;
          for (std::uint32_t p = first; p < last; ++p) {
            const auto f = Geometry::load_matrix(set.f, static_cast<int>(p));
            const auto tau = Geometry::load_symmetric(set.tau, static_cast<int>(p));
            const double j = determinant(f), present = density / j;
            double work;
            if (parts_.physics.empty() || !parts_.physics[s].expands) {
              work = law.elastic_energy(full(f), full(tau), j);
            } else {
              // The law counts energy by the volume that it sees, which what expands has more of.
              const double stretch = 1.0 + set.brought[set.free_strain + 1].values[p];
              const double shrink = 1.0 / stretch, volume = stretch * stretch * stretch;
              Matrix3<double> own = full(f);
              for (double* c : {&own.xx, &own.xy, &own.xz, &own.yx, &own.yy, &own.yz, &own.zx, &own.zy, &own.zz}) {
                *c *= shrink;
              }
              work = volume * law.elastic_energy(own, scale_shift(full(tau), 1.0 / volume, 0.0), j / volume);
              to[free][p] = stretch - 1.0;
            }
            if (!parts_.physics.empty()) {
              traces_[s][p] = present * trace(tau);
              energies_[s][p] = present * work;
            }
            if constexpr (LawType::kPlasticWork >= 0) {
              work += (1.0 - law.heat_fraction()) * set.history[LawType::kPlasticWork][p];
            }
            double speed2 = 0.0;
            for (int k = 0; k < 2; ++k) speed2 += std::pow(static_cast<double>(set.v[k][p]), 2);
            to[one][p] = 1.0;
            to[energy][p] = present * work;
            to[xx][p] = f.xx - 1.0;
            to[xz][p] = f.xz;
            to[zx][p] = f.zx;
            to[zz][p] = f.zz - 1.0;
            to[stress_xx][p] = present * tau.xx;
            to[stress_zz][p] = present * tau.zz;
            to[stress_xz][p] = present * tau.xz;
            to[stress_hoop][p] = Geometry::kHoop ? present * tau.yy : 0.0;
            to[kinetic][p] = 0.5 * present * (parts_.grid_energy ? 1.0 : speed2);
            to[hoop_gradient][p] = Geometry::kHoop ? f.yy - 1.0 : 0.0;
            to[place_x][p] = set.x[0][p];
            to[place_z][p] = set.x[1][p];
            if (!parts_.physics.empty() && parts_.physics[s].pressure >= 0) add_water(s, p, full(f), j);
          }
        },
        parts_.laws[s]);
  });
}

// `number(n)`: the number n of a particle, or the mean of them.
template <class Get>
ContourValues TipValues::values_of(Get&& number) {
  ContourValues values;
  values.gradient[0][0] = number(xx);
  values.gradient[0][1] = number(xz);
  values.gradient[1][0] = number(zx);
  values.gradient[1][1] = number(zz);
  values.hoop_gradient = number(hoop_gradient);
  values.xx = number(stress_xx);
  values.zz = number(stress_zz);
  values.xz = number(stress_xz);
  values.hoop = number(stress_hoop);
  values.energy = number(energy);
  values.kinetic = number(kinetic);
  values.centre = {number(place_x), number(place_z)};
  return values;
}

bool TipValues::values_at(int field, NodeRef ref, ContourValues& values) const {
  const int f = field - first_;
  if (ref.block < 0 || marks_[f][ref.block] == 0) return false;
  const auto sum = [&](int number) { return nodal_[f][number / 2].at(ref.block, number % 2, ref.node); };
  const double mass = sum(one);
  if (!(mass > parts_.fields[field]->least_mass)) return false;
  values = values_of([&](int number) { return sum(number) / mass; });
  if (!parts_.physics.empty()) {
    values.free = sum(free) / mass;
    values.pressure = sum(pressure) / mass;
  }
  if (!parts_.grid_energy) return true;
  if (parts_.physics.empty()) {
    values.energy =
        0.5 * (values.xx * values.gradient[0][0] + values.zz * values.gradient[1][1] +
               values.xz * (values.gradient[0][1] + values.gradient[1][0]) + values.hoop * values.hoop_gradient);
  }
  const NodalField& velocity = parts_.fields[field]->velocity;
  values.kinetic *= std::pow(velocity.at(ref.block, 0, ref.node), 2) + std::pow(velocity.at(ref.block, 1, ref.node), 2);
  return true;
}

bool TipValues::find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const {
  const CrackFields::NodeOfField of = field == ContourField::own
                                          ? CrackFields::NodeOfField{first_, parts_.chosen.find_place(first_, node)}
                                          : parts_.chosen.find_across(first_, crack_, node);
  return of.field >= 0 && values_at(of.field, of.ref, values);
}

bool TipValues::at(const Vec2& place, const Vec2& from, ContourValues& values) const {
  values = {};
  double sum = 0.0;
  parts_.chosen.each_node_around(first_, place, from, [&](const CrackFields::NodeOfField& own, double hat) {
    ContourValues here;
    if (!values_at(own.field, own.ref, here)) return;
    sum += hat;
    values = ContourValues::between(values, here, hat / sum);
  });
  return sum > 0.0;
}

void TipValues::find_samples(const GridLines& lines, const ContourPath& path, std::vector<AreaSample>& samples) {
  samples.clear();
  const int fields = parts_.chosen.fields_of(first_);
  std::vector<ParticleSet>& sets = parts_.sets;
  const auto take = [&](auto&& array) {
    taken_.assign(sets.size(), {});
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (sets[s].field != first_) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        PaddedArray<double>& to = array(s, k);
        if (to.size() != sets[s].id.size()) to.assign(sets[s].id.size(), 0.0);
        taken_[s][k] = to.data();
      }
    }
  };
  for (int f = 0; f < fields; ++f) {
    Grid& grid = *parts_.fields[first_ + f];
    take([&](std::size_t s, std::size_t k) -> PaddedArray<double>& { return acceleration_[s][k]; });
    transfer_->gather(first_ + f, grid.force, taken_, &marks_[f]);
    for (std::size_t c = 0; c < 2; ++c) {
      const std::size_t nodes = static_cast<std::size_t>(grid.layout.nodes_per_block());
      component_.resize(grid.blocks.size());
      for (int b = 0; b < grid.blocks.size(); ++b) {
        std::copy_n(grid.velocity.block(b) + c * nodes, nodes, component_.block(b));
      }
      take([&](std::size_t s, std::size_t k) -> PaddedArray<double>& { return slope_[s][c][k]; });
      transfer_->gradient(first_ + f, component_, taken_, &marks_[f]);
    }
  }
  if (!parts_.physics.empty()) find_slopes();
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleSet& set = sets[s];
    if (set.field != first_ || parts_.cracks[crack_].divides[s] == 0) continue;
    const auto look = [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t p = first; p < last; ++p) {
        const Vec2 place(set.x[0][p], set.x[1][p]);
        if (!path.contains(lines, place)) continue;
        const auto& of = numbers_[s];
        AreaSample sample;
        sample.place = place;
        const double j = with_geometry(parts_.geometry, [&](auto kind) -> double {
          return determinant(kind.load_matrix(set.f, static_cast<int>(p)));
        });
        sample.density = parts_.densities[s] / j;
        const double across = axisymmetric(parts_.geometry) ? kTurn * place[0] : parts_.across;
        sample.area = set.mass_of(static_cast<int>(p)) / (sample.density * across);
        for (int k = 0; k < 2; ++k) {
          sample.acceleration[k] = acceleration_[s][k][p];
          sample.velocity[k] = set.v[k][p];
          for (int c = 0; c < 2; ++c) sample.velocity_gradient[c][k] = slope_[s][c][k][p];
        }
        sample.values = values_of([&](int number) { return of[number][p]; });
        if (parts_.grid_energy) sample.values.kinetic *= sample.velocity.squaredNorm();
        if (!parts_.physics.empty()) add_physics(s, p, sample);
        samples.push_back(sample);
      }
    };
    const Grid& grid = *parts_.fields[first_];
    for (int o = 0; o < grid.blocks.owners(); ++o) {
      if (marks_[0][grid.blocks.owner_block(o)] != 0) {
        look(set.begin[grid.first_owner + o], set.begin[grid.first_owner + o + 1]);
      }
    }
    look(set.begin[parts_.chosen.patches().first_owner], set.begin.back());
  }
  if (parts_.ranks != nullptr) gather_samples(*parts_.ranks, samples);
}

}  // namespace mpm
