#include "lib/live/live_answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lib/files/deserved_digits.hpp"
#include "lib/files/result_file.hpp"
#include "lib/live/plan_json.hpp"
#include "lib/report/run_record.hpp"

namespace taut::host {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> as_read(const std::optional<double>& value) {
  return value ? std::optional<double>(rounded(*value, computed_digits)) : value;
}

Json segments(const SceneDescription& scene, const Answer& answer) {
  Json all = Json::object();
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const std::size_t first = start_of(scene, c).segment;
    Json list = Json::array();
    for (std::size_t i = first; i < first + scene.cables[c].segments(); ++i) {
      const auto [low, high] = force_band(answer.tension[i], answer.deviation[i]);
      const double sd = answer.deviation[i];
      list.push_back({{"force", answer.tension[i]},
                      {"sd", sd},
                      {"low", rounded(low, computed_digits)},
                      {"high", rounded(high, computed_digits)}});
    }
    all[scene.cables[c].name] = std::move(list);
  }
  return all;
}

Json joints(const SceneDescription& scene, const Answer& answer) {
  Json all = Json::object();
  for (std::size_t c = 0; c < scene.cables.size(); ++c) {
    const std::size_t first = start_of(scene, c).joint;
    Json list = Json::array();
    for (std::size_t j = first; j < first + scene.cables[c].joints(); ++j)
      list.push_back(
          {{"state", state_word(answer.state[j])}, {"mu", answer.mu[j]}, {"mu_sd", answer.mu_deviation[j]}});
    all[scene.cables[c].name] = std::move(list);
  }
  return all;
}

}  // namespace

std::vector<JackNow> jacks_of(const SceneDescription& scene, const LogRow& row, const Answer& answer,
                              const std::vector<std::array<bool, 2>>& has_stroke) {
  std::vector<JackNow> jacks;
  for (std::size_t c = 0; c < scene.cables.size(); ++c)
    for (std::size_t end = 0; end < 2; ++end) {
      if (!scene.cables[c].is_jacked(end)) continue;
      const std::size_t first = start_of(scene, c).segment;
      const EndRow& read = row.cables[c][end];
      jacks.push_back(
          {c, end, answer.tension[end == 0 ? first : first + scene.cables[c].segments() - 1],
           as_read(read.reading),
           has_stroke[c][end] ? as_read(read.stroke) : std::optional<double>(answer.extension[c][end])});
    }
  return jacks;
}

std::vector<std::string> words_of(const std::string& list) {
  std::istringstream stream(list);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::array<double, 2> force_band(double force, double sd) {
  return {std::max(force - band_width * sd, 0.0), force + band_width * sd};
}

std::string answer_json(const SceneDescription& scene, const LiveAnswer& live) {
  const bool is_there = live.row > 0;
  Json json = Json::object();
  json["time"] = is_there ? Json(live.time) : Json(nullptr);
  json["segments"] = is_there ? segments(scene, live.answer) : Json::object();
  json["joints"] = is_there ? joints(scene, live.answer) : Json::object();
  json["jack"] = Json::object();
  for (const JackNow& jack : live.jacks)
    json["jack"][scene.cables[jack.cable].name + "." + end_name(jack.end)] = {
        {"force", jack.force}, {"reading", or_null(jack.reading)}, {"stroke", or_null(jack.stroke)}};
  json["alarms"] = live.alarms;
  json["notices"] = live.notices;
  if (live.plan) json["plan"] = plan_json(*live.plan);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace taut::host
