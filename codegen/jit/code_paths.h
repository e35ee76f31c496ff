// Machine code as a graph, and its longest path. Free of LLVM.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rung::codegen {

inline constexpr uint32_t kNoLoop = UINT32_MAX;

// Instructions that are always run together.
struct CodeBlock {
  uint64_t instructions = 0;
  std::vector<std::string> calls{}; // of functions of the same code
  std::vector<uint32_t> next{};
  uint32_t loop = kNoLoop; // the innermost one that it is in
};

struct CodeLoop {
  uint32_t header = 0;       // the only block where it is entered
  uint32_t parent = kNoLoop; // comes before it in the list
  uint64_t rounds = 0;       // in which the header runs, at most, each time that the loop is entered
};

struct FunctionCode {
  std::vector<CodeBlock> blocks{}; // it begins with the first
  std::vector<CodeLoop> loops{};
  std::string unknown{}; // not empty: why its length is not known
};

struct CodeLength {
  uint64_t instructions = 0; // UINT64_MAX: at least that
  std::string unknown{};
};

// By name. Each is measured once.
class CodeLengths {
public:
  explicit CodeLengths(std::map<std::string, FunctionCode> functions) : functions_(std::move(functions)) {}
  // Of the longest path through a function.
  const CodeLength& of(const std::string& function);

private:
  std::map<std::string, FunctionCode> functions_;
  std::map<std::string, CodeLength> known_;
};

} // namespace rung::codegen
