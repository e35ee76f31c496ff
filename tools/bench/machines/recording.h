// What a machine wrote into a PLC program's memory, part by part: recorded once from a scenario with its simulated NC,
// replayed by the bench without one. Places are logical ones (space and byte), so a recording outlives other layouts.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::bench {

// Bytes of a space that the machine wrote before a part.
struct Writes {
  std::string space;
  uint32_t byte = 0;
  std::vector<uint8_t> bytes;
};

// The inputs and the result of one call of the host: a scan, or a slot of a program that runs in slots.
struct Part {
  std::vector<Writes> writes;
  uint64_t hash = 0; // of all spaces after the part, as run by the interpreter
};

struct Recording {
  std::string scenario; // the scenario that was recorded
  std::vector<Part> parts;
};

// As text: a line for the scenario, then a line for each part: its hash, and SPACE:BYTE=HEX for each write. Parts
// without writes whose hash is that of the part before are counted (*N).
std::string textOf(const Recording& recording);
// Throws std::runtime_error that names the wrong line.
Recording recordingOf(const std::string& text);

} // namespace rung::bench
