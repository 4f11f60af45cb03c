// The damping of a step: rates as functions of place and time, feedback against the exact solution of its equation, and
// errors that end a run.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/mechanics/damping.hpp"

namespace mpm {
namespace damping_control_test {

using Of = FeedbackDefinition::Of;

Function of(const std::string& expression) { return Function::parse(expression); }

/// Particles at random positions in [0, 1)^2, in plane strain.
struct Plane {
  explicit Plane(int count = 500)
      : fields(make_fields(GridLayout(2, Vec3::Constant(0.1), Vec3::Zero(), Vec3::Ones()))) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    ParticleSet set;
    set.name = "soil";
    set.mass = 0.25;
    set.id.resize(count);
    set.x.resize(2);
    for (auto& x : set.x) x.resize(count);
    for (int p = 0; p < count; ++p) {
      set.id[p] = 10 + count - p;  // ids are not in the order of particles
      for (auto& x : set.x) x[p] = place(random);
    }
    sets.push_back(std::move(set));
  }
  StepContext step(double start, double dt) { return {fields, dt, start}; }
  double mass() const { return sets[0].mass * sets[0].size(); }
  Fields fields;
  Grid& grid = *fields.front();
  std::vector<ParticleSet> sets;
};

std::string refusal(DampingControl& control, const StepContext& context) {
  try {
    control.begin_step(context);
  } catch (const DampingError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DampingControl, RatesAreReadAtTheMiddleOfTheStep) {
  Plane plane;
  DampingDefinition damping;
  damping.grid = of("3*t");
  damping.particle = of("5*t");
  damping.pic = of("0.1*t");
  damping.in_force = false;
  DampingControl control(damping, 1.0, plane.fields, plane.sets, 2);
  control.begin_step(plane.step(2.0, 0.01));
  EXPECT_NEAR(control.rates(0).grid, 3.0 * 2.005, 1e-14);
  EXPECT_NEAR(control.rates(0).particle, 5.0 * 2.005, 1e-14);
  EXPECT_EQ(control.rates(0).grid_of_particle, nullptr);
  EXPECT_NEAR(control.flip(), 1.0 - 0.2005, 1e-15);

  // Damping on the nodes leaves nothing of the grid's rate for the particles.
  damping.in_force = true;
  DampingControl on_nodes(damping, 1.0, plane.fields, plane.sets, 2);
  on_nodes.begin_step(plane.step(2.0, 0.01));
  EXPECT_EQ(on_nodes.rates(0).grid, 0.0);
  EXPECT_NEAR(on_nodes.rates(0).particle, 5.0 * 2.005, 1e-14);

  // Without a PIC fraction of the damping, that of the transfer holds.
  DampingControl plain(DampingDefinition(2.0), 0.9, plane.fields, plane.sets, 1);
  plain.begin_step(plane.step(0.0, 0.01));
  EXPECT_EQ(plain.flip(), 0.9);
  EXPECT_FALSE(plain.in_update() || plain.needs_energy());
}

// Rates are alpha(t + dt/2, x_p), with the same bits for any number of threads. PIC as a function of place is a rate of
// -(1 - beta)/dt on the grid and +(1 - beta)/dt on the particle, with a FLIP fraction of 1: method reference 6.2.
TEST(DampingControl, RatesOfPlaceAreReadAtTheParticles) {
  Plane plane;
  DampingDefinition damping;
  damping.grid = of("3*x+t");
  damping.particle = 2.0;
  damping.pic = of("0.25*z");
  damping.in_force = false;
  const double dt = 0.01;
  DampingControl one(damping, 1.0, plane.fields, plane.sets, 1), three(damping, 1.0, plane.fields, plane.sets, 3);
  one.begin_step(plane.step(1.0, dt));
  three.begin_step(plane.step(1.0, dt));
  EXPECT_EQ(one.flip(), 1.0);
  const DampingRates a = one.rates(0), b = three.rates(0);
  ASSERT_NE(a.grid_of_particle, nullptr);
  ASSERT_NE(a.particle_of_particle, nullptr);
  for (int p = 0; p < plane.sets[0].size(); ++p) {
    const double x = plane.sets[0].x[0][p], z = plane.sets[0].x[1][p];
    EXPECT_NEAR(a.grid_of_particle[p], 3.0 * x + 1.005 - 0.25 * z / dt, 1e-13);
    EXPECT_NEAR(a.particle_of_particle[p], 2.0 + 0.25 * z / dt, 1e-13);
    EXPECT_EQ(a.grid_of_particle[p], b.grid_of_particle[p]);
    EXPECT_EQ(a.particle_of_particle[p], b.particle_of_particle[p]);
  }
}

// A body in translation at v, damped by the feedback of its own energy with target 0:
//   dv/dt = -alpha v,  d alpha/dt = 2 K / m (m v^2 / 2) = K v^2,
// so that v^2 + alpha^2 / K is constant, and v = v0 sech(sqrt(K) v0 t), alpha = sqrt(K) v0 tanh(sqrt(K) v0 t).
TEST(DampingControl, FeedbackFollowsItsExactSolution) {
  Plane plane;
  const double gain = 4.0, v0 = 1.5, end = 0.7, root = std::sqrt(gain) * v0;
  const auto errors = [&](int steps, Of part) {
    DampingDefinition damping;
    damping.feedback = FeedbackDefinition{gain, 0.0, std::numeric_limits<double>::infinity(), part};
    damping.in_force = false;
    DampingControl control(damping, 1.0, plane.fields, plane.sets, 1);
    EXPECT_TRUE(control.in_update() && control.needs_energy());
    const double dt = end / steps;
    double v = v0;
    for (int n = 0; n < steps; ++n) {
      const StepContext context = plane.step(n * dt, dt);
      control.begin_step(context);
      const DampingRates rates = control.rates(0);
      const double rate = part == Of::grid ? rates.grid : rates.particle;
      EXPECT_EQ(part == Of::grid ? rates.particle : rates.grid, 0.0);
      const double energy = 0.5 * plane.mass() * v * v, taken = plane.mass() * rate * v * dt;
      // The other energy is ignored.
      const Damped damped{Vec3(taken, 0.0, 0.0), part == Of::grid ? energy : -1e9, part == Of::grid ? -1e9 : energy};
      v -= rate * v * dt;
      control.end_step(context, damped);
    }
    std::vector<ImpulseAccount> accounts;
    control.accounts(accounts);
    EXPECT_EQ(accounts.at(0).name, "damping");
    EXPECT_NEAR(accounts[0].impulse.x(), plane.mass() * (v - v0), 1e-12 * plane.mass() * v0);
    return std::array<double, 2>{std::abs(v - v0 / std::cosh(root * end)),
                                 std::abs(control.alpha() - root * std::tanh(root * end))};
  };
  for (const Of part : {Of::grid, Of::particle}) {
    const auto coarse = errors(200, part), fine = errors(400, part);
    for (int k = 0; k < 2; ++k) {
      EXPECT_LT(fine[k], 0.01 * v0);               // dt/2 times rates of a few per second
      EXPECT_NEAR(coarse[k] / fine[k], 2.0, 0.1);  // first order
    }
  }
}

// d alpha/dt = 2 K / m (E - E_target): with a given energy alpha is an integral. It stops at the limit and falls again.
TEST(DampingControl, FeedbackKeepsToItsTargetAndLimit) {
  Plane plane;
  DampingDefinition damping;
  damping.feedback = FeedbackDefinition{plane.mass() / 2.0, of("t"), 0.2, Of::grid};
  DampingControl control(damping, 1.0, plane.fields, plane.sets, 1);
  const double dt = 1e-3;
  double largest = 0.0;
  for (int n = 0; n < 2000; ++n) {
    control.begin_step(plane.step(n * dt, dt));
    EXPECT_EQ(control.rates(0).grid, 0.0);                               // it acts in the force
    control.end_step(plane.step(n * dt, dt), {Vec3::Zero(), 1.0, 0.0});  // d alpha/dt = 1 - t
    largest = std::max(largest, control.alpha());
    if (n == 99) {
      EXPECT_NEAR(control.alpha(), 0.1 - 0.1 * 0.1 / 2, 1e-4);  // t - t^2/2, first order in dt
    }
  }
  EXPECT_EQ(largest, 0.2);
  // From 0.2 at t = 1 it falls by (2 - 1)^2 / 2 until t = 2: a negative alpha adds energy below the target.
  EXPECT_NEAR(control.alpha(), 0.2 - 0.5, 2e-3);
}

TEST(DampingControl, ForeseesTheLargestRateOfAPeriod) {
  Plane plane;
  const auto largest = [&](const DampingDefinition& damping, double start, double period, double energy = 0.0) {
    return DampingControl(damping, 1.0, plane.fields, plane.sets, 2)
        .largest_rate(start, period, energy, plane.grid.layout);
  };
  EXPECT_EQ(largest(DampingDefinition(7.0), 0.0, 1.0), 7.0);
  DampingDefinition damping;
  damping.grid = of("10*t");
  damping.particle = 1.0;
  EXPECT_NEAR(largest(damping, 2.0, 0.5), 26.0, 1e-13);  // the largest is at the end
  damping.grid = of("10-10*t");
  EXPECT_NEAR(largest(damping, 0.0, 1.0), 11.0, 1e-13);  // the largest is at the beginning
  damping.grid = of("x");
  damping.in_force = false;
  double farthest = 0.0;
  for (int p = 0; p < plane.sets[0].size(); ++p) farthest = std::max(farthest, plane.sets[0].x[0][p]);
  EXPECT_NEAR(largest(damping, 0.0, 1.0), farthest + 1.0, 1e-14);
  // It grows by 2 K / m E a second, up to the limit.
  DampingDefinition feedback;
  feedback.feedback = FeedbackDefinition{3.0, 0.0, 5.0, Of::grid};
  EXPECT_NEAR(largest(feedback, 0.0, 0.1, 4.0 * plane.mass()), 2.4, 1e-13);
  EXPECT_NEAR(largest(feedback, 0.0, 1.0, 4.0 * plane.mass()), 5.0, 1e-13);
}

// f -= alpha p at every node, and the account is the sum.
TEST(DampingControl, TheForceIsAPartOfTheMomentum) {
  Plane plane;
  plane.grid.rebuild({plane.grid.layout.key({0, 0}), plane.grid.layout.key({0, 1})});
  const int count = 2 * plane.grid.layout.nodes_per_block();
  for (int b = 0; b < plane.grid.blocks.size(); ++b) {
    for (int n = 0; n < count; ++n) {
      plane.grid.momentum.block(b)[n] = 1.0 + n;
      plane.grid.force.block(b)[n] = 0.5;
    }
  }
  DampingDefinition damping;
  damping.grid = of("4*t");
  DampingControl control(damping, 1.0, plane.fields, plane.sets, 2);
  StepContext context = plane.step(0.995, 0.01);
  control.momentum_gathered(context);
  control.forces_gathered(context);
  double sum_x = 0.0;
  for (int b = 0; b < plane.grid.blocks.size(); ++b) {
    for (int n = 0; n < count; ++n) {
      EXPECT_NEAR(plane.grid.force.block(b)[n], 0.5 - 4.0 * (1.0 + n), 1e-12);
      if (n < count / 2) sum_x += 1.0 + n;
    }
  }
  std::vector<ImpulseAccount> accounts;
  control.accounts(accounts);
  EXPECT_NEAR(accounts.at(0).impulse.x(), -4.0 * sum_x * 0.01, 1e-13 * sum_x);
}

TEST(DampingControl, WhatCannotBeEndsTheRun) {
  Plane plane;
  const StepContext context = plane.step(1.0, 0.01);
  DampingDefinition damping;
  damping.grid = of("1-2*t");
  DampingControl negative(damping, 1.0, plane.fields, plane.sets, 1);
  EXPECT_EQ(refusal(negative, context),
            "method.damping at t = 1.005 s: grid is -1.01 1/s: below 0 it drives the motion; write max(0, ...) around "
            "it");
  damping.grid = 200.0;
  DampingControl strong(damping, 1.0, plane.fields, plane.sets, 1);
  EXPECT_EQ(refusal(strong, context)
                .find("method.damping at t = 1.005 s: a rate of 200 1/s turns a velocity round in "
                      "a step of 0.01 s; lower it,"),
            0u);
  damping = {};
  damping.pic = of("2*t");
  DampingControl beyond(damping, 1.0, plane.fields, plane.sets, 1);
  EXPECT_EQ(refusal(beyond, context).find("method.damping at t = 1.005 s: pic is 2.01:"), 0u);

  // A bad rate at particles names the one with the smallest id, for any number of threads.
  damping = {};
  damping.particle = of("x < 0.5 ? sqrt(-1) : 1");
  std::uint32_t first = 1000000;
  for (int p = 0; p < plane.sets[0].size(); ++p) {
    if (plane.sets[0].x[0][p] < 0.5) first = std::min(first, plane.sets[0].id[p]);
  }
  DampingControl one(damping, 1.0, plane.fields, plane.sets, 1), three(damping, 1.0, plane.fields, plane.sets, 3);
  const std::string text = refusal(one, context);
  EXPECT_EQ(text.find("method.damping at particle " + std::to_string(first) + " of 'soil' at ("), 0u) << text;
  EXPECT_NE(text.find("is not finite"), std::string::npos) << text;
  EXPECT_EQ(text, refusal(three, context));
}

}  // namespace damping_control_test
}  // namespace mpm
