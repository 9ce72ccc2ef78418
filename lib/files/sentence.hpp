// Sentences of the program as values, which can be said in any language.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut::host {

/// A text with {1}, {2}, .. in it, with these texts in their place; what has no text stays.
std::string filled(std::string_view pattern, const std::vector<std::string>& texts);

/// A sentence: English words with {1}, {2}, .. for its parts, which are sentences again or stand for
/// themselves, as names and numbers do. Words says it in another language.
class Sentence {
 public:
  Sentence() = default;
  /// What is the same in all languages.
  Sentence(std::string itself) : words_(std::move(itself)), is_itself_(true) {}
  explicit Sentence(const char* english, std::vector<Sentence> parts = {})
      : words_(english), parts_(std::move(parts)) {}

  bool empty() const { return words_.empty(); }
  /// The name or number, or the English pattern.
  const std::string& words() const { return words_; }
  /// Whether words() are the same in all languages.
  bool is_itself() const { return is_itself_; }
  const std::vector<Sentence>& parts() const { return parts_; }

  std::string english() const {
    return said([](const std::string& words) { return words; });
  }
  /// The sentence with the words that `in_language` has for an English pattern.
  template <class InLanguage>
  std::string said(const InLanguage& in_language) const {
    if (is_itself_) return words_;
    std::vector<std::string> texts;
    for (const Sentence& part : parts_) texts.push_back(part.said(in_language));
    return filled(in_language(words_), texts);
  }

 private:
  std::string words_;
  std::vector<Sentence> parts_;
  bool is_itself_ = false;
};

}  // namespace taut::host
