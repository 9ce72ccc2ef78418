// A file as text.
#pragma once

#include <cstddef>
#include <string>

namespace taut::host {

/// The whole file. Throws InputError if it cannot be read or is larger than `most` bytes.
std::string read_text(const std::string& path, std::size_t most);

/// Throws InputError unless `path` is a file that can be opened for reading; `noun` says what it should be.
void require_readable(const std::string& path, const std::string& noun);

}  // namespace taut::host
