// Tractions as forces on the grid: at which nodes they act, on which particles, and their sums. The mass of nodes is
// set by hand, so that only the stage itself acts.
#include "mpm/mechanics/face_tractions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "mpm/math/constants.hpp"
#include "mpm/step/sorter.hpp"

namespace mpm {
namespace face_tractions_test {

constexpr double kCell = 0.1, kHalf = 0.25, kThickness = 0.3, kDt = 1e-3;
constexpr double kTwoPi = 2.0 * mpm::kPi;
constexpr std::array<DomainFace, 4> kEdges = {{{1, false}, {0, true}, {1, true}, {0, false}}};

using Points = std::vector<std::array<double, 3>>;

/// Particles at rest with boxes of half a cell; every node has mass.
struct Stand {
  Stand(GeometryKind kind, ShapeKind shape_kind, const Points& points)
      : geometry(kind),
        shape(shape_kind),
        dim(dimensions(kind)),
        fields(make_fields(GridLayout(dim, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(2.0)))) {
    ParticleSet set;
    set.name = "block";
    set.mass = 1.0;
    set.half = {kHalf, kHalf, kHalf};
    set.highest = {20.0, 20.0, 20.0};
    set.first_id = 5;
    set.id.resize(points.size());
    std::iota(set.id.begin(), set.id.end(), 5u);
    set.x.resize(dim);
    for (int k = 0; k < dim; ++k) {
      set.x[k].resize(points.size());
      for (std::size_t p = 0; p < points.size(); ++p) set.x[k][p] = points[p][k];
    }
    set.v.assign(dim, ParticleScalar(Precision::float64, points.size()));
    set.f.assign(9, ParticleScalar(Precision::float64, points.size()));
    if (traits_of(shape).follows_deformation()) {
      const int components = shape == ShapeKind::ugimp_stretch ? dim : dim * dim;
      set.domain.assign(components, ParticleScalar(Precision::float64, points.size()));
    }
    set.start_x = set.x;
    sets.push_back(std::move(set));
    sort();
  }
  void sort() {
    ASSERT_FALSE(sorter.sort(sets, fields));
    fill(grid.mass, 1.0);
    fill(grid.force, 0.0);
  }
  void fill(NodalField& field, double value) const {
    std::fill_n(field.data(), grid.blocks.size() * field.components() * grid.layout.nodes_per_block(), value);
  }
  /// Sets F of every particle, by rows, in the grid's axes.
  void deform(const std::vector<double>& f) {
    for (std::size_t c = 0; c < sets[0].domain.size(); ++c) sets[0].domain[c].assign(sets[0].size(), f[c]);
  }
  TractionTerm term(DomainFace face, const std::array<Function, 3>& value, bool follows = false) const {
    TractionTerm term;
    term.face = face;
    term.particles.resize(sets[0].size());
    std::iota(term.particles.begin(), term.particles.end(), 0u);
    term.follows = follows;
    term.value = value;
    return term;
  }
  FaceTractions stage(const std::vector<TractionTerm>& terms) {
    return {{geometry, shape, kThickness}, fields, sets, terms};
  }
  /// Forces that are not zero, by node numbers.
  std::map<std::array<int, 3>, Vec3> forces(FaceTractions& stage, double start = 0.0) {
    fill(grid.force, 0.0);
    StepContext context{fields, kDt, start};
    stage.forces_gathered(context);
    std::map<std::array<int, 3>, Vec3> found;
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
        const Vec3 force = nodal_vector(grid.force, grid.layout, {b, n});
        if (force.norm() > 0.0) found[grid.layout.node(grid.blocks.block(b), n)] = force;
      }
    }
    return found;
  }
  static Vec3 impulse(const FaceTractions& stage) {
    std::vector<ImpulseAccount> accounts;
    stage.accounts(accounts);
    EXPECT_EQ(accounts.size(), 1u);
    EXPECT_EQ(accounts[0].name, "traction");
    return accounts[0].impulse;
  }

  GeometryKind geometry;
  ShapeKind shape;
  int dim;
  Sorter sorter{1};
  Fields fields;
  Grid& grid = *fields.front();
  std::vector<ParticleSet> sets;
};

Vec3 sum(const std::map<std::array<int, 3>, Vec3>& forces) {
  Vec3 total = Vec3::Zero();
  for (const auto& [node, force] : forces) total += force;
  return total;
}

double hat(double cells) { return std::max(0.0, 1.0 - std::abs(cells)); }

// F = [[1.2, 0.4], [-0.1, 0.9]]: half vectors (0.03, -0.0025) and (0.01, 0.0225) m. The edge x_max of a particle at
// (0.52, 0.41) has its corners at (0.54, 0.385) and (0.56, 0.43), each with |d_2| thickness of its area: eq. (51).
TEST(FaceTractions, GoToTheNodesOfTheCorners) {
  Stand stand(GeometryKind::plane_strain, ShapeKind::cpdi, {{0.52, 0.41, 0.0}});
  stand.deform({1.2, 0.4, -0.1, 0.9});
  auto stage = stand.stage({stand.term({0, true}, {Function(1000.0), Function(), Function(-200.0)})});
  const auto forces = stand.forces(stage);
  const double area = std::hypot(0.01, 0.0225) * kThickness;
  for (int i = 4; i < 8; ++i) {
    for (int j = 2; j < 7; ++j) {
      const double weight = area * (hat(5.4 - i) * hat(3.85 - j) + hat(5.6 - i) * hat(4.3 - j));
      const auto found = forces.find({i, j, 0});
      const Vec3 force = found == forces.end() ? Vec3(Vec3::Zero()) : found->second;
      EXPECT_NEAR(force.x(), 1000.0 * weight, 1e-13) << i << ' ' << j;  // round-off of 10 N
      EXPECT_NEAR(force.z(), -200.0 * weight, 1e-13) << i << ' ' << j;
    }
  }
  const Vec3 total(2000.0 * area, 0.0, -400.0 * area);
  EXPECT_LT((sum(forces) - total).norm(), 1e-14 * total.norm());
  EXPECT_LT((Stand::impulse(stage) - total * kDt).norm(), 1e-14 * total.norm() * kDt);
}

// Faces of a box: with F = diag(1.5, 0.8) the edge x_max has 0.8 of its initial length with CPDI and with the box that
// stretches, at the end of a half vector that is 1.5 times as long. uGIMP and functions without a box have the initial
// edge.
TEST(FaceTractions, ActOnTheDomainOfTheShapeFunction) {
  for (const ShapeKind shape : {ShapeKind::dirac, ShapeKind::ugimp, ShapeKind::ugimp_stretch, ShapeKind::cpdi,
                                ShapeKind::qcpdi, ShapeKind::bspline2, ShapeKind::bspline3}) {
    Stand stand(GeometryKind::plane_strain, shape, {{0.52, 0.41, 0.0}});
    const bool stretch = shape == ShapeKind::ugimp_stretch;
    stand.deform(stretch ? std::vector<double>{1.5, 0.8} : std::vector<double>{1.5, 0.0, 0.0, 0.8});
    auto stage = stand.stage({stand.term({0, true}, {Function::parse("1000*x"), Function(), Function()})});
    const double edge = 2.0 * kHalf * kCell * (traits_of(shape).follows_deformation() ? 0.8 : 1.0);
    const double x = 0.52 + kHalf * kCell * (traits_of(shape).follows_deformation() ? 1.5 : 1.0);
    EXPECT_NEAR(sum(stand.forces(stage)).x(), 1000.0 * x * edge * kThickness, 1e-13) << shape_name(shape);
  }
}

// The edge x_max of a ring at r with half vectors a, b has an area of 2 b (r + a) a radian, 2 pi times as much in all.
// The box at r = 0.01 m is cut off at the axis: it extends from 0 to 0.035 m, and z_max has an area pi r^2.
TEST(FaceTractions, AreOfWholeRings) {
  const double a = kHalf * kCell;
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::cpdi}) {
    Stand stand(GeometryKind::axisymmetric, shape, {{0.62, 0.41, 0.0}});
    stand.deform({1.0, 0.0, 0.0, 1.0});
    auto stage = stand.stage({stand.term({0, true}, {Function(1000.0), Function(), Function()})});
    const double force = 1000.0 * kTwoPi * (0.62 + a) * 2.0 * a;
    EXPECT_NEAR(sum(stand.forces(stage)).x(), force, 1e-13 * force);
    EXPECT_NEAR(Stand::impulse(stage).x(), force * kDt, 1e-13 * force * kDt);
  }
  Stand inner(GeometryKind::axisymmetric, ShapeKind::ugimp, {{0.01, 0.41, 0.0}});
  auto stage = inner.stage({inner.term({1, true}, {Function(), Function(), Function(1000.0)})});
  const double disk = 1000.0 * 0.5 * kTwoPi * std::pow(0.01 + a, 2);
  EXPECT_NEAR(sum(inner.forces(stage)).z(), disk, 1e-13 * disk);
}

// The deformed domain of CPDI at r = 0.02 m reaches r = 0.02 - 0.025 1.2 - 0.025 0.4 = -0.02 m: all its half vectors
// are halved.
TEST(FaceTractions, OfADomainAtTheAxisAreThoseOfTheSmallerOne) {
  Stand stand(GeometryKind::axisymmetric, ShapeKind::cpdi, {{0.02, 0.41, 0.0}});
  stand.deform({1.2, 0.4, -0.1, 0.9});
  auto stage = stand.stage({stand.term({1, true}, {Function(), Function(), Function(1000.0)})});
  const double force = 1000.0 * kTwoPi * (0.02 + 0.5 * 0.01) * std::hypot(0.03, 0.0025);
  EXPECT_NEAR(sum(stand.forces(stage)).z(), force, 1e-13 * force);
}

// Pressure follows a block that has turned: its sum over all edges is zero, and on one edge it acts against the normal.
TEST(FaceTractions, MayFollowTheFace) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  Stand stand(GeometryKind::plane_strain, ShapeKind::cpdi, {{0.52, 0.41, 0.0}, {0.9, 0.3, 0.0}});
  stand.deform({c, -s, s, c});
  const std::array<Function, 3> value = {Function(1000.0), Function(30.0), Function()};
  const double area = 2.0 * kHalf * kCell * kThickness;
  auto one = stand.stage({stand.term({0, true}, value, true)});
  const Vec3 expected = 2.0 * area * (-1000.0 * Vec3(c, 0.0, s) + 30.0 * Vec3(-s, 0.0, c));
  EXPECT_LT((sum(stand.forces(one)) - expected).norm(), 1e-13 * expected.norm());
  std::vector<TractionTerm> terms;
  for (const DomainFace face : kEdges) {
    terms.push_back(stand.term(face, {Function(1000.0), Function(), Function()}, true));
  }
  auto all = stand.stage(terms);
  EXPECT_LT(sum(stand.forces(all)).norm(), 1e-13 * expected.norm());
  EXPECT_LT(Stand::impulse(all).norm(), 1e-13 * expected.norm() * kDt);
}

TEST(FaceTractions, InASolidAndInALine) {
  Stand solid(GeometryKind::solid, ShapeKind::cpdi, {{0.52, 0.41, 0.63}});
  solid.deform({1.2, 0.3, -0.1, 0.1, 0.9, 0.25, -0.2, 0.15, 1.1});
  std::vector<TractionTerm> terms;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      terms.push_back(solid.term({axis, upper}, {Function(1000.0), Function(), Function()}, true));
    }
  }
  auto closed = solid.stage(terms);
  const double scale = 1000.0 * std::pow(2.0 * kHalf * kCell, 2);
  EXPECT_LT(sum(solid.forces(closed)).norm(), 1e-13 * scale);
  // The face z_max is spanned by d_1 and d_2, 0.025 of the columns of F; shear along them in turn.
  auto top = solid.stage({solid.term({2, true}, {Function(1000.0), Function(50.0), Function(-70.0)}, true)});
  const Vec3 d1(1.2, 0.1, -0.2), d2(0.3, 0.9, 0.15);
  const Vec3 normal = d1.cross(d2);
  const double area = 4.0 * std::pow(kHalf * kCell, 2) * normal.norm();
  const Vec3 expected = area * (-1000.0 * normal.normalized() + 50.0 * d1.normalized() - 70.0 * d2.normalized());
  EXPECT_LT((sum(solid.forces(top)) - expected).norm(), 1e-13 * expected.norm());

  Stand line(GeometryKind::line, ShapeKind::ugimp, {{0.52, 0.0, 0.0}});
  auto end = line.stage({line.term({0, false}, {Function(1000.0), Function(), Function()})});
  const auto forces = line.forces(end);  // at x = 0.495 m, with the area of the line
  EXPECT_NEAR(forces.at({4, 0, 0}).x(), 1000.0 * kThickness * 0.05, 1e-12);
  EXPECT_NEAR(forces.at({5, 0, 0}).x(), 1000.0 * kThickness * 0.95, 1e-12);
}

// In plane stress a domain that follows the deformation has the particle's present thickness: f[4] = 0.7.
TEST(FaceTractions, OfASheetHaveItsThickness) {
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::cpdi}) {
    Stand stand(GeometryKind::plane_stress, shape, {{0.52, 0.41, 0.0}});
    stand.deform({1.0, 0.0, 0.0, 1.0});
    stand.sets[0].f[4].assign(1, 0.7);
    auto stage = stand.stage({stand.term({0, true}, {Function(1000.0), Function(), Function()})});
    const double thickness = kThickness * (shape == ShapeKind::cpdi ? 0.7 : 1.0);
    EXPECT_NEAR(sum(stand.forces(stage)).x(), 1000.0 * 2.0 * kHalf * kCell * thickness, 1e-13);
  }
}

// Functions are evaluated at mid-step, at the present and the initial middle of the face.
TEST(FaceTractions, AreFunctionsOfTimeAndPlace) {
  Stand stand(GeometryKind::plane_strain, ShapeKind::ugimp, {{0.52, 0.41, 0.0}});
  stand.sets[0].start_x[0][0] = 0.3;
  stand.sets[0].v[0].set(0, 2.0);
  const double area = 2.0 * kHalf * kCell * kThickness;
  auto stage =
      stand.stage({stand.term({0, true}, {Function::parse("1e4*t"), Function(),
                                          Function::parse("100*x + 1e4*X", {}, FunctionPlaces::present_and_start)})});
  const Vec3 force = sum(stand.forces(stage, 0.5));
  EXPECT_NEAR(force.x(), area * 1e4 * (0.5 + 0.5 * kDt), 1e-12);
  EXPECT_NEAR(force.z(), area * (100.0 * (0.545 + 0.5 * kDt * 2.0) + 1e4 * 0.325), 1e-12);
  auto bad = stand.stage({stand.term({0, true}, {Function::parse("sqrt(-t)"), Function(), Function()})});
  try {
    stand.forces(bad, 1.0);
    ADD_FAILURE() << "a traction that is not finite went unnoticed";
  } catch (const LoadError& error) {
    EXPECT_EQ(std::string(error.what()).find("traction on 'block' at particle 5: "), 0u) << error.what();
  }
}

// One particle of three is loaded. It moves past the others, and is found again after a sort.
TEST(FaceTractions, StayWithTheirParticles) {
  Stand stand(GeometryKind::plane_strain, ShapeKind::ugimp, {{0.52, 0.41, 0.0}, {1.12, 0.41, 0.0}, {1.52, 0.41, 0.0}});
  TractionTerm term = stand.term({0, true}, {Function(1000.0), Function(), Function()});
  term.particles = {0};
  auto stage = stand.stage({term});
  const auto centre = [](const std::map<std::array<int, 3>, Vec3>& forces) {
    double moment = 0.0;
    for (const auto& [node, force] : forces) moment += node[0] * kCell * force.x();
    return moment / sum(forces).x();
  };
  EXPECT_NEAR(centre(stand.forces(stage)), 0.545, 1e-14);
  for (std::size_t p = 0; p < 3; ++p) {
    if (stand.sets[0].id[p] == 5) stand.sets[0].x[0][p] = 1.82;
  }
  stand.sort();
  ASSERT_EQ(stand.sets[0].id[2], 5u);  // the loaded particle is the last one now
  EXPECT_NEAR(centre(stand.forces(stage)), 1.845, 1e-14);
}

// A corner at 5.2 cells between node 5, which has mass, and node 6, which dirac's particle at 4.95 cells gives none.
TEST(FaceTractions, KeepTheirForceWhereANodeHasNoMass) {
  Stand stand(GeometryKind::line, ShapeKind::dirac, {{0.495, 0.0, 0.0}});
  auto stage = stand.stage({stand.term({0, true}, {Function(1000.0), Function(), Function()})});
  for (int b = 0; b < stand.grid.blocks.size(); ++b) {
    for (int n = 0; n < kBlockEdge; ++n) {
      const int node = stand.grid.layout.node(stand.grid.blocks.block(b), n)[0];
      stand.grid.mass.at(b, 0, n) = node == 4 || node == 5 ? 1.0 : 0.0;
    }
  }
  const auto forces = stand.forces(stage);
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_NEAR(forces.at({5, 0, 0}).x(), 1000.0 * kThickness, 1e-12);
  stand.fill(stand.grid.mass, 0.0);
  EXPECT_THROW(stand.forces(stage), LoadError);
}

// Work is force times the displacement of the nodes, v dt - a dt^2 / 2.
TEST(FaceTractions, DoWork) {
  Stand stand(GeometryKind::plane_strain, ShapeKind::ugimp, {{0.52, 0.41, 0.0}});
  auto stage = stand.stage({stand.term({0, true}, {Function(1000.0), Function(), Function()})});
  const double force = sum(stand.forces(stage)).x();
  stand.fill(stand.grid.velocity, 3.0);
  stand.fill(stand.grid.force, 400.0);  // the field now holds the acceleration
  StepContext context{stand.fields, kDt, 0.0};
  stage.momentum_updated(context);
  const double expected = force * (3.0 * kDt - 0.5 * 400.0 * kDt * kDt);
  EXPECT_NEAR(stage.work(), expected, 1e-14 * expected);
}

// An L of 4 by 4 less 2 by 2 particles: the outermost ones along x include those of the short rows.
TEST(FaceTractions, FindTheOutermostParticles) {
  Points points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < (j < 2 ? 4 : 2); ++i) points.push_back({0.025 + 0.05 * i, 0.025 + 0.05 * j, 0.0});
  }
  const Stand stand(GeometryKind::plane_strain, ShapeKind::ugimp, {{0.5, 0.5, 0.0}});
  ParticleSet set = stand.sets[0];
  set.id.resize(points.size());
  for (int k = 0; k < 2; ++k) {
    set.x[k].resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) set.x[k][p] = points[p][k];
  }
  using List = std::vector<std::uint32_t>;
  EXPECT_EQ(outermost_particles(set, stand.grid.layout, {0, true}), (List{3, 7, 9, 11}));
  EXPECT_EQ(outermost_particles(set, stand.grid.layout, {0, false}), (List{0, 4, 8, 10}));
  EXPECT_EQ(outermost_particles(set, stand.grid.layout, {1, true}), (List{6, 7, 10, 11}));
  EXPECT_EQ(outermost_particles(set, stand.grid.layout, {1, false}), (List{0, 1, 2, 3}));
}

}  // namespace face_tractions_test
}  // namespace mpm
