// Terms that faces inside a tip's contour add to its J: CrackTips gathers them from chains, laws and nodal values.
#include <algorithm>

#include "mpm/crack/chain.hpp"
#include "mpm/crack/crack_tips.hpp"

namespace mpm {

// Faces inside the contour: bends of this crack, other cracks, tractions and friction.
void CrackTips::add_faces(const CrackTip& tip, const JForm& form, JResult& result) {
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const Chain& chain = cracks_[c].chain;
    const bool own = static_cast<int>(c) == tip.crack;
    faces_.clear();
    for (int k = 0; k + 1 < chain.size(); ++k) {
      const Vec2 &from = chain.points()[k].place, &to = chain.points()[k + 1].place;
      FaceSample sample;
      sample.place = 0.5 * (from + to);
      sample.along = to - from;
      if (!path_.contains(lines_, sample.place)) continue;
      const Vec2 aside = 1e-6 * Vec2(-sample.along[1], sample.along[0]);
      if (!values_.at(sample.place, sample.place + aside, sample.above)) continue;
      if (!values_.at(sample.place, sample.place - aside, sample.below)) continue;
      const Vec2 normal = aside.normalized();
      if (!own && 0.5 * (chain.opening(k) + chain.opening(k + 1)).dot(normal) <= 0.0) {
        sample.traction_above = sample.above.traction(-normal);
        sample.traction_below = sample.below.traction(normal);
      }
      faces_.push_back(sample);
    }
    result.faces += face_term(form, faces_, own ? TractionTerms::left_out : TractionTerms::counted);
  }
  // Tractions on this crack, from the contour's crossing to the tip.
  const Chain& chain = cracks_[tip.crack].chain;
  const int step = tip.end == 1 ? 1 : -1;
  const ContourCrossing& crossing = path_.crossing;
  int next = tip.end == 1 ? crossing.segment + 1 : crossing.segment;
  const int before = tip.end == 1 ? crossing.segment : crossing.segment + 1;
  work_.clear();
  const auto work_at = [&](int point) {
    const int law = tractions_.any() ? tractions_.law_number(tip.crack, point) : -1;
    return law < 0 ? 0.0 : tractions_.law(law).face_work(tractions_.state(tip.crack, point));
  };
  const double along = tip.end == 1 ? crossing.along_segment : 1.0 - crossing.along_segment;
  const double behind = work_at(before) == 0.0 ? work_at(next) : work_at(before);  // the zone may end in between
  work_.push_back({crossing.place, (1.0 - along) * behind + along * work_at(next)});
  for (; next >= 0 && next < chain.size(); next += step) work_.push_back({chain.points()[next].place, work_at(next)});
  // Last point stands for a zone that ends inside the contour.
  const auto first = std::find_if(work_.begin(), work_.end(), [](const FaceWork& one) { return one.work != 0.0; });
  work_.erase(work_.begin(), first);
  result.faces_work = traction_work(form, work_) + friction_at(tip, form);
}

double CrackTips::friction_at(const CrackTip& tip, const JForm& form) {
  slips_.clear();
  const Crack& crack = cracks_[tip.crack];
  const ContactLaw& law = crack.definition.faces.law;
  if (law.kind != ContactLaw::Kind::coulomb || crack.definition.faces.ignored) return 0.0;
  const double coefficient = law.at(time_).coefficient;
  if (!(coefficient > 0.0)) return 0.0;
  const Chain& chain = crack.chain;
  const ContourCrossing& crossing = path_.crossing;
  const int step = tip.end == 1 ? 1 : -1, before = tip.end == 1 ? crossing.segment : crossing.segment + 1;
  const double part = tip.end == 1 ? crossing.along_segment : 1.0 - crossing.along_segment;
  Vec2 from = crossing.place, opening = (1.0 - part) * chain.opening(before) + part * chain.opening(before + step);
  for (int k = before + step; k >= 0 && k < chain.size(); k += step) {
    const Vec2 to = chain.points()[k].place, along = (to - from).normalized(), normal(-along[1], along[0]);
    // Faces part at the tip, where a point's own opening is that of the cells around it.
    const Vec2 next = k == chain.point_at(tip.end) ? Vec2(0.0, 0.0) : chain.opening(k);
    FrictionSample sample{from, to, 0.0, (next - opening).dot(along)};
    from = to;
    opening = next;
    if (along.isZero(0.0)) continue;  // the path meets the crack at this point
    const Vec2 middle = sample.middle(), aside = 1e-6 * (sample.to - sample.from).norm() * normal;
    ContourValues above, below;
    if (!values_.at(middle, middle + aside, above) || !values_.at(middle, middle - aside, below)) continue;
    const ContourValues mean = ContourValues::between(above, below, 0.5);
    const double pressure = -mean.traction(normal).dot(normal);
    if (!(pressure > 0.0)) continue;
    sample.shear = coefficient * pressure;
    slips_.push_back(sample);
  }
  return friction_work(form, slips_);
}

}  // namespace mpm
