// A program of iec2c as a peer (generated/peer.h): the sources that it writes, and what its runtime does around a scan.
#include "config.c"
#include "resource1.c"

#define EXPORTED __attribute__((visibility("default")))

TIME __CURRENT_TIME;
static unsigned long tick;

EXPORTED void peer_begin(void) {
  __CURRENT_TIME.tv_sec = 0;
  __CURRENT_TIME.tv_nsec = 0;
  tick = 0;
  config_init__();
}

EXPORTED void peer_scan(int ms) {
  config_run__(tick++);
  __CURRENT_TIME.tv_nsec += ms * 1000000L;
  if (__CURRENT_TIME.tv_nsec >= 1000000000L) {
    __CURRENT_TIME.tv_nsec -= 1000000000L;
    ++__CURRENT_TIME.tv_sec;
  }
}

#define BIT(number) &INSTANCE0.B##number.value,
#define WORD(number) &INSTANCE0.W##number.value,
#define ENTRY(number, index) &INSTANCE0.A##number.value.table[index],
#define REAL(number) &INSTANCE0.R##number.value,
EXPORTED void* peer_places[] = {
#include "places.inc"
};
