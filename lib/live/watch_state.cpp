#include "lib/live/watch_state.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/state_file.hpp"
#include "lib/live/write_all.hpp"

namespace taut::host {
namespace {

constexpr const char* magic = "taut-watch-1";
constexpr std::size_t most_bytes = std::size_t{1} << 31;
constexpr char header_mark = 'H', row_mark = 'R';

}  // namespace

WatchState::WatchState(const std::string& path, const std::string& scene_text)
    : path_(path), scene_(fingerprint(scene_text)) {
  std::error_code none;
  if (std::filesystem::exists(path, none))
    read();
  else
    write_anew("");
  if (descriptor_ < 0 && !is_plain_) descriptor_ = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0 && !is_plain_) fail();
}

WatchState::~WatchState() {
  if (descriptor_ >= 0) close(descriptor_);
}

void WatchState::refuse() const {
  throw InputError(path_, "", "is not a whole state", "name a file that --state has written, or a new one");
}

void WatchState::fail() const {
  throw InputError(path_, "", "cannot be written: " + std::generic_category().message(errno),
                   "name a place with room and the right to write");
}

// The first line has the sizes of what follows, which may hold anything.
std::string WatchState::head(const std::string& state) const {
  return std::string(magic) + ' ' + scene_ + ' ' + std::to_string(record_size_.value_or(-1)) + ' ' +
         std::to_string(header_.size()) + ' ' + std::to_string(first_row_.size()) + ' ' +
         std::to_string(state.size()) + (plan_.empty() ? "" : ' ' + std::to_string(plan_.size())) + '\n' +
         header_ + first_row_ + state + plan_;
}

void WatchState::read() {
  const std::string text = read_text(path_, most_bytes, "state file");
  const std::size_t end = text.find('\n');
  if (text.empty() || end == std::string::npos) refuse();
  std::istringstream line(text.substr(0, end));
  std::string word, scene;
  std::int64_t record = -1;
  std::size_t header = 0, first_row = 0, state = 0, plan = 0;
  line >> word;
  if (word != magic) {
    state_ = text;  // of `taut estimate`, or refused by who reads it
    is_plain_ = true;
    return;
  }
  if (!(line >> scene >> record >> header >> first_row >> state)) refuse();
  line >> plan;  // where there was one
  if (scene != scene_)
    throw InputError(path_, "", "belongs to another scene, or the scene file has changed",
                     "name a new file: it begins anew");
  std::size_t at = end + 1;
  for (const auto& [size, part] : {std::pair{header, &header_}, std::pair{first_row, &first_row_},
                                   std::pair{state, &state_}, std::pair{plan, &plan_}}) {
    if (size > text.size() - at) refuse();
    *part = text.substr(at, size);
    at += size;
  }
  if (record >= 0) record_size_ = record;
  read_rows(text, at);
}

void WatchState::read_rows(const std::string& text, std::size_t at) {
  bool is_first = false;
  for (std::size_t end = text.find('\n', at); end != std::string::npos;
       at = end + 1, end = text.find('\n', at)) {
    const std::string line = text.substr(at + 1, end - at - 1);
    if (text[at] == header_mark) {
      rows_.push_back({line, {}});
      header_ = line;
      is_first = true;
    } else if (text[at] == row_mark) {
      if (rows_.empty()) rows_.push_back({header_, {}});
      rows_.back().rows.push_back(line);
      if (is_first) first_row_ = line;
      is_first = false;
      ++appended_;
    } else {
      refuse();
    }
  }
  // A line that was being written when the program was killed.
  if (at < text.size() && truncate(path_.c_str(), static_cast<off_t>(at)) != 0) fail();
}

void WatchState::begin_log(const std::string& header) {
  coming_ = header;
  has_begun_ = true;
}

bool WatchState::is_known(const std::string& header, const std::string& first_row) const {
  return !first_row_.empty() && header == header_ && first_row == first_row_;
}

void WatchState::continue_log() { has_begun_ = false; }

void WatchState::append(const std::string& row) {
  if (is_plain_) write_anew(state_);
  std::string text;
  if (has_begun_) {
    text = header_mark + coming_ + '\n';
    header_ = coming_;
    first_row_ = row;
    has_begun_ = false;
  }
  text += row_mark + row + '\n';
  if (!write_all(descriptor_, text)) fail();
  ++appended_;
}

void WatchState::renew(const std::string& state, std::optional<std::int64_t> record_size,
                       const std::string& plan) {
  record_size_ = record_size;
  plan_ = plan;
  write_anew(state);
  appended_ = 0;
}

void WatchState::write_anew(const std::string& state) {
  const std::string beside = path_ + ".part";
  const int descriptor = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) fail();
  if (!write_all(descriptor, head(state)) || std::rename(beside.c_str(), path_.c_str()) != 0) {
    const int reason = errno;
    close(descriptor);
    std::remove(beside.c_str());
    errno = reason;
    fail();
  }
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = descriptor;
  is_plain_ = false;
}

}  // namespace taut::host
