// Whether cables were under load before the first row of a log that tells.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lib/files/log_file.hpp"
#include "lib/files/scene_description.hpp"

namespace taut::host {

/// The jacks from the first row on that tells of loads, see tells_load(): in those before, no load cell is
/// read but those behind wedges. The force of a jack that has no column is zero.
class FirstLoad {
 public:
  /// The scene has what fill_in_deviations() gives it.
  FirstLoad(const LogRules& rules, const SceneDescription& scene);

  /// Rows in their order.
  void take(const LogRow& row);
  /// Whether some jack pulls in that row more than 5 % of what it ever does, and did not come there from
  /// zero in one stage: the next row goes on by less than 0.8 of that. What noise and zero of its cell can
  /// show is no load. Or whether only wedges hold some cable in it, and a load cell at its other end says
  /// that they do. As far as rows have been taken.
  bool is_under_load() const;
  /// Rows from the first one on that tells.
  std::size_t telling() const { return telling_; }
  /// Whether no row tells anything so far: nobody knows what jacks pull, and wedges hold.
  bool is_silent() const { return rows_ > 0 && telling_ == 0; }
  /// Whether further rows can say so.
  bool is_open() const;
  /// The cables that only wedges hold in the first row that tells, or in all if none does, where no load cell
  /// reads what they hold, quoted and with commas between. If others tell, these are taken to be without
  /// load, as are those whose turn has not come.
  const std::string& unread() const { return unread_; }

 private:
  enum class Held { no, unread, under_load };

  struct Jack {
    std::optional<double> first, second;
    double largest = 0, none = 0;  // what may be read of no load

    // From a load of its own, and not in one stage from zero.
    bool goes_on() const { return first && *first > none && (!second || *second - *first < 0.8 * *first); }
  };

  Held held_by_wedges(const LogRow& row, std::size_t c) const;
  bool tells(const LogRow& row) const;

  const LogRules& rules_;
  const SceneDescription& scene_;
  std::vector<std::array<Jack, 2>> jacks_;
  bool is_held_ = false;
  std::string unread_;
  std::size_t rows_ = 0, telling_ = 0;
};

/// Of a whole log.
FirstLoad first_load_of(const std::string& path, const LogRules& rules, const SceneDescription& scene);

}  // namespace taut::host
