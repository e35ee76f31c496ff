// Reads one file of a program: lines to statements (reader.cpp), and includes and macros between them
// (reader_lines.cpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frontend/dialects/technol/read/declare.h"
#include "frontend/dialects/technol/read/macros.h"

namespace rung::frontend::technol {

class FileReader {
public:
  FileReader(ReadContext& context, uint32_t file)
      : c_(context), program_(context.program), file_(file), structure_(context, file),
        structures_(context, structure_, file), declarations_(context, structure_, structures_, file),
        macros_(context, file) {}
  void read();
  // Whether a line is a T_INCLUDE.
  static bool isInclude(std::string_view text);

private:
  void readLines(FileId id, uint32_t depth);
  struct IncludedFile {
    std::string path;
    std::optional<FileId> id = std::nullopt;
    bool again = false;                     // it was included before
    std::vector<std::string> problems = {}; // if it was not found
  };
  bool includes(const SourceLine& line, uint32_t depth);
  void readIncluded(const IncludedFile& file, SourceRange at, uint32_t depth);
  IncludedFile findIncluded(std::string_view name, bool quoted, SourcePos at);
  bool macroLine(uint32_t first, uint32_t count, uint32_t line);
  void useMacro(const Macro& macro, uint32_t first, uint32_t count, uint32_t line);
  void mark(Role role, MacroStack stack, const Token& at, uint32_t line);
  void takeDataLabels();
  void checkEightBits(const Statement& statement);
  static bool endsMacros(const Token& head);
  bool allowedInInclude(const Statement& statement);
  void logicalLine(uint32_t first, uint32_t count, uint32_t line);
  bool beginsStatement(uint32_t first) const;
  bool splitLabel(uint32_t& first, uint32_t& count);
  uint32_t readLabel(uint32_t& first, uint32_t& count);
  bool instance(uint32_t first, uint32_t count, uint32_t line);
  bool foreign(std::span<const Token> tokens);
  const Row* unknown(uint32_t& first, uint32_t& count);
  const Row* instruction(uint32_t& first, uint32_t& count);
  void statement(const Row* row, uint32_t first, uint32_t count, uint32_t line);
  void structural(Statement& statement, uint32_t index);
  void checkNoOperands(const Statement& statement);
  void checkSwitch(const Statement& statement);
  void code(Statement& statement, uint32_t index);
  bool mayStandThere(const Statement& statement) const;
  void checkWait(const Statement& statement);
  void checkLoop(const Statement& statement);
  void attachLabels(Statement& statement, uint32_t index);
  const Token* oneName(const Statement& statement);
  void declareUnit(const Token& name, SymbolKind kind, uint32_t index);

  ReadContext& c_;
  SourceProgram& program_;
  uint32_t file_;
  Structure structure_;
  Structures structures_;
  DeclarationReader declarations_;
  MacroSet macros_;
  std::vector<std::string> expanding_; // macros whose lines are being read
  std::vector<std::string> including_; // paths of the files that are being included
  uint32_t includeDepth_ = 0;
  bool includeReported_ = false;
  std::vector<uint32_t> codeLabels_;    // tokens; labels before a DATA_LOCAL between instructions: wait for its end
  std::vector<uint32_t> pendingLabels_; // tokens; labels of the next statement
  bool badLabel_ = false;               // the statement has a label that is not a valid name
  uint32_t passed_ = 0;                 // number of EX-kind statements and jumps so far
  bool textAfterStop_ = false;
};

} // namespace rung::frontend::technol
