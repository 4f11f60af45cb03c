// Reports of cracks and of their tips.
#include "mpm/crack/crack_stage.hpp"
#include "state.hpp"

namespace mpm {

std::vector<CrackReport> Simulation::cracks() const {
  std::vector<CrackReport> reports;
  const auto* stage = dynamic_cast<const CrackStage*>(state_->modules.find("cracks"));
  if (stage == nullptr) return reports;
  const auto world = [](const Vec2& place) { return Vec3(place[0], 0.0, place[1]); };
  for (std::size_t c = 0; c < stage->cracks().size(); ++c) {
    const Crack& crack = stage->cracks()[c];
    const CrackTractions& tractions = stage->tractions();
    const int number = static_cast<int>(c);
    CrackReport report;
    report.name = crack.definition.name;
    report.length = crack.chain.length();
    report.open_length = crack.chain.open_length([&](int point) { return tractions.law_at(number, point) < 0; });
    for (int k = 0; k < crack.chain.size(); ++k) {
      const CrackPoint& point = crack.chain.points()[k];
      report.points.push_back(world(point.place));
      report.above.push_back(world(point.above));
      report.below.push_back(world(point.below));
      const TractionState& state = tractions.state(number, k);
      report.normal_traction.push_back(state.traction.normal);
      report.shear_traction.push_back(state.traction.shear);
      report.debonded.push_back(state.failed);
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<CrackTipReport> Simulation::crack_tips() const {
  std::vector<CrackTipReport> reports;
  const auto* stage = dynamic_cast<const CrackStage*>(state_->modules.find("cracks"));
  if (stage == nullptr) return reports;
  for (const CrackTip& tip : stage->tips()) {
    const Crack& crack = stage->cracks()[tip.crack];
    const Vec2 place = crack.chain.points()[crack.chain.point_at(tip.end)].place;
    const Vec2 direction = crack.chain.direction(tip.end);
    CrackTipReport report;
    static_cast<TipNumbers&>(report) = tip;
    report.crack = crack.definition.name;
    report.end = tip.end == 0 ? "start" : "end";
    report.place = Vec3(place[0], 0.0, place[1]);
    report.direction = Vec3(direction[0], 0.0, direction[1]);
    report.state = tip.looked ? describe(tip.status) : "not looked at yet";
    report.growth = tip.by_alternate ? tip.why + "; it last grew by the alternate rule (alt)" : tip.why;
    if (tip.material >= 0) report.material = state_->definition.materials[tip.material].name;
    report.has_j = !tip.looked || tip.status == ContourStatus::complete;
    report.stopped = stage->tip_stopped(tip);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace mpm
