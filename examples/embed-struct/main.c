/* A demonstration control whose parts, one of them the PLC program, share a struct. main PROGRAM.so */
#include <stdio.h>

#include "nc_binding.h" /* made by rungc bind of nc_block.h and nc.bind */

static nc_block block;

static bool failed(int32_t status) {
  if (status < 0) fprintf(stderr, "%s\n", rung_error_text());
  return status < 0;
}

/* Simulates another part of the control for a millisecond. */
static void control(void) {
  block.head++;
  block.keys.start = block.axis[0].position == 0;
  if (block.axis[0].enable) block.axis[0].position += 50;
  block.tail = block.head;
}

static void show(int ms) {
  printf("%d ms: %.3f mm, drive %u, lamps %02x %02x, feed %.1f\n", ms, block.axis[0].position / 1000.0,
         block.axis[0].enable, block.lamps[0], block.lamps[1], block.feed);
}

int main(int argc, char** argv) {
  rung_image* image;
  rung_instance* plc;
  if (argc != 2 || failed(rung_image_open(argv[1], NULL, &image)) || failed(rung_instance_new(image, NULL, &plc)) ||
      failed(rung_bind_nc_block(plc, &block)) || failed(rung_instance_power_on(plc, RUNG_WARM)))
    return 1;
  block.mode = NC_MODE_AUTO;
  block.keys.override = 12;
  block.buttons[0] = 0x81, block.buttons[1] = 0x0f;
  for (int ms = 1; ms <= 200; ++ms) {
    control();
    if (failed(rung_instance_run_due(plc, 1000000))) return 1;
    if (ms % 50 == 0) show(ms);
  }
  block.head++; /* the control begins to write, and hangs */
  block.buttons[0] = 0x42;
  for (int ms = 0; ms < 40; ++ms)
    if (failed(rung_instance_run_due(plc, 1000000))) return 1;
  uint32_t inconsistent = 0;
  rung_instance_inconsistent(plc, &block, &inconsistent);
  printf("lamps %02x %02x; no whole copy for %u slices\n", block.lamps[0], block.lamps[1], inconsistent);
  if (failed(rung_instance_power_off(plc))) return 1;
  rung_instance_free(plc), rung_image_close(image);
  return 0;
}
