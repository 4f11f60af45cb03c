// Limit loads against published tables, and against what their derivations say of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/limit_loads.hpp"
#include "study/suite.hpp"

namespace mpm::study {
namespace study_limit_loads_test {

double radians(double degrees) { return degrees * kPi / 180.0; }

// Tables of K_p, N_q and N_c in textbooks (Vesic (1973), J. Soil Mech. Found. Div. 99, table 1), to their last digit.
TEST(LimitLoads, ArePublishedOnes) {
  EXPECT_NEAR(passive_coefficient(radians(30.0)), 3.0, 1e-12);
  EXPECT_NEAR(active_coefficient(radians(30.0)), 1.0 / 3.0, 1e-12);
  struct Row {
    double friction, nq, nc;
  };
  for (const Row& row :
       {Row{20.0, 6.40, 14.83}, Row{30.0, 18.40, 30.14}, Row{35.0, 33.30, 46.12}, Row{40.0, 64.20, 75.31}}) {
    EXPECT_NEAR(bearing_surcharge_factor(radians(row.friction)), row.nq, 0.006) << row.friction;
    EXPECT_NEAR(bearing_cohesion_factor(radians(row.friction)), row.nc, 0.006) << row.friction;
  }
  EXPECT_NEAR(bearing_cohesion_factor(0.0), 5.1416, 5e-5);
  EXPECT_NEAR(bearing_cohesion_factor(1e-5), 5.1416, 1e-3);  // the limit of the general formula
  // Randolph & Houlsby (1984): 9.14 and 11.94.
  EXPECT_NEAR(lateral_pile_factor(0.0), 9.14, 0.005);
  EXPECT_NEAR(lateral_pile_factor(1.0), 11.94, 0.005);
}

// Chen (1975), Limit Analysis and Soil Plasticity, table 5.1: K_p = 6.93 by the log spiral for a vertical wall with
// wall friction = friction = 30 degrees, of the whole force. Kérisel & Absi (1990), Active and Passive Earth Pressure
// Tables: 6.5, 10.5 and 18 for 30, 35 and 40 degrees, between the bounds.
TEST(LimitLoads, BoundsOfARoughWallHoldPublishedValuesBetweenThem) {
  EXPECT_NEAR(rough_wall_coefficient(radians(30.0)).upper / std::cos(radians(30.0)), 6.93, 0.005);
  for (const auto& [friction, whole] : {std::pair{30.0, 6.5}, {35.0, 10.5}, {40.0, 18.0}}) {
    const Bounds bounds = rough_wall_coefficient(radians(friction));
    EXPECT_LT(bounds.lower, whole * std::cos(radians(friction)));
    EXPECT_GT(bounds.upper, whole * std::cos(radians(friction)));
    EXPECT_LT(bounds.upper / bounds.lower, 1.4) << friction;
  }
}

// Soil that the wedge displaces piles up beside it: the triangle between face, contact and the lip, which is as long as
// the contact and falls at (half angle - fan). And at 90 degrees it is Prandtl's punch, (2 + pi) k.
TEST(LimitLoads, WedgePilesUpWhatItDisplaces) {
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    const double beta = radians(degrees);
    const WedgeIndentation wedge = wedge_indentation(beta);
    const double height = wedge.contact * std::sin(beta - wedge.fan);
    const double base = wedge.contact * (std::sin(beta) + std::cos(beta - wedge.fan)) - std::tan(beta);
    EXPECT_NEAR(0.5 * base * height, 0.5 * std::tan(beta), 1e-9) << degrees;
    EXPECT_NEAR(wedge.contact * std::cos(beta) - 1.0, height, 1e-9) << degrees;
  }
  EXPECT_NEAR(wedge_indentation(radians(90.0) - 1e-7).pressure, 2.0 + kPi, 1e-6);
}

// Davis's friction of soil that dilates as much as it rubs is its own; without dilation tan(phi*) = sin(phi).
TEST(LimitLoads, DavisLeavesAssociatedSoilAlone) {
  for (const double degrees : {20.0, 30.0, 40.0}) {
    EXPECT_NEAR(davis_friction(radians(degrees), radians(degrees)), radians(degrees), 1e-12);
    EXPECT_NEAR(std::tan(davis_friction(radians(degrees), 0.0)), std::sin(radians(degrees)), 1e-12);
  }
}

// Janssen's slice: d(sigma_v)/dz = rho g - 2 mu K sigma_v / width, and the wall's pressure is K sigma_v.
TEST(LimitLoads, SiloPressureSolvesJanssensEquation) {
  constexpr double kFriction = 0.4, kRatio = 0.5, kStep = 1e-5;
  for (const double depth : {0.1, 1.0, 3.0}) {
    const double slope =
        (silo_wall_pressure(depth + kStep, kFriction, kRatio) - silo_wall_pressure(depth - kStep, kFriction, kRatio)) /
        (2.0 * kStep);
    EXPECT_NEAR(slope, kRatio - 2.0 * kFriction * kRatio * silo_wall_pressure(depth, kFriction, kRatio), 1e-9);
  }
  EXPECT_NEAR(silo_wall_pressure(100.0, kFriction, kRatio), 1.0 / (2.0 * kFriction), 1e-12);
}

TEST(LimitLoads, SlopeSlidesBeyondItsFriction) {
  EXPECT_EQ(slope_acceleration(radians(29.0), radians(30.0)), 0.0);
  EXPECT_NEAR(9.81 * slope_acceleration(radians(35.0), radians(30.0)), 0.98727, 5e-6);  // by hand
}

// Found by itself: the least force over planes from the foot of a wall that has swept a little soil, which lies as an
// even heap on the wedge of Rankine.
TEST(LimitLoads, SweptSoilOfASmoothBladeIsThatOfTheWeakestWedge) {
  for (const double degrees : {20.0, 30.0, 40.0}) {
    const double friction = radians(degrees);
    const double heap_end = std::tan(0.25 * kPi + 0.5 * friction);  // over the depth
    const auto least_force = [&](double travel) {
      double least = 1e9;
      for (int i = 1; i < 60000; ++i) {
        const double angle = (0.5 * kPi - friction) * i / 60000.0, height = travel / heap_end;
        // The plane z = x tan(angle) leaves the heap at its top, at its end or beyond it.
        double weight = 0.0;
        if ((1.0 + height) / std::tan(angle) < heap_end) {
          weight = 0.5 * (1.0 + height) * (1.0 + height) / std::tan(angle);
        } else if (1.0 / std::tan(angle) > heap_end) {
          weight = 0.5 / std::tan(angle) + travel;
        } else {
          weight = (1.0 + height) * heap_end - 0.5 * heap_end * heap_end * std::tan(angle);
        }
        least = std::min(least, weight * std::tan(angle + friction));
      }
      return least;
    };
    const double growth = (least_force(1e-3) / least_force(0.0) - 1.0) / 1e-3;
    EXPECT_NEAR(growth, swept_soil_growth(friction, false), 0.01 * growth) << degrees;
  }
}

// The arm of a heap lies between that of an even one and that of all its weight at the far end; before a rough wall
// the block reaches further and the heap is lower.
TEST(LimitLoads, SweptSoilOfARoughBladeIsLess) {
  for (const double degrees : {20.0, 30.0, 40.0}) {
    const double smooth = swept_soil_growth(radians(degrees), false), rough = swept_soil_growth(radians(degrees), true);
    EXPECT_GT(rough, 0.5 * smooth) << degrees;
    EXPECT_LT(rough, smooth) << degrees;
  }
}

TEST(LimitLoads, WeightFactorOfAnotherAngleIsRefused) {
  EXPECT_EQ(bearing_weight_factor(radians(30.0), true), 14.75);
  try {
    bearing_weight_factor(radians(25.0), true);
    FAIL();
  } catch (const StudyError& error) {
    EXPECT_STREQ(error.what(), "N_gamma is known for 20, 30 and 40 degrees, not for 25");
  }
}

}  // namespace study_limit_loads_test
}  // namespace mpm::study
