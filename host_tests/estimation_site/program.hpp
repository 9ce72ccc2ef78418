// The program under test, known by its files alone.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace estimation_site {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A folder that goes away.
struct Scratch {
  std::filesystem::path path;
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "taut.XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

/// Runs a program with its standard error in a file, for at most a minute of processor time. Returns the exit
/// status, or -1 if it was killed.
inline int run_program(const std::vector<std::string>& words, const std::filesystem::path& errors) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) return -1;
  if (child == 0) {
    const rlimit most{60, 60};
    setrlimit(RLIMIT_CPU, &most);
    const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file >= 0) dup2(file, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A result of the program, by columns. No field of it has quotes in it.
class Result {
 public:
  explicit Result(const std::string& text) {
    std::size_t at = 0;
    bool is_header = true;
    while (at < text.size()) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::vector<std::string> fields = split(text.substr(at, end - at));
      if (is_header) {
        for (std::size_t i = 0; i < fields.size(); ++i) columns_[fields[i]] = i;
      } else if (fields.size() == columns_.size()) {
        rows_.push_back(std::move(fields));
      }
      is_header = false;
      at = end + 1;
    }
  }
  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  std::size_t column(const std::string& name) const {
    const auto found = columns_.find(name);
    return found == columns_.end() ? none : found->second;
  }
  /// NaN where there is no such column.
  double number(std::size_t row, std::size_t column) const {
    return column == none ? std::strtod("nan", nullptr) : std::strtod(rows_[row][column].c_str(), nullptr);
  }
  std::string word(std::size_t row, std::size_t column) const {
    return column == none ? "" : rows_[row][column];
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::size_t at = 0;
    while (true) {
      const std::size_t end = line.find(',', at);
      fields.push_back(line.substr(at, end - at));
      if (end == std::string::npos) return fields;
      at = end + 1;
    }
  }

  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace estimation_site
