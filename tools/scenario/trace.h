// The forms of a trace: VCD for wave viewers, CSV for tables.
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
  // Once, before the samples.
  virtual void begin(std::string_view program, std::span<const runtime::TracedName> names) = 0;
  // The values of all names at a time that is not before the last one; some of names that are not known now.
  virtual void sample(int64_t us, uint64_t scan, std::span<const runtime::TracedValue> values) = 0;
};

// By the ending of the file's name, .vcd or .csv; null for another one.
std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out);

// A file of the values that names had during a run, sampled after every scan.
//
//   auto trace = Trace::open("out.vcd", defaultTraceNames(session, uses), session.instance(), session.nc());
//   session.addObserver(*trace.value());
//   …
//   if (std::string error = trace.value()->finish(); !error.empty()) …

// "" when a trace can have this name, else which endings there are.
std::string traceFileProblem(std::string_view path);

// The names of all places that rungs read or write at a fixed address: symbols, and addresses that have none. Without
// `uses` (a program that was not compiled here): all its symbols.
std::vector<std::string> defaultTraceNames(const rung_program& program, const ir::Uses* uses);

class Trace final : public Observer {
public:
  // "" when all names are variables of the program or cells of the NC. Quantities of the NC are 0 until they exist.
  static std::string nameProblem(const std::vector<std::string>& names, const runtime::Instance& instance,
                                 const sim::SimulatedNc& nc);
  // Begins the file with the values of now. The names have no problem.
  static Result<std::unique_ptr<Trace>> open(const std::string& path, const std::vector<std::string>& names,
                                             const runtime::Instance& instance, const sim::SimulatedNc& nc);

  void scanned(const Session& session) override { sample(session.instance(), session.nc(), session.scans()); }
  // Names that the new program does not have, or with values of another kind, have none from now on.
  void replaced(const Session& session, const NextProgram& next) override;
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
    ValueKind kind = ValueKind::Int; // as the file has it
  };
  std::vector<Source> sources_;
  // Of the last sample.
  std::vector<std::optional<Reading>> readings_;
  std::vector<runtime::TracedValue> values_;
};

} // namespace rung::scenario
