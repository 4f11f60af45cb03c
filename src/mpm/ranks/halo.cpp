#include "mpm/ranks/halo.hpp"

#include <algorithm>
#include <tuple>

#include "mpm/ranks/lists.hpp"

namespace mpm {
// The ranks whose particles may reach a block: those of the blocks around it, and its own.
std::vector<int> Halo::ranks_around(const GridLayout& layout, std::uint64_t key) const {
  std::vector<int> list;
  const std::array<int, 3> middle = layout.block(key);
  const int count = neighbours_of(layout.dim());
  for (int s = 0; s < count; ++s) {
    std::array<int, 3> block = middle;
    int rest = s;
    for (int k = layout.dim() - 1; k >= 0; --k, rest /= 3) block[k] += rest % 3 - 1;
    const int rank = territory_.owner(layout.key(block));
    if (rank != ranks_.rank() && std::find(list.begin(), list.end(), rank) == list.end()) list.push_back(rank);
  }
  return list;
}

void Halo::meet(Fields& fields, const Everywhere& everywhere) {
  find_own(fields, everywhere);
  std::vector<Given> given = hear();
  admit(fields, given);
  find_rows(fields, given);
  plan(fields, given);
  find_counted(fields, given);
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
    for (int b = 0; b < blocks.size(); ++b) {
      const Use use{f, blocks.key(b)};
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
      given.push_back({use, parcel.rank, -1, met});
    }
  }
  const std::vector<Communicator::Bytes> all = ranks_.gather(bytes_of(told_all_));
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    for (const Use& use : list_of<Use>(all[rank])) given.push_back({use, rank, -1, rank != ranks_.rank()});
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

void Halo::find_rows(const Fields& fields, std::vector<Given>& given) {
  const auto rows = [&](const std::vector<Use>& uses) {
    std::vector<std::int32_t> list;
    list.reserve(uses.size());
    for (const Use& use : uses) list.push_back(fields[use.field]->blocks.find(use.key));
    return bytes_of(list);
  };
  std::vector<Communicator::Parcel> parcels;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    if (!told_[rank].empty()) parcels.push_back({rank, rows(told_[rank])});
  }
  auto next = given.begin();  // they come in the order in which the uses came
  for (const Communicator::Parcel& parcel : ranks_.deliver(parcels)) {
    for (const std::int32_t row : list_of<std::int32_t>(parcel.bytes)) next++->row = row;
  }
  for (const Communicator::Bytes& bytes : ranks_.gather(rows(told_all_))) {
    for (const std::int32_t row : list_of<std::int32_t>(bytes)) next++->row = row;
  }
}

void Halo::plan(const Fields& fields, std::vector<Given>& given) {
  given.erase(std::remove_if(given.begin(), given.end(), [](const Given& one) { return !one.met; }), given.end());
  std::sort(given.begin(), given.end(), [](const Given& a, const Given& b) {
    return std::tie(a.use.field, a.use.key, a.rank) < std::tie(b.use.field, b.use.key, b.rank);
  });
  fields_.resize(fields.size());
  auto next = given.begin();
  for (std::size_t f = 0; f < fields.size(); ++f) {
    OfField& field = fields_[f];
    std::vector<Communicator::Source> sources;
    field.sums.clear();
    while (next != given.end() && next->use.field == f) {
      const Use use = next->use;
      Sum sum{fields[f]->blocks.find(use.key), static_cast<int>(sources.size()), 0, 0, owns(use)};
      for (; next != given.end() && !(use < next->use); ++next) {
        sources.push_back({next->rank, next->row});
        ++sum.count;
        sum.before += next->rank < ranks_.rank();
      }
      field.sums.push_back(sum);
    }
    field.rows = static_cast<int>(sources.size());
    field.copies = ranks_.make_copies(fields[f]->blocks.size(), sources);
  }
}

void Halo::find_counted(Fields& fields, const std::vector<Given>& given) const {
  std::vector<std::pair<std::uint64_t, int>> lowest;  // of each block that others give to, the lowest rank that does
  for (const Given& one : given) lowest.emplace_back(one.use.key, one.rank);
  std::sort(lowest.begin(), lowest.end());
  for (auto& grid : fields) {
    grid->elsewhere.assign(grid->blocks.size(), 0);
    for (int b = 0; b < grid->blocks.size(); ++b) {
      const std::uint64_t key = grid->blocks.key(b);
      const auto found = std::lower_bound(lowest.begin(), lowest.end(), std::pair{key, 0});
      if (found == lowest.end() || found->first != key) continue;
      const bool mine = std::binary_search(own_keys_.begin(), own_keys_.end(), key) && ranks_.rank() < found->second;
      grid->elsewhere[b] = mine ? 0 : 1;
    }
  }
}

void Halo::add(int number, NodalField& values) {
  OfField& field = fields_[number];
  const int numbers = values.components() * values.nodes_per_block();
  field.received.resize(static_cast<std::size_t>(field.rows) * numbers);
  field.copies->begin(values.data(), field.received.data(), numbers);
  field.copies->end(values.data(), field.received.data(), numbers);
  for (const Sum& sum : field.sums) {
    double* own = values.block(sum.block);
    const double* received = field.received.data() + static_cast<std::size_t>(sum.first) * numbers;
    for (int n = 0; n < numbers; ++n) {
      double total = 0.0;
      for (int i = 0; i < sum.before; ++i) total += received[i * numbers + n];
      if (sum.own) total += own[n];
      for (int i = sum.before; i < sum.count; ++i) total += received[i * numbers + n];
      own[n] = total;
    }
  }
  numbers_received_ += field.received.size();
  ++exchanges_;
}

std::uint64_t Halo::blocks_received() const {
  std::uint64_t blocks = 0;
  for (const OfField& field : fields_) blocks += field.rows;
  return blocks;
}

}  // namespace mpm
