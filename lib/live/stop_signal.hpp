// Whether somebody has asked the program to end.
#pragma once

namespace taut::host {

/// While it lives, SIGINT, SIGTERM and SIGHUP are requests to end in good order. The second one ends the
/// program as it would have without this. A signal that is ignored, as by nohup, stays so. One object at a
/// time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  bool is_requested() const;
  /// What poll() finds readable once it is requested.
  int descriptor() const;
  /// Waits that long, or until it is requested.
  void wait(int milliseconds) const;
  /// As if a signal had come.
  void request() const;
};

/// While it lives, signals go to other threads than those that are started.
class SignalsHeldBack {
 public:
  SignalsHeldBack();
  ~SignalsHeldBack();
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;
};

}  // namespace taut::host
