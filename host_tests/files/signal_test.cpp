// A run that a signal ends leaves no part of its result behind.
#include <doctest/doctest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "files/run_program.hpp"
#include "lib/files/output_file.hpp"

namespace fs = std::filesystem;

namespace {

/// The program in the middle of a run that would take hours, with its result begun.
class LongRun {
 public:
  /// `ignored`: a signal that is ignored from the start, as by nohup; 0 for none.
  explicit LongRun(const Scratch& scratch, int ignored = 0) : folder_(scratch.path) {
    std::ofstream log(folder_ / "log.csv");
    log << "time,C.end\n";
    for (int row = 1; row <= 10000; ++row) log << row << ",1000\n";
    log.close();
    const std::string log_path = (folder_ / "log.csv").string(), result = (folder_ / "result.csv").string();
    process_ = fork();
    if (process_ == 0) {
      if (ignored != 0) signal(ignored, SIG_IGN);
      const int nothing = open("/dev/null", O_WRONLY);
      dup2(nothing, 2);
      execl(TAUT_PROGRAM, "taut", "simulate", TAUT_FILES "/one_jack.json", log_path.c_str(), "-o",
            result.c_str(), "--method", "stepwise", "--substeps", "1000000", static_cast<char*>(nullptr));
      _exit(127);
    }
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!has_part() && std::chrono::steady_clock::now() < patience)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    REQUIRE(has_part());
  }
  ~LongRun() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  LongRun(const LongRun&) = delete;
  LongRun& operator=(const LongRun&) = delete;

  void send(int signal) const { kill(process_, signal); }
  /// The signal that ended the program; 0 if it ended by itself.
  int ended_by() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }
  bool has_part() const {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().find(".part") != std::string::npos) return true;
    return false;
  }

 private:
  fs::path folder_;
  pid_t process_ = 0;
};

}  // namespace

TEST_CASE("a signal ends the run as ever, and nothing is left of the result that was begun") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    const Scratch scratch;
    LongRun run(scratch);
    run.send(signal);
    CHECK(run.ended_by() == signal);
    CHECK_FALSE(run.has_part());
    CHECK_FALSE(fs::exists(scratch.path / "result.csv"));
  }
}

TEST_CASE("a signal leaves an older result as it was") {
  const Scratch scratch;
  std::ofstream(scratch.path / "result.csv") << "older";
  LongRun run(scratch);
  run.send(SIGTERM);
  CHECK(run.ended_by() == SIGTERM);
  CHECK_FALSE(run.has_part());
  CHECK(text_of(scratch.path / "result.csv") == "older");
}

TEST_CASE("a signal that was to be ignored is ignored") {
  const Scratch scratch;
  LongRun run(scratch, SIGHUP);
  run.send(SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  CHECK(run.has_part());
  run.send(SIGTERM);
  CHECK(run.ended_by() == SIGTERM);
  CHECK_FALSE(run.has_part());
}

TEST_CASE("a signal leaves none of several results that were begun at once, and what was finished stays") {
  const Scratch scratch;
  const auto path = [&](const char* name) { return (scratch.path / name).string(); };
  const pid_t process = fork();
  if (process == 0) {
    signal(SIGTERM, SIG_DFL);  // not that of the test runner
    taut::host::OutputFile first(path("first")), done(path("done")), third(path("third"));
    done.write("whole");
    done.finish();
    taut::host::OutputFile fourth(path("fourth"));
    raise(SIGTERM);
    _exit(1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  CHECK(WIFSIGNALED(status));
  CHECK(text_of(path("done")) == "whole");
  CHECK(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()) == 1);
}
