// Words of instruction lists (see list_word.h).
#include "frontend/ladder/text/list_word.h"

#include <algorithm>
#include <iterator>

#include "rtlib/text/letters.h"

namespace rung::frontend::ladder {
namespace {

constexpr std::string_view kOpen = "a contact [x]";
constexpr std::string_view kClosed = "a closed contact [/x]";
constexpr std::string_view kOpenInSeries = "a contact [x] in series: [y]--[x]";
constexpr std::string_view kClosedInSeries = "a closed contact [/x] in series: [y]--[/x]";
constexpr std::string_view kOpenInParallel = "a contact [x] in a branch, which joins in '+'";
constexpr std::string_view kClosedInParallel = "a closed contact [/x] in a branch, which joins in '+'";
constexpr std::string_view kRising = "a contact for a rising edge, [@x]";
constexpr std::string_view kFalling = "a contact for a falling edge, [%x]";
constexpr std::string_view kBranches = "branches, which join in '+'";
constexpr std::string_view kCoil = "a coil (x)";
constexpr std::string_view kNegatedCoil = "a negated coil (/x)";
constexpr std::string_view kSetCoil = "a coil (S x)";
constexpr std::string_view kResetCoil = "a coil (R x)";

struct ListWord {
  std::string_view word;
  std::string_view drawn;
};
constexpr ListWord kListWords[] = {
    {"=", kCoil},
    {"A", kOpen},
    {"AN", kClosed},
    {"ANB", kBranches},
    {"AND", kOpenInSeries},
    {"AND.NOT", kClosedInSeries},
    {"ANDF", "a contact for a falling edge, [%x], in series"},
    {"ANDI", kClosedInSeries},
    {"ANDN", kClosedInSeries},
    {"ANDNOT", kClosedInSeries},
    {"ANDP", "a contact for a rising edge, [@x], in series"},
    {"ANI", kClosedInSeries},
    {"LD", kOpen},
    {"LDF", kFalling},
    {"LDI", kClosed},
    {"LDN", kClosed},
    {"LDNOT", kClosed},
    {"LDP", kRising},
    {"O", kOpenInParallel},
    {"ON", kClosedInParallel},
    {"OR", kOpenInParallel},
    {"OR.NOT", kClosedInParallel},
    {"ORB", kBranches},
    {"ORF", "a contact for a falling edge, [%x], in a branch, which joins in '+'"},
    {"ORI", kClosedInParallel},
    {"ORN", kClosedInParallel},
    {"ORNOT", kClosedInParallel},
    {"ORP", "a contact for a rising edge, [@x], in a branch, which joins in '+'"},
    {"OTE", kCoil},
    {"OTL", kSetCoil},
    {"OTU", kResetCoil},
    {"OUT", kCoil},
    {"OUTI", kNegatedCoil},
    {"OUTN", kNegatedCoil},
    {"R", kResetCoil},
    {"RD", kOpen},
    {"RD.NOT", kClosed},
    {"RESET", kResetCoil},
    {"RST", kResetCoil},
    {"S", kSetCoil},
    {"SET", kSetCoil},
    {"ST", "a coil (x); where ST begins a rung, a contact [x]"},
    {"STN", kNegatedCoil},
    {"U", kOpen},
    {"UN", kClosed},
    {"WRT", kCoil},
    {"WRT.NOT", kNegatedCoil},
    {"XIC", kOpen},
    {"XIO", kClosed},
};

} // namespace

std::string_view drawnFor(std::string_view listWord) {
  const auto* const found = std::ranges::find_if(
      kListWords, [&](const ListWord& one) { return text::equalsIgnoringCase(one.word, listWord); });
  return found == std::end(kListWords) ? std::string_view() : found->drawn;
}

bool isListLine(std::span<const Word> words) {
  if (words.size() > 1 && std::ranges::all_of(words[0].text, text::isDigit)) words = words.subspan(1);
  return !words.empty() && !words[0].quoted && !drawnFor(words[0].text).empty();
}

} // namespace rung::frontend::ladder
