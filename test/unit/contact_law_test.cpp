// Values of a law of contact in a step: one rule wherever surfaces meet. Expected values follow from the functions.
#include "mpm/rigid/contact_law.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mpm {
namespace {

FrictionLaw in_step(const ContactLaw& law, double start, double dt) {
  return law.in_step(start, dt, [] { return std::string("'block' with 'plate'"); });
}

TEST(ContactLaw, ReadsFunctionsAtTheMiddleOfTheStep) {
  ContactLaw law;
  law.friction = Function::parse("0.5 - t");
  EXPECT_DOUBLE_EQ(in_step(law, 0.1, 0.2).coefficient, 0.3);
}

TEST(ContactLaw, RefusesWhatWouldDriveSliding) {
  ContactLaw falling;
  falling.friction = Function::parse("0.5 - t");
  EXPECT_NO_THROW(in_step(falling, 0.3, 0.2));
  EXPECT_THROW(in_step(falling, 0.5, 0.2), FunctionError);
  ContactLaw weak;
  weak.friction = 0.3;
  weak.static_friction = 0.2;
  EXPECT_THROW(in_step(weak, 0.0, 1.0), FunctionError);
  ContactLaw pulls;
  pulls.adhesion = -1.0;
  EXPECT_THROW(in_step(pulls, 0.0, 1.0), FunctionError);
}

}  // namespace
}  // namespace mpm
