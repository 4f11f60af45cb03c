#include "mpm/contact/pair_normal.hpp"

namespace mpm {
namespace {

Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3::Zero();
}

}  // namespace

PairNormals pair_normals(const NormalRule& rule, const NodeMaterial& a, const NodeMaterial& b) {
  const auto both = [](const Vec3& normal) { return PairNormals{unit(normal), unit(normal)}; };
  const bool with_rigid = a.rigid || b.rigid;
  const Vec3 of_rigid = a.rigid ? a.gradient : Vec3(-b.gradient);
  const double rigid_length = rule.rigid_bias * of_rigid.norm();
  switch (rule.method) {
    case NormalMethod::larger_gradient: {
      if (with_rigid) {
        const Vec3 other = a.rigid ? Vec3(-b.gradient) : a.gradient;
        return both(other.norm() > rigid_length ? other : of_rigid);
      }
      return both(a.gradient.squaredNorm() >= b.gradient.squaredNorm() ? a.gradient : Vec3(-b.gradient));
    }
    case NormalMethod::larger_volume:
      return both(a.volume >= b.volume ? a.gradient : Vec3(-b.gradient));
    case NormalMethod::average: {
      const Vec3 mean = (a.volume * a.gradient - b.volume * b.gradient) / (a.volume + b.volume);
      return both(with_rigid && !(mean.norm() > rigid_length) ? of_rigid : mean);
    }
    case NormalMethod::own:
      break;
  }
  return {unit(a.gradient), unit(-b.gradient)};
}

}  // namespace mpm
