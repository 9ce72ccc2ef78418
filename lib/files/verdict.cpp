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

// Raised in so many of the last rows.
struct Often {
  std::size_t raised;
  int of_rows;
};
// An alarm makes numbers doubtful while it was raised so often; in a load stage, which is all that there is
// of its load, also as often as is said for that.
struct Rule {
  const char* kind;
  Often usually, in_stages;
  const char* reason;  // {1} is the place
};
constexpr int all = Verdict::rows;
// The worst first: what explains the others stands before them.
constexpr std::array<Rule, 10> rules = {{
    {"unknown-past", {1, 1}, {1, 1}, "nobody knows how {1} came under load (pull on or use --state)"},
    {"late-lock", {1, 1}, {1, 1}, "the wedge at {1} may have held before the log says so"},
    {"unsaid-lock", {1, 1}, {1, 1}, "the wedge at {1} may hold though no row has it locked"},
    {"unread", {1, 1}, {1, 1}, "the load cell at {1} is not read"},
    {"frozen", {1, all}, {1, all}, "the load cell at {1} keeps one value although the load moves"},
    {"model-misfit", {1, all}, {1, all}, "{1} does not fit the model"},
    {"sensor", {3, all}, {1, 3}, "the load cell at {1} contradicts the model"},
    {"elongation", {3, all}, {1, 3}, "the stroke at {1} contradicts the model"},
    {"gauge", {3, all}, {1, 3}, "the measured force of {1} contradicts the model"},
    {"outlier", {6, all}, {6, all}, "the load cell at {1} gives readings that do not belong together"},
}};

using Bits = std::bitset<Verdict::rows>;

// Kinds hold no colon, names may.
bool is_of(const Rule& rule, const std::string& word) { return word.substr(0, word.find(':')) == rule.kind; }

bool is_so(const Often& often, std::uint32_t raised) {
  return (Bits(raised) << static_cast<std::size_t>(Verdict::rows - often.of_rows)).count() >= often.raised;
}

bool is_doubtful(const Rule& rule, std::uint32_t raised, bool is_stage) {
  return is_so(rule.usually, raised) || (is_stage && is_so(rule.in_stages, raised));
}

}  // namespace

bool is_trust(const Sentence& verdict) { return verdict.words() == trust; }

Sentence Verdict::take(const std::string& words, bool is_stage) {
  for (auto word = raised_.begin(); word != raised_.end();) {
    word->second = static_cast<std::uint32_t>((Bits(word->second) << 1).to_ulong());
    word = word->second == 0 ? raised_.erase(word) : std::next(word);
  }
  std::istringstream stream(words);
  for (std::string word; stream >> word;)
    if (std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) { return is_of(rule, word); }))
      raised_[word] |= 1;
  Sentence reasons;
  std::size_t count = 0;
  for (const Rule& rule : rules)
    for (const auto& [word, raised] : raised_) {
      if (count == most_reasons || !is_of(rule, word) || !is_doubtful(rule, raised, is_stage)) continue;
      const Sentence reason(rule.reason, {word.substr(word.find(':') + 1)});
      reasons = count++ == 0 ? reason : Sentence("{1}; {2}", {reasons, reason});
    }
  return count == 0 ? Sentence(trust) : Sentence("do not trust: {1}", {reasons});
}

}  // namespace taut::host
