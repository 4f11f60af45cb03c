#include "mpm/ranks/halo.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <tuple>

#include "mpm/ranks/lists.hpp"

namespace mpm {
namespace {

constexpr int kReach = 2;  ///< nodes beyond its block that an owner's particles may give to (grid/block_table.hpp)
constexpr int kRow = 64;   ///< nodes that travel as one; a part for a rank is filled up to whole rows

int whole_rows(int nodes) { return (nodes + kRow - 1) / kRow; }
int number_of(std::uint64_t nodes) { return static_cast<int>(std::bitset<64>(nodes).count()); }

/// visit(first, count) for every run of nodes.
template <class Visit>
void each_run(std::uint64_t nodes, Visit&& visit) {
  while (nodes != 0) {
    const int first = __builtin_ctzll(nodes);
    const std::uint64_t beyond = ~(nodes >> first);  // its lowest bit is that of the first node after the run
    const int count = beyond == 0 ? 64 : __builtin_ctzll(beyond);
    visit(first, count);
    if (first + count >= 64) return;
    nodes &= ~std::uint64_t{0} << (first + count);
  }
}

int components_of(const Halo::Values& values) {
  int components = 0;
  for (const NodalField* field : values) components += field == nullptr ? 0 : field->components();
  return components;
}

}  // namespace

// The ranks whose particles may reach a block: those of the blocks around it, and its own.
std::vector<int> Halo::ranks_around(const GridLayout& layout, std::uint64_t key) const {
  std::vector<int> list;
  const std::array<int, 3> middle = layout.block(key);
  const int count = neighbours_of(layout.dim());
  for (int s = 0; s < count; ++s) {
    const int rank = territory_.owner(layout.key(neighbour_of(middle, s, layout.dim())));
    if (rank != ranks_.rank() && std::find(list.begin(), list.end(), rank) == list.end()) list.push_back(rank);
  }
  return list;
}

void Halo::meet(Fields& fields, const Everywhere& everywhere) {
  find_own(fields, everywhere);
  std::vector<Given> given = hear();
  admit(fields, given);
  given.erase(std::remove_if(given.begin(), given.end(), [](const Given& one) { return !one.met; }), given.end());
  fields_.resize(fields.size());
  plan_receiving(fields, given, exchange(plan_sending(fields, given)));
  find_counted(fields, given);
}

std::vector<Halo::Nodes> Halo::reach(const BlockTable& blocks) const {
  const GridLayout& layout = blocks.layout();
  const int span = neighbours_of(layout.dim());
  std::vector<Nodes> of_neighbour(span, 0), nodes(blocks.size(), 0);
  for (int s = 0; s < span; ++s) {
    const std::array<int, 3> neighbour = neighbour_of({}, s, layout.dim());
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      const std::array<int, 3> node = layout.node({}, n);
      bool within = true;
      for (int k = 0; k < layout.dim(); ++k) {
        const int at = node[k] + neighbour[k] * kBlockEdge;  // from the owner's first node
        within = within && at >= -kReach && at < kBlockEdge + kReach;
      }
      if (within) of_neighbour[s] |= Nodes{1} << n;
    }
  }
  for (int owner = 0; owner < blocks.owners(); ++owner) {
    for (int s = 0; s < span; ++s) nodes[blocks.neighbours(owner)[s]] |= of_neighbour[s];
  }
  return nodes;
}

void Halo::find_own(const Fields& fields, const Everywhere& everywhere) {
  own_.clear();
  own_keys_.clear();
  told_.assign(ranks_.size(), {});
  told_all_.clear();
  const auto by_all = [&](const std::array<int, 3>& block) {
    const auto says_so = [&](const Everywhere& also) { return also(block); };
    return everywhere(block) || std::any_of(everywhere_.begin(), everywhere_.end(), says_so);
  };
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const BlockTable& blocks = fields[f]->blocks;
    const std::vector<Nodes> nodes = reach(blocks);
    for (int b = 0; b < blocks.size(); ++b) {
      const Use use{f, blocks.key(b), nodes[b]};
      own_.push_back(use);  // in ascending order
      own_keys_.push_back(use.key);
      if (by_all(blocks.block(b))) {
        told_all_.push_back(use);
      } else {
        for (const int rank : ranks_around(blocks.layout(), use.key)) told_[rank].push_back(use);
      }
    }
  }
  std::sort(own_keys_.begin(), own_keys_.end());
  own_keys_.erase(std::unique(own_keys_.begin(), own_keys_.end()), own_keys_.end());
}

std::vector<Halo::Given> Halo::hear() {
  std::vector<Given> given;
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    if (!told_[rank].empty()) parcels.push_back({rank, bytes_of(told_[rank])});
  }
  for (const Communicator::Parcel& parcel : ranks_.deliver(parcels)) {
    for (const Use& use : list_of<Use>(parcel.bytes)) {
      const bool met = std::binary_search(own_keys_.begin(), own_keys_.end(), use.key);
      given.push_back({use, parcel.rank, met, false});
    }
  }
  const std::vector<Communicator::Bytes> all = ranks_.gather(bytes_of(told_all_));
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    for (const Use& use : list_of<Use>(all[rank])) given.push_back({use, rank, rank != ranks_.rank(), true});
  }
  return given;
}

void Halo::admit(Fields& fields, const std::vector<Given>& given) {
  for (std::size_t f = 0; f < fields.size(); ++f) {
    std::vector<std::uint64_t> guests;
    for (const Given& one : given) {
      if (one.met && one.use.field == f && !owns(one.use)) guests.push_back(one.use.key);
    }
    std::sort(guests.begin(), guests.end());
    guests.erase(std::unique(guests.begin(), guests.end()), guests.end());
    fields[f]->admit(guests);
  }
}

bool Halo::owns(const Use& use) const { return std::binary_search(own_.begin(), own_.end(), use); }

Halo::Begins Halo::plan_sending(const Fields& fields, const std::vector<Given>& given) {
  std::vector<std::vector<std::uint64_t>> met(ranks_.size());  // blocks that this rank and another give to
  for (const Given& one : given) {
    if (!one.to_all) met[one.rank].push_back(one.use.key);
  }
  Begins begins(ranks_.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    OfField& field = fields_[f];
    field.out.clear();
    int at = 0;
    const auto add = [&](const Use& use) {
      if (use.field != f) return;
      field.out.push_back({fields[f]->blocks.find(use.key), use.nodes, at, number_of(use.nodes), ranks_.rank()});
      at += field.out.back().count;
    };
    if (ranks_.size() > 1) std::for_each(told_all_.begin(), told_all_.end(), add);
    for (int rank = 0; rank < ranks_.size(); ++rank) {
      if (f == 0) std::sort(met[rank].begin(), met[rank].end());
      at = whole_rows(at) * kRow;
      begins[rank].push_back(at / kRow);
      for (const Use& use : told_[rank]) {
        if (std::binary_search(met[rank].begin(), met[rank].end(), use.key)) add(use);
      }
    }
    field.out_rows = whole_rows(at);
  }
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    if (met[rank].empty()) begins[rank].clear();
  }
  return begins;
}

Halo::Begins Halo::exchange(const Begins& begins) {
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    if (!begins[rank].empty()) parcels.push_back({rank, bytes_of(begins[rank])});
  }
  Begins heard(ranks_.size());
  for (const Communicator::Parcel& parcel : ranks_.deliver(parcels)) {
    heard[parcel.rank] = list_of<std::int32_t>(parcel.bytes);
  }
  return heard;
}

void Halo::plan_receiving(const Fields& fields, std::vector<Given> given, const Begins& begins) {
  // One rank after the other: what it sends to all, then its part for this rank. Both come in the order of blocks.
  const auto parts_of = [](const Given& one) { return std::tuple(one.use.field, one.rank, !one.to_all); };
  std::stable_sort(given.begin(), given.end(),
                   [&](const Given& a, const Given& b) { return parts_of(a) < parts_of(b); });
  auto one = given.cbegin();
  for (std::size_t f = 0; f < fields.size(); ++f) {
    OfField& field = fields_[f];
    std::vector<Communicator::Source> sources;
    field.in.clear();
    while (one != given.cend() && one->use.field == f) {
      const Given& part = *one;  // the first of what a rank sends to all, or of its part for this rank
      const int begin = static_cast<int>(sources.size()) * kRow;
      int at = begin;
      for (; one != given.cend() && parts_of(*one) == parts_of(part); ++one) {
        const int count = number_of(one->use.nodes);
        field.in.push_back({fields[f]->blocks.find(one->use.key), one->use.nodes, at, count, part.rank});
        at += count;
      }
      const int row = part.to_all ? 0 : begins[part.rank][f];
      for (int i = 0; i < whole_rows(at - begin); ++i) sources.push_back({part.rank, row + i});
    }
    field.in_rows = static_cast<int>(sources.size());
    field.copies = ranks_.make_copies(field.out_rows, sources);

    std::sort(field.in.begin(), field.in.end(),
              [](const Piece& a, const Piece& b) { return std::tie(a.block, a.rank) < std::tie(b.block, b.rank); });
    field.sums.clear();
    for (std::size_t i = 0; i < field.in.size(); ++i) {
      const Piece& piece = field.in[i];
      if (i == 0 || field.in[i - 1].block != piece.block) {
        const bool own = owns({f, fields[f]->blocks.key(piece.block), 0});
        field.sums.push_back({piece.block, static_cast<int>(i), 0, 0, own});
      }
      ++field.sums.back().count;
      field.sums.back().before += piece.rank < ranks_.rank();
    }
  }
}

void Halo::find_counted(Fields& fields, const std::vector<Given>& given) {
  std::vector<std::pair<std::uint64_t, int>> lowest;  // lowest rank that gives to each block that others give to
  for (const Given& one : given) lowest.emplace_back(one.use.key, one.rank);
  std::sort(lowest.begin(), lowest.end());
  std::vector<std::uint64_t> to_all;  // also where nobody else gives
  for (const Use& use : told_all_) to_all.push_back(use.key);
  std::sort(to_all.begin(), to_all.end());
  std::vector<std::uint8_t> shared;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    Grid* grid = fields[f].get();
    grid->elsewhere.assign(grid->blocks.size(), 0);
    shared.assign(grid->blocks.size(), 0);
    for (int b = 0; b < grid->blocks.size(); ++b) {
      const std::uint64_t key = grid->blocks.key(b);
      if (std::binary_search(to_all.begin(), to_all.end(), key)) shared[b] = 1;
      const auto found = std::lower_bound(lowest.begin(), lowest.end(), std::pair{key, 0});
      if (found == lowest.end() || found->first != key) continue;
      shared[b] = 1;
      const bool mine = std::binary_search(own_keys_.begin(), own_keys_.end(), key) && ranks_.rank() < found->second;
      grid->elsewhere[b] = mine ? 0 : 1;
    }
    divide(static_cast<int>(f), *grid, shared);
  }
}

void Halo::divide(int number, const Grid& grid, const std::vector<std::uint8_t>& shared) {
  const BlockTable& blocks = grid.blocks;
  std::vector<std::uint8_t> border(blocks.owners()), inner(blocks.owners());
  for (int owner = 0; owner < blocks.owners(); ++owner) {
    const int* around = blocks.neighbours(owner);
    border[owner] = std::any_of(around, around + blocks.neighbour_count(), [&](int b) { return shared[b] != 0; });
    inner[owner] = border[owner] == 0;
  }
  fields_[number].at_border.rebuild_of(grid.shares, blocks, border);
  fields_[number].inside.rebuild_of(grid.shares, blocks, inner);
}

void Halo::add(int number, NodalField& values) {
  begin(number, {&values});
  end(number, {&values});
}

void Halo::begin(int number, const Values& values) {
  OfField& field = fields_[number];
  const int components = components_of(values);
  field.sent.resize(static_cast<std::size_t>(field.out_rows) * kRow * components);
  field.received.resize(static_cast<std::size_t>(field.in_rows) * kRow * components);
  for (const Piece& piece : field.out) {
    double* to = field.sent.data() + static_cast<std::size_t>(piece.at) * components;
    for (const NodalField* nodal : values) {
      if (nodal == nullptr) continue;
      const double* from = nodal->block(piece.block);
      for (int k = 0; k < nodal->components(); ++k, from += nodal->nodes_per_block()) {
        each_run(piece.nodes, [&](int first, int count) { to = std::copy_n(from + first, count, to); });
      }
    }
  }
  field.copies->begin(field.sent.data(), field.received.data(), kRow * components);
}

void Halo::end(int number, const Values& values) {
  OfField& field = fields_[number];
  const int components = components_of(values);
  field.copies->end(field.sent.data(), field.received.data(), kRow * components);
  for (const Sum& sum : field.sums) {
    int component = 0;
    for (NodalField* nodal : values) {
      if (nodal == nullptr) continue;
      const int nodes = nodal->nodes_per_block();
      for (int k = 0; k < nodal->components(); ++k, ++component) {
        double* own = nodal->block(sum.block) + k * nodes;
        if (sum.own && sum.count == 1) {  // two numbers, in whichever order
          const Piece& piece = field.in[sum.first];
          const double* from = field.received.data() + static_cast<std::size_t>(piece.at) * components;
          from += component * piece.count;
          each_run(piece.nodes, [&](int first, int count) {
            for (int n = first; n < first + count; ++n) own[n] += *from++;
          });
          continue;
        }
        std::array<double, kRow> total{};
        const auto add = [&](int begin, int end) {
          for (int i = begin; i < end; ++i) {
            const Piece& piece = field.in[sum.first + i];
            const double* from = field.received.data() + static_cast<std::size_t>(piece.at) * components;
            from += component * piece.count;
            each_run(piece.nodes, [&](int first, int count) {
              for (int n = first; n < first + count; ++n) total[n] += *from++;
            });
          }
        };
        add(0, sum.before);
        for (int n = 0; n < nodes && sum.own; ++n) total[n] += own[n];
        add(sum.before, sum.count);
        std::copy_n(total.begin(), nodes, own);
      }
    }
  }
  numbers_received_ += field.received.size();
}

}  // namespace mpm
