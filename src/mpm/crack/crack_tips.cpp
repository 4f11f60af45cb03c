#include "mpm/crack/crack_tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "mpm/crack/chain.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

constexpr double kClosed = 1e-3;  ///< part of the slip, an opening that is none
constexpr int kMoment = 2;        ///< cells around the tip where particles have the first moment of energy wrong

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
  by_balance_ = settings_.growth.criterion == FractureCriterion::energy_balance;
  for (const FractureMaterial& material : settings_.materials) {
    const std::optional<GrowthRule>& own = material.constants.growth;
    by_balance_ = by_balance_ || (own && own->criterion == FractureCriterion::energy_balance);
  }
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

JForm CrackTips::form_of(const Chain& chain, const Vec2& tip) {
  JForm form;
  form.large_strain = true;
  form.tip_radius = tip[0];
  if (axisymmetric(parts_.geometry)) {
    form.kind = settings_.contour.about_axis_by_broberg ? JForm::Kind::broberg : JForm::Kind::bergkvist_huong;
  }
  const int size = std::min(settings_.contour.size, kMoment);
  edge_.status = ContourStatus::no_material;
  if (form.kind != JForm::Kind::bergkvist_huong) return form;
  make_path(lines_, chain.line().data(), static_cast<int>(chain.line().size()), tip, size, edge_);
  if (edge_.status != ContourStatus::complete) return form;
  form.low = lines_.place(edge_.low);
  form.high = lines_.place(edge_.high);
  return form;
}

void CrackTips::find(double time) {
  time_ = time;
  for (CrackTip& tip : tips_) find(tip);
}

void CrackTips::find_materials() {
  for (CrackTip& tip : tips_) find_material(tip);
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
  if (!named.empty() && tip.growths == 0) {
    for (std::size_t m = 0; m < settings_.materials.size(); ++m) {
      if (settings_.materials[m].name == named) tip.material = static_cast<int>(m);
    }
    return;
  }
  // That of the particle nearest to the tip, and of the first body of several.
  const Vec2 place = chain.points()[chain.point_at(tip.end)].place;
  struct Nearest {
    double distance;
    std::int64_t set;
  };
  Nearest nearest{std::numeric_limits<double>::infinity(), -1};
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    if (cracks_[tip.crack].divides[s] == 0) continue;
    for (std::uint32_t p = set.begin[chosen_.patches().first_owner]; p < set.begin.back(); ++p) {
      const double distance = (Vec2(set.x[0][p], set.x[1][p]) - place).squaredNorm();
      if (distance < nearest.distance) nearest = {distance, static_cast<std::int64_t>(s)};
    }
  }
  if (parts_.ranks != nullptr) {
    for (const Nearest& one : gather_list(*parts_.ranks, std::vector<Nearest>{nearest})) {
      if (std::tie(one.distance, one.set) < std::tie(nearest.distance, nearest.set)) nearest = one;
    }
  }
  if (nearest.set >= 0) tip.material = settings_.material_of_set[nearest.set];
}

void CrackTips::find(CrackTip& tip) {
  const Chain& chain = cracks_[tip.crack].chain;
  tip.looked = true;
  tip.j = tip.zone = 0.0;
  tip.k = {};
  const Vec2 opening = chain.tip_opening(tip.end);
  tip.opening = opening[0];
  tip.slip = opening[1];
  find_material(tip);
  const Vec2 place = chain.points()[chain.point_at(tip.end)].place;
  lay_path(tip);
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
  const bool swells = !parts_.physics.empty();
  if (inertia || swells || axisymmetric(parts_.geometry)) values_.find_samples(lines_, path_, samples_);
  JForm form = form_of(chain, place);
  if (swells) form.content = mean_content(samples_);
  Vec2 joining{0.0, 0.0};
  if (edge_.status == ContourStatus::complete) {
    if (gather_contour(lines_, edge_, values_, pieces_, false) == ContourStatus::complete) {
      joining = joining_term(form, pieces_);
    } else {
      form.low = form.high;
    }
  }
  JResult result = integrate_j(form, lines_, path_, values_, samples_, inertia, pieces_, swells);
  tip.status = result.status;
  if (result.status != ContourStatus::complete) return;
  result.contour += joining;
  form.rotation = result.rotation;
  form.growth = result.growth;
  add_faces(tip, form, result);
  tip.zone = result.faces_work;
  tip.j = result.along(chain.direction(tip.end));
  split(tip);
}

// Around the tip and no other: ends of chains that are not exterior and not on another crack. A crack that is too
// short for that has one contour around both of its tips, and no J, until it has grown.
void CrackTips::lay_path(const CrackTip& tip) {
  const std::vector<Vec2>& line = cracks_[tip.crack].chain.line();
  const auto lay = [&] {
    make_path(lines_, line.data(), static_cast<int>(line.size()), end_of(tip.crack, tip.end), settings_.contour.size,
              path_, others_);
  };
  others_.clear();
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const int crack = static_cast<int>(c);
    for (int end = 0; end < 2; ++end) {
      if (crack == tip.crack || !cracks_[c].felt || !divide_one_body(tip.crack, crack)) continue;
      if (cracks_[c].chain.end(end) == CrackEnd::exterior) continue;
      if (!lies_on_other_crack(crack, end_of(crack, end))) others_.push_back(end_of(crack, end));
    }
  }
  const int other = 1 - tip.end;
  const bool own = cracks_[tip.crack].chain.end(other) != CrackEnd::exterior &&
                   !lies_on_other_crack(tip.crack, end_of(tip.crack, other));
  if (own) others_.push_back(end_of(tip.crack, other));
  lay();
  if (!own || path_.status != ContourStatus::holds_other_tip) return;
  others_.pop_back();
  lay();
}

const Vec2& CrackTips::end_of(int crack, int end) const {
  const Chain& chain = cracks_[crack].chain;
  return chain.points()[chain.point_at(end)].place;
}

bool CrackTips::divide_one_body(int crack, int other) const {
  const std::vector<std::uint8_t>&one = cracks_[crack].divides, &two = cracks_[other].divides;
  for (std::size_t s = 0; s < one.size(); ++s) {
    if (one[s] != 0 && two[s] != 0) return true;
  }
  return false;
}

bool CrackTips::lies_on_other_crack(int crack, const Vec2& place) const {
  const double near = kMet * parts_.fields.front()->layout.smallest_cell();
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const int other = static_cast<int>(c);
    if (other == crack || !cracks_[c].felt || !divide_one_body(crack, other)) continue;
    if (cracks_[c].chain.distance(place) <= near) return true;
  }
  return false;
}

void CrackTips::split(CrackTip& tip) {
  if (tip.material < 0 || !settings_.materials[tip.material].elastic || cracks_[tip.crack].definition.fixed) return;
  const ElasticConstants& elastic = *settings_.materials[tip.material].elastic;
  const bool by_integral = settings_.split == CracksDefinition::Split::interaction && !axisymmetric(parts_.geometry);
  if (!by_integral) {
    tip.k = split_by_openings(tip.j, tip.opening, tip.slip, elastic, tip.running);
    return;
  }
  const Chain& chain = cracks_[tip.crack].chain;
  tip.k =
      interaction_integral(elastic, chain.points()[chain.point_at(tip.end)].place, chain.direction(tip.end), pieces_);
  if (!parts_.physics.empty()) {
    const StressIntensity more =
        eigenstrain_term(elastic, end_of(tip.crack, tip.end), chain.direction(tip.end), samples_, path_.area(lines_));
    tip.k.one += more.one;
    tip.k.two += more.two;
  }
  // The shear of friction on faces inside the contour, which the auxiliary field of free faces leaves out: the work of
  // a traction on the jump of that field, (kappa + 1) / G sqrt(d / (2 pi)), times E' / 2 = 4 G / (kappa + 1).
  const Vec2 at = chain.points()[chain.point_at(tip.end)].place;
  double friction = 0.0;
  for (const FrictionSample& sample : slips_) {
    const double far = std::sqrt((sample.from - at).norm()), close = std::sqrt((sample.to - at).norm());
    friction += std::sqrt(2.0 / kPi) * sample.shear * 2.0 * (far - close);
  }
  tip.k.two -= std::copysign(std::min(friction, std::abs(tip.k.two)), tip.k.two);
  // K_I of closed faces means nothing; whether they are is known to a part of the slip.
  if (tip.opening <= kClosed * std::abs(tip.slip)) tip.k.one = 0.0;
}

void CrackTips::heat(double dt) {
  for (std::size_t t = 0; t < tips_.size() && heating_ != nullptr; ++t) {
    const Chain& chain = cracks_[tips_[t].crack].chain;
    heating_->heat(static_cast<int>(t), chain.points()[chain.point_at(tips_[t].end)].place, dt);
  }
}

void CrackTips::serialise(StateArchive& archive) {
  archive.value("grown_area", grown_area_);
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const StateArchive::Group group(archive, "tip_" + std::to_string(t));
    CrackTip& tip = tips_[t];
    archive.value("looked", tip.looked);
    archive.value("status", tip.status);
    for (const TipNumber& of : kTipNumbers) archive.value(of.stored, of.at(tip));
    archive.value("material", tip.material);
    archive.value("growths", tip.growths);
    archive.value("by_alternate", tip.by_alternate);
    archive.value("why", tip.why);
    tip.growth.serialise(archive);
  }
}

}  // namespace mpm
