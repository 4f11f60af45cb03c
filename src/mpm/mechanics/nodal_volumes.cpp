#include "mpm/mechanics/nodal_volumes.hpp"

#include <array>

#include "mpm/loop/loop.hpp"
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

class NodalVolumeSurvey final : public VolumeSurvey {
  using Weight = ScalarTransfer::Weight;

 public:
  NodalVolumeSurvey(std::unique_ptr<ScalarTransfer> transfer, Fields& fields, std::vector<ParticleSet>& sets,
                    std::vector<double> densities, GeometryKind geometry, int threads, const NodeChoice* choice)
      : transfer_(std::move(transfer)),
        fields_(fields),
        sets_(sets),
        densities_(std::move(densities)),
        geometry_(geometry),
        dim_(dimensions(geometry)),
        threads_(threads),
        choice_(choice),
        arrays_(sets.size()) {}

  void survey(int field, const std::vector<std::uint8_t>& marked, const SurveyWants& wants,
              NodalVolumes& result) override {
    const Grid& grid = *fields_[field];
    find_givers(grid, marked, giving_);
    make_room(wants);
    fill(grid, wants);
    const auto spread = [&](NodalField& to, auto&& number) {
      transfer_->spread(field, given(number), Weight::mass, to, &marked);
    };
    const auto volume = [&](std::size_t s, int) { return arrays_[s].volume.data(); };
    transfer_->spread_gradient_sum(field, given(volume), Weight::mass, result.gradient, &marked);
    spread(result.volume, volume);
    if (wants.start_volume) {
      spread(result.start_volume, [&](std::size_t s, int) { return arrays_[s].start_volume.data(); });
    }
    if (wants.position) spread(result.position, [&](std::size_t s, int k) { return sets_[s].x[k].data(); });
    if (wants.displacement)
      spread(result.displacement, [&](std::size_t s, int k) { return arrays_[s].moved[k].data(); });
    for (int c = 0; c < dim_ && wants.slope; ++c) {
      spread(result.slope[c], [&](std::size_t s, int k) { return arrays_[s].slope[c][k].data(); });
    }
  }

 private:
  /// Values of a set's particles, in their order; filled for those of the owners at work.
  struct Arrays {
    PaddedArray<double> volume, start_volume;                 ///< over mass [m^3/kg]
    std::array<PaddedArray<double>, 3> moved;                 ///< displacement [m]
    std::array<std::array<PaddedArray<double>, 3>, 3> slope;  ///< slope of the displacement
  };

  // number(set, component): an array.
  template <class Number>
  const ScalarTransfer::Given& given(Number&& number) {
    given_.assign(sets_.size(), {});
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      for (int k = 0; k < dim_; ++k) given_[s][k] = number(s, k);
    }
    return given_;
  }

  void make_room(const SurveyWants& wants) {
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const std::size_t size = sets_[s].id.size();
      const auto room = [&](PaddedArray<double>& of) {
        if (of.size() != size) of.assign(size, 0.0);
      };
      Arrays& a = arrays_[s];
      room(a.volume);
      if (wants.start_volume) room(a.start_volume);
      for (int c = 0; c < dim_; ++c) {
        if (wants.displacement) room(a.moved[c]);
        for (int k = 0; k < dim_ && wants.slope; ++k) room(a.slope[c][k]);
      }
    }
  }

  void fill(const Grid& grid, const SurveyWants& wants) {
    for_all("particles: volumes and gradients", threads_, grid.blocks.owners(), [&](int o) {
      if (giving_[o] != 0) fill_owner(grid.first_owner + o, wants);
    });
    if (choice_ == nullptr) return;
    for (int patch = 0; patch < choice_->patches(); ++patch) fill_owner(choice_->grid().first_owner + patch, wants);
  }

  void fill_owner(int owner, const SurveyWants& wants) {
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const ParticleSet& set = sets_[s];
      with_geometry(geometry_, [&](auto kind) {
        for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) fill(kind, s, p, wants);
      });
    }
  }

  template <class Geometry>
  void fill(Geometry, std::size_t s, std::uint32_t p, const SurveyWants& wants) {
    const ParticleSet& set = sets_[s];
    Arrays& a = arrays_[s];
    const auto f = Geometry::load_matrix(set.f, static_cast<int>(p));
    const auto around = [](double radius) { return Geometry::kHoop ? kTurn * radius : 1.0; };
    const double start = 1.0 / densities_[s];
    a.volume[p] = start * determinant(f) / around(set.x[0][p]);
    if (wants.start_volume) a.start_volume[p] = start / around(Geometry::kHoop ? set.start_x[0][p] : 0.0);
    for (int c = 0; c < dim_ && wants.displacement; ++c) {
      a.moved[c][p] = set.x[c][p] - set.start_x[c][p];
    }
    if (!wants.slope) return;
    const auto h = slopes(f);
    for (int c = 0; c < dim_; ++c) {
      for (int k = 0; k < dim_; ++k) a.slope[c][k][p] = h[c][k];
    }
  }

  std::unique_ptr<ScalarTransfer> transfer_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  std::vector<double> densities_;
  GeometryKind geometry_;
  int dim_, threads_;
  const NodeChoice* choice_;
  std::vector<Arrays> arrays_;
  ScalarTransfer::Given given_;
  std::vector<std::uint8_t> giving_;  ///< for each owner, 1 if its particles give to a marked block
};

}  // namespace

std::unique_ptr<VolumeSurvey> make_volume_survey(std::unique_ptr<ScalarTransfer> transfer, Fields& fields,
                                                 std::vector<ParticleSet>& sets, std::vector<double> densities,
                                                 GeometryKind geometry, int threads, const NodeChoice* choice) {
  return std::make_unique<NodalVolumeSurvey>(std::move(transfer), fields, sets, std::move(densities), geometry, threads,
                                             choice);
}

}  // namespace mpm
