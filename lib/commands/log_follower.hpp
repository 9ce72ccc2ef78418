// What all commands that go through a log have in common: reading, checking, following it row by row.
#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/commands/far_ends_in_time.hpp"
#include "lib/commands/first_load.hpp"
#include "lib/commands/member_turns.hpp"
#include "lib/commands/plausible_log.hpp"
#include "lib/commands/result_writer.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/log_verdict.hpp"
#include "lib/files/sentence.hpp"
#include "lib/files/state_file.hpp"
#include "lib/kinds/make_model.hpp"

namespace taut::host {

/// What is followed, how, and where the result goes.
struct RunOptions {
  std::string scene, log;  ///< log: `-` for standard input, which is followed as it comes
  std::string output;      ///< empty: standard output
  Method method = methods.front().second;
  NumberFormat numbers;
  int substeps = 1;  ///< load steps a row, for the method stepwise
  AlarmLimits<double> limits;
  ResultChoice choice;  ///< of `simulate` and `estimate`
  std::string state;    ///< for `estimate`: where the log goes on from, and what it leaves; empty: nothing
};

/// A log that comes while it is followed, in place of RunOptions::log.
struct LogStream {
  std::istream& text;
  std::string name;              ///< for messages
  std::string state;             ///< what LogFollower::state() gave, to go on from; empty: nothing
  std::function<void()> begins;  ///< called when the header has been read
  /// Asked where a row cannot be used: whether it is left out. Then the next line of `text` must be the
  /// header again. Without it such a row ends the log with an InputError.
  std::function<bool(const InputError&)> leaves_out;
  /// Asked in the first row of a log: whether this log has been followed before, and rows up to the last time
  /// are no news.
  std::function<bool()> is_known;
};

/// Gets every row that has an answer, in order.
using RowVisitor = std::function<void(const LogRow&, const Answer&)>;

/// A scene and a log that have been read and checked, ready to be followed.
class LogFollower {
 public:
  /// Remarks go to standard error. Throws InputError for unusable input. The options must outlive it.
  explicit LogFollower(const RunOptions& options);
  /// Of a log that comes while it is followed; RunOptions::state has no effect then.
  LogFollower(const RunOptions& options, LogStream stream);
  ~LogFollower() = default;
  LogFollower(const LogFollower&) = delete;
  LogFollower& operator=(const LogFollower&) = delete;

  const SceneDescription& scene() const { return scene_; }
  /// Whether the log comes from standard input: then rows are checked as they come, follow() throws
  /// InputError where one cannot be used, and nothing is known of rows to come.
  bool is_stream() const { return source_.has_value(); }
  /// What a reader of the result may not expect.
  const std::vector<Sentence>& remarks() const { return remarks_; }

  /// Follows the log to its last row or to the first that has no answer. Returns where and why the answer
  /// ends; empty if the log is whole.
  Sentence follow(const RowVisitor& visit);
  /// After follow(): the same with another log, whose times may begin anew. Columns that were not in the
  /// first one are not used, with a remark.
  Sentence go_on(LogStream stream, const RowVisitor& visit);
  /// While a stream is followed, and after it: whether it has the column.
  bool has_column(const std::string& name) const { return stream_ != nullptr && stream_->has(name); }
  /// All that a LogStream needs to go on after the last row that was visited, or is being; nothing as long as
  /// forces depend on a past that is not known.
  std::optional<std::string> state() const;
  /// What has been learned of friction, and from which columns.
  std::vector<LearnedFriction> learned() const { return model_->learned(); }
  /// The forces of the struts after the last row that was visited.
  std::vector<StrutEstimate> struts() const { return model_->struts(); }
  /// Date and time of the log's first row, if it has them.
  const std::optional<Moment>& began() const { return origin_; }
  /// After a log that is whole: writes what the next one goes on from, if the options name a file for it.
  void keep_state() const;

 private:
  void remark(const Sentence& sentence);
  void read_log();
  void bring_into_time(const PlausibleLog& plausible);
  void open_stream();
  void begin();
  Sentence follow(LogReader& log, const RowVisitor& visit);
  Sentence reason(const Followed& path, const std::function<Followed(int)>& again) const;
  void require_later(const LogReader& log, const LogRow& row) const;
  Sentence follow_stream(const RowVisitor& visit);
  Sentence follow_row(const LogRow& row, Answer& answer, const RowVisitor& visit);
  bool next_of_stream(LogRow& row);
  void take_first_load(const LogRow& row);
  std::string loads_at_end(const Followed& path, const LogRow& row) const;
  void remark_on_unloaded(const FirstLoad& load);
  void warn_of_bend(const LogRow& row, const Answer& answer);
  void warn_of_turn(const LogRow& row);
  void remark_on_left_out(const LogReader& log);
  void remark_on_columns(const LogReader& log);
  void remark_on_substeps();
  void read_state();
  void take_state(const std::string& path, const std::string& text);
  SavedState present_state() const;
  void remark_on_new_columns(const LogReader& log);
  Sentence place(const LogRow& row) const;

  const RunOptions& options_;
  SceneDescription scene_;
  std::unique_ptr<Model> model_;
  LogRules rules_;
  std::optional<LogStream> source_;           // where a stream comes from
  std::unique_ptr<LogReader> stream_;         // the log that it is now
  std::unique_ptr<FirstLoad> first_load_;     // of a stream, as long as it is in question
  std::unique_ptr<FarEndsInTime> late_ends_;  // of a file
  std::size_t rows_ = 0, left_out_ = 0, followed_ = 0;
  std::optional<SavedState> begun_;  // with the log before
  LogVerdict verdict_;
  LogRow last_;
  std::optional<Moment> origin_;  // of its time
  std::vector<Sentence> remarks_;
  bool bends_too_far_ = false, turns_too_far_ = false;  // and that has been said
  MemberTurns turns_;
};

/// Why a model came no further.
Sentence reason_to_stop(const Followed& path, const SceneDescription& scene);

}  // namespace taut::host
