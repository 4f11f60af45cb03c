#include "patch_samples.hpp"

#include <cstddef>
#include <cstdint>
#include <map>

namespace mpm {

namespace {

const double kFlat = std::cos(kPi / 180.0);
constexpr double kFine = 1.0 / 3.0;  // part of the spacing: edges of the triangles that are gathered

/// Triangles that meet smoothly, and how.
struct Patches {
  std::vector<std::array<int, 3>> mates;  ///< mates of each triangle, across the side from corner i on; -1 for none
  std::vector<int> patch;                 ///< patch of each triangle
  std::vector<double> depth;              ///< depth of each triangle, as of a Piece [m]
  std::vector<std::vector<int>> members;  ///< triangles of each patch

  explicit Patches(const Faces& faces)
      : mates(faces.triangles.size(), {-1, -1, -1}), patch(mates.size(), -1), depth(mates.size(), 0.0) {
    pair_sides(faces);
    for (std::size_t t = 0; t < patch.size(); ++t) {
      if (patch[t] < 0) gather(faces, static_cast<int>(t));
    }
  }

 private:
  /// Pairs sides that are next to each other in the list where several bodies share an edge, as those of one body
  /// are.
  void pair_sides(const Faces& faces) {
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> open;  // triangle and side
    for (std::size_t t = 0; t < mates.size(); ++t) {
      for (int e = 0; e < 3; ++e) {
        const int from = faces.triangles[t][e], to = faces.triangles[t][(e + 1) % 3];
        auto& opposite = open[{to, from}];
        if (opposite.empty()) {
          open[{from, to}].emplace_back(static_cast<int>(t), e);
          continue;
        }
        const auto [mate, side] = opposite.back();
        opposite.pop_back();
        mates[t][e] = mate;
        mates[mate][side] = static_cast<int>(t);
      }
    }
  }

  void gather(const Faces& faces, int first) {
    const int number = static_cast<int>(members.size());
    members.push_back({first});
    patch[first] = number;
    for (std::size_t i = 0; i < members.back().size(); ++i) {
      const int t = members.back()[i];
      for (int e = 0; e < 3; ++e) {
        const int mate = mates[t][e];
        if (mate < 0 || faces.normals[t].dot(faces.normals[mate]) <= kSmooth) continue;
        // As of a chord that goes across the side, and twice that, for a triangle has arcs in two directions.
        const Vec3 side = faces.corners(t)[(e + 1) % 3] - faces.corners(t)[e];
        const double turn = angle_between(faces.normals[t], faces.normals[mate]);
        depth[t] += 2.0 * faces.areas[t] / side.norm() * std::tan(0.25 * turn);
        if (patch[mate] >= 0) continue;
        patch[mate] = number;
        members.back().push_back(mate);
      }
    }
  }
};

using Segment = std::pair<Vec3, Vec3>;

/// Straight segments in a grid of cells, each in all cells within the clearance of it.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<Segment>& segments, const SampleRules& rules)
      : cell_(std::max(rules.spacing, rules.clearance)), clearance_(rules.clearance * (1.0 - kRound)) {
    for (const Segment& segment : segments) {
      Box box;
      box.add(segment.first);
      box.add(segment.second);
      const auto low = key(box.min.array() - rules.clearance), high = key(box.max.array() + rules.clearance);
      for (std::int64_t i = low[0]; i <= high[0]; ++i)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
          for (std::int64_t k = low[2]; k <= high[2]; ++k) cells_[{i, j, k}].push_back(segment);
    }
  }

  bool near(const Vec3& place) const {
    const auto cell = cells_.find(key(place));
    if (cell == cells_.end()) return false;
    return std::any_of(cell->second.begin(), cell->second.end(), [&](const Segment& segment) {
      const Vec3 along = segment.second - segment.first, arm = place - segment.first;
      return (arm - std::clamp(arm.dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm() < clearance_;
    });
  }

 private:
  std::array<std::int64_t, 3> key(const Vec3& place) const {
    const Vec3 cell = (place / cell_).array().floor();
    return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
            static_cast<std::int64_t>(cell.z())};
  }

  double cell_, clearance_;
  std::map<std::array<std::int64_t, 3>, std::vector<Segment>> cells_;
};

/// Samples one patch after another.
class PatchSampler {
 public:
  PatchSampler(const Sampler& sampler, const Faces& faces)
      : sampler_(sampler), rules_(sampler.rules()), faces_(faces), patches_(faces) {}

  Samples run() {
    for (const std::vector<int>& members : patches_.members) {
      Vec3 sum = Vec3::Zero();
      for (const int t : members) sum += faces_.areas[t] * faces_.normals[t];
      const Vec3 mean = sum.stableNormalized();
      const bool flat =
          std::all_of(members.begin(), members.end(), [&](int t) { return faces_.normals[t].dot(mean) > kFlat; });
      if (flat) {
        sample_flat(members, mean);
      } else {
        sample_curved(members);
      }
    }
    return std::move(samples_);
  }

 private:
  double area_of(const std::vector<int>& members) const {
    double area = 0.0;
    for (const int t : members) area += faces_.areas[t];
    return area;
  }

  /// Convex edges of a patch, in pieces of a spacing at most, where they are edges of the surface.
  std::vector<Segment> convex_edges(const std::vector<int>& members) const {
    std::vector<Segment> edges;
    if (rules_.clearance == 0.0) return edges;
    for (const int t : members) {
      const Corners corners = faces_.corners(t);
      for (int e = 0; e < 3; ++e) {
        const int mate = patches_.mates[t][e];
        if (mate < 0 || faces_.normals[t].dot(faces_.normals[mate]) > kSmooth) continue;
        const Vec3 &from = corners[e], along = corners[(e + 1) % 3] - from;
        const Corners other = faces_.corners(mate);
        if ((other[0] + other[1] + other[2] - 3.0 * from).dot(faces_.normals[t]) >= 0.0) continue;
        const int count = static_cast<int>(std::ceil(along.norm() / rules_.spacing));
        for (int k = 0; k < count; ++k) {
          const Vec3 start = from + k * along / count, end = from + (k + 1) * along / count;
          if (sampler_.is_edge(0.5 * (start + end), faces_.normals[t], faces_.normals[mate]))
            edges.emplace_back(start, end);
        }
      }
    }
    return edges;
  }

  /// The direction in which most of a patch's border runs: of the longest side among those that run alike.
  Vec3 border_direction(const std::vector<int>& members, const Vec3& normal) const {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    struct Runs {
      double length = 0.0;
      Vec3 longest = Vec3::Zero();
    };
    std::map<int, Runs> runs;  // by whole degrees
    for (const int t : members) {
      const Corners corners = faces_.corners(t);
      for (int e = 0; e < 3; ++e) {
        const int mate = patches_.mates[t][e];
        if (mate >= 0 && patches_.patch[mate] == patches_.patch[t]) continue;
        const Vec3 side = corners[(e + 1) % 3] - corners[e];
        Runs& run =
            runs[(static_cast<int>(std::lround(std::atan2(side.dot(v), side.dot(u)) * 180.0 / kPi)) + 360) % 360];
        run.length += side.norm();
        if (side.norm() > run.longest.norm() * (1.0 + kRound)) run.longest = side;
      }
    }
    Runs most;
    for (const auto& [angle, run] : runs) {
      if (run.length > most.length * (1.0 + kRound)) most = run;
    }
    return (most.longest - most.longest.dot(normal) * normal).normalized();
  }

  void sample_flat(const std::vector<int>& members, const Vec3& normal) {
    const Vec3 first = border_direction(members, normal), second = normal.cross(first);
    const auto in_plane = [&](const Vec3& p) { return Vec2(p.dot(first), p.dot(second)); };
    Eigen::AlignedBox2d box;
    for (const int t : members) {
      for (const Vec3& corner : faces_.corners(t)) box.extend(in_plane(corner));
    }
    const int columns = parts_of(box.sizes().x(), rules_.spacing), rows = parts_of(box.sizes().y(), rules_.spacing);
    const Vec2 step(box.sizes().x() / columns, box.sizes().y() / rows);

    std::vector<int> owner(static_cast<std::size_t>(columns) * rows, -1);
    for (const int t : members) {
      std::array<Vec2, 3> corners;
      for (int c = 0; c < 3; ++c) corners[c] = (in_plane(faces_.corners(t)[c]) - box.min()).cwiseQuotient(step);
      mark_cells(corners, t, columns, rows, owner);
    }
    const auto found = owner.size() - static_cast<std::size_t>(std::count(owner.begin(), owner.end(), -1));
    if (found == 0) return sample_middle(members);
    const double area = area_of(members) / static_cast<double>(found);

    std::vector<Segment> edges = convex_edges(members);
    const Vec2 wide = (box.sizes().array() >= kNarrow * rules_.spacing * (1.0 - kRound)).cast<double>();
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                               [&](const Segment& edge) {
                                 const Vec2 along = in_plane(edge.second - edge.first).cwiseAbs();
                                 return wide[along.x() < along.y() ? 0 : 1] == 0.0;  // the axis that it bounds
                               }),
                edges.end());
    const SegmentGrid grid(edges, rules_);
    for (std::size_t cell = 0; cell < owner.size(); ++cell) {
      const int t = owner[cell];
      if (t < 0) continue;
      const Vec2 centre = box.min() + Vec2(cell % columns + 0.5, cell / columns + 0.5).cwiseProduct(step);
      const Vec3 foot = centre.x() * first + centre.y() * second;
      const Vec3& own = faces_.normals[t];
      const Vec3 place = foot + (faces_.corners(t)[0] - foot).dot(own) / normal.dot(own) * normal;
      if (sampler_.hidden(place, own, patches_.depth[t])) continue;
      const SurfaceSample sample = sampler_.settled(place, own, area);
      if (!grid.near(sample.place)) samples_.push_back(sample);
    }
  }

  /// Gives the cells, of size 1, whose centres are in a triangle to it, where no other has them.
  static void mark_cells(const std::array<Vec2, 3>& corners, int t, int columns, int rows, std::vector<int>& owner) {
    const auto [low, high] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
    const auto first = [](double from) { return std::max(0, static_cast<int>(std::ceil(from - 0.5 - kRound))); };
    const auto last = [](double to, int count) {
      return std::min(count - 1, static_cast<int>(std::floor(to - 0.5 + kRound)));
    };
    for (int row = first(low); row <= last(high, rows); ++row) {
      const double y = std::clamp(row + 0.5, low, high);
      double from = kInfinity, to = -kInfinity;
      for (int e = 0; e < 3; ++e) {
        const Vec2 &a = corners[e], &b = corners[(e + 1) % 3];
        if ((a.y() - y) * (b.y() - y) > 0.0) continue;
        const double share = a.y() == b.y() ? 0.0 : (y - a.y()) / (b.y() - a.y());
        const double x = a.x() + share * (b.x() - a.x());
        from = std::min({from, x, a.y() == b.y() ? b.x() : x});
        to = std::max({to, x, a.y() == b.y() ? b.x() : x});
      }
      for (int column = first(from); column <= last(to, columns); ++column) {
        int& own = owner[static_cast<std::size_t>(row) * columns + column];
        if (own < 0) own = t;
      }
    }
  }

  /// One point for a patch too thin for the grid, in the middle of its largest triangle.
  void sample_middle(const std::vector<int>& members) {
    const int t = *std::max_element(members.begin(), members.end(),
                                    [&](int a, int b) { return faces_.areas[a] < faces_.areas[b]; });
    const Corners corners = faces_.corners(t);
    const Vec3 place = (corners[0] + corners[1] + corners[2]) / 3.0;
    if (sampler_.hidden(place, faces_.normals[t], patches_.depth[t])) return;
    samples_.push_back(sampler_.settled(place, faces_.normals[t], area_of(members)));
  }

  struct Gathered {
    double area = 0.0;
    Vec3 place = Vec3::Zero(), normal = Vec3::Zero();  ///< times area
    void add(const Gathered& other) {
      area += other.area;
      place += other.place;
      normal += other.normal;
    }
  };
  using Voxel = std::array<std::int64_t, 3>;

  /// Cubes are centred on multiples of the spacing; a place between two goes to the one nearer the origin.
  Voxel voxel_of(const Vec3& place) const {
    Voxel voxel;
    for (int k = 0; k < 3; ++k) {
      const double steps = std::floor(std::abs(place[k]) / rules_.spacing + 0.5 - kRound);
      voxel[k] = static_cast<std::int64_t>(place[k] < 0.0 ? -steps : steps);
    }
    return voxel;
  }

  void sample_curved(const std::vector<int>& members) {
    std::map<Voxel, std::map<int, Gathered>> voxels;  // by the octant of the normal
    for (const int t : members) {
      const Vec3& normal = faces_.normals[t];
      const int octant = (normal.x() < 0.0 ? 1 : 0) + (normal.y() < 0.0 ? 2 : 0) + (normal.z() < 0.0 ? 4 : 0);
      std::vector<Corners> open = {faces_.corners(t)};
      while (!open.empty()) {
        const Corners c = open.back();
        open.pop_back();
        int longest = 0;
        const auto length = [&](int e) { return (c[(e + 1) % 3] - c[e]).norm(); };
        for (int e = 1; e < 3; ++e) {
          if (length(e) > length(longest) * (1.0 + kRound)) longest = e;
        }
        const Vec3 &a = c[longest], &b = c[(longest + 1) % 3], &tip = c[(longest + 2) % 3];
        if (length(longest) > kFine * rules_.spacing) {
          const Vec3 middle = 0.5 * (a + b);
          open.push_back({a, middle, tip});
          open.push_back({middle, b, tip});
          continue;
        }
        const Vec3 place = (a + b + tip) / 3.0;
        if (sampler_.hidden(place, normal, patches_.depth[t])) continue;
        const double area = 0.5 * (b - a).cross(tip - a).norm();
        voxels[voxel_of(place)][octant].add({area, area * place, area * normal});
      }
    }

    std::vector<Segment> edges = convex_edges(members);
    double border = 0.0;
    for (const Segment& edge : edges) border += (edge.second - edge.first).norm();
    if (2.0 * area_of(members) < kNarrow * rules_.spacing * border) edges.clear();
    const SegmentGrid grid(edges, rules_);
    const auto add = [&](const Gathered& g) {
      const SurfaceSample sample = sampler_.settled(g.place / g.area, g.normal.stableNormalized(), g.area);
      if (!grid.near(sample.place)) samples_.push_back(sample);
    };
    for (const auto& [voxel, octants] : voxels) {
      Gathered all;
      for (const auto& [octant, part] : octants) all.add(part);
      // Two sides of something thin have no mean between them.
      if (all.normal.norm() >= kSameFace * all.area) {
        add(all);
      } else {
        for (const auto& [octant, part] : octants) add(part);
      }
    }
  }

  const Sampler& sampler_;
  const SampleRules& rules_;
  const Faces& faces_;
  Patches patches_;
  Samples samples_;
};

}  // namespace

Samples sample_patches(const Sampler& sampler, const Faces& faces) { return PatchSampler(sampler, faces).run(); }

}  // namespace mpm
