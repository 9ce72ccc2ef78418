// What `taut watch` leaves behind at every instant, so that it can go on after it was killed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace taut::host {

/// Rows of one log as they came.
struct KeptRows {
  std::string header;
  std::vector<std::string> rows;
};

/// A file with the state of the estimator at some row, the size that the record had then, and the text of all
/// rows since. A row is appended before it is answered; now and then the file is written anew beside itself
/// and renamed, with a newer state and no rows. So the file is whole at every instant, but for a last line
/// without an end, which counts as not there.
class WatchState {
 public:
  /// So many rows are appended before there is a newer state.
  static constexpr std::size_t most_rows = 500;

  /// Reads the file if there is one; also one that `taut estimate` has written. Throws InputError for one
  /// that is of another scene or no state.
  WatchState(const std::string& path, const std::string& scene_text);
  ~WatchState();
  WatchState(const WatchState&) = delete;
  WatchState& operator=(const WatchState&) = delete;

  /// What was found: the state, empty if there is none; the size of the record [bytes], if there was one;
  /// rows since.
  const std::string& state() const { return state_; }
  const std::optional<std::int64_t>& record_size() const { return record_size_; }
  const std::vector<KeptRows>& rows() const { return rows_; }
  /// What renew() was given of a plan, empty if there is none.
  const std::string& plan() const { return plan_; }
  bool is_new() const { return state_.empty() && rows_.empty(); }
  /// The header of the log that was followed last; empty if there is none.
  const std::string& last_header() const { return header_; }

  /// Rows come from here on from a log with this header.
  void begin_log(const std::string& header);
  /// Whether this header and first row are those of the log that was followed last.
  bool is_known(const std::string& header, const std::string& first_row) const;
  /// The log that has begun is that one.
  void continue_log();

  /// A row, before it is answered.
  void append(const std::string& row);
  /// Whether a newer state is due.
  bool is_due() const { return appended_ >= most_rows; }
  /// A newer state after the last row, the size of the record with that row in it, and how the jacks stood in
  /// their plan.
  void renew(const std::string& state, std::optional<std::int64_t> record_size, const std::string& plan);

 private:
  void read();
  void read_rows(const std::string& text, std::size_t from);
  std::string head(const std::string& state) const;
  void write_anew(const std::string& state);
  [[noreturn]] void refuse() const;
  [[noreturn]] void fail() const;

  std::string path_, scene_;
  std::string state_, plan_;
  std::optional<std::int64_t> record_size_;
  std::vector<KeptRows> rows_;
  std::string header_, first_row_;  // of the log that was followed last
  std::string coming_;              // header of the log that has begun
  bool has_begun_ = false;          // and has no row yet
  bool is_plain_ = false;           // the file is one of `taut estimate`
  std::size_t appended_ = 0;
  int descriptor_ = -1;
};

}  // namespace taut::host
