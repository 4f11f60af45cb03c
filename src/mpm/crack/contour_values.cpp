#include "mpm/crack/contour_values.hpp"

#include <cmath>

namespace mpm {

ContourValues ContourValues::between(const ContourValues& a, const ContourValues& b, double part) {
  const auto mix = [part](double from, double to) { return (1.0 - part) * from + part * to; };
  ContourValues mean;
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) mean.gradient[i][k] = mix(a.gradient[i][k], b.gradient[i][k]);
  }
  mean.hoop_gradient = mix(a.hoop_gradient, b.hoop_gradient);
  mean.xx = mix(a.xx, b.xx);
  mean.zz = mix(a.zz, b.zz);
  mean.xz = mix(a.xz, b.xz);
  mean.hoop = mix(a.hoop, b.hoop);
  mean.energy = mix(a.energy, b.energy);
  mean.kinetic = mix(a.kinetic, b.kinetic);
  mean.free = mix(a.free, b.free);
  mean.pressure = mix(a.pressure, b.pressure);
  mean.centre = (1.0 - part) * a.centre + part * b.centre;
  return mean;
}

namespace {

constexpr double kAside = 0.05;  ///< part of an edge: centres nearer to it lie on it
constexpr double kApart = 0.2;   ///< part of an edge that two centres on it are apart at least to give a slope

/// Half the mean of twice_of(values) along the contour.
template <class Get>
double mean_of(const std::vector<ContourPiece>& pieces, Get&& twice_of) {
  double sum = 0.0, length = 0.0;
  for (const ContourPiece& piece : pieces) {
    for (const ContourValues* values : {&piece.first, &piece.last}) sum += 0.5 * piece.length() * twice_of(*values);
    length += 2.0 * piece.length();
  }
  return length > 0.0 ? sum / length : 0.0;
}

/// One side of the crack on the edge that it meets: at its face, and at the node on this side.
struct Side {
  ContourValues face, node;
};

/// @param across values at the node `far` of material on this side; null: none
/// @param part of the edge from `far` to `near` where the crack lies
Side side_of(const ContourValues* across, const ContourValues& own, const Vec2& far, const Vec2& near, double part,
             bool at_centres) {
  if (across == nullptr) return {own, own};
  const Vec2 edge = near - far;
  const auto along = [&](const ContourValues& values) { return (values.centre - far).dot(edge) / edge.squaredNorm(); };
  const auto aside = [&](const ContourValues& values) {
    const Vec2 off = values.centre - far;
    return std::abs(off[0] * edge[1] - off[1] * edge[0]) / edge.squaredNorm();
  };
  const double from = along(*across), to = along(own);
  if (!at_centres || aside(*across) > kAside || aside(own) > kAside || to - from < kApart) {
    return {ContourValues::between(*across, own, part), own};
  }
  return {ContourValues::between(*across, own, (part - from) / (to - from)),
          ContourValues::between(*across, own, (1.0 - from) / (to - from))};
}

}  // namespace

double mean_rotation(const std::vector<ContourPiece>& pieces) {
  return mean_of(pieces, [](const ContourValues& values) { return values.gradient[0][1] - values.gradient[1][0]; });
}

double mean_growth(const std::vector<ContourPiece>& pieces) {
  return mean_of(pieces, [](const ContourValues& values) { return values.gradient[0][0] + values.gradient[1][1]; });
}

ContourStatus gather_contour(const GridLines& lines, const ContourPath& path, const ContourSource& source,
                             std::vector<ContourPiece>& pieces, bool at_centres) {
  pieces.clear();
  const int edges = static_cast<int>(path.nodes.size());
  const auto node = [&](int place) -> const std::array<int, 2>& { return path.nodes[place % edges]; };
  const ContourCrossing& crossing = path.crossing;

  ContourValues before, after, across;  // at the nodes beside the crack
  if (!source.find(node(crossing.edge), ContourField::own, before) ||
      !source.find(node(crossing.edge + 1), ContourField::own, after)) {
    return ContourStatus::no_material;
  }
  // Material across the crack from one node belongs to the side of the other.
  const auto place = [&](int at) { return lines.place(node(at)); };
  const auto side = [&](int far, int near, const ContourValues& own, double part) {
    const bool found = source.find(node(far), ContourField::across, across);
    return side_of(found ? &across : nullptr, own, place(far), place(near), part, at_centres);
  };
  const Side leaving = side(crossing.edge, crossing.edge + 1, after, crossing.along);
  const Side coming = side(crossing.edge + 1, crossing.edge, before, 1.0 - crossing.along);
  ContourPiece piece;
  piece.from = crossing.place;
  piece.first = leaving.face;
  for (int k = 1; k <= edges; ++k) {
    const int at = crossing.edge + k;
    piece.to = place(at);
    if (!source.find(node(at), ContourField::own, piece.last)) return ContourStatus::no_material;
    if (k == 1) piece.last = leaving.node;
    if (k == edges) piece.last = coming.node;
    const Vec2 along = (place(at) - place(at - 1)).normalized();
    piece.normal = Vec2(along[1], -along[0]);
    pieces.push_back(piece);
    piece.from = piece.to;
    piece.first = piece.last;
  }
  piece.to = crossing.place;
  piece.last = coming.face;
  piece.normal = pieces.front().normal;
  pieces.push_back(piece);
  return ContourStatus::complete;
}

}  // namespace mpm
