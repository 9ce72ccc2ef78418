/* Follows a log through the C interface of a scene: C_INTERFACE is the name that `taut export --c` was given, C_HEADER its header.
 *   c_interface_test LOG LOAD... -- END...    names of the load columns, then of the load cells at start and end of every cable
 * Writes time, forces and standard deviations of all segments as bits, as `taut estimate --scalar float --hex` does. In the middle of
 * the log the state is saved and restored. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include C_HEADER
#include "put_bits.h"

#define JOIN_(a, b) a##_##b
#define JOIN(a, b) JOIN_(a, b)
#define CALL(function) JOIN(C_INTERFACE, function)

enum { most_columns = 32, most_line = 4096 };

static char* columns[most_columns];
static int column_count;

static int column_of(const char* name, const char* ending) {
  char wanted[128];
  int i;
  strcpy(wanted, name);
  strcat(wanted, ending);
  for (i = 0; i < column_count; ++i)
    if (strcmp(columns[i], wanted) == 0) return i;
  return -1;
}

static int split(char* line, char** fields) {
  int count = 0;
  line[strcspn(line, "\r\n")] = '\0';
  for (;;) {
    fields[count++] = line;
    line = strchr(line, ',');
    if (line == NULL || count == most_columns) return count;
    *line++ = '\0';
  }
}

static int failed(CALL(status) status) {
  if (status.code != 0) fprintf(stderr, "%s\n", CALL(describe)(status));
  return status.code != 0;
}

/* Calls that make no sense have an answer all the same. */
static int bad_calls_are_refused(void) {
  CALL(row) row;
  memset(&row, 0, sizeof row);
  if (CALL(advance)(&row).code == 0 || CALL(advance)(NULL).code == 0) return 0;
  if (CALL(restore)(NULL, 0).code == 0 || CALL(save)(NULL, 0) != 0) return 0;
  if (CALL(force)(0) == CALL(force)(0) || CALL(state)(0) != '?') return 0; /* a NaN differs from itself */
  return CALL(alarms)() == 0 && CALL(alarm)(0).kind == -1;
}

int main(int argc, char** argv) {
  char header[most_line], line[most_line];
  char* fields[most_columns];
  const char* loads[16];
  const char* ends[32];
  int load_count = 0, end_count = 0, is_end = 0, i, row_number = 0;
  double before = 0;
  CALL(row) row;
  FILE* log = fopen(argv[1], "r");
  void* saved = malloc(CALL(state_size)());
  if (log == NULL || saved == NULL) return 2;
  for (i = 2; i < argc; ++i) {
    if (strcmp(argv[i], "--") == 0)
      is_end = 1;
    else if (is_end)
      ends[end_count++] = argv[i];
    else
      loads[load_count++] = argv[i];
  }
  if (!bad_calls_are_refused()) return 3;
  if (fgets(header, sizeof header, log) == NULL) return 2;
  column_count = split(header, columns);
  memset(&row, 0, sizeof row);
  if (failed(CALL(start)())) return 1;
  while (fgets(line, sizeof line, log) != NULL) {
    const int count = split(line, fields);
    const double time = strtod(fields[0], NULL);
    row.dt = row_number == 0 ? 1.0f : (float)(time - before);
    for (i = 0; i < load_count; ++i) {
      const int at = column_of(loads[i], "");
      if (at >= 0 && at < count && fields[at][0] != '\0') row.factor[i] = (float)strtod(fields[at], NULL);
    }
    for (i = 0; i < end_count; ++i) {
      CALL(end)* const end = &row.end[i / 2][i % 2];
      const int force = column_of(ends[i], ""), locked = column_of(ends[i], ".locked");
      end->has_force = force >= 0 && force < count && fields[force][0] != '\0';
      if (end->has_force) end->force = (float)strtod(fields[force], NULL);
      if (locked >= 0 && locked < count && fields[locked][0] != '\0') end->locked = fields[locked][0] == '1';
    }
    if (failed(CALL(advance)(&row))) return 1;
    before = time;
    if (++row_number == 2) {
      const size_t size = CALL(save)(saved, CALL(state_size)());
      if (size == 0 || failed(CALL(start)()) || failed(CALL(restore)(saved, size))) return 1;
    }
    put_bits((float)time);
    for (i = 0; CALL(force)(i) == CALL(force)(i); ++i) putchar(','), put_bits(CALL(force)(i));
    for (i = 0; CALL(sd)(i) == CALL(sd)(i); ++i) putchar(','), put_bits(CALL(sd)(i));
    putchar('\n');
  }
  fclose(log);
  free(saved);
  return 0;
}
