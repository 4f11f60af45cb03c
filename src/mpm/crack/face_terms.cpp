#include "mpm/crack/face_terms.hpp"

#include <cmath>

namespace mpm {

Vec2 face_term(const JForm& form, const std::vector<FaceSample>& samples, TractionTerms tractions) {
  const bool counted = tractions == TractionTerms::counted;
  const Vec2 none{0.0, 0.0};
  Vec2 sum{0.0, 0.0};
  for (const FaceSample& sample : samples) {
    const double length = sample.along.norm();
    if (length == 0.0) continue;
    const Vec2 up = Vec2(-sample.along[1], sample.along[0]) / length;
    // The material above ends downwards.
    sum += length * weight_of(form, sample.place, sample.above) *
           energy_flux(form, sample.above, -up, counted ? sample.traction_above : none);
    sum += length * weight_of(form, sample.place, sample.below) *
           energy_flux(form, sample.below, up, counted ? sample.traction_below : none);
  }
  return sum;
}

double traction_work(const JForm& form, const std::vector<FaceWork>& from_crossing_to_tip) {
  if (from_crossing_to_tip.empty()) return 0.0;
  const FaceWork& crossing = from_crossing_to_tip.front();
  if (form.kind != JForm::Kind::bergkvist_huong) return crossing.work;
  double sum = crossing.work * crossing.place[0];
  for (std::size_t k = 1; k < from_crossing_to_tip.size(); ++k) {
    const FaceWork &from = from_crossing_to_tip[k - 1], &to = from_crossing_to_tip[k];
    sum += 0.5 * (from.work + to.work) * (to.place[0] - from.place[0]);
  }
  return sum / form.tip_radius;
}

double friction_work(const JForm& form, const std::vector<FrictionSample>& samples) {
  double sum = 0.0;
  for (const FrictionSample& sample : samples) {
    const double weight = form.kind == JForm::Kind::bergkvist_huong ? sample.middle()[0] / form.tip_radius : 1.0;
    sum += weight * std::abs(sample.shear * sample.slip);
  }
  return sum;
}

}  // namespace mpm
