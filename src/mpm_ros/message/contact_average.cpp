#include "mpm_ros/message/contact_average.hpp"

#include <type_traits>
#include <utility>

#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {
namespace {

/// Magnitude of the force that `Over::step` compares [N]; pairs do not report one.
double largest_step(const mpm::ContactReport& report) { return report.peak.force.norm(); }
double largest_step(const mpm::PairReport&) { return 0.0; }

/// The mean by weight of two values; one that is not a number has no weight, and must not spread.
Value mean(const Value& a, double weight_a, const Value& b, double weight_b) {
  if (!(weight_b > 0.0)) return a;
  if (!(weight_a > 0.0)) return b;
  return std::visit(
      [&](const auto& first) -> Value {
        using Number = std::decay_t<decltype(first)>;
        return Number((weight_a * first + weight_b * std::get<Number>(b)) / (weight_a + weight_b));
      },
      a);
}

/// `sum` becomes the report over its interval and that of `next`.
template <class Report, class Message>
void join(Report& sum, const Report& next, const std::vector<Quantity<Report, Message>>& quantities) {
  const Report before = sum;
  for (const Quantity<Report, Message>& one : quantities) {
    if (!one.set_report) continue;
    const Value a = one.of_report(before), b = one.of_report(next);
    switch (one.over) {
      case Over::mean:
        one.set_report(sum, mean(a, before.interval, b, next.interval));
        break;
      case Over::place:
        one.set_report(sum, mean(a, before.interval * before.pressing, b, next.interval * next.pressing));
        break;
      case Over::step:
        if (largest_step(next) > largest_step(before)) one.set_report(sum, b);
        break;
      case Over::sum:
        one.set_report(sum, std::get<double>(a) + std::get<double>(b));
        break;
      case Over::start:
      case Over::now:
        one.set_report(sum, b);
        break;
    }
  }
}

template <class Report, class Message>
void serialise_numbers(mpm::StateArchive& archive, Report& report,
                       const std::vector<Quantity<Report, Message>>& quantities) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (!one.set_report) continue;
    Value value = one.of_report(report);
    std::visit([&](auto& number) { archive.value(one.name, number); }, value);
    one.set_report(report, value);
  }
}

}  // namespace

void ContactAverage::add(const Contacts& contacts) {
  if (std::exchange(empty_, false)) {
    sum_ = contacts;
    return;
  }
  for (std::size_t body = 0; body < contacts.bodies.size(); ++body) {
    join(sum_.bodies[body], contacts.bodies[body], contact_quantities());
    sum_.bodies[body].origin = contacts.bodies[body].origin;
  }
  for (std::size_t pair = 0; pair < contacts.pairs.size(); ++pair) {
    join(sum_.pairs[pair], contacts.pairs[pair], pair_quantities());
  }
}

Contacts ContactAverage::take() {
  empty_ = true;
  return std::exchange(sum_, {});
}

void Contacts::serialise(mpm::StateArchive& archive) {
  archive.rows("bodies", bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const mpm::StateArchive::Group group(archive, "body_" + std::to_string(b));
    archive.value("name", bodies[b].body);
    archive.value("origin", bodies[b].origin);
    serialise_numbers(archive, bodies[b], contact_quantities());
  }
  archive.rows("pairs", pairs);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const mpm::StateArchive::Group group(archive, "pair_" + std::to_string(p));
    archive.value("name", pairs[p].name);
    serialise_numbers(archive, pairs[p], pair_quantities());
  }
}

void ContactAverage::serialise(mpm::StateArchive& archive) {
  archive.value("empty", empty_);
  sum_.serialise(archive);
}

}  // namespace mpm_ros
