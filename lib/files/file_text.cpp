#include "lib/files/file_text.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "lib/files/input_error.hpp"

namespace taut::host {

void require_readable(const std::string& path, const std::string& noun) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    throw InputError(path, "", "is a directory", "name a " + noun);
  errno = 0;
  if (!std::ifstream(path, std::ios::binary)) {
    const std::string reason = errno != 0 ? std::generic_category().message(errno) : "unknown reason";
    throw InputError(path, "", "cannot be opened: " + reason, "name a " + noun + " that can be read");
  }
}

std::string read_text(const std::string& path, std::size_t most, const std::string& noun) {
  require_readable(path, noun);
  std::ifstream file(path, std::ios::binary);
  std::string text, block(std::size_t{1} << 16, '\0');
  while (text.size() <= most &&
         (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)) {
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad())
    throw InputError(path, "", "cannot be read to its end", "check the disk or copy the file again");
  if (text.size() > most) {
    throw InputError(path, "", "is larger than " + std::to_string(most >> 20) + " MiB",
                     "check that it is a " + noun);
  }
  return text;
}

}  // namespace taut::host
