/* A PLC program that reads the status of LinuxCNC's motion controller. On a machine the status is in memory that
 * LinuxCNC shares (struct emcmot_struct_t of its sources); here a function fills it. main PROGRAM.so */
#include <stdio.h>

#include "motion_binding.h" /* made by rungc bind of motion.h and motion.bind */

static emcmot_status_t status;
static struct {
  uint8_t red, green, yellow;
} light;

static const rung_variable lamps[] = {
    {"RED", &light.red, RUNG_HOST_BOOL, RUNG_FROM_PROGRAM, 0},
    {"GREEN", &light.green, RUNG_HOST_BOOL, RUNG_FROM_PROGRAM, 0},
    {"YELLOW", &light.yellow, RUNG_HOST_BOOL, RUNG_FROM_PROGRAM, 0},
};

static bool failed(int32_t result) {
  if (result < 0) fprintf(stderr, "%s\n", rung_error_text());
  return result < 0;
}

/* Writes the status as the controller does in each period. */
static void control(double z, double speed, int soft_limit) {
  status.head++;
  status.heartbeat++;
  status.motion_state = EMCMOT_MOTION_COORD;
  status.joint_status[2].homed = true;
  status.joint_status[2].pos_fb = z;
  status.spindle_status[0].speed = speed;
  status.on_soft_limit = soft_limit;
  status.tail = status.head;
}

static bool show(rung_instance* plc, const char* when) {
  for (int ms = 0; ms < 24; ++ms)
    if (failed(rung_instance_run_due(plc, 1000000))) return false;
  printf("%s: red %u, green %u, yellow %u\n", when, light.red, light.green, light.yellow);
  return true;
}

int main(int argc, char** argv) {
  rung_image* image;
  rung_instance* plc;
  if (argc != 2 || failed(rung_image_open(argv[1], NULL, &image)) || failed(rung_instance_new(image, NULL, &plc)) ||
      failed(rung_bind_emcmot_status_t(plc, &status)) || failed(rung_instance_bind(plc, lamps, 3)) ||
      failed(rung_instance_power_on(plc, RUNG_WARM)))
    return 1;
  control(10, 0, 0);
  if (!show(plc, "at rest")) return 1;
  control(-2.5, 1200, 0);
  if (!show(plc, "cutting")) return 1;
  control(-80, 1200, 16);
  if (!show(plc, "beyond a limit")) return 1;
  status.head++; /* the controller begins to write, and hangs */
  status.on_soft_limit = 0;
  if (!show(plc, "in the middle of a change")) return 1;
  status.tail = status.head;
  if (!show(plc, "after it")) return 1;
  if (failed(rung_instance_power_off(plc))) return 1;
  rung_instance_free(plc), rung_image_close(image);
  return 0;
}
