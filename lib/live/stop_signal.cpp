#include "lib/live/stop_signal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>

namespace taut::host {
namespace {

constexpr std::array<int, 3> stopping = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> requested = false;
std::array<int, 2> ends = {-1, -1};  // of a pipe, so that poll() wakes up
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait for a lock");

extern "C" void take_request(int) {
  const int error = errno;
  requested = true;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = write(ends[1], &byte, 1);
  errno = error;
}

thread_local sigset_t before;

}  // namespace

StopSignal::StopSignal() {
  requested = false;
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "no pipe for signals");
  for (const int end : ends) {
    fcntl(end, F_SETFD, FD_CLOEXEC);
    fcntl(end, F_SETFL, O_NONBLOCK);
  }
  for (const int signal : stopping) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = take_request;
    sigemptyset(&action.sa_mask);
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, nullptr);
  }
}

StopSignal::~StopSignal() {
  for (const int signal : stopping) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != take_request) continue;
    action.sa_handler = SIG_DFL;
    sigaction(signal, &action, nullptr);
  }
  for (int& end : ends) {
    close(end);
    end = -1;
  }
}

bool StopSignal::is_requested() const { return requested; }

int StopSignal::descriptor() const { return ends[0]; }

void StopSignal::wait(int milliseconds) const {
  pollfd waiting{ends[0], POLLIN, 0};
  poll(&waiting, 1, milliseconds);
}

void StopSignal::request() const { take_request(0); }

SignalsHeldBack::SignalsHeldBack() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
}

SignalsHeldBack::~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }

}  // namespace taut::host
