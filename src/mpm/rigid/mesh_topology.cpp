// Checks on a triangle mesh before it serves as a rigid body.
#include "mpm/rigid/mesh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "mpm/math/constants.hpp"

namespace mpm {

namespace {

using Edge = std::pair<int, int>;

std::string place_of(const Vec3& point) {
  std::ostringstream text;
  text << "(" << point.x() << ", " << point.y() << ", " << point.z() << ")";
  return text.str();
}

std::string place_of(const TriangleMesh& mesh, const Edge& edge) {
  return place_of(mesh.vertices[edge.first]) + " to " + place_of(mesh.vertices[edge.second]);
}

void check_numbers(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw RigidError("mesh: it has no triangles");
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) {
      throw RigidError("mesh: vertex " + std::to_string(v) + " is not finite: " + place_of(mesh.vertices[v]));
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) {
      if (v < 0 || v >= count) {
        throw RigidError("mesh: triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                         ", but there are " + std::to_string(count));
      }
    }
  }
}

/// A triangle that repeats a vertex has edges a-b and b-a only: its neighbours close without it. One whose three
/// corners lie on a line cannot go without opening the mesh, and has no normal to stay.
std::vector<std::array<int, 3>> with_area(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    if (i == j || j == k || k == i) continue;
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    // 1e-12: a height a million million times smaller than the side is rounding, not shape.
    if (!((b - a).cross(c - a).norm() > 1e-12 * longest)) {
      throw RigidError("mesh: triangle " + std::to_string(t) + " at " + place_of(a) +
                       " has no area; repair the mesh (merge vertices, remove degenerate faces)");
    }
    kept.push_back(mesh.triangles[t]);
  }
  if (kept.empty()) throw RigidError("mesh: no triangle has an area");
  return kept;
}

/// The triangle on the left of each directed edge. @throws RigidError unless each edge and its opposite occur once.
std::map<Edge, int> paired_edges(const TriangleMesh& mesh) {
  std::map<Edge, int> owner;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int e = 0; e < 3; ++e) {
      const Edge edge{mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]};
      if (!owner.emplace(edge, static_cast<int>(t)).second) {
        throw RigidError("mesh: not consistently oriented: the edge " + place_of(mesh, edge) +
                         " is used twice in one direction; turn the faces alike, and join no more than two at an edge");
      }
    }
  }
  std::size_t open = 0;
  Edge first;
  for (const auto& [edge, triangle] : owner) {
    if (owner.count({edge.second, edge.first}) != 0) continue;
    if (open++ == 0) first = edge;
  }
  if (open > 0) {
    throw RigidError("mesh: not closed: " + std::to_string(open) +
                     " edges have a triangle on one side only, the first from " + place_of(mesh, first) +
                     "; fill the holes and merge vertices");
  }
  return owner;
}

/// The connected part that each triangle belongs to, numbered from 0.
std::vector<int> parts_of(const TriangleMesh& mesh, const std::map<Edge, int>& owner) {
  std::vector<int> part(mesh.triangles.size(), -1);
  int count = 0;
  std::vector<int> todo;
  for (std::size_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] >= 0) continue;
    todo.push_back(static_cast<int>(seed));
    part[seed] = count;
    while (!todo.empty()) {
      const int t = todo.back();
      todo.pop_back();
      for (int e = 0; e < 3; ++e) {
        const int next = owner.at({mesh.triangles[t][(e + 1) % 3], mesh.triangles[t][e]});
        if (part[next] >= 0) continue;
        part[next] = count;
        todo.push_back(next);
      }
    }
    ++count;
  }
  return part;
}

/// Solid angle of triangle abc seen from the origin, signed: Van Oosterom & Strackee (1983) eq. (8).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// Outer parts must lie outside of all others, inward-turned ones inside another.
void check_parts(const TriangleMesh& mesh, const std::vector<int>& part) {
  const int count = 1 + *std::max_element(part.begin(), part.end());
  if (count == 1) return;
  std::vector<double> volume(count, 0.0);
  std::vector<Vec3> sample(count);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    volume[part[t]] += a.dot(b.cross(c)) / 6.0;
    sample[part[t]] = (a + b + c) / 3.0;
  }
  for (int p = 0; p < count; ++p) {
    double turns = 0.0;  // how often the other parts wind around this one's sample point
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (part[t] == p) continue;
      const auto& [i, j, k] = mesh.triangles[t];
      turns += solid_angle(mesh.vertices[i] - sample[p], mesh.vertices[j] - sample[p], mesh.vertices[k] - sample[p]) /
               (4.0 * kPi);
    }
    // Whole numbers, but one half where parts touch: the quarters decide.
    if (volume[p] > 0.0 && turns > 0.75) {
      throw RigidError("mesh: the part at " + place_of(sample[p]) + " lies inside another part; unite the parts");
    }
    if (volume[p] < 0.0 && turns < 0.25) {
      throw RigidError("mesh: the part at " + place_of(sample[p]) + " is turned inside out; turn its faces");
    }
  }
}

}  // namespace

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
  struct Less {
    bool operator()(const Vec3& a, const Vec3& b) const {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    }
  };
  std::map<Vec3, int, Less> index;
  TriangleMesh joined;
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (int c = 0; c < 3; ++c) {
      const Vec3& vertex = mesh.vertices[triangle[c]];
      const auto [place, added] = index.emplace(vertex, static_cast<int>(joined.vertices.size()));
      if (added) joined.vertices.push_back(vertex);
      corners[c] = place->second;
    }
    joined.triangles.push_back(corners);
  }
  return joined;
}

TriangleMesh solid_mesh(const TriangleMesh& mesh) {
  check_numbers(mesh);
  TriangleMesh solid{mesh.vertices, with_area(mesh)};
  const std::vector<int> part = parts_of(solid, paired_edges(solid));
  const double volume = signed_volume(solid);
  if (volume < 0.0) {
    for (auto& triangle : solid.triangles) std::swap(triangle[1], triangle[2]);
  } else if (!(volume > 0.0)) {
    throw RigidError("mesh: it encloses no volume");
  }
  check_parts(solid, part);
  return solid;
}

}  // namespace mpm
