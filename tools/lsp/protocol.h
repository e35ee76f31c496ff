// Values of the protocol as JSON.
#pragma once
#include <optional>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/lsp/position.h"

namespace rung::lsp {

using nlohmann::json;

// Codes of JSON-RPC and of the protocol.
enum class ErrorCode : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  NotInitialized = -32002,
  Cancelled = -32800,
  RequestFailed = -32803,
};

// The answer to a request that cannot be served; the text is for the user.
class RequestError : public std::runtime_error {
public:
  RequestError(ErrorCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ErrorCode code() const { return code_; }

private:
  ErrorCode code_;
};

json toJson(const Position& position);
json toJson(const Range& range);
// The file of the range, and where in it.
json locationOf(const SourceManager& sources, SourceRange range, Unit unit);
// Throw RequestError for another value.
const json& memberOf(const json& object, const char* key);
Position positionFrom(const json& value);
Range rangeFrom(const json& value);

} // namespace rung::lsp
