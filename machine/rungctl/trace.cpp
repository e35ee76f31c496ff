// See trace.h.
#include "machine/rungctl/trace.h"

#include <string_view>

#include "rtlib/text/number.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

runtime::TracedName describe(const std::string& program, const json& name) {
  runtime::TracedName made{.name = name.value("name", ""), .scope = program};
  const std::string type = name.value("type", "bit");
  if (type == "real") made.kind = runtime::TracedKind::Real;
  if (type.starts_with('i')) made.width = text::numberIn<uint32_t>(std::string_view(type).substr(1)).value_or(1);
  return made;
}

runtime::TracedValue valueOf(const json& value) {
  runtime::TracedValue made{.known = !value.is_null()};
  if (value.is_boolean())
    made.integer = value.get<bool>() ? 1 : 0;
  else if (value.is_number_integer())
    made.integer = static_cast<uint64_t>(value.get<int64_t>());
  if (value.is_number()) made.real = value.get<double>();
  if (value.is_string()) made.real = text::numberIn<double>(value.get<std::string>()).value_or(0); // nan, inf
  return made;
}

} // namespace

Trace::Trace(std::ostream& out, const std::string& program, const json& names) : vcd_(out) {
  std::vector<runtime::TracedName> described;
  for (const json& name : names) described.push_back(describe(program, name));
  values_.resize(described.size());
  vcd_.begin(program, described);
}

void Trace::add(const json& event) {
  const json& values = event.at("values");
  for (size_t i = 0; i < values_.size() && i < values.size(); ++i) values_[i] = valueOf(values[i]);
  vcd_.sample(event.value("us", int64_t{0}), values_, event.value("lost", uint64_t{0}));
  ++scans_;
  lastScan_ = event.value("scan", uint64_t{0});
}

} // namespace rung::rungctl
