// Where a result goes: standard output, or a file that appears only when it is whole.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace taut::host {

/// A stream of text to a file or standard output.
///
/// A file is written beside its target and takes the target's place in finish(); without finish() the target
/// stays as it was, also when a signal ends the program. A device or a pipe is written directly. All
/// functions throw InputError if the output cannot be written.
class OutputFile {
 public:
  /// An empty path means standard output.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// What is written until now can be read, in a file that is not whole under its other name.
  void flush();
  /// Everything is written: makes it last.
  void finish();

 private:
  void open_beside();
  void remove_temporary();
  [[noreturn]] void fail() const;

  std::string target_;     // as given, for messages
  std::string final_;      // the file that is replaced, links followed
  std::string temporary_;  // empty if the target is written directly
  std::FILE* stream_ = nullptr;
};

/// Throws InputError if the output would take the place of an input of the same run.
void keep_inputs(const std::string& output, const std::vector<std::string>& inputs);

/// Throws InputError if two outputs of one run would be one file, however they are spelt; `both` says what it
/// would be, as in `the log and the sheet of one plan`. An empty path is no file.
void keep_apart(const std::string& first, const std::string& second, const std::string& both);

/// Throws InputError if a file could not be written here, before time is spent on what goes into it. It stays
/// as it was. An empty path is no file.
void require_writable(const std::string& path);

}  // namespace taut::host
