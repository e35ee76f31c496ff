/* Compiles a PLC program in the process, runs it, and replaces it while it runs. main FILE.lad NEXT.lad */
#include <stdbool.h>
#include <stdio.h>

#include <rung/compiler.h>
#include <rung/runtime.h>

/* Returns null if the program has errors, which are printed. */
static rung_image* compile(const char* name) {
  const rung_source source = {.name = name};
  rung_compilation* compilation = NULL;
  rung_image* image = NULL;
  const int32_t status = rung_compile(&source, 1, NULL, &compilation);
  if (status == RUNG_REFUSED) fputs(rung_compilation_report(compilation), stderr);
  if (status != RUNG_OK && status != RUNG_REFUSED) fprintf(stderr, "%s\n", rung_compiler_error_text());
  if (status == RUNG_OK && rung_compilation_image(compilation, &image) != RUNG_OK)
    fprintf(stderr, "%s\n", rung_compiler_error_text());
  rung_compilation_free(compilation);
  return image;
}

static bool failed(int32_t status) {
  if (status < 0) fprintf(stderr, "%s\n", rung_error_text());
  return status < 0;
}

/* Moves the axis to `position`; returns whether the drive is on then. */
static bool drive_at(rung_instance* plc, int32_t position) {
  rung_cell start, at, enable;
  if (failed(rung_instance_find(plc, "START", RUNG_WRITE, &start)) ||
      failed(rung_instance_find(plc, "D0:4", RUNG_WRITE, &at)) ||
      failed(rung_instance_find(plc, "ENABLE", RUNG_READ, &enable)))
    return false;
  const rung_cell cells[] = {start, at};
  const rung_value values[] = {{.integer = position == 0}, {.integer = position}};
  rung_value on = {0};
  rung_instance_write_all(plc, cells, 2, values);
  for (int i = 0; i < 4; ++i) rung_instance_scan(plc);
  rung_instance_read(plc, enable, 0, 1, &on);
  return on.integer != 0;
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  rung_image *image = compile(argv[1]), *next = compile(argv[2]);
  rung_instance* plc;
  rung_replacement* change;
  if (image == NULL || next == NULL || failed(rung_instance_new(image, NULL, &plc)) ||
      failed(rung_instance_power_on(plc, RUNG_COLD)))
    return 1;
  printf("the drive is on at 0 mm: %d, at 6 mm: %d\n", drive_at(plc, 0), drive_at(plc, 6000));
  if (failed(rung_replacement_new(plc, next, NULL, 0, &change)) || failed(rung_instance_replace(plc, change))) return 1;
  drive_at(plc, 1000);
  printf("the new program, which goes further: %d, at 6 mm: %d\n", drive_at(plc, 0), drive_at(plc, 6000));
  rung_replacement_free(change), rung_instance_free(plc), rung_image_close(next), rung_image_close(image);
  return 0;
}
