// A load cell on a converter: an instrument that reads newtons.
#pragma once

#include "instruments/reading.hpp"
#include "instruments/scale.hpp"

namespace instruments {

/// `Converter` has `Counts read()`, as Hx711.
template <class Converter>
class LoadCell {
 public:
  LoadCell(Converter& converter, const Scale& scale) : converter_(converter), scale_(scale) {}

  Reading read() {
    const auto counts = converter_.read();
    if (counts.fault != Fault::none) return Reading::without(counts.fault, counts.at);
    return Reading::of(scale_.force(counts.value), counts.at);
  }
  /// To calibrate it.
  Scale& scale() { return scale_; }

 private:
  Converter& converter_;
  Scale scale_;
};

}  // namespace instruments
