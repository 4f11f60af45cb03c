#include "mpm/contact/shared_blocks.hpp"

namespace mpm {

bool SharedBlocks::changed(const Fields& fields) {
  std::vector<std::uint64_t> generations;
  generations.reserve(fields.size());
  for (const auto& field : fields) generations.push_back(field->blocks.generation());
  if (generations == generations_) return false;
  generations_ = std::move(generations);
  return true;
}

void SharedBlocks::mark(const Fields& fields) {
  marks_.resize(fields.size());
  any_.assign(fields.size(), 0);
  for (std::size_t f = 0; f < fields.size(); ++f) marks_[f].assign(fields[f]->blocks.size(), 0);
  for (const SharedBlock& block : list_) {
    for (const SharedBlock::Part& part : block.parts) {
      marks_[part.field][part.block] = 1;
      any_[part.field] = 1;
    }
  }
}

}  // namespace mpm
