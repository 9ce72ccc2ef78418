#include "lib/report/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace taut::host {

bool Curve::Piece::is_gap() const { return std::isnan(first.y); }

// A gap is lost in a piece that has points.
void Curve::Piece::join(const Piece& later) {
  if (later.is_gap()) return;
  if (is_gap()) {
    *this = later;
    return;
  }
  if (later.least.y < least.y) least = later.least;
  if (later.most.y > most.y) most = later.most;
  last = later.last;
}

void Curve::add(double x, double y) {
  const CurvePoint point{x, std::isfinite(y) ? y : std::numeric_limits<double>::quiet_NaN()};
  pieces_.add({point, point, point, point});
}

CurvePoints Curve::points() const {
  CurvePoints found;
  for (const Piece& piece : pieces_.cells()) {
    std::array<CurvePoint, points_a_piece> four{piece.first, piece.least, piece.most, piece.last};
    std::sort(four.begin(), four.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    for (const CurvePoint& point : four)
      if (found.empty() || point.x > found.back().x) found.push_back(point);
  }
  return found;
}

}  // namespace taut::host
