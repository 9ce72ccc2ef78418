// Prints the figures of the paper beside those of taut, as the table of README.md here.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "experiments.hpp"

namespace {

using namespace paper;

/// Without the sign of a number that is rounded to zero.
std::string number(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::fabs(value) * unit < 0.5 ? 0.0 : value);
  return text;
}

/// With its sign.
std::string difference(double found, double reference, int decimals) {
  const std::string text = number(found - reference, decimals);
  return found > reference && text.find_first_not_of("0.") != std::string::npos ? "+" + text : text;
}

void print_row(const std::string& experiment, const std::string& what, const std::string& reference,
               const std::string& found, const std::string& difference) {
  std::printf("| %s | %s | %s | %s | %s |\n", experiment.c_str(), what.c_str(), reference.c_str(),
              found.c_str(), difference.c_str());
}

/// Forces of an experiment, or the end of the program with the reason.
template <class SceneType>
auto forces(const SceneType& scene, const Drive& drive) {
  static taut::Stepwise<double, SceneType> solver;
  const taut::Status status = follow(solver, scene, drive);
  if (!status) {
    std::fprintf(stderr, "paper_table: %s\n", taut::describe(status.code));
    std::exit(1);
  }
  return solver.response();
}

void print_table_3() {
  for (const RollerColumn& printed : table_3) {
    const auto found = forces(cable_roller(printed.mu), roller_drive);
    const std::string mu = "mu = " + number(printed.mu, printed.mu == 2.42 ? 2 : printed.mu > 0 ? 1 : 0);
    const std::string note = printed.mu == misprinted_mu
                                 ? " (misprint: mu N = " + number(printed.mu * printed.contact, 1) + ")"
                                 : "";
    print_row(&printed == &table_3[0] ? "Table 3, cable-roller model" : "", mu + ", friction f [N]",
              number(printed.friction, 1) + note, number(found.friction[0], 2),
              difference(found.friction[0], printed.friction, 2));
    print_row("", mu + ", normal pressure N [N]", number(printed.contact, 1), number(found.contact[0], 2),
              difference(found.contact[0], printed.contact, 2));
  }
}

void print_table_4() {
  for (const RollingJointRow& row : table_4) {
    const std::string name = row.name;
    const double mu = identified_mu(row.T1, row.T2, roller_alpha);
    print_row(&row == &table_4[0] ? "Table 4, rolling joint" : "",
              name + ", mu from T1 and T2 by the note of the table",
              number(row.mu, 4) + " (2 sin(alpha) (T1 - T2) / (T1 + T2))", number(mu, 4),
              difference(mu, row.mu, 4));
    const auto found = forces(rolling_joint(mu), {0, row.T1});
    const std::string T2 = name + ", T2 [kN] from T1 = " + number(row.T1 / 1000, 2) + " kN and that mu";
    print_row("", T2, number(row.T2 / 1000, 2) + " (measured)", number(found.tension[0] / 1000, 2),
              difference(found.tension[0] / 1000, row.T2 / 1000, 2));
    print_row("", T2, number(row.T2_numerical / 1000, 1) + " (numerical)", number(found.tension[0] / 1000, 2),
              difference(found.tension[0] / 1000, row.T2_numerical / 1000, 2));
  }
}

void print_chain() {
  const auto found = forces(sliding_chain(), chain_drive);
  const auto by_hand = chain_by_hand();
  for (int i = 3; i >= 0; --i) {
    const double expected = by_hand[static_cast<std::size_t>(i)];
    print_row(i == 3 ? "Section 4.2, chain of four segments, angles of our own" : "",
              "T" + std::to_string(i + 1) + " [N]",
              number(expected, 3) + (i == 3 ? " (jack)" : " (Eq. (43))"), number(found.tension[i], 3),
              difference(found.tension[i], expected, 3));
  }
}

void print_truss() {
  for (const TrussCase& given : table_5) {
    const auto found = forces(given.scene(), given.drive());
    const auto [least, most] = std::minmax_element(found.tension.items.begin(), found.tension.items.end());
    const std::string experiment =
        &given == &table_5[0] ? "Section 4.3, truss string, structure of our own" : "";
    print_row(experiment, std::string(given.name) + ", largest cable force [N]", "", number(*most, 1), "");
    print_row("", std::string(given.name) + ", smallest cable force [N]", "", number(*least, 1), "");
  }
}

}  // namespace

int main() {
  std::puts("| Experiment | Figure | Paper | taut | Difference |");
  std::puts("|---|---|---|---|---|");
  print_table_3();
  print_table_4();
  print_chain();
  print_truss();
}
