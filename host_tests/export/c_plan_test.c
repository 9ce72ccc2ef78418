/* The next moves through the C interface of a scene that `taut export --c jack` wrote: the jack at the end of cable 0 pulls, goes too far,
 * and moves are looked for while rows go on. Writes what was found as bits.
 *   -DPULL= largest force of the jack [N]    -DTARGET= of the first four segments [N]    -DEVENTS= of each search in all */
#ifndef JACK_PLAN
#define JACK_PLAN
#endif
#include <stdio.h>
#include <string.h>

#include "jack.h"
#include "put_bits.h"

static void put(float value) {
  putchar(' ');
  put_bits(value);
}

static jack_row row;

static int read_row(float force) {
  row.dt = 1;
  row.end[0][1].has_force = 1;
  row.end[0][1].force = force;
  row.end[0][0].has_force = row.end[0][1].force > 0;
  row.end[0][0].force = 0.8f * force;
  return jack_advance(&row).code;
}

static int look(const jack_goal* goal) {
  jack_moves moves;
  int i, events;
  jack_status status = jack_plan(goal, 0, 1);
  if (status.code != 0) return status.code;
  for (events = 0; events < EVENTS && !jack_plan_on(5); events += 5)
    if (read_row(row.end[0][1].force) != 0) return -1; /* the estimator goes on */
  moves = jack_plan_moves();
  printf("%d", moves.count);
  put(moves.force[0]);
  put(moves.force[1]);
  put(moves.error);
  for (i = 0; i < JACK_SEGMENTS; ++i) put(jack_plan_force(i));
  putchar('\n');
  return 0;
}

int main(void) {
  jack_goal goal;
  int i;
  memset(&goal, 0, sizeof goal);
  /* Calls that make no sense. */
  if (jack_plan(&goal, 0, 1).code == 0 || !jack_plan_on(1) || jack_plan_force(0) == jack_plan_force(0)) return 3;
  if (jack_start().code != 0) return 1;
  if (jack_plan(NULL, 0, 1).code == 0 || jack_plan(&goal, JACK_CABLES, 1).code == 0 || jack_plan(&goal, 0, 0).code == 0) return 3;
#if JACK_LOADS > 0
  row.factor[0] = 1;
#endif
  for (i = 0; i < 4; ++i) goal.target[i] = TARGET;
  if (read_row(0) != 0 || look(&goal) != 0) return 1;
  for (i = 1; i <= 10; ++i)
    if (read_row(PULL * 0.1f * (float)i) != 0) return 1;
  if (look(&goal) != 0) return 1;
  goal.lock = 1;
  goal.most_force = 0.95f * PULL;
  goal.worth_a_move = 0.001f;
  return look(&goal) != 0;
}
