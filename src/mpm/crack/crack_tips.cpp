#include "mpm/crack/crack_tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/crack/chain.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kClosed = 1e-3;  ///< of the slip, an opening that is none

GridLines lines_of(const GridLayout& layout) {
  GridLines lines;
  for (int k = 0; k < 2; ++k) {
    lines.origin[k] = layout.origin(k);
    lines.cell[k] = layout.cell(k);
    lines.nodes[k] = layout.last_node(k) + 1;
  }
  return lines;
}

}  // namespace

CrackTips::CrackTips(std::vector<Crack>& cracks, const CrackFields& chosen, CrackTractions& tractions,
                     FieldJumps& jumps, TipParts parts, std::unique_ptr<ScalarTransfer> transfer, TipSettings settings)
    : cracks_(cracks),
      chosen_(chosen),
      tractions_(tractions),
      jumps_(jumps),
      parts_(std::move(parts)),
      settings_(std::move(settings)),
      values_(parts_, std::move(transfer)),
      lines_(lines_of(parts_.fields.front()->layout)) {
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (int end = 0; end < 2; ++end) {
      if (cracks[c].chain.end(end) != CrackEnd::tip) continue;
      CrackTip tip;
      tip.crack = static_cast<int>(c);
      tip.end = end;
      tip.start_direction = cracks[c].chain.direction(end);
      tips_.push_back(std::move(tip));
    }
  }
}

JForm CrackTips::form_of(const Vec2& tip) const {
  JForm form;
  form.large_strain = true;
  form.tip_radius = tip[0];
  if (axisymmetric(parts_.geometry)) {
    form.kind = settings_.contour.about_axis_by_broberg ? JForm::Kind::broberg : JForm::Kind::bergkvist_huong;
  }
  return form;
}

void CrackTips::find(double time) {
  time_ = time;
  for (CrackTip& tip : tips_) find(tip);
}

// The group with most of the contour's nodes.
int CrackTips::group_of(const CrackTip& tip, const ContourPath& path) const {
  int best = -1, most = 0;
  for (const int first : chosen_.groups(tip.crack)) {
    int count = 0;
    for (const std::array<int, 2>& node : path.nodes) {
      const NodeRef ref = chosen_.find_place(first, node);
      count += ref.block >= 0 && parts_.fields[first]->carries(ref.block, ref.node) ? 1 : 0;
    }
    if (count > most) {
      most = count;
      best = first;
    }
  }
  return best;
}

void CrackTips::find_material(CrackTip& tip) {
  const Chain& chain = cracks_[tip.crack].chain;
  const std::string& named = cracks_[tip.crack].definition.tip_materials[tip.end];
  const bool kept = tip.material >= 0 && settings_.materials[tip.material].constants.keeps_tips;
  if (kept) return;
  if (tip.material < 0 && !named.empty()) {
    for (std::size_t m = 0; m < settings_.materials.size(); ++m) {
      if (settings_.materials[m].name == named) tip.material = static_cast<int>(m);
    }
    return;
  }
  // That of the particle nearest to the tip.
  const Vec2 place = chain.points()[chain.point_at(tip.end)].place;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    if (cracks_[tip.crack].divides[s] == 0) continue;
    for (std::uint32_t p = set.begin[chosen_.patches().first_owner]; p < set.begin.back(); ++p) {
      const double distance = (Vec2(set.x[0][p], set.x[1][p]) - place).squaredNorm();
      if (!(distance < nearest)) continue;
      nearest = distance;
      tip.material = settings_.material_of_set[s];
    }
  }
}

void CrackTips::find(CrackTip& tip) {
  const Chain& chain = cracks_[tip.crack].chain;
  tip.looked = true;
  tip.j = tip.zone = 0.0;
  tip.k = {};
  const Vec2 opening = chain.tip_opening(tip.end);
  tip.opening = {opening[0], opening[1]};
  find_material(tip);
  const Vec2 place = chain.points()[chain.point_at(tip.end)].place;
  make_path(lines_, chain.line().data(), static_cast<int>(chain.line().size()), place, settings_.contour.size, path_);
  tip.status = path_.status;
  if (path_.status != ContourStatus::complete) return;
  const int first = group_of(tip, path_);
  if (first < 0) {
    tip.status = ContourStatus::no_material;
    return;
  }
  values_.gather(first, tip.crack, path_.low, path_.high);
  const bool inertia = settings_.contour.terms == 2;
  samples_.clear();
  if (inertia || axisymmetric(parts_.geometry)) values_.find_samples(lines_, path_, samples_);
  JResult result = integrate_j(form_of(place), lines_, path_, values_, samples_, inertia, pieces_);
  tip.status = result.status;
  if (result.status != ContourStatus::complete) return;
  add_faces(tip, result);
  tip.zone = result.faces_work;
  tip.j = result.along(chain.direction(tip.end));
  split(tip);
}

// Faces inside the contour: bends of this crack, other cracks, tractions and friction.
void CrackTips::add_faces(const CrackTip& tip, JResult& result) {
  const JForm form = form_of(cracks_[tip.crack].chain.points()[cracks_[tip.crack].chain.point_at(tip.end)].place);
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
  // Where the zone ends inside the contour, its last point stands for it.
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

void CrackTips::split(CrackTip& tip) {
  if (tip.material < 0 || !settings_.materials[tip.material].elastic || cracks_[tip.crack].definition.fixed) return;
  const ElasticConstants& elastic = *settings_.materials[tip.material].elastic;
  const bool by_integral = settings_.split == CracksDefinition::Split::interaction && !axisymmetric(parts_.geometry);
  if (!by_integral) {
    tip.k = split_by_openings(tip.j, tip.opening.normal, tip.opening.shear, elastic, tip.running);
    return;
  }
  const Chain& chain = cracks_[tip.crack].chain;
  tip.k =
      interaction_integral(elastic, chain.points()[chain.point_at(tip.end)].place, chain.direction(tip.end), pieces_);
  // The shear of friction on faces inside the contour, which the auxiliary field of free faces leaves out: the work of
  // a traction on the jump of that field, (kappa + 1) / G sqrt(d / (2 pi)), times E' / 2 = 4 G / (kappa + 1).
  const Vec2 at = chain.points()[chain.point_at(tip.end)].place;
  double friction = 0.0;
  for (const FrictionSample& sample : slips_) {
    const double far = std::sqrt((sample.from - at).norm()), close = std::sqrt((sample.to - at).norm());
    friction += std::sqrt(2.0 / kPi) * sample.shear * 2.0 * (far - close);
  }
  tip.k.two -= std::copysign(std::min(friction, std::abs(tip.k.two)), tip.k.two);
  // Of closed faces the integral's K_I means nothing; whether they are is known to a part of the slip.
  if (tip.opening.normal <= kClosed * std::abs(tip.opening.shear)) tip.k.one = 0.0;
}

void CrackTips::heat(double dt) {
  for (std::size_t t = 0; t < tips_.size() && heating_ != nullptr; ++t) {
    const Chain& chain = cracks_[tips_[t].crack].chain;
    heating_->heat(static_cast<int>(t), chain.points()[chain.point_at(tips_[t].end)].place, dt);
  }
}

void CrackTips::serialise(StateArchive& archive) {
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const StateArchive::Group group(archive, "tip_" + std::to_string(t));
    CrackTip& tip = tips_[t];
    archive.value("looked", tip.looked);
    archive.value("status", tip.status);
    for (const auto& [name, number] : {std::pair<const char*, double*>{"j", &tip.j},
                                       {"zone", &tip.zone},
                                       {"k_one", &tip.k.one},
                                       {"k_two", &tip.k.two},
                                       {"opening_normal", &tip.opening.normal},
                                       {"opening_shear", &tip.opening.shear},
                                       {"speed", &tip.speed},
                                       {"grown", &tip.grown},
                                       {"angle", &tip.angle},
                                       {"first_angle", &tip.first_angle},
                                       {"running", &tip.running},
                                       {"released", &tip.released},
                                       {"last_growth", &tip.last_growth},
                                       {"next_look", &tip.next_look}}) {
      archive.value(name, *number);
    }
    archive.value("material", tip.material);
    archive.value("growths", tip.growths);
    archive.value("by_alternate", tip.by_alternate);
    archive.value("why", tip.why);
    tip.growth.serialise(archive);
  }
}

}  // namespace mpm
