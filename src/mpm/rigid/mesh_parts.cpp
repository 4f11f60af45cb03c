// Division of a mesh into parts that are bodies, holes in them, and groups of both, with the sign of one distance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "mpm/rigid/mesh_topology.hpp"
#include "signed_mesh.hpp"

namespace mpm {

namespace {

constexpr int kMostParts = 10'000;  ///< their boxes are compared in pairs
constexpr double kTouch = 1e-9;     ///< part of the mesh's size: rounding of coordinates that are meant to be equal

struct Part {
  int number = 0;
  double volume = 0.0;
  Box bounds;
  Vec3 place = Vec3::Zero();        ///< on its surface, to be named in errors
  std::vector<int> holes;           ///< holes of a body, among holes
  std::unique_ptr<SignedMesh> own;  ///< mesh of its own if it was asked for
};

/// Makes meshes of some parts, at a cost of their own triangles.
class PartPicker {
 public:
  explicit PartPicker(const SolidMesh& solid)
      : solid_(solid),
        triangles_(static_cast<std::size_t>(solid.parts)),
        new_vertex_(solid.mesh.vertices.size(), -1),
        new_triangle_(solid.part.size(), -1) {
    for (std::size_t t = 0; t < solid.part.size(); ++t) triangles_[solid.part[t]].push_back(static_cast<int>(t));
  }

  SolidMesh pick(const std::vector<int>& parts) {
    SolidMesh result;
    std::vector<int> chosen;
    std::map<int, int> new_part;
    for (const int part : parts) {
      chosen.insert(chosen.end(), triangles_[part].begin(), triangles_[part].end());
      new_part.emplace(part, static_cast<int>(new_part.size()));
    }
    std::sort(chosen.begin(), chosen.end());
    std::vector<int> vertices;
    for (const int t : chosen) {
      std::array<int, 3> corners = solid_.mesh.triangles[t];
      for (int& v : corners) {
        if (new_vertex_[v] < 0) {
          new_vertex_[v] = static_cast<int>(vertices.size());
          vertices.push_back(v);
          result.mesh.vertices.push_back(solid_.mesh.vertices[v]);
        }
        v = new_vertex_[v];
      }
      new_triangle_[t] = static_cast<int>(result.mesh.triangles.size());
      result.mesh.triangles.push_back(corners);
      result.part.push_back(new_part[solid_.part[t]]);
    }
    for (const int t : chosen) {
      for (int e = 0; e < 3; ++e) {
        const int mate = solid_.mate[static_cast<std::size_t>(3 * t + e)];
        result.mate.push_back(3 * new_triangle_[mate / 3] + mate % 3);
      }
    }
    for (const int v : vertices) new_vertex_[v] = -1;
    result.parts = static_cast<int>(parts.size());
    return result;
  }

 private:
  const SolidMesh& solid_;
  std::vector<std::vector<int>> triangles_;  ///< triangles of each part
  std::vector<int> new_vertex_, new_triangle_;
};

class Parts {
 public:
  explicit Parts(const SolidMesh& solid) : solid_(solid), picker_(solid) {
    if (solid.parts > kMostParts) {
      throw RigidError(fmt::format("mesh: it has {} parts that do not hang together, and {} at most may be; unite them",
                                   solid.parts, kMostParts));
    }
    std::vector<Part> all(static_cast<std::size_t>(solid.parts));
    for (std::size_t t = solid.part.size(); t-- > 0;) {
      const auto& [i, j, k] = solid.mesh.triangles[t];
      const Vec3 &a = solid.mesh.vertices[i], &b = solid.mesh.vertices[j], &c = solid.mesh.vertices[k];
      Part& part = all[solid.part[t]];
      for (const Vec3* corner : {&a, &b, &c}) part.bounds.add(*corner);
      part.place = (a + b + c) / 3.0;
    }
    for (std::size_t t = 0; t < solid.part.size(); ++t) {
      const auto& [i, j, k] = solid.mesh.triangles[t];
      Part& part = all[solid.part[t]];
      const Vec3 origin = part.bounds.center();
      const Vec3 a = solid.mesh.vertices[i] - origin, b = solid.mesh.vertices[j] - origin;
      part.volume += a.dot(b.cross(solid.mesh.vertices[k] - origin)) / 6.0;
    }
    vertices_.resize(all.size());
    std::vector<char> seen(solid.mesh.vertices.size(), 0);  // parts share no vertex
    for (std::size_t t = 0; t < solid.part.size(); ++t) {
      for (const int v : solid.mesh.triangles[t]) {
        if (seen[v] == 0) vertices_[solid.part[t]].push_back(v);
        seen[v] = 1;
      }
    }
    Box bounds;
    for (std::size_t p = 0; p < all.size(); ++p) {
      bounds.add(all[p].bounds.min);
      bounds.add(all[p].bounds.max);
      all[p].number = static_cast<int>(p);
      if (!(std::abs(all[p].volume) > 0.0)) fail(all[p], "encloses no volume; leave it out");
      (all[p].volume > 0.0 ? bodies_ : holes_).push_back(std::move(all[p]));
    }
    touch_ = kTouch * bounds.size().norm();
  }

  std::vector<SolidMesh> groups() {
    outlines_.resize(bodies_.size());
    for (std::size_t h = 0; h < holes_.size(); ++h) put_into_body(static_cast<int>(h));
    for (Part& body : bodies_) check_holes(body);
    for (Part& body : bodies_) check_not_inside(body);
    std::vector<std::vector<int>> groups;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto apart = [&](const std::vector<int>& group) {
        return std::none_of(group.begin(), group.end(), [&](int other) {
          return bodies_[other].bounds.grown(touch_).intersects(bodies_[b].bounds);
        });
      };
      const auto fitting = std::find_if(groups.begin(), groups.end(), apart);
      if (fitting == groups.end()) {
        groups.push_back({static_cast<int>(b)});
      } else {
        fitting->push_back(static_cast<int>(b));
      }
    }
    std::vector<SolidMesh> result;
    for (const std::vector<int>& group : groups) {
      std::vector<int> parts;
      for (const int b : group) {
        const std::vector<int> own = parts_of(bodies_[b]);
        parts.insert(parts.end(), own.begin(), own.end());
      }
      result.push_back(picker_.pick(parts));
    }
    return result;
  }

 private:
  [[noreturn]] static void fail(const Part& part, const std::string& what) {
    throw RigidError(
        fmt::format("mesh: the part at ({:g}, {:g}, {:g}) {}", part.place.x(), part.place.y(), part.place.z(), what));
  }

  /// Its number, and those of its holes.
  std::vector<int> parts_of(const Part& body) const {
    std::vector<int> parts = {body.number};
    for (const int hole : body.holes) parts.push_back(holes_[hole].number);
    return parts;
  }

  bool within_bounds(const Part& inner, const Box& outer) const {
    return outer.grown(touch_).contains(inner.bounds.min) && outer.grown(touch_).contains(inner.bounds.max);
  }

  /// A part's distance: that of its surface, and of those of its holes.
  const SignedMesh& distance_of(Part& part) {
    if (!part.own) part.own = std::make_unique<SignedMesh>(picker_.pick(parts_of(part)));
    return *part.own;
  }

  /// True if a vertex of the part lies outside of the surface.
  bool any_outside(const Part& part, const SignedMesh& surface) const {
    return std::any_of(vertices_[part.number].begin(), vertices_[part.number].end(),
                       [&](int v) { return surface.at(solid_.mesh.vertices[v]).distance > touch_; });
  }

  /// Finds the smallest body around a hole.
  void put_into_body(int number) {
    Part& hole = holes_[number];
    std::vector<int> around;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (within_bounds(hole, bodies_[b].bounds) && bodies_[b].volume > -hole.volume)
        around.push_back(static_cast<int>(b));
    }
    std::sort(around.begin(), around.end(), [&](int a, int b) { return bodies_[a].volume < bodies_[b].volume; });
    for (const int b : around) {
      std::unique_ptr<SignedMesh>& surface = outlines_[static_cast<std::size_t>(b)];
      if (!surface) surface = std::make_unique<SignedMesh>(picker_.pick({bodies_[b].number}));
      if (any_outside(hole, *surface)) continue;
      bodies_[b].holes.push_back(number);
      return;
    }
    fail(hole, "is turned inside out; turn its faces, or unite it with the part that it cuts");
  }

  void check_holes(const Part& body) {
    for (const int one : body.holes) {
      for (const int other : body.holes) {
        if (one == other || !holes_[one].bounds.intersects(holes_[other].bounds)) continue;
        // Outside of a hole's surface is in the hole: its faces look there.
        if (any_outside(holes_[one], distance_of(holes_[other])))
          fail(holes_[one], "is a hole that overlaps another one; unite the holes");
      }
    }
  }

  void check_not_inside(const Part& inner) {
    for (Part& outer : bodies_) {
      if (&outer == &inner || !within_bounds(inner, outer.bounds)) continue;
      if (any_outside(inner, distance_of(outer))) continue;
      fail(inner, "lies inside another part; leave it out, or unite the parts; if it is a hole, turn its faces");
    }
  }

  const SolidMesh& solid_;
  PartPicker picker_;
  std::vector<std::vector<int>> vertices_;  ///< vertices of each part
  std::vector<Part> bodies_, holes_;
  std::vector<std::unique_ptr<SignedMesh>> outlines_;  ///< outlines of bodies without their holes, if asked for
  double touch_ = 0.0;
};

}  // namespace

std::vector<SolidMesh> disjoint_groups(SolidMesh solid) {
  if (solid.parts > 1) return Parts(solid).groups();
  std::vector<SolidMesh> whole;
  whole.push_back(std::move(solid));
  return whole;
}

}  // namespace mpm
