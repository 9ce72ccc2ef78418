#include "lib/files/deserved_digits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace taut::host {
namespace {

// Long enough for every double in this form.
struct Scientific {
  std::array<char, 40> text{};
  const char* end = nullptr;

  // Of libm's log10 nobody knows the last bit; this is the same on every machine.
  Scientific(double number, int digits) {
    end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::scientific,
                        digits - 1)
              .ptr;
  }
  double number() const {
    double found = 0;
    std::from_chars(text.data(), end, found);
    return found;
  }
  int exponent() const {
    const char* at = std::find(text.data(), end, 'e') + 1;
    int found = 0;
    std::from_chars(*at == '+' ? at + 1 : at, end, found);
    return found;
  }
};

bool has_digits(double number) { return number != 0 && std::isfinite(number); }

// The place of the last digit of a deviation: 0 for ones, -1 for tenths.
constexpr int below_all_digits = -100000;
int last_place(double deviation) {
  if (!has_digits(deviation)) return below_all_digits;
  return Scientific(deviation, deviation_digits).exponent() - (deviation_digits - 1);
}

int known_digits(int exponent, int place) {
  return std::clamp(exponent - place + 1, fewest_digits, computed_digits);
}

int best_known_digits(const Answer& answer) {
  bool is_any = false;
  int best = fewest_digits;
  for (std::size_t i = 0; i < answer.tension.size() && i < answer.deviation.size(); ++i) {
    if (!has_digits(answer.tension[i])) continue;
    is_any = true;
    best = std::max(best, known_digits(Scientific(answer.tension[i], computed_digits).exponent(),
                                       last_place(answer.deviation[i])));
  }
  return is_any ? best : computed_digits;
}

// With so many digits, and of these no more than up to `known`, at least a few, nor any below `least`.
double rounded_at(double number, int digits, int known, int least) {
  if (!has_digits(number)) return number + 0.0;
  const Scientific text(number, computed_digits);
  const int exponent = text.exponent();
  digits = std::min({digits, known_digits(exponent, known), exponent - least + 1});
  if (digits == computed_digits) return text.number();
  return digits < 1 ? 0 : rounded(number, digits);
}

using Lists = std::initializer_list<std::vector<double>*>;

double largest_of(const Lists& lists) {
  double largest = 0;
  for (const auto* numbers : lists)
    for (const double number : *numbers) largest = std::max(largest, std::fabs(number));
  return largest;
}

void round_all(const Lists& lists, int digits, double least) {
  const int place = last_place(least);
  for (auto* numbers : lists)
    for (double& number : *numbers) number = rounded_at(number, digits, below_all_digits, place);
}

void round_as_known(std::vector<double>& numbers, std::vector<double>& deviations, double least) {
  const int place = last_place(least);
  for (std::size_t i = 0; i < numbers.size() && i < deviations.size(); ++i) {
    numbers[i] = rounded_at(numbers[i], computed_digits, last_place(deviations[i]), place);
    deviations[i] = rounded(deviations[i], deviation_digits);
  }
}

}  // namespace

double rounded(double number, int digits) {
  if (!has_digits(number)) return number + 0.0;
  return Scientific(number, digits).number();
}

double rounded_as_known(double number, double deviation) {
  return rounded_at(number, computed_digits, last_place(deviation), below_all_digits);
}

Answer with_deserved_digits(const Answer& answer) {
  Answer written = answer;
  const int digits = best_known_digits(answer);
  std::vector<double> extensions;
  for (const auto& ends : answer.extension) extensions.insert(extensions.end(), ends.begin(), ends.end());
  const Lists forces = {&written.tension, &written.contact, &written.friction, &written.strut},
              lengths = {&written.slip, &written.displacement, &extensions};
  const double least_force = computed_deviation * largest_of(forces);
  if (answer.deviation.empty()) {
    round_all(forces, computed_digits, least_force);
  } else {
    round_as_known(written.tension, written.deviation, least_force);
    round_as_known(written.mu, written.mu_deviation, computed_deviation);
    round_all({&written.contact, &written.friction, &written.strut}, digits, least_force);
  }
  round_all(lengths, digits, computed_deviation * largest_of(lengths));
  round_all({&written.friction_used}, digits, computed_deviation);
  for (std::size_t i = 0; i < extensions.size(); ++i) written.extension[i / 2][i % 2] = extensions[i];
  return written;
}

}  // namespace taut::host
