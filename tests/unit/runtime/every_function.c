/* Every function of rung/runtime.h from C: what each says of handles that are none. Gives the number of wrong answers,
 * and prints them. */
#include "rung/runtime.h"

#include <stdio.h>
#include <string.h>

int callEveryFunction(void* no_handle);

static int wrong;

static void expect(int32_t status, int32_t wanted, const char* what, int line) {
  if (status == wanted && strlen(rung_error_text()) > 10) return;
  printf("every_function.c:%d: %s gives %d, not %d: \"%s\"\n", line, what, status, wanted, rung_error_text());
  ++wrong;
}
#define BAD_HANDLE(call) expect(call, RUNG_BAD_HANDLE, #call, __LINE__)
#define BAD_ARGUMENT(call) expect(call, RUNG_BAD_ARGUMENT, #call, __LINE__)
#define REFUSED(call) expect(call, RUNG_REFUSED, #call, __LINE__)

static void images(rung_image* image) {
  rung_symbol_info symbol = {.size = sizeof symbol};
  BAD_HANDLE(rung_image_symbol(image, 0, &symbol));
  if (rung_image_program(image) != NULL) ++wrong;
}

static void instances(rung_instance* plc) {
  rung_state state = {.size = sizeof state};
  rung_fault_info fault = {.size = sizeof fault};
  rung_message_info message = {.size = sizeof message};
  rung_request request = {.size = sizeof request};
  rung_reply reply = {.size = sizeof reply};
  rung_profile profile = {.size = sizeof profile};
  rung_program_info program = {.size = sizeof program};
  rung_cell_info info = {.size = sizeof info};
  rung_cell cell = 0;
  int64_t constant = 0;
  rung_value value = {0};
  uint32_t line = 0;
  char text[8];
  size_t size = 0;
  BAD_HANDLE(rung_instance_power_on(plc, RUNG_COLD));
  BAD_HANDLE(rung_instance_power_off(plc));
  BAD_HANDLE(rung_instance_stop(plc));
  BAD_HANDLE(rung_instance_start(plc));
  BAD_HANDLE(rung_instance_run_due(plc, 0));
  BAD_HANDLE(rung_instance_run_due_fast(plc, 0));
  BAD_HANDLE(rung_instance_slice(plc));
  BAD_HANDLE(rung_instance_scan(plc));
  BAD_HANDLE(rung_instance_slot(plc));
  BAD_HANDLE(rung_instance_fast(plc));
  BAD_HANDLE(rung_instance_limit(plc, 0));
  BAD_HANDLE(rung_instance_sample(plc));
  BAD_HANDLE(rung_instance_prefetch(plc, 0));
  BAD_HANDLE(rung_instance_state(plc, &state));
  BAD_HANDLE(rung_instance_fault(plc, &fault));
  BAD_HANDLE(rung_instance_find(plc, "X", RUNG_READ, &cell));
  BAD_HANDLE(rung_instance_cell(plc, cell, &info));
  BAD_HANDLE(rung_instance_describe(plc, NULL, "X", RUNG_READ, &info, &constant));
  BAD_HANDLE(rung_instance_release(plc, cell));
  BAD_HANDLE(rung_instance_read(plc, cell, 0, 1, &value));
  BAD_HANDLE(rung_instance_write(plc, cell, 0, 1, &value));
  BAD_HANDLE(rung_instance_read_all(plc, &cell, 1, &value));
  BAD_HANDLE(rung_instance_write_all(plc, &cell, 1, &value));
  BAD_HANDLE(rung_instance_read_text(plc, cell, text, sizeof text));
  BAD_HANDLE(rung_instance_write_text(plc, cell, "a"));
  BAD_HANDLE(rung_instance_bind(plc, NULL, 0));
  BAD_HANDLE(rung_instance_bind_blocks(plc, NULL, 0));
  BAD_HANDLE(rung_instance_bind_struct(plc, NULL, NULL));
  BAD_HANDLE(rung_instance_inconsistent(plc, NULL, NULL));
  BAD_HANDLE(rung_instance_next_message(plc, &message));
  BAD_HANDLE(rung_instance_shown(plc, 0, &message));
  BAD_HANDLE(rung_instance_define_message(plc, 1, 0, "a"));
  BAD_HANDLE(rung_instance_next_request(plc, &request));
  BAD_HANDLE(rung_instance_answer(plc, &reply));
  BAD_HANDLE(rung_instance_begin_function(plc, 0, RUNG_FUNCTION_M, 3, &line));
  BAD_HANDLE(rung_instance_function_done(plc, 0, 0));
  BAD_HANDLE(rung_instance_abort_functions(plc, 0));
  BAD_HANDLE(rung_instance_supports_function(plc, 0, RUNG_FUNCTION_M, 3));
  BAD_HANDLE(rung_instance_group_function(plc, 0, 3, 1));
  BAD_HANDLE(rung_instance_high_speed_functions(plc, 0));
  BAD_HANDLE(rung_instance_begin_power_off(plc));
  BAD_HANDLE(rung_instance_axis_group(plc, 0, 0));
  BAD_HANDLE(rung_instance_serving(plc, 1));
  BAD_HANDLE(rung_instance_keep(plc, "file"));
  BAD_HANDLE(rung_instance_flush(plc));
  BAD_HANDLE(rung_instance_unsaved(plc, text, sizeof text));
  BAD_HANDLE(rung_instance_save(plc, text, sizeof text, &size));
  BAD_HANDLE(rung_instance_load(plc, text, sizeof text));
  BAD_HANDLE(rung_instance_set_clock(plc, 0));
  rung_recording_info recorded = {.size = sizeof recorded};
  BAD_HANDLE(rung_instance_record(plc, NULL));
  BAD_HANDLE(rung_instance_mark(plc, "a"));
  BAD_HANDLE(rung_instance_keep_recording(plc));
  BAD_HANDLE(rung_instance_follow_recording(plc));
  BAD_HANDLE(rung_instance_recording(plc, &recorded));
  rung_timer_info timer = {.size = sizeof timer};
  BAD_HANDLE(rung_instance_timer(plc, 0, &timer));
  BAD_HANDLE(rung_instance_profile(plc, 0, &profile));
  BAD_HANDLE(rung_instance_worst_rung(plc, &profile));
  BAD_HANDLE(rung_instance_clear_profile(plc));
  BAD_HANDLE(rung_instance_replace(plc, NULL));
  BAD_HANDLE(rung_instance_program(plc, &program));
}

static void watches(rung_watch* watch) {
  rung_sample sample = {.size = sizeof sample};
  rung_value value = {0};
  BAD_HANDLE(rung_watch_newest(watch, &value, &sample));
  BAD_HANDLE(rung_watch_next(watch, &value, &sample));
  rung_trace* trace = NULL;
  BAD_HANDLE(rung_trace_new(watch, "file.vcd", &trace));
}

static void replacements(rung_replacement* replacement) {
  rung_replacement_info report = {.size = sizeof report};
  rung_change change = {.size = sizeof change};
  rung_rung_change rung = {.size = sizeof rung};
  BAD_HANDLE(rung_replacement_report(replacement, &report));
  BAD_HANDLE(rung_replacement_change(replacement, 0, &change));
  BAD_HANDLE(rung_replacement_allow_late(replacement));
  BAD_HANDLE(rung_replacement_rung(replacement, 0, &rung));
}

static void shadows(rung_instance* plc, rung_image* image, rung_shadow* shadow) {
  rung_shadow_info report = {.size = sizeof report};
  rung_difference difference = {.size = sizeof difference};
  rung_shadow* made = NULL;
  BAD_HANDLE(rung_shadow_new(plc, image, 1, 1, &made));
  BAD_HANDLE(rung_instance_shadow(plc, NULL));
  BAD_HANDLE(rung_shadow_work(shadow));
  BAD_HANDLE(rung_shadow_report(shadow, &report));
  BAD_HANDLE(rung_shadow_difference(shadow, 0, &difference));
}

static void forces(rung_instance* plc, rung_image* image) {
  const rung_forced_cell cell = {.name = "X"};
  const rung_code_maker maker = {.size = sizeof maker};
  rung_force_info info = {.size = sizeof info};
  rung_forces* made = NULL;
  char byte = 0;
  size_t count = 1;
  BAD_HANDLE(rung_forces_new(plc, NULL, &cell, 1, &made));
  BAD_HANDLE(rung_instance_force(plc, NULL));
  BAD_HANDLE(rung_instance_forced(plc, 0, &info));
  BAD_HANDLE(rung_image_serve(image, &maker));
  BAD_HANDLE(rung_image_file(image, 0, &byte, &count));
}

int callEveryFunction(void* no_handle) {
  void* const handles[] = {NULL, no_handle, (char*)no_handle + 1};
  rung_image* image = NULL;
  rung_instance* plc = NULL;
  rung_replacement* replacement = NULL;
  rung_watch* watch = NULL;
  const rung_cell cell = 0;
  for (size_t i = 0; i < sizeof handles / sizeof *handles; ++i) {
    images(handles[i]);
    instances(handles[i]);
    replacements(handles[i]);
    watches(handles[i]);
    forces(handles[i], handles[i]);
    shadows(handles[i], handles[i], handles[i]);
    BAD_HANDLE(rung_instance_new(handles[i], NULL, &plc));
    BAD_HANDLE(rung_replacement_new(handles[i], NULL, NULL, 0, &replacement));
    BAD_HANDLE(rung_watch_new(handles[i], &cell, 1, 0, &watch));
    if (handles[i] == NULL) continue; /* may be ended */
    BAD_HANDLE(rung_image_close(handles[i]));
    BAD_HANDLE(rung_instance_free(handles[i]));
    BAD_HANDLE(rung_replacement_free(handles[i]));
    BAD_HANDLE(rung_watch_free(handles[i]));
    BAD_HANDLE(rung_forces_free(handles[i]));
    BAD_HANDLE(rung_shadow_free(handles[i]));
    BAD_HANDLE(rung_trace_write(handles[i]));
    BAD_HANDLE(rung_trace_free(handles[i]));
  }
  BAD_ARGUMENT(rung_image_open(NULL, NULL, &image));
  BAD_ARGUMENT(rung_image_open("file.so", NULL, NULL));
  BAD_ARGUMENT(rung_image_open_memory(-1, NULL, &image));
  REFUSED(rung_image_open_memory(-1, "nothing", &image));
  BAD_ARGUMENT(rung_image_adopt(NULL, NULL, NULL, NULL, &image));
  if (rung_image_close(NULL) != RUNG_OK || rung_instance_free(NULL) != RUNG_OK ||
      rung_replacement_free(NULL) != RUNG_OK || rung_shadow_free(NULL) != RUNG_OK ||
      rung_forces_free(NULL) != RUNG_OK || rung_trace_free(NULL) != RUNG_OK)
    ++wrong;
  if (rung_runtime_version() != (RUNG_RUNTIME_MAJOR << 16 | RUNG_RUNTIME_MINOR)) ++wrong;
  return wrong;
}
