// The forms of a trace: VCD for wave viewers, CSV for tables.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "tools/scenario/values.h"

namespace rung::scenario {

struct TracedName {
  std::string name;
  std::string scope; // the area of the program, or "NC"
  ValueKind kind = ValueKind::Int;
  uint32_t width = 1; // of an integer, in bits
};

class TraceWriter {
public:
  virtual ~TraceWriter() = default;
  // Once, before the samples.
  virtual void begin(std::string_view program, std::span<const TracedName> names) = 0;
  // The values of all names at a time that is not before the last one; nothing for a name that is not there now.
  virtual void sample(int64_t us, uint64_t scan, std::span<const std::optional<Reading>> values) = 0;
};

// By the ending of the file's name, .vcd or .csv; null for another one.
std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out);

} // namespace rung::scenario
