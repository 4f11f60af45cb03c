#include "mpm/transport/content_at_rest.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

ContentAtRest::ContentAtRest(const GridLayout& layout, double change, double rate, double after)
    : layout_(&layout), change_(change), rate_(rate), after_(after) {
  each_tile_node(layout.dim(), [&](int t, int block, int node) {
    of_side_[block].emplace_back(t, node);
    nodes_ = t + 1;
  });
}

void ContentAtRest::follow(const Fields& fields) {
  const std::uint64_t generation = fields.front()->blocks.generation();
  if (generation == generation_ && shared_.size() == fields.size()) return;
  generation_ = generation;
  shared_.resize(fields.size());
  const int sides = neighbours_of(layout_->dim());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const Grid& grid = *fields[f];
    shared_[f].clear();
    for (int b = 0; b < grid.blocks.size() && !tiles_.empty(); ++b) {
      for (int side = 0; side < sides; ++side) {
        const auto beside = neighbour_of(grid.blocks.block(b), side, layout_->dim());
        const auto tile = tiles_.find({static_cast<int>(f), layout_->key(beside)});
        if (tile == tiles_.end()) continue;
        for (const auto& [t, node] : of_side_[sides - 1 - side]) {
          if (tile->second.capacity[t] > 0.0) shared_[f].push_back({{b, node}, &tile->second, t, false});
        }
      }
    }
  }
}

void ContentAtRest::watch(const Fields& fields, int field, const std::vector<double>& changes, double now) {
  watched_.resize(fields.size());
  const BlockTable& blocks = fields[field]->blocks;
  before_.swap(watched_[field]);
  std::vector<Watched>& watched = watched_[field];
  watched.clear();
  auto old = before_.begin();
  for (int owner = 0; owner < blocks.owners(); ++owner) {
    Watched one{blocks.key(blocks.owner_block(owner)), now};
    while (old != before_.end() && old->key < one.key) ++old;
    if (old != before_.end() && old->key == one.key) one.since = old->since;
    if (changes[owner] > rate_) one.since = now;
    watched.push_back(one);
  }
}

void ContentAtRest::find_changed() {
  for (const std::vector<Shared>& list : shared_) {
    for (const Shared& shared : list) {
      Tile& tile = *shared.tile;
      if (std::abs(tile.came[shared.at]) > change_ * tile.capacity[shared.at]) tile.changed = true;
    }
  }
}

bool ContentAtRest::quiet(const RestingBlock& block, double now) const {
  if (block.field >= static_cast<int>(watched_.size())) return false;
  const std::vector<Watched>& watched = watched_[block.field];
  const auto before = [](const Watched& one, std::uint64_t key) { return one.key < key; };
  const auto found = std::lower_bound(watched.begin(), watched.end(), block.key, before);
  return found != watched.end() && found->key == block.key && now - found->since >= after_;
}

bool ContentAtRest::changed(const RestingBlock& block) const {
  const auto found = tiles_.find({block.field, block.key});
  return found != tiles_.end() && found->second.changed;
}

ContentAtRest::Tile& ContentAtRest::tile(const RestingBlock& block) {
  Tile& tile = tiles_[{block.field, block.key}];
  for (auto* numbers : {&tile.capacity, &tile.value, &tile.flow, &tile.room, &tile.came}) numbers->resize(nodes_, 0.0);
  return tile;
}

ContentAtRest::Tile ContentAtRest::take(const RestingBlock& block) {
  const auto found = tiles_.find({block.field, block.key});
  if (found == tiles_.end()) return {};
  Tile tile = std::move(found->second);
  tiles_.erase(found);
  shared_.clear();  // refers to the tile, and follow() finds it anew
  return tile;
}

std::vector<ContentAtRest::Name> ContentAtRest::names() const {
  std::vector<Name> names;
  for (const auto& one : tiles_) names.push_back(one.first);
  std::sort(names.begin(), names.end());
  return names;
}

void ContentAtRest::hashed(std::vector<double>& numbers) const {
  for (const Name& name : names()) {
    const std::vector<double>& came = tiles_.at(name).came;
    numbers.insert(numbers.end(), came.begin(), came.end());
  }
}

void ContentAtRest::serialise(StateArchive& archive) {
  const std::vector<Name> names = this->names();
  std::vector<int> fields, changed;
  std::vector<std::uint64_t> keys;
  for (const Name& name : names) {
    fields.push_back(name.first);
    keys.push_back(name.second);
    changed.push_back(tiles_[name].changed ? 1 : 0);
  }
  archive.list("field", fields);
  archive.list("key", keys);
  archive.list("changed", changed);
  if (archive.reading()) tiles_.clear();
  std::vector<double> values;
  const auto numbers = [&](const char* name, std::vector<double> Tile::*of) {
    values.clear();
    for (std::size_t n = 0; n < keys.size() && !archive.reading(); ++n) {
      const std::vector<double>& own = tiles_[{fields[n], keys[n]}].*of;
      values.insert(values.end(), own.begin(), own.end());
    }
    archive.list(name, values);
    for (std::size_t n = 0; n < keys.size() && archive.reading(); ++n) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(n) * nodes_;
      (tiles_[{fields[n], keys[n]}].*of).assign(first, first + nodes_);
    }
  };
  numbers("capacity", &Tile::capacity);
  numbers("value", &Tile::value);
  numbers("flow", &Tile::flow);
  numbers("room", &Tile::room);
  numbers("came", &Tile::came);
  std::vector<int> of_field;
  std::vector<std::uint64_t> watched;
  std::vector<double> since;
  for (std::size_t f = 0; f < watched_.size(); ++f) {
    for (const Watched& one : watched_[f]) {
      of_field.push_back(static_cast<int>(f));
      watched.push_back(one.key);
      since.push_back(one.since);
    }
  }
  archive.list("watched_field", of_field);
  archive.list("watched", watched);
  archive.list("since", since);
  if (!archive.reading()) return;
  for (std::size_t n = 0; n < keys.size(); ++n) tiles_[{fields[n], keys[n]}].changed = changed[n] != 0;
  watched_.clear();
  for (std::size_t i = 0; i < watched.size(); ++i) {
    watched_.resize(std::max<std::size_t>(watched_.size(), of_field[i] + 1));
    watched_[of_field[i]].push_back({watched[i], since[i]});
  }
  shared_.clear();  // found anew
}

}  // namespace mpm
