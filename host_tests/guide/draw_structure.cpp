// The drawing of `taut report` as a picture of its own, for light and dark:
//
//     draw_structure SCENE LOG -o OUT.svg
//
// Cables have the colours of the forces that `taut estimate` finds in the last row.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "lib/commands/log_follower.hpp"
#include "lib/kinds/own_stack.hpp"
#include "lib/report/page_style.hpp"
#include "lib/report/run_record.hpp"
#include "lib/report/structure_drawing.hpp"

namespace {

using namespace taut::host;

std::string picture(const RunOptions& run) {
  LogFollower follower(run);
  RunRecord record(follower.scene());
  const Sentence end =
      follower.follow([&](const LogRow& row, const Answer& answer) { record.add(row, answer); });
  if (!end.empty()) throw std::runtime_error(end.english());
  const ForceScale scale(record.end.tension);
  const ForceUnit unit = ForceUnit::for_largest(scale.high);
  const std::string drawing = structure_drawing(follower.scene(), record, unit, scale);
  const std::string begin = "<svg ";
  const std::size_t content = drawing.find('>') + 1;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + drawing.substr(begin.size(), content - begin.size()) +
         "\n<style>" + page_style + force_colour_rules() + "</style>\n" + drawing.substr(content) + "\n";
}

int draw(int count, char** words) {
  try {
    if (count != 5 || std::string(words[3]) != "-o")
      throw std::runtime_error("usage: draw_structure SCENE LOG -o OUT.svg");
    RunOptions run;
    run.scene = words[1];
    run.log = words[2];
    run.method = Method::estimate;
    const std::string text = picture(run);
    std::ofstream(words[4]) << text;
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace

int main(int count, char** words) {
  return taut::host::call_with_own_stack([&] { return draw(count, words); });
}
