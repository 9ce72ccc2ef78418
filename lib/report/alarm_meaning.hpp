// What an alarm means and what to do about it.
#pragma once

#include <string>

namespace taut::host {

struct AlarmMeaning {
  const char* means;
  const char* to_do;
};

/// For the word of an alarm as alarm_word() writes it.
AlarmMeaning alarm_meaning(const std::string& word);

/// Where it is: what follows the kind.
std::string alarm_place(const std::string& word);

}  // namespace taut::host
