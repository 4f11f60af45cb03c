// Tractions on faces of particle domains: areas and weights against the quadrature of the reference values, directions,
// and sums over closed domains (Nairn & Guilkey (2015) eq. (40)-(55); method reference 4.1 to 4.4).
#include "mpm/shape/traction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/math/constants.hpp"
#include "shape_check.hpp"

namespace mpm {
namespace traction_test {

using test::table_rows;

constexpr double kTwoPi = 2.0 * mpm::kPi;
constexpr double kTolerance = 1e-12;  // as method reference 13 suggests; values are of order 1 to 50

// The papers' edges 1, 2, 3, 4.
constexpr std::array<DomainFace, 4> kEdges = {{{1, false}, {0, true}, {1, true}, {0, false}}};

double hat(double cells) { return std::max(0.0, 1.0 - std::abs(cells)); }

double relative(double expected) { return kTolerance * std::max(1.0, std::abs(expected)); }

TEST(TractionWeights, OfEdgesAreTheReferenceValues) {
  const auto rows = table_rows("traction_edges.csv");
  ASSERT_EQ(rows.size(), 240u);  // 64, 98 and 78 rows of the three tables
  int truncated = 0, shrunk = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double>& v = rows[i];
    ASSERT_EQ(v.size(), 17u) << i;
    const bool ring = v[0] > 0.0, box = v[0] > 1.0;
    PlacedDomain domain;
    domain.dim = 2;
    for (int k = 0; k < 2; ++k) {
      domain.center[k] = v[4 + 4 * k];
      for (int c = 0; c < 2; ++c) domain.d[k][c] = v[10 + 2 * c + k] * 0.5 * v[3 + 4 * k] * v[2 + 4 * k];
    }
    const PlacedDomain given = domain;
    if (box) truncate_at_axis(domain);
    if (ring && !box) shrink_to_axis(domain);
    truncated += box && domain.center[0] != given.center[0];
    shrunk += domain.d[1][1] != given.d[1][1];
    const GeometryKind geometry = ring ? GeometryKind::axisymmetric : GeometryKind::plane_strain;
    const FaceParts parts = face_parts(geometry, domain, kEdges[static_cast<int>(v[1]) - 1], 1.0);
    const double scale = ring ? 1.0 / kTwoPi : 1.0;
    ASSERT_EQ(parts.corners, 2);
    double weight = 0.0;
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(scale * parts.corner[a].area, v[14 + a], relative(v[14 + a])) << "row " << i << ", corner " << a;
      double n = scale * parts.corner[a].area;
      for (int k = 0; k < 2; ++k) n *= hat((parts.corner[a].at[k] - v[5 + 4 * k]) / v[2 + 4 * k]);
      weight += n;
    }
    EXPECT_NEAR(weight, v[16], relative(v[16])) << "row " << i;
    EXPECT_NEAR(scale * parts.area, v[14] + v[15], relative(v[14] + v[15])) << "row " << i;
  }
  EXPECT_EQ(truncated, 14);
  EXPECT_EQ(shrunk, 16);
}

TEST(TractionWeights, OfFacesInASolidAreTheReferenceValues) {
  const auto rows = table_rows("traction_faces.csv");
  ASSERT_EQ(rows.size(), 24u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double>& v = rows[i];
    ASSERT_EQ(v.size(), 26u) << i;
    PlacedDomain domain;
    domain.dim = 3;
    for (int k = 0; k < 3; ++k) {
      domain.center[k] = v[6 + 4 * k];
      for (int c = 0; c < 3; ++c) domain.d[k][c] = v[16 + 3 * c + k] * 0.5 * v[5 + 4 * k] * v[4 + 4 * k];
    }
    const DomainFace face{static_cast<int>(std::abs(v[0])) - 1, v[0] > 0.0};
    const FaceParts parts = face_parts(GeometryKind::solid, domain, face, 1.0);
    ASSERT_EQ(parts.corners, 4);
    int corner = 0;  // index among the face's corners, in which the side along the lowest axis changes fastest
    for (int k = 0, bit = 1; k < 3; ++k) {
      if (k == face.axis) continue;
      corner += v[1 + k] > 0.0 ? bit : 0;
      bit *= 2;
    }
    EXPECT_NEAR(parts.corner[corner].area, v[25], relative(v[25])) << "row " << i;
    EXPECT_NEAR(parts.area, 4.0 * v[25], relative(v[25])) << "row " << i;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(parts.corner[corner].at[k], v[7 + 4 * k], relative(v[7 + 4 * k])) << "row " << i;
    }
  }
}

// The end of a line has the area across it, at the end of the half vector.
TEST(TractionWeights, OfAnEnd) {
  PlacedDomain domain;
  domain.dim = 1;
  domain.center[0] = 2.0;
  domain.d[0][0] = 0.3;
  const FaceParts upper = face_parts(GeometryKind::line, domain, {0, true}, 7.0);
  const FaceParts lower = face_parts(GeometryKind::line, domain, {0, false}, 7.0);
  ASSERT_EQ(upper.corners, 1);
  EXPECT_EQ(upper.corner[0].area, 7.0);
  EXPECT_EQ(upper.area, 7.0);
  EXPECT_EQ(upper.corner[0].at[0], 2.3);
  EXPECT_EQ(lower.corner[0].at[0], 1.7);
  EXPECT_EQ(upper.outward[0], 1.0);
  EXPECT_EQ(lower.outward[0], -1.0);
}

template <int Dim>
PlacedDomain random_domain(std::mt19937& engine) {
  const auto place = test::random_place<Dim>(engine);
  double d[Dim][Dim];
  place.domain(d);
  PlacedDomain domain;
  domain.dim = Dim;
  for (int k = 0; k < Dim; ++k) {
    domain.center[k] = place.x[k];
    for (int c = 0; c < Dim; ++c) domain.d[k][c] = d[k][c];
  }
  return domain;
}

struct Closed {
  PlacedDomain::Vector normal{};  ///< sum over all faces of area times outward normal
  double volume = 0.0;            ///< sum of area times normal times middle, divided by the number of axes (Gauss)
};

template <int Dim>
Closed all_faces(GeometryKind geometry, const PlacedDomain& domain) {
  Closed sum;
  for (int axis = 0; axis < Dim; ++axis) {
    for (const bool upper : {false, true}) {
      const FaceParts parts = face_parts(geometry, domain, {axis, upper}, 1.0);
      double corners = 0.0, length = 0.0;
      for (int a = 0; a < parts.corners; ++a) corners += parts.corner[a].area;
      EXPECT_NEAR(corners, parts.area, 1e-14 * parts.area);
      for (int c = 0; c < Dim; ++c) {
        sum.normal[c] += parts.area * parts.outward[c];
        sum.volume += parts.area * parts.outward[c] * (parts.middle[c] - domain.center[c]) / Dim;
        length += parts.outward[c] * parts.outward[c];
      }
      EXPECT_NEAR(length, 1.0, 1e-14);
      for (int t = 0; t < Dim - 1; ++t) {
        double across = 0.0;
        for (int c = 0; c < Dim; ++c) across += parts.outward[c] * parts.along[t][c];
        EXPECT_NEAR(across, 0.0, 1e-14);  // both are unit vectors
      }
    }
  }
  return sum;
}

// Outward normals times areas of a closed domain sum to zero, and times the positions of the faces to its volume. In
// axisymmetry they sum to 2 pi A_p along r, which the hoop stress balances.
TEST(TractionNormals, CloseTheDomain) {
  std::mt19937 engine(7);
  for (int i = 0; i < 50; ++i) {
    const PlacedDomain plane = random_domain<2>(engine), solid = random_domain<3>(engine);
    const auto& p = plane.d;
    const double area = 4.0 * (p[0][0] * p[1][1] - p[0][1] * p[1][0]);
    const Closed flat = all_faces<2>(GeometryKind::plane_strain, plane);
    EXPECT_NEAR(flat.normal[0], 0.0, 1e-14);
    EXPECT_NEAR(flat.normal[1], 0.0, 1e-14);
    EXPECT_NEAR(flat.volume, area, 1e-13 * area);

    PlacedDomain ring = plane;
    ring.center[0] = 3.0;  // off the axis
    const Closed round = all_faces<2>(GeometryKind::axisymmetric, ring);
    EXPECT_NEAR(round.normal[0], kTwoPi * area, 1e-13 * kTwoPi * 3.0);
    EXPECT_NEAR(round.normal[1], 0.0, 1e-13 * kTwoPi * 3.0);

    const auto normal = traction::cross(solid.d[1], solid.d[2]);
    double volume = 0.0;
    for (int c = 0; c < 3; ++c) volume += 8.0 * solid.d[0][c] * normal[c];
    const Closed full = all_faces<3>(GeometryKind::solid, solid);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(full.normal[c], 0.0, 1e-14);
    EXPECT_NEAR(full.volume, volume, 1e-13 * volume);
  }
}

}  // namespace traction_test
}  // namespace mpm
