// The modules of a run, and the order in which those that are stages act. Put together when the scene is loaded.
#pragma once

#include <array>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "mpm/step/stage.hpp"

namespace mpm {

class Modules {
 public:
  /// Adds a module that acts across fields, or not on the grid at all.
  template <class M>
  M& add(std::unique_ptr<M> module) {
    static_assert(!std::is_base_of_v<FieldStage, M>, "say in which field: add_in_field()");
    M& added = *module;
    Entry entry;
    if constexpr (std::is_base_of_v<Stage, M>) entry.across = &added;
    entry.module = std::move(module);
    add_entry(std::move(entry));
    return added;
  }
  /// Adds a stage of the velocity field with this number.
  template <class M>
  M& add_in_field(std::unique_ptr<M> stage, int field) {
    M& added = *stage;
    Entry entry;
    entry.in_field = &added;
    entry.field = field;
    entry.module = std::move(stage);
    add_entry(std::move(entry));
    return added;
  }

  /// Calls the stages at a hook, in the order of their ranks.
  void act(Hook hook, StepContext& context) const;
  /// Calls those of one rank alone.
  void act(Hook hook, Rank rank, StepContext& context) const;

  /// For ranks other than the first: what all ranks know counts as 0 here in accounts, energies and numbers.
  void leave_shared_to_first() { leaves_shared_ = true; }
  /// In the order in which they were added.
  const std::vector<Module*>& list() const { return list_; }
  /// Adds the accounts of all modules. Accounts of one name are summed, and so is the momentum that they exchanged.
  void accounts(std::vector<ImpulseAccount>& list) const;
  /// Adds the energies of all modules.
  void energies(EnergyReport& report) const;
  std::vector<NamedNumber> numbers() const;
  /// The first module of this class, or null.
  template <class M>
  M* first() const {
    for (Module* module : list_) {
      if (auto* found = dynamic_cast<M*>(module)) return found;
    }
    return nullptr;
  }
  /// The first module of this name, or null.
  const Module* find(const std::string& name) const;
  /// Serialises each module in a group of its own.
  void serialise(StateArchive& archive);

 private:
  struct Entry {
    std::unique_ptr<Module> module;
    Stage* across = nullptr;         ///< the module, if it acts across fields
    FieldStage* in_field = nullptr;  ///< the module, if it acts in one
    int field = 0;
  };
  /// A stage at a hook.
  struct Call {
    Rank rank;
    Stage* across;
    FieldStage* in_field;
    int field;
  };
  static void carry_out(const Call& call, std::size_t hook, StepContext& context);
  void add_entry(Entry entry);
  /// True if what a module reports counts here.
  bool counts(const Module& module) const { return !(leaves_shared_ && module.same_on_all_ranks()); }
  void put_in_order();

  std::vector<Entry> entries_;
  std::vector<Module*> list_;
  std::array<std::vector<Call>, kHooks> calls_;
  bool leaves_shared_ = false;
};

}  // namespace mpm
