#include "mpm/ranks/agree.hpp"

#include <vector>

#include "mpm/ranks/lists.hpp"

namespace mpm {

std::string first_text(Communicator& ranks, const std::string& own) {
  for (const Communicator::Bytes& bytes : ranks.gather(bytes_of(std::vector<char>(own.begin(), own.end())))) {
    const std::vector<char> text = list_of<char>(bytes);
    if (!text.empty()) return {text.begin(), text.end()};
  }
  return {};
}

}  // namespace mpm
