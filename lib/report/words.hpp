// The words of a report in another language, from one table.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "lib/files/sentence.hpp"

namespace taut::host {

enum class Language { english, chinese, german };

/// By their names: `en`, `zh`, `de`.
inline constexpr std::array<std::pair<const char*, Language>, 3> languages = {
    {{"en", Language::english}, {"zh", Language::chinese}, {"de", Language::german}}};

/// Says in one language what it is given in English.
class Words {
 public:
  Words() = default;
  explicit Words(Language language) : language_(language) {}

  /// The words for these, as the table has them; what is not in it stays as it is.
  std::string operator()(std::string_view english) const;
  /// {1}, {2}, .. are replaced by these texts, which are not translated.
  std::string operator()(std::string_view english, std::initializer_list<std::string> texts) const;
  /// With the words of the table for every part of it.
  std::string operator()(const Sentence& sentence) const;

  /// `en`, `zh`, `de`: for the attribute lang of a page.
  const char* code() const;

 private:
  Language language_ = Language::english;
};

/// The table, for tests: a text in English, and the same in the languages that follow.
struct Translation {
  const char* english;
  const char* chinese;
  const char* german;
};
const Translation* begin_of_words();
const Translation* end_of_words();

}  // namespace taut::host
