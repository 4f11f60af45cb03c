// The contact section of scenes: laws of pairs, velocity fields, normals and detection, and refusals.
#include <gtest/gtest.h>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_contact_test {

/// Three bodies and, with_tool, a tool; the contact section is on line 8.
std::string scene(const std::string& contact, const std::string& tool = "", bool with_tool = true) {
  return "geometry: plane_strain\n"
         "grid: {cell: 0.1, min: [0, 0], max: [2, 2]}\n"
         "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n"
         "bodies:\n"
         "  - {name: a, material: soft, shape: {box: {min: [0, 0], max: [0.5, 0.5]}}}\n"
         "  - {name: b, material: soft, shape: {box: {min: [0.5, 0], max: [1, 0.5]}}}\n"
         "  - {name: c, material: soft, shape: {box: {min: [1, 0], max: [1.5, 0.5]}}}\n"
         "contact: " +
         contact + "\n" +
         (with_tool
              ? "rigid_bodies: [{name: tool, shape: {sphere: {radius: 0.2}}, pose: {position: [1, 1.5]}" + tool + "}]\n"
              : "");
}

Scene read(const std::string& contact, const std::string& tool = "") {
  return parse_scene(scene(contact, tool), "good.yaml");
}

const ContactLaw* law(const Scene& scene, const std::string& first, const std::string& second) {
  for (const PairDefinition& pair : scene.definition.contact.pairs) {
    if (pair.first == first && pair.second == second) return &pair.law;
  }
  return nullptr;
}

void expect_refused(const std::string& contact, const std::string& where, const std::string& what,
                    bool with_tool = true) {
  const std::string start = "bad.yaml:8: contact" + where + ": ";
  try {
    parse_scene(scene(contact, "", with_tool), "bad.yaml");
    FAIL() << "taken: " << contact;
  } catch (const SceneError& error) {
    const std::string found = error.what();
    EXPECT_EQ(found.substr(0, start.size()), start) << found;
    EXPECT_NE(found.find(what), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

TEST(SceneContact, FrictionAloneIsForTools) {
  const Scene read_scene = read("{friction: 0.3}");
  EXPECT_TRUE(read_scene.definition.contact.pairs.empty());
  for (const BodyDefinition& body : read_scene.bodies) EXPECT_EQ(body.field, 0);
  EXPECT_EQ(read_scene.definition.rigid_bodies[0].friction.coefficient, 0.3);
  const FrictionLaw whole =
      read("{friction: 0.3, static_friction: 0.4, adhesion: 2 kPa}").definition.rigid_bodies[0].friction;
  EXPECT_EQ(whole.static_coefficient, 0.4);
  EXPECT_EQ(whole.adhesion, 2000.0);
}

TEST(SceneContact, BodiesOfAPairHaveFieldsOfTheirOwn) {
  const Scene read_scene = read("{pairs: [{between: [b, a], friction: \"0.1*t\", adhesion: 5}]}");
  EXPECT_EQ(read_scene.bodies[0].field, 1);
  EXPECT_EQ(read_scene.bodies[1].field, 2);
  EXPECT_EQ(read_scene.bodies[2].field, 0);
  const ContactLaw* pair = law(read_scene, "a", "b");
  ASSERT_NE(pair, nullptr);
  EXPECT_EQ(pair->friction(2.0), 0.2);
  EXPECT_EQ(pair->at(0.0).adhesion, 5.0);
  // c has no law with the two and sticks to them.
  EXPECT_EQ(law(read_scene, "a", "c")->kind, ContactLaw::Kind::one_field);
  EXPECT_EQ(law(read_scene, "b", "c")->kind, ContactLaw::Kind::one_field);
  EXPECT_EQ(build(read_scene).bodies[1].field, 2);
}

TEST(SceneContact, ANamedLawIsThatOfAllBodies) {
  const Scene read_scene = read("{law: coulomb, friction: 0.2, pairs: [{between: [a, c], friction: stick}]}");
  EXPECT_EQ(read_scene.bodies[0].field, 0);
  EXPECT_EQ(read_scene.bodies[2].field, 2);
  EXPECT_EQ(law(read_scene, "a", "b")->friction(0.0), 0.2);
  EXPECT_EQ(law(read_scene, "a", "c")->kind, ContactLaw::Kind::stick);
  EXPECT_EQ(read_scene.definition.rigid_bodies[0].friction.coefficient, 0.2);
}

TEST(SceneContact, InterfacesNormalsAndDetection) {
  const Scene read_scene = read(
      "{normals: 0, rigid_bias: 5, minimum_volume: 0.5, detection: displacements, pairs: [{between: [a, c], friction: "
      "0.1}, {between: [a, b], law: interface, opened: 2 MPa/m, closed: perfect, tangential: 0}, {between: [b, c], "
      "law: interface, opened: 1, "
      "closed: 3, tangential: perfect}, {between: [c, tool], friction: 0.7}]}",
      ", normals: particles");
  const ContactDefinition& contact = read_scene.definition.contact;
  EXPECT_EQ(contact.normals.method, NormalMethod::larger_gradient);
  EXPECT_EQ(contact.normals.rigid_bias, 5.0);
  EXPECT_EQ(contact.detection.kind, Detection::displacements);
  EXPECT_EQ(contact.detection.minimum_volume, 0.5);
  EXPECT_EQ(law(read_scene, "a", "b")->interface.opened, 2e6);
  EXPECT_LT(law(read_scene, "a", "b")->interface.closed, 0.0);
  EXPECT_LT(law(read_scene, "b", "c")->interface.tangential, 0.0);
  EXPECT_EQ(law(read_scene, "c", "tool")->friction(0.0), 0.7);
  EXPECT_EQ(read("{normals: own, law: stick}").definition.contact.normals.method, NormalMethod::own);
  const DetectionRule usual = read("{friction: 0}").definition.contact.detection;
  EXPECT_EQ(usual.kind, Detection::positions);  // 0.8 cells, as the sources advise
  EXPECT_EQ(usual.position, 0.8);
}

// The manual's Dn is the stiffness across, whether opened or closed, of which Dnt and Dnc take one each.
TEST(SceneContact, OneNormalStiffnessIsOfBothSides) {
  const auto interface_of = [](const std::string& keys) {
    return law(read("{pairs: [{between: [a, b], law: interface, tangential: 1, " + keys + "}]}"), "a", "b")->interface;
  };
  EXPECT_EQ(interface_of("normal: 2 MPa/mm").opened, 2e9);
  EXPECT_EQ(interface_of("normal: 2 MPa/mm").closed, 2e9);
  EXPECT_EQ(interface_of("normal: 2, closed: 5").opened, 2.0);
  EXPECT_EQ(interface_of("normal: 2, closed: 5").closed, 5.0);
  EXPECT_EQ(interface_of("normal: 2, opened: 5").opened, 5.0);
  EXPECT_LT(interface_of("opened: 5").closed, 0.0);  // perfect
  const std::string start = "{pairs: [{between: [a, b], law: ";
  expect_refused(start + "interface, tangential: 1, normal: 1, opened: 1, closed: 1}]}", ".pairs.0.normal",
                 "leave one of the three out");
  expect_refused(start + "coulomb, friction: 0, normal: 1}]}", ".pairs.0.normal", "write law: interface");
}

// Keys that nothing in the scene would read are refused, since a user would believe that they act.
TEST(SceneContact, RefusesWhatNothingReads) {
  for (const char* key : {"friction: 0.3", "static_friction: 0.3", "adhesion: 1"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(':'));
    const std::string pairs = ", pairs: [{between: [a, b], friction: 0.1}]}";
    expect_refused("{" + std::string(key) + pairs, "." + name, "it is of tools, and there are none", false);
    EXPECT_NO_THROW(read("{" + std::string(key) + pairs));
  }
  EXPECT_NO_THROW(parse_scene(scene("{law: coulomb, friction: 0.3}", "", false), "good.yaml"));
  const std::string no_bodies = "it concerns contact between deformable bodies and with rigid bodies of particles";
  for (const char* key : {"normals: 0", "detection: approach", "position: 0.7", "minimum_volume: 0.5"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(':'));
    expect_refused("{friction: 0.3, " + std::string(key) + "}", "." + name, no_bodies);
    expect_refused("{pairs: [{between: [a, b], law: one_field}], " + std::string(key) + "}", "." + name, no_bodies);
    EXPECT_NO_THROW(read("{" + std::string(key) + "}", ", normals: particles"));
    EXPECT_NO_THROW(read("{" + std::string(key) + ", pairs: [{between: [a, b], friction: 0}]}"));
    const std::string with_interface =
        "{" + std::string(key) + ", pairs: [{between: [a, b], law: interface, normal: 1, tangential: 1}]}";
    if (name == "normals") {
      EXPECT_NO_THROW(read(with_interface));
    } else {
      expect_refused(with_interface, "." + name, "the scene's contact is by interfaces alone");
    }
  }
  expect_refused("{rigid_bias: 5, law: stick}", ".rigid_bias", "it concerns rigid bodies of particles");
  EXPECT_NO_THROW(read("{rigid_bias: 5}", ", normals: particles"));
}

TEST(SceneContact, EdgesAreSharpUnlessTheSceneSaysOtherwise) {
  EXPECT_TRUE(read("{friction: 0}").definition.contact.sharp_edges);
  EXPECT_TRUE(read("{edges: sharp}").definition.contact.sharp_edges);
  EXPECT_FALSE(read("{edges: blunt}").definition.contact.sharp_edges);
  expect_refused("{method: nodes, edges: sharp}", ".edges", "it is for contact at points");
}

TEST(SceneContact, RigidBodiesMayBeParticles) {
  EXPECT_TRUE(read("{method: nodes}", ", normals: particles").definition.rigid_bodies[0].particles);
  EXPECT_FALSE(read("{friction: 0}", ", normals: surface").definition.rigid_bodies[0].particles);
  EXPECT_TRUE(read("{method: points}", ", normals: particles").definition.rigid_bodies[0].particles);
  EXPECT_THROW(read("{friction: 0}", ", normals: gradient"), SceneError);
}

TEST(SceneContact, RefusesWhatItCannotMean) {
  expect_refused("{pairs: [{between: [a, d], friction: 0}]}", ".pairs.0.between.1", "no body 'd'");
  expect_refused("{pairs: [{between: [a], friction: 0}]}", ".pairs.0.between", "names of two bodies");
  expect_refused("{pairs: [{between: [a, a], friction: 0}]}", ".pairs.0.between.1", "with itself");
  expect_refused("{pairs: [{between: [a, b], friction: 0}, {between: [b, a], friction: 1}]}", ".pairs.1.between",
                 "a second law for these two");
  expect_refused("{pairs: [{between: [a, b]}]}", ".pairs.0", "coulomb needs friction");
  expect_refused("{pairs: [{between: [a, b], law: interface, opened: 1}]}", ".pairs.0", "tangential");
  expect_refused("{pairs: [{between: [a, b], law: interface, opened: 1, tangential: 1, friction: 0.3}]}",
                 ".pairs.0.friction", "the law interface has none");
  expect_refused("{pairs: [{between: [a, b], friction: 0.3, opened: 1}]}", ".pairs.0.opened", "law: interface");
  expect_refused("{pairs: [{between: [a, b], law: one_field, adhesion: 1}]}", ".pairs.0.adhesion", "leave it out");
  expect_refused("{pairs: [{between: [a, b], friction: -0.3}]}", ".pairs.0.friction", "less than 0");
  expect_refused("{pairs: [{between: [a, b], friction: 0.3, static_friction: 0.2}]}", ".pairs.0.static_friction",
                 "less than the friction of sliding");
  expect_refused("{pairs: [{between: [a, tool], law: one_field}]}", ".pairs.0.law", "for two deformable bodies");
  expect_refused("{law: interface, opened: 1, tangential: 1}", ".law", "not for tools");
  expect_refused("{law: sticky}", ".law", "sticky");
  expect_refused("{normals: 4, law: stick}", ".normals", "4");
  expect_refused("{detection: approach, position: 0.7}", ".position", "detection: positions");
  expect_refused("{friction: 0.3, distance: 1}", ".distance", "distance");
  expect_refused("{friction: \"0.1*t\"}", ".friction", "write functions of time in pairs");
}

}  // namespace scene_contact_test
}  // namespace mpm
