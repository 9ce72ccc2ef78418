#include "lib/files/sentence.hpp"

#include <cstddef>

namespace taut::host {

std::string filled(std::string_view pattern, const std::vector<std::string>& texts) {
  std::string text;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const bool is_place =
        i + 2 < pattern.size() && pattern[i] == '{' && pattern[i + 2] == '}' && pattern[i + 1] > '0';
    const std::size_t number = is_place ? static_cast<std::size_t>(pattern[i + 1] - '0') : 0;
    if (number == 0 || number > texts.size()) {
      text += pattern[i];
      continue;
    }
    text += texts[number - 1];
    i += 2;
  }
  return text;
}

}  // namespace taut::host
