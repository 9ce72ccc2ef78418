// A curve over time that keeps its minima and maxima, however long it is.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/report/thinned.hpp"

namespace taut::host {

struct CurvePoint {
  double x = 0, y = 0;
};

using CurvePoints = std::vector<CurvePoint>;

/// Points in the order of x; not more than about `most_points` are kept. A y that is not a number is a gap.
class Curve {
 public:
  static constexpr std::size_t usual_points = 1000;

  explicit Curve(std::size_t most_points = usual_points) : pieces_(most_points / points_a_piece) {}

  void add(double x, double y);
  CurvePoints points() const;
  bool empty() const { return pieces_.cells().empty(); }

 private:
  static constexpr std::size_t points_a_piece = 4;

  struct Piece {
    CurvePoint first, least, most, last;
    bool is_gap() const;
    void join(const Piece& later);
  };

  Thinned<Piece> pieces_;
};

}  // namespace taut::host
