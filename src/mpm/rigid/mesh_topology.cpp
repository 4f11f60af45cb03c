// Checks on a triangle mesh before it serves as a rigid body.
#include "mpm/rigid/mesh_topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "mpm/math/constants.hpp"

namespace mpm {

namespace {

constexpr std::size_t kMostTriangles = 2'000'000;
constexpr double kSameAngle = 1e-9;  ///< [rad] between triangles at an edge that lie on each other

std::string place_of(const Vec3& point) { return fmt::format("({:g}, {:g}, {:g})", point.x(), point.y(), point.z()); }

void check_numbers(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw RigidError("mesh: it has no triangles");
  check_triangle_count(mesh.triangles.size());
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite())
      throw RigidError(fmt::format("mesh: vertex {} is not finite: {}", v, place_of(mesh.vertices[v])));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) {
      if (v < 0 || v >= count)
        throw RigidError(fmt::format("mesh: triangle {} names vertex {}, but there are {}", t, v, count));
    }
  }
}

/// A triangle that repeats a vertex has edges a-b and b-a only: its neighbours close without it. One whose three
/// corners lie on a line cannot go without opening the mesh, and has no normal to stay.
std::vector<std::array<int, 3>> with_area(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> kept;
  kept.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    if (i == j || j == k || k == i) continue;
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    // 1e-12: a height a million million times smaller than the side is rounding, not shape.
    if (!((b - a).cross(c - a).norm() > 1e-12 * longest)) {
      throw RigidError(
          fmt::format("mesh: triangle {} at {} has no area; repair the mesh (merge vertices, remove degenerate faces)",
                      t, place_of(a)));
    }
    kept.push_back(mesh.triangles[t]);
  }
  if (kept.empty()) throw RigidError("mesh: no triangle has an area");
  return kept;
}

/// A side of a triangle, and the edge that it lies on.
struct Side {
  std::uint64_t edge;  ///< its two vertices, the lower one first
  int number;
  bool forward;  ///< from the lower vertex to the higher one
};

/// Finds each side's mate.
class SidePairs {
 public:
  explicit SidePairs(const TriangleMesh& mesh) : mesh_(mesh) {}

  std::vector<int> find() {
    std::vector<Side> sides;
    sides.reserve(3 * mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int e = 0; e < 3; ++e) {
        const auto from = static_cast<std::uint32_t>(mesh_.triangles[t][e]);
        const auto to = static_cast<std::uint32_t>(mesh_.triangles[t][(e + 1) % 3]);
        const std::uint64_t edge = std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
        sides.push_back({edge, static_cast<int>(3 * t) + e, from < to});
      }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.number < b.number; });
    mate_.assign(sides.size(), -1);
    for (auto first = sides.begin(); first != sides.end();) {
      const auto last = std::find_if(first, sides.end(), [&](const Side& side) { return side.edge != first->edge; });
      pair(&*first, static_cast<std::size_t>(last - first));
      first = last;
    }
    if (open_ > 0) {
      throw RigidError(
          fmt::format("mesh: not closed: {} edges have a triangle on one side only, the first from {}; fill the holes "
                      "and merge vertices",
                      open_, place_of_side(first_open_)));
    }
    return std::move(mate_);
  }

 private:
  /// Pairs the sides at one edge.
  void pair(Side* sides, std::size_t count) {
    const auto forward =
        static_cast<std::size_t>(std::count_if(sides, sides + count, [](const Side& side) { return side.forward; }));
    if (2 * forward == count) {
      if (count > 2) sort_around(sides, count);
      match(sides, count);
      return;
    }
    if (forward > 1 || count - forward > 1) {
      const bool twice_forward = forward > 1;
      const Side* twice =
          std::find_if(sides, sides + count, [&](const Side& side) { return side.forward == twice_forward; });
      throw RigidError(fmt::format(
          "mesh: not consistently oriented: the edge {} is used twice in one direction; turn the faces alike, and join "
          "no more than two at an edge",
          place_of_side(twice->number)));
    }
    if (open_++ == 0) first_open_ = sides->number;
  }

  /// By their angle about the edge, the low vertex below. Seen so, material lies at smaller angles than a forward
  /// side's triangle, and at larger ones than a backward side's.
  void sort_around(Side* sides, std::size_t count) const {
    const Vec3& low = mesh_.vertices[static_cast<std::size_t>(sides->edge >> 32)];
    const Vec3& high = mesh_.vertices[static_cast<std::size_t>(sides->edge & 0xffffffffU)];
    const Vec3 along = (high - low).normalized();
    const auto arm = [&](const Side& side) {
      const Vec3 third = mesh_.vertices[mesh_.triangles[side.number / 3][(side.number % 3 + 2) % 3]] - low;
      return Vec3(third - third.dot(along) * along);
    };
    const Vec3 first = arm(*sides).normalized(), across = along.cross(first);
    std::vector<std::pair<double, Side>> turned;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 out = arm(sides[i]);
      double angle = std::atan2(out.dot(across), out.dot(first));
      if (angle < -kSameAngle) angle += 2.0 * kPi;
      turned.emplace_back(angle, sides[i]);
    }
    std::sort(turned.begin(), turned.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    // Material behind one triangle ends before that of the next begins, where they lie on each other.
    for (auto begin = turned.begin(); begin != turned.end();) {
      auto end = begin + 1;
      while (end != turned.end() && end->first - (end - 1)->first < kSameAngle) ++end;
      std::stable_partition(begin, end, [](const auto& one) { return one.second.forward; });
      begin = end;
    }
    for (std::size_t i = 0; i < count; ++i) sides[i] = turned[i].second;
  }

  /// Going round, each backward side with the forward one that closes it.
  void match(const Side* sides, std::size_t count) {
    std::vector<int> open;
    for (std::size_t i = 0; i < 2 * count; ++i) {  // twice round, since the first ones can close what begins last
      const Side& side = sides[i % count];
      if (mate_[side.number] >= 0) continue;
      if (!side.forward) {
        if (i < count) open.push_back(side.number);
      } else if (!open.empty()) {
        mate_[side.number] = open.back();
        mate_[open.back()] = side.number;
        open.pop_back();
      }
    }
  }

  std::string place_of_side(int side) const {
    const auto& triangle = mesh_.triangles[static_cast<std::size_t>(side / 3)];
    return place_of(mesh_.vertices[triangle[side % 3]]) + " to " + place_of(mesh_.vertices[triangle[(side + 1) % 3]]);
  }

  const TriangleMesh& mesh_;
  std::vector<int> mate_;
  std::size_t open_ = 0;
  int first_open_ = -1;
};

/// Numbers the connected parts.
void find_parts(SolidMesh& solid) {
  solid.part.assign(solid.mesh.triangles.size(), -1);
  std::vector<int> todo;
  for (std::size_t seed = 0; seed < solid.part.size(); ++seed) {
    if (solid.part[seed] >= 0) continue;
    todo.push_back(static_cast<int>(seed));
    solid.part[seed] = solid.parts;
    while (!todo.empty()) {
      const int t = todo.back();
      todo.pop_back();
      for (int e = 0; e < 3; ++e) {
        const int next = solid.mate[static_cast<std::size_t>(3 * t + e)] / 3;
        if (solid.part[next] >= 0) continue;
        solid.part[next] = solid.parts;
        todo.push_back(next);
      }
    }
    ++solid.parts;
  }
}

/// Gives each part vertices of its own.
void part_vertices(SolidMesh& solid) {
  std::vector<std::vector<int>> triangles_of(static_cast<std::size_t>(solid.parts));
  for (std::size_t t = 0; t < solid.part.size(); ++t) triangles_of[solid.part[t]].push_back(static_cast<int>(t));
  std::vector<int> number(solid.mesh.vertices.size(), -1), last_part(solid.mesh.vertices.size(), -1);
  std::vector<Vec3> vertices;
  for (int p = 0; p < solid.parts; ++p) {
    for (const int t : triangles_of[p]) {
      for (int& v : solid.mesh.triangles[t]) {
        if (last_part[v] != p) {
          last_part[v] = p;
          number[v] = static_cast<int>(vertices.size());
          vertices.push_back(solid.mesh.vertices[v]);
        }
        v = number[v];
      }
    }
  }
  solid.mesh.vertices = std::move(vertices);
}

/// Vertices by their coordinates, in a table of open addresses.
class VertexTable {
 public:
  explicit VertexTable(std::size_t most) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    slots_.assign(size, -1);
  }
  /// Its number among `vertices`, to which it is added if it is new.
  int number_of(const Vec3& vertex, std::vector<Vec3>& vertices) {
    std::size_t slot = hash(vertex) & (slots_.size() - 1);
    while (slots_[slot] >= 0) {
      if (vertices[static_cast<std::size_t>(slots_[slot])] == vertex) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<int>(vertices.size());
    vertices.push_back(vertex);
    return slots_[slot];
  }

 private:
  static std::size_t hash(const Vec3& vertex) {
    std::uint64_t mixed = 0;
    for (int k = 0; k < 3; ++k) {
      const double number = vertex[k] + 0.0;  // -0 is 0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      mixed = (mixed ^ bits) * 0x9E3779B97F4A7C15U;
      mixed ^= mixed >> 29;
    }
    return static_cast<std::size_t>(mixed ^ mixed >> 32);
  }

  std::vector<int> slots_;
};

}  // namespace

void check_triangle_count(std::size_t triangles) {
  if (triangles <= kMostTriangles) return;
  throw RigidError(fmt::format("mesh: more than {} triangles; make it coarser", kMostTriangles));
}

double signed_volume(const TriangleMesh& mesh) {
  // About a vertex, not the world's origin: no cancellation for a mesh drawn far from it.
  const Vec3 origin = mesh.vertices.empty() ? Vec3(Vec3::Zero()) : mesh.vertices.front();
  double volume = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    volume += (mesh.vertices[i] - origin).dot((mesh.vertices[j] - origin).cross(mesh.vertices[k] - origin)) / 6.0;
  }
  return volume;
}

TriangleMesh join_equal_vertices(const TriangleMesh& mesh) {
  check_numbers(mesh);
  VertexTable table(mesh.vertices.size());
  TriangleMesh joined;
  joined.triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (int c = 0; c < 3; ++c) corners[c] = table.number_of(mesh.vertices[triangle[c]], joined.vertices);
    joined.triangles.push_back(corners);
  }
  return joined;
}

SolidMesh solid_mesh(const TriangleMesh& mesh) {
  check_numbers(mesh);
  SolidMesh solid;
  solid.mesh = {mesh.vertices, with_area(mesh)};
  const double volume = signed_volume(solid.mesh);
  if (volume < 0.0) {
    for (auto& triangle : solid.mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  solid.mate = SidePairs(solid.mesh).find();
  if (!(std::abs(volume) > 0.0)) throw RigidError("mesh: it encloses no volume");
  find_parts(solid);
  if (solid.parts > 1) part_vertices(solid);
  return solid;
}

}  // namespace mpm
