// A JSON file as a tree that keeps the order of its keys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace taut::host {

/// What a file of JSON may have [byte].
inline constexpr std::size_t largest_json_file = std::size_t{16} << 20;

/// A value of a JSON file with everything below it.
struct JsonValue {
  enum class Kind : unsigned char { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;
  std::string text;               ///< of a string
  std::vector<JsonValue> items;   ///< of an array, or the values of an object
  std::vector<std::string> keys;  ///< of an object: keys[i] names items[i]
};

/// Parses JSON with // and /* */ comments; `file` is for messages.
///
/// Throws InputError for a syntax error, a key that comes twice in one object, nesting deeper than a scene
/// can be, or more values than any scene needs.
JsonValue parse_json(std::string_view text, const std::string& file);

}  // namespace taut::host
