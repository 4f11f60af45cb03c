#include "mpm/crack/contour_values.hpp"

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
  return mean;
}

ContourStatus gather_contour(const GridLines& lines, const ContourPath& path, const ContourSource& source,
                             std::vector<ContourPiece>& pieces) {
  pieces.clear();
  const int edges = static_cast<int>(path.nodes.size());
  const auto node = [&](int place) -> const std::array<int, 2>& { return path.nodes[place % edges]; };
  const ContourCrossing& crossing = path.crossing;

  ContourValues before, after, across;  // at the nodes beside the crack
  if (!source.find(node(crossing.edge), ContourField::own, before) ||
      !source.find(node(crossing.edge + 1), ContourField::own, after)) {
    return ContourStatus::no_material;
  }
  // What one node has across the crack belongs to the side of the other.
  ContourPiece piece;
  piece.from = crossing.place;
  piece.first = source.find(node(crossing.edge), ContourField::across, across)
                    ? ContourValues::between(across, after, crossing.along)
                    : after;
  for (int k = 1; k <= edges; ++k) {
    const int at = crossing.edge + k;
    piece.to = lines.place(node(at));
    if (!source.find(node(at), ContourField::own, piece.last)) return ContourStatus::no_material;
    const Vec2 along = (lines.place(node(at)) - lines.place(node(at - 1))).normalized();
    piece.normal = Vec2(along[1], -along[0]);
    pieces.push_back(piece);
    piece.from = piece.to;
    piece.first = piece.last;
  }
  piece.to = crossing.place;
  piece.last = source.find(node(crossing.edge + 1), ContourField::across, across)
                   ? ContourValues::between(before, across, crossing.along)
                   : before;
  piece.normal = pieces.front().normal;
  pieces.push_back(piece);
  return ContourStatus::complete;
}

}  // namespace mpm
