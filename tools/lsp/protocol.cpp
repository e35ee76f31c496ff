// See protocol.h.
#include "tools/lsp/protocol.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

uint32_t countFrom(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_integer() || found->get<int64_t>() < 0)
    throw RequestError(ErrorCode::InvalidParams, std::string(key) + " must be a number from 0");
  return static_cast<uint32_t>(std::min<int64_t>(found->get<int64_t>(), std::numeric_limits<int32_t>::max()));
}

} // namespace

json toJson(const Position& position) { return {{"line", position.line}, {"character", position.character}}; }
json toJson(const Range& range) { return {{"start", toJson(range.begin)}, {"end", toJson(range.end)}}; }

json locationOf(const SourceManager& sources, SourceRange range, Unit unit) {
  return {{"uri", uriOf(pathOf(sources, sources.fileOf(range.begin)))},
          {"range", toJson(rangeOf(sources, range, unit))}};
}

const json& memberOf(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    throw RequestError(ErrorCode::InvalidParams, std::string(key) + " is missing");
  return object.at(key);
}

Position positionFrom(const json& value) {
  if (!value.is_object()) throw RequestError(ErrorCode::InvalidParams, "a position must be an object");
  return {countFrom(value, "line"), countFrom(value, "character")};
}

Range rangeFrom(const json& value) {
  return {positionFrom(memberOf(value, "start")), positionFrom(memberOf(value, "end"))};
}

} // namespace rung::lsp
