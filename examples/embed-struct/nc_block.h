/* Data exchanged between a demonstration control and its PLC. */
#ifndef NC_BLOCK_H
#define NC_BLOCK_H

#include <stdbool.h>
#include <stdint.h>

enum nc_mode { NC_MODE_MANUAL, NC_MODE_MDI, NC_MODE_AUTO };

struct nc_axis {
  int32_t position; /* 0.001 mm */
  unsigned enable : 1, fault : 1;
};

typedef struct nc_block {
  uint8_t head; /* incremented before the control writes; `tail` is set to it afterwards */
  struct {
    unsigned start : 1, stop : 1;
    unsigned override : 5; /* of the feed, in steps of 10 % */
  } keys;
  enum nc_mode mode;
  struct nc_axis axis[2];
  uint8_t buttons[2];
  uint8_t lamps[2];
  double feed; /* 1.0 is the programmed feed */
  uint8_t tail;
} nc_block;

#endif
