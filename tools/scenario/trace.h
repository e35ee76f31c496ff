// Output formats of a trace: VCD for wave viewers, CSV for tables.
#pragma once
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "ir/analysis/uses.h"
#include "ir/support/result.h"
#include "rtlib/record/vcd.h"
#include "tools/scenario/names.h"
#include "tools/scenario/session.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

class TraceWriter {
public:
  virtual ~TraceWriter() = default;
  // Called once, before the samples.
  virtual void begin(std::string_view program, std::span<const runtime::TracedName> names) = 0;
  // The values of all names at a time that is not before the last one; names that are not known now have no value.
  virtual void sample(int64_t us, uint64_t scan, std::span<const runtime::TracedValue> values) = 0;
};

// Chosen by the ending of the file's name, .vcd or .csv; null for any other.
std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out);

// A file with the values of names during a run, sampled after every scan.
//
//   auto trace = Trace::open("out.vcd", defaultTraceNames(session, uses), session.instance(), session.nc());
//   session.addObserver(*trace.value());
//   …
//   if (std::string error = trace.value()->finish(); !error.empty()) …

// "" if a trace can have this file name, otherwise the possible endings.
std::string traceFileProblem(std::string_view path);

// The names of all places that rungs read or write at a fixed address: symbols, and addresses without a symbol. Without
// `uses` (the program was not compiled in this process): all symbols of the program.
std::vector<std::string> defaultTraceNames(const rung_program& program, const ir::Uses* uses);

class Trace final : public Observer {
public:
  // "" if all names are variables of the program or cells of the NC. Quantities of the NC are 0 until they exist.
  static std::string nameProblem(const std::vector<std::string>& names, const runtime::Instance& instance,
                                 const sim::SimulatedNc& nc);
  // Begins the file with the current values. nameProblem() must have returned "" for the names.
  static Result<std::unique_ptr<Trace>> open(const std::string& path, const std::vector<std::string>& names,
                                             const runtime::Instance& instance, const sim::SimulatedNc& nc,
                                             uint64_t scan = 0);

  void scanned(const Session& session) override { sample(session.instance(), session.nc(), session.scans()); }
  // Names that the new program does not have, or has with another kind of value, have no values from now on.
  void replaced(const Session& session, const NextProgram&) override { relocate(session.instance(), session.nc()); }
  void relocate(const runtime::Instance& instance, const sim::SimulatedNc& nc);
  // Times continue in the file.
  void restored(const Session& session) override { clockSet(session.nowUs()); }
  void clockSet(int64_t us) { restoredUs_ = sampledUs_ - us; }
  void sample(const runtime::Instance& instance, const sim::SimulatedNc& nc, uint64_t scan);
  // Ends the file; "" or why it could not be written.
  std::string finish();

private:
  explicit Trace(std::string path) : path_(std::move(path)), out_(path_, std::ios::binary) {}

  std::string path_;
  std::ofstream out_;
  std::unique_ptr<TraceWriter> writer_;
  struct Source {
    NamedValue value;
    ValueKind kind = ValueKind::Int; // kind in the file
  };
  std::vector<Source> sources_;
  int64_t sampledUs_ = 0;  // the last time in the file
  int64_t restoredUs_ = 0; // by which the program's clock has gone back
  // Of the last sample, by name.
  std::vector<std::optional<Reading>> readings_;
  std::vector<runtime::TracedValue> values_;
};

} // namespace rung::scenario
