#include "lib/files/output_file.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/unfinished_file.hpp"

namespace taut::host {
namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path) : target_(path) {
  if (path.empty()) {
    target_ = "standard output";
    stream_ = stdout;
    return;
  }
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) throw InputError(path, "", "is a directory", "name a file for the output");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    stream_ = std::fopen(path.c_str(), "wb");
  } else {
    open_beside();
  }
  if (stream_ == nullptr) fail();
}

// Opens a new file in the folder of the target, so that it can be renamed to it.
void OutputFile::open_beside() {
  constexpr int attempts = 100;
  std::error_code error;
  const fs::path resolved = fs::canonical(target_, error);
  final_ = error ? target_ : resolved.string();
  for (int i = 0; i < attempts && stream_ == nullptr; ++i) {
    temporary_ = final_ + ".part" + std::to_string(i);
    stream_ = open_unfinished(temporary_.c_str());
    if (stream_ == nullptr && errno != EEXIST) return;
  }
}

OutputFile::~OutputFile() {
  if (stream_ == nullptr || stream_ == stdout) return;
  std::fclose(stream_);
  if (!temporary_.empty()) remove_temporary();
}

void OutputFile::remove_temporary() {
  std::remove(temporary_.c_str());
  forget_unfinished(temporary_.c_str());
}

void OutputFile::fail() const {
  const std::string reason = errno != 0 ? std::generic_category().message(errno) : "unknown reason";
  throw InputError(target_, "", "cannot be written: " + reason,
                   "name a place with room and the right to write");
}

void OutputFile::write(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size()) fail();
}

void OutputFile::flush() {
  errno = 0;
  if (std::fflush(stream_) != 0) fail();
}

void OutputFile::finish() {
  flush();
  if (stream_ == stdout) return;
  std::FILE* const written = std::exchange(stream_, nullptr);
  const bool closed = std::fclose(written) == 0;
  if (temporary_.empty()) {
    if (!closed) fail();
    return;
  }
  std::error_code error;
  const fs::file_status replaced = fs::status(final_, error);
  if (fs::exists(replaced)) fs::permissions(temporary_, replaced.permissions(), error);
  if (closed && std::rename(temporary_.c_str(), final_.c_str()) == 0) {
    forget_unfinished(temporary_.c_str());
    return;
  }
  const int reason = errno;
  remove_temporary();
  errno = reason;
  fail();
}

void keep_inputs(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code none;
    if (!output.empty() && fs::equivalent(output, input, none))
      throw InputError(output, "", "is an input of this run", "name another file for the output");
  }
}

void keep_apart(const std::string& first, const std::string& second, const std::string& both) {
  if (first.empty() || second.empty()) return;
  std::error_code none;
  const auto place = [&](const std::string& path) { return fs::weakly_canonical(fs::absolute(path), none); };
  if (place(first) == place(second)) throw InputError(second, "", "is " + both, "name another file");
}

// A device or a pipe would take it for the output itself.
void require_writable(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  const bool is_written_directly =
      fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  if (!path.empty() && !is_written_directly) const OutputFile tried(path);
}

}  // namespace taut::host
