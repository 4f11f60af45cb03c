#include "mpm/crack/j_integral.hpp"

namespace mpm {
namespace {

/// u_i,k without the rotation and the growth of the form.
double turned_back(const JForm& form, const double (&gradient)[2][2], int i, int k) {
  return gradient[i][k] - (i == k ? form.growth : (k - i) * form.rotation);
}

/// rho (a_i u_i,k - v_i v_i,k), with derivatives by undeformed coordinates at large strain.
Vec2 inertia_density(const JForm& form, const AreaSample& sample) {
  const auto& g = sample.values.gradient;
  Vec2 density{0.0, 0.0};
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 2; ++i) {
      double slope = sample.velocity_gradient[i][k];
      if (form.large_strain) {
        for (int j = 0; j < 2; ++j) slope += sample.velocity_gradient[i][j] * g[j][k];
      }
      density[k] += sample.acceleration[i] * turned_back(form, g, i, k) - sample.velocity[i] * slope;
    }
  }
  return sample.density * density;
}

/// Columns of the stress that works on u_i,k: sigma, or at large strain sigma F^-T in the plane.
void working_stress(const JForm& form, const ContourValues& values, double (&stress)[2][2]) {
  const double sigma[2][2] = {{values.xx, values.xz}, {values.xz, values.zz}};
  const auto& g = values.gradient;
  double inverse[2][2] = {{1.0, 0.0}, {0.0, 1.0}};
  if (form.large_strain) {
    const double det = (1.0 + g[0][0]) * (1.0 + g[1][1]) - g[0][1] * g[1][0];
    inverse[0][0] = (1.0 + g[1][1]) / det;
    inverse[0][1] = -g[0][1] / det;
    inverse[1][0] = -g[1][0] / det;
    inverse[1][1] = (1.0 + g[0][0]) / det;
  }
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) stress[i][k] = sigma[i][0] * inverse[k][0] + sigma[i][1] * inverse[k][1];
  }
}

/// Term that the ring adds to the area, by area in the plane (crack reference 4.6). In undeformed coordinates
/// P dA_0 = (r / R) sigma F^-T dA and P_hoop dA_0 = sigma_hoop dA.
Vec2 ring_density(const JForm& form, const AreaSample& sample) {
  const ContourValues& values = sample.values;
  const double stretch = form.large_strain ? 1.0 + values.hoop_gradient : 1.0;
  if (form.kind_at(sample.place) == JForm::Kind::bergkvist_huong) {
    const double density = stretch * (values.energy + form.content * values.pressure + values.kinetic) -
                           values.hoop * values.hoop_gradient;
    return {-density / form.tip_radius, 0.0};
  }
  double stress[2][2];
  working_stress(form, values, stress);
  const auto& g = values.gradient;
  const double radius = sample.place[0] / stretch;
  Vec2 density;
  for (int k = 0; k < 2; ++k) density[k] = -stretch * (stress[0][0] * g[0][k] + stress[1][0] * g[1][k]) / radius;
  density[0] += values.hoop * values.hoop_gradient / radius;
  return density;
}

}  // namespace

double weight_of(const JForm& form, const Vec2& place, const ContourValues& values) {
  if (form.kind_at(place) == JForm::Kind::bergkvist_huong) return place[0] / form.tip_radius;
  return form.about_axis() && form.large_strain ? 1.0 + values.hoop_gradient : 1.0;
}

Vec2 energy_flux(const JForm& form, const ContourValues& values, const Vec2& normal, const Vec2& traction) {
  const double energy = values.energy + form.content * values.pressure + values.kinetic;
  const auto& g = values.gradient;
  Vec2 flux;
  for (int k = 0; k < 2; ++k) {
    const double way = normal[k] + (form.large_strain ? g[0][k] * normal[0] + g[1][k] * normal[1] : 0.0);
    flux[k] = energy * way - traction[0] * turned_back(form, g, 0, k) - traction[1] * turned_back(form, g, 1, k);
  }
  return flux;
}

Vec2 contour_term(const JForm& form, const std::vector<ContourPiece>& pieces) {
  const auto at = [&form](const Vec2& place, const ContourValues& values, const Vec2& normal) -> Vec2 {
    return weight_of(form, place, values) * energy_flux(form, values, normal, values.traction(normal));
  };
  Vec2 sum{0.0, 0.0};
  for (const ContourPiece& piece : pieces) {
    sum += 0.5 * piece.length() * (at(piece.from, piece.first, piece.normal) + at(piece.to, piece.last, piece.normal));
  }
  return sum;
}

Vec2 joining_term(const JForm& form, const std::vector<ContourPiece>& edge) {
  JForm outside = form, inside = form;
  outside.low = outside.high;
  inside.kind = JForm::Kind::broberg;
  return contour_term(inside, edge) - contour_term(outside, edge);
}

double mean_content(const std::vector<AreaSample>& samples) {
  double sum = 0.0, covered = 0.0;
  for (const AreaSample& sample : samples) {
    sum += sample.area * sample.content;
    covered += sample.area;
  }
  return covered > 0.0 ? sum / covered : 0.0;
}

Vec2 area_term(const JForm& form, const std::vector<AreaSample>& samples, double area, bool inertia) {
  Vec2 sum{0.0, 0.0};
  double covered = 0.0;
  for (const AreaSample& sample : samples) {
    covered += sample.area;
    if (inertia) sum += sample.area * weight_of(form, sample.place, sample.values) * inertia_density(form, sample);
    sum += sample.area * weight_of(form, sample.place, sample.values) *
           (sample.free_force + (sample.content - form.content) * sample.pressure_slope);
    if (form.about_axis()) sum += sample.area * ring_density(form, sample);
  }
  if (covered <= 0.0) return {0.0, 0.0};
  return sum * (area / covered);
}

JResult integrate_j(JForm form, const GridLines& lines, const ContourPath& path, const ContourSource& source,
                    const std::vector<AreaSample>& samples, bool inertia, std::vector<ContourPiece>& pieces,
                    bool swells) {
  JResult result;
  result.status = path.status;
  if (path.status != ContourStatus::complete) return result;
  result.status = gather_contour(lines, path, source, pieces, !form.about_axis());
  if (result.status != ContourStatus::complete) return result;
  result.crossing = path.crossing;
  if (inertia && !form.about_axis()) form.rotation = mean_rotation(pieces);
  if (swells && inertia && !form.about_axis()) form.growth = mean_growth(pieces);
  result.rotation = form.rotation;
  result.growth = form.growth;
  JForm outside = form;  // also where the square reaches the contour
  outside.low = outside.high;
  result.contour = contour_term(outside, pieces);
  result.area = area_term(form, samples, path.area(lines), inertia);
  return result;
}

}  // namespace mpm
