// A program of STruC++ as a peer (generated/peer.h): includes the sources that STruC++ generates, and does what its
// runtime does around a scan.
#include <new>

#include "program.cpp"

#define EXPORTED extern "C" __attribute__((visibility("default")))

static strucpp::Configuration_CONFIG configuration;

EXPORTED void peer_begin() {
  configuration.~Configuration_CONFIG();
  new (&configuration) strucpp::Configuration_CONFIG;
  strucpp::__CURRENT_TIME_NS = 0;
}

EXPORTED void peer_scan(int ms) {
  configuration.INSTANCE0.run();
  strucpp::__CURRENT_TIME_NS += ms * 1000000LL;
}

#define BIT(number) configuration.INSTANCE0.B##number.raw_ptr(),
#define WORD(number) configuration.INSTANCE0.W##number.raw_ptr(),
#define ENTRY(number, index) configuration.INSTANCE0.A##number[index].raw_ptr(),
#define REAL(number) configuration.INSTANCE0.R##number.raw_ptr(),
EXPORTED void* peer_places[];
void* peer_places[] = {
#include "places.inc"
};
