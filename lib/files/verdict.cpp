#include "lib/files/verdict.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <iterator>
#include <sstream>

namespace taut::host {
namespace {

constexpr const char* trust = "trust";
constexpr std::size_t most_reasons = 2;

// An alarm makes numbers doubtful while it was raised in so many of the last rows.
struct Rule {
  const char* kind;
  std::size_t raised;
  int of_rows;
  const char* before_place;
  const char* after_place;
};
// The worst first: what explains the others stands before them.
constexpr std::array<Rule, 7> rules = {{
    {"unknown-past", 1, 1, "nobody knows how ", " came under load (pull on or use --state)"},
    {"frozen", 1, Verdict::rows, "the load cell at ", " keeps one value although the load moves"},
    {"model-misfit", 1, Verdict::rows, "", " does not fit the model"},
    {"sensor", 3, Verdict::rows, "the load cell at ", " contradicts the model"},
    {"elongation", 3, Verdict::rows, "the stroke at ", " contradicts the model"},
    {"gauge", 3, Verdict::rows, "the measured force of ", " contradicts the model"},
    {"outlier", 6, Verdict::rows, "the load cell at ", " gives readings that do not belong together"},
}};

using Bits = std::bitset<Verdict::rows>;

// Kinds hold no colon, names may.
bool is_of(const Rule& rule, const std::string& word) { return word.substr(0, word.find(':')) == rule.kind; }

std::size_t times(const Rule& rule, std::uint32_t raised) {
  return (Bits(raised) << static_cast<std::size_t>(Verdict::rows - rule.of_rows)).count();
}

}  // namespace

bool is_trust(const std::string& verdict) { return verdict == trust; }

std::string Verdict::take(const std::string& words) {
  for (auto word = raised_.begin(); word != raised_.end();) {
    word->second = static_cast<std::uint32_t>((Bits(word->second) << 1).to_ulong());
    word = word->second == 0 ? raised_.erase(word) : std::next(word);
  }
  std::istringstream stream(words);
  for (std::string word; stream >> word;)
    if (std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) { return is_of(rule, word); }))
      raised_[word] |= 1;
  std::string reasons;
  std::size_t count = 0;
  for (const Rule& rule : rules)
    for (const auto& [word, raised] : raised_) {
      if (count == most_reasons || !is_of(rule, word) || times(rule, raised) < rule.raised) continue;
      reasons += (count++ == 0 ? "do not trust: " : "; ") +
                 (rule.before_place + word.substr(word.find(':') + 1)) + rule.after_place;
    }
  return count == 0 ? trust : reasons;
}

}  // namespace taut::host
