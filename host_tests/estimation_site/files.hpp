// The files of a jacking: what the estimator gets, and what is true.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimation_site/cases.hpp"

namespace estimation_site {

/// What the instruments of a cable show, row by row.
struct Readings {
  std::vector<double> start, end;             ///< NaN: an empty field
  std::array<std::vector<double>, 2> stroke;  ///< of the jack at the start, if there is one, and at the end
  double sd = 0;                              ///< of the noise, as stated [N]
  double step = 0;                            ///< of the display [N]
  double lag = 0;                             ///< of the cells' filter, as stated [s]
};

/// A gauge on a segment or a strut.
struct GaugeReadings {
  std::string column;         ///< of the log, and what the scene calls it
  std::vector<double> force;  ///< [N], row by row
  double sd = 0;              ///< of the noise, as stated [N]
  double zero_sd = 0;         ///< [N]
};

/// A site that is jacked, and what was read.
struct Jacked {
  Ground ground;
  Reality reality;
  std::vector<Deed> rows;
  std::vector<Readings> readings;  ///< by cable
  std::vector<GaugeReadings> gauges;
};

/// What a cable is called.
std::string cable_name(std::size_t cable);

/// The scene as the estimator gets it: with what today's format has, or with all that is declared.
std::string scene_text(const Jacked& jacked, const Case& tried, bool far, bool declared);
/// The log as the estimator gets it.
std::string log_text(const Jacked& jacked, const Case& tried, bool far);

/// The true scene and the true forces, for `taut simulate`.
std::string true_scene_text(const Jacked& jacked);
std::string true_log_text(const Jacked& jacked);
/// Phases and the true segment forces.
std::string truth_text(const Jacked& jacked);

}  // namespace estimation_site
