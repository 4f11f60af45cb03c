#include "mpm/mechanics/stress_average.hpp"

#include <algorithm>

#include "mpm/math/dimension.hpp"

namespace mpm {
namespace {

// Of every law of soil; simulation/stress_average_module.cpp checks it.
constexpr int kPlasticStrain = 0;

/// How a stress is stored: in a plane xx, zz, xz, yy.
template <class Geometry>
struct Stored {
  static constexpr int kCount = Geometry::kDim == 3 ? 6 : 4;
  static constexpr std::array<int, 3> kDiagonal =
      Geometry::kDim == 3 ? std::array<int, 3>{0, 1, 2} : std::array<int, 3>{0, 1, 3};
  using Stress = std::array<double, kCount>;

  static double mean(const Stress& s) { return (s[kDiagonal[0]] + s[kDiagonal[1]] + s[kDiagonal[2]]) / 3.0; }
  /// Elastic energy of a stress in a unit of volume.
  static double energy(const Stress& s, double bulk, double shear) {
    const double tension = mean(s);
    double squares = 0.0;
    for (const double component : s) squares += 2.0 * component * component;
    for (const int i : kDiagonal) squares -= s[i] * s[i];
    return tension * tension / (2.0 * bulk) + (squares - 3.0 * tension * tension) / (4.0 * shear);
  }
};

/// What the flowing particles of a cell have together.
template <class Stress>
struct CellSum {
  double mass = 0.0;
  Stress stress{};
  int particles = 0;
};

}  // namespace

StressAverage::StressAverage(std::vector<AveragedSet> sets, GeometryKind geometry, int threads)
    : sets_(std::move(sets)), geometry_(geometry), threads_(threads) {
  for (const AveragedSet& one : sets_) places_.push_back(one.set->bring("plastic_strain_before", "1"));
}

template <class Geometry, class T>
double StressAverage::average_block(const AveragedSet& one, double* before, std::uint32_t begin, std::uint32_t end,
                                    const GridLayout& layout, const std::array<int, 3>& block) {
  using Tensor = Stored<Geometry>;
  using Stress = typename Tensor::Stress;
  ParticleSet& set = *one.set;
  const T* strain = set.history[kPlasticStrain].template data<T>();
  std::array<T*, Tensor::kCount> component;
  for (int i = 0; i < Tensor::kCount; ++i) component[i] = set.tau[i].template data<T>();
  const auto stress = [&](std::uint32_t p) {
    Stress s;
    for (int i = 0; i < Tensor::kCount; ++i) s[i] = static_cast<double>(component[i][p]);
    return s;
  };
  const auto flows = [&](std::uint32_t p) { return strain[p] > before[p] && Tensor::mean(stress(p)) < 0.0; };
  const auto cell_of = [&](std::uint32_t p) {
    int cell = 0;
    for (int k = 0; k < Geometry::kDim; ++k) {
      const int node = GridLayout::nearest(layout.in_cells(k, set.x[k][p])) - kBlockEdge * block[k];
      cell = cell * kBlockEdge + std::clamp(node, 0, kBlockEdge - 1);
    }
    return cell;
  };
  CellSum<Stress> cells[nodes_of_block(Geometry::kDim)];
  bool any = false;
  for (std::uint32_t p = begin; p < end; ++p) {
    if (!flows(p)) continue;
    CellSum<Stress>& cell = cells[cell_of(p)];
    const double mass = set.mass_of(static_cast<int>(p));
    const Stress own = stress(p);
    cell.mass += mass;
    for (int i = 0; i < Tensor::kCount; ++i) cell.stress[i] += mass * own[i];
    ++cell.particles;
    any = any || cell.particles > 1;
  }
  double lost = 0.0;
  if (any) {
    for (std::uint32_t p = begin; p < end; ++p) {
      if (!flows(p)) continue;
      const CellSum<Stress>& cell = cells[cell_of(p)];
      if (cell.particles < 2) continue;
      Stress mean = cell.stress;
      for (double& value : mean) value /= cell.mass;
      const double energy = Tensor::energy(stress(p), one.bulk, one.shear) - Tensor::energy(mean, one.bulk, one.shear);
      for (int i = 0; i < Tensor::kCount; ++i) component[i][p] = static_cast<T>(mean[i]);
      // Of Cauchy stress on the present volume.
      const double j = determinant(Geometry::load_matrix(set.f, static_cast<int>(p)));
      lost += set.mass_of(static_cast<int>(p)) * energy * one.density / j;
    }
  }
  for (std::uint32_t p = begin; p < end; ++p) before[p] = strain[p];
  return lost;
}

template <class Geometry, class T>
void StressAverage::average(const AveragedSet& one, std::size_t place, const StepContext& context) {
  const GridLayout& layout = context.layout();
  double* before = one.set->brought[place].values.data();
  for (const auto& grid : context.fields) {
    const BlockTable& blocks = grid->blocks;
    const int owners = blocks.owners(), first = grid->first_owner;
    of_owner_.resize(owners);
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int owner = 0; owner < owners; ++owner) {
      of_owner_[owner] =
          average_block<Geometry, T>(one, before, one.set->begin[first + owner], one.set->begin[first + owner + 1],
                                     layout, blocks.block(blocks.owner_block(owner)));
    }
    for (const double lost : of_owner_) taken_ += lost;
  }
}

void StressAverage::momentum_gathered(StepContext& context) {
  with_geometry(geometry_, [&](auto kind) {
    using Geometry = decltype(kind);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (sets_[s].set->precision == Precision::float64) {
        average<Geometry, double>(sets_[s], places_[s], context);
      } else {
        average<Geometry, float>(sets_[s], places_[s], context);
      }
    }
  });
}

void StressAverage::energies(EnergyReport& report) const {
  report.add("stress averaging", NamedEnergy::Kind::dissipated, taken_);
}

}  // namespace mpm
