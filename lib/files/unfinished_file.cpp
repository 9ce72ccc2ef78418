#include "lib/files/unfinished_file.hpp"

#ifndef _WIN32
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#endif

namespace taut::host {

#ifdef _WIN32

std::FILE* open_unfinished(const char* path) { return std::fopen(path, "wbx"); }
void forget_unfinished(const char*) {}

#else

namespace {

constexpr std::array<int, 4> ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

std::array<std::atomic<const char*>, most_unfinished> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait for a lock");

// The default action is back in force when this is called: the signal still ends the program.
extern "C" void remove_unfinished(int signal) {
  for (auto& each : unfinished)
    if (const char* const path = each.exchange(nullptr)) unlink(path);
  raise(signal);
}

// A signal that is ignored, as by nohup, stays so.
void watch(int signal) {
  struct sigaction action {};
  if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  action.sa_handler = remove_unfinished;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  sigaction(signal, &action, nullptr);
}

}  // namespace

std::FILE* open_unfinished(const char* path) {
  sigset_t held, before;
  sigemptyset(&held);
  for (const int signal : ending_signals) sigaddset(&held, signal);
  for (const int signal : ending_signals) watch(signal);
  // Between making the file and noting it no signal may come.
  pthread_sigmask(SIG_BLOCK, &held, &before);
  const auto room = std::find(unfinished.begin(), unfinished.end(), nullptr);
  std::FILE* file = nullptr;
  errno = EMFILE;
  if (room != unfinished.end()) file = std::fopen(path, "wbx");
  const int reason = errno;
  if (file != nullptr) *room = path;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = reason;
  return file;
}

void forget_unfinished(const char* path) {
  const auto noted = std::find(unfinished.begin(), unfinished.end(), path);
  if (noted != unfinished.end()) *noted = nullptr;
}

#endif

}  // namespace taut::host
