// A fingerprint of a file, as `sha256sum` prints it.
#pragma once

#include <string>
#include <string_view>

namespace taut::host {

/// SHA-256 (FIPS 180-4) of the bytes, in 64 hexadecimal digits. Cost: linear in the bytes.
std::string sha256(std::string_view bytes);

}  // namespace taut::host
