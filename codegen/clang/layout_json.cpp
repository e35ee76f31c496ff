// See layout_json.h.
#include "codegen/clang/layout_json.h"

#include <nlohmann/json.hpp>

namespace rung::codegen {
namespace {

using nlohmann::json;

json jsonOf(const HostMember& m) {
  return {{"name", m.name},
          {"type", m.type},
          {"kind", static_cast<int>(m.kind)},
          {"signed", m.isSigned},
          {"bit", m.bit},
          {"bits", m.bits},
          {"bytes", m.bytes},
          {"lengths", m.lengths},
          {"record", m.record},
          {"why", m.why},
          {"constants", m.constants}};
}

HostMember memberOf(const json& j) {
  return {.name = j.at("name"),
          .type = j.at("type"),
          .kind = static_cast<MemberKind>(j.at("kind").get<int>()),
          .isSigned = j.at("signed"),
          .bit = j.at("bit"),
          .bits = j.at("bits"),
          .bytes = j.at("bytes"),
          .lengths = j.at("lengths"),
          .record = j.at("record"),
          .constants = j.at("constants"),
          .why = j.at("why")};
}

} // namespace

std::string toJson(const HostLayout& layout) {
  json records = json::array();
  for (const HostRecord& record : layout.records) {
    json members = json::array();
    for (const HostMember& member : record.members) members.push_back(jsonOf(member));
    records.push_back({{"union", record.isUnion}, {"members", std::move(members)}});
  }
  json constants = json::array();
  for (const EnumConstant& c : layout.constants) constants.push_back({{"name", c.name}, {"value", c.value}});
  const json all = {{"name", layout.name},
                    {"type", layout.type},
                    {"bytes", layout.bytes},
                    {"records", std::move(records)},
                    {"constants", std::move(constants)}};
  // Names in a header may contain any bytes.
  return all.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

Result<HostLayout> layoutOf(std::string_view text) {
  try {
    const json j = json::parse(text);
    HostLayout layout{
        .name = j.at("name"), .type = j.at("type"), .bytes = j.at("bytes"), .records = {}, .constants = {}};
    for (const json& record : j.at("records")) {
      HostRecord& made = layout.records.emplace_back();
      made.isUnion = record.at("union");
      for (const json& member : record.at("members")) made.members.push_back(memberOf(member));
    }
    for (const json& c : j.at("constants")) layout.constants.push_back({c.at("name"), c.at("value")});
    return layout;
  } catch (const json::exception& error) {
    return failure(error.what());
  }
}

} // namespace rung::codegen
