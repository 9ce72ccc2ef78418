// The estimator beside what people do now, on the same logs with a known truth:
//
//     estimation_practice [--count N]
//
// Truss strings and rigid saddles, one mu that differs from the nominal one as its standard deviation of 30 %
// says, load cells with 0.5 % of noise; a ramp, a hold, a release to a half, a hold and a ramp back. The
// error is that of all inner segment forces relative to their truth, root mean square over the samples from a
// tenth of the full force on.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "estimation/site.hpp"

namespace {

using namespace estimation;

constexpr double full = 2e5, nominal_mu = 0.2, mu_sd = 0.06;

/// T = F exp(-mu beta), beta the angle by which the cable has turned on its way from the jack.
class ExponentialLoss {
 public:
  explicit ExponentialLoss(const taut::FrictionPrior<double, PlaneCapacity>& prior, int segments)
      : angle_(static_cast<std::size_t>(segments), 0.0) {
    for (int i = segments - 2; i >= 0; --i)
      angle_[static_cast<std::size_t>(i)] = angle_[static_cast<std::size_t>(i) + 1] + prior.contact_factor[i];
  }
  double force(int segment, double jack, double mu) const {
    return jack * std::exp(-mu * angle_[static_cast<std::size_t>(segment)]);
  }
  /// mu from the forces at both ends.
  double mu(double jack, double far) const { return std::log(jack / far) / angle_.front(); }

 private:
  std::vector<double> angle_;
};

enum Way { exponential, two_cells, discontinuous, raw, jack_alone, far_end, ways };
struct Error {
  double square = 0;
  long count = 0;
  void add(double found, double truth) {
    square += (found - truth) * (found - truth) / (truth * truth);
    ++count;
  }
  double percent() const { return 100 * std::sqrt(square / static_cast<double>(count)); }
};
struct Errors {
  std::array<Error, ways> first_ramp, after;
};

std::vector<double> log_rows() {
  std::vector<double> rows;
  const double turns[] = {0, 1, 1, 0.5, 0.5, 1};
  for (int piece = 0; piece < 5; ++piece)
    for (int i = 1; i <= 200; ++i)
      rows.push_back(full * (turns[piece] + (turns[piece + 1] - turns[piece]) * i / 200));
  return rows;
}

using Model = taut::Condensed<double, PlaneCapacity>;

bool compare(std::uint64_t seed, Errors& errors) {
  Random random(seed);
  static Ground ground;
  taut::Cable<double> cable = support::steel_cable(nominal_mu);
  cable.law = taut::FrictionLaw::capstan;
  cable.mu_sd = mu_sd;
  cable.shared_mu = true;
  if (random.coin())
    support::truss_string(ground.known, cable, 6);
  else
    support::rigid_saddles(ground.known, cable, support::chain_points(7));
  const double actual = std::fmax(0.02, nominal_mu + mu_sd * gaussian(random));
  ground.set_true_mu(std::vector<double>(16, actual));
  Instruments with_cell, without;
  without.has_cell = false;
  const auto site = std::make_unique<Site<double>>(ground, with_cell, full, seed),
             alone = std::make_unique<Site<double>>(ground, without, full, seed);

  const auto locked_model = std::make_unique<Model>(), nominal_model = std::make_unique<Model>();
  const auto locked = std::make_unique<taut::Tracker<Model>>(),
             nominal = std::make_unique<taut::Tracker<Model>>();
  static Plane glued;
  glued = ground.known;
  for (int j = 0; j < glued.mu.size(); ++j) glued.mu[j] = 50;
  glued.cables[0].law = taut::FrictionLaw::point;
  bool good = support::condense(ground.known, *nominal_model).ok() &&
              nominal->start(*nominal_model).status.ok() && support::condense(glued, *locked_model).ok() &&
              locked->start(*locked_model).status.ok();
  taut::FrictionPrior<double, PlaneCapacity> prior;
  taut::find_friction_prior(ground.known, prior);

  // After the fact: the means of both cells over the first hold.
  struct Row {
    double jack, far;
  };
  std::vector<Row> readings;
  const ExponentialLoss loss(prior, site->segments());
  const auto rows = log_rows();
  std::vector<std::vector<double>> truths;
  for (std::size_t row = 0; row < rows.size() && good; ++row) {
    site->advance(rows[row]);
    alone->advance(rows[row]);
    const double jack = site->jack_reading();
    readings.push_back({jack, site->cell_reading()});
    taut::Sample<double, PlaneCapacity> sample;
    sample.jack[0][1].force = std::fmax(0, jack);
    good = site->good() && alone->good() && nominal->advance(sample).status.ok() &&
           locked->advance(sample).status.ok();
    truths.emplace_back();
    auto& into = row < 200 ? errors.first_ramp : errors.after;
    for (int i = 0; i < site->segments(); ++i) truths.back().push_back(site->true_force(i));
    if (rows[row] < 0.1 * full) continue;
    for (int i = 0; i + 1 < site->segments(); ++i) {
      const double truth = site->true_force(i);
      into[exponential].add(loss.force(i, jack, nominal_mu), truth);
      into[discontinuous].add(locked->tension(i), truth);
      into[raw].add(nominal->tension(i), truth);
      into[jack_alone].add(truth + alone->error(i), truth);
      into[far_end].add(truth + site->error(i), truth);
    }
  }
  if (!good) return false;
  Row mean{0, 0};
  for (std::size_t row = 200; row < 400; ++row) {
    mean.jack += readings[row].jack / 200;
    mean.far += readings[row].far / 200;
  }
  const double mu = loss.mu(mean.jack, mean.far);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row] < 0.1 * full) continue;
    auto& into = row < 200 ? errors.first_ramp : errors.after;
    for (int i = 0; i + 1 < site->segments(); ++i)
      into[two_cells].add(loss.force(i, readings[row].jack, mu), truths[row][static_cast<std::size_t>(i)]);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 200;
  if (argc == 3 && std::strcmp(argv[1], "--count") == 0) count = std::strtoull(argv[2], nullptr, 10);
  Errors errors;
  for (std::uint64_t seed = 1; seed <= count; ++seed)
    if (!compare(seed, errors)) {
      std::printf("seed %llu: no answer\n", static_cast<unsigned long long>(seed));
      return EXIT_FAILURE;
    }
  const char* names[ways] = {"exponential loss, nominal mu",
                             "exponential loss, mu from two load cells after the fact",
                             "discontinuous cable",
                             "`taut simulate`, nominal mu, raw readings",
                             "`taut estimate`, jack's load cell alone",
                             "`taut estimate`, load cell at the far end"};
  const char* needs[ways] = {
      "angles, mu",    "angles, both load cells, the whole log", "a finite element model",
      "the scene, mu", "the scene, mu and how well it is known", "the scene, both load cells"};
  std::puts("| method | needs | first ramp, error [%] | hold, release, re-jacking [%] | error bars |");
  std::puts("| --- | --- | ---: | ---: | --- |");
  for (std::size_t way = 0; way < ways; ++way)
    std::printf("| %s | %s | %.2f | %.2f | %s |\n", names[way], needs[way], errors.first_ramp[way].percent(),
                errors.after[way].percent(), way >= jack_alone ? "yes" : "no");
  return EXIT_SUCCESS;
}
