// Traces (see trace.h).
#include "tools/scenario/trace.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

#include "tools/report/place_names.h"
#include "tools/report/used_places.h"
#include "tools/scenario/names.h"

namespace rung::scenario {

namespace {

bool isQuantity(std::string_view name) { return name.starts_with("NC."); }

// The area of the place; "NC" for what lies in no memory.
const char* areaOf(const rung_program& program, const std::optional<runtime::Ref>& place) {
  return place && place->kind != runtime::RefKind::Constant ? program.spaces[place->space].name : "NC";
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
    if (isQuantity(name)) continue; // some exist only once they have been set
    const Result<Reading> reading = readName(instance, nc, name, false);
    if (!reading.ok()) return reading.error();
  }
  return {};
}

Result<std::unique_ptr<Trace>> Trace::open(const std::string& path, const std::vector<std::string>& names,
                                           const runtime::Instance& instance, const sim::SimulatedNc& nc) {
  const rung_program& program = instance.program();
  std::vector<Source> sources;
  std::vector<TracedName> traced;
  for (const std::string& name : names) {
    NamedValue source(name, instance, nc);
    const Reading reading = source.read(instance, nc).value_or(Reading{});
    traced.push_back({name, areaOf(program, source.place()), reading.kind, reading.width});
    sources.push_back({std::move(source), reading.kind});
  }
  std::unique_ptr<Trace> trace(new Trace(path));
  trace->writer_ = makeTraceWriter(path, trace->out_);
  if (trace->writer_ == nullptr) return failure(traceFileProblem(path));
  if (!trace->out_) return failure(fmt::format("cannot write '{}'", path));
  trace->sources_ = std::move(sources);
  trace->writer_->begin(program.name, traced);
  trace->sample(instance, nc, 0);
  return trace;
}

void Trace::replaced(const Session& session, const NextProgram&) {
  for (Source& source : sources_) source.value.locate(session.instance(), session.nc());
}

void Trace::sample(const runtime::Instance& instance, const sim::SimulatedNc& nc, uint64_t scan) {
  values_.clear();
  for (const Source& source : sources_) {
    std::optional<Reading> value = source.value.read(instance, nc);
    if (value && value->kind != source.kind) value.reset();
    values_.push_back(std::move(value));
  }
  writer_->sample(instance.nowUs(), scan, values_);
}

std::string Trace::finish() {
  writer_.reset();
  out_.close();
  return out_ ? std::string() : fmt::format("cannot write '{}'", path_);
}

} // namespace rung::scenario
