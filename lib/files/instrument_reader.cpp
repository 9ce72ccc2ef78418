#include "lib/files/instrument_reader.hpp"

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

const Keys force_keys = {
    {"sd", false, ""},         {"gain_sd", false, ""},     {"zero_sd", false, ""}, {"resolution", false, ""},
    {"hysteresis", false, ""}, {"calibration", false, ""}, {"exact", false, ""},   {"lag", false, ""},
};
const Keys stroke_keys = {{"sd", false, ""}, {"zero", false, ""}, {"resolution", false, ""}};
const Keys hysteresis_keys = {
    {"part", true, "half the width between pulling and letting out, relative to the force"},
    {"sd", false, ""},
    {"calibrated", false, ""},
};

double deviation(const Field& field, const std::string& unit) {
  const double sd = field.amount("the standard deviation" + unit + " as a number");
  if (!(sd > 0)) field.refuse("a standard deviation of " + plain(sd), "write one greater than zero");
  return sd;
}

double part(const Field& field, const std::string& meaning, double below) {
  const double found = field.number(meaning + " as a number");
  if (!(found >= 0 && found < below))
    field.refuse(meaning + " cannot be " + plain(found), "write one from 0 to " + plain(below));
  return found;
}

void read_hysteresis(const Field& field, InstrumentDescription& instrument) {
  field.require_keys(hysteresis_keys, "the friction of a ram: { \"part\": ..., \"calibrated\": \"mean\" }");
  instrument.has_hysteresis = true;
  instrument.part = part(field.at("part"), "the part of the force that friction takes", 0.5);
  instrument.part_sd = instrument.part / 2;
  if (const auto sd = field.find("sd")) instrument.part_sd = part(*sd, "its standard deviation", 0.5);
  if (const auto way = field.find("calibrated")) {
    const std::string allowed = "\"mean\" or \"up\"";
    const std::string& found = way->text(allowed);
    if (found != "mean" && found != "up")
      way->refuse("a gauge cannot be calibrated " + quote(found), "write " + allowed);
    instrument.right_while_it_pulls = found == "up";
  }
}

void read_calibration(const Field& field, InstrumentDescription& instrument) {
  const std::string wanted = "a list of [reading, force in N], both ascending";
  for (const Field& item : field.elements(wanted)) {
    const auto pair = item.elements("[reading, force in N]");
    if (pair.size() != 2)
      item.refuse("found " + counted(pair.size(), "number"), "write [reading, force in N]");
    const std::array<double, 2> point = {pair[0].number("a reading"), pair[1].number("a force [N]")};
    if (!instrument.calibration.empty() &&
        !(point[0] > instrument.calibration.back()[0] && point[1] > instrument.calibration.back()[1]))
      item.refuse("the calibration does not ascend here", "write " + wanted);
    instrument.calibration.push_back(point);
  }
  if (instrument.calibration.size() < 2)
    field.refuse("the calibration has " + counted(instrument.calibration.size(), "point"),
                 "write at least two: " + wanted);
}

void read_force_cell(const Field& item, bool may_be_exact, InstrumentDescription& instrument) {
  item.require_keys(force_keys, "an instrument: { \"sd\": ... }");
  if (const auto sd = item.find("sd")) instrument.sd = deviation(*sd, " [N]");
  if (const auto sd = item.find("gain_sd"))
    instrument.gain_sd = part(*sd, "the standard deviation of a gain", 1);
  if (const auto sd = item.find("zero_sd")) {
    instrument.zero_sd = sd->amount("the standard deviation of the zero [N] as a number");
    if (!(*instrument.zero_sd >= 0))
      sd->refuse("a standard deviation of " + plain(*instrument.zero_sd), "write zero or more");
  }
  if (const auto step = item.find("resolution")) {
    instrument.resolution = step->amount("the step of the display [N] as a number");
    if (!(instrument.resolution >= 0))
      step->refuse("a step of " + plain(instrument.resolution), "write zero or more");
  }
  if (const auto lag = item.find("lag")) {
    instrument.lag = lag->amount("the time constant of a filter [s] as a number");
    if (!(instrument.lag >= 0 && instrument.lag <= 10))
      lag->refuse("a time constant of " + plain(instrument.lag) + " s",
                  "write one from 0 to 10: it is in seconds");
  }
  if (const auto hysteresis = item.find("hysteresis")) read_hysteresis(*hysteresis, instrument);
  if (const auto calibration = item.find("calibration")) read_calibration(*calibration, instrument);
  if (const auto exact = item.find("exact")) {
    instrument.exact = exact->boolean("true or false");
    if (instrument.exact && instrument.lag > 0)
      exact->refuse("a load cell that lags is not exact", "remove \"lag\", or this and write its \"sd\"");
    if (instrument.exact && !may_be_exact)
      exact->refuse("only the load cell of a jack can be exact", "remove it, and write its \"sd\"");
  }
}

void read_stroke(const Field& item, InstrumentDescription& instrument) {
  item.require_keys(stroke_keys, "the stroke of a jack: { \"sd\": ..., \"zero\": \"free\" }");
  instrument.sd = 1e-3;
  instrument.has_free_zero = true;
  if (const auto sd = item.find("sd")) instrument.sd = deviation(*sd, " [m]");
  if (const auto step = item.find("resolution"))
    instrument.resolution = part(*step, "the step of a stroke [m]", 1);
  if (const auto zero = item.find("zero")) {
    const std::string allowed = "\"free\" or \"start\"";
    const std::string& found = zero->text(allowed);
    if (found != "free" && found != "start")
      zero->refuse("a stroke cannot be read from " + quote(found), "write " + allowed);
    instrument.has_free_zero = found == "free";
  }
}

}  // namespace

void read_instruments(const Field& sensors, SceneDescription& scene) {
  for (const auto& [name, item] :
       sensors.members("an object that gives columns of the log their instruments")) {
    std::vector<std::string> known;
    const auto is = [&, &column = name](const std::string& candidate) {
      known.push_back(candidate);
      return column == candidate;
    };
    const auto find = [&, &field = item, &given = name]() -> bool {
      const auto force_cell = [&](InstrumentDescription& instrument, bool may_be_exact) {
        instrument.is_given = true;
        read_force_cell(field, may_be_exact, instrument);
        return true;
      };
      for (CableDescription& cable : scene.cables) {
        for (std::size_t end = 0; end < 2; ++end) {
          const std::string column = cable.name + "." + end_name(end);
          if (cable.closed) {
            if (given == column)
              field.refuse("cable " + quote(cable.name) + " is closed and has no ends",
                           "remove the load cell");
            continue;
          }
          if (is(column)) return force_cell(cable.cell[end], cable.is_jacked(end));
          if (cable.is_jacked(end) && is(column + ".stroke")) {
            cable.stroke[end].is_given = true;
            read_stroke(field, cable.stroke[end]);
            return true;
          }
        }
        for (std::size_t i = 0; i < cable.segments(); ++i)
          if (is(cable.name + ".T" + std::to_string(i + 1))) return force_cell(cable.force[i], false);
      }
      for (std::size_t i = 0; i < scene.struts.size(); ++i)
        if (is("strut" + std::to_string(i + 1))) return force_cell(scene.struts[i].gauge, false);
      return false;
    };
    if (!find())
      item.refuse("there is no instrument " + quote(name), suggestion(name, known, "the instruments are"));
  }
}

}  // namespace taut::host
