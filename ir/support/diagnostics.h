// Diagnostics: errors and warnings about a program. Every code is one entry of ir/support/diag/*.def with its severity,
// its message and its explanation; a report has the code, a range and the arguments of the message:
//   diags.report(diag::DuplicateSymbol, range) << name;
//   diags.report(diag::DuplicateSymbol, range).note(first, "first declared here") << name;
// Code that reports includes the header of the code's family, ir/support/diag/*.h: a new entry recompiles only those
// files. A report is complete at the end of its full expression. The same code at the same position with the same
// arguments is stored once. Codes are stable names: scenarios and users refer to them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <variant>
#include <vector>

#include "ir/support/source.h"

namespace rung {

enum class Severity : uint8_t { Warning, Error };

/// A code: its family in the upper byte, its line in the family's file in the lower one.
enum class Diag : uint16_t {};

namespace diag {
/// In the order of allDiags().
enum class Family : uint8_t { Source, Project, Ladder, Operand, Structure, Pmc, Nct, Technol };
constexpr Diag codeOf(Family family, uint8_t line) {
  return static_cast<Diag>(static_cast<unsigned>(family) << 8 | line);
}
} // namespace diag

struct DiagInfo {
  Diag id;
  std::string_view code;
  Severity severity;
  std::string_view message;     ///< fmt pattern with positional placeholders {0}, {1}, …
  std::string_view explanation; ///< what it means and how to fix it
};

const DiagInfo& diagInfo(Diag id);
/// The entry of a code such as "unbalanced-stack", or nullptr.
const DiagInfo* findDiag(std::string_view code);
/// All entries, family by family.
std::span<const DiagInfo> allDiags();

using DiagArg = std::variant<int64_t, std::string>;

/// Another position that explains the error. A note follows the message; a label marks a part of the source with a few
/// words. The range of a note may be invalid: a remark without a position.
struct DiagNote {
  SourceRange range;
  std::string text;
};

/// A change that fixes the error: the characters of range become replacement.
struct DiagFix {
  SourceRange range;
  std::string replacement;
  bool noted = false; ///< a note describes it for the user
};

struct Diagnostic {
  Diag id{};
  Severity severity = Severity::Error; ///< as reported: after strict mode has been applied
  SourceRange range;                   ///< invalid if there is no position
  std::vector<DiagArg> args;
  std::vector<DiagNote> labels;
  std::vector<DiagNote> notes;
  std::vector<DiagFix> fixes;
};

/// The message with its arguments. A missing argument is printed as "?", a surplus one is ignored.
std::string messageOf(const Diagnostic& diagnostic);

class Diagnostics;

/// Collects the parts of one report and adds it to its Diagnostics when it is destroyed.
class DiagBuilder {
public:
  DiagBuilder(Diagnostics& sink, Diag id, SourceRange range);
  ~DiagBuilder();
  DiagBuilder(const DiagBuilder&) = delete;
  DiagBuilder& operator=(const DiagBuilder&) = delete;

  DiagBuilder& operator<<(std::string_view arg);
  DiagBuilder& operator<<(const char* arg) { return *this << std::string_view(arg); }
  DiagBuilder& operator<<(char arg) { return *this << std::string_view(&arg, 1); }
  template <typename T>
    requires(std::is_integral_v<T>)
  DiagBuilder& operator<<(T arg) {
    return number(static_cast<int64_t>(arg));
  }

  DiagBuilder& label(SourceRange range, std::string_view text);
  DiagBuilder& note(SourceRange range, std::string_view text);
  DiagBuilder& note(std::string_view text) { return note(SourceRange{}, text); }
  DiagBuilder& fix(SourceRange range, std::string_view replacement);
  /// Adds "did you mean WORD?" and, if the range is valid, the fix that inserts it. Does nothing for an empty word.
  DiagBuilder& meant(SourceRange range, std::string_view word);
  /// For a code that is an error in one dialect and a warning in another. Strict mode still applies.
  DiagBuilder& severity(Severity severity);

private:
  DiagBuilder& number(int64_t arg);

  Diagnostics& sink_;
  Diagnostic diagnostic_;
};

class Diagnostics {
public:
  /// Of each severity at most this many are stored; all are counted. Limits the memory that a file of garbage takes.
  static constexpr size_t kDefaultLimit = 1000;

  DiagBuilder report(Diag id, SourceRange range) { return DiagBuilder(*this, id, range); }
  DiagBuilder report(Diag id) { return DiagBuilder(*this, id, SourceRange{}); }
  void add(Diagnostic diagnostic);

  void setErrorLimit(size_t limit) { limit_ = limit; }
  /// Strict mode: from now on these warnings count as errors.
  void raiseToError(std::initializer_list<Diag> ids);

  bool hasErrors() const { return errors_ != 0; }
  size_t errorCount() const { return errors_; }
  size_t warningCount() const { return warnings_; }
  /// How many were counted but not stored.
  size_t droppedCount() const { return dropped_; }
  bool has(Diag id) const;
  /// False after many errors: suggestions are not read then, and computing them takes long for a file of garbage.
  bool suggests() const { return errors_ <= 100; }

  /// In the order of reporting.
  const std::vector<Diagnostic>& reported() const { return kept_; }
  /// By position (files in the order in which they were added), otherwise in the order of reporting.
  std::vector<const Diagnostic*> sorted() const;

private:
  bool isNew(const Diagnostic& diagnostic);

  std::vector<Diagnostic> kept_;
  std::unordered_set<uint64_t> seen_;
  std::vector<Diag> raised_;
  size_t limit_ = kDefaultLimit;
  size_t errors_ = 0;
  size_t warnings_ = 0;
  size_t keptErrors_ = 0;
  size_t keptWarnings_ = 0;
  size_t dropped_ = 0;
};

} // namespace rung
