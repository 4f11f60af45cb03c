// Rules for the weights of every shape function, seen through the transfers that any field may use: values of a
// particle sum to 1 and its gradients to 0, linear fields and their slopes are reproduced; and that sums do not depend
// on threads or on what is left out. Against plain loops: kernel_shapes_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mpm/mechanics/scalar_transfers.hpp"
#include "step_scene.hpp"

namespace mpm::test {
namespace scalar_transfer_test {

using Weight = ScalarTransfer::Weight;

/// A jittered body, and transfers between it and its nodes.
template <class Geometry, class T>
struct Body {
  using Scene = StepScene<Geometry, T>;
  static constexpr int kDim = Scene::kDim;

  explicit Body(ShapeKind shape, int threads = 1) : scene({shape, UpdateScheme::usf, {TransferKind::flip, 1.0, 2}}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (ParticleScalar& f : scene.set().f) {
      for (int p = 0; p < scene.set().size(); ++p) f.set(p, f[p] + 0.1 * unit(random));
    }
    StepContext context = scene.context();
    scene.mechanics->scatter_momentum(context);  // domains that follow the deformation are noted
    sets = {scene.set()};
    transfer = make_scalar_transfer(scene.kernels(), scene.fields, sets, threads);
    for (auto& component : of) {
      component.resize(scene.set().size());
      for (double& number : component) number = unit(random);
    }
    for (auto& component : taken) component.resize(scene.set().size());
  }
  NodalField nodal(int components) const {
    NodalField field(components, scene.grid.layout.nodes_per_block());
    field.resize(scene.grid.blocks.size());
    return field;
  }
  ScalarTransfer::Given given() const { return {{of[0].data(), of[1].data(), of[2].data()}}; }
  ScalarTransfer::Taken to() { return {{taken[0].data(), taken[1].data(), taken[2].data()}}; }

  Scene scene;
  std::vector<ParticleSet> sets;
  std::unique_ptr<ScalarTransfer> transfer;
  std::array<std::vector<double>, 3> of, taken;
};

/// Rounding of a place in a tile, up to 8 cells, by weights that change by 1 / (2 half) a cell; a few terms.
template <class T>
constexpr double kRounding = sizeof(T) == 8 ? 1e-12 : 64 * std::numeric_limits<float>::epsilon();

template <class Geometry, class T>
void check_identities(ShapeKind shape) {
  if (!has_shape(shape, kGeometryKind<Geometry>)) return;
  SCOPED_TRACE(std::string(shape_name(shape)) + " " + spoken_name(kGeometryKind<Geometry>));
  Body<Geometry, T> body(shape);
  auto& scene = body.scene;
  constexpr int kDim = Geometry::kDim;
  constexpr double cell = StepScene<Geometry, T>::kCell;

  // A constant, and the place.
  NodalField one = body.nodal(1), place = body.nodal(kDim);
  scene.each_node([&](int b, int n, const std::array<int, 3>& at) {
    one.at(b, 0, n) = 1.0;
    for (int k = 0; k < kDim; ++k) place.at(b, k, n) = scene.node_position(at[k]);
  });
  body.transfer->gather(0, one, body.to());
  for (const double sum : body.taken[0]) EXPECT_NEAR(sum, 1.0, kRounding<T>);
  body.transfer->gradient(0, one, body.to());
  for (int k = 0; k < kDim; ++k) {
    for (const double sum : body.taken[k]) EXPECT_NEAR(sum, 0.0, kRounding<T> / cell);
  }
  body.transfer->gather(0, place, body.to());
  for (int p = 0; p < scene.set().size(); ++p) {
    const auto mean = scene.mean_place(p);  // its own, but for a ring, whose values have the weight r
    for (int k = 0; k < kDim; ++k) {
      if (!Geometry::kHoop) {
        EXPECT_NEAR(mean[k], scene.set().x[k][p], 1e-12);
      }
      EXPECT_NEAR(body.taken[k][p], mean[k], kRounding<T> * 8 * cell);
    }
  }
  // The slope of a linear field; of r, d r/d r = 1 holds for the weighted functions too, and T makes r / r = 1 of it
  // where T is that of the plane's average: method reference 3.
  for (int k = 0; k < kDim; ++k) {
    NodalField along = body.nodal(1);
    scene.each_node(
        [&](int b, int n, const std::array<int, 3>& at) { along.at(b, 0, n) = scene.node_position(at[k]); });
    body.transfer->gradient(0, along, body.to());
    for (int j = 0; j < kDim; ++j) {
      for (const double slope : body.taken[j]) EXPECT_NEAR(slope, j == k ? 1.0 : 0.0, 16 * kRounding<T>);
    }
    if (!Geometry::kHoop || k > 0) continue;
    for (const double hoop : body.taken[2]) EXPECT_NEAR(hoop, 1.0, 16 * kRounding<T>);
  }
  body.transfer->slopes(0, place, body.to());
  for (int k = 0; k < kDim; ++k) {
    for (const double slope : body.taken[k]) EXPECT_NEAR(slope, 1.0, 16 * kRounding<T>);
  }

  // The place whose slope a gradient takes is the slope of a parabola, which splines know at the particle itself.
  std::array<std::vector<double>, 3> places;
  for (int k = 0; k < kDim; ++k) {
    NodalField parabola = body.nodal(1);
    scene.each_node([&](int b, int n, const std::array<int, 3>& at) {
      parabola.at(b, 0, n) = 0.5 * std::pow(scene.node_position(at[k]), 2);
    });
    body.transfer->gradient(0, parabola, body.to());
    places[k].assign(body.taken[k].begin(), body.taken[k].begin() + scene.set().size());
  }
  body.transfer->slope_lead(body.to());
  for (int k = 0; k < kDim; ++k) {
    for (int p = 0; p < scene.set().size(); ++p) {
      EXPECT_NEAR(body.taken[k][p], places[k][p] - scene.set().x[k][p], kRounding<T> * 64 * cell);
      if (shape == ShapeKind::bspline2) {
        EXPECT_NEAR(body.taken[k][p], 0.0, kRounding<T> * 64 * cell);
      } else {
        EXPECT_LE(std::abs(body.taken[k][p]), (0.5 + kRounding<T>)*cell);
      }
    }
  }

  // All that particles give arrives; gradients give as much as they take.
  NodalField found = body.nodal(1);
  const auto total = [&](double& size) {
    double sum = 0.0;
    scene.each_node([&](int b, int n, const std::array<int, 3>&) {
      sum += found.at(b, 0, n);
      size += std::abs(found.at(b, 0, n));
    });
    return sum;
  };
  double size = 0.0;
  body.transfer->spread(0, body.given(), Weight::one, found);
  const double given = std::accumulate(body.of[0].begin(), body.of[0].end(), 0.0);
  const double arrived = total(size);
  EXPECT_NEAR(arrived, given, kRounding<T> * size);
  size = 0.0;
  ScalarTransfer::Given without_hoop = body.given();
  if (Geometry::kHoop) without_hoop[0][2] = nullptr;
  body.transfer->spread_gradient(0, without_hoop, Weight::mass, found);
  const double left = total(size);
  EXPECT_GT(size, 0.0);
  EXPECT_NEAR(left, 0.0, kRounding<T> * size);
}

template <class Geometry>
void check_shapes() {
  for (const ShapeKind shape : kAllShapes) {
    check_identities<Geometry, double>(shape);
    check_identities<Geometry, float>(shape);
  }
}
TEST(ScalarTransfer, KeepsSumsAndLinearFieldsOfALine) { check_shapes<Line>(); }
TEST(ScalarTransfer, KeepsSumsAndLinearFieldsOfAPlane) { check_shapes<PlaneStrain>(); }
TEST(ScalarTransfer, KeepsSumsAndLinearFieldsOfRings) { check_shapes<Axisymmetric>(); }
TEST(ScalarTransfer, KeepsSumsAndLinearFieldsOfASolid) { check_shapes<Solid>(); }

// Gathering is the transpose of spreading, and the gradient of its spread: sum over particles of a_p (S b)_p = sum over
// nodes of (S^T a)_i b_i.
TEST(ScalarTransfer, GathersWithWhatItSpreads) {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, GeometryKind::axisymmetric)) continue;
    Body<Axisymmetric, double> body(shape);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    NodalField b = body.nodal(1), spread = body.nodal(1);
    body.scene.each_node([&](int block, int n, const std::array<int, 3>&) { b.at(block, 0, n) = unit(random); });
    for (const bool gradient : {false, true}) {
      double of_nodes = 0.0, of_particles = 0.0, size = 0.0;
      if (gradient) {
        body.transfer->spread_gradient(0, body.given(), Weight::one, spread);
        body.transfer->gradient(0, b, body.to());
      } else {
        body.transfer->spread(0, body.given(), Weight::one, spread);
        body.transfer->gather(0, b, body.to());
      }
      for (int k = 0; k < (gradient ? 3 : 1); ++k) {
        for (std::size_t p = 0; p < body.of[k].size(); ++p) {
          of_particles += body.of[k][p] * body.taken[k][p];
          size += std::abs(body.of[k][p] * body.taken[k][p]);
        }
      }
      body.scene.each_node(
          [&](int block, int n, const std::array<int, 3>&) { of_nodes += spread.at(block, 0, n) * b.at(block, 0, n); });
      EXPECT_NEAR(of_nodes, of_particles, 1e-12 * size) << shape_name(shape);
    }
  }
}

TEST(ScalarTransfer, HasTheSameBitsForAnyNumberOfThreadsAndOfMarks) {
  Body<Solid, double> one(ShapeKind::ugimp, 1), three(ShapeKind::ugimp, 3);
  NodalField first = one.nodal(3), second = one.nodal(3), marked = one.nodal(3);
  one.transfer->spread(0, one.given(), Weight::mass, first);
  three.transfer->spread(0, three.given(), Weight::mass, second);
  ScalarTransfer::Marks marks(one.scene.grid.blocks.size(), 0);
  for (std::size_t b = 0; b < marks.size(); b += 3) marks[b] = 1;
  three.transfer->spread(0, three.given(), Weight::mass, marked, &marks);
  const int count = 3 * one.scene.grid.layout.nodes_per_block();
  double largest = 0.0;
  for (int b = 0; b < one.scene.grid.blocks.size(); ++b) {
    for (int i = 0; i < count; ++i) {
      largest = std::max(largest, std::abs(first.block(b)[i]));
      EXPECT_EQ(first.block(b)[i], second.block(b)[i]);
      if (marks[b] != 0) {
        EXPECT_EQ(first.block(b)[i], marked.block(b)[i]);
      }
    }
  }
  EXPECT_GT(largest, 0.0);
}

}  // namespace scalar_transfer_test
}  // namespace mpm::test
