// VCD and CSV (see trace_writers.h).
#include "tools/scenario/trace_writers.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ostream.h>

namespace rung::scenario {
namespace {

// ---- VCD (IEEE 1364, clause 18)
// --------------------------------------------------------------------------------------

// Short codes of printable characters.
std::string codeOf(size_t index) {
  std::string code;
  do {
    code += static_cast<char>('!' + index % 94);
    index /= 94;
  } while (index != 0);
  return code;
}

// Without blanks, which end a word.
std::string word(std::string_view text) {
  std::string out(text);
  std::ranges::replace_if(out, [](char c) { return c <= ' ' || c == 127; }, '_');
  return out.empty() ? "_" : out;
}

std::string binary(uint64_t value, uint32_t width) {
  return width < 64 ? fmt::format("{:b}", value & ((1ull << width) - 1)) : fmt::format("{:b}", value);
}

std::string vcdChange(const TracedName& name, const Reading& value, const std::string& code) {
  switch (name.kind) {
  case ValueKind::Real: return fmt::format("r{:.16g} {}", value.real, code);
  case ValueKind::Text: return fmt::format("s{} {}", word(value.text), code);
  case ValueKind::Int: break;
  }
  return name.width == 1 ? fmt::format("{}{}", value.integer & 1, code)
                         : fmt::format("b{} {}", binary(value.integer, name.width), code);
}

class VcdWriter final : public TraceWriter {
public:
  explicit VcdWriter(std::ostream& out) : out_(out) {}

  void begin(std::string_view program, std::span<const TracedName> names) override {
    names_.assign(names.begin(), names.end());
    last_.resize(names.size());
    fmt::print(out_, "$version rungc $end\n$timescale 1 us $end\n$scope module {} $end\n", word(program));
    std::vector<std::string> scopes;
    for (const TracedName& name : names)
      if (std::ranges::find(scopes, name.scope) == scopes.end()) scopes.push_back(name.scope);
    for (const std::string& scope : scopes) writeScope(scope);
    fmt::print(out_, "$upscope $end\n$enddefinitions $end\n");
  }

  void sample(int64_t us, uint64_t, std::span<const Reading> values) override {
    const bool first = !time_;
    if (first) {
      stamp(us);
      out_ << "$dumpvars\n";
    }
    for (size_t i = 0; i < values.size(); ++i) {
      std::string change = vcdChange(names_[i], values[i], codeOf(i));
      if (change == last_[i]) continue;
      stamp(us);
      out_ << change << '\n';
      last_[i] = std::move(change);
    }
    if (first) out_ << "$end\n";
    end_ = us;
  }

  // The last scan ends the picture, even if nothing has changed in it.
  ~VcdWriter() override {
    if (time_) stamp(end_);
  }

private:
  void writeScope(const std::string& scope) {
    fmt::print(out_, "$scope module {} $end\n", word(scope));
    for (size_t i = 0; i < names_.size(); ++i) {
      const TracedName& name = names_[i];
      if (name.scope != scope) continue;
      constexpr std::string_view kTypes[] = {"wire", "real", "string"}; // by ValueKind; "string" is GTKWave's
      const uint32_t width = name.kind == ValueKind::Real ? 64 : name.kind == ValueKind::Text ? 1 : name.width;
      fmt::print(out_, "$var {} {} {} {} $end\n", kTypes[static_cast<size_t>(name.kind)], width, codeOf(i),
                 word(name.name));
    }
    fmt::print(out_, "$upscope $end\n");
  }
  void stamp(int64_t us) {
    if (time_ == us) return;
    time_ = us;
    fmt::print(out_, "#{}\n", us);
  }

  std::ostream& out_;
  std::vector<TracedName> names_;
  std::vector<std::string> last_;
  std::optional<int64_t> time_;
  int64_t end_ = 0;
};

// ---- CSV (RFC 4180)
// --------------------------------------------------------------------------------------------------

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

  void sample(int64_t us, uint64_t scan, std::span<const Reading> values) override {
    fmt::print(out_, "{:.6f},{}", static_cast<double>(us) / 1e6, scan);
    for (size_t i = 0; i < values.size(); ++i) out_ << ',' << csvValue(names_[i], values[i]);
    out_ << '\n';
  }

private:
  std::ostream& out_;
  std::vector<TracedName> names_;
};

} // namespace

std::unique_ptr<TraceWriter> makeTraceWriter(std::string_view path, std::ostream& out) {
  if (path.ends_with(".vcd")) return std::make_unique<VcdWriter>(out);
  if (path.ends_with(".csv")) return std::make_unique<CsvWriter>(out);
  return nullptr;
}

} // namespace rung::scenario
