#include "lib/live/record_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "lib/files/input_error.hpp"
#include "lib/live/write_all.hpp"

namespace taut::host {
namespace {

// Where the last whole line ends, in a file of this size.
std::int64_t end_of_lines(int descriptor, std::int64_t size) {
  std::array<char, 4096> bytes;
  while (size > 0) {
    const auto count =
        static_cast<std::size_t>(std::min<std::int64_t>(size, static_cast<std::int64_t>(bytes.size())));
    const std::int64_t from = size - static_cast<std::int64_t>(count);
    if (pread(descriptor, bytes.data(), count, from) != static_cast<ssize_t>(count)) return -1;
    for (std::size_t i = count; i > 0; --i)
      if (bytes[i - 1] == '\n') return from + static_cast<std::int64_t>(i);
    size = from;
  }
  return 0;
}

}  // namespace

RecordFile::RecordFile(const std::string& path, const std::string& header) : path_(path) {
  struct stat now {};
  if (stat(path.c_str(), &now) == 0 && !S_ISREG(now.st_mode))
    throw InputError(path, "", "is no file", "name a file for the record");
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0 || fstat(descriptor_, &now) != 0) fail("opened");
  size_ = now.st_size;
  at_ = end_of_lines(descriptor_, now.st_size);
  // What has no line in it is a header that was cut short, or nothing.
  std::string begin(std::min(at_ == 0 ? static_cast<std::size_t>(size_) : header.size(), header.size() + 1),
                    '\0');
  if (pread(descriptor_, begin.data(), begin.size(), 0) != static_cast<ssize_t>(begin.size()) ||
      header.compare(0, begin.size(), begin) != 0)
    throw InputError(path, "", "is not a record of this scene", "name another file, or a new one");
  cut();
  if (at_ == 0) append(header);
}

RecordFile::~RecordFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void RecordFile::fail(const std::string& doing) const {
  throw InputError(path_, "", "cannot be " + doing + ": " + std::generic_category().message(errno),
                   "name a place with room and the right to write");
}

void RecordFile::go_back_to(std::int64_t size) {
  if (size > size_)
    throw InputError(path_, "", "has fewer rows than the state knows",
                     "name the record that belongs to the state");
  at_ = size;
}

void RecordFile::cut() {
  if (ftruncate(descriptor_, at_) != 0) fail("cut");
  size_ = at_;
}

void RecordFile::append(const std::string& line) {
  if (at_ < size_) {
    std::string there(line.size(), '\0');
    const ssize_t count = pread(descriptor_, there.data(), there.size(), at_);
    if (count != static_cast<ssize_t>(line.size()) || there != line) cut();
  }
  if (at_ == size_) {
    if (lseek(descriptor_, at_, SEEK_SET) < 0 || !write_all(descriptor_, line)) fail("written");
    size_ += static_cast<std::int64_t>(line.size());
  }
  at_ += static_cast<std::int64_t>(line.size());
}

}  // namespace taut::host
