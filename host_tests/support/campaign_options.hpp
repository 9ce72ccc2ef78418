// What a campaign is told by its command line.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <variant>

namespace support {

/// An option, and what it sets: a number, a word, or whether it is there.
struct Option {
  const char* name;
  std::variant<int*, long*, std::string*, bool*> to;

  /// Returns false if `word` is not what comes after this option.
  bool set(const char* word) const {
    if (std::string* const* const text = std::get_if<std::string*>(&to)) {
      **text = word;
      return true;
    }
    char* end = nullptr;
    const long number = std::strtol(word, &end, 10);
    if (int* const* const count = std::get_if<int*>(&to)) **count = static_cast<int>(number);
    if (long* const* const count = std::get_if<long*>(&to)) **count = number;
    return end != word && *end == '\0';
  }
};

/// Reads arguments such as `--seed 2`. Anything else ends the program with the list of options and exit
/// status 2, before a campaign of many minutes begins; so does `--help`, with exit status 0.
inline void read_options(int argc, char** argv, std::initializer_list<Option> options) {
  for (int i = 1; i < argc; ++i) {
    bool known = false;
    for (const Option& option : options) {
      if (argv[i] != std::string(option.name)) continue;
      if (bool* const* const flag = std::get_if<bool*>(&option.to))
        known = ** flag = true;
      else if (i + 1 < argc)
        known = option.set(argv[++i]);
      break;
    }
    if (known) continue;
    const bool helps = argv[i] == std::string("--help");
    if (!helps) std::fprintf(stderr, "%s: cannot use %s\n", argv[0], argv[i]);
    std::fprintf(helps ? stdout : stderr, "options:");
    for (const Option& option : options)
      std::fprintf(helps ? stdout : stderr, " %s%s", option.name,
                   std::holds_alternative<bool*>(option.to)          ? ""
                   : std::holds_alternative<std::string*>(option.to) ? " NAME"
                                                                     : " N");
    std::fprintf(helps ? stdout : stderr, "\n");
    std::exit(helps ? 0 : 2);
  }
}

}  // namespace support
