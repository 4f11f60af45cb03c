// Heights along x in a planar scene: a polyline, and all that lies below it.
//
// Pieces are looked at from the point's own column outwards, until none of those left can be nearer. Whether a point is
// inside follows from the height above or below it, not from normals.
#include "height_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/math/constants.hpp"

namespace mpm {

namespace {

struct NearestOnProfile {
  double squared = kInfinity;
  Vec2 point = Vec2::Zero(), normal = Vec2::Zero();  ///< nearest point, and outward normal of the piece it is on
  bool inner = true;                                 ///< not an end of the piece
};

class HeightProfile final : public Surface {
 public:
  explicit HeightProfile(const HeightGrid& grid)
      : low_(grid.low.x()),
        high_(grid.high.x()),
        step_((high_ - low_) / (grid.columns - 1)),
        heights_(grid.heights),
        lowest_(*std::min_element(heights_.begin(), heights_.end())),
        highest_(*std::max_element(heights_.begin(), heights_.end())) {}

  SurfacePoint at(const Vec3& point) const override {
    const Vec2 p(point.x(), point.z());
    const NearestOnProfile nearest = find_nearest(p);
    const Vec2 away = p - nearest.point;
    SurfacePoint result;
    const auto in_space = [](const Vec2& v) { return Vec3(v.x(), 0.0, v.y()); };
    if (nearest.inner) {
      result.distance = away.dot(nearest.normal);
      result.normal = in_space(nearest.normal);
      return result;
    }
    const bool inside = p.x() >= low_ && p.x() <= high_ && p.y() < height(p.x());
    result.distance = (inside ? -1.0 : 1.0) * away.norm();
    const bool touching = std::abs(result.distance) <= kTouching * step_;
    result.normal = in_space(touching ? nearest.normal : Vec2(away / result.distance));
    return result;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    if (point.z() - highest_ > band || low_ - point.x() > band || point.x() - high_ > band) return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override { return {{low_, -kInfinity, -kInfinity}, {high_, kInfinity, highest_}}; }

  double thickness() const override { return high_ - low_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    // As deep below its lowest place, and as far along y, as it is wide.
    const double half = 0.5 * (high_ - low_), bottom = lowest_ - (high_ - low_);
    std::vector<std::array<Vec3, 3>> result;
    const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      result.push_back({a, b, c});
      result.push_back({a, c, d});
    };
    const auto corner = [](double x, double y, double z) { return Vec3(x, y, z); };
    for (int i = 0; i < pieces(); ++i) {
      const double x = place(i), next = place(i + 1), z = heights_[i], z_next = heights_[i + 1];
      quad(corner(x, -half, z), corner(next, -half, z_next), corner(next, half, z_next), corner(x, half, z));
      quad(corner(x, half, bottom), corner(next, half, bottom), corner(next, -half, bottom), corner(x, -half, bottom));
      quad(corner(x, -half, bottom), corner(next, -half, bottom), corner(next, -half, z_next), corner(x, -half, z));
      quad(corner(x, half, z), corner(next, half, z_next), corner(next, half, bottom), corner(x, half, bottom));
    }
    const double z = heights_.front(), z_end = heights_.back();
    quad(corner(low_, -half, z), corner(low_, half, z), corner(low_, half, bottom), corner(low_, -half, bottom));
    quad(corner(high_, -half, bottom), corner(high_, half, bottom), corner(high_, half, z_end),
         corner(high_, -half, z_end));
    return result;
  }

 private:
  int pieces() const { return static_cast<int>(heights_.size()) - 1; }
  double place(int i) const { return i == pieces() ? high_ : low_ + i * step_; }

  int column(double x) const {
    return static_cast<int>(std::clamp(std::floor((x - low_) / step_), 0.0, pieces() - 1.0));
  }

  double height(double x) const {
    const int i = column(x);
    return heights_[i] + (x - place(i)) / (place(i + 1) - place(i)) * (heights_[i + 1] - heights_[i]);
  }

  NearestOnProfile find_nearest(const Vec2& p) const {
    NearestOnProfile best;
    const int own = column(p.x());
    for (int ring = 0, nearer = 1; nearer != 0; ++ring) {
      nearer = 0;
      for (const int i : {own - ring, own + ring}) {
        if (i < 0 || i >= pieces() || (ring == 0 && nearer != 0)) continue;
        const double gap = std::max({place(i) - p.x(), p.x() - place(i + 1), 0.0});
        if (gap * gap >= best.squared) continue;
        nearer = 1;
        look_at(i, p, best);
      }
    }
    look_at_side(low_, heights_.front(), -1.0, p, best);
    look_at_side(high_, heights_.back(), 1.0, p, best);
    return best;
  }

  void look_at(int i, const Vec2& p, NearestOnProfile& best) const {
    const Vec2 from(place(i), heights_[i]), along = Vec2(place(i + 1), heights_[i + 1]) - from;
    const double t = (p - from).dot(along) / along.squaredNorm();
    const Vec2 point = from + std::clamp(t, 0.0, 1.0) * along;
    const double squared = (p - point).squaredNorm();
    if (squared >= best.squared) return;
    best = {squared, point, Vec2(-along.y(), along.x()).normalized(), t > 0.0 && t < 1.0};
  }

  static void look_at_side(double x, double top, double outwards, const Vec2& p, NearestOnProfile& best) {
    const double squared = (p.x() - x) * (p.x() - x);
    if (p.y() < top && squared < best.squared) best = {squared, {x, p.y()}, {outwards, 0.0}, true};
  }

  double low_, high_, step_;
  std::vector<double> heights_;
  double lowest_, highest_;
};

}  // namespace

std::unique_ptr<Surface> make_height_profile(const HeightGrid& grid) { return std::make_unique<HeightProfile>(grid); }

}  // namespace mpm
