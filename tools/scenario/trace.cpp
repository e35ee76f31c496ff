// Writes traces (see trace.h).
#include "tools/scenario/trace.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <sstream>

#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/scenario/names.h"

namespace rung::scenario {

namespace {

bool isQuantity(std::string_view name) { return name.starts_with("NC."); }

// The area of the place; "NC" for a value that is not in memory.
const char* areaOf(const rung_program& program, const std::optional<runtime::Ref>& place) {
  return place && place->kind != runtime::RefKind::Constant ? program.spaces[place->space].name : "NC";
}

runtime::TracedKind kindOf(ValueKind kind) {
  switch (kind) {
  case ValueKind::Int: return runtime::TracedKind::Integer;
  case ValueKind::Real: return runtime::TracedKind::Real;
  case ValueKind::Text: break;
  }
  return runtime::TracedKind::Text;
}

// Bits and bytes are unsigned, wider integers signed.
runtime::TracedValue tracedOf(const Reading& value) {
  const bool isSigned = value.kind == ValueKind::Int && value.width > 8;
  return {.known = true,
          .integer = isSigned ? static_cast<uint64_t>(signedOf(value)) : value.integer,
          .real = value.real,
          .text = value.text};
}

} // namespace

std::string traceFileProblem(std::string_view path) {
  std::ostringstream nowhere;
  if (makeTraceWriter(path, nowhere) != nullptr) return {};
  return fmt::format("'{}' cannot be a trace: its name must end in .vcd or .csv", path);
}

std::vector<std::string> defaultTraceNames(const rung_program& program, const ir::Uses* uses) {
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  };
  if (uses != nullptr) {
    for (const report::UsedPlace& place : report::usedPlaces(program, *uses))
      add(report::writtenName(program, report::refOf(place.use)));
    return names;
  }
  for (uint32_t i = 0; i < program.symbol_count; ++i)
    if ((program.symbols[i].flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) == 0) add(program.symbols[i].name);
  return names;
}

std::string Trace::nameProblem(const std::vector<std::string>& names, const runtime::Instance& instance,
                               const sim::SimulatedNc& nc) {
  for (const std::string& name : names) {
    if (isQuantity(name)) continue; // some quantities exist only once they have been set
    const Result<Reading> reading = readName(instance, nc, name, false);
    if (!reading.ok()) return reading.error();
  }
  return {};
}

Result<std::unique_ptr<Trace>> Trace::open(const std::string& path, const std::vector<std::string>& names,
                                           const runtime::Instance& instance, const sim::SimulatedNc& nc,
                                           uint64_t scan) {
  const rung_program& program = instance.program();
  std::vector<Source> sources;
  std::vector<runtime::TracedName> traced;
  for (const std::string& name : names) {
    NamedValue source(name, instance, nc);
    const Reading reading = source.read(instance, nc).value_or(Reading{});
    traced.push_back({name, areaOf(program, source.place()), kindOf(reading.kind), reading.width});
    sources.push_back({std::move(source), reading.kind});
  }
  std::unique_ptr<Trace> trace(new Trace(path));
  trace->writer_ = makeTraceWriter(path, trace->out_);
  if (trace->writer_ == nullptr) return failure(traceFileProblem(path));
  if (!trace->out_) return failure(fmt::format("cannot write '{}'", path));
  trace->sources_ = std::move(sources);
  trace->writer_->begin(program.name, traced);
  trace->sample(instance, nc, scan);
  return trace;
}

void Trace::relocate(const runtime::Instance& instance, const sim::SimulatedNc& nc) {
  for (Source& source : sources_) source.value.locate(instance, nc);
}

void Trace::sample(const runtime::Instance& instance, const sim::SimulatedNc& nc, uint64_t scan) {
  readings_.clear();
  readings_.reserve(sources_.size()); // must not be reallocated: `values_` refers to its texts
  values_.clear();
  for (const Source& source : sources_) {
    const std::optional<Reading>& value = readings_.emplace_back(source.value.read(instance, nc));
    values_.push_back(value && value->kind == source.kind ? tracedOf(*value) : runtime::TracedValue{});
  }
  sampledUs_ = instance.nowUs() + restoredUs_;
  writer_->sample(sampledUs_, scan, values_);
}

std::string Trace::finish() {
  writer_.reset();
  out_.close();
  return out_ ? std::string() : fmt::format("cannot write '{}'", path_);
}

// VCD and CSV.

namespace {

// ---- VCD ---------------------------------------------------------------------------------------------------------

class VcdTrace final : public TraceWriter {
public:
  explicit VcdTrace(std::ostream& out) : vcd_(out) {}
  ~VcdTrace() override { vcd_.end(); }

  void begin(std::string_view program, std::span<const runtime::TracedName> names) override {
    vcd_.begin(program, names);
  }
  void sample(int64_t us, uint64_t, std::span<const runtime::TracedValue> values) override { vcd_.sample(us, values); }

private:
  runtime::VcdWriter vcd_;
};

// ---- CSV (RFC 4180) ----------------------------------------------------------------------------------------------

std::string field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string csvValue(runtime::TracedKind kind, const runtime::TracedValue& value) {
  switch (kind) {
  case runtime::TracedKind::Real: return fmt::format("{}", value.real);
  case runtime::TracedKind::Text: return field(value.text);
  case runtime::TracedKind::Integer: break;
  }
  return fmt::format("{}", static_cast<int64_t>(value.integer));
}

class CsvWriter final : public TraceWriter {
public:
  explicit CsvWriter(std::ostream& out) : out_(out) {}

  void begin(std::string_view, std::span<const runtime::TracedName> names) override {
    out_ << "time_s,scan";
    for (const runtime::TracedName& name : names) {
      kinds_.push_back(name.kind);
      out_ << ',' << field(name.name);
    }
    out_ << '\n';
  }

  void sample(int64_t us, uint64_t scan, std::span<const runtime::TracedValue> values) override {
    fmt::print(out_, "{:.6f},{}", static_cast<double>(us) / 1e6, scan);
    for (size_t i = 0; i < values.size(); ++i) {
      out_ << ',';
      if (values[i].known) out_ << csvValue(kinds_[i], values[i]);
    }
    out_ << '\n';
  }

private:
  std::ostream& out_;
  std::vector<runtime::TracedKind> kinds_;
};

} // namespace

std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out) {
  if (path.ends_with(".vcd")) return std::make_unique<VcdTrace>(out);
  if (path.ends_with(".csv")) return std::make_unique<CsvWriter>(out);
  return nullptr;
}

} // namespace rung::scenario
