#include "mpm/crack/crack_tractions.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

/// Square of a circular frequency [1/s^2]: up to four points pull at a node, on both of its sides.
double frequency_squared(double spring, double mass) { return 8.0 * spring / mass; }

}  // namespace

CrackTractions::CrackTractions(std::vector<Crack>& cracks, const CrackFields& chosen, Fields& fields,
                               const std::vector<TractionLawDefinition>& laws, GeometryKind geometry, double across)
    : cracks_(cracks), chosen_(chosen), fields_(fields), geometry_(geometry), across_(across) {
  for (const TractionLawDefinition& law : laws) laws_.emplace_back(law);
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    groups_.push_back(chosen.groups(static_cast<int>(c)));
    Points points;
    const int size = cracks[c].chain.size();
    points.law.assign(size, law_of(cracks[c].definition.traction));
    points.state.resize(size);
    points.force.assign(size, Vec2::Zero());
    points_.push_back(std::move(points));
  }
}

int CrackTractions::law_of(const std::string& name) const {
  for (std::size_t l = 0; l < laws_.size(); ++l) {
    if (laws_[l].definition().name == name) return static_cast<int>(l);
  }
  return -1;
}

double CrackTractions::area(int crack, int point) const {
  const Chain& chain = cracks_[crack].chain;
  return chain.tangent_area(point).norm() * across(crack, chain.points()[point].place[0]);
}

// Thickness of faces at that radius [m].
double CrackTractions::across(int crack, double radius) const {
  const double thickness = cracks_[crack].definition.thickness;
  return axisymmetric(geometry_) ? kTurn * radius : thickness > 0.0 ? thickness : across_;
}

void CrackTractions::find(double time) {
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const Chain& chain = cracks_[c].chain;
    Points& points = points_[c];
    for (int k = 0; k < chain.size(); ++k) {
      points.force[k].setZero();
      if (points.law[k] < 0 || points.state[k].failed) continue;
      const Vec2 tangent = chain.tangent_area(k).normalized(), normal(-tangent[1], tangent[0]);
      const Vec2 opening = chain.opening(k);
      const Traction traction =
          laws_[points.law[k]].advance(opening.dot(normal), opening.dot(tangent), time, points.state[k]);
      points.force[k] = -area(static_cast<int>(c), k) * (traction.normal * normal + traction.shear * tangent);
    }
  }
}

// `mass(field, ref)`: of a node [kg].
template <class Mass>
void CrackTractions::find_shares(int crack, const Vec2& place, const Vec2& from, Mass&& mass,
                                 std::vector<Share>& shares) const {
  shares.clear();
  double sum = 0.0;
  for (const int first : groups_[crack]) {
    chosen_.each_node_around(first, place, from, [&](const CrackFields::NodeOfField& own, double hat) {
      const double of_node = mass(own.field, own.ref);
      if (!(of_node > fields_[own.field]->least_mass)) return;
      shares.push_back({own.field, own.ref, of_node, hat * of_node});
      sum += hat * of_node;
    });
  }
  for (Share& share : shares) share.part /= sum;
}

// Finds the shares of both sides of a point; false if one of them has no nodes.
template <class Mass>
bool CrackTractions::find_shares(int crack, int point, Mass&& mass) {
  const Chain& chain = cracks_[crack].chain;
  find_shares(crack, chain.points()[point].above, chain.beside(point, true), mass, above_);
  find_shares(crack, chain.points()[point].below, chain.beside(point, false), mass, below_);
  return !above_.empty() && !below_.empty();
}

double CrackTractions::mean_mass(const std::vector<Share>& shares) {
  double mass = 0.0;
  for (const Share& share : shares) mass += share.part * share.mass;
  return mass;
}

// The square of the circular frequency of what tips may add.
template <class Mass>
double CrackTractions::fastest_growth(const std::vector<FacesOfGrowth>& growth, Mass&& mass) {
  double fastest = 0.0;
  for (const FacesOfGrowth& faces : growth) {
    const int tip = cracks_[faces.crack].chain.point_at(faces.end);
    if (!find_shares(faces.crack, tip, mass)) continue;
    const double radius = cracks_[faces.crack].chain.points()[tip].place[0];
    const double spring = laws_[faces.law].stiffness() * faces.length * across(faces.crack, radius);
    // Nodes ahead of the tip are whole yet: growth leaves half of one that it runs through to either side.
    for (const auto* shares : {&above_, &below_}) {
      fastest = std::max(fastest, frequency_squared(spring, 0.5 * mean_mass(*shares)));
    }
  }
  return fastest;
}

void CrackTractions::begin(ScalarTransfer& transfer, const std::vector<ParticleSet>& sets,
                           const std::vector<FacesOfGrowth>& growth) {
  std::vector<PaddedArray<double>> ones;
  ScalarTransfer::Given given;
  for (const ParticleSet& set : sets) ones.emplace_back().assign(set.id.size(), 1.0);
  for (const PaddedArray<double>& one : ones) given.push_back({one.data(), nullptr, nullptr});
  std::vector<NodalField> masses;
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    masses.emplace_back(1, fields_[f]->layout.nodes_per_block());
    transfer.spread(static_cast<int>(f), given, ScalarTransfer::Weight::mass, masses.back());
  }
  const auto mass = [&](int field, NodeRef ref) { return masses[field].at(ref.block, 0, ref.node); };
  double fastest = fastest_growth(growth, mass);
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const int crack = static_cast<int>(c);
    for (int k = 0; k < cracks_[c].chain.size(); ++k) {
      if (law_at(crack, k) < 0 || !find_shares(crack, k, mass)) continue;
      const double spring = laws_[points_[c].law[k]].stiffness() * area(crack, k);
      fastest = std::max(fastest, frequency_squared(spring, std::min(mean_mass(above_), mean_mass(below_))));
    }
  }
  shortest_time_ = fastest > 0.0 ? 1.0 / std::sqrt(fastest) : 0.0;
}

void CrackTractions::add_forces(const std::vector<FacesOfGrowth>& growth) {
  const auto mass = [&](int field, NodeRef ref) { return fields_[field]->mass.at(ref.block, 0, ref.node); };
  double fastest = fastest_growth(growth, mass);
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const int crack = static_cast<int>(c);
    const Points& points = points_[c];
    for (int k = 0; k < cracks_[c].chain.size(); ++k) {
      if (law_at(crack, k) < 0 || !find_shares(crack, k, mass)) continue;
      const double spring = laws_[points.law[k]].stiffness() * area(crack, k);
      double sign = 1.0;
      for (const std::vector<Share>* shares : {&above_, &below_}) {
        for (const Share& share : *shares) {
          for (int i = 0; i < 2; ++i) {
            fields_[share.field]->force.at(share.ref.block, i, share.ref.node) +=
                sign * share.part * points.force[k][i];
          }
        }
        fastest = std::max(fastest, frequency_squared(spring, mean_mass(*shares)));
        sign = -1.0;
      }
    }
  }
  shortest_time_ = fastest > 0.0 ? 1.0 / std::sqrt(fastest) : 0.0;
}

void CrackTractions::grow(int crack, int end, int points, int law) {
  Points& of = points_[crack];
  const auto insert = [&](auto& list, const auto& value) {
    list.insert(end == 0 ? list.begin() : list.end(), points, value);
  };
  insert(of.law, law);
  insert(of.state, TractionState{});
  insert(of.force, Vec2(Vec2::Zero()));
}

double CrackTractions::stored(int crack) const {
  double sum = 0.0;
  const Points& of = points_[crack];
  for (std::size_t k = 0; k < of.law.size(); ++k) {
    if (of.law[k] < 0 || laws_[of.law[k]].definition().kind == TractionKind::pressure) continue;
    const FaceOpening& opening = of.state[k].opening;
    sum += area(crack, static_cast<int>(k)) * laws_[of.law[k]].stored(of.state[k], opening.normal, opening.shear);
  }
  return sum;
}

double CrackTractions::released(int crack) const {
  double sum = 0.0;
  const Points& of = points_[crack];
  for (std::size_t k = 0; k < of.law.size(); ++k) {
    if (of.law[k] < 0 || laws_[of.law[k]].definition().kind == TractionKind::pressure) continue;
    sum += area(crack, static_cast<int>(k)) * laws_[of.law[k]].released(of.state[k]);
  }
  return sum;
}

int CrackTractions::failed(int crack) const {
  const auto& states = points_[crack].state;
  return static_cast<int>(std::count_if(states.begin(), states.end(), [](const TractionState& s) { return s.failed; }));
}

void CrackTractions::energies(EnergyReport& report) const {
  if (laws_.empty()) return;
  double stored_sum = 0.0, released_sum = 0.0, work = 0.0;
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    stored_sum += stored(static_cast<int>(c));
    released_sum += released(static_cast<int>(c));
    const Points& of = points_[c];
    for (std::size_t k = 0; k < of.law.size(); ++k) {
      if (of.law[k] < 0 || laws_[of.law[k]].definition().kind != TractionKind::pressure) continue;
      work -= area(static_cast<int>(c), static_cast<int>(k)) * of.state[k].work;
    }
  }
  report.add("crack_tractions", NamedEnergy::Kind::stored, stored_sum);
  report.add("crack_separation", NamedEnergy::Kind::dissipated, released_sum);
  report.add("crack_pressure", NamedEnergy::Kind::work, work);
}

void CrackTractions::serialise(StateArchive& archive) {
  for (std::size_t c = 0; c < points_.size(); ++c) {
    const StateArchive::Group group(archive, "tractions_" + std::to_string(c));
    archive.list("law", points_[c].law);
    mpm::serialise(archive, points_[c].state);
    points_[c].force.resize(points_[c].law.size(), Vec2::Zero());
    for (int i = 0; i < 2; ++i) {
      std::vector<double> part;
      for (const Vec2& force : points_[c].force) part.push_back(force[i]);
      archive.list(i == 0 ? "force_x" : "force_z", part);
      for (std::size_t k = 0; k < part.size(); ++k) points_[c].force[k][i] = part[k];
    }
  }
  archive.value("shortest_time", shortest_time_);
}

void CrackTractions::hashed(std::vector<double>& numbers) const {
  for (const Points& of : points_) {
    for (const TractionState& state : of.state) {
      numbers.insert(numbers.end(), {state.largest[0], state.largest[1], state.damage});
    }
  }
}

}  // namespace mpm
