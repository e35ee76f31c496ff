// Names of a program: the flags and limits, the symbols of the NC, and the program's declarations. Names are common to
// all modules and files and may be used above their declaration; case is significant.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/dialects/nct/config.h"
#include "frontend/ladder/text/ladder_file.h"
#include "frontend/sema/symbol_table.h"
#include "frontend/syntax/word_lexer.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::nct {

// Operands for checker and lowering: constants, and places in memory that are fixed or computed.

struct Symbol; // symbols.h

inline constexpr uint32_t kNoRegister = UINT32_MAX;

enum class ConstantKind : uint8_t { Decimal, Hex, Real };

// #14, #$AB, *3.5 (man. l.598-668). A hexadecimal constant is a pattern of 32 bits, `integer` its signed value.
struct Constant {
  ConstantKind kind = ConstantKind::Decimal;
  int64_t integer = 0;
  double real = 0;
};

// A word or bit. `word` contains the base and all constant offsets; registers are words whose value is added at run
// time.
struct Address {
  uint32_t word = 0;
  uint32_t bit = 0;
  uint32_t indexRegister = kNoRegister; // added to `word`
  uint32_t bitRegister = kNoRegister;   // contains the bit's number, instead of `bit`
  bool isBit = false;
  bool immediate = false; // `!`: the time-slice memory
  bool oddIndex = false;  // has an odd constant index
  bool isFixed() const { return indexRegister == kNoRegister && bitRegister == kNoRegister; }
};

enum class Form : uint8_t { Bad, Constant, Word, Bit, Text };

struct Operand {
  Form form = Form::Bad;   // Bad: an error has been reported
  bool fromSymbol = false; // written as a name
  char edge = 0;           // '@' or '%' before it
  Constant constant;
  Address address;              // Word and Bit
  const Symbol* base = nullptr; // Word and Bit: the name to which offsets are added; null: it is an address
  const Word* source = nullptr;
};

inline constexpr std::string_view kFlagsName = "FLAGS";
// Bits of FLAGS; the order of the manual's chapter 5 (l.725-777).
inline constexpr std::string_view kFlagNames[] = {"FL_ER", "FL_UF", "FL_OF", "FL_CY", "FL_GT", "FL_EQ", "FL_LT"};

// The signal that a name in the manual means: itself except for some misprints.
std::string_view aliasOf(std::string_view name);

enum class SymbolKind : uint8_t { Bad, Word, Bit, Constant };

struct Symbol {
  uint32_t index = 0; // in Symbols::all, of a name that was found
  std::string_view name;
  SourceRange declared;
  SymbolKind kind = SymbolKind::Bad; // Bad: its declaration was reported, uses are not
  uint32_t word = 0;
  uint32_t bit = 0;
  Constant constant;
  std::string_view comment;
  const nc::Signal* signal = nullptr; // of the NC
  bool isArea = false;                // whether it is the beginning of an area of the NC
  const ladder::Declaration* declaration = nullptr;
  bool pending = false;   // its value has not been read yet
  bool resolving = false; // it is being read: a further use is a cycle
};

struct UndeclaredName : frontend::UndeclaredUse {
  std::string_view whole; // the operand's text if the name is its beginning
};

class Symbols : public frontend::SymbolTable<Symbol, UndeclaredName> {
public:
  Symbols(const Config& config, const SourceManager& sources, Diagnostics& diagnostics);

  // Adds a name; a name that already exists is reported.
  void declare(const ladder::Declaration& declaration);
  // Adds a name whose declaration was reported, unless it exists.
  void declareBad(std::string_view name);
  // Reads the values of all declarations; afterwards `find` returns complete symbols.
  void resolveAll();

  // The meaning of a name at that range of the source, recorded as a use. Null if there is no such name. Symbols of the
  // NC and FLAGS are added on first use: in a program that does not name FLAGS, its bits may be separate bytes
  // (ir/shape). The result stays valid.
  const Symbol* use(std::string_view name, SourceRange range);
  // The same for a text that may be something else: records no use.
  const Symbol* find(std::string_view name);
  // Reports undeclared-symbol. Must be called after all operands have been read.
  void reportUndeclared();
  // Adds all names to the analysis. Must be called last.
  void addTo(frontend::Analysis& analysis) const;

  const Config& config() const { return config_; }
  const SourceManager& sources() const { return sources_; }
  // Whether the word contains an input of the NC.
  bool isInputWord(uint32_t word) const { return word < direction_.size() && direction_[word] == kInput; }
  bool isNcWord(uint32_t word) const { return word >= kFirstNcWord && word < config_.plcNvram; }

private:
  // The index of a name, which is added if it is one of the NC; kNoName if there is no such name.
  uint32_t indexOf(std::string_view name);
  uint32_t enterPredefined(std::string_view name);
  void resolve(Symbol& symbol);
  void resolveConstant(Symbol& symbol);
  void resolveAddress(Symbol& symbol);
  void explain(DiagBuilder& report, std::span<const UndeclaredName> uses);
  // The known name most similar to a misspelt one; empty if none is close.
  text::Likely similarTo(std::string_view name) const;

  static constexpr uint8_t kInput = 1;
  const Config& config_;
  const SourceManager& sources_;
  Diagnostics& diagnostics_;
  std::vector<uint8_t> direction_; // by word of the NC area
  int depth_ = 0;                  // nesting depth of declarations that refer to each other
};

} // namespace rung::frontend::nct
