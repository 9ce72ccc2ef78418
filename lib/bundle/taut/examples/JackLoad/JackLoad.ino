// The force in a cable behind a friction joint, from the load cell of its jack.
//
// Once a second a row of readings goes in, and the force at the anchored end comes out with its standard
// deviation. Here the rows are those of an experiment; put the readings of your load cells in their place, and
// the scene that `taut export` writes of your structure in place of rolling_joint.hpp.
#include <taut_device.hpp>

#include "rolling_joint.hpp"

namespace roller = rolling_cable_strut_joint_three_set_ups_side_by_side;
using Estimator = taut::Estimator<taut::Condensed<float, roller::Capacity>, roller::unknowns, roller::reading_unknowns>;

static auto known = roller::prior<float>;  // mu 0.219 with a standard deviation of a half of it
static Estimator estimator;                    // all the memory it needs

static const float rows[][2] = {{20000, 0}, {40000, 33350}, {30000, 0}, {20000, 0}};  // jack; far end, 0: not read
static unsigned row = 0;
static bool is_well = false;

void setup() {
  Serial.begin(115200);
  known.cell[0][0].sd = 100;  // cable 0 has a load cell at its anchored end, too: 100 N
  is_well = bool(estimator.start(roller::condensed<float>, known).status);
  Serial.println(is_well ? "jack [N], far end [N], sd, mu, sd" : "the scene is refused");
}

void loop() {
  if (!is_well || row == sizeof rows / sizeof rows[0]) return;
  Estimator::ReadingsType readings;
  readings.dt = 1;               // seconds since the row before
  auto& end = readings.ends[0];  // of cable 0: its start is anchored, a jack pulls at its end
  end[1].has_force = true;
  end[1].force = rows[row][0];
  end[0].has_force = rows[row][1] > 0;
  end[0].force = rows[row][1];
  is_well = bool(estimator.advance(readings).status);
  if (!is_well) {
    Serial.println("no answer: the forces before were the last");
    return;
  }
  const auto far_end = estimator.estimate(0);  // of segment 0, at the anchored end
  Serial.print(end[1].force, 0);
  Serial.print(", ");
  Serial.print(far_end.force, 0);
  Serial.print(", ");
  Serial.print(far_end.deviation, 0);
  Serial.print(", ");
  Serial.print(estimator.mu(0), 3);
  Serial.print(", ");
  Serial.println(estimator.mu_deviation(0), 3);
  ++row;
  delay(1000);
}
