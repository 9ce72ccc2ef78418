// How badly an answer breaks the laws it must obey.
#pragma once

#include <algorithm>
#include <ostream>

namespace support {

using Exact = long double;

/// How badly an answer breaks the laws it must obey; all parts are numbers without a unit, zero is perfect.
///
/// Forces count as parts of the largest force so far. What is computed from displacements counts as a part of
/// stiffness x displacement where that is larger: no scalar type holds a displacement any better.
struct Violations {
  Exact imbalance = 0;            ///< forces on the free axes of a node
  Exact contact = 0;              ///< N or f that does not follow from the tensions
  Exact pushing = 0;              ///< tension below zero
  Exact beyond_friction = 0;      ///< tensions further apart than friction can hold
  Exact incompatible = 0;         ///< tension of a taut segment that does not follow from its elongation
  Exact stretched_but_slack = 0;  ///< a run without tension that is longer than its unstressed length
  Exact strut = 0;                ///< strut force that does not follow from its elongation
  Exact jack = 0;                 ///< tension at an unlocked jack other than the jack's force
  Exact uphill = 0;               ///< slipped against the larger tension in this step
  Exact below_limit = 0;          ///< slipped in this step although friction could hold
  Exact off_limit = 0;            ///< slides, but its tensions are not those at the limit that opposes it
  Exact largest_force = 0;        ///< [N], that the parts above refer to

  Exact worst() const {
    return std::max({imbalance, contact, pushing, beyond_friction, incompatible, stretched_but_slack, strut,
                     jack, uphill, below_limit, off_limit});
  }
};

inline std::ostream& operator<<(std::ostream& out, const Violations& v) {
  return out << "imbalance " << v.imbalance << ", contact " << v.contact << ", pushing " << v.pushing
             << ", beyond_friction " << v.beyond_friction << ", incompatible " << v.incompatible
             << ", stretched_but_slack " << v.stretched_but_slack << ", strut " << v.strut << ", jack "
             << v.jack << ", uphill " << v.uphill << ", below_limit " << v.below_limit << ", off_limit "
             << v.off_limit << ", largest_force " << v.largest_force;
}

}  // namespace support
