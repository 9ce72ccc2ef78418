// The scene "rolling cable-strut joint: three set-ups side by side" after static condensation, written by `taut export`: do not edit.
#pragma once

#ifndef TAUT_DEVICE_HPP
#if __has_include("taut/device.hpp")
#include "taut/condensation/condensed.hpp"
#include "taut/estimation/friction_prior.hpp"
#else
#include "taut_device.hpp"  // taut in one header
#endif
#endif

namespace rolling_cable_strut_joint_three_set_ups_side_by_side {

/// Fits the condensed scene exactly.
struct Capacity : ::taut::Capacity {
  static constexpr int nodes = 0, struts = 0, cables = 3, jacks = 3, spans = 3, segments = 6, joints = 3, substructures = 0, loads = 0;
  static constexpr bool hoops = false, prestrain = false, smooth = false, strokes = false, seating = false, lags = false;
};

namespace detail {

constexpr ::taut::FixedList<::taut::CableLayout<float>, Capacity::cables> make_cables(float) {
  ::taut::FixedList<::taut::CableLayout<float>, Capacity::cables> cables;
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0F, 3, 0, 0});
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0F, 3, 2, 1});
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0F, 3, 4, 2});
  return cables;
}
constexpr ::taut::Condensed<float, Capacity> make_condensed(float) {
  return {make_cables(float()), 6, 3, 0,
          /*coupling*/ {{{{
            0x1.312dp+24, 0x1.af956f3f59a9cp+23, 0x1.312dp+24, 0x1.af956f3f59a9cp+23, 0x1.312dp+24,
            0x1.af956f3f59a9cp+23}}}},
          /*prestrain*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0}}},
          /*load*/ {},
          /*rho*/ {{{
            0x1.aadf0be3119cep-1, 0x1.c8711e2f88b43p-1, 0x1.9123afdc8d58p-1}}},
          /*cos_alpha*/ {{{
            0x1.87de2ap-2F, 0x1.87de2ap-2F, 0x1.87de2ap-2F}}},
          /*sin_alpha*/ {{{
            0x1.d906bcp-1F, 0x1.d906bcp-1F, 0x1.d906bcp-1F}}},
          /*most_force*/ {{{
            0x1.e848p+20F, 0x1.e848p+20F, 0x1.e848p+20F}}},
          /*most_factor*/ {}};
}
constexpr ::taut::FrictionPrior<float, Capacity> make_prior(float) {
  return {/*mu*/ {{{
            0x1.c04ea4a8c154dp-3, 0x1.1ba5e353f7ceep-3, 0x1.2c226809d4952p-2}}},
          /*contact_factor*/ {{{
            0x1.a827999fcef32p-2, 0x1.a827999fcef32p-2, 0x1.a827999fcef32p-2}}},
          /*capstan*/ {{{
            false, false, false}}},
          /*mu_sd*/ {{{
            0x1.c04ea4p-4F, 0x1.1ba5e4p-4F, 0x1.2c2268p-3F}}},
          /*shared*/ {{{
            false, false, false}}},
          /*scatter*/ {{{
            0x0p+0F, 0x0p+0F, 0x0p+0F}}},
          /*seating_sd*/ {{{
            0x0p+0F, 0x0p+0F, 0x0p+0F}}},
          /*drift_sd*/ {{{
            0x0p+0F, 0x0p+0F, 0x0p+0F}}},
          /*length*/ {{{
            0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F}}},
          /*cell*/ {{{
            {{{0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}, {0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}}},
            {{{0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}, {0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}}},
            {{{0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}, {0x0p+0F, 0x0p+0F, 0x0p+0F, 0x0p+0F, 0x1p+0F, 0x1p+0F}}}}}}};
}

constexpr ::taut::FixedList<::taut::CableLayout<double>, Capacity::cables> make_cables(double) {
  ::taut::FixedList<::taut::CableLayout<double>, Capacity::cables> cables;
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0, 3, 0, 0});
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0, 3, 2, 1});
  cables.add({false, {::taut::End::anchored, ::taut::End::jacked}, 0x0p+0, 3, 4, 2});
  return cables;
}
constexpr ::taut::Condensed<double, Capacity> make_condensed(double) {
  return {make_cables(double()), 6, 3, 0,
          /*coupling*/ {{{{
            0x1.312dp+24, 0x1.af956f3f59a9cp+23, 0x1.312dp+24, 0x1.af956f3f59a9cp+23, 0x1.312dp+24,
            0x1.af956f3f59a9cp+23}}}},
          /*prestrain*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0}}},
          /*load*/ {},
          /*rho*/ {{{
            0x1.aadf0be3119cep-1, 0x1.c8711e2f88b43p-1, 0x1.9123afdc8d58p-1}}},
          /*cos_alpha*/ {{{
            0x1.87de2a6aea962p-2, 0x1.87de2a6aea962p-2, 0x1.87de2a6aea962p-2}}},
          /*sin_alpha*/ {{{
            0x1.d906bcf328d46p-1, 0x1.d906bcf328d46p-1, 0x1.d906bcf328d46p-1}}},
          /*most_force*/ {{{
            0x1.e848p+20, 0x1.e848p+20, 0x1.e848p+20}}},
          /*most_factor*/ {}};
}
constexpr ::taut::FrictionPrior<double, Capacity> make_prior(double) {
  return {/*mu*/ {{{
            0x1.c04ea4a8c154dp-3, 0x1.1ba5e353f7ceep-3, 0x1.2c226809d4952p-2}}},
          /*contact_factor*/ {{{
            0x1.a827999fcef32p-2, 0x1.a827999fcef32p-2, 0x1.a827999fcef32p-2}}},
          /*capstan*/ {{{
            false, false, false}}},
          /*mu_sd*/ {{{
            0x1.c04ea4a8c154dp-4, 0x1.1ba5e353f7ceep-4, 0x1.2c226809d4952p-3}}},
          /*shared*/ {{{
            false, false, false}}},
          /*scatter*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0}}},
          /*seating_sd*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0}}},
          /*drift_sd*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0}}},
          /*length*/ {{{
            0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0}}},
          /*cell*/ {{{
            {{{0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}, {0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}}},
            {{{0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}, {0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}}},
            {{{0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}, {0x0p+0, 0x0p+0, 0x0p+0, 0x0p+0, 0x1p+0, 0x1p+0}}}}}}};
}

}  // namespace detail

/// The scene for Tracker and Estimator, as condensed<float> or condensed<double>.
template <class Scalar>
inline constexpr ::taut::Condensed<Scalar, Capacity> condensed = detail::make_condensed(Scalar());

/// What is known of friction and load cells, for Estimator. Where the scene has no mu_sd it is half of the mean mu.
/// Of a jack that the scene does not say to be exact, an ordinary cell is taken, at an anchored end only one whose sd it says.
template <class Scalar>
inline constexpr ::taut::FrictionPrior<Scalar, Capacity> prior = detail::make_prior(Scalar());

/// The Parameters of an Estimator of this scene.
constexpr int unknowns = 3;
/// And its Further: unknowns of load cells at anchored ends.
constexpr int reading_unknowns = 0;

/// Names, by the numbers that samples, responses and statuses use.
namespace names {

/// Cables, as in Sample::jack.
inline constexpr ::taut::FixedArray<const char*, Capacity::cables> cables = {{{
    "original", "teflon", "welded"}}};
/// Load patterns, as in Sample::factor.
inline constexpr ::taut::FixedArray<const char*, Capacity::loads> loads = {};
/// The nodes at which the joints lie.
inline constexpr ::taut::FixedArray<const char*, Capacity::joints> joint_nodes = {{{
    "original joint", "teflon joint", "welded joint"}}};

}  // namespace names

}  // namespace rolling_cable_strut_joint_three_set_ups_side_by_side
