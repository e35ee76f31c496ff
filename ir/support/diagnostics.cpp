// The table of codes, the collection of reports, and the formatting of messages.
#include "ir/support/diagnostics.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <unordered_map>

#include <fmt/args.h>
#include <fmt/format.h>

#include "ir/support/check.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/project.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/structure.h"
#include "ir/support/diag/technol.h"
#include "ir/support/put.h"
#include "rtlib/text/utf8.h"

namespace rung {
namespace {

constexpr DiagInfo kDiags[] = {
#define DIAG(name, code, severity, message, explanation) {diag::name, code, Severity::severity, message, explanation},
#include "ir/support/diag/all.def"
#undef DIAG
};

/// The index of the first entry of each family.
constexpr auto kFirstOfFamily = [] {
  std::array<size_t, 256> first{};
  for (size_t i = std::size(kDiags); i-- > 0;) first[static_cast<unsigned>(kDiags[i].id) >> 8] = i;
  return first;
}();

/// No message has more placeholders.
constexpr size_t kMaxArgs = 8;
/// Longer arguments are truncated: a word in a file of garbage may have megabytes.
constexpr size_t kMaxArgLength = 200;

std::string shorten(std::string_view argument) {
  if (argument.size() <= kMaxArgLength) return std::string(argument);
  return std::string(text::wholeCharacters(argument, kMaxArgLength)) + "...";
}

std::unordered_map<std::string_view, const DiagInfo*> makeCodeIndex() {
  std::unordered_map<std::string_view, const DiagInfo*> index;
  for (const DiagInfo& info : kDiags) index.emplace(info.code, &info);
  return index;
}

} // namespace

const DiagInfo& diagInfo(Diag id) {
  const size_t index = kFirstOfFamily[static_cast<unsigned>(id) >> 8] + (static_cast<unsigned>(id) & 0xFF);
  RUNG_CHECK(index < std::size(kDiags) && kDiags[index].id == id, "no such diagnostic");
  return kDiags[index];
}

const DiagInfo* findDiag(std::string_view code) {
  static const auto index = makeCodeIndex();
  const auto found = index.find(code);
  return found == index.end() ? nullptr : found->second;
}

std::span<const DiagInfo> allDiags() { return kDiags; }

std::string messageOf(const Diagnostic& diagnostic) {
  fmt::dynamic_format_arg_store<fmt::format_context> store;
  for (const DiagArg& arg : diagnostic.args) std::visit([&store](const auto& value) { store.push_back(value); }, arg);
  for (size_t i = diagnostic.args.size(); i < kMaxArgs; ++i) store.push_back("?");
  const std::string_view pattern = diagInfo(diagnostic.id).message;
  // An invalid pattern is a defect of a .def file; the user still gets its text.
  try {
    return fmt::vformat(pattern, store);
  } catch (const fmt::format_error&) {
    return std::string(pattern);
  }
}

DiagBuilder::DiagBuilder(Diagnostics& sink, Diag id, SourceRange range) : sink_(sink) {
  diagnostic_.id = id;
  diagnostic_.severity = diagInfo(id).severity;
  diagnostic_.range = range;
}

DiagBuilder::~DiagBuilder() { sink_.add(std::move(diagnostic_)); }

DiagBuilder& DiagBuilder::operator<<(std::string_view arg) {
  diagnostic_.args.emplace_back(shorten(arg));
  return *this;
}

DiagBuilder& DiagBuilder::number(int64_t arg) {
  diagnostic_.args.emplace_back(arg);
  return *this;
}

DiagBuilder& DiagBuilder::label(SourceRange range, std::string_view text) {
  diagnostic_.labels.push_back({range, std::string(text)});
  return *this;
}

DiagBuilder& DiagBuilder::note(SourceRange range, std::string_view text) {
  diagnostic_.notes.push_back({range, std::string(text)});
  return *this;
}

DiagBuilder& DiagBuilder::fix(SourceRange range, std::string_view replacement) {
  diagnostic_.fixes.push_back({.range = range, .replacement = std::string(replacement)});
  return *this;
}

DiagBuilder& DiagBuilder::meant(SourceRange range, std::string_view word) {
  if (word.empty()) return *this;
  note("did you mean " + std::string(word) + "?");
  if (range.valid()) diagnostic_.fixes.push_back({.range = range, .replacement = std::string(word), .noted = true});
  return *this;
}

DiagBuilder& DiagBuilder::severity(Severity severity) {
  diagnostic_.severity = severity;
  return *this;
}

bool Diagnostics::isNew(const Diagnostic& diagnostic) {
  std::string key = fmt::format("{} {}", static_cast<unsigned>(diagnostic.id), diagnostic.range.begin.value);
  for (const DiagArg& arg : diagnostic.args) {
    std::visit([&key](const auto& value) { put(key, "\n{}", value); }, arg);
  }
  return seen_.insert(std::hash<std::string>()(key)).second;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (std::ranges::find(raised_, diagnostic.id) != raised_.end()) diagnostic.severity = Severity::Error;
  const bool isError = diagnostic.severity == Severity::Error;
  size_t& kept = isError ? keptErrors_ : keptWarnings_;
  if (kept < limit_ && !isNew(diagnostic)) return;
  ++(isError ? errors_ : warnings_);
  if (kept >= limit_) {
    ++dropped_;
    return;
  }
  ++kept;
  kept_.push_back(std::move(diagnostic));
}

void Diagnostics::raiseToError(std::initializer_list<Diag> ids) {
  raised_.insert(raised_.end(), ids.begin(), ids.end());
}

bool Diagnostics::has(Diag id) const {
  return std::any_of(kept_.begin(), kept_.end(), [id](const Diagnostic& d) { return d.id == id; });
}

std::vector<const Diagnostic*> Diagnostics::sorted() const {
  std::vector<const Diagnostic*> order;
  order.reserve(kept_.size());
  for (const Diagnostic& d : kept_) order.push_back(&d);
  // Pointers into the vector increase in the order of reporting.
  std::sort(order.begin(), order.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return a->range.begin != b->range.begin ? a->range.begin < b->range.begin : a < b;
  });
  return order;
}

} // namespace rung
