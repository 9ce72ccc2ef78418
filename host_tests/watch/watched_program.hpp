// `taut watch` as a process that is fed, looked at and ended.
#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "files/run_program.hpp"

/// Whether it comes true in so many seconds.
inline bool comes_true(const std::function<bool()>& condition, double seconds = 20) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < until) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return condition();
}

/// The program in a folder, with standard input from a pipe, standard output and standard error to the files
/// `out` and `err` of the folder.
class WatchedProgram {
 public:
  WatchedProgram(const Scratch& scratch, std::vector<std::string> arguments, int output = -1)
      : scratch_(scratch) {
    std::filesystem::remove(scratch.path / "err");
    int input[2] = {-1, -1};
    REQUIRE(pipe2(input, O_CLOEXEC) == 0);
    arguments.insert(arguments.begin(), {"taut", "watch"});
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const std::string folder = scratch.path.string();
    process_ = fork();
    if (process_ == 0) {
      if (chdir(folder.c_str()) != 0) _exit(126);
      dup2(input[0], STDIN_FILENO);
      const int out = output >= 0 ? output : open("out", O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(out, STDOUT_FILENO);
      dup2(open("err", O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
      execv(TAUT_PROGRAM, pointers.data());
      _exit(127);
    }
    close(input[0]);
    input_ = input[1];
  }
  ~WatchedProgram() {
    close_input();
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  WatchedProgram(const WatchedProgram&) = delete;
  WatchedProgram& operator=(const WatchedProgram&) = delete;

  /// False if the program takes no more.
  bool write(const std::string& text) const {
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t count = ::write(input_, text.data() + done, text.size() - done);
      if (count <= 0) return false;
      done += static_cast<std::size_t>(count);
    }
    return true;
  }
  void close_input() {
    if (input_ >= 0) close(input_);
    input_ = -1;
  }
  void send(int signal) const { kill(process_, signal); }
  pid_t process() const { return process_; }
  /// Exit status, 128 and the signal that ended it, or -1 if it goes on.
  int ended(double seconds = 20) {
    int status = 0;
    if (process_ <= 0 ||
        !comes_true([&] { return waitpid(process_, &status, WNOHANG) == process_; }, seconds))
      return -1;
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  bool is_running() const { return process_ > 0 && waitpid(process_, nullptr, WNOHANG) == 0; }

  std::string out() const { return text_of(scratch_.path / "out"); }
  std::string err() const { return text_of(scratch_.path / "err"); }
  /// The port that the program says it listens at.
  int port() const {
    int found = 0;
    const std::string before = "http://127.0.0.1:";
    REQUIRE(comes_true([&] {
      const std::string text = err();
      const std::size_t at = text.find(before);
      if (at == std::string::npos || text.find('\n', at) == std::string::npos) return false;
      found = std::stoi(text.substr(at + before.size()));
      return true;
    }));
    return found;
  }

 private:
  const Scratch& scratch_;
  pid_t process_ = 0;
  int input_ = -1;
};
