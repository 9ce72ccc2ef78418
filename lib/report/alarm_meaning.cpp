#include "lib/report/alarm_meaning.hpp"

#include <array>
#include <utility>

namespace taut::host {
namespace {

constexpr std::array<std::pair<const char*, AlarmMeaning>, 19> meanings = {{
    {"outlier",
     {"A reading of the load cell at this jack does not belong to the others. It was left out.",
      "Nothing, if it is rare. If it comes again and again, check the cell, its cable and its sd in the "
      "scene."}},
    {"sensor",
     {"The load cell at this anchored end contradicts the model by more than five standard deviations.",
      "Check the cell (zero, range, seat), then the scene: angles at the joints, mu and its sd, forgotten "
      "joints."}},
    {"mu",
     {"Friction is surely outside of what the scene says was known of it.",
      "Look at the joints: dirt, damage, missing grease or liner. If all is well, correct mu and mu_sd in "
      "the scene."}},
    {"stuck",
     {"The joint holds back more than its friction allows: it does not slide though it should.",
      "Look whether the cable is caught or clamped there before pulling on."}},
    {"elongation",
     {"Since the jack last reversed or was locked, its stroke has grown by more or less than "
      "computed, beyond the tolerance (5 %) and the noise of its readings.",
      "Stop and find the reason before pulling on: slipping wedges, a broken wire, slack, wrong E, A or "
      "lengths."}},
    {"force-high",
     {"The force in this segment is above its limit, or has not come back from there by 1 % of it.",
      "Stop pulling; release until it is below the limit."}},
    {"force-low",
     {"The force in this segment is below its limit, or has not come back from there by 1 % of it.",
      "Pull on, or release and pull again to bring the force over the joints; look for a slack cable."}},
    {"no-information",
     {"The load cell at this anchored end was read, but joints between it and the jack stick: the reading "
      "says nothing about mu. Readings taken while the cable slides over all joints are worth more.",
      "Nothing."}},
    {"gauge",
     {"The measured force of this strut or segment contradicts the model by more than five standard "
      "deviations.",
      "Check the gauge (zero, temperature, bending of the strut), then the scene: loads, areas, mu and its "
      "sd."}},
    {"model-misfit",
     {"The readings of the load cell at this anchored end are off what the model says for longer than chance "
      "allows. The forces of this cable are in doubt.",
      "Compare both cells under one load (gain, zero), then check the scene: angles at the joints, forgotten "
      "joints, loads, mu and its sd."}},
    {"frozen",
     {"The load cell keeps one value although the load moves. What it shows since then is no measurement.",
      "Check the cell, its cable and the logger. Leave its fields in the log empty until it reads again."}},
    {"unread",
     {"The load cell of this jack has not been read for long, while rows went on. Its load is taken to be "
      "where it was.",
      "Check the cell, its plug and the logger. If the pump was worked meanwhile, forces are others."}},
    {"late-lock",
     {"This end was locked while the load of its jack fell, or when next to none was left. If its wedge held "
      "before the log says so, the forces are those from before the load fell; the intervals reach that far.",
      "In the log mark the end as locked from the row on in which its load began to fall, and read it again. "
      "On the device: lock an end before its jack is let out."}},
    {"early-unlock",
     {"This end was marked as unlocked before its jack pulls what the wedge holds. A wedge cannot come free "
      "before that: it is taken to hold until then.",
      "Nothing."}},
    {"gain",
     {"The load cell at this anchored end and that of the jack surely differ by more than 1 % of the force. "
      "The intervals hold for it; the forces would be known better if they did not.",
      "Compare both cells under one load, and have the wrong one calibrated."}},
    {"unknown-past",
     {"The cable was under load before the first row, and nobody said how it came there. The interval holds "
      "the forces of every past.",
      "Pull on until the cable has slid over all joints, or give the state that the last visit left "
      "(--state)."}},
    {"lift-off",
     {"The jack pulls what this locked end holds: its wedge comes free.",
      "Unlock the end in the log from here on (locked 0), so that the jack drives it again."}},
    {"silent",
     {"No row comes from the line. What is shown is the last that was known.",
      "Check the cable, its plugs and the logger. The line is opened again as soon as it is there."}},
    {"unreadable",
     {"A line came that is no row of the log. It was left out.",
      "Nothing, if it is rare. If it comes again and again, check baud, plugs and the logger."}},
}};

}  // namespace

AlarmMeaning alarm_meaning(const std::string& word) {
  const std::string kind = word.substr(0, word.find(':'));
  for (const auto& [name, meaning] : meanings)
    if (kind == name) return meaning;
  return {"An alarm that this report has no words for.", "See the description of the alarms."};
}

std::string alarm_place(const std::string& word) {
  const std::size_t colon = word.find(':');
  return colon == std::string::npos ? "" : word.substr(colon + 1);
}

}  // namespace taut::host
