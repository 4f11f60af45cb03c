// The tables of the work-precision study: runs are written and read back to the same bits, fronts and costs follow from
// them by their definitions, methods have the work that is counted by hand, and no refusal or failure is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "mpm/choice/front.hpp"
#include "mpm/choice/method_choice.hpp"
#include "study/counted_work.hpp"
#include "study/problems.hpp"
#include "study/runner.hpp"
#include "study/summary.hpp"

namespace mpm::study {
namespace study_tables_test {

using choice::charted_methods;
using choice::ChoiceError;
using choice::cost_at;
using choice::find_method;
using choice::front;
using choice::FrontPoint;
using choice::main_methods;
using choice::MethodChoice;
using choice::transfer_label;

Row ran(const std::string& method, double work, double error) {
  Row row;
  row.suite = "suite";
  row.method = method;
  row.status = "ok";
  row.work = work;
  row.cost = 2.0 * work;
  row.error = error;
  return row;
}

const Cheapest& line(const std::vector<Cheapest>& lines, double target, const std::string& by) {
  for (const Cheapest& one : lines) {
    if (one.target == target && one.by == by) return one;
  }
  throw StudyError("no such line");
}

TEST(StudyRows, ReadBackToTheSameBits) {
  Row row = ran("cpdi/usavg/flip", 1.0 / 3.0, 0.1);
  row.cells = 16;
  row.particles_per_cell = 4;
  row.steps = 12345678901ull;
  row.particles = 4096;
  row.cfl = 0.5;
  row.error_measure = "a, with comma";
  row.message = "said \"no\",\nthen nothing";
  Row failed;
  failed.status = "failed";
  std::stringstream text;
  write_header(text);
  write_row(text, row);
  write_row(text, failed);
  const std::vector<Row> rows = read_rows(text);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].method, row.method);
  EXPECT_EQ(rows[0].work, row.work);
  EXPECT_EQ(rows[0].error, row.error);
  EXPECT_EQ(rows[0].steps, row.steps);
  EXPECT_EQ(rows[0].particles, row.particles);
  EXPECT_EQ(rows[0].cells, 16);
  EXPECT_EQ(rows[0].particles_per_cell, 4);
  EXPECT_EQ(rows[0].error_measure, row.error_measure);
  EXPECT_EQ(rows[0].message, row.message);
  EXPECT_EQ(rows[1].status, "failed");
  EXPECT_TRUE(std::isnan(rows[1].error));
}

TEST(StudyRows, RefuseWhatIsNoTable) {
  std::stringstream header("suite,method\n");
  EXPECT_THROW(read_rows(header), StudyError);
  std::stringstream text;
  write_header(text);
  text << "too,few\n";
  try {
    read_rows(text);
    FAIL();
  } catch (const StudyError& error) {
    EXPECT_EQ(std::string(error.what()), "run 1: 2 cells, not 20");
  }
}

TEST(StudySummary, FrontLeavesOutWhatACheaperRunMatches) {
  const std::vector<FrontPoint> points =
      front({{4.0, 0.1}, {1.0, 0.2}, {2.0, 0.2}, {8.0, 0.3}, {9.0, 0.05}, {5.0, NAN}});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].cost, 1.0);
  EXPECT_EQ(points[1].cost, 4.0);
  EXPECT_EQ(points[2].cost, 9.0);
}

TEST(StudySummary, CostIsStraightInLogLog) {
  // error = 1 / cost^2: at an error of 0.0004 the cost is 50, round-off of a power.
  const std::vector<FrontPoint> points = {{10.0, 0.01}, {100.0, 0.0001}};
  EXPECT_NEAR(*cost_at(points, 0.0004), 50.0, 1e-12);
  EXPECT_EQ(*cost_at(points, 0.5), 10.0);      // the cheapest run is accurate enough
  EXPECT_EQ(*cost_at(points, 0.0001), 100.0);  // just reached
  EXPECT_FALSE(cost_at(points, 0.00009));
  EXPECT_FALSE(cost_at({}, 1.0));
}

TEST(StudySummary, NamesTheCheapestAndTheNext) {
  Row broken = ran("dirac/usf/flip", 0.01, 1e-6);
  broken.status = "failed";
  const std::vector<Cheapest> lines =
      summarise({ran("ugimp/usf/flip", 10.0, 0.2), ran("ugimp/usf/flip", 100.0, 0.02), ran("cpdi/usf/flip", 30.0, 0.05),
                 ran("cpdi/usf/flip", 300.0, 0.005), broken});
  EXPECT_EQ(lines.size(), 8u);  // four targets, by work and by cost
  const Cheapest& ten = line(lines, 0.1, "work");
  EXPECT_EQ(ten.method, "ugimp/usf/flip");
  EXPECT_NEAR(ten.value, 20.0, 1e-12);  // error = 2 / work
  EXPECT_NEAR(ten.reference, 20.0, 1e-12);
  EXPECT_EQ(ten.second, "cpdi/usf/flip");
  EXPECT_EQ(ten.second_value, 30.0);
  EXPECT_NEAR(line(lines, 0.1, "cost").value, 40.0, 1e-12);
  const Cheapest& one = line(lines, 0.01, "work");
  EXPECT_EQ(one.method, "cpdi/usf/flip");
  EXPECT_NEAR(one.value, 150.0, 1e-11);  // error = 1.5 / work
  EXPECT_TRUE(one.second.empty());
  EXPECT_TRUE(std::isnan(one.reference));
  EXPECT_TRUE(line(lines, 0.003, "cost").method.empty());
}

TEST(StudyMethods, CountedWorkIsThatOfTheSteps) {
  const Transfer flip, xpic3 = {TransferKind::xpic, 1.0, 3};
  // By hand from the steps of method reference 5.4, and from 6.6 for a gather and a scatter per order.
  EXPECT_EQ(passes(UpdateScheme::usf, flip), 4);
  EXPECT_EQ(passes(UpdateScheme::usl, flip), 5);
  EXPECT_EQ(passes(UpdateScheme::usavg, flip), 6);
  EXPECT_EQ(passes(UpdateScheme::usavg, xpic3), 10);
  Transfer mixed;
  mixed.flip = 0.6;
  mixed.mixed = 2;
  mixed.every = 5;
  EXPECT_EQ(passes(UpdateScheme::usf, mixed), 4.4);
  EXPECT_EQ(visits(ShapeKind::dirac, 3), 8);
  EXPECT_EQ(visits(ShapeKind::ugimp, 2), 9);
  EXPECT_EQ(visits(ShapeKind::bspline3, 3), 64);
  EXPECT_EQ(visits(ShapeKind::cpdi, 2), 4 * 4);   // corners times nodes of a cell
  EXPECT_EQ(visits(ShapeKind::qcpdi, 2), 9 * 4);  // points times nodes of a cell
  MethodDefinition method;
  method.update = UpdateScheme::usf;
  EXPECT_EQ(counted_work(method, 3), 27.0 * 4.0);
}

TEST(StudyMethods, HaveNamesOfTheirOwn) {
  const std::vector<MethodChoice> all = charted_methods();
  EXPECT_EQ(all.front().label, "ugimp/usf/flip");
  std::set<std::string> labels, shapes, transfers;
  for (const MethodChoice& choice : all) {
    labels.insert(choice.label);
    shapes.insert(shape_name(choice.method.shape));
    transfers.insert(transfer_label(choice.method.transfer));
  }
  EXPECT_EQ(labels.size(), all.size());
  EXPECT_EQ(shapes.size(), kShapeTraits.size());
  EXPECT_EQ(transfers,
            (std::set<std::string>{"flip", "flip0.99", "pic", "xpic2", "xpic3", "fmpm2", "fmpm3", "fmpm5", "apic"}));
  for (const MethodChoice& choice : main_methods()) EXPECT_TRUE(labels.count(choice.label));
  EXPECT_EQ(find_method("ugimp/usavg/flip/single").method.precision, Precision::float32);
  EXPECT_THROW(find_method("ugimp"), ChoiceError);
}

// A wrong letter is one change. More letters of 'ugimp' are missing than present, so no name is near.
TEST(StudyMethods, NameTheNearestFirst) {
  const auto refusal = [](const std::string& label) {
    try {
      find_method(label);
    } catch (const ChoiceError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string start =
      "no method is called 'bspline2/usavg/fmpn2'; did you mean 'bspline2/usavg/fmpm2'? there are ";
  EXPECT_EQ(refusal("bspline2/usavg/fmpn2").substr(0, start.size()), start);
  EXPECT_EQ(refusal("ugimp").find("no method is called 'ugimp'; there are ugimp/usf/flip, "), 0U) << refusal("ugimp");
}

TEST(StudyRunner, MeasuresARunAndItsCost) {
  Runner runner({1, 1e-4});
  const Row row = runner.run(find_suite("bar_small"), find_method("ugimp/usavg/flip"), {8});
  EXPECT_EQ(row.status, "ok");
  EXPECT_EQ(row.particles, 8u * 2u);
  EXPECT_EQ(row.geometry, "line");
  EXPECT_EQ(row.particles_per_cell, 2);
  EXPECT_GT(row.error, 0.0);
  EXPECT_LT(row.error, 1.0);  // it would be 1/sqrt(2) for a bar that does not move
  EXPECT_EQ(row.work, 16.0 * static_cast<double>(row.steps) * 3.0 * 6.0);
  EXPECT_GT(row.relative_cost, 0.0);
  EXPECT_DOUBLE_EQ(row.cost, row.relative_cost * 16.0 * static_cast<double>(row.steps));
}

TEST(StudyRunner, ReportsWhatIsRefusedAndWhatFails) {
  Runner runner({1, 1e-4});
  // A body that starts with a particle outside the grid is refused; one that flies out of it fails.
  Suite suite = find_suite("colliding_disks");
  const auto definition = suite.definition;
  suite.definition = [&](const MethodDefinition& method, const Discretisation& d) {
    SimulationDefinition changed = definition(method, d);
    changed.bodies[0].positions[0].x() = 100.0;
    return changed;
  };
  const Row refused = runner.run(suite, find_method("ugimp/usf/flip"), {8});
  EXPECT_EQ(refused.status, "refused");
  EXPECT_NE(refused.message.find("outside the grid"), std::string::npos);
  EXPECT_TRUE(std::isnan(refused.error));
  EXPECT_TRUE(std::isnan(refused.work));
  suite.definition = [&](const MethodDefinition& method, const Discretisation& d) {
    SimulationDefinition changed = definition(method, d);
    for (Vec3& velocity : changed.bodies[0].velocities) velocity = Vec3(-10.0, 0.0, 0.0);
    return changed;
  };
  const Row failed = runner.run(suite, find_method("ugimp/usf/flip"), {8});
  EXPECT_EQ(failed.status, "failed");
  EXPECT_NE(failed.message.find("outside the domain"), std::string::npos);
  EXPECT_TRUE(std::isnan(failed.error));
}

}  // namespace study_tables_test
}  // namespace mpm::study
