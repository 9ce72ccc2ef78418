// What is tried: one thing that a site does to an estimator in each case.
#pragma once

#include <string>
#include <vector>

#include "estimation_site/instruments.hpp"
#include "estimation_site/jacking.hpp"
#include "estimation_site/site.hpp"

namespace estimation_site {

/// What is asked of the estimator in `--check`.
enum class Demand {
  model,     ///< the case is within the declared model
  accuracy,  ///< the instruments lie as far as is declared
  alarm      ///< something is off by a certain amount
};

struct Case {
  std::string name;
  Demand demand = Demand::accuracy;
  GroundRules ground;
  JackingRules jacking;
  InstrumentRules instruments;
  bool with_far = true, without_far = true;  ///< far-end cell
  bool logs_dead = false, logs_sun = false, logs_stroke = false;
  std::size_t locks_late = 0;    ///< so many rows after an end was locked the log says so
  bool unlocks_early = false;    ///< that it is no more as soon as the pump runs, while its wedge holds yet
  bool gauges_segments = false;  ///< one a cable, at neither end
  bool gauges_struts = false;    ///< both at one joint of each cable (trusses)
  bool silent = false;           ///< the scene has no sensors
};

inline void make_typical_mix(Case& mix) {
  mix.instruments.jack_gain_sd = mix.instruments.far_gain_sd = 0.01;
  mix.instruments.zero_sd = 0.002;
  mix.jacking.ram = 0.015;
  mix.jacking.ram_sd = 0.0075;
  mix.ground.scatter = 0.1;
  mix.ground.E_sd = 0.03;
  mix.instruments.noise = 1.3;
}

/// Two or three of them.
inline void put_cables_below_truss(Case& tried) {
  tried.ground.truss_only = true;
  tried.ground.most_cables = 3;
}

inline std::vector<Case> all_cases(int year_rows) {
  std::vector<Case> cases;
  const auto add = [&](const char* name, Demand demand = Demand::accuracy) -> Case& {
    cases.emplace_back();
    cases.back().name = name;
    cases.back().demand = demand;
    return cases.back();
  };
  add("clean", Demand::model);
  // What differs in instruments alone comes together, for the jackings are the same.
  add("jack-gain-1").instruments.jack_gain_sd = 0.01;
  add("jack-gain-2").instruments.jack_gain_sd = 0.02;
  add("offset").instruments.zero_sd = 0.005;
  add("noise-twice").instruments.noise = 2;
  add("loose-plug").instruments.loose_plug = true;
  {
    Case& c = add("display");
    c.instruments.step = 0.01;
    c.instruments.least_sd = 0.0005;
    c.instruments.most_sd = 0.002;
  }
  {
    Case& c = add("frozen-cell", Demand::alarm);
    c.instruments.far_freezes = true;
    c.without_far = false;
  }
  {
    Case& c = add("off-by-gain-2", Demand::alarm);
    c.instruments.jack_gain_sd = 0.02;
    c.instruments.sized = true;
    c.without_far = false;
  }
  add("no-sensors").silent = true;
  add("own-mu", Demand::model).ground.shared = false;
  {
    Case& c = add("load-factor", Demand::model);
    c.ground.truss_only = c.jacking.dead_load = c.logs_dead = true;
  }
  {
    Case& c = add("temperature-logged", Demand::model);
    c.jacking.warming = 8;
    c.jacking.lock = c.logs_sun = true;
  }
  {
    Case& c = add("leaking-pump", Demand::model);
    c.jacking.least_leak = 0.0005;
    c.jacking.most_leak = 0.02;
  }
  {
    Case& c = add("pumped-again", Demand::model);
    c.jacking.least_leak = 0.005;
    c.jacking.most_leak = 0.02;
    c.jacking.pumped_again = true;
  }
  add("cells-in-turn", Demand::model).instruments.in_turn = true;
  add("held-cells").instruments.is_held = true;
  add("drop-outs", Demand::model).instruments.drops_out = true;
  {
    Case& c = add("drop-outs-of-both", Demand::model);
    c.instruments.drops_out = c.instruments.far_drops_out = true;
    c.jacking.visit = true;
  }
  {
    Case& c = add("wrong-readings");
    c.instruments.wrong = 0.02;
    c.jacking.visit = true;
  }
  for (const bool in_stages : {false, true}) {
    Case& c = add(in_stages ? "late-locks-in-stages" : "late-locks", Demand::alarm);
    c.locks_late = in_stages ? 2 : 3;
    c.jacking.lock = true;
    c.jacking.stages = in_stages;
  }
  {
    Case& c = add("unlocked-early", Demand::model);
    c.unlocks_early = c.jacking.visit = true;
  }
  {
    Case& c = add("far-end-tared");
    c.jacking.rests = true;
    c.instruments.zero_sd = 0.002;
    c.instruments.far_tared = 0.03;
    c.without_far = false;
  }
  {
    Case& c = add("other-clock");
    c.instruments.other_clock = 8;
    c.without_far = false;
  }
  add("any-pace", Demand::model).jacking.any_pace = true;
  {
    Case& c = add("cables-in-turns", Demand::model);
    c.jacking.in_turns = true;
    put_cables_below_truss(c);
  }
  add("second-visit", Demand::model).jacking.visit = true;
  {
    Case& c = add("two-jacks", Demand::model);
    c.ground.two_jacks = true;
    c.with_far = false;
  }
  {
    Case& c = add("jacks-in-turn", Demand::model);
    c.ground.two_jacks = c.jacking.jacks_in_turn = true;
    c.ground.wedges = c.with_far = false;
  }
  {
    Case& c = add("jacks-in-turn-strokes");
    c.ground.two_jacks = c.jacking.jacks_in_turn = c.logs_stroke = true;
    c.ground.wedges = c.with_far = false;
    c.ground.E_sd = 0.03;
    c.instruments.jack_gain_sd = 0.01;
  }
  add("load-stages", Demand::model).jacking.stages = true;
  {
    Case& c = add("even-stages", Demand::model);
    c.jacking.stages = c.jacking.even = true;
  }
  {
    Case& c = add("mistyped-stages");
    c.jacking.stages = c.jacking.even = c.instruments.mistyped = true;
    c.instruments.step = 0.001;
  }
  {
    Case& c = add("turns", Demand::model);
    c.jacking.swings = c.jacking.lock = true;
  }
  {
    Case& c = add("turns-in-stages", Demand::model);
    c.jacking.swings = c.jacking.lock = c.jacking.stages = true;
  }
  {
    Case& c = add("pressure-gauge");
    c.jacking.ram = 0.02;
    c.jacking.ram_sd = 0.01;
  }
  add("mu-scatter").ground.scatter = 0.2;
  {
    Case& c = add("seating");
    c.ground.seating_sd = 0.5;
    c.jacking.lock = true;
  }
  {
    Case& c = add("temperature-not-logged");
    c.jacking.warming_locked = 10;
    c.jacking.lock = true;
  }
  {
    Case& c = add("noise-correlated");
    c.instruments.memory = 1;
    c.jacking.least_rate = 5;
    c.jacking.every_row = true;
  }
  add("pump-ripple").jacking.ripple = 0.005;
  add("filtered-cells").instruments.filtered = true;
  {
    Case& c = add("elongation-loop");
    c.jacking.loop = c.logs_stroke = true;
    c.ground.E_sd = 0.03;
    c.with_far = false;
  }
  {
    Case& c = add("elongation-loop-stages");
    c.jacking.loop = c.jacking.stages = c.logs_stroke = true;
    c.ground.E_sd = 0.03;
    c.with_far = false;
  }
  const auto add_segment_gauge = [&](const char* name) -> Case& {
    Case& c = add(name);
    c.gauges_segments = true;
    c.instruments.gauge_gain_sd = 0.01;
    c.instruments.gauge_zero_sd = 0.005;
    return c;
  };
  add_segment_gauge("segment-gauge");
  add_segment_gauge("segment-gauge-stages").jacking.stages = true;
  const auto add_strut_gauges = [&](const char* name, Demand demand) -> Case& {
    Case& c = add(name, demand);
    c.gauges_struts = c.ground.truss_only = true;
    c.instruments.gauge_gain_sd = 0.02;
    c.instruments.gauge_zero_sd = 0.01;
    return c;
  };
  add_strut_gauges("strut-gauges", Demand::accuracy);
  add_strut_gauges("gauge-freezes", Demand::alarm).instruments.gauges_freeze = true;
  add_strut_gauges("gauge-creeps", Demand::alarm).instruments.gauge_creep = 0.1;
  {
    Case& c = add("year");
    c.jacking.year_rows = year_rows;
    c.logs_sun = true;
    c.without_far = false;
  }
  {
    Case& c = add("off-by-10-kelvin", Demand::alarm);
    c.jacking.warming_locked = 10;
    c.jacking.lock = c.jacking.sized = true;
    c.without_far = false;
  }
  make_typical_mix(add("typical-mix"));
  {
    Case& c = add("cables-together", Demand::model);
    c.jacking.together = true;
    put_cables_below_truss(c);
  }
  {
    Case& c = add("cables-in-stages", Demand::model);
    c.jacking.in_turns = c.jacking.stages = true;
    put_cables_below_truss(c);
  }
  {
    Case& c = add("cables-in-turns-mix");
    make_typical_mix(c);
    c.jacking.in_turns = true;
    put_cables_below_truss(c);
  }
  make_typical_mix(add("typical-mix-silent"));
  cases.back().silent = true;
  return cases;
}

}  // namespace estimation_site
