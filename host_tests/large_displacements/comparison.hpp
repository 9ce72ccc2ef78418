// Two results as CSV, column by column.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace large_displacements {

/// The columns of a result by name, as they are written.
using Table = std::map<std::string, std::vector<std::string>>;
Table table_of(const std::string& text);

/// The largest difference in one kind of columns, of the largest value there.
struct Difference {
  std::string kind;  ///< "segments", "struts", "payouts", "slips", "displacements"
  double largest = 0, part = 0;
  std::string column;  ///< where it is
  double time = 0;
};

/// Over the rows up to a time [s] and the columns that both have; columns of other kinds do not count.
std::vector<Difference> compare(const std::string& result, const std::string& reference,
                                double until = std::numeric_limits<double>::infinity());

/// By what part the loads differ at which two messages say that a path ended, "... C.end 2.46e+06 N ...", of
/// the second one. One that names no load came to the largest of the log, so that this is the least part;
/// negative where neither does.
double end_difference(const std::string& message, const std::string& reference, const std::string& log);

/// Tables of what random.cmake found, a line for each kind of structure: how far both came, then the largest
/// difference of each kind and that which 95 % of the scenes stay below [% of the largest value]. Once up to
/// the target and once up to where taut remarks that joints bend by more than the theory is made for.
std::string summary(const std::string& lines);

}  // namespace large_displacements
