#include "lib/kinds/own_stack.hpp"

#ifndef _WIN32
#include <pthread.h>
#include <signal.h>
#endif

#include <cstddef>

namespace taut::host {

#ifdef _WIN32

int call_with_own_stack(const std::function<int()>& function) { return function(); }

#else

namespace {

// What is not touched takes no memory. Checked builds need several times what optimised ones do.
constexpr std::size_t stack_size = std::size_t{64} << 20;

struct Call {
  const std::function<int()>& function;
  int result = 0;
  sigset_t signals{};  // that the caller held back
};

extern "C" void* make_call(void* argument) {
  auto& call = *static_cast<Call*>(argument);
  pthread_sigmask(SIG_SETMASK, &call.signals, nullptr);
  call.result = call.function();
  return nullptr;
}

}  // namespace

int call_with_own_stack(const std::function<int()>& function) {
  Call call{function};
  pthread_attr_t attributes;
  pthread_t thread;
  if (pthread_attr_init(&attributes) != 0) return function();
  // Signals are for the thread that works: what it holds back, nobody else must take.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &call.signals);
  const bool runs = pthread_attr_setstacksize(&attributes, stack_size) == 0 &&
                    pthread_create(&thread, &attributes, make_call, &call) == 0;
  pthread_attr_destroy(&attributes);
  if (runs) pthread_join(thread, nullptr);
  pthread_sigmask(SIG_SETMASK, &call.signals, nullptr);
  return runs ? call.result : function();
}

#endif

}  // namespace taut::host
