#include "lib/files/unfinished_file.hpp"

#ifndef _WIN32
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#endif

namespace taut::host {

#ifdef _WIN32

std::FILE* open_unfinished(const char* path) { return std::fopen(path, "wbx"); }
void forget_unfinished() {}

#else

namespace {

constexpr std::array<int, 4> ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

std::atomic<const char*> unfinished = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler must not wait for a lock");

// The default action is back in force when this is called: the signal still ends the program.
extern "C" void remove_unfinished(int signal) {
  if (const char* const path = unfinished.exchange(nullptr)) unlink(path);
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
  std::FILE* const file = std::fopen(path, "wbx");
  if (file != nullptr) unfinished = path;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return file;
}

void forget_unfinished() { unfinished = nullptr; }

#endif

}  // namespace taut::host
