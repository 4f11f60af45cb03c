// Speeds of the waves that absorbing faces absorb: that of pressure is the fastest wave of the undeformed law; the
// others follow from the moduli (Timoshenko & Goodier, Theory of Elasticity).
#include <gtest/gtest.h>

#include <cmath>

#include "material_zoo.hpp"
#include "mpm/boundary/absorbing.hpp"
#include "mpm/material/law.hpp"

namespace mpm {
namespace elastic_waves_test {

/// Elastic law of soil inside its yield surface: soil's own wave speed is a bound that foresees flow.
MaterialDefinition before_flow(MaterialDefinition material) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&material.law)) {
    return {material.name, material.density, LinearElasticDefinition{soil->elasticity}};
  }
  if (const auto* soil = std::get_if<MohrCoulombDefinition>(&material.law)) {
    return {material.name, material.density, LinearElasticDefinition{soil->elasticity}};
  }
  if (const auto* grain = std::get_if<MuIDefinition>(&material.law)) {
    return {material.name, material.density, LinearElasticDefinition{grain->elasticity}};
  }
  if (const auto* sand = std::get_if<NorSandDefinition>(&material.law)) {
    const double shear = sand->shear_modulus * std::pow(sand->least_pressure / 1e5, sand->shear_exponent);
    return {material.name, material.density,
            LinearElasticDefinition{{2.0 * shear * (1.0 + sand->poisson), sand->poisson}}};
  }
  return material;
}

TEST(ElasticWaves, AreThoseOfTheLaws) {
  const Matrix3<double> whole{1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const paths::Specimen& specimen : paths::zoo()) {
    const Law law = make_law(before_flow(specimen.material));
    Symmetric3<double> tau{};
    if (const auto* gas = std::get_if<IdealGasDefinition>(&specimen.material.law)) {
      tau.xx = tau.yy = tau.zz = -gas->pressure / specimen.material.density;  // a gas is never free of stress
    }
    const double fastest =
        std::visit([&](const auto& l) { return static_cast<double>(l.wave_speed(whole, tau, 1.0)); }, law);
    const ElasticWaves waves = elastic_waves(specimen.material, GeometryKind::solid);
    EXPECT_NEAR(waves.pressure, fastest, 1e-6 * fastest) << specimen.material.name;
    EXPECT_LT(waves.shear, waves.pressure) << specimen.material.name;
  }
}

TEST(ElasticWaves, OfAPlateAndOfShear) {
  const MaterialDefinition steel{"steel", 8000.0, LinearElasticDefinition{{2e11, 0.25}}};
  const double shear = std::sqrt(8e10 / 8000.0);  // G = E / 2.5
  EXPECT_NEAR(elastic_waves(steel, GeometryKind::solid).shear, shear, 1e-9 * shear);
  const double plate = std::sqrt(2e11 / (1.0 - 0.0625) / 8000.0);
  EXPECT_NEAR(elastic_waves(steel, GeometryKind::plane_stress).pressure, plate, 1e-9 * plate);
  EXPECT_EQ(elastic_waves({"water", 1000.0, NewtonianFluidDefinition{2e9}}, GeometryKind::solid).shear, 0.0);
}

// With hat functions the particles of a cell give half of its mass to the node of a face. Splines, folded at the wall,
// give their integral over the half line (shape/bspline.hpp), which many particles approximate.
TEST(FaceMass, IsTheWeightOfHalfALine) {
  EXPECT_EQ(face_mass(ShapeKind::ugimp, 2), 0.5);
  // Quadratic: hat to 1/2, then (3/2 - x)^2 / 2: 3/8 + 1/6. Cubic: 1 - x + x^3/6 to 1, then (2 - x)^3 / 6: 13/24 +
  // 1/24.
  EXPECT_NEAR(face_mass(ShapeKind::bspline2, 50), 3.0 / 8.0 + 1.0 / 6.0, 1e-4);
  EXPECT_NEAR(face_mass(ShapeKind::bspline3, 50), 13.0 / 24.0 + 1.0 / 24.0, 1e-4);
}

}  // namespace elastic_waves_test
}  // namespace mpm
