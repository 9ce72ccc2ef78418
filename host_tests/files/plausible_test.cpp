// What is possible and yet surely a mistake is refused with its place and remedy, unless it is meant.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "files/result_table.hpp"
#include "files/run_program.hpp"

namespace {

/// A cable of 10 m over a saddle, E A = 2e7 N, jacked at its end.
struct Site {
  std::string E = "2e11", coordinates = "[0, 0]", prestrain = "0", more, sensors, wedge,
              friction = R"("law": "point", "mu": 0.1, "mu_sd": 0.05)";
  std::string text(bool plausible) const {
    return R"({ "taut": 1, "name": "site", "dimension": 2, )" +
           std::string(plausible ? "" : "\"plausible\": false, ") + R"("nodes": { "a": )" + coordinates +
           R"(, "b": [5, -0.5], "c": [10, 0] }, "supports": { "a": "xy", "b": "xy", "c": "xy" },
  "cables": [ { "name": "C", "path": ["a", "b", "c"], "E": )" +
           E + R"(, "A": 1e-4, "start": "anchored", "end": "jacked", "prestrain": )" + prestrain + wedge +
           R"(, "friction": { )" + friction + R"( } } ], "sensors": { )" + sensors + "}" + more + " }";
  }
};

Outcome run(const Scratch& scratch, const Site& site, const std::string& command, const std::string& log,
            bool plausible = true) {
  std::ofstream(scratch.path / "scene.json") << site.text(plausible);
  std::ofstream(scratch.path / "log.csv") << log;
  return run_taut(scratch, command + " " + scratch.quoted("scene.json") +
                               (command == "check" ? "" : " " + scratch.quoted("log.csv")));
}

// Refused with the message, which is one line and names the way out; taken where it is meant.
void check_refused(const Site& site, const std::string& command, const std::string& log,
                   const std::string& message) {
  const Scratch scratch;
  const Outcome refused = run(scratch, site, command, log);
  CHECK(refused.status == 2);
  CHECK(refused.out.empty());
  CHECK_MESSAGE(refused.err.find(message) != std::string::npos, refused.err);
  CHECK(refused.err.find("; if it is meant, \"plausible\": false in the scene switches such checks off\n") !=
        std::string::npos);
  CHECK(run(scratch, site, command, log, false).err.find("if it is meant") == std::string::npos);
}
std::string check_taken(const Site& site, const std::string& command, const std::string& log) {
  const Scratch scratch;
  const Outcome outcome = run(scratch, site, command, log);
  CHECK_MESSAGE(outcome.status == 0, outcome.err);
  return outcome.err;
}

// A ramp with the friction of nobody's choice: so many rows up to a force, with what else each has.
template <class Row>
std::string ramp(const std::string& header, int rows, const Row& row) {
  std::string log = header + "\n";
  for (int i = 1; i <= rows; ++i) log += std::to_string(i) + "," + row(i) + "\n";
  return log;
}
std::string up_to(double most, int rows, int i) { return std::to_string(most * i / rows); }

}  // namespace

TEST_CASE("a modulus in GPa or MPa is refused, for a strut too; those of steel, carbon and ropes are taken") {
  Site site;
  for (const char* const E : {"200", "2e5", "2e13"}) {
    site.E = E;
    check_refused(site, "check", "", "scene.json: /cables/0/E: a modulus of ");
  }
  for (const char* const E : {"1e9", "2.1e11", "1e12"}) {
    site.E = E;
    check_taken(site, "check", "");
  }
  site = Site();
  site.more = R"(, "struts": [ { "nodes": ["b", "c"], "E": 210000, "A": 1e-3 } ])";
  check_refused(site, "check", "", "scene.json: /struts/0/E: a modulus of 210000 N/m2 is that of no strut; ");
  // A spring of 1e6 N/m, and what is to be rigid.
  site.more =
      R"(, "struts": [ { "nodes": ["b", "c"], "E": 1, "A": 5e6 }, { "nodes": ["a", "b"], "E": 2e15, "A": 1 } ])";
  check_taken(site, "check", "");
}

TEST_CASE("a prestrain in per cent is refused at its place") {
  Site site;
  site.prestrain = "0.3";
  check_refused(site, "check", "",
                "scene.json: /cables/0/prestrain: a strain of 0.3 is more than a cable takes; ");
  site.prestrain = "[0.001, 0.021]";
  check_refused(site, "check", "", "scene.json: /cables/0/prestrain/1: ");
  site.prestrain = "[0.02, -0.1]";
  check_taken(site, "check", "");
}

TEST_CASE("loads, temperatures and the target of second-order theory that are absurd are refused by place") {
  Site site;
  site.more = R"(, "loads": { "dead": { "forces": { "b": [0, -1e30] } } })";
  check_refused(site, "check", "",
                "scene.json: /loads/dead/forces/b: a load of -1e+30 N on a node is that of no structure; ");
  site.more = R"(, "loads": { "warm": { "temperature": { "C": 2000 } } })";
  check_refused(site, "check", "",
                "scene.json: /loads/warm/temperature/C: a change of temperature by 2000 K ");
  const auto target = [&](const std::string& loads, const std::string& force) {
    site.more = R"(, "loads": { "dead": { "forces": { "b": [0, -1000] } } }, "second_order": { "target": {
      "loads": { "dead": )" +
                loads + R"( }, "forces": { "C.end": )" + force + " } } }";
  };
  target("1", "1e30");
  check_refused(
      site, "check", "",
      "scene.json: /second_order/target/forces/C.end: a jack force of 1e+30 N is more than the cable "
      "can carry; write one in N, below 2e+06");
  target("-1e30", "1e5");
  check_refused(site, "check", "", "scene.json: /second_order/target/loads/dead: a load of ");
}

TEST_CASE("a thermal expansion in parts of a million is refused, and a temperature that no cable has") {
  Site site;
  for (const char* const alpha : {"12", "-0.002"}) {
    site.wedge = std::string(R"(, "alpha": )") + alpha;
    check_refused(site, "check", "", "scene.json: /cables/0/alpha: a thermal expansion of ");
  }
  site.wedge = R"(, "alpha": 1.2e-5, "temperature_sd": 1200)";
  check_refused(site, "check", "",
                "scene.json: /cables/0/temperature_sd: a temperature that is known to 1200 K ");
  // Of carbon it is below zero, of polymers ten times that of steel.
  for (const char* const alpha : {"-1e-6", "2e-4"}) {
    site.wedge = std::string(R"(, "temperature_sd": 20, "alpha": )") + alpha;
    check_taken(site, "check", "");
  }
}

TEST_CASE("coordinates in mm are refused where they make a cable longer than 10 km") {
  Site site;
  site.coordinates = "[-20000, 0]";
  check_refused(site, "check", "", "scene.json: /cables/0/path: the cable is 20010 m long; ");
  site.coordinates = "[-9000, 0]";
  check_taken(site, "check", "");
}

TEST_CASE("a jack force that strains the cable by more than 2 % is refused by its row") {
  check_refused(
      {}, "simulate", "time,C.end\n1,300000\n2,500000\n",
      "log.csv: line 3, column 2 (C.end): the jack force 5e+05 strains cable \"C\" by more than 2 %; "
      "write a force below 4e+05 N: is the unit wrong?");
  check_taken({}, "simulate", "time,C.end\n1,300000\n2,400000\n");
}

TEST_CASE("readings in N under a header in kN are refused; a single wrong one is for the estimator") {
  check_refused(
      {}, "estimate", ramp("time,C.end [kN]", 20, [](int i) { return up_to(2e4, 20, i); }),
      "log.csv: line 2, column 2 (C.end): the jack force 1e+06, as most here, strains cable \"C\" by more "
      "than 2 %; write the unit of the column after its name, as in C.end [N]");
  check_taken({}, "estimate",
              ramp("time,C.end", 20, [](int i) { return i == 9 ? "9.9e37" : up_to(2e4, 20, i); }));
}

TEST_CASE("forces in kN or MN without their unit are refused; 1 kN on a strand is taken") {
  // 19 kN in MN; and in kN the least and the most that cables are strained by, 0.1 and 0.7 %.
  for (const double most : {0.019, 20.0, 140.0})
    check_refused(
        {}, "estimate", ramp("time,C.end", 20, [&](int i) { return up_to(most, 20, i); }),
        "log.csv: line 1, column 2 (C.end): no jack strains its cable by as much as 1e-5 in the whole log; "
        "write the unit of the column after its name, as in C.end [kN]");
  check_taken({}, "estimate", ramp("time,C.end", 20, [](int i) { return up_to(1000, 20, i); }));
  check_taken({}, "estimate", "time,C.end\n1,0\n2,0\n3,0\n4,0\n");
  check_taken({}, "simulate", "time,C.end\n1,1\n2,2\n3,3\n4,4\n");
}

TEST_CASE("load stages in kN without their unit are refused, and thousands after a comma; noise is taken") {
  // Stages are on no line, and what they scatter by is as large as they are.
  const std::vector<int> stages = {0, 13, 30, 55, 47, 65, 95, 105, 130, 90, 120};
  const int rows = static_cast<int>(stages.size());
  const auto stage = [&](int i) { return std::to_string(stages.at(static_cast<std::size_t>(i - 1))); };
  const std::string message =
      "no jack strains its cable by as much as 1e-5 in the whole log; write the unit "
      "of the column after its name, as in C.end [kN]";
  check_refused({}, "estimate", ramp("time,C.end", rows, [&](int i) { return stage(i); }),
                "log.csv: line 1, column 2 (C.end): " + message + "; if");
  const auto semicolons = [](std::string log) {
    log.replace(log.find("time,C"), 6, "time;C");
    for (std::size_t at = log.find('\n'); at != std::string::npos; at = log.find('\n', at + 1))
      if (const std::size_t comma = log.find(',', at); comma != std::string::npos) log[comma] = ';';
    return log;
  };
  check_refused({}, "estimate",
                semicolons(ramp("time,C.end", rows, [&](int i) { return stage(i) + (i > 1 ? ",000" : ""); })),
                message + ", or leave out commas that stand for thousands; if");
  check_taken({}, "estimate", ramp("time,C.end", rows, [&](int i) { return stage(i) + "000"; }));
  std::uint32_t random = 1;
  for (const int readings : {30, 60, 30000})
    check_taken({}, "estimate", ramp("time,C.end", readings, [&](int row) {
                  int noise = 60 * row / readings;  // a zero that drifts, and four that are nearly normal
                  for (int i = 0; i < 4; ++i) {
                    random = random * 1664525U + 1013904223U;
                    noise += static_cast<int>(random >> 26) - 32;
                  }
                  return std::to_string(noise);
                }));
}

TEST_CASE("strokes in mm without the unit are refused; from any mark and with a wrong one they are taken") {
  const auto strokes = [](double from, double to, int wrong) {
    return ramp("time,C.end,C.end.stroke", 20, [&](int i) {
      return up_to(2e4, 20, i) + "," +
             (i == wrong ? std::string("999") : std::to_string(from + (to - from) * i / 20));
    });
  };
  check_refused({}, "estimate", strokes(0, 10, 0),
                "log.csv: line 20, column 3 (C.end.stroke): strokes go from 1 to 9.5 m, "
                "over more than a tenth of cable \"C\"; ");
  check_refused({}, "estimate", strokes(0, 10, 0), "as in C.end.stroke [mm]");
  check_taken({}, "estimate", strokes(7.4, 7.41, 0));
  check_taken({}, "estimate", strokes(0, 0.01, 7));
}

TEST_CASE(
    "a force in kN without the unit is refused where the stroke grows as if it were a thousand times "
    "larger") {
  // 300 kN stretch the cable by 150 mm; 300 N would by 0.15.
  const auto log = [](double newtons, double slack, double softness) {
    return ramp("time,C.end,C.end.stroke", 20, [=](int i) {
      const double part = i / 20.0;
      return std::to_string(newtons * part) + "," +
             std::to_string(0.3 + slack * std::min(1.0, 5 * part) + softness * 0.15 * part);
    });
  };
  check_refused(Site(), "estimate", log(300, 0, 1),
                "; write the unit of the column after its name, as in C.end [kN]");
  check_refused(Site(), "estimate", log(300, 0, 1), "where cable \"C\" itself stretches by 0.0");
  check_refused(Site(), "estimate", log(300, 0.1, 3), "C.end [kN]");
  check_taken(Site(), "estimate", log(3e5, 0, 1));
  check_taken(Site(), "estimate", log(3e5, 0.2, 1));  // slack that is taken out first
  check_taken(Site(), "estimate", log(3e5, 0, 5));    // a structure five times as soft as its cable
}

TEST_CASE("a cell that scatters by more than its cable ever pulls is refused at its place in the scene") {
  Site site;
  site.sensors = R"("C.start": { "sd": 200 } )";
  const auto log = [](double most) {
    return ramp("time,C.start,C.end", 50,
                [&](int i) { return up_to(0.9 * most, 50, i) + "," + up_to(most, 50, i); });
  };
  check_refused(site, "estimate", log(350),
                "scene.json: /sensors/C.start/sd: a cell that scatters by 200 N where the jacks of its cable "
                "pull at most 350 N; ");
  check_taken(site, "estimate", log(1000));  // a first stage
  // A tenth of a jacking that is under way.
  site.sensors = R"("C.start": { "sd": 5000 } )";
  check_refused(site, "estimate", log(49000),
                "scatters by 5000 N where the jacks of its cable pull at most 49000 N; write sd in N");
  check_taken(site, "estimate", log(51000));
  // At rest there is nothing but noise.
  check_taken(site, "estimate", ramp("time,C.start,C.end", 50, [](int i) {
                return std::string(i % 3 == 0 ? "90,-80" : "-70,60");
              }));
}

TEST_CASE("a log without the jack is refused where other instruments read the cable under load") {
  check_refused(
      {}, "estimate", ramp("time,C.start", 5, [](int i) { return up_to(900, 5, i); }),
      "log.csv: line 1: there is no column \"C.end\", though other instruments read cable \"C\" under load; "
      "add the force of this jack");
  check_refused({}, "estimate", ramp("# site\ntime,C.end.stroke", 5, [](int i) { return up_to(0.01, 5, i); }),
                "log.csv: line 2: there is no column \"C.end\"");
  check_taken({}, "estimate", ramp("time,C.start", 5, [](int) { return std::string("0"); }));
  check_taken({}, "simulate", ramp("time,C.start", 5, [](int i) { return up_to(900, 5, i); }));
}

TEST_CASE("friction in per cent is refused, but not a joint that locks itself") {
  Site site;
  for (const char* const friction :
       {R"("law": "capstan", "mu": 12, "mu_sd": 0.05)", R"("law": "capstan", "mu": [2.5])"}) {
    site.friction = friction;
    check_refused(site, "check", "", "scene.json: /cables/0/friction/mu: a friction coefficient of ");
  }
  for (const char* const friction :
       {R"("law": "point", "mu": 0.12, "mu_sd": 3)", R"("law": "capstan", "mu": 0.12, "mu_sd": 1.5)"}) {
    site.friction = friction;
    check_refused(site, "check", "", "scene.json: /cables/0/friction/mu_sd: a standard deviation of ");
  }
  site.friction = R"("law": "point", "mu": 0.12, "mu_sd": 0.05, "scatter": 10)";
  check_refused(site, "check", "", "/cables/0/friction/scatter: a relative standard deviation of 10 tells ");
  for (const char* const friction :
       {R"("law": "point", "mu": 50, "mu_sd": 5)", R"("law": "capstan", "mu": 1.2, "mu_sd": 0.9)",
        R"("law": "point", "mu": 0.12, "mu_sd": 0.5, "scatter": 0.9)"}) {
    CAPTURE(friction);
    site.friction = friction;
    check_taken(site, "check", "");
  }
}

TEST_CASE("a draw-in in mm and a deviation of E A in per cent are refused") {
  Site site;
  site.wedge = R"(, "seating": 6)";
  check_refused(site, "check", "",
                "scene.json: /cables/0/seating: no wedge is drawn in by 6 m; write it in m");
  site.wedge = R"(, "seating": 0.006, "seating_sd": 2)";
  check_refused(site, "check", "", "scene.json: /cables/0/seating_sd: no wedge is drawn in by 2 m");
  site.wedge = R"(, "E_sd": 3)";
  check_refused(site, "check", "", "scene.json: /cables/0/E_sd: a relative standard deviation of 3 tells ");
  site.wedge = R"(, "seating": 0.03, "seating_sd": 0.01, "E_sd": 0.2)";
  check_taken(site, "check", "");
}

TEST_CASE("a column that goes over to another unit is refused where it does; a load that is let out is not") {
  const Site site;
  const auto log = [](double times, double noise) {
    return ramp("time,C.end", 60, [=](int i) {
      const double load = i <= 30 ? 1000.0 * i : 30000 + 10 * (i % 3), off = i % 2 == 0 ? noise : -noise;
      return std::to_string(i <= 40 ? load + off : (load + off) / times);
    });
  };
  for (const double times : {1e3, 1e6}) {
    CAPTURE(times);
    check_refused(site, "estimate", log(times, 50),
                  "log.csv: line 42, column 2 (C.end): from one row to the next ");
  }
  check_refused(
      site, "estimate",
      ramp("time,C.end", 60, [](int i) { return std::to_string(i <= 30 ? 1.0 * i : 1000.0 * 30); }),
      "log.csv: line 32, column 2 (C.end): from one row to the next the force goes from 30 to 30000 N");
  // What is left of a load, twice what would be a thousandth, and noise about that.
  check_taken(site, "estimate", log(500, 50));
  check_taken(site, "estimate", ramp("time,C.end", 60, [](int i) {
                return std::to_string(i <= 30 ? 1000.0 * i : 30 * (1 + 0.3 * (i % 4)));
              }));
  // Behind a wedge, where a logger goes on writing what was read last; in another unit once it pulls again.
  const auto locked = [](int first_row_after) {
    return ramp("time,C.end,C.end.locked", 60, [=](int i) {
      const bool is_after = i >= first_row_after;
      return i <= 30 ? std::to_string(1000.0 * i) + ",0" : is_after ? "30.1,0" : "30.1,1";
    });
  };
  check_taken(site, "estimate", locked(100));
  check_refused(site, "estimate", locked(50),
                "log.csv: line 51, column 2 (C.end): from one row to the next ");
}

TEST_CASE(
    "an end that is locked rows after its load was let out is taken with a remark, one that is not without") {
  // A ramp of thirty rows, five at rest, and what the jack reads until it is locked for five.
  const auto remark = [](const std::vector<double>& then) {
    const Scratch scratch;
    std::string log = "time,C.end,C.end.locked\n";
    int row = 0;
    const auto add = [&](double load, int locked) {
      log += std::to_string(++row) + "," + std::to_string(load) + "," + std::to_string(locked) + "\n";
    };
    for (int i = 1; i <= 35; ++i) add(1000.0 * std::min(i, 30), 0);
    for (const double load : then) add(load, 0);
    for (int i = 0; i < 5; ++i) add(0, 1);
    const Outcome outcome = run(scratch, Site(), "estimate", log);
    CHECK_MESSAGE(outcome.status == 0, outcome.err);
    const auto found = outcome.err.find("remark: the load of ");
    return found == std::string::npos ? "" : outcome.err.substr(found, outcome.err.find('\n', found) - found);
  };
  CHECK(remark({20000, 8000, 10}) ==
        "remark: the load of \"C.end\" falls from 30000 to 10 N after line 36, and the end is locked in line "
        "40: if its wedge was drawn in before, \"C.end.locked\" is 1 from line 37 on");
  CHECK(remark({}).empty());
  // Overstressed, misread, and let out slowly.
  CHECK(remark({29500, 29000, 28500}).empty());
  CHECK(remark({60000, 30000}).empty());
  std::vector<double> slowly;
  for (int i = 0; i < 40; ++i) slowly.push_back(30000 - 700.0 * i);
  CHECK(remark(slowly).empty());
}

TEST_CASE("a jack that is let out behind a wedge of which no row says that it holds is not to be trusted") {
  const std::string doubt = "do not trust: the wedge at C.end may hold though no row has it locked";
  const auto verdicts = [](const std::string& wedge, const std::string& rows) {
    const Scratch scratch;
    Site site;
    site.wedge = wedge;
    return Table(run(scratch, site, "estimate", "time,C.end,C.end.locked\n" + rows).out).column("verdict");
  };
  const std::string wedge = R"(, "seating": 0.002)",
                    let_out = "0,0,0\n60,10000,0\n120,20000,0\n180,30000,0\n240,0,0\n300,0,0\n360,0,0\n";
  const auto found = verdicts(wedge, let_out);
  REQUIRE(found.size() == 7);
  for (std::size_t i = 0; i < 5; ++i) CHECK(found[i] == "trust");
  CHECK(found[5] == doubt);
  CHECK(found[6] == doubt);
  // Without a wedge it is let out.
  for (const std::string& verdict : verdicts("", let_out)) CHECK(verdict == "trust");
  // On the way up again forces are what the wedge makes them, until the jack has pulled more than before.
  const auto pulled = verdicts(wedge, let_out + "420,15000,0\n480,30000,0\n540,35000,0\n600,40000,0\n");
  REQUIRE(pulled.size() == 11);
  CHECK(pulled[7].find(doubt) == 0);
  CHECK(pulled[8].find(doubt) == 0);
  CHECK(pulled[10].find("wedge") == std::string::npos);
  // A far end that has come down with it says that it does not.
  std::string stages = "time,C.end,C.start\n";
  for (int i = 0; i < 7; ++i)
    stages += std::to_string(60 * i) +
              (i < 4   ? "," + std::to_string(1e4 * i) + "," + std::to_string(9800 * i)
               : i < 5 ? ",0,500"
                       : ",0,400") +
              "\n";
  const Scratch scratch;
  Site site;
  site.wedge = wedge;
  for (const std::string& verdict : Table(run(scratch, site, "estimate", stages).out).column("verdict"))
    CHECK(verdict.find("wedge") == std::string::npos);
  // Once the log says that it holds, it was late.
  const auto late = verdicts(wedge, let_out + "420,0,1\n480,0,1\n");
  REQUIRE(late.size() == 9);
  for (std::size_t i : {7, 8})
    CHECK(late[i] == "do not trust: the wedge at C.end may have held before the log says so");
}

TEST_CASE(
    "a wedge of which no row says that it holds is not to be trusted in the log of the next visit, too") {
  const std::string head = "time,C.end,C.end.locked\n",
                    rows = "0,0,0\n60,10000,0\n120,20000,0\n180,30000,0\n240,0,0\n300,0,0\n360,15000,0\n";
  Site site;
  site.wedge = R"(, "seating": 0.002)";
  for (std::size_t cut = rows.find('\n') + 1; cut < rows.size(); cut = rows.find('\n', cut) + 1) {
    const Scratch scratch;
    const std::string command = "estimate --state " + scratch.quoted("state");
    std::vector<std::string> verdicts;
    for (const std::string& visit : {rows.substr(0, cut), rows.substr(cut)})
      for (const std::string& verdict :
           Table(run(scratch, site, command, head + visit).out).column("verdict"))
        verdicts.push_back(verdict);
    REQUIRE(verdicts.size() == 7);
    CAPTURE(cut);
    for (std::size_t i = 0; i < verdicts.size(); ++i)
      CHECK((verdicts[i] == "do not trust: the wedge at C.end may hold though no row has it locked") ==
            (i >= 5));
  }
}

TEST_CASE(
    "a jack that is let out though its wedge never holds, or locked in the row of its load, is remarked on") {
  const auto remarks = [](const std::string& wedge, const std::string& log) {
    Site site;
    site.wedge = wedge;
    return check_taken(site, "estimate", log);
  };
  const std::string wedge = R"(, "seating": 0.002)",
                    let_out = "time,C.end\n0,0\n60,10000\n120,20000\n180,30000\n240,0\n300,0\n";
  CHECK(remarks(wedge, let_out)
            .find("remark: the load of \"C.end\" falls from 30000 N to next to nothing after line 5, and the "
                  "end is "
                  "never locked: if its wedge was drawn in there, \"C.end.locked\" is 1 from line 6 on; if "
                  "it has "
                  "none, leave out \"seating\"\n") != std::string::npos);
  // Without a wedge it is let out, and one row is a slip.
  CHECK(remarks("", let_out).find("never locked") == std::string::npos);
  CHECK(remarks(wedge, "time,C.end\n0,0\n60,20000\n120,0\n180,30000\n").find("never locked") ==
        std::string::npos);
  CHECK(remarks(wedge, "time,C.end\n0,0\n60,9000\n120,300000\n180,10000\n240,12000\n300,14000\n")
            .find("never locked") == std::string::npos);
  const std::string stages = "time,C.end,C.end.locked\n0,0,0\n60,10000,0\n120,20000,0\n";
  CHECK(
      remarks(wedge, stages + "180,30000,1\n240,0,1\n")
          .find("remark: the load 30000 N of \"C.end\" in line 5 is not used, for the end is locked in that "
                "row, and 20000 N before: if the jack pulled it before the wedge was drawn in, give it a row "
                "of its own before that\n") != std::string::npos);
  for (const char* locked : {"180,20100,1\n", "180,0,1\n", "180,30000,0\n240,30000,1\n"})
    CHECK(remarks(wedge, stages + locked).find("is not used") == std::string::npos);
}

TEST_CASE("the cell of a jack that rests off zero before its load rises is remarked on") {
  const auto remarks = [](const std::string& cell, const std::string& log) {
    Site site;
    site.sensors = cell;
    return check_taken(site, "estimate", log);
  };
  // Rests with noise of 20 N at `rest`, then goes up to 40 kN more.
  const auto log = [](double rest, int rows) {
    const auto row = [&](int i) {
      const double pull = i > rows ? 400.0 * (i - rows) : 0, noise = 20 * std::sin(2.3 * i);
      return std::to_string(rest + pull + noise);
    };
    return ramp("time,C.end", rows + 100, row);
  };
  const std::string cell = R"("C.end": { "sd": 20 })", said = R"("C.end": { "sd": 20, "zero_sd": 500 })";
  const std::string remark =
      "before its load rises: if nothing pulls there, take that off all of its readings";
  for (const int rows : {6, 30, 300}) {
    CAPTURE(rows);
    const std::string found = remarks(cell, log(1200, rows));
    CHECK(found.find(" N in its first " + std::to_string(rows) + " rows, " + remark) != std::string::npos);
    CHECK(found.find("remark: \"C.end\" reads 1") != std::string::npos);
  }
  for (const double rest : {1200.0, -1200.0})
    CHECK(remarks(cell, log(rest, 30)).find(remark) != std::string::npos);
  // A zero as it is said to be, or as that of any cell is; a load from which the log begins; no rest at all.
  CHECK(remarks(said, log(1200, 30)).find(remark) == std::string::npos);
  CHECK(remarks(R"("C.end": { "exact": true })", log(1200, 30)).find(remark) == std::string::npos);
  CHECK(remarks(cell, log(60, 30)).find(remark) == std::string::npos);
  CHECK(remarks(cell, log(8000, 30)).find(remark) == std::string::npos);
  CHECK(remarks(cell, log(1200, 3)).find(remark) == std::string::npos);
  CHECK(remarks(cell, log(0, 0)).find(remark) == std::string::npos);
}

// Up to 40 kN with two holds on the way, a hold, and down to 20 kN; friction holds a fiftieth back.
double load(double t) {
  const auto part = [&](double from, double to) { return std::clamp((t - from) / (to - from), 0.0, 1.0); };
  return 1e4 * (part(10, 30) + 1.5 * part(50, 80) + 1.5 * part(100, 130) - 2 * part(150, 170));
}
double far_end(double t) { return std::max(0.98 * load(std::min(t, 150.0)), 0.0); }
// Of row i, with noise of 20 N.
std::string read_text(double force, int i, double phase) {
  return std::to_string(force + 20 * std::sin(2.3 * i + phase));
}

TEST_CASE("a far end that is shown later than its jack is remarked on with how much later it is") {
  const auto loosely = [&](double t) { return t < 150 ? far_end(t) : std::min(far_end(t), load(t) / 0.98); };
  const auto remarks = [](const std::string& log, const std::string& lag = "") {
    Site site;
    site.sensors = R"("C.end": { "sd": 20 }, "C.start": { "sd": 20)" + lag + " }";
    const std::string all = check_taken(site, "estimate", log);
    const std::size_t at = all.find("remark: \"C.");
    return at == std::string::npos ? "" : all.substr(at, all.find('\n', at) - at);
  };
  const auto log = [&](double later, const auto& at_far_end) {
    return ramp("time,C.end,C.start", 180, [&](int i) {
      return read_text(load(i), i, 0) + "," + read_text(at_far_end(i - later), i, 1);
    });
  };
  const std::string way_out =
      ", and that is taken off: let the clocks of loggers agree; if an amplifier averages, write \"lag\": 3 "
      "for it";
  CHECK(remarks(log(3, far_end)) == "remark: \"C.start\" is read 3 s later than \"C.end\"" + way_out);
  CHECK(remarks(log(-3, far_end)) == "remark: \"C.end\" is read 3 s later than \"C.start\"" + way_out);
  CHECK(remarks(log(40, far_end)).find("\"C.start\" is read 40 s later than \"C.end\"") != std::string::npos);
  // As two loggers, each with rows of its own.
  std::string in_turn = "time,C.end,C.start\n";
  for (int i = 1; i <= 180; ++i)
    in_turn += std::to_string(i) + "," + read_text(load(i), i, 0) + ",\n" + std::to_string(i + 0.4) + ",," +
               read_text(far_end(i + 0.4 - 5), i, 1) + "\n";
  CHECK(remarks(in_turn).find("\"C.start\" is read 5 s later") != std::string::npos);
  // Behind a filter, with which a ramp is 3 s late and a hold is not.
  double filtered = 0;
  const auto slowly = [&](double t) { return filtered += (far_end(t) - filtered) / 4; };
  const std::string lagging = log(0, slowly), found = remarks(lagging), late = "\"C.start\" is read ";
  REQUIRE(found.find(late) != std::string::npos);
  const double seconds = std::stod(found.substr(found.find(late) + late.size()));
  CHECK(seconds >= 2);
  CHECK(seconds <= 3);
  CHECK(remarks(lagging, R"(, "lag": 4)").empty());
  // Nearly as long as the way up, on which a hold would be on a path of its own.
  std::string at_once = "time,C.end,C.start\n";
  const auto quickly = [](double t) { return 4e4 * std::clamp(t / 13, 0.0, 1.0); };
  for (int i = 1; i <= 280; ++i)
    at_once += std::to_string(i / 10.0) + "," + read_text(quickly(i / 10.0), i, 0) + "," +
               read_text(0.95 * quickly(i / 10.0 + 7), i, 1) + "\n";
  CHECK(remarks(at_once).find("\"C.end\" is read 7 s later") != std::string::npos);
  // With it taken off friction is what it is without it, and so are forces.
  const auto answers = [&](double later) {
    const Scratch scratch;
    Site site;
    site.sensors = R"("C.end": { "sd": 20 }, "C.start": { "sd": 20 })";
    return Table(run(scratch, site, "estimate", log(later, far_end)).out);
  };
  const Table in_time = answers(0);
  for (const double later : {-3.0, 3.0}) {
    const Table off = answers(later);
    CAPTURE(later);
    CHECK(std::fabs(off.number(144, "C.mu1") - in_time.number(144, "C.mu1")) < 0.002);
    CHECK(std::fabs(off.number(144, "C.T1") / in_time.number(144, "C.T1") - 1) < 0.001);
  }
  // What is no gap: none, friction that lets the far end come down, a cell that stops, values that are
  // written again, load stages.
  CHECK(remarks(log(0, far_end)).empty());
  CHECK(remarks(log(0.2, far_end)).empty());
  CHECK(remarks(log(0, loosely)).empty());
  CHECK(remarks(log(0, [&](double t) { return far_end(std::min(t, 60.0)); })).empty());
  CHECK(remarks(ramp("time,C.end,C.start", 180, [&](int i) {
          const int read = i - i % 3;
          return read_text(load(read), read, 0) + "," + read_text(far_end(i), i, 1);
        })).empty());
  // A jack that is let out at once, while friction holds the far end.
  for (const double down : {200.0, 500.0, 800.0, 1200.0}) {
    CAPTURE(down);
    const auto at_once_down = [&](double t) { return t < 46 ? 1000 * t : 46000 - down * (t - 46); };
    CHECK(remarks(ramp("time,C.end,C.start", 60, [&](int i) {
            return read_text(at_once_down(i), i, 0) + "," +
                   read_text(0.9 * at_once_down(std::min(i, 46)), i, 1);
          })).empty());
  }
  // A part of the way that the jack's cell does not show, of one that has no corner but its end.
  const auto up_and_down = [](double t) { return 4e4 * std::min(t / 120, 2 - t / 120); };
  for (const int from : {10, 15, 20, 25, 30, 60, 90}) {
    CAPTURE(from);
    CHECK(remarks(ramp("time,C.end,C.start", 180, [&](int i) {
            const bool is_lost = i > from && i < from + 20;
            return (is_lost ? "" : read_text(up_and_down(i), i, 0)) + "," +
                   read_text(0.9 * up_and_down(std::min(i, 120)), i, 1);
          })).empty());
  }
  std::string stages = "time,C.end,C.start\n";
  for (int i = 1; i <= 18; ++i)
    stages += std::to_string(60 * i) + "," + read_text(load(10 * i), i, 0) + "," +
              read_text(far_end(10 * i - 20), i, 1) + "\n";
  CHECK(remarks(stages).find("later") == std::string::npos);
}

TEST_CASE("far ends of several cables are brought into time each by what it is off by") {
  const std::string cable =
      R"("path": ["a", "b", "c"], "E": 2e11, "A": 1e-4, "start": "anchored", "end": "jacked",
      "friction": { "law": "point", "mu": 0.1, "mu_sd": 0.05 } })";
  const std::string scene = R"({ "taut": 1, "name": "two", "dimension": 2,
      "nodes": { "a": [0, 0], "b": [5, -0.5], "c": [10, 0] }, "supports": { "a": "xy", "b": "xy", "c": "xy" },
      "cables": [ { "name": "C", )" +
                            cable + R"(, { "name": "D", )" + cable + R"( ],
      "sensors": { "C.end": { "sd": 20 }, "C.start": { "sd": 20 }, "D.end": { "sd": 20 }, "D.start": { "sd": 20 } } })";
  // That of C is not read for half a minute.
  const auto answers = [&](double later_at_C, double later_at_D) {
    const Scratch scratch;
    std::ofstream(scratch.path / "scene.json") << scene;
    std::ofstream(scratch.path / "log.csv") << ramp("time,C.end,C.start,D.end,D.start", 180, [&](int i) {
      const std::string of_C = i > 95 && i < 125 ? "" : read_text(far_end(i - later_at_C), i, 1);
      return read_text(load(i), i, 0) + "," + of_C + "," + read_text(load(i), i, 2) + "," +
             read_text(far_end(i - later_at_D), i, 3);
    });
    const Outcome outcome =
        run_taut(scratch, "estimate " + scratch.quoted("scene.json") + " " + scratch.quoted("log.csv"));
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    if (later_at_C != 0) {
      CHECK(outcome.err.find("\"C.start\" is read 3 s later than \"C.end\"") != std::string::npos);
      CHECK(outcome.err.find("\"D.end\" is read 20 s later than \"D.start\"") != std::string::npos);
    }
    return Table(outcome.out);
  };
  const Table in_time = answers(0, 0), off = answers(3, -20);
  for (const char* name : {"C", "D"}) {
    CAPTURE(name);
    const std::string mu = std::string(name) + ".mu1", force = std::string(name) + ".T1";
    CHECK(std::fabs(off.number(144, mu) - in_time.number(144, mu)) < 0.002);
    CHECK(std::fabs(off.number(144, force) / in_time.number(144, force) - 1) < 0.001);
  }
}

TEST_CASE("an area in mm2 is refused by name") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") <<
      R"({ "taut": 1, "name": "n", "dimension": 2, "nodes": { "a": [0, 0], "b": [10, 0] }, "supports": { "a": "xy",
      "b": "xy" }, "cables": [ { "name": "C", "path": ["a", "b"], "E": 2e11, "A": 140, "start": "anchored",
      "end": "jacked" } ] })";
  const Outcome refused = run_taut(scratch, "check " + scratch.quoted("scene.json"));
  CHECK(refused.status == 2);
  CHECK_MESSAGE(
      refused.err.find("/cables/0/A: a cross-section of 140 m2 is that of no cable; write it in m2, as "
                       "in 1.4e-3") != std::string::npos,
      refused.err);
}

TEST_CASE("plausible is true or false") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json")
      << R"({ "taut": 1, "name": "n", "dimension": 2, "plausible": "no", "nodes": { "a": [0, 0] } })";
  CHECK(run_taut(scratch, "check " + scratch.quoted("scene.json")).err.find("/plausible: ") !=
        std::string::npos);
}

TEST_CASE("a drift of mu, which is not used yet, is remarked on where mu is estimated") {
  const Scratch scratch;
  Site site;
  site.sensors = R"("C.end": { "exact": true })";
  const std::string
      log = "time,C.end\n1,10000\n2,20000\n",
      remark = "remark: the drift of mu of cable \"C\" is not used yet: mu is taken to stay what it is\n";
  CHECK(run(scratch, site, "estimate", log).err.empty());
  site.friction += R"(, "drift": 0.05)";
  CHECK(run(scratch, site, "estimate", log).err == remark);
  CHECK(run(scratch, site, "simulate", log).err.empty());
}
