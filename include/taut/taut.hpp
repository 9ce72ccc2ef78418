// taut: the force in every cable segment of a cable-supported structure while it is being tensioned.
//
// All of the library, and what it promises. include/taut/README.md has the equations, README.md a program.
// device.hpp has what follows an exported scene, without Eigen.
//
// UNITS. SI throughout: m, N, N/m2, K, rad, s. Forces of segments, struts and jacks are positive in tension.
// Friction coefficients and load factors have no unit.
//
// NUMBERS. Nodes, struts, beams, cables, segments, joints and load patterns are counted from 0 over the whole
// scene, the segments and joints of one cable one after the other; files and messages count from 1. A cable
// end is 0 (start) or 1 (end). Arrays have the size of the capacity; what is beyond the scene's own count
// has no meaning. An index is not checked: one outside of the scene is undefined behaviour.
//
// ERRORS are values: a Status, or a Progress with one, that cannot be ignored. It is false if something is
// wrong, and names the node, joint, cable or end; segments and joints are counted along their cable there.
// Nothing throws or prints. What returns no Status cannot fail.
// advance() before start() fails with `not_started`; what returns no Status says zero then.
//
// MEMORY. No heap. An object holds all its storage, of a size that its types fix: keep Tracker, Estimator,
// Condensation and above all Stepwise in static memory rather than on a stack. There is no recursion, so the
// stack that a call needs is bounded, too. firmware_example/SIZES.md has both, measured.
//
// INTERRUPTS AND THREADS. Nothing has state outside of its own objects, waits or takes a lock. So every call
// may be made from an interrupt or a thread, but not while another call changes the same object: who reads
// tension() in an interrupt that has cut into advance() sees half of a state. Functions that are const may
// run at the same time. Scenes, condensed scenes and FrictionPrior are only read and may be shared. An event
// takes a thousand times as long as a sample without one: let the interrupt hand over the readings, and call
// advance() outside.
//
// THE SAME BITS everywhere from Condensed on: + - * / and square roots alone, in the order written down. It
// takes IEEE arithmetic, -ffp-contract=off and no -ffast-math. For capstan joints Condensation and
// find_friction_prior() use tanh and atan2 of the C library, which may round as they like: export those
// scenes.
//
// COSTS are orders of the worst case, in operations, for n segments and J joints (of all cables together), L
// load patterns, K jacked ends and P unknowns of the friction.
//
// --------------------------------------------------------------------------------------------------------
//
// Scene<Scalar, Dimension, Capacity>: what is modelled. A plain value, filled by add functions at run time
// or in a constant expression. An add function returns the number of what was added, or -1 if there is no
// room, and costs as much as there is to copy.
//
//   validate(scene), which Condensation and Stepwise call first, fails if and only if something in the scene
//   cannot be used as it is: `capacity_exceeded` to `out_of_range` in status.hpp. It does not promise an
//   answer. Costs the square of the nodes of a path, and the cube of the rows of a substructure.
//
// Condensation<Scalar, Scene>: from a scene to Condensed, once. The object can be thrown away after run().
//
//   Fails as validate(); with `mechanism` if a node is free to move with all joints stuck (between rigid
//   saddles: if a node is not held); with `ill_conditioned` if a node is held so weakly that this cannot be
//   told, or a solve does not reach equilibrium to 2e-12 of its largest force, in double for float, too;
//   with `capacity_exceeded` if its factor has more entries than Capacity::profile, or too many
//   displacements are asked for; with `out_of_range` for a displacement that the scene has not. `condensed`
//   is of no use then. Costs one factorization within the skyline of the stiffness matrix and 1 + L + n
//   solves of at most 16 corrections each; between rigid saddles n (1 + L).
//
// Condensed<Scalar, Capacity>: an aggregate of arrays, a constant in flash if `taut export` wrote it. In
// double for float, too: coupling n x n [N/m], symmetric, or n between rigid saddles; prestrain n [N]; load
// L x n [N a unit factor]; rho J, 0 < rho <= 1, or 0 where the joint is self-locking. On request rows for
// strut forces [N] (CondensedStruts) and displacements [m] (CondensedDisplacements), 1 + L + n numbers each.
//
// SecondOrderCondensation<Scalar, Scene>: the same in second-order theory, to SecondOrder, which takes the
// place of Condensed in Tracker and Estimator.
//
//   run() takes the loads and jack forces of the target besides. It fails as Condensation does, there also
//   with `mechanism` where tension and thrust at the target leave a node without stiffness, with `gives_way`
//   where members buckle there, and with `out_of_range` if no cable has tension there.
//   Costs twelve condensations, with a solve more for every strut and beam, and three paths to the target. A
//   tracker has n^2 numbers more, and n^2 operations for every bar where its level or geometry has changed by
//   a step.
//
// Tracker<Condensed, Parameters>: exact from sample to sample. The condensed scene must outlive it. start(),
// then advance() for every Sample: factors of the L load patterns, force [N] and lock of both ends of every
// cable.
//
//   advance() refuses a sample with `bad_sample`, and does nothing, if and only if a factor is not finite or
//   beyond Condensed::most_factor, or the force of an unlocked jack is not finite, negative or beyond
//   Condensed::most_force. On the path to the sample it ends with
//     `pulled_through`    two jacks of a cable differ by more than friction holds (on a cable of one segment
//                         they must pull alike, and nothing is done),
//     `mechanism`         a joint that slides sets its node free,
//     `gives_way`         no answer goes on from here: the structure would jump,
//     `ill_conditioned`   equilibrium is not reached to rounding,
//     `state_iterations`  events follow one another, and the path does not go on.
//   Then, or when the event budget is spent (fraction < 1 and no error), the state is the last that was
//   tested against friction, T >= 0 and equilibrium, and the next call goes on from there. "Where the theory
//   ends" in include/taut/README.md says where these may be wrong. start() fails as the path of the prestrain
//   does.
//
//   Costs n (K + L) without an event, n where one input alone changes. A call has at most `event_budget`
//   events, 64 + 16 n by default. An event solves a complementarity problem, at worst six, and three more for
//   every step a little further on that is tried, most often one and seven in a row at worst; each has n + 2
//   J pairs at most, with 16 pivots a pair. It makes one map, n^2 (K + L). A pivot costs n^2 on a structure,
//   n^3 if constraints are factored anew, and n between rigid saddles. Most events are one pivot. tension()
//   costs nothing; respond() n (J + K + L), and n + L for every strut. save() is a copy; restore() factors
//   the constraints, n^3, and makes one map. restore() fails with `bad_sample` if it finds that the state is
//   none of this scene; it does not find all.
//
// verify(tracker): an independent check of a tracker's state against equilibrium, T >= 0 and the friction
// cones, from the slips alone. It returns violations as parts of the largest force so far: where all is well
// about 1e-11 in double and 1e-7 in float. Costs n (n + J + L); const.
//
// Estimator<Condensed, Parameters, Further>: from readings to forces with standard deviations. Parameters
// holds one unknown for every joint that can slide, or for every cable with a shared mu; gain, zero and
// hysteresis of a jack's load cell where they are not known; two for every jack whose load cell has noise and
// one for its wedge, without which reversals and draw-in count as exact. Further holds gain and zero of all
// other instruments. They are `unknowns` and `reading_unknowns` of an exported header, whose `strokes` are
// the instruments that start() takes and take_stroke() is given, by number. Condensed scene and
// FrictionPrior must outlive it. start(), then advance() for every Readings: forces [N] and strokes [m]
// of cable ends as far as they were read, load factors, locks, time since the row before.
//
//   start() fails with `capacity_exceeded` if and only if friction and cells at jacks have more unknowns than
//   Parameters, or other instruments more than Further, otherwise as Tracker::start(). advance() fails with
//   `bad_sample`, and does nothing, if a load factor is not finite or beyond Condensed::most_factor, or dt is
//   below zero or not finite, otherwise as Tracker::advance(). Readings with dt zero count as far apart as
//   those before. A reading that is not finite, more than the cable can carry, or contradicts is no error: it
//   is left out, with an alarm. alarms() are those of the last row. A row whose event budget is spent is gone
//   on with by calls with the same sample, no readings and dt zero.
//
//   Intervals hold for readings with a constant gain and zero as uncertain as stated, and independent
//   Gaussian noise, at least as stated.
//
//   Costs n + K + P^2 a row without an event. With events the path has up to five parts (to where jacks were
//   when other loads began to change, twice, to reversals, to lock-offs, to the row), and where it has no
//   answer three more; each is up to one call of Tracker::advance(), and four more for every cable that two
//   jacks pull, with the event budget each. A measurement adjusts the tracker up to four times, J + 1 maps
//   each. estimate(segment) costs P (P + K + L), const. take_strut() and take_stroke() are for after an
//   advance() that came to its end, and cost P n (K + L) and a measurement. Where two jacks pull a cable both
//   strokes of a row count together.
//
// find_bounds(): least and largest force of every segment of a cable whose past is not known, from load
// cells and a band of mu. `ranges` has n entries [N]; those of the cable are filled. Returns false if no
// load cell was read or the cable is a closed hoop: then they are 0 to infinity. An empty range says that
// readings and band contradict each other. Costs the segments of the cable, twice.
//
// JackPlanner<Tracker>: the next moves of one jack, none to two, that bring forces nearest to the targets of
// a JackGoal, from where an Estimator, or any tracker of this type, says that the cables are; other jacks and
// loads stay. begin(), then step() with a few events at a time until it is true; best() at any time.
//
//   begin() fails with `bad_sample` if the end has no jack at work, or the state is none of the scene; from
//   an Estimator, with `mechanism` where Tracker::adjust() does. What has no answer on the way is not looked
//   at any further. Looks end after `most_events` at the latest, by default 128 (n + 32), eight times that in
//   second-order theory. step(k) costs k events of the tracker and, for each, n numbers.
//
// Stepwise<Scalar, Scene>: the procedure of Yan et al. (2015), for the host: the reference that all else is
// compared with. The scene must outlive it. Its error is that of its load steps.
//
//   start() fails as validate(), then as a path does. advance() fails with `bad_sample`, and does nothing,
//   if and only if a factor or the force of an unlocked jack is not finite, or the force negative; at a load
//   step with `mechanism`, `pulled_through`, `state_iterations` or `ill_conditioned`, and stays at the step
//   before. With R <= n sliding spans a load step takes at most 16 + 2 (J + R) global systems, and (2 + 2 R)
//   (J + 2) more if that does not settle: each a band factorization of Dimension (nodes + 2 J) unknowns.
#pragma once

#include "taut/condensation/condense.hpp"
#include "taut/elements/elements.hpp"
#include "taut/estimation/bounds.hpp"
#include "taut/estimation/estimator.hpp"
#include "taut/estimation/find_friction_prior.hpp"
#include "taut/estimation/unknown_past.hpp"
#include "taut/planning/jack_planner.hpp"
#include "taut/scene/capacity.hpp"
#include "taut/scene/friction.hpp"
#include "taut/scene/sample.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/validation.hpp"
#include "taut/status.hpp"
#include "taut/stepwise/stepwise.hpp"
#include "taut/tracking/target_state.hpp"
#include "taut/tracking/tracker.hpp"
#include "taut/tracking/verify.hpp"
