// A file as text.
#pragma once

#include <cstddef>
#include <string>

namespace taut::host {

/// What a scene, a goal or a state may have at most [byte].
inline constexpr std::size_t largest_text_file = std::size_t{1} << 28;

/// The whole file. Throws InputError if it cannot be read or is larger than `most` bytes; `noun` says what it
/// should be, as in `scene file`.
std::string read_text(const std::string& path, std::size_t most, const std::string& noun);

/// Throws InputError unless `path` is a file that can be opened for reading; `noun` says what it should be.
void require_readable(const std::string& path, const std::string& noun);

}  // namespace taut::host
