#include "mpm/implicit/surface_samples.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <map>
#include <tuple>

#include "patch_samples.hpp"

namespace mpm {

namespace {

/// A piece of the outline in y = 0, the body on its right.
struct Piece {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero(), along = Vec3::Zero();
  int from_id = -1, to_id = -1;                      ///< ids of ends, equal at joints; -1 where the outline is cut off
  int before = -1, after = -1;                       ///< pieces that go on smoothly
  bool corner_before = false, corner_after = false;  ///< convex
  double depth = 0.0;  ///< that the surface may be away from the piece, for its neighbours turn [m]

  double length() const { return (to - from).norm(); }
  Vec3 normal() const { return along.cross(Vec3::UnitY()); }
};

/// Cuts the drawn surface at y = 0. Vertices there count as y > 0, so that edges in the plane are cut once.
std::vector<Piece> cut_outline(const Faces& faces, bool half) {
  Box bounds;
  for (const Vec3& vertex : faces.vertices) bounds.add(vertex);
  const double nothing = kRound * bounds.size().maxCoeff();
  const auto snapped = [&](double value) { return std::abs(value) <= nothing ? 0.0 : value; };
  std::map<std::pair<int, int>, int> ids;
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
    std::array<std::pair<Vec3, int>, 2> ends;
    int found = 0;
    for (int e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax({faces.triangles[t][e], faces.triangles[t][(e + 1) % 3]});
      const Vec3 &a = faces.vertices[low], &b = faces.vertices[high];
      const double ya = snapped(a.y()), yb = snapped(b.y());
      if ((ya < 0.0) == (yb < 0.0)) continue;
      const auto key = ya == 0.0 ? std::pair(low, low) : (yb == 0.0 ? std::pair(high, high) : std::pair(low, high));
      Vec3 place = ya == 0.0 ? a : (yb == 0.0 ? b : Vec3(a + ya / (ya - yb) * (b - a)));
      place = {half ? snapped(place.x()) : place.x(), 0.0, place.z()};
      ends[found++] = {place, ids.emplace(key, static_cast<int>(ids.size())).first->second};
    }
    if (found < 2 || ends[0].second == ends[1].second) continue;
    if ((ends[1].first - ends[0].first).dot(Vec3::UnitY().cross(faces.normals[t])) < 0.0) std::swap(ends[0], ends[1]);
    if (half) {
      const double x0 = ends[0].first.x(), x1 = ends[1].first.x();
      if (x0 <= 0.0 && x1 <= 0.0) continue;
      const Vec3 on_axis = ends[0].first + x0 / (x0 - x1) * (ends[1].first - ends[0].first);
      if (x0 < 0.0) ends[0] = {{0.0, 0.0, on_axis.z()}, -1};
      if (x1 < 0.0) ends[1] = {{0.0, 0.0, on_axis.z()}, -1};
    }
    Piece piece;
    std::tie(piece.from, piece.from_id) = ends[0];
    std::tie(piece.to, piece.to_id) = ends[1];
    if (!(piece.length() > 0.0)) continue;
    piece.along = (piece.to - piece.from) / piece.length();
    pieces.push_back(piece);
  }
  return pieces;
}

/// Joins pieces where exactly two meet: smoothly, or at a corner.
void join_pieces(const Sampler& sampler, std::vector<Piece>& pieces) {
  std::map<int, std::pair<std::vector<int>, std::vector<int>>> joints;  // pieces that end, that start
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    joints[pieces[i].to_id].first.push_back(static_cast<int>(i));
    joints[pieces[i].from_id].second.push_back(static_cast<int>(i));
  }
  for (const auto& [id, joint] : joints) {
    if (id < 0 || joint.first.size() != 1 || joint.second.size() != 1) continue;
    Piece &one = pieces[joint.first.front()], &two = pieces[joint.second.front()];
    if (one.along.dot(two.along) > kSmooth) {
      one.after = joint.second.front();
      two.before = joint.first.front();
      // A chord of an arc is half its length times the tangent of a quarter of its turn from it; a chord may be cut in
      // two, and then four times as much for the smaller part is enough for both.
      const double turn = std::tan(0.25 * angle_between(one.along, two.along));
      one.depth += 2.0 * one.length() * turn;
      two.depth += 2.0 * two.length() * turn;
    } else if (two.normal().dot(one.along) > 0.0 && sampler.is_edge(one.to, one.normal(), two.normal())) {
      one.corner_after = two.corner_before = true;
    }
  }
}

/// `half`: about an axis, where points have their clearance from a rim by where they lie.
void sample_chain(const Sampler& sampler, const std::vector<const Piece*>& chain, bool half, Samples& samples) {
  double length = 0.0;
  for (const Piece* piece : chain) length += piece->length();
  const auto& [spacing, clearance] = sampler.rules();
  const Piece &front = *chain.front(), &back = *chain.back();
  double before = 0.0, after = 0.0;  // left out at the ends
  if (half && clearance > 0.0) {
    before = front.corner_before ? 0.5 * spacing : 0.0;
    after = back.corner_after ? 0.5 * spacing : 0.0;
    if (length - before - after < spacing * (1.0 - kRound)) before = after = 0.0;
  }
  const double used = length - before - after;
  const int count = parts_of(used, spacing);
  const bool narrow = half || length < kNarrow * spacing * (1.0 - kRound);
  const auto near = [&](const Vec3& corner, const Vec3& place) {
    return !narrow && (place - corner).norm() < clearance * (1.0 - kRound);
  };
  std::size_t i = 0;
  double start = 0.0;  // start of piece i along the chain
  for (int k = 0; k < count; ++k) {
    const double along = before + (k + 0.5) / count * used;
    while (i + 1 < chain.size() && along >= start + chain[i]->length()) start += chain[i++]->length();
    const Piece& piece = *chain[i];
    const Vec3 place = piece.from + (along - start) * piece.along;
    if (sampler.hidden(place, piece.normal(), piece.depth)) continue;
    SurfaceSample sample = sampler.settled(place, piece.normal(), used / count);
    sample.place.y() = sample.normal.y() = 0.0;
    sample.normal.normalize();
    if (front.corner_before && near(front.from, sample.place)) continue;
    if (back.corner_after && near(back.to, sample.place)) continue;
    samples.push_back(sample);
  }
}

Samples sample_outline(const Sampler& sampler, const Faces& faces, bool half) {
  std::vector<Piece> pieces = cut_outline(faces, half);
  join_pieces(sampler, pieces);
  Samples samples;
  std::vector<bool> done(pieces.size());
  // Open chains begin at a piece without one before it; what is left are closed ones.
  for (const bool closed : {false, true}) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (done[i] || (!closed && pieces[i].before >= 0)) continue;
      std::vector<const Piece*> chain;
      for (int p = static_cast<int>(i); p >= 0 && !done[p]; p = pieces[p].after) {
        done[p] = true;
        chain.push_back(&pieces[p]);
      }
      sample_chain(sampler, chain, half, samples);
    }
  }
  return samples;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const Surface& surface, GeometryKind geometry, const SampleRules& rules) {
  if (!(rules.spacing > 0.0) || std::isinf(rules.spacing) || !(rules.clearance >= 0.0) || std::isinf(rules.clearance)) {
    throw RigidError(
        fmt::format("points on a surface: spacing is {:g} m and clearance {:g} m; the spacing must be "
                    "positive, the clearance not negative, both finite",
                    rules.spacing, rules.clearance));
  }
  if (geometry == GeometryKind::line) throw RigidError("points on a surface: a line has none; use a plane or space");
  const Sampler sampler(surface, rules);
  const Faces faces(surface);
  if (dimensions(geometry) == 2) return sample_outline(sampler, faces, axisymmetric(geometry));
  return sample_patches(sampler, faces);
}

}  // namespace mpm
