// What has to hold whatever noise there is: asked of many sites that differ in their seeds.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>

namespace estimation {

/// Calls check(site) with a new Site(seed, said) for twenty seeds; a check that fails says which one.
template <class Site, class Said, class Check>
void for_each_seed(const Said& said, const Check& check) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const auto site = std::make_unique<Site>(seed, said);
    check(*site);
  }
}

}  // namespace estimation
