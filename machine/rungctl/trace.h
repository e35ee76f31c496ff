// The scans of a watch as a value change dump.
#pragma once
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "rtlib/record/vcd.h"

namespace rung::rungctl {

class Trace {
public:
  // `names` is the answer to `watch`. The stream must outlive the trace.
  Trace(std::ostream& out, const std::string& program, const nlohmann::json& names);
  void add(const nlohmann::json& event);
  void end() { vcd_.end(); }
  uint64_t scans() const { return scans_; }
  uint64_t lastScan() const { return lastScan_; } // 0 before the first scan

private:
  runtime::VcdWriter vcd_;
  std::vector<runtime::TracedValue> values_;
  uint64_t scans_ = 0;
  uint64_t lastScan_ = 0;
};

} // namespace rung::rungctl
