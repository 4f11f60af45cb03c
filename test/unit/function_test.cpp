// Functions of time and place: values worked out by hand, and refused expressions.
#include "mpm/math/function.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mpm {
namespace function_test {

std::string refusal(const std::string& expression) {
  try {
    Function::parse(expression);
  } catch (const FunctionError& error) {
    return error.what();
  }
  return "";
}

TEST(Function, TellsWhatTheParserFoundFromWhatMayBeWritten) {
  const std::string text = refusal("t<");
  EXPECT_EQ(text.find("expression 't<' does not parse: "), 0U) << text;
  EXPECT_NE(text.find("; an expression may use t, x, y, z"), std::string::npos) << text;
}

TEST(Function, DefaultsToZeroAndHoldsConstants) {
  EXPECT_EQ(Function()(3.0), 0.0);
  EXPECT_EQ(Function(2.5)(3.0, Vec3(1, 2, 3)), 2.5);
  EXPECT_TRUE(Function(2.5).is_constant());
}

TEST(Function, ReadsTimeAndPlace) {
  EXPECT_EQ(Function::parse("2*t + x - y*z")(0.5, Vec3(3, 4, 5)), 1.0 + 3.0 - 20.0);
  EXPECT_FALSE(Function::parse("2*t").is_constant());
  // sin(pi/6) = 1/2 and log(e) = 1, to the last digits of the library's functions.
  EXPECT_NEAR(Function::parse("sin(pi/6)")(0.0), 0.5, 1e-15);
  EXPECT_NEAR(Function::parse("ln(e)")(0.0), 1.0, 1e-15);
}

TEST(Function, HasComparisonsAndChoice) {
  const Function pulse = Function::parse("0.1*(t<1)");
  EXPECT_EQ(pulse(0.999), 0.1);
  EXPECT_EQ(pulse(1.0), 0.0);
  const Function steps = Function::parse("t < 0.2 ? -0.01 : t >= 0.5 && x != 0 ? 7 : 0");
  EXPECT_EQ(steps(0.1), -0.01);
  EXPECT_EQ(steps(0.3), 0.0);
  EXPECT_EQ(steps(0.5, Vec3(1, 0, 0)), 7.0);
}

TEST(Function, TakesAndGivesValuesInItsUnits) {
  // Result in mm/s, time in ms and place in mm: at 2 ms and 3 mm, 2 + 3 = 5 mm/s.
  const Function f = Function::parse("t + x", {1e-3, 1e-3, 1e-3});
  // Three roundings of a few units in the last place.
  EXPECT_NEAR(f(2e-3, Vec3(3e-3, 0, 0)), 5e-3, 1e-17);
}

TEST(Function, CopiesAreValues) {
  Function f = Function::parse("t");
  const Function copy = f;
  f = Function(9.0);
  EXPECT_EQ(copy(4.0), 4.0);
  EXPECT_EQ(f(4.0), 9.0);
  EXPECT_EQ(copy.text(), "t");
}

TEST(Function, ReadsThePlaceAtTheStartWhereToldTo) {
  const Function f = Function::parse("x - X + 10*(y - Y) + Z", {1.0, 1.0, 1e-3}, FunctionPlaces::present_and_start);
  EXPECT_TRUE(f.uses_start());
  // Places in mm: (3 - 1) + 10 (5 - 2) + 7.
  EXPECT_NEAR(f(0.0, Vec3(3e-3, 5e-3, 0), Vec3(1e-3, 2e-3, 7e-3)), 39.0, 1e-13);
  EXPECT_FALSE(Function::parse("x", {}, FunctionPlaces::present_and_start).uses_start());
  EXPECT_FALSE(Function(2.0).uses_start());
  EXPECT_NE(refusal("X").find("unknown name 'X'; write 'x'"), std::string::npos) << refusal("X");
}

TEST(Function, AnOwnCopyIsTheSameFunction) {
  const Function f = Function::parse("t*x + X", {2.0, 3.0, 4.0}, FunctionPlaces::present_and_start);
  const Function copy = f.own_copy();
  const Vec3 place(1.0, 2.0, 3.0), start(5.0, 6.0, 7.0);
  EXPECT_EQ(copy(0.7, place, start), f(0.7, place, start));
  EXPECT_EQ(copy.text(), f.text());
  EXPECT_EQ(Function(3.0).own_copy()(0.0), 3.0);
}

TEST(Function, NamesAnUnknownVariableWithAHint) {
  EXPECT_NE(refusal("2*time").find("unknown name 'time'; write 't'"), std::string::npos) << refusal("2*time");
  EXPECT_NE(refusal("q + 1").find("unknown name 'q'; an expression may use t, x, y, z"), std::string::npos);
}

// The parser's own '=' assigns to t, and all later values of the function are others.
TEST(Function, RefusesToAssign) {
  for (const char* bad : {"t=1 ? -0.1 : 0.3", "x=y", "y = 3", "t==1 ? x=2 : 0", "(t = 2) + 1"}) {
    EXPECT_NE(refusal(bad).find("'=' would assign, which no expression may; write '=='"), std::string::npos) << bad;
  }
  const Function f = Function::parse("t==1 ? -0.1 : x<=2 && x>=1 && y!=0 ? 7 : 0.3");
  EXPECT_EQ(f(1.0), -0.1);
  EXPECT_EQ(f(2.0, Vec3(1.5, 1, 0)), 7.0);
  EXPECT_EQ(f(2.0), 0.3);
}

TEST(Function, UsesConstantsByName) {
  const NamedConstants constants = {{"slip", 0.2}, {"v", 0.4}};
  const Function f = Function::parse("v*(1 - slip)*t", {}, FunctionPlaces::present, constants);
  EXPECT_NEAR(f(2.0), 0.64, 1e-15);
  EXPECT_EQ(f.own_copy()(2.0), f(2.0));
  EXPECT_TRUE(f.uses_time());
  EXPECT_FALSE(f.uses_place());
  EXPECT_TRUE(Function::parse("x + t").uses_place(0));
  EXPECT_FALSE(Function::parse("x + t").uses_place(1));
  try {
    Function::parse("slib*t", {}, FunctionPlaces::present, constants);
    FAIL();
  } catch (const FunctionError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("unknown name 'slib'; did you mean 'slip'?"), std::string::npos) << text;
    EXPECT_NE(text.find("the scene's constants slip, v"), std::string::npos) << text;
  }
  EXPECT_EQ(meaning_in_expressions("t"), "the time");
  EXPECT_EQ(meaning_in_expressions("sin"), "a function");
  EXPECT_EQ(meaning_in_expressions("slip"), "");
  EXPECT_EQ(names_in_expression("2e3*a1 + sin(_b)*1.5e-2-e"), (std::vector<std::string>{"a1", "sin", "_b", "e"}));
}

TEST(Function, RefusesWhatDoesNotParse) {
  for (const char* bad : {"2*(t", "", "t +", "1, 2", "sin()", "\"t\"", "t ? 1", "= 3"}) {
    EXPECT_NE(refusal(bad), "") << bad;
  }
}

TEST(Function, RefusesAValueThatIsNotFinite) {
  const Function f = Function::parse("1/x");
  EXPECT_EQ(f(0.0, Vec3(4, 0, 0)), 0.25);
  EXPECT_THROW(f(0.0, Vec3::Zero()), FunctionError);
  EXPECT_THROW(Function::parse("sqrt(-1)")(0.0), FunctionError);
}

}  // namespace function_test
}  // namespace mpm
