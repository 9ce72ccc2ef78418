// One end of one cable, and what a table by cable and end has for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace taut {

/// End 0 (start) or 1 (end) of a cable.
template <class Cap>
struct CableEnd {
  std::int16_t number = 0;
  std::uint8_t end = 0;

  static CableEnd of(int cable, std::size_t end) {
    return {static_cast<std::int16_t>(cable), static_cast<std::uint8_t>(end)};
  }
  // With one cable the compiler knows which.
  int cable() const { return Cap::cables == 1 ? 0 : number; }
  bool is(int cable_number, std::size_t which) const { return cable() == cable_number && end == which; }
  /// The segment at this end of the cable, of a condensed scene.
  template <class Model>
  int segment(const Model& model) const {
    return model.cables[cable()].end_segment(end);
  }
  /// The entry of this end in a table `table[cable][end]`.
  template <class Table>
  auto& in(Table& table) const {
    return table[cable()][end];
  }
};

}  // namespace taut
