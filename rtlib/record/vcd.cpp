// Names, times and changes (see vcd.h).
#include "rtlib/record/vcd.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "rtlib/text/controls.h"

namespace rung::runtime {
namespace {

// Short codes of printable characters.
std::string codeOf(size_t index) {
  std::string code;
  do {
    code += static_cast<char>('!' + index % 94);
    index /= 94;
  } while (index != 0);
  return code;
}

// Replaces blanks, which would end the word, and control characters.
std::string word(std::string_view text) {
  std::string out(text);
  std::ranges::replace_if(out, [](char c) { return c == ' ' || text::isControl(c); }, '_');
  return out.empty() ? "_" : out;
}

std::string binary(uint64_t value, uint32_t width) {
  std::string digits;
  for (uint32_t bit = width; bit-- > 0;)
    if (const bool on = (value >> bit & 1) != 0; on || !digits.empty() || bit == 0) digits += on ? '1' : '0';
  return digits;
}

std::string real(double value) {
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.16g", value);
  return {text.data(), static_cast<size_t>(length)};
}

std::string unknown(const TracedName& name, const std::string& code) {
  switch (name.kind) {
  case TracedKind::Real: return "rnan " + code;
  case TracedKind::Text: return "s_ " + code;
  case TracedKind::Integer: break;
  }
  return (name.width == 1 ? "x" : "bx ") + code;
}

std::string change(const TracedName& name, const TracedValue& value, const std::string& code) {
  if (!value.known) return unknown(name, code);
  switch (name.kind) {
  case TracedKind::Real: return 'r' + real(value.real) + ' ' + code;
  case TracedKind::Text: return 's' + word(value.text) + ' ' + code;
  case TracedKind::Integer: break;
  }
  return name.width == 1 ? binary(value.integer, 1) + code : 'b' + binary(value.integer, name.width) + ' ' + code;
}

} // namespace

void VcdWriter::begin(std::string_view program, std::span<const TracedName> names) {
  names_.assign(names.begin(), names.end());
  last_.resize(names.size());
  out_ << "$version rungc $end\n$timescale 1 us $end\n$scope module " << word(program) << " $end\n";
  std::vector<std::string> scopes;
  for (const TracedName& name : names)
    if (std::ranges::find(scopes, name.scope) == scopes.end()) scopes.push_back(name.scope);
  for (const std::string& scope : scopes) writeScope(scope);
  out_ << "$upscope $end\n$enddefinitions $end\n";
}

void VcdWriter::writeScope(const std::string& scope) {
  constexpr std::string_view kTypes[] = {"wire", "real", "string"}; // by TracedKind
  out_ << "$scope module " << word(scope) << " $end\n";
  for (size_t i = 0; i < names_.size(); ++i) {
    const TracedName& name = names_[i];
    if (name.scope != scope) continue;
    const uint32_t width = name.kind == TracedKind::Real ? 64 : name.kind == TracedKind::Text ? 1 : name.width;
    out_ << "$var " << kTypes[static_cast<size_t>(name.kind)] << ' ' << width << ' ' << codeOf(i) << ' '
         << word(name.name) << " $end\n";
  }
  out_ << "$upscope $end\n";
}

void VcdWriter::sample(int64_t us, std::span<const TracedValue> values, uint64_t lost) {
  if (lost != lost_) out_ << "$comment " << lost - lost_ << " scans are missing here $end\n";
  lost_ = lost;
  const bool first = !time_;
  if (first) {
    stamp(us);
    out_ << "$dumpvars\n";
  }
  for (size_t i = 0; i < values.size(); ++i) {
    std::string now = change(names_[i], values[i], codeOf(i));
    if (now == last_[i]) continue;
    stamp(us);
    out_ << now << '\n';
    last_[i] = std::move(now);
  }
  if (first) out_ << "$end\n";
  end_ = us;
}

void VcdWriter::end() {
  if (time_) stamp(end_);
}

void VcdWriter::stamp(int64_t us) {
  if (time_ == us) return;
  time_ = us;
  out_ << '#' << us << '\n';
}

} // namespace rung::runtime
