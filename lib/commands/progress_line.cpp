#include "lib/commands/progress_line.hpp"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

#include <iostream>
#include <string>

namespace taut::host {
namespace {

constexpr auto patience = std::chrono::seconds(2);
constexpr auto refresh = std::chrono::milliseconds(200);

bool is_terminal(int descriptor) {
#ifdef _WIN32
  return _isatty(descriptor) != 0;
#else
  return isatty(descriptor) != 0;
#endif
}

}  // namespace

ProgressLine::ProgressLine(std::size_t rows, bool watched)
    : rows_(rows), watched_(watched), next_(Clock::now() + patience) {}

void ProgressLine::show(std::size_t row) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + refresh;
  const auto percent =
      static_cast<int>(100 * static_cast<double>(row) / static_cast<double>(rows_ > 0 ? rows_ : 1));
  const std::string line =
      "row " + std::to_string(row) + " of " + std::to_string(rows_) + " (" + std::to_string(percent) + " %)";
  std::cerr << '\r' << line << std::flush;
  width_ = line.size();
}

// Blanks, not a control sequence: every terminal knows them.
void ProgressLine::erase() {
  if (width_ == 0) return;
  std::cerr << '\r' << std::string(width_, ' ') << '\r' << std::flush;
  width_ = 0;
}

bool standard_error_is_terminal() { return is_terminal(2); }
bool standard_output_is_terminal() { return is_terminal(1); }

}  // namespace taut::host
