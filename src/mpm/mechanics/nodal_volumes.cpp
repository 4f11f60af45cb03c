#include "mpm/mechanics/nodal_volumes.hpp"

#include <algorithm>
#include <array>

#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/kernel_views.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

// Displacement gradient by place now, I - F^-1, in the grid's axes; row c, column k.
template <class T>
std::array<std::array<double, 3>, 3> slopes(const Matrix3<T>& f) {
  const Matrix3<T> g = inverse(f, determinant(f));
  return {{{1 - g.xx, -g.xy, -g.xz}, {-g.yx, 1 - g.yy, -g.yz}, {-g.zx, -g.zy, 1 - g.zz}}};
}
template <class T>
std::array<std::array<double, 3>, 3> slopes(const MatrixPlane<T>& f) {
  const double d = f.xx * f.zz - f.xz * f.zx;
  return {{{1 - f.zz / d, f.xz / d, 0}, {f.zx / d, 1 - f.xx / d, 0}, {0, 0, 0}}};
}

/// T is the precision of the particles.
template <class T>
class VolumeSurveyOf final : public VolumeSurvey {
 public:
  VolumeSurveyOf(const mpm_kernel::KernelTable<T>& kernels, Fields& fields, std::vector<ParticleSet>& sets,
                 const std::vector<Law>& laws, std::vector<double> densities, GeometryKind geometry, int threads)
      : kernels_(kernels),
        fields_(fields),
        sets_(sets),
        laws_(laws),
        densities_(std::move(densities)),
        geometry_(geometry),
        dim_(dimensions(geometry)),
        threads_(threads),
        arrays_(sets.size()) {}

  void survey(int field, const std::vector<std::uint8_t>& marked, const SurveyWants& wants,
              NodalVolumes& result) override {
    Grid& grid = *fields_[field];
    look_at(grid, marked);
    make_room(wants);
    fill(grid, wants);
    find_gradient(grid, result.gradient);
    spread(grid, result.volume, [](const Arrays& a, int) { return a.volume.data(); });
    if (wants.start_volume) {
      spread(grid, result.start_volume, [](const Arrays& a, int) { return a.start_volume.data(); });
    }
    if (wants.position) spread(grid, result.position, [](const Arrays& a, int k) { return a.set->x[k].data(); });
    if (wants.displacement) spread(grid, result.displacement, [](const Arrays& a, int k) { return a.moved[k].data(); });
    for (int c = 0; c < dim_ && wants.slope; ++c) {
      spread(grid, result.slope[c], [c](const Arrays& a, int k) { return a.slope[c][k].data(); });
    }
  }

 private:
  /// Of a set's particles, in their order; filled for those of the owners at work.
  struct Arrays {
    const ParticleSet* set = nullptr;
    PaddedArray<double> volume, start_volume;  ///< over mass [m^3/kg]
    PaddedArray<T> pull;                       ///< -V_p [m^3]
    PaddedArray<T> one, none;
    std::array<PaddedArray<double>, 3> moved;                 ///< displacement [m]
    std::array<std::array<PaddedArray<double>, 3>, 3> slope;  ///< of the displacement
  };

  // Owners that give to a marked block, and the blocks that these give to.
  void look_at(const Grid& grid, const std::vector<std::uint8_t>& marked) {
    const BlockTable& blocks = grid.blocks;
    int span = 1;
    for (int k = 0; k < dim_; ++k) span *= 3;
    at_work_.assign(blocks.owners(), 0);
    touched_.assign(blocks.size(), 0);
    for (int o = 0; o < blocks.owners(); ++o) {
      const int* near = blocks.neighbours(o);
      at_work_[o] = std::any_of(near, near + span, [&](int b) { return marked[b] != 0; });
      if (!at_work_[o]) continue;
      for (int i = 0; i < span; ++i) touched_[near[i]] = 1;
    }
  }

  void make_room(const SurveyWants& wants) {
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      Arrays& a = arrays_[s];
      const std::size_t size = sets_[s].id.size();
      a.set = &sets_[s];
      if (a.volume.size() != size) {
        a.volume.assign(size, 0.0);
        a.pull.assign(size, T(0));
        a.one.assign(size, T(1));
        a.none.assign(size, T(0));
      }
      if (wants.start_volume && a.start_volume.size() != size) a.start_volume.assign(size, 0.0);
      for (int c = 0; c < dim_; ++c) {
        if (wants.displacement && a.moved[c].size() != size) a.moved[c].assign(size, 0.0);
        for (int k = 0; k < dim_ && wants.slope; ++k) {
          if (a.slope[c][k].size() != size) a.slope[c][k].assign(size, 0.0);
        }
      }
    }
  }

  void fill(const Grid& grid, const SurveyWants& wants) {
    const int owners = grid.blocks.owners();
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int o = 0; o < owners; ++o) {
      if (!at_work_[o]) continue;
      for (std::size_t s = 0; s < sets_.size(); ++s) {
        const ParticleSet& set = sets_[s];
        const int owner = grid.first_owner + o;
        with_geometry(geometry_, [&](auto kind) {
          for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) fill(kind, s, p, wants);
        });
      }
    }
  }

  template <class Geometry>
  void fill(Geometry, std::size_t s, std::uint32_t p, const SurveyWants& wants) {
    const ParticleSet& set = sets_[s];
    Arrays& a = arrays_[s];
    const auto f = Geometry::load_matrix(set.f, static_cast<int>(p));
    const double around = Geometry::kHoop ? kTurn * set.x[0][p] : 1.0;
    const double start = 1.0 / densities_[s];
    const double volume = start * determinant(f) / around;
    a.volume[p] = volume;
    a.pull[p] = static_cast<T>(-volume * set.mass_of(static_cast<int>(p)));
    if (wants.start_volume) a.start_volume[p] = start / around;
    for (int c = 0; c < dim_ && wants.displacement; ++c) {
      a.moved[c][p] = set.x[c][p] - set.start_x[c][p];
    }
    if (!wants.slope) return;
    const auto h = slopes(f);
    for (int c = 0; c < dim_; ++c) {
      for (int k = 0; k < dim_; ++k) a.slope[c][k][p] = h[c][k];
    }
  }

  void clear(const Grid& grid, NodalField& field) const {
    field.resize(grid.blocks.size());
    const int count = field.components() * grid.layout.nodes_per_block();
    for (int b = 0; b < grid.blocks.size(); ++b) {
      if (touched_[b]) std::fill_n(field.block(b), count, 0.0);
    }
  }

  void look_at_sets(const Grid& grid) {
    views_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      views_.push_back(view_of<T>(sets_[s], laws_[s], kernels_.laws, grid.first_owner));
    }
  }

  template <class Pass>
  void each_at_work(const Grid& grid, Pass&& pass) {
    each_owner(grid, threads_, [&](const mpm_kernel::BlockView& block) {
      if (at_work_[block.owner]) pass(block);
    });
  }

  // `values(arrays, axis)`: numbers of a set's particles.
  template <class Values>
  void spread(Grid& grid, NodalField& to, Values&& values) {
    clear(grid, to);
    look_at_sets(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      for (int k = 0; k < dim_; ++k) views_[s].load[k] = values(arrays_[s], k);
    }
    const mpm_kernel::GridView view = view_of(grid);
    each_at_work(grid, [&](const mpm_kernel::BlockView& block) {
      kernels_.scatter_load(view, block, views_.data(), static_cast<int>(views_.size()), to.data());
    });
  }

  void find_gradient(Grid& grid, NodalField& to) {
    clear(grid, to);
    look_at_sets(grid);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      mpm_kernel::SetView<T>& view = views_[s];
      Arrays& a = arrays_[s];
      view.mass = 1.0;
      if (view.masses != nullptr) view.masses = a.one.data();
      // Stored first come the normal stresses along the grid's axes (math/dimension.hpp).
      for (int c = 0; c < 6; ++c) view.tau[c] = c < dim_ ? a.pull.data() : a.none.data();
    }
    mpm_kernel::GridView view = view_of(grid);
    view.force = to.data();
    each_at_work(grid, [&](const mpm_kernel::BlockView& block) {
      kernels_.force(view, block, views_.data(), static_cast<int>(views_.size()), nullptr);
    });
  }

  mpm_kernel::KernelTable<T> kernels_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  std::vector<double> densities_;
  GeometryKind geometry_;
  int dim_, threads_;
  std::vector<Arrays> arrays_;
  std::vector<std::uint8_t> at_work_, touched_;
  std::vector<mpm_kernel::SetView<T>> views_;
};

}  // namespace

template <class T>
std::unique_ptr<VolumeSurvey> make_volume_survey(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                                 std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                                 std::vector<double> densities, GeometryKind geometry, int threads) {
  return std::make_unique<VolumeSurveyOf<T>>(kernels, fields, sets, laws, std::move(densities), geometry, threads);
}

template std::unique_ptr<VolumeSurvey> make_volume_survey(const mpm_kernel::KernelTable<double>&, Fields&,
                                                          std::vector<ParticleSet>&, const std::vector<Law>&,
                                                          std::vector<double>, GeometryKind, int);
template std::unique_ptr<VolumeSurvey> make_volume_survey(const mpm_kernel::KernelTable<float>&, Fields&,
                                                          std::vector<ParticleSet>&, const std::vector<Law>&,
                                                          std::vector<double>, GeometryKind, int);

}  // namespace mpm
