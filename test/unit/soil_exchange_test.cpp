// Exchange between particles of soil and cells of the implicit step, sixteen numbers at once as the processor has it,
// against one particle and one piece after another, as devices have it (kernel/soil_exchange.hpp). 0.1 s.
#include "mpm/kernel/soil_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mpm/kernel/select.hpp"

namespace soil_exchange_test {

using mpm_kernel::SoilMotion;
using mpm_kernel::SoilParticles;
using mpm_kernel::SoilSums;

constexpr int kEdge = 4;   ///< cells of a block along an axis
constexpr int kAlong = 3;  ///< blocks around one along an axis
constexpr int kCount = 200;
constexpr int kCorner[3] = {8, 4, 12};  ///< first node of the block at work

/// Those of this build and machine.
std::vector<mpm::Isa> sets() {
  std::vector<mpm::Isa> list;
  for (const mpm::Isa isa : {mpm::Isa::plain, mpm::Isa::avx2, mpm::Isa::avx512}) {
    if (mpm::isa_available(isa)) list.push_back(isa);
  }
  return list;
}

/// Particles of soil in the block, deformed and under stress, and the cells of the blocks around it.
template <class T, class Geometry>
struct Bed {
  static constexpr int kDim = Geometry::kDim;
  static constexpr int kBlocks = kDim == 3 ? 27 : 9, kCells = kDim == 3 ? 64 : 16;
  std::array<std::vector<double>, 3> x;
  std::array<std::vector<T>, 9> f;
  std::array<std::vector<T>, 6> tau;
  std::vector<T> masses, strain, opening, work;
  std::vector<SoilSums<T>> sums = std::vector<SoilSums<T>>(kBlocks * kCells);
  std::vector<SoilMotion<T>> motion = std::vector<SoilMotion<T>>(kBlocks * kCells);

  /// Boxes have half the width of a cell, or just about all of it, so that thin pieces come up.
  /// `metal`: all have the same mass, and none opens.
  Bed(double half_width, bool metal) : half(half_width), is_metal(metal) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto fill = [&](std::vector<T>& values, double middle, double spread) {
      values.resize(kCount);
      for (T& value : values) value = static_cast<T>(middle + spread * any(random));
    };
    for (int k = 0; k < kDim; ++k) {
      x[k].resize(kCount);
      // A particle's nearest node is one of the block's, from half a cell below the first to half a cell above the
      // last.
      for (double& place : x[k]) place = kOrigin + kCell * (kCorner[k] + 1.5 + 1.999 * any(random));
      x[k][0] = kOrigin + kCell * (kCorner[k] + 1.0 + half);  // a box with a face on that of cells
    }
    for (int i = 0; i < Geometry::kMatrix; ++i) fill(f[i], i % (kDim + 1) == 0 ? 1.0 : 0.0, 0.1);
    for (int i = 0; i < Geometry::kSymmetric; ++i) fill(tau[i], i < 3 ? -1.0 : 0.0, 0.5);
    fill(masses, 2.0, 0.5);
    fill(strain, 0.3, 0.3);
    fill(opening, 0.0, 0.01);
    fill(work, 1.0, 0.5);
    for (SoilMotion<T>& cell : motion) {
      for (T& value : cell.gradient) value = static_cast<T>(any(random));
      for (T& value : cell.stress) value = static_cast<T>(1e3 * any(random));
      cell.opening = static_cast<T>(any(random));
      cell.shear = static_cast<T>(1.0 + any(random));
      cell.power = static_cast<T>(1e3 * any(random));
    }
  }

  SoilParticles<T> view() {
    SoilParticles<T> view{};
    for (int k = 0; k < kDim; ++k) {
      view.x[k] = x[k].data();
      view.half[k] = half;
      view.origin[k] = kOrigin;
      view.inverse_cell[k] = 1.0 / kCell;
    }
    for (int i = 0; i < 9; ++i) view.f[i] = f[i].data();
    for (int i = 0; i < 6; ++i) view.tau[i] = tau[i].data();
    view.strain = strain.data();
    view.opening = is_metal ? nullptr : opening.data();
    view.work = work.data();
    view.masses = is_metal ? nullptr : masses.data();
    view.mass = 1.7;
    view.density = 1600.0;
    view.bulk = 1e6;
    view.shear = 4e5;
    view.per_strain = 2.0;
    view.strain_of_shear = std::sqrt(2.0);
    view.dilation_start = 5.0;
    view.dilation_slope = 4.5;
    return view;
  }
  mpm_kernel::SoilPlacesOf<T> places() {
    mpm_kernel::SoilPlacesOf<T> of{};
    for (int n = 0; n < kBlocks; ++n) {
      of.sums[n] = sums.data() + n * kCells;
      of.motion[n] = motion.data() + n * kCells;
    }
    return of;
  }

  /// visit(number of the cell, parts of the box, middles) for each piece of a particle that is not empty.
  template <class Visit>
  void each_piece(int p, Visit&& visit) const {
    mpm::soil::Cut<T> cuts[kDim];
    for (int k = 0; k < kDim; ++k) {
      const double at = (x[k][p] - kOrigin) * (1.0 / kCell) - kCorner[k];
      cuts[k] = mpm::soil::Cut<T>(at, at - half, at + half, 1.0 / (2.0 * half));
    }
    for (int piece = 0; piece < 1 << kDim; ++piece) {
      int block = 0, local = 0;
      T part[kDim], middle[kDim];
      bool empty = false;
      for (int k = 0; k < kDim; ++k) {
        const int side = piece >> k & 1, from_first = cuts[k].cell + side + kEdge;  // among the blocks around
        block = kAlong * block + std::clamp(from_first / kEdge, 0, kAlong - 1);
        local = kEdge * local + from_first % kEdge;
        part[k] = cuts[k].part[side];
        middle[k] = cuts[k].middle[side];
        empty = empty || part[k] == T(0);
      }
      if (!empty) visit(block * kCells + local, part, middle);
    }
  }

  static constexpr double kOrigin = -0.7, kCell = 0.04;
  double half;
  bool is_metal;
};

template <class T>
void expect_near(const std::vector<T>& found, const std::vector<T>& sought, double size, const char* what) {
  double most = 0.0;
  for (std::size_t i = 0; i < sought.size(); ++i) most = std::max(most, std::abs(double(found[i]) - double(sought[i])));
  EXPECT_LE(most, 40.0 * std::numeric_limits<T>::epsilon() * size) << what;
}

/// The numbers of SoilSums in their order.
template <class T>
std::array<T, 16> numbers(const SoilSums<T>& s) {
  return {s.volume,    s.place[0],  s.place[1],  s.place[2],  s.place[3],  s.place[4], s.place[5], s.stress[0],
          s.stress[1], s.stress[2], s.stress[3], s.stress[4], s.stress[5], s.opening,  s.left,     s.dilates};
}

template <class T, class Geometry>
void compare(mpm::Isa isa, double half, bool metal) {
  constexpr auto kKind = Geometry::kDim == 3 ? mpm::GeometryKind::solid : mpm::GeometryKind::plane_strain;
  const mpm_kernel::SoilPasses<T>& passes = mpm::sweep_table<T>(isa, kKind).passes;
  constexpr double kDt = 0.1;  // in which volumes change by more than a step may give

  Bed<T, Geometry> all(half, metal), one(half, metal);
  passes.gather(all.view(), 0, kCount, kCorner, all.places());
  passes.take(all.view(), 0, kCount, kCorner, all.places(), kDt);

  const SoilParticles<T> view = one.view();
  std::array<double, 16> size{};  // sums of sizes, over all cells
  double volume = 0.0;
  for (int p = 0; p < kCount; ++p) {
    mpm::Wide<T> lanes[mpm::soil::kNumbers];
    mpm::soil::numbers_of<Geometry>(view, p, 1, lanes);
    T given[mpm::soil::kNumbers];
    for (int i = 0; i < mpm::soil::kNumbers; ++i) given[i] = lane(lanes[i], 0);
    volume += given[0];
    SoilSums<T> alone{};
    one.each_piece(p, [&](int cell, const T* part, const T* middle) {
      mpm::soil::add_piece<Geometry>(one.sums[cell], given, part, middle);
      mpm::soil::add_piece<Geometry>(alone, given, part, middle);
    });
    EXPECT_NEAR(alone.volume, given[0], 20.0 * std::numeric_limits<T>::epsilon() * given[0]);
    for (int i = 0; i < 16; ++i) size[i] = std::max(size[i], std::abs(double(numbers(alone)[i])));
  }
  for (int i = 0; i < 16; ++i) {
    std::vector<T> found, sought;
    double total = 0.0;
    for (std::size_t cell = 0; cell < one.sums.size(); ++cell) {
      found.push_back(numbers(all.sums[cell])[i]);
      sought.push_back(numbers(one.sums[cell])[i]);
      total += sought.back();
    }
    expect_near(found, sought, 4.0 * size[i], "sum");
    if (i == 0) {
      EXPECT_NEAR(total, volume, 1e3 * std::numeric_limits<T>::epsilon() * volume);
    }
  }

  for (int p = 0; p < kCount; ++p) {
    T sums[mpm::soil::kMotionNumbers] = {};
    one.each_piece(p, [&](int cell, const T* part, const T*) {
      T whole = part[0] * part[1];
      if constexpr (Geometry::kDim == 3) whole *= part[2];
      mpm::soil::add_motion(sums, whole, one.motion[cell]);
    });
    mpm::Wide<T> lanes[mpm::soil::kMotionNumbers];
    for (int i = 0; i < mpm::soil::kMotionNumbers; ++i) lanes[i] = mpm::Wide<T>(double(sums[i]));
    mpm::soil::take_motion<Geometry>(view, p, 1, lanes, kDt);
  }
  for (int i = 0; i < Geometry::kMatrix; ++i) expect_near(all.f[i], one.f[i], 1.0, "F");
  for (int i = 0; i < Geometry::kSymmetric; ++i) expect_near(all.tau[i], one.tau[i], 2.0, "tau");
  expect_near(all.strain, one.strain, 1.0, "plastic strain");
  expect_near(all.opening, one.opening, 0.1, "opening");
  expect_near(all.work, one.work, 2.0, "work");
}

template <class T>
void compare_all() {
  for (const mpm::Isa isa : sets()) {
    for (const double half : {0.25, 0.4999}) {
      for (const bool metal : {false, true}) {
        compare<T, mpm::Solid>(isa, half, metal);
        compare<T, mpm::PlaneStrain>(isa, half, metal);
      }
    }
  }
}

TEST(SoilExchange, IsThatOfOneParticleAndOnePieceAfterAnother) {
  compare_all<double>();
  compare_all<float>();
}

}  // namespace soil_exchange_test
