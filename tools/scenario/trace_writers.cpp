// VCD and CSV (see trace_writers.h).
#include "tools/scenario/trace_writers.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "rtlib/record/vcd.h"

namespace rung::scenario {
namespace {

// ---- VCD ---------------------------------------------------------------------------------------------------------

static_assert(static_cast<int>(ValueKind::Int) == static_cast<int>(runtime::VcdKind::Integer) &&
              static_cast<int>(ValueKind::Real) == static_cast<int>(runtime::VcdKind::Real) &&
              static_cast<int>(ValueKind::Text) == static_cast<int>(runtime::VcdKind::Text));

class VcdTrace final : public TraceWriter {
public:
  explicit VcdTrace(std::ostream& out) : vcd_(out) {}
  ~VcdTrace() override { vcd_.end(); }

  void begin(std::string_view program, std::span<const TracedName> names) override {
    std::vector<runtime::VcdName> shown;
    for (const TracedName& name : names)
      shown.push_back({name.name, name.scope, static_cast<runtime::VcdKind>(name.kind), name.width});
    vcd_.begin(program, shown);
  }
  void sample(int64_t us, uint64_t, std::span<const std::optional<Reading>> values) override {
    shown_.clear();
    for (const std::optional<Reading>& value : values)
      shown_.push_back(value ? runtime::VcdValue{true, value->integer, value->real, value->text} : runtime::VcdValue{});
    vcd_.sample(us, shown_);
  }

private:
  runtime::VcdWriter vcd_;
  std::vector<runtime::VcdValue> shown_;
};

// ---- CSV (RFC 4180) ----------------------------------------------------------------------------------------------

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

// Bits and bytes without a sign, wider integers with one.
std::string csvValue(const TracedName& name, const Reading& value) {
  switch (name.kind) {
  case ValueKind::Real: return fmt::format("{}", value.real);
  case ValueKind::Text: return field(value.text);
  case ValueKind::Int: break;
  }
  return name.width <= 8 ? fmt::format("{}", value.integer) : fmt::format("{}", signedOf(value));
}

class CsvWriter final : public TraceWriter {
public:
  explicit CsvWriter(std::ostream& out) : out_(out) {}

  void begin(std::string_view, std::span<const TracedName> names) override {
    names_.assign(names.begin(), names.end());
    out_ << "time_s,scan";
    for (const TracedName& name : names) out_ << ',' << field(name.name);
    out_ << '\n';
  }

  void sample(int64_t us, uint64_t scan, std::span<const std::optional<Reading>> values) override {
    fmt::print(out_, "{:.6f},{}", static_cast<double>(us) / 1e6, scan);
    for (size_t i = 0; i < values.size(); ++i) {
      out_ << ',';
      if (const std::optional<Reading>& value = values[i]) out_ << csvValue(names_[i], *value);
    }
    out_ << '\n';
  }

private:
  std::ostream& out_;
  std::vector<TracedName> names_;
};

} // namespace

std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out) {
  if (path.ends_with(".vcd")) return std::make_unique<VcdTrace>(out);
  if (path.ends_with(".csv")) return std::make_unique<CsvWriter>(out);
  return nullptr;
}

} // namespace rung::scenario
