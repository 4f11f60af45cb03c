// The keys of each law, with units and refusals.
#include <gtest/gtest.h>

#include <algorithm>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_materials_test {

Scene scene_of(const std::string& material) {
  return parse_scene(
      "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
      "materials:\n"
      "  - {name: m, " +
          material +
          "}\n"
          "bodies:\n"
          "  - {name: block, material: m, shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}}\n",
      "a.yaml", {});
}

template <class Definition>
Definition law_of(const std::string& material) {
  return std::get<Definition>(scene_of(material).definition.materials.at(0).law);
}

// The text of a refusal after file and line.
std::string refusal(const std::string& material) {
  try {
    scene_of(material);
  } catch (const SceneError& error) {
    const std::string text = error.what(), start = "a.yaml:3: materials.m";
    EXPECT_EQ(text.rfind(start, 0), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text.substr(start.size());
  }
  return "";
}

TEST(SceneMaterials, Metal) {
  const std::string start = "density: 2700, law: j2_plasticity, young: 70 GPa, poisson: 0.33, yield_stress: 250 MPa";
  const auto plain = law_of<J2PlasticityDefinition>(start);
  EXPECT_EQ(plain.elasticity.young, 7e10);
  EXPECT_EQ(plain.yield_stress, 250e6);
  EXPECT_EQ(plain.hardening_modulus, 0.0);
  EXPECT_EQ(plain.saturation_rate, 0.0);
  const auto hardening = law_of<J2PlasticityDefinition>(
      start + ", hardening_modulus: 1 GPa, saturation_stress: 300 MPa, saturation_rate: 12");
  EXPECT_EQ(hardening.hardening_modulus, 1e9);
  EXPECT_EQ(hardening.saturation_stress, 300e6);
  EXPECT_EQ(hardening.saturation_rate, 12.0);
  EXPECT_EQ(refusal(start + ", saturation_rate: 12"),
            ": saturation_stress and saturation_rate go together; write both or neither");
  EXPECT_EQ(refusal(start + ", saturation_stress: 200 MPa, saturation_rate: 12"),
            ".saturation_stress: saturation stress is 2e+08 Pa; it must be finite and not below the yield stress, "
            "2.5e+08 Pa");
  EXPECT_EQ(refusal("density: 2700, law: j2_plasticity, young: 70 GPa, poisson: 0.33"),
            ": the key 'yield_stress' is missing; add it");
  EXPECT_EQ(refusal(start + ", hardening_moduli: 1 GPa"),
            ".hardening_moduli: unknown key 'hardening_moduli'; did you mean 'hardening_modulus'?");
}

TEST(SceneMaterials, Fluid) {
  const std::string start = "density: 1000, law: newtonian_fluid";
  const Scene scene = scene_of(start + ", sound_speed: 20 m/s, viscosity: 1e-3 Pa s");
  const auto water = std::get<NewtonianFluidDefinition>(scene.definition.materials.at(0).law);
  EXPECT_EQ(water.bulk_modulus, 4e5);  // rho c^2
  EXPECT_EQ(water.viscosity, 1e-3);
  EXPECT_EQ(water.exponent, 7.0);
  EXPECT_FALSE(water.tension);
  bool recorded = false;
  for (const auto& [key, choice] : scene.choices) recorded = recorded || key == "materials.m.tension";
  EXPECT_TRUE(recorded);
  const auto other = law_of<NewtonianFluidDefinition>(start + ", bulk_modulus: 2.2 GPa, exponent: 1, tension: allow");
  EXPECT_EQ(other.bulk_modulus, 2.2e9);
  EXPECT_EQ(other.exponent, 1.0);
  EXPECT_TRUE(other.tension);
  const std::string one = ": write exactly one of bulk_modulus and sound_speed";
  EXPECT_EQ(refusal(start), one);
  EXPECT_EQ(refusal(start + ", sound_speed: 20, bulk_modulus: 4e5"), one);
  EXPECT_EQ(refusal(start + ", sound_speed: 20, viscosity: 1 Pa"),
            ".viscosity: '1 Pa' is a pressure, but a viscosity is expected; write one such as 1 Pa s");
  EXPECT_EQ(refusal(start + ", sound_speed: 20, young: 1 MPa").rfind(".young: unknown key 'young'", 0), 0u);
  EXPECT_EQ(refusal(start + ", sound_speed: 20, tension: some").rfind(".tension: 'some' is not known", 0), 0u);
}

TEST(SceneMaterials, Gas) {
  const std::string start = "density: 1.2, law: ideal_gas, pressure: 1 bar";
  const auto air = law_of<IdealGasDefinition>(start + ", temperature: 293 K");
  EXPECT_EQ(air.pressure, 1e5);
  EXPECT_EQ(air.temperature, 293.0);
  EXPECT_EQ(air.heat_capacity_ratio, 1.4);
  EXPECT_EQ(air.process, GasProcess::adiabatic);
  const auto other =
      law_of<IdealGasDefinition>(start + ", temperature: 300, heat_capacity_ratio: 1.67, process: isothermal");
  EXPECT_EQ(other.heat_capacity_ratio, 1.67);
  EXPECT_EQ(other.process, GasProcess::isothermal);
  EXPECT_EQ(refusal(start + ", temperature: -20"),
            ".temperature: temperature is -20 K; it is absolute and must be positive and finite");
  EXPECT_EQ(refusal(start + ", temperature: 20 degC").rfind(".temperature: unknown unit 'degC'", 0), 0u);
  EXPECT_EQ(refusal(start + ", temperature: 293, heat_capacity_ratio: 1"),
            ".heat_capacity_ratio: heat capacity ratio is 1; it must be finite and above 1");
}

TEST(SceneMaterials, ViscoelasticSolid) {
  const std::string start = "density: 100, law: viscoelastic, young: 20 kPa, poisson: 0.3, branch_modulus: 10 kPa";
  const auto foam = law_of<StandardLinearSolidDefinition>(start + ", relaxation_time: 50 ms");
  EXPECT_EQ(foam.elasticity.young, 2e4);
  EXPECT_EQ(foam.branch_modulus, 1e4);
  EXPECT_EQ(foam.relaxation_time, 0.05);
  EXPECT_EQ(refusal(start + ", relaxation_time: 0"),
            ".relaxation_time: relaxation time is 0 s; it must be positive and finite");
  EXPECT_EQ(refusal(start), ": the key 'relaxation_time' is missing; add it");
}

TEST(SceneMaterials, MetalUnderImpact) {
  const std::string least =
      "density: 7850, law: johnson_cook, shear_modulus: 77.3 GPa, C0: 3574 m/s, S: 1.92, gamma0: 1.69, A: 1.5 GPa, "
      "heat_capacity: 477 J/(kg K)";
  const auto plain = law_of<JohnsonCookDefinition>(least);
  EXPECT_EQ(plain.shear_modulus, 77.3e9);
  EXPECT_EQ(plain.pressure.sound_speed, 3574.0);
  EXPECT_EQ(plain.pressure.hugoniot_slope, 1.92);
  EXPECT_EQ(plain.pressure.gamma0, 1.69);
  EXPECT_EQ(plain.yield_stress, 1.5e9);
  EXPECT_EQ(plain.hardening, 0.0);
  EXPECT_EQ(plain.rate_sensitivity, 0.0);
  EXPECT_EQ(plain.melting_temperature, 0.0);  // none
  EXPECT_EQ(plain.reference_temperature, 293.0);
  EXPECT_EQ(plain.heat_capacity, 477.0);
  EXPECT_EQ(plain.heat_fraction, 0.9);
  const Scene scene = scene_of(least + ", C: 0.003");
  for (const char* key : {"reference_rate", "reference_temperature", "melting_temperature"}) {
    const auto recorded = [&](const auto& choice) { return choice.first == std::string("materials.m.") + key; };
    EXPECT_EQ(std::count_if(scene.choices.begin(), scene.choices.end(), recorded), 1) << key;
  }
  const auto all = law_of<JohnsonCookDefinition>(
      least +
      ", B: 569 MPa, n: 0.22, C: 0.003, reference_rate: 10 1/s, m: 1.17, melting_temperature: 1777 K, "
      "reference_temperature: 300 K, heat_fraction: 0.8");
  EXPECT_EQ(all.hardening, 569e6);
  EXPECT_EQ(all.hardening_exponent, 0.22);
  EXPECT_EQ(all.rate_sensitivity, 0.003);
  EXPECT_EQ(all.reference_rate, 10.0);
  EXPECT_EQ(all.softening_exponent, 1.17);
  EXPECT_EQ(all.melting_temperature, 1777.0);
  EXPECT_EQ(all.reference_temperature, 300.0);
  EXPECT_EQ(all.heat_fraction, 0.8);
  EXPECT_EQ(refusal(least + ", B: 1 GPa"), ": B and n go together; write both or neither");
  const std::string melting =
      ": m and melting_temperature go together: strength falls from reference_temperature to melting_temperature; "
      "write both, or neither for a metal that heat neither softens nor melts";
  EXPECT_EQ(refusal(least + ", m: 1"), melting);
  EXPECT_EQ(refusal(least + ", melting_temperature: 1777 K"), melting);
  EXPECT_EQ(refusal(least + ", m: 1, melting_temperature: 200 K"),
            ".melting_temperature: melting temperature is 200 K; it must be finite and above the reference "
            "temperature, 293 K");
  EXPECT_EQ(refusal(least + ", B: 1 GPa, n: 1.2"), ".n: n is 1.2; it must lie above 0 and not above 1");
  EXPECT_EQ(refusal(least + ", heat_fraction: 2"), ".heat_fraction: heat fraction is 2; it must lie from 0 to 1");
  EXPECT_EQ(refusal("density: 7850, law: johnson_cook, shear_modulus: 77 GPa, C0: 0, S: 2, gamma0: 2, A: 1 GPa, "
                    "heat_capacity: 477"),
            ".C0: C0 is 0 m/s; it must be positive and finite");
  EXPECT_EQ(refusal("density: 7850, law: johnson_cook, shear_modulus: 77 GPa, C0: 1, S: 2, gamma0: 2, A: 1 GPa, "
                    "heat_capacity: 477 J"),
            ".heat_capacity: '477 J' is an energy, but a heat capacity is expected; write one such as 450 J/(kg K)");
}

TEST(SceneMaterials, ALawIsNamed) {
  EXPECT_EQ(refusal("density: 1000, young: 1 MPa, poisson: 0.3"), ": the key 'law' is missing; add it");
  EXPECT_EQ(refusal("density: 1000, law: j2_plastic"),
            ".law: 'j2_plastic' is not known; did you mean 'j2_plasticity'?");
  EXPECT_EQ(refusal("density: 1000, law: rigid"),
            ".law: 'rigid' is not built yet; a rigid body is not a material: write it under rigid_bodies");
}

}  // namespace scene_materials_test
}  // namespace mpm
