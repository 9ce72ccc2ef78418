#include "lib/files/job_file.hpp"

#include <algorithm>
#include <utility>

#include "lib/files/file_text.hpp"
#include "lib/files/json_field.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr std::size_t most_stages = 100;
constexpr double largest_tolerance = 1;

const Keys job_keys = {
    {"taut", true, "1, the version of the format"},
    {"project", false, ""},
    {"drawing", false, ""},
    {"contractor", false, ""},
    {"crew", false, ""},
    {"witness", false, ""},
    {"date", false, ""},
    {"remarks", false, ""},
    {"instruments", false, ""},
    {"stages", false, ""},
    {"tolerance", false, ""},
};

class JobReader {
 public:
  JobReader(const Field& root, const SceneDescription& scene) : root_(root), scene_(scene) {}

  Job read() {
    root_.require_head("job", "{ \"taut\": 1, \"project\": \"...\" }", job_keys);
    for (const auto& [key, text] : {std::pair{"project", &job_.project},
                                    {"drawing", &job_.drawing},
                                    {"contractor", &job_.contractor},
                                    {"crew", &job_.crew},
                                    {"witness", &job_.witness},
                                    {"date", &job_.date},
                                    {"remarks", &job_.remarks}})
      read_text_of(root_, key, *text);
    if (const auto instruments = root_.find("instruments")) read_instruments(*instruments);
    if (const auto stages = root_.find("stages")) read_stages(*stages);
    if (const auto tolerance = root_.find("tolerance")) read_tolerances(*tolerance);
    return std::move(job_);
  }

 private:
  static void read_text_of(const Field& object, const char* key, std::string& text) {
    if (const auto field = object.find(key)) text = field->text("a text");
  }

  void read_instruments(const Field& field) {
    std::vector<std::string> known;
    for (const CableDescription& cable : scene_.cables) {
      for (std::size_t end = 0; end < 2; ++end) {
        known.push_back(cable.name + "." + end_name(end));
        if (cable.is_jacked(end)) known.push_back(known.back() + ".stroke");
      }
      for (std::size_t i = 0; i < cable.segments(); ++i)
        known.push_back(cable.name + ".T" + std::to_string(i + 1));
    }
    for (std::size_t i = 0; i < scene_.struts.size(); ++i) known.push_back("strut" + std::to_string(i + 1));
    const Keys keys = {{"id", false, ""}, {"calibrated", false, ""}, {"certificate", false, ""}};
    for (const auto& [column, given] : field.members("an object that says of columns what reads them")) {
      if (std::find(known.begin(), known.end(), column) == known.end())
        given.refuse("no instrument is read in a column " + quote(column),
                     suggestion(column, known, "the columns are"));
      given.members("an object with the id of the instrument, when it was calibrated, and the certificate");
      given.require_keys(keys, "");
      JobInstrument& instrument = job_.instruments[column];
      read_text_of(given, "id", instrument.id);
      read_text_of(given, "calibrated", instrument.calibrated);
      read_text_of(given, "certificate", instrument.certificate);
    }
  }

  void read_stages(const Field& field) {
    std::vector<std::string> jacks;
    for (const CableDescription& cable : scene_.cables)
      for (std::size_t end = 0; end < 2; ++end)
        if (cable.is_jacked(end)) jacks.push_back(cable.name + "." + end_name(end));
    const auto items = field.elements("a list of stages: [{ \"C.end\": 2e5 }, ...]");
    if (items.size() > most_stages)
      field.refuse(counted(items.size(), "stage"), "write at most " + std::to_string(most_stages));
    for (const Field& item : items) {
      JobStage stage;
      stage.force.resize(scene_.cables.size());
      for (const auto& [name, value] : item.members("an object that gives jacks their forces [N]")) {
        if (name == "name") {
          stage.name = value.text("a text");
          continue;
        }
        const auto found = std::find(jacks.begin(), jacks.end(), name);
        if (found == jacks.end())
          value.refuse("there is no jack " + quote(name), suggestion(name, jacks, "the jacks are"));
        const double force = value.amount("a force [N] as a number");
        if (!(force > 0)) value.refuse("a force of " + plain(force), "write one greater than zero [N]");
        required(stage, name) = force;
      }
      job_.stages.push_back(std::move(stage));
    }
  }
  std::optional<double>& required(JobStage& stage, const std::string& jack) const {
    std::size_t c = 0, end = 0;
    while (scene_.cables[c].name + "." + end_name(end) != jack) {
      c += end;
      end = 1 - end;
    }
    return stage.force[c][end];
  }

  void read_tolerances(const Field& field) {
    field.members("an object: { \"elongation\": 0.05, \"force\": 0.02 }");
    field.require_keys({{"elongation", false, ""}, {"force", false, ""}}, "");
    if (const auto part = field.find("elongation")) job_.elongation_tolerance = tolerance(*part);
    if (const auto part = field.find("force")) job_.force_tolerance = tolerance(*part);
  }
  static double tolerance(const Field& field) {
    const double found = field.amount("a part as a number, 0.05 for 5 %");
    if (!(found > 0 && found < largest_tolerance))
      field.refuse("a tolerance of " + plain(found), "write a part between 0 and 1: 0.05 for 5 %");
    return found;
  }

  Field root_;
  const SceneDescription& scene_;
  Job job_;
};

}  // namespace

Job read_job_file(const std::string& path, const SceneDescription& scene) {
  const JsonValue tree = parse_json(read_text(path, largest_json_file, "job file"), path);
  return JobReader(Field(tree, "", path), scene).read();
}

}  // namespace taut::host
