// How a tracker is driven along with conditioned loads: straight on, or through corners.
#pragma once

#include <cstddef>

#include "taut/estimation/jack_loads.hpp"
#include "taut/numerics/larger.hpp"
#include "taut/status.hpp"
#include "taut/tracking/tracker.hpp"

namespace taut {

/// Drives the tracker to the loads of a row if nothing happens on the way but that one load changes. Returns
/// false if and only if more does; then nothing was done. Cost: that of Tracker::try_to_extend().
template <class TrackerType, class Jacks, class SampleType>
[[nodiscard]] bool try_extend(TrackerType& tracker, Jacks& jacks, const SampleType& given) {
  using Cap = typename TrackerType::Cap;
  // With one jack alone the compiler knows what can change.
  if constexpr (Jacks::capacity == 1 && Cap::loads == 0) {
    if (jacks.empty() || jacks[0].locked) return false;
    const auto load = jacks[0].target();
    if (!tracker.try_to_extend(0, load)) return false;
    jacks[0].driven.force = load;
  } else {
    const auto to = jacks.target(given);
    if (!tracker.try_to_extend(to)) return false;
    jacks.arrive(to, load_patterns(tracker.model()));
  }
  return true;
}

/// The progress along one path after another.
template <class Scalar>
Progress<Scalar> join(const Progress<Scalar>& first, Progress<Scalar> then) {
  then.events += first.events;
  then.fraction *= first.status ? first.fraction : Scalar(1);
  return then;
}

/// Drives the tracker straight to these loads, two jacks as far as friction holds them: where a cable is
/// pulled through, to what hold.pull_less(cable, to) leaves of `to`, and on from there if hold.raise(cable)
/// finds more friction. `to` is then where the tracker is. Fails as Tracker::advance() does. Cost: that of
/// Tracker::advance(), at most four times more a cable.
template <class TrackerType, class SampleType, class Hold>
Progress<typename TrackerType::Scalar> drive_straight(TrackerType& tracker, SampleType& to, int event_budget,
                                                      const Hold& hold) {
  auto progress = tracker.advance(to, event_budget);
  const auto go_on = [&] { progress = join(progress, tracker.advance(to, event_budget)); };
  for (int count = 0;
       progress.status.code == Code::pulled_through && count < 2 * tracker.model().cables.size(); ++count) {
    const int c = progress.status.index;
    const auto wanted = to;
    if (!hold.pull_less(c, to)) break;
    go_on();
    if (!progress.is_complete() || !hold.raise(c)) continue;
    to = wanted;
    go_on();
  }
  return progress;
}

/// Notes where a path to `to` has ended. Returns whether that is there. Cost: a few operations a jack.
template <class TrackerType, class Jacks, class SampleType>
bool arrive(const TrackerType& tracker, Jacks& jacks, const SampleType& to,
            const Progress<typename TrackerType::Scalar>& progress) {
  const int patterns = load_patterns(tracker.model());
  const bool is_there = progress.is_complete();
  if (is_there)
    jacks.arrive(to, patterns);
  else
    jacks.arrive(tracker.loads(), patterns);
  return is_there;
}

/// Where the path to `to` has ended without an answer: there may be more friction, which hold.stand(progress,
/// go_on, bounds) finds, or a jack may pull more than it is taken to, and a structure that leans on its cable
/// may have an answer then. Drives the tracker on from there with every unlocked jack where it was to come,
/// and one, two and three standard deviations above its best estimate, until there is an answer; `to` is then
/// where that is. Otherwise fails as before. Cost: that of drive_straight() and hold.stand() eight times.
template <class TrackerType, class Jacks, class SampleType, class Hold>
Progress<typename TrackerType::Scalar> look_for_answer(TrackerType& tracker, const Jacks& jacks,
                                                       SampleType& to, int event_budget, const Hold& hold,
                                                       Progress<typename TrackerType::Scalar> progress) {
  using Scalar = typename TrackerType::Scalar;
  constexpr int most = 3;
  const auto lacks_answer = [](Code code) {
    return code == Code::mechanism || code == Code::gives_way || code == Code::state_iterations;
  };
  const auto go_on = [&] { return drive_straight(tracker, to, event_budget, hold); };
  // That a load is off by a deviation is as likely as that friction is.
  for (const int bounds : Hold::bounds)
    for (int deviations = 0; deviations <= most && lacks_answer(progress.status.code); ++deviations) {
      bool pulls = deviations == 0;
      for (int k = 0; k < jacks.size(); ++k) {
        const Scalar sd = larger(jacks[k].at.sd, jacks[k].filter.sd());
        if (jacks[k].locked || !(jacks[k].filter.sd() > 0)) continue;
        const Scalar target = jacks[k].target();
        jacks.in(to.jack, k).force =
            deviations == 0 ? target
                            : larger(target, jacks[k].at.load) + static_cast<Scalar>(deviations) * sd;
        pulls = true;
      }
      if (!pulls) break;
      if (deviations > 0) progress = join(progress, go_on());
      progress = hold.stand(progress, go_on, bounds);
    }
  return progress;
}

/// Drives the tracker to where jacks were a row ago, before the other loads began to change, then to where
/// loads have reversed, some of them twice, then to the loads that ends had when they were locked. leave(to)
/// is called before each path; remember(k, sd, turns) where jack `k` reversed or was locked at a load of that
/// standard deviation [N], and whether it turned there; remember_load(k) where it was a row ago, or once it
/// has reversed since. Fails as Tracker::advance() does. Cost: that of drive_straight() five times.
template <class TrackerType, class Jacks, class Leave, class Remember, class RememberLoad, class Hold>
Progress<typename TrackerType::Scalar> drive_through(TrackerType& tracker, Jacks& jacks,
                                                     const Corners<typename TrackerType::Scalar>& corners,
                                                     int event_budget, const Leave& leave,
                                                     const Remember& remember,
                                                     const RememberLoad& remember_load, const Hold& hold) {
  auto corner = jacks.driven(load_patterns(tracker.model()));
  Progress<typename TrackerType::Scalar> progress;
  // Goes where place(k) is, with the jacks with is_there(k), and remembers that.
  const auto go = [&](const auto& is_there, const auto& place, const auto& keep) {
    bool any = false;
    for (int k = 0; k < jacks.size(); ++k) {
      if (!progress.status || !is_there(k)) continue;
      jacks.in(corner.jack, k) = {place(k), jacks.in(corner.jack, k).locked && jacks[k].locked};
      any = true;
    }
    if (!any) return;
    leave(corner);
    progress = join(progress, drive_straight(tracker, corner, event_budget, hold));
    for (int k = 0; k < jacks.size(); ++k)
      if (progress.status && is_there(k)) keep(k);
  };
  // A load that went up, or came down, until it was at `to` has been no farther: driven back there, joints
  // would stick at a load of which nothing is remembered.
  const auto come_no_farther = [&](int k, bool has_gone_up, auto to) {
    const auto from = jacks.in(corner.jack, k).force;
    if (has_gone_up ? to < from : to > from) tracker.correct_load(k, to);
    return to;
  };
  const auto a_row_ago = [&](int k) { return jacks[k].corner(); };
  const auto has_reversed = [&](int k) { return jacks[k].has_reversed(); };
  if (corners.loads) go([&](int k) { return !has_reversed(k); }, a_row_ago, remember_load);
  if (corners.reverses) {
    go([&](int k) { return jacks[k].turned_before; },
       [&](int k) { return come_no_farther(k, jacks[k].had_risen_before(), jacks[k].first_turn); },
       [&](int k) { remember(k, jacks[k].first_turn_sd, true); });
    go(
        has_reversed, [&](int k) { return come_no_farther(k, jacks[k].had_risen(), jacks[k].at.reversal); },
        [&](int k) { remember(k, jacks[k].turn_sd, true); });
  }
  if (corners.loads)
    go([&](int k) { return has_reversed(k) && jacks[k].changes_rest(); }, a_row_ago, remember_load);
  if (corners.locks)
    go([&](int k) { return jacks[k].locks_now; },
       [&](int k) { return come_no_farther(k, jacks[k].locks_rising(), jacks[k].at.load); },
       [&](int k) { remember(k, jacks[k].lock_sd, jacks[k].locks_rising()); });
  return progress;
}

/// Drives the tracker through the corners to `target`, where more happens than that a load changes. Fails as
/// Tracker::advance() does; the jacks are then where the path ended. Cost: that of drive_straight() six
/// times, and of look_for_answer().
template <class TrackerType, class Jacks, class SampleType, class Leave, class Remember, class RememberLoad,
          class Hold>
[[gnu::noinline]] Progress<typename TrackerType::Scalar> drive(
    TrackerType& tracker, Jacks& jacks, const Corners<typename TrackerType::Scalar>& corners,
    const SampleType& target, int event_budget, const Leave& leave, const Remember& remember,
    const RememberLoad& remember_load, const Hold& hold) {
  Progress<typename TrackerType::Scalar> progress;
  if (corners.any())
    progress = drive_through(tracker, jacks, corners, event_budget, leave, remember, remember_load, hold);
  SampleType to = target;
  if (progress.status) leave(to);
  if (progress.status) progress = join(progress, drive_straight(tracker, to, event_budget, hold));
  if (!progress.status) progress = look_for_answer(tracker, jacks, to, event_budget, hold, progress);
  if (progress.status.code != Code::not_started) arrive(tracker, jacks, to, progress);
  return progress;
}

}  // namespace taut
