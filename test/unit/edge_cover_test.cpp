// Weights of the nodes around a point of contact near the edge of a tool's face.
#include "mpm/contact/edge_cover.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "mpm/step/point_weights.hpp"
#include "mpm/step/sorter.hpp"

namespace mpm {
namespace edge_cover_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kCell = 0.1;
constexpr double kSeen = 1e-5;     ///< [m/s]: a millionth of a node taken for all, of velocities 10 m/s apart
constexpr double kFurther = 0.15;  ///< cells by which an edge of a tool without sides acts further out than it lies

/// A field whose nodes all carry 1 kg, from 0 to 2 m along each axis.
struct Field {
  explicit Field(int dim, const Vec3& cell = Vec3::Constant(kCell))
      : fields(make_fields(GridLayout(dim, cell, Vec3::Zero(), Vec3::Constant(2.0)))), sets(1) {
    ParticleSet& set = sets[0];
    set.half = {0.5, 0.5, 0.5};
    set.highest = {20.0, 20.0, 20.0};
    const int along = 20;
    const std::size_t count = dim == 2 ? along * along : along * along * along;
    set.id.resize(count);
    set.x.assign(dim, PaddedArray<double>(count));
    const auto zeros = [&](int number) {
      return std::vector<ParticleScalar>(number, ParticleScalar(set.precision, count));
    };
    set.v = zeros(dim), set.f = zeros(dim == 2 ? 5 : 9), set.tau = zeros(dim == 2 ? 4 : 6), set.history = zeros(1);
    for (std::size_t p = 0; p < count; ++p) {
      set.id[p] = static_cast<std::uint32_t>(p);
      std::size_t rest = p;
      for (int k = 0; k < dim; ++k, rest /= along) set.x[k][p] = (0.5 + static_cast<double>(rest % along)) * kCell;
    }
    EXPECT_FALSE(Sorter(1).sort(sets, fields));
    Grid& own = grid();
    for (int b = 0; b < own.blocks.size(); ++b) {
      for (int n = 0; n < own.layout.nodes_per_block(); ++n) own.mass.at(b, 0, n) = 1.0;
    }
  }
  Grid& grid() { return *fields.front(); }
  Vec3 place(int node) {
    const int per_block = grid().layout.nodes_per_block();
    return grid().layout.node_position(grid().blocks.block(node / per_block), node % per_block);
  }
  Fields fields;
  std::vector<ParticleSet> sets;
};

RigidBody body_of(std::unique_ptr<Surface> surface, const Vec3& position, Sides sides = Sides::one) {
  RigidBodyDefinition definition;
  definition.name = "tool";
  definition.surface = std::move(surface);
  definition.pose = {position, Quat::Identity()};
  definition.sides = sides;
  return RigidBody(definition);
}

struct Around {
  std::vector<PointNode> nodes;
  std::vector<double> before;  ///< weights without edges
  bool at_edge = false;

  double seen(Field& field, const std::function<double(const Vec3&)>& velocity) const {
    double sum = 0.0;
    for (const PointNode& node : nodes) sum += (node.reading + node.start) * velocity(field.place(node.node));
    return sum;
  }
};

void expect_no_edge(const Around& found) {
  EXPECT_FALSE(found.at_edge);
  ASSERT_EQ(found.before.size(), found.nodes.size());
  for (std::size_t n = 0; n < found.nodes.size(); ++n) {
    EXPECT_EQ(found.nodes[n].weight, found.before[n]);
    EXPECT_EQ(found.nodes[n].reading, found.before[n]);
  }
}

Around around(Field& field, const RigidBody& body, const Vec3& place, const Vec3& normal) {
  const std::vector<const RigidBody*> bodies = {&body};
  ContactPoint point;
  point.place = place;
  point.normal = normal;
  const MaterialNodes material(field.fields, 0);
  const PointWeights weights(material, ShapeKind::ugimp, place);
  Around result;
  for (int n = 0; n < weights.count; ++n) {
    const NodeRef ref = weights.node[n].ref;
    const int node = ref.block * field.grid().layout.nodes_per_block() + ref.node;
    result.nodes.push_back({0, node, weights.weight[n], weights.weight[n]});
    result.before.push_back(weights.weight[n]);
  }
  result.nodes.resize(2 * weights.count);
  const int dim = field.grid().layout.dim();
  const EdgeCover cover(bodies, dim == 2 ? GeometryKind::plane_strain : GeometryKind::solid,
                        field.grid().layout.smallest_cell());
  const EdgeCover::Nodes kept = cover.apply(point, material, result.nodes.data(), weights.count);
  result.at_edge = kept.at_edge;
  result.nodes.resize(kept.count);
  return result;
}

/// A blade whose front is the plane x = 0.63 and whose edge lies at this height.
RigidBody blade(double edge) { return body_of(make_box({0.5, kInfinite, 2.0}), {0.63 - 0.25, 0.0, edge + 1.0}); }

TEST(EdgeCover, AwayFromEdgesNothingChanges) {
  Field field(2);
  expect_no_edge(around(field, blade(0.5), {0.63, 0.0, 0.87}, Vec3::UnitX()));
}

/// Part of a hat function that lies on the positive side of a plane, at this many cells in front of which its node
/// lies.
double hat_beyond(double cells) {
  const double c = std::clamp(cells, -1.0, 1.0);
  return c < 0.0 ? 0.5 * (1.0 + c) * (1.0 + c) : 1.0 - 0.5 * (1.0 - c) * (1.0 - c);
}

// Material before the face moves with one velocity, that below the edge with another, and a node's velocity is the
// mean by its hat function, which is what a grid sees of two rigid halves. The point sees the upper velocity,
// wherever the edge and the point lie between the nodes. Soil behind the plane of the face carries what acts on the
// nodes below, so that an impulse is spread as the velocity is seen, and no energy is lost.
TEST(EdgeCover, APointSeesWhatIsBeforeItsFace) {
  Field field(2);
  for (const double edge : {0.5, 0.513, 0.54, 0.55, 0.567, 0.599}) {
    const RigidBody body = blade(edge);
    const auto velocity = [&](const Vec3& place) {
      const double above = hat_beyond((place.z() - edge) / kCell + kFurther);
      const double front = hat_beyond((place.x() - 0.63) / kCell);
      return (above * front * 3.0 - (1.0 - above) * 7.0) / (above * front + 1.0 - above);
    };
    for (const double above : {0.01, 0.04, 0.08, 0.13}) {
      const Around found = around(field, body, {0.63, 0.0, edge + above}, Vec3::UnitX());
      EXPECT_NEAR(found.seen(field, velocity), 3.0, kSeen) << edge << ' ' << above;
      double whole = 0.0;
      for (const PointNode& node : found.nodes) {
        whole += node.weight;
        EXPECT_NEAR(node.weight, node.reading, 1e-14);
      }
      EXPECT_NEAR(whole, 1.0, 1e-12);  // momentum
    }
  }
}

// A tool whose two sides have a field each acts where its edge lies.
TEST(EdgeCover, AToolThatDividesTheFieldActsWhereItLies) {
  Field field(2);
  const double edge = 0.54;
  const RigidBody body = body_of(make_box({0.1, kInfinite, 2.0}), {0.58, 0.0, edge + 1.0}, Sides::automatic);
  const auto velocity = [&](const Vec3& place) {
    const double above = hat_beyond((place.z() - edge) / kCell);
    const double front = hat_beyond((place.x() - 0.63) / kCell);
    return (above * front * 3.0 - (1.0 - above) * 7.0) / (above * front + 1.0 - above);
  };
  EXPECT_NEAR(around(field, body, {0.63, 0.0, edge + 0.04}, Vec3::UnitX()).seen(field, velocity), 3.0, kSeen);
}

// Effect of an impulse at one point on the velocity at another is the same the other way round, whatever the nodes
// weigh, and no impulses gain energy: the sweeps over points then converge. Less than a hundredth is left where a
// node further out has a small part before the face itself, and the soil behind the plane is thin.
TEST(EdgeCover, PointsAnswerEachOtherSymmetrically) {
  Field field(2);
  const auto mass = [&](int node) {
    const int per_block = field.grid().layout.nodes_per_block();
    return field.grid().mass.at(node / per_block, 0, node % per_block);
  };
  const std::vector<double> heights = {0.01, 0.03, 0.06, 0.11, 0.17};
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    for (int b = 0; b < field.grid().blocks.size(); ++b) {
      for (int n = 0; n < field.grid().layout.nodes_per_block(); ++n) {
        field.grid().mass.at(b, 0, n) = std::exp(std::uniform_real_distribution<>(-6.0, 0.0)(random));
      }
    }
    for (const double edge : {0.5, 0.52, 0.567}) {
      SCOPED_TRACE(testing::Message() << seed << ' ' << edge);
      const RigidBody body = blade(edge);
      Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(heights.size(), heights.size());
      for (std::size_t one = 0; one < heights.size(); ++one) {
        const Around reads = around(field, body, {0.63, 0.0, edge + heights[one]}, Vec3::UnitX());
        for (std::size_t other = 0; other < heights.size(); ++other) {
          const Around pushes = around(field, body, {0.63, 0.0, edge + heights[other]}, Vec3::UnitX());
          for (const PointNode& read : reads.nodes) {
            for (const PointNode& pushed : pushes.nodes) {
              if (read.node == pushed.node) answers(one, other) += read.reading * pushed.weight / mass(read.node);
            }
          }
        }
      }
      const double scale = answers.cwiseAbs().maxCoeff();
      EXPECT_LT((answers - answers.transpose()).cwiseAbs().maxCoeff(), 1e-2 * scale);
      EXPECT_GT(answers.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-2 * scale);
    }
  }
}

// The face of a footing on the ground, whose surface is the plane of the face: nothing is behind it beside the footing,
// so nothing is pulled there, and each node gets the part that is covered.
TEST(EdgeCover, NothingPullsAtAFreeSurface) {
  Field field(2);
  const double ground = 1.0, edge = 0.73;
  for (int b = 0; b < field.grid().blocks.size(); ++b) {
    for (int n = 0; n < field.grid().layout.nodes_per_block(); ++n) {
      const Vec3 place = field.grid().layout.node_position(field.grid().blocks.block(b), n);
      if (place.z() > ground + 0.01) field.grid().mass.at(b, 0, n) = 0.0;
    }
  }
  const RigidBody body = body_of(make_box({2.0 * edge, kInfinite, 0.5}), {0.0, 0.0, ground + 0.25});
  const auto velocity = [&](const Vec3& place) {
    const double part = hat_beyond((edge - place.x()) / kCell + kFurther);
    return -3.0 * part + (1.0 - part) * 7.0;
  };
  const Around found = around(field, body, {edge - 0.01, 0.0, ground}, -Vec3::UnitZ());
  EXPECT_TRUE(found.at_edge);
  EXPECT_NEAR(found.seen(field, velocity), -3.0, kSeen);
  double whole = 0.0;
  for (const PointNode& node : found.nodes) {
    const double inside = (edge - field.place(node.node).x()) / kCell + kFurther;
    const double part = hat_beyond(inside), of_further = hat_beyond(inside - 1.0);
    EXPECT_NEAR(node.weight, node.reading * (part - of_further) / (1.0 - of_further), 1e-6);
    whole += node.weight;
  }
  EXPECT_NEAR(whole, 1.0, 1e-12);
}

// Cells twice as high as wide, with an edge below and one above.
TEST(EdgeCover, OnCellsThatAreNotCubesToo) {
  Field field(2, {kCell, kCell, 2.0 * kCell});
  for (const double sense : {1.0, -1.0}) {
    for (const double edge : {0.8, 0.87, 0.9, 0.96}) {
      const RigidBody body = body_of(make_box({0.5, kInfinite, 0.9}), {0.63 - 0.25, 0.0, edge + sense * 0.45});
      const auto velocity = [&](const Vec3& place) {
        const double above = hat_beyond(sense * (place.z() - edge) / (2.0 * kCell) + kFurther);
        const double front = hat_beyond((place.x() - 0.63) / kCell);
        return (above * front * 3.0 - (1.0 - above) * 7.0) / (above * front + 1.0 - above);
      };
      const Around found = around(field, body, {0.63, 0.0, edge + sense * 0.06}, Vec3::UnitX());
      EXPECT_NEAR(found.seen(field, velocity), 3.0, kSeen) << sense << ' ' << edge;
    }
  }
}

TEST(EdgeCover, AnEdgeOnWhichMaterialEndsIsNone) {
  Field field(2);
  const RigidBody body = blade(0.5);
  for (int b = 0; b < field.grid().blocks.size(); ++b) {
    for (int n = 0; n < field.grid().layout.nodes_per_block(); ++n) {
      const Vec3 place = field.grid().layout.node_position(field.grid().blocks.block(b), n);
      if (place.z() < 0.45) field.grid().mass.at(b, 0, n) = 0.0;
    }
  }
  const Around found = around(field, body, {0.63, 0.0, 0.51}, Vec3::UnitX());
  ASSERT_EQ(found.before.size(), found.nodes.size());
  for (std::size_t n = 0; n < found.nodes.size(); ++n) EXPECT_NEAR(found.nodes[n].weight, found.before[n], 1e-14);
}

// Nodes 0.85 cells above the edge are covered just wholly. Whether a point is at an edge decides on the overlap
// that it keeps.
TEST(EdgeCover, RoundOffDecidesNothingWhereNodesAreJustCovered) {
  Field field(2);
  for (const double off : {-1e-14, -1e-16, 0.0, 1e-16, 1e-14}) {
    SCOPED_TRACE(off);
    expect_no_edge(around(field, blade(0.5 + kFurther * kCell + off), {0.63, 0.0, 0.65}, Vec3::UnitX()));
  }
  EXPECT_TRUE(around(field, blade(0.5 + kFurther * kCell + 2e-3), {0.63, 0.0, 0.65}, Vec3::UnitX()).at_edge);
}

TEST(EdgeCover, APointBeyondAnEdgeIsNoContact) {
  Field field(2);
  const RigidBody body = blade(0.5);
  EXPECT_TRUE(around(field, body, {0.63, 0.0, 0.38}, Vec3::UnitX()).nodes.empty());
}

// A cylinder of one cell and a half in radius, and a face that goes on at 45 degrees.
TEST(EdgeCover, ARoundSurfaceAndABendAreNoEdges) {
  Field field(2);
  const RigidBody round = body_of(make_cylinder(1.5 * kCell, kInfinite, 1), {0.9, 0.0, 0.9});
  const RigidBody bent =
      body_of(make_polygon({{0.0, 0.0}, {0.63, 0.0}, {0.63, -0.4}, {0.33, -0.7}, {0.0, -0.7}}), {0.0, 0.0, 1.4});
  for (const Around& found : {around(field, round, {0.9 + 1.5 * kCell, 0.0, 0.9}, Vec3::UnitX()),
                              around(field, bent, {0.63, 0.0, 1.02}, Vec3::UnitX())}) {
    ASSERT_FALSE(found.nodes.empty());
    expect_no_edge(found);
  }
}

// A box in space, near one edge, and near a corner, where two edges meet: nodes lie beyond either.
TEST(EdgeCover, InSpaceToo) {
  Field field(3);
  const RigidBody body = body_of(make_box({0.5, 1.0, 1.0}), {0.38, 1.03, 1.04});  // edges at y = 0.53, z = 0.54
  const auto velocity = [&](const Vec3& place) {
    const double above = hat_beyond((place.z() - 0.54) / kCell + kFurther);
    const double front = hat_beyond((place.x() - 0.63) / kCell);
    return (above * front * 3.0 - (1.0 - above) * 7.0) / (above * front + 1.0 - above);
  };
  const Around edge = around(field, body, {0.63, 1.02, 0.57}, Vec3::UnitX());
  EXPECT_NEAR(edge.seen(field, velocity), 3.0, kSeen);
  const Around corner = around(field, body, {0.63, 0.55, 0.56}, Vec3::UnitX());
  bool beside = false, below = false;
  for (const PointNode& node : corner.nodes) {
    if (node.reading >= 0.0) continue;
    beside = beside || field.place(node.node).y() < 0.53 - 0.4 * kCell;
    below = below || field.place(node.node).z() < 0.54 - 0.4 * kCell;
  }
  EXPECT_TRUE(beside);
  EXPECT_TRUE(below);
}

}  // namespace edge_cover_test
}  // namespace mpm
