#include "lib/live/file_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"

namespace taut::host {

FileSource::FileSource(const std::string& path, bool grows, const StopSignal& stop)
    : path_(path), grows_(grows), stop_(stop) {
  require_readable(path, "log file");
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none))
    throw InputError(path, "", "is a pipe or a device", "write - for standard input, or --serial " + path);
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw InputError(path, "", "cannot be opened: " + std::generic_category().message(errno),
                     "name a log file that can be read");
}

FileSource::~FileSource() { close(descriptor_); }

std::optional<std::string> FileSource::next() {
  while (!stop_.is_requested()) {
    if (std::optional<std::string> line = lines_.take()) return line;
    std::array<char, 65536> bytes;
    const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
    if (count > 0) {
      lines_.add({bytes.data(), static_cast<std::size_t>(count)});
      read_ += count;
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw InputError(path_, "", "cannot be read: " + std::generic_category().message(errno),
                       "check the disk, then start again");
    if (!grows_) return lines_.rest();
    struct stat now {};
    if (fstat(descriptor_, &now) == 0 && now.st_size < read_)
      throw InputError(path_, "", "has become shorter while it was followed",
                       "start again with the log that is written now; --state goes on");
    stop_.wait(interval);
  }
  return std::nullopt;
}

}  // namespace taut::host
