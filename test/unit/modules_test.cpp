// The order in which the stages of a run act (step/order.hpp, step/modules.hpp), and the fields that each receives.
#include "mpm/step/modules.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace modules_test {

using Said = std::vector<std::string>;

/// A stage that records its name at the hooks for updated momentum and for the increment.
template <class Context>
class Saying final : public StageWith<Context> {
 public:
  Saying(std::string name, Rank first, std::optional<Rank> again, Said& said)
      : name_(std::move(name)), ranks_{first, again}, said_(said) {}
  std::string name() const override { return name_; }
  Ranks ranks(Hook hook) const override { return hook == Hook::momentum_updated ? ranks_ : Ranks{ranks_.first}; }
  void momentum_updated(Context& context) override { say(context); }
  void increment_found(Context& context) override { say(context); }
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back({"both", Vec3::UnitX(), 1.0}); }

 private:
  void say(const StepContext&) { said_.push_back(name_); }
  void say(const FieldContext& context) { said_.push_back(name_ + std::to_string(context.grid.first_owner)); }
  std::string name_;
  Ranks ranks_;
  Said& said_;
};

/// Two fields with different numbers of their first owners, which identify them.
Fields two_fields() {
  Fields fields = make_fields(GridLayout(2, Vec3::Ones(), Vec3::Zero(), Vec3::Constant(8.0)), 2);
  fields[1]->first_owner = 1;
  return fields;
}

// Walls and other constraints act before contact and again after it, in each of two fields. The order in which stages
// were added matters only among stages of one rank.
TEST(Modules, ActByRank) {
  for (const bool contact : {false, true}) {
    Fields fields = two_fields();
    Said said;
    Modules modules;
    modules.add(std::make_unique<Saying<StepContext>>("load", Rank::load, std::nullopt, said));
    if (contact) modules.add(std::make_unique<Saying<StepContext>>("tool", Rank::rigid_body, std::nullopt, said));
    for (int f = 0; f < 2; ++f) {
      modules.add_in_field(std::make_unique<Saying<FieldContext>>("lid", Rank::condition, Rank::condition_again, said),
                           f);
    }
    for (int f = 0; f < 2; ++f) {
      modules.add_in_field(std::make_unique<Saying<FieldContext>>("wall", Rank::wall, Rank::wall_again, said), f);
    }
    StepContext context{fields, 1.0};
    modules.act(Hook::momentum_updated, context);
    if (contact) {
      EXPECT_EQ(said, (Said{"wall0", "wall1", "lid0", "lid1", "tool", "wall0", "wall1", "lid0", "lid1", "load"}));
    } else {
      EXPECT_EQ(said, (Said{"wall0", "wall1", "lid0", "lid1", "load"}));
    }
    said.clear();
    modules.act(Hook::increment_found, context);
    EXPECT_EQ(said.size(), contact ? 6u : 5u);
    modules.act(Hook::forces_gathered, context);
    EXPECT_EQ(said.size(), contact ? 6u : 5u);
  }
}

TEST(Modules, AccountsOfOneNameBecomeOne) {
  Said said;
  Modules modules;
  for (int f = 0; f < 2; ++f) {
    modules.add_in_field(std::make_unique<Saying<FieldContext>>("wall", Rank::wall, std::nullopt, said), f);
  }
  std::vector<ImpulseAccount> accounts;
  modules.accounts(accounts);
  ASSERT_EQ(accounts.size(), 1u);
  EXPECT_EQ(accounts[0].impulse.x(), 2.0);
  EXPECT_EQ(accounts[0].exchanged, 2.0);
}

// Energies of one name become one; totals go by kind, not by name.
TEST(Modules, EnergiesAreSummedByKind) {
  using Kind = NamedEnergy::Kind;
  EnergyReport report;
  report.add("kinetic", Kind::stored, 1.0);
  report.add("surface", Kind::stored, 2.0);
  report.add("lost", Kind::dissipated, 4.0);
  report.add("done", Kind::work, 8.0);
  report.add("ball", Kind::of_bodies, 16.0);
  report.add("surface", Kind::stored, 32.0);
  EXPECT_EQ(report.of("surface"), 34.0);
  EXPECT_EQ(report.of("none"), 0.0);
  EXPECT_EQ(report.list().size(), 5u);
  EXPECT_EQ(report.total(), 35.0);
  EXPECT_EQ(report.whole(), 51.0);
}

}  // namespace modules_test
}  // namespace mpm
