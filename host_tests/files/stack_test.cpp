// The program does with little stack what it does with much.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "files/run_program.hpp"

namespace {

/// A cable over so many fixed saddles, which needs the largest class of the program.
std::string many_saddles(int joints) {
  std::string nodes, supports, path;
  for (int i = 0; i < joints + 2; ++i) {
    const std::string comma = i == 0 ? "" : ", ", name = "\"n" + std::to_string(i) + "\"";
    nodes += comma + name + ": [" + std::to_string(i) + (i % 2 == 0 ? ", 0]" : ", -0.1]");
    supports += comma + name + ": \"xy\"";
    path += comma + name;
  }
  return "{ \"taut\": 1, \"name\": \"many saddles\", \"dimension\": 2, \"nodes\": {" + nodes +
         "}, \"supports\": {" + supports + "}, \"cables\": [ { \"name\": \"C\", \"path\": [" + path +
         "], \"E\": 2e11, \"A\": 1e-3, \"start\": \"anchored\", \"end\": \"jacked\", "
         "\"friction\": { \"law\": \"point\", \"mu\": 0.05, \"mu_sd\": 0.02, \"shared\": true } } ] }";
}

}  // namespace

TEST_CASE("every command answers for a large scene where the stack is limited to 1 MiB") {
  const Scratch scratch;
  std::ofstream(scratch.path / "scene.json") << many_saddles(120);
  std::ofstream(scratch.path / "log.csv") << "time,C.end\n0,50000\n1,100000\n2,60000\n3,120000\n4,0\n";
  const std::string scene = scratch.quoted("scene.json"), files = scene + " " + scratch.quoted("log.csv");
  CHECK(run_taut(scratch, "check " + scene).out.find("capacity class          large\n") != std::string::npos);
  const std::string commands[] = {"check " + scene,
                                  "export " + scene,
                                  "simulate " + files,
                                  "simulate --scalar float " + files,
                                  "simulate --method stepwise " + files,
                                  "estimate " + files,
                                  "estimate --scalar float " + files,
                                  "report " + files + " -o " + scratch.quoted("report.html")};
  for (const std::string& command : commands) {
    INFO(command);
    const Outcome limited = run_taut(scratch, command, "ulimit -s 1024");
    CHECK(limited.status == 0);
    CHECK(limited.out == run_taut(scratch, command).out);
  }
}
