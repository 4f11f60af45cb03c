// Decoupled tractions between the faces of a crack, linear ones and pressure. The formulas asserted are those of crack
// reference 5.5's table; what they are compared with is advance() in small steps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/traction_completion.hpp"
#include "mpm/crack/traction_law.hpp"

namespace mpm::test {
namespace crack_traction_curves_test {

constexpr double kMpa = 1e6, kMm = 1e-3;

/// A curve as the table has it: S and W of the opening, and G_c.
struct TableRow {
  TractionKind kind;
  TractionMode mode;
  std::function<double(double)> strength, work;
  double toughness;
};

TableRow triangular_row() {
  const double s = 10 * kMpa, uc = 0.1 * kMm, ue = 0.02 * kMm;
  TractionMode mode;
  mode.strength = s;
  mode.opening = uc;
  mode.elastic = ue;
  return {TractionKind::triangular, mode, [=](double d) { return s * (uc - d) / (uc - ue); },
          [=](double u) { return 0.5 * s * (u * (uc - u) + uc * (u - ue)) / (uc - ue); }, 0.5 * s * uc};
}

TableRow cubic_row() {
  const double s = 10 * kMpa, uc = 0.1 * kMm, g = 9.0 / 16.0 * s * uc;
  TractionMode mode;
  mode.strength = s;
  mode.opening = uc;
  return {TractionKind::cubic, mode,
          [=](double d) { return 27.0 * s / (4.0 * uc * uc * uc) * d * (uc - d) * (uc - d); },
          [=](double u) {
            const double x = u / uc;
            return g * x * x * (6.0 - 8.0 * x + 3.0 * x * x);
          },
          g};
}

TableRow trilinear_row() {
  const double s1 = 10 * kMpa, u1 = 0.02 * kMm, s2 = 4 * kMpa, u2 = 0.05 * kMm, u3 = 0.1 * kMm;
  TractionMode mode;
  mode.strength = s1;
  mode.elastic = u1;
  mode.strength_2 = s2;
  mode.elastic_2 = u2;
  mode.opening = u3;
  const auto height = [=](double d) {
    return d < u2 ? s1 + (s2 - s1) * (d - u1) / (u2 - u1) : s2 * (u3 - d) / (u3 - u2);
  };
  return {TractionKind::trilinear, mode, height,
          [=](double u) {  // areas of a triangle and of trapezia
            if (u < u2) return 0.5 * s1 * u1 + 0.5 * (s1 + height(u)) * (u - u1);
            return 0.5 * s1 * u1 + 0.5 * (s1 + s2) * (u2 - u1) + 0.5 * (s2 + height(u)) * (u - u2);
          },
          0.5 * (s1 * u2 + s2 * (u3 - u1))};
}

TableRow exponential_row() {
  const double s = 10 * kMpa, uc = 0.1 * kMm, ue = 0.02 * kMm, a = 3.0;
  TractionMode mode;
  mode.strength = s;
  mode.opening = uc;
  mode.elastic = ue;
  mode.decay = a;
  const double rest = std::exp(-a), f = 2.0 * (1.0 / a - rest / (1.0 - rest));
  const auto height = [=](double d) { return s * (std::exp(-a * (d - ue) / (uc - ue)) - rest) / (1.0 - rest); };
  return {TractionKind::exponential, mode, height,
          [=](double u) {  // Simpson's rule, to 1e-12
            const int n = 2000;
            const double h = (u - ue) / n;
            double sum = height(ue) + height(u);
            for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * height(ue + i * h);
            return 0.5 * s * ue + sum * h / 3.0;
          },
          0.5 * s * (ue + f * (uc - ue))};
}

std::vector<TableRow> table() { return {triangular_row(), cubic_row(), trilinear_row(), exponential_row()}; }

TractionLaw law_of(const TableRow& row) {
  TractionLawDefinition definition;
  definition.name = "glue";
  definition.kind = row.kind;
  definition.normal = definition.shear = row.mode;
  return TractionLaw(definition);
}

/// From the state's openings to these, in even steps.
Traction walk(const TractionLaw& law, TractionState& state, double normal, double shear, int steps) {
  const FaceOpening from = state.opening;
  Traction traction;
  for (int i = 1; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    traction = law.advance(from.normal + s * (normal - from.normal), from.shear + s * (shear - from.shear), 0.0, state);
  }
  return traction;
}

// S(u), and W(u) as the work summed; the trapezoid rule errs by less than max|S''| du^2 u / 12 (1e-8 of G_c with 1e4
// steps), and not at all on straight lines whose corners are reached by steps.
TEST(CrackTractionCurves, FollowTheTable) {
  for (const TableRow& row : table()) {
    const TractionLaw law = law_of(row);
    for (const double part : {0.25, 0.4, 0.5, 0.75, 0.95}) {
      const double u = part * row.mode.opening;
      TractionState normal, shear;
      const Traction t_n = walk(law, normal, u, 0.0, 10000);
      const Traction t_t = walk(law, shear, 0.0, -u, 10000);
      const double straight = row.kind == TractionKind::triangular ? 1e-12 : 1e-7;
      EXPECT_NEAR(t_n.normal, row.strength(u), 1e-12 * row.mode.strength) << kTractionKindNames[int(row.kind)];
      EXPECT_EQ(t_n.shear, 0.0);
      EXPECT_EQ(t_t.shear, -t_n.normal);  // the same curve, along the faces and backwards
      EXPECT_EQ(t_t.normal, 0.0);
      EXPECT_NEAR(normal.work, row.work(u), straight * row.toughness) << kTractionKindNames[int(row.kind)] << u;
      EXPECT_NEAR(shear.work, row.work(u), straight * row.toughness);
      // Omega = W - S u / 2
      EXPECT_NEAR(normal.dissipated[0], row.work(u) - 0.5 * row.strength(u) * u, 1e-11 * row.toughness);
      EXPECT_EQ(shear.dissipated[1], normal.dissipated[0]);
    }
  }
}

// The closed forms of Omega, where the table has one.
TEST(CrackTractionCurves, DissipateByClosedForms) {
  const TableRow three = triangular_row(), four = cubic_row(), five = trilinear_row();
  const double u = 0.07 * kMm, x = 0.7;
  TractionState a, b, c;
  law_of(three).advance(u, 0.0, 0.0, a);
  EXPECT_NEAR(a.dissipated[0], three.toughness * (0.07 - 0.02) / (0.1 - 0.02), 1e-12 * three.toughness);
  law_of(four).advance(u, 0.0, 0.0, b);
  EXPECT_NEAR(b.dissipated[0], four.toughness * x * x * x * (4.0 - 3.0 * x), 1e-12 * four.toughness);
  law_of(five).advance(u, 0.0, 0.0, c);
  const double g_2 = 0.5 * 4 * kMpa * 0.1 * kMm, g_1 = five.toughness - g_2;
  EXPECT_NEAR(c.dissipated[0], g_1 + g_2 * (0.07 - 0.05) / (0.1 - 0.05), 1e-12 * five.toughness);
}

TEST(CrackTractionCurves, FailWithTheirToughness) {
  for (const TableRow& row : table()) {
    const TractionLaw law = law_of(row);
    EXPECT_NEAR(law.toughness(CrackMode::normal), row.toughness, 1e-12 * row.toughness);
    TractionState state;
    walk(law, state, 0.9999 * row.mode.opening, 0.0, 9999);
    EXPECT_FALSE(state.failed);
    const Traction after = walk(law, state, 1.0001 * row.mode.opening, 0.0, 2);
    EXPECT_TRUE(state.failed);
    EXPECT_EQ(after.normal, 0.0);
    EXPECT_NEAR(state.dissipated[0], row.toughness, 1e-12 * row.toughness);
    EXPECT_NEAR(state.work, row.toughness, 1e-7 * row.toughness);  // the trapezoid rule's, as above
    EXPECT_EQ(state.freed, 0.0);
    EXPECT_EQ(law.advance(0.01 * kMm, 0.01 * kMm, 0.0, state).shear, 0.0);
    EXPECT_EQ(law.stored(state, 0.01 * kMm, 0.01 * kMm), 0.0);
  }
}

// On straight lines from the origin to u_e and to u_c the trapezoid rule is exact: one step far beyond does G_c of
// work.
TEST(CrackTractionCurves, FailInOneStep) {
  const TableRow row = triangular_row();
  TractionState state;
  law_of(row).advance(3.0 * row.mode.opening, 0.0, 0.0, state);
  EXPECT_TRUE(state.failed);
  EXPECT_NEAR(state.work, row.toughness, 1e-12 * row.toughness);
  EXPECT_NEAR(state.dissipated[0], row.toughness, 1e-12 * row.toughness);
}

// A cubic curve has its peak at a third of its opening and starts with the slope 27 sigma / (4 u_c).
TEST(CrackTractionCurves, HaveTheirPeakAndSlope) {
  const TableRow row = cubic_row();
  TractionState state;
  EXPECT_NEAR(law_of(row).advance(row.mode.opening / 3.0, 0.0, 0.0, state).normal, row.mode.strength,
              1e-12 * row.mode.strength);
  EXPECT_NEAR(law_of(row).stiffness(), 6.75 * 10 * kMpa / (0.1 * kMm), 1.0);
  EXPECT_NEAR(law_of(triangular_row()).stiffness(), 10 * kMpa / (0.02 * kMm), 1.0);
}

// The way back is straight to the origin, and on it nothing is dissipated; the way to the last opening is the same.
TEST(CrackTractionCurves, UnloadToTheOrigin) {
  for (const TableRow& row : table()) {
    const TractionLaw law = law_of(row);
    const double u = 0.6 * row.mode.opening;
    TractionState state;
    walk(law, state, u, 0.0, 1000);
    const double dissipated = state.dissipated[0], work = state.work;
    const Traction half = walk(law, state, 0.5 * u, 0.0, 3);
    EXPECT_NEAR(half.normal, 0.5 * row.strength(u), 1e-12 * row.mode.strength);
    walk(law, state, 0.0, 0.0, 3);
    EXPECT_NEAR(state.work, work - 0.5 * row.strength(u) * u, 1e-12 * row.toughness);
    EXPECT_EQ(state.dissipated[0], dissipated);
    EXPECT_EQ(law.advance(-0.5 * u, 0.0, 0.0, state).normal, 0.0);  // contact's
    EXPECT_NEAR(law.advance(u, 0.0, 0.0, state).normal, row.strength(u), 1e-12 * row.mode.strength);
    EXPECT_NEAR(state.work, work, 1e-12 * row.toughness);  // the closed part of the way does no work
    EXPECT_EQ(state.dissipated[0], dissipated);
  }
}

// Work = stored + dissipated. The trapezoid rule errs by h^2/12 [S'(b) - S'(a)], which is exact for a cubic polynomial
// (Euler and Maclaurin); on straight lines only in the step across a corner.
TEST(CrackTractionCurves, BalanceTheirEnergy) {
  const TableRow cubic = cubic_row();
  const TractionLaw law = law_of(cubic);
  const double uc = cubic.mode.opening, u = 0.8 * uc;
  for (const int steps : {8, 64}) {
    TractionState state;
    walk(law, state, u, 0.0, steps);
    const double h = u / steps, k = law.stiffness();
    const auto slope = [&](double x) { return k * (1.0 - x) * (1.0 - 3.0 * x); };  // slope of k u (1 - u/u_c)^2
    const double error = h * h / 12.0 * (slope(0.8) - slope(0.0));
    EXPECT_GT(std::abs(error), 1e-6 * cubic.toughness);
    EXPECT_NEAR(state.work - error, law.stored(state, u, 0.0) + law.released(state), 1e-12 * cubic.toughness);
  }
  const TableRow lines = triangular_row();
  const TractionLaw other = law_of(lines);
  TractionState state;
  for (const double n : {0.3, 0.5, -0.2, 0.4, 0.6, 0.1}) {  // times u_c; both ways, through the closed crack, any step
    const double t = n > 0.45 ? -0.5 * n : 0.4 * n;
    other.advance(n * lines.mode.opening, t * lines.mode.opening, 0.0, state);
    EXPECT_NEAR(state.work, other.stored(state, n * lines.mode.opening, t * lines.mode.opening) + other.released(state),
                1e-10 * lines.toughness);
  }
  EXPECT_GT(state.dissipated[0], 0.1 * lines.toughness);
}

// Crack reference 5.5, checks: sigma 10 and 20 MPa, u_c 0.1 and 0.2 mm, u_e a tenth: by n = 1 it fails at
// u_n = u_t = 0.07333 mm, where (u - 0.01) / 0.09 + (u - 0.02) / 0.18 = 1. What was stored then is freed.
TEST(CrackTractionCurves, FailByTheRuleOfBothModes) {
  TractionLawDefinition definition;
  definition.normal = {10 * kMpa, 0.1 * kMm, 0.01 * kMm, 0.0, 0.0, 0.0, 0.0};
  definition.shear = {20 * kMpa, 0.2 * kMm, 0.02 * kMm, 0.0, 0.0, 0.0, 0.0};
  const auto fails_at = [&](double mix, TractionState& state) {
    definition.mix = mix;
    const TractionLaw law(definition);
    for (double u = 0.0; !state.failed; u += 1e-5 * kMm) law.advance(u, u, 0.0, state);
    EXPECT_NEAR(state.work, law.released(state), 1e-10 * law.toughness(CrackMode::shear));
    return state.opening.normal;
  };
  TractionState one, two, pure;
  EXPECT_NEAR(fails_at(1.0, one), 0.22 / 3.0 * kMm, 1.1e-5 * kMm);  // a step
  const double u = 0.22 / 3.0;
  EXPECT_NEAR(one.freed, 0.5 * kMpa * kMm * u * (10.0 * (0.1 - u) / 0.09 + 20.0 * (0.2 - u) / 0.18),
              1e-3 * one.freed);  // a step
  // n = 2: ((u - 0.01) / 0.09)^2 + ((u - 0.02) / 0.18)^2 = 1, so 5 u^2 - 0.12 u + 0.0008 = 0.0324
  const double root = (0.12 + std::sqrt(0.0144 + 20.0 * (0.0324 - 0.0008))) / 10.0;
  EXPECT_NEAR(fails_at(2.0, two), root * kMm, 1.1e-5 * kMm);
  EXPECT_NEAR(fails_at(0.0, pure), 0.1 * kMm, 1.1e-5 * kMm);  // fails when one of them has
}

TEST(CrackTractionCurves, SpringsHoldForever) {
  TractionLawDefinition definition;
  definition.kind = TractionKind::linear;
  definition.normal.stiffness = 3e9;
  definition.shear.stiffness = 2e9;
  const TractionLaw law(definition);
  TractionState state;
  const Traction traction = law.advance(0.002, -0.001, 0.0, state);
  EXPECT_DOUBLE_EQ(traction.normal, 6e6);
  EXPECT_DOUBLE_EQ(traction.shear, -2e6);
  EXPECT_DOUBLE_EQ(state.work, 0.5 * (3e9 * 4e-6 + 2e9 * 1e-6));  // 1/2 k u^2
  EXPECT_DOUBLE_EQ(law.stored(state, 0.002, -0.001), state.work);
  EXPECT_EQ(law.advance(-0.002, 0.001, 0.0, state).normal, 0.0);
  EXPECT_DOUBLE_EQ(law.stiffness(), 3e9);
  EXPECT_EQ(law.toughness(CrackMode::normal), std::numeric_limits<double>::infinity());
}

// A negative pressure opens, acts on closed faces too unless there is a least opening, and takes p delta_n from J.
TEST(CrackTractionCurves, PressureFollowsTime) {
  TractionLawDefinition definition;
  definition.kind = TractionKind::pressure;
  definition.pressure = Function::parse("-1e5 * (1 + t)");
  TractionState state;
  const TractionLaw law(definition);
  EXPECT_DOUBLE_EQ(law.advance(-1e-4, 1e-3, 0.0, state).normal, -1e5);
  EXPECT_DOUBLE_EQ(law.advance(2e-4, 1e-3, 1.0, state).normal, -2e5);
  EXPECT_DOUBLE_EQ(law.face_work(state), -2e5 * 2e-4);
  EXPECT_DOUBLE_EQ(state.work, 1e5 * 1e-4 - 2e5 * 3e-4);
  EXPECT_EQ(law.stored(state, 2e-4, 1e-3) + law.released(state) + law.stiffness(), 0.0);
  definition.least_opening = 1e-4;
  const TractionLaw late(definition);
  TractionState other;
  EXPECT_EQ(late.advance(1e-4, 0.0, 0.0, other).normal, 0.0);
  EXPECT_DOUBLE_EQ(late.advance(3e-4, 0.0, 0.0, other).normal, -1e5);
  EXPECT_DOUBLE_EQ(late.face_work(other), -1e5 * 2e-4);  // it acts on the part of the opening beyond the least
}

TEST(CrackTractionCurves, RefuseWhatIsNotALaw) {
  TractionLawDefinition definition;
  definition.name = "glue";
  definition.where = "a.yaml:3: laws[0]";
  try {
    TractionLaw law(definition);
    FAIL() << "a law without numbers";
  } catch (const CrackError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("a.yaml:3: laws[0]: traction law 'glue', normal direction: the strength"), 0u) << text;
  }
  definition.kind = TractionKind::linear;
  definition.shear.stiffness = -1.0;
  EXPECT_THROW(TractionLaw{definition}, CrackError);
  TractionState state;
  const TractionLaw law = law_of(cubic_row());
  EXPECT_THROW(law.advance(std::nan(""), 0.0, 0.0, state), CrackError);
  EXPECT_THROW(TractionCurve(TractionKind::pressure, cubic_row().mode), CrackError);
}

/// Numbers by name in memory.
class TractionMemory final : public StateArchive {
 public:
  bool reading() const override { return reading_; }
  void read() { reading_ = true; }
  std::size_t columns() const { return bytes_.size(); }

 private:
  static std::size_t size_of(Number number) {
    return number == Number::uint8 ? 1 : number == Number::float64 || number == Number::uint64 ? 8 : 4;
  }
  void values(const std::string& name, Number number, void* data, std::size_t count) override {
    std::vector<char>& bytes = bytes_[name];
    if (!reading_) bytes.resize(count * size_of(number));
    ASSERT_EQ(bytes.size(), count * size_of(number));
    std::memcpy(reading_ ? data : bytes.data(), reading_ ? bytes.data() : data, bytes.size());
  }
  std::size_t stored(const std::string& name) override { return bytes_[name].size(); }

  bool reading_ = false;
  std::map<std::string, std::vector<char>> bytes_;
};

TEST(CrackTractionState, IsStoredToTheLastBit) {
  std::vector<TractionState> states(3);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double a = 0.1 + static_cast<double>(i);
    states[i] = {{a + 0.01, a + 0.02}, a + 0.03, {a + 0.04, a + 0.05}, a + 0.06, a + 0.07, {a + 0.08, a + 0.09},
                 {a + 0.11, a + 0.12}, i == 1};
  }
  TractionMemory archive;
  serialise(archive, states);
  EXPECT_EQ(archive.columns(), 13u);  // twelve members, and how many points there are
  archive.read();
  std::vector<TractionState> read;
  serialise(archive, read);
  ASSERT_EQ(read.size(), states.size());
  const auto numbers = [](const TractionState& s) {
    return std::vector<double>{s.largest[0],    s.largest[1],      s.damage,         s.dissipated[0],
                               s.dissipated[1], s.freed,           s.work,           s.opening.normal,
                               s.opening.shear, s.traction.normal, s.traction.shear, s.failed ? 1.0 : 0.0};
  };
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(numbers(read[i]), numbers(states[i]));
}

}  // namespace crack_traction_curves_test
}  // namespace mpm::test
