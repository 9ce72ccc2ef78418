// Forces at large displacements for a scene and a log of taut:
//
//     large_displacements SCENE LOG [-o OUT] [--steps N] [--pieces N] [--present-length]
//     large_displacements --compare RESULT REFERENCE
//     large_displacements --ends MESSAGE MESSAGE LOG
//     large_displacements --summary LINES
//     large_displacements --scenes
//     large_displacements --write NAME DIR
//
// README.md here says what each is. Exit status as that of taut: 1 where no stable equilibrium is found.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "large_displacements/comparison.hpp"
#include "large_displacements/result.hpp"
#include "large_displacements/scene_file.hpp"
#include "large_displacements/scenes.hpp"

namespace large_displacements {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string out;
  int steps = 8, pieces = 1;
  bool present_length = false;
};

Options read_options(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto next = [&]() -> std::string {
      if (++i >= count) throw std::runtime_error(word + " needs a value");
      return words[i];
    };
    if (word == "-o")
      options.out = next();
    else if (word == "--steps")
      options.steps = std::stoi(next());
    else if (word == "--pieces")
      options.pieces = std::stoi(next());
    else if (word == "--present-length")
      options.present_length = true;
    else
      options.files.push_back(word);
  }
  if (options.files.size() != 2 || options.steps < 1 || options.pieces < 1)
    throw std::runtime_error(
        "usage: large_displacements SCENE LOG [-o OUT] [--steps N] [--pieces N] [--present-length]");
  return options;
}

/// Says how far the path went, in the words of the log.
void say_where(const Model& model, const Path& path, const Reached& reached, std::size_t row) {
  std::fprintf(stderr, "row %zu: no stable equilibrium beyond %.9g of the way from the row before", row,
               reached.part);
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    std::fprintf(stderr, ", %s %.9g", model.loads[i].name.c_str(), path.inputs.factors[i]);
  for (std::size_t c = 0; c < model.cables.size(); ++c)
    for (const int end : {0, 1})
      if (path.inputs.ends[c][end].jacked)
        std::fprintf(stderr, ", %s.%s %.9g N", model.cables[c].name.c_str(), end == 0 ? "start" : "end",
                     path.inputs.ends[c][end].value);
  std::fprintf(stderr, "; smallest eigenvalue %.3g\n", path.stability());
}

int follow(const Options& options) {
  Model model = read_scene(file_text(options.files[0]));
  model.pieces = options.pieces;
  if (options.present_length) model.reference_length = ReferenceLength::present;
  const auto rows = read_log(file_text(options.files[1]), model);
  std::ofstream file;
  if (!options.out.empty()) file.open(options.out);
  std::ostream& out = options.out.empty() ? std::cout : file;
  write_header(out, model);
  Path path(model, options.steps);
  Reached reached = path.started;
  for (std::size_t row = 0; row < rows.size() && reached; ++row) {
    reached = path.advance(rows[row]);
    if (reached)
      write_row(out, rows[row].time, path);
    else
      say_where(model, path, reached, row + 1);
  }
  if (!path.started) say_where(model, path, path.started, 0);
  return reached ? 0 : 1;
}

}  // namespace
}  // namespace large_displacements

int main(int count, char** words) try {
  using namespace large_displacements;
  const std::string first = count > 1 ? words[1] : "";
  if (first == "--scenes") {
    for (const std::string& name : scene_names()) std::printf("%s\n", name.c_str());
    return 0;
  }
  if (first == "--compare" && (count == 4 || count == 5)) {
    const double until = count == 5 ? std::stod(words[4]) : std::numeric_limits<double>::infinity();
    for (const Difference& d : compare(file_text(words[2]), file_text(words[3]), until))
      std::printf("%-8s %.3g of %.6g, %s at %g\n", d.kind.c_str(), d.part, d.largest, d.column.c_str(),
                  d.time);
    return 0;
  }
  if (first == "--ends" && count == 5) {
    std::printf("%.3g\n", end_difference(words[2], words[3], file_text(words[4])));
    return 0;
  }
  if (first == "--summary" && count == 3) {
    std::fputs(summary(file_text(words[2])).c_str(), stdout);
    return 0;
  }
  if (first == "--write" && count == 4) {
    const Jacking made = scene_by_name(words[2]);
    const std::string stem = std::string(words[3]) + "/" + made.model.name;
    write_scene(made.model, made.target, stem + ".json");
    write_log(made.model, made.rows, stem + ".csv");
    return 0;
  }
  return follow(read_options(count, words));
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
