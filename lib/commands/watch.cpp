#include "lib/commands/watch.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <istream>
#include <memory>
#include <mutex>
#include <sstream>
#include <utility>
#include <vector>

#include "lib/commands/log_follower.hpp"
#include "lib/files/deserved_digits.hpp"
#include "lib/files/file_text.hpp"
#include "lib/files/input_error.hpp"
#include "lib/files/output_file.hpp"
#include "lib/files/result_file.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/files/text.hpp"
#include "lib/kinds/valid_scene.hpp"
#include "lib/live/answer_board.hpp"
#include "lib/live/file_source.hpp"
#include "lib/live/http_server.hpp"
#include "lib/live/live_page.hpp"
#include "lib/live/load_history.hpp"
#include "lib/live/pace.hpp"
#include "lib/live/pipe_source.hpp"
#include "lib/live/plan_guide.hpp"
#include "lib/live/planner.hpp"
#include "lib/live/record_file.hpp"
#include "lib/live/serial_source.hpp"
#include "lib/live/stop_signal.hpp"
#include "lib/live/terminal.hpp"
#include "lib/live/watch_state.hpp"
#include "lib/plan/find_plan.hpp"
#include "lib/plan/goal_file.hpp"
#include "lib/plan/plan_words.hpp"
#include "lib/plan/prior.hpp"

namespace taut::host {
namespace {

constexpr const char* silent = "silent:line";
constexpr const char* unreadable = "unreadable:line";

void require_possible(const WatchOptions& options) {
  if (options.log.empty() == options.serial.empty())
    throw InputError("taut watch", "",
                     options.log.empty() ? "has no rows to follow" : "has two logs to follow",
                     "name a log, - for standard input, or --serial DEVICE");
  if (options.speed && (options.log.empty() || options.log == "-"))
    throw InputError("--speed", "", "needs a log that is a file",
                     "leave it out: rows are answered as they come");
  if (options.speed && !(*options.speed > 0))
    throw InputError("--speed", "", "is not greater than zero", "write 1 for the speed of the log");
  const std::vector<std::string> inputs = {options.scene, options.log, options.goal};
  keep_inputs(options.record, inputs);
  keep_inputs(options.state, inputs);
  keep_apart(options.record, options.state, "the record and the state of one run");
}

class Watch {
 public:
  explicit Watch(const WatchOptions& options)
      : options_(options), scene_(read_scene_file(options.scene)), is_serial_(!options.serial.empty()) {
    run_.scene = options.scene;
    run_.log = name();
    run_.state = options.state;
    run_.method = Method::estimate;
    run_.limits = options.limits;
    if (options.speed) pace_ = std::make_unique<Pace>(*options.speed, stop_);
    if (!options.goal.empty()) {
      require_valid(scene_);
      goal_ = std::make_unique<PlanGoal>(read_goal_file(options.goal, scene_));
    }
    if (!options.state.empty())
      state_ = std::make_unique<WatchState>(options.state,
                                            read_text(options.scene, largest_text_file, "scene file"));
    if (!options.record.empty())
      record_ = std::make_unique<RecordFile>(options.record, result_header(scene_, ResultColumns::estimate));
  }

  int run() {
    std::unique_ptr<LineSource> source = open_source();
    agree_on_record();
    if (goal_ && !make_plan()) return stop_.is_requested() ? 0 : 1;
    std::unique_ptr<HttpServer> server;
    if (!options_.http.empty()) {
      server = std::make_unique<HttpServer>(
          http_address("--http", options_.http), board_, history_,
          [this](const LiveAnswerPtr& now) { return live_page(scene_, name(), bounds(), now); });
      std::cerr << server->url() << std::endl;
    }
    const Terminal terminal(scene_, board_);
    struct Closer {
      AnswerBoard& board;
      ~Closer() { board.close(); }
    } const closer{board_};
    if (guide_)
      planner_ = std::make_unique<Planner>(*goal_, [this](const PlanFound& found) { take_plan(found); });
    struct Quitter {
      std::unique_ptr<Planner>& planner;
      ~Quitter() { planner.reset(); }
    } const quitter{planner_};

    is_replaying_ = true;
    Sentence end = replay();
    is_replaying_ = false;
    while (end.empty() && !stop_.is_requested()) {
      LineBuffer lines(*source);
      end = follow_live(lines);
      if (!is_serial_) break;
    }
    if (follower_ && state_) renew_state();
    if (end.empty()) return 0;
    std::cerr << end.english() << "; what is shown ends before it\n";
    return 1;
  }

 private:
  std::string name() const {
    return is_serial_            ? serial_line(options_.serial).device
           : options_.log == "-" ? "standard input"
                                 : options_.log;
  }

  LiveBounds bounds() const {
    LiveBounds bounds;
    if (goal_) {
      bounds.target = goal_->target;
      bounds.most_segment = goal_->most_segment;
    }
    bounds.least_force = options_.limits.least_force;
    if (options_.limits.most_force >= 0) bounds.most_force = options_.limits.most_force;
    return bounds;
  }

  std::unique_ptr<LineSource> open_source() {
    if (is_serial_)
      return std::make_unique<SerialSource>(
          serial_line(options_.serial), state_ ? state_->last_header() : "", stop_,
          [this](bool is_silent) { tell(is_silent); }, FrameRows(scene_));
    if (options_.log == "-") return std::make_unique<PipeSource>(STDIN_FILENO, stop_);
    return std::make_unique<FileSource>(options_.log, !options_.speed, stop_);
  }

  // The record holds what the state knows, and no more.
  void agree_on_record() {
    if (!state_ || !record_) return;
    if (state_->is_new())
      state_->renew("", record_->size(), "");
    else if (state_->record_size())
      record_->go_back_to(*state_->record_size());
    repeats_record_ = state_->record_size().has_value();
  }

  // Rows that were answered before the program was killed, after the state that was written last.
  Sentence replay() {
    if (!state_) return {};
    Sentence end;
    for (const KeptRows& part : state_->rows()) {
      if (part.rows.empty() || !end.empty()) continue;
      std::string text = part.header + "\n";
      for (const std::string& row : part.rows) text += row + "\n";
      std::istringstream lines(text);
      end = follow({lines, options_.state, state_->state(), {}, {}, {}},
                   [this](const LogRow& row, const Answer& answer) {
                     if (record_ && repeats_record_) record(row, answer);
                     show(row, answer);
                   });
    }
    if (record_) record_->cut();
    return end;
  }

  Sentence follow_live(LineBuffer& lines) {
    std::string header;
    std::istream text(&lines);
    LogStream log{text, name(), state_ ? state_->state() : "", {}, {}, {}};
    log.begins = [&] {
      header = lines.last_line();
      if (state_) state_->begin_log(header);
    };
    if (is_serial_)
      log.leaves_out = [&](const InputError& error) { return leave_out(error, lines, header); };
    else if (state_)
      log.is_known = [&] {
        if (!state_->is_known(header, lines.last_line())) return false;
        std::cerr << "remark: this is the log that " << options_.state
                  << " stands in: rows that it has are skipped\n";
        state_->continue_log();
        return true;
      };
    try {
      return follow(std::move(log), [&](const LogRow& row, const Answer& answer) {
        if (pace_) pace_->wait_for(row.time);
        if (state_) state_->append(lines.last_line());
        if (record_) record(row, answer);
        show(row, answer);
        if (state_ && (state_->is_due() || has_plan_changed())) renew_state();
      });
    } catch (const InputError&) {
      // A log without a header, or without rows, is none where it was to end, or where a line was lost.
      if (stop_.is_requested() || (is_serial_ && lines.is_over())) return {};
      throw;
    }
  }

  Sentence follow(LogStream log, const RowVisitor& visit) {
    if (follower_) return follower_->go_on(std::move(log), visit);
    follower_ = std::make_unique<LogFollower>(run_, std::move(log));
    return follower_->follow(visit);
  }

  // Noise on the line must not end the watch.
  bool leave_out(const InputError& error, LineBuffer& lines, const std::string& header) {
    constexpr int most_remarks = 20;
    if (lines.is_over()) return false;
    if (++left_out_ <= most_remarks)
      std::cerr << "remark: " << error.what() << "; the line is left out"
                << (left_out_ == most_remarks ? ", as will be others without a word" : "") << '\n';
    unreadable_rows_ = Verdict::rows;
    lines.insert(header);
    return true;
  }

  void record(const LogRow& row, const Answer& answer) {
    record_->append(result_row(scene_, row.time, answer, NumberFormat{}, ResultColumns::estimate));
  }

  void renew_state() {
    const std::optional<std::string> text = follower_->state();
    if (!text) return;
    std::string plan;
    if (guide_) {
      const std::lock_guard<std::mutex> lock(showing_);
      plan = guide_->state();
    }
    state_->renew(*text, record_ ? std::optional<std::int64_t>(record_->size()) : std::nullopt, plan);
  }

  // As `taut plan` finds it. False if there is none.
  bool make_plan() {
    const GiveUp give_up = [this] { return stop_.is_requested(); };
    PlanResult result;
    try {
      result.plan = find_plan(scene_, *goal_, give_up);
      if (!result.plan.status() || !result.plan.outcome.whole) {
        std::cerr << options_.scene << ": "
                  << (result.plan.status() ? "the plan comes to no end" : no_plan_text(scene_, result.plan))
                  << '\n';
        return false;
      }
      if (has_prior(scene_))
        result.prior = outcome_over_prior(scene_, *goal_, result.plan.jacks, result.plan.stages, {}, give_up);
    } catch (const GivenUp&) {
      return false;
    }
    for (const std::string& said : plan_sentences(scene_, *goal_, result))
      std::cerr << "plan: " << said << '\n';
    guide_ = std::make_unique<PlanGuide>(
        scene_, *goal_, read_text(options_.goal, largest_text_file, "goal file"), result.plan, result.prior);
    if (state_ && !state_->plan().empty() && !guide_->go_on(state_->plan()))
      std::cerr << "remark: " << options_.state
                << " has a plan to another goal: its stages are found anew from the rows\n";
    else
      goes_on_in_plan_ = state_ && !state_->plan().empty();
    return true;
  }

  bool has_plan_changed() {
    if (!guide_) return false;
    const std::lock_guard<std::mutex> lock(showing_);
    return guide_->take_change();
  }

  // Of a row: where the jacks stand in the plan, and whether it is to be found anew.
  void guide(const LogRow& row, const Answer& answer) {
    if (!goes_on_in_plan_ && rows_ == 1) guide_->begin(known_mu(follower_->scene()));
    std::vector<double> factor = row.factor;
    for (std::size_t i = 0; i < factor.size(); ++i)
      if (!follower_->has_column(scene_.loads[i].name)) factor[i] = goal_->factor[i];
    std::optional<PlanRequest> request = guide_->take(row, answer, factor, !is_replaying_);
    if (request) planner_->ask(std::move(*request));
  }

  // From the thread that plans: the same numbers once more, with another plan.
  void take_plan(const PlanFound& found) {
    const std::lock_guard<std::mutex> lock(showing_);
    guide_->take(found);
    LiveAnswer live;
    if (const LiveAnswerPtr newest = board_.newest()) live = *newest;
    publish(std::move(live));
  }

  void show(const LogRow& row, const Answer& answer) {
    std::vector<std::array<bool, 2>> has_stroke;
    for (const CableDescription& cable : scene_.cables)
      has_stroke.push_back({follower_->has_column(cable.name + ".start.stroke"),
                            follower_->has_column(cable.name + ".end.stroke")});
    const std::lock_guard<std::mutex> lock(showing_);
    LiveAnswer live;
    live.row = ++rows_;
    live.time = rounded(row.time, time_digits);
    live.answer = with_deserved_digits(answer);
    live.jacks = jacks_of(scene_, row, live.answer, has_stroke);
    live.alarms = words_of(answer.alarms);
    live.notices = words_of(answer.notices);
    if (unreadable_rows_ > 0) {
      --unreadable_rows_;
      live.notices.emplace_back(unreadable);
    }
    if (guide_) guide(row, answer);
    publish(std::move(live));
  }

  // Between two rows: the same numbers once more, with or without a word about the line.
  void tell(bool is_silent) {
    if (!is_silent && !is_silent_) return;
    is_silent_ = is_silent;
    std::cerr << "remark: " << name() << ": " << (is_silent ? "the line is silent" : "rows come again")
              << std::endl;
    if (!is_silent) return;  // the next row says so
    const std::lock_guard<std::mutex> lock(showing_);
    LiveAnswer live;
    if (const LiveAnswerPtr newest = board_.newest()) live = *newest;
    live.alarms.emplace_back(silent);
    publish(std::move(live));
  }

  void publish(LiveAnswer live) {
    if (guide_) {
      PlanNow now = guide_->now();
      const auto is_limit = [](const std::string& word) { return word.compare(0, 11, "plan-limit:") == 0; };
      live.alarms.erase(std::remove_if(live.alarms.begin(), live.alarms.end(), is_limit), live.alarms.end());
      live.alarms.insert(live.alarms.end(), now.alarms.begin(), now.alarms.end());
      live.plan = std::make_shared<const PlanNow>(std::move(now));
    }
    live.json = answer_json(scene_, live);
    history_.add(live);
    board_.put(std::make_shared<const LiveAnswer>(std::move(live)));
  }

  const WatchOptions& options_;
  SceneDescription scene_;  // as the file has it
  bool is_serial_;
  RunOptions run_;
  std::unique_ptr<PlanGoal> goal_;
  StopSignal stop_;
  AnswerBoard board_;
  LoadHistory history_;
  std::unique_ptr<Pace> pace_;
  std::unique_ptr<WatchState> state_;
  std::unique_ptr<RecordFile> record_;
  bool repeats_record_ = false;
  std::unique_ptr<LogFollower> follower_;
  std::mutex showing_;  // rows and new plans come from two threads
  std::unique_ptr<PlanGuide> guide_;
  std::unique_ptr<Planner> planner_;
  bool is_replaying_ = false, goes_on_in_plan_ = false;
  std::size_t rows_ = 0;
  int left_out_ = 0, unreadable_rows_ = 0;
  bool is_silent_ = false;
};

}  // namespace

int watch(const WatchOptions& options) {
  require_possible(options);
  return Watch(options).run();
}

}  // namespace taut::host
