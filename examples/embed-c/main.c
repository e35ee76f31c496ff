/* A demonstration CNC: one axis, moved by a PLC program. main PROGRAM.so NEXT.so */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include <rung/runtime.h>

static struct {
  bool start, jam, enable;
  int32_t position; /* 0.001 mm */
  uint8_t strokes;
} axis;

static const rung_variable variables[] = {
    {"START", &axis.start, RUNG_HOST_BOOL, RUNG_TO_PROGRAM, 0},
    {"JAM", &axis.jam, RUNG_HOST_BOOL, RUNG_TO_PROGRAM, 0},
    {"D0:4", &axis.position, RUNG_HOST_I32, RUNG_TO_PROGRAM, 0},
    {"ENABLE", &axis.enable, RUNG_HOST_BOOL, RUNG_FROM_PROGRAM, 0},
    {"STROKES", &axis.strokes, RUNG_HOST_U8, RUNG_FROM_PROGRAM, 0},
};

static bool failed(int32_t status) {
  if (status < 0) fprintf(stderr, "%s\n", rung_error_text());
  return status < 0;
}

/* Simulates the machine for a millisecond. */
static void move(void) {
  if (axis.enable) axis.position += 50;
  axis.start = !axis.enable && axis.position == 0;
  if (!axis.enable && axis.position > 0) axis.position -= 250; /* back to the start */
  if (axis.position < 0) axis.position = 0;
}

int main(int argc, char** argv) {
  rung_image *image, *next;
  rung_instance* plc;
  rung_replacement* change;
  rung_instance_options options = {.size = sizeof options, .flags = RUNG_MEASURE};
  if (argc != 3 || failed(rung_image_open(argv[1], NULL, &image)) || failed(rung_image_open(argv[2], NULL, &next)) ||
      failed(rung_instance_new(image, &options, &plc)) ||
      failed(rung_instance_bind(plc, variables, sizeof variables / sizeof *variables)) ||
      failed(rung_instance_power_on(plc, RUNG_WARM)) || failed(rung_replacement_new(plc, next, NULL, 0, &change)))
    return 1;
  struct timespec due;
  clock_gettime(CLOCK_MONOTONIC, &due);
  bool changed = false;
  for (int ms = 0; ms < 2000; ++ms) {
    if (ms == 700) axis.jam = true;
    if (rung_instance_run_due(plc, 1000000) == RUNG_FAULTED) { /* outputs are 0: the axis does not move */
      rung_fault_info fault = {.size = sizeof fault};
      rung_instance_fault(plc, &fault);
      printf("%d ms: %s\n", ms, fault.text);
      axis.jam = false;
      if (failed(rung_instance_power_on(plc, RUNG_WARM))) return 1;
    }
    if (ms >= 1000 && !changed) { /* a new program, while the axis moves */
      const int32_t status = rung_instance_replace(plc, change);
      if (failed(status)) return 1;
      if (status == RUNG_OK) changed = printf("%d ms: the new program runs\n", ms) > 0;
    }
    move();
    due.tv_nsec += 1000000;
    if (due.tv_nsec >= 1000000000) due.tv_sec++, due.tv_nsec -= 1000000000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL);
  }
  rung_profile worst = {.size = sizeof worst};
  if (rung_instance_worst_rung(plc, &worst) == RUNG_OK)
    printf("%" PRIu8 " strokes; the worst rung is %s, %s:%u\n", axis.strokes, worst.title, worst.file, worst.line);
  if (failed(rung_instance_power_off(plc))) return 1;
  rung_replacement_free(change), rung_instance_free(plc), rung_image_close(next), rung_image_close(image);
  return 0;
}
