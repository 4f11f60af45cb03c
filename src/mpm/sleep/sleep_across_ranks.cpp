#include "mpm/sleep/sleep_across_ranks.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <utility>

#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

// Reason why a rank names a block to the others.
enum What : std::int32_t { kAny, kWakes, kFallsAsleep, kAsksForces, kAsksMeans };

/// Forces that a rank's part of a block gives to the grid.
struct Part {
  std::uint64_t key;
  std::int32_t field;
  double rate;
  BlockForces forces;
};

}  // namespace

SleepAcrossRanks::Agreed SleepAcrossRanks::agree(bool any, const std::vector<BlockName>& falling,
                                                 std::vector<BlockName>& to_wake) {
  std::vector<Told> own;
  if (any) own.push_back({0, 0, kAny});
  for (const BlockName& name : to_wake) own.push_back({name.key, name.field, kWakes});
  for (const BlockName& name : falling) own.push_back({name.key, name.field, kFallsAsleep});
  const std::vector<Communicator::Bytes> all = ranks().gather(bytes_of(own));
  to_wake.clear();
  std::vector<std::pair<BlockName, int>> falls;  // and on which rank
  for (int rank = 0; rank < ranks().size(); ++rank) {
    for (const Told& told : list_of<Told>(all[rank])) {
      const BlockName name{told.field, told.key};
      any = any || told.what == kAny;
      if (told.what == kWakes) to_wake.push_back(name);
      if (told.what == kFallsAsleep) falls.emplace_back(name, rank);
    }
  }
  sort_names(to_wake);
  Agreed agreed{any, false};
  for (const auto& [name, rank] : falls) {
    if (std::binary_search(to_wake.begin(), to_wake.end(), name)) continue;
    agreed.falls = true;
    if (rank != ranks().rank()) elsewhere_.insert(name);
    asleep_.forget_whole(name);  // more of it sleeps now
  }
  for (const BlockName& name : to_wake) {
    elsewhere_.erase(name);
    asleep_.forget_whole(name);
  }
  return agreed;
}

void SleepAcrossRanks::begin_anew() {
  elsewhere_.clear();
  knows_all_ = true;
  std::vector<Told> own;
  for (const auto& one : asleep_.all()) own.push_back({one.first.key, one.first.field, kFallsAsleep});
  const std::vector<Communicator::Bytes> all = ranks().gather(bytes_of(own));
  for (int rank = 0; rank < ranks().size(); ++rank) {
    if (rank == ranks().rank()) continue;
    for (const Told& told : list_of<Told>(all[rank])) elsewhere_.insert({told.field, told.key});
  }
}

void SleepAcrossRanks::add_met(std::vector<BlockName>& names) const {
  const int fields = static_cast<int>(fields_.size());
  for (int of = 0; of < fields && !elsewhere_.empty(); ++of) {
    const BlockTable& blocks = fields_[of]->blocks;
    for (int b = 0; b < blocks.size() && fields > 1; ++b) {
      for (int f = 0; f < fields; ++f) {
        if (f != of && elsewhere_.count({f, blocks.key(b)}) != 0) names.push_back({f, blocks.key(b)});
      }
    }
  }
}

SleepAcrossRanks::Names SleepAcrossRanks::find_around() const {
  Names around;
  for (std::size_t f = 0; f < fields_.size() && !elsewhere_.empty(); ++f) {
    const BlockTable& blocks = fields_[f]->blocks;
    const GridLayout& layout = blocks.layout();
    for (int b = 0; b < blocks.size(); ++b) {
      for (int side = 0; side < neighbours_of(layout.dim()); ++side) {
        const BlockName name{static_cast<int>(f), layout.key(neighbour_of(blocks.block(b), side, layout.dim()))};
        if (elsewhere_.count(name) != 0) around.insert(name);
      }
    }
  }
  return around;
}

void SleepAcrossRanks::ask(const Names& around, std::vector<Told>& asked) const {
  for (const BlockName& name : around) {
    if (!asleep_.knows_whole(name)) asked.push_back({name.key, name.field, kAsksForces});
  }
  for (std::size_t f = 0; f < fields_.size() && !knows_all_; ++f) {
    const BlockTable& blocks = fields_[f]->blocks;
    for (int b = 0; b < blocks.size(); ++b) {
      if (std::binary_search(known_[f].begin(), known_[f].end(), blocks.key(b))) continue;
      asked.push_back({blocks.key(b), static_cast<std::int32_t>(f), kAsksMeans});
    }
  }
}

void SleepAcrossRanks::meet(std::vector<SleepBorder>& borders) {
  if (none_asleep()) {  // nor has any node a mean then
    knows_all_ = true;
    return;
  }
  const Names around = find_around();
  asleep_.forget_wholes_but([&](const BlockName& name) { return around.count(name) != 0; });
  std::vector<Told> own;
  ask(around, own);
  const std::vector<Communicator::Bytes> asked = ranks().gather(bytes_of(own));
  std::vector<std::vector<Part>> parts(ranks().size());
  std::vector<std::vector<SleepBorder::Mean>> means(ranks().size());
  for (int rank = 0; rank < ranks().size(); ++rank) {
    for (const Told& told : list_of<Told>(asked[rank])) {
      const SleepingBlock* block = told.what == kAsksForces ? asleep_.own({told.field, told.key}) : nullptr;
      if (block != nullptr) parts[rank].push_back({told.key, told.field, block->rate, block->forces});
      if (told.what == kAsksMeans && rank != ranks().rank()) borders[told.field].add_means(told.key, means[rank]);
    }
  }
  std::vector<std::unique_ptr<SleepingBlock>> wholes;
  std::unordered_map<BlockName, SleepingBlock*, BlockName::Hash> by_name;
  for (const std::vector<Part>& of_rank : exchange(ranks(), std::move(parts))) {  // sums in the order of ranks
    for (const Part& part : of_rank) {
      SleepingBlock*& whole = by_name[{part.field, part.key}];
      if (whole == nullptr) {
        wholes.push_back(std::make_unique<SleepingBlock>());
        whole = wholes.back().get();
        whole->name = {part.field, part.key};
      }
      whole->rate = std::max(whole->rate, part.rate);
      whole->forces.add(part.forces);
    }
  }
  for (std::unique_ptr<SleepingBlock>& whole : wholes) asleep_.know_whole(std::move(whole));
  std::vector<std::vector<SleepBorder::Mean>> of_field(fields_.size());
  for (const std::vector<SleepBorder::Mean>& of_rank : exchange(ranks(), std::move(means))) {
    for (const SleepBorder::Mean& mean : of_rank) of_field[mean.field].push_back(mean);
  }
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    borders[f].take_means(of_field[f]);
    const BlockTable& blocks = fields_[f]->blocks;
    known_[f].clear();
    for (int b = 0; b < blocks.size(); ++b) known_[f].push_back(blocks.key(b));
  }
  knows_all_ = false;
}

}  // namespace mpm
