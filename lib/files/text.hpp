// Small pieces of text for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::host {

/// The text in double quotes on one line: control characters and broken UTF-8 as \xNN, long texts cut short.
std::string quote(std::string_view text);

/// Whether the bytes are UTF-8.
bool is_utf8(std::string_view text);

/// A number as the shortest decimal that reads back the same.
std::string plain(double number);

/// `1 joint`, `2 joints`: a count and its noun, with an s where one belongs.
std::string counted(std::size_t count, const std::string& noun);

/// What to write in place of `word`: the most similar known word, or else the list of all known ones.
/// `kind` says what the known words are, as in `the nodes are`.
std::string suggestion(std::string_view word, const std::vector<std::string>& known, const std::string& kind);

/// `key` as a step of a JSON pointer, with its leading slash.
std::string pointer_step(std::string_view key);

}  // namespace taut::host
