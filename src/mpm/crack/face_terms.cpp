#include "mpm/crack/face_terms.hpp"

#include <cmath>

namespace mpm {
namespace {

/// r / a where the form of Bergkvist and Huong holds.
double moment_weight(const JForm& form, const Vec2& place) {
  return form.kind_at(place) == JForm::Kind::bergkvist_huong ? place[0] / form.tip_radius : 1.0;
}

}  // namespace

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
  const std::vector<FaceWork>& list = from_crossing_to_tip;
  if (form.kind != JForm::Kind::bergkvist_huong) return list.front().work;
  double sum = moment_weight(form, list.back().place) * list.back().work;
  for (std::size_t k = 1; k < list.size(); ++k) {
    const FaceWork &from = list[k - 1], &to = list[k];
    sum += moment_weight(form, 0.5 * (from.place + to.place)) * (from.work - to.work);
  }
  return sum;
}

double friction_work(const JForm& form, const std::vector<FrictionSample>& samples) {
  double sum = 0.0;
  for (const FrictionSample& sample : samples) {
    sum += moment_weight(form, sample.middle()) * std::abs(sample.shear * sample.slip);
  }
  return sum;
}

}  // namespace mpm
