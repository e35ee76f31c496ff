// What the last word of a line at the prompt can become.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/scenario/session.h"

namespace rung::scenario {

// What a word of a statement or command names.
enum class Names : uint8_t { None, Values, Services, Statements, Files, PlcCommands, BlockCommands };

class Completion {
public:
  // `statements`: the words of all statements and commands. The session outlives this and has started.
  Completion(const Session& session, std::vector<std::string> statements)
      : session_(session), statements_(std::move(statements)) {}

  // Sorted; case does not matter. Those that the word begins, or nothing.
  std::vector<std::string> of(Names names, std::string_view word);

private:
  const std::vector<std::string>& values();

  const Session& session_;
  std::vector<std::string> statements_;
  std::vector<std::string> values_; // looked up when they are asked for first
  uint32_t generation_ = 0;         // of the instance, then
};

// The first part that all of them share.
std::string commonStart(const std::vector<std::string>& words);

} // namespace rung::scenario
