// The one error of everything that reads what a person wrote.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace taut::host {

/// Unusable input: the file, the place in it, what is wrong there and what would be right.
///
/// `place` is a JSON pointer or a line and column; it is empty where the whole file is meant.
class InputError : public std::exception {
 public:
  InputError(std::string file, std::string place, std::string problem, std::string remedy)
      : file_(std::move(file)),
        place_(std::move(place)),
        problem_(std::move(problem)),
        remedy_(std::move(remedy)),
        line_(file_ + ": " + (place_.empty() ? "" : place_ + ": ") + problem_ + "; " + remedy_) {}

  const std::string& file() const noexcept { return file_; }
  const std::string& place() const noexcept { return place_; }
  const std::string& problem() const noexcept { return problem_; }
  const std::string& remedy() const noexcept { return remedy_; }

  /// One line: `FILE: PLACE: problem; remedy`.
  const char* what() const noexcept override { return line_.c_str(); }

 private:
  std::string file_, place_, problem_, remedy_, line_;
};

}  // namespace taut::host
