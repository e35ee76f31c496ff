// See foreign_file.h.
#include "ir/support/foreign_file.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "ir/support/encoding.h"
#include "ir/support/pmc_address.h"
#include "ir/support/utf8.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/controls.h"
#include "rtlib/text/end_of_file.h"
#include "rtlib/text/letters.h"

namespace rung {
namespace {

constexpr size_t kLooked = size_t{1} << 16; // bytes of a file, where what it is must show
constexpr size_t kMostLines = 200;          // of them

// ---- lines

// Without blanks at both ends; lines of blanks and comments are left out.
std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty() && lines.size() < kMostLines) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text::trimmed(text.substr(0, end));
    if (!line.empty() && !line.starts_with(';') && !line.starts_with("//")) lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string_view fieldOf(std::string_view line, size_t number) {
  for (; number > 0; --number) {
    const size_t comma = line.find(',');
    if (comma == std::string_view::npos) return {};
    line.remove_prefix(comma + 1);
  }
  return text::trimmed(line.substr(0, line.find(',')));
}

// Whether the line is a letter N, that many digits, and one of these letters after them.
bool isNumbered(std::string_view line, size_t digits, std::string_view letters) {
  if (line.size() < digits + 2 || text::upper(line[0]) != 'N') return false;
  if (!std::ranges::all_of(line.substr(1, digits), text::isDigit)) return false;
  const std::string_view rest = text::trimmed(line.substr(1 + digits));
  return !rest.empty() && letters.find(text::upper(rest[0])) != std::string_view::npos;
}

std::string_view wordOf(std::string_view line) { return line.substr(0, line.find_first_of(" \t(")); }

// Old systems, and some transfer programs, end lines so. Nothing after the first line would be read.
bool endsLinesWithCr(std::string_view text) {
  const size_t cr = text.find('\r');
  return text.find('\n') == std::string_view::npos && text.find_first_not_of('\r', cr) != std::string_view::npos;
}

// ---- kinds of the control's files

bool isParameters(std::span<const std::string_view> lines) {
  const auto first = std::ranges::find_if(lines, [](std::string_view line) { return line != "%"; });
  if (first == lines.end()) return false;
  return text::startsWithIgnoringCase(*first, "(PMC") || (isNumbered(*first, 6, "P") && (*first)[1] == '6');
}

bool isTrace(std::span<const std::string_view> lines) {
  return std::ranges::any_of(lines, [](std::string_view line) {
    return text::equalsIgnoringCase(fieldOf(line, 0), "Data") && pmcAddress(fieldOf(line, 1));
  });
}

// By the first lines: there may be a line of titles, and comments without a symbol.
bool isSymbols(std::span<const std::string_view> lines) {
  const auto first = lines.first(std::min<size_t>(lines.size(), 3));
  return std::ranges::any_of(first, [](std::string_view line) { return pmcAddress(fieldOf(line, 1)).has_value(); });
}

bool hasSections(std::span<const std::string_view> lines) {
  return std::ranges::any_of(lines, [](std::string_view line) {
    return line.size() > 2 && line.starts_with("%@") && (text::isDigit(line[2]) || text::isLetter(line[2]));
  });
}

std::optional<ControlFile> controlFileOf(std::span<const std::string_view> lines) {
  if (lines.empty() || hasSections(lines)) return std::nullopt;
  if (text::equalsIgnoringCase(fieldOf(lines[0], 0), "PMC SIGNAL DATA")) return ControlFile::Signals;
  if (isParameters(lines)) return ControlFile::Parameters;
  if (isTrace(lines)) return ControlFile::Trace;
  if (isSymbols(lines)) return ControlFile::Symbols;
  return std::nullopt;
}

// In the order of ControlFile.
constexpr std::array<std::string_view, 4> kControlFiles = {
    "a list of PMC parameters: `rungc import` makes initial values of them",
    "a table of symbols and comments: `rungc import` makes a file of the program of it",
    "a signal trace: `rungc import` makes a scenario of it",
    "a signal operation file of the PMC simulator: `rungc import` makes a scenario of it"};

// ---- other texts

constexpr std::string_view kCrLines =
    "a text without LF, whose lines end with CR alone: save it with CR LF at the ends of its lines";
constexpr std::string_view kPartProgram = "a part program (G code), not a program of the PMC";
constexpr std::string_view kCncParameters =
    "parameters of the CNC, not of the PMC: the control writes those of the PMC from the PMC's own screens";
constexpr std::string_view kGskList = "a command list of a GSK control: name it .pmc, or say --dialect gsk";

struct Word {
  std::string_view word; // a line begins with it
  std::string_view what;
};

constexpr std::string_view kOtherDialect = "a source of Rung in another dialect, which its first statement names";
constexpr Word kWords[] = {
    {"FUNC", kGskList},
    {"PRM", kGskList},
    {"MODULE_MAIN", "a TECHNOL source: name it .plc, or say --dialect technol"},
    {"ORGANIZATION_BLOCK", "a STEP 7 source of a Siemens control, which Rung does not read"},
    {"FUNCTION_BLOCK", "a source of another PLC (STEP 7 or IEC 61131-3), which Rung does not read"},
    {"DATA_BLOCK", "a STEP 7 source of a Siemens control, which Rung does not read"},
    {"PROGRAM", "a source of another PLC (IEC 61131-3), which Rung does not read"},
    {"/PROG", "a program of a FANUC robot, which Rung does not read"},
};

bool isPartProgram(std::span<const std::string_view> lines) {
  const auto first = std::ranges::find_if(lines, [](std::string_view line) { return line != "%"; });
  if (first == lines.end()) return false;
  const std::string_view line = *first;
  const bool isNumber = line.size() > 1 && (line[0] == 'O' || line[0] == ':') && text::isDigit(line[1]);
  return isNumber || (first != lines.begin() && line.starts_with("<") && line.find('>') != std::string_view::npos);
}

std::string_view xmlOf(std::string_view text) {
  if (text.find("RSLogix5000Content") != std::string_view::npos)
    return "a project of a Rockwell controller (L5X), which Rung does not read";
  if (text.find("plcopen.org") != std::string_view::npos) return "PLCopen XML, which Rung does not read";
  return "an XML or HTML file";
}

// "" for what may be a program.
std::string_view foreignText(std::string_view text) {
  if (endsLinesWithCr(text)) return kCrLines;
  const std::vector<std::string_view> lines = linesOf(text);
  if (lines.empty() || hasSections(lines)) return {};
  if (const auto kind = controlFileOf(lines)) return kControlFiles[static_cast<size_t>(*kind)];
  if (text::equalsIgnoringCase(wordOf(lines[0]), "dialect")) return kOtherDialect;
  if (lines[0].starts_with("<")) return xmlOf(text);
  if (isPartProgram(lines)) return kPartProgram;
  if (std::ranges::any_of(lines, [](std::string_view line) { return isNumbered(line, 5, "QPALTS"); }))
    return kCncParameters;
  for (const std::string_view line : lines)
    for (const Word& word : kWords)
      if (text::equalsIgnoringCase(wordOf(line), word.word)) return word.what;
  return {};
}

// ---- binary files

struct Magic {
  std::string_view bytes; // the file begins with them
  std::string_view what;
};

constexpr Magic kMagic[] = {
    {"PK\x03\x04", "a ZIP archive: unpack it, and name the file in it"},
    {"\x1F\x8B", "a compressed file (gzip): unpack it, and name the file in it"},
    {"%PDF-", "a PDF document: a printed ladder cannot be read; in LADDER-III write a mnemonic file"},
    {"\x89PNG", "a picture"},
    {"MZ", "a program for Windows"},
    {"\x7F"
     "ELF",
     "a compiled program"},
};

constexpr std::string_view kProject =
    "a LADDER-III project (.LAD), which is binary: open it in LADDER-III, and write a mnemonic file (Tool > Mnemonic "
    "Convert)";
constexpr std::string_view kBinary =
    "a binary file, such as a memory card file (.MEM, PMC1.000) or a LADDER-III project (.LAD): in LADDER-III import "
    "it, decompile it, and write a mnemonic file (Tool > Mnemonic Convert)";

// FANUC's texts have tabs, line ends, form feeds and the end-of-file mark of DOS.
bool isOfBinary(char c) { return text::isControl(c) && text::trimmed({&c, 1}).size() == 1 && c != '\f'; }

// In UTF-8 without byte order mark.
std::string firstText(std::string_view bytes) {
  std::string text = decoded(bytes, guessedEncoding(bytes)).text;
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return std::string(text::upToEndOfFile(text));
}

// "" for a text.
std::string_view foreignBinary(std::string_view bytes) {
  for (const Magic& magic : kMagic)
    if (bytes.starts_with(magic.bytes)) return magic.what;
  if (!isBinary(bytes)) return {};
  constexpr std::string_view kWide("#\0L\0R", 5); // its members are LEVEL1.#LR and others
  const bool isProject = bytes.find("#LR") != std::string_view::npos || bytes.find(kWide) != std::string_view::npos;
  return isProject ? kProject : kBinary;
}

} // namespace

std::optional<ControlFile> controlFileOf(std::string_view text) {
  return controlFileOf(linesOf(text.substr(0, kLooked)));
}

bool isMnemonicFile(std::string_view text) { return hasSections(linesOf(text.substr(0, kLooked))); }

size_t firstBinary(std::string_view text) {
  const auto found = std::ranges::find_if(text, isOfBinary);
  return found == text.end() ? std::string_view::npos : static_cast<size_t>(found - text.begin());
}

bool isBinary(std::string_view bytes) {
  return firstBinary(firstText(bytes.substr(0, kLooked))) != std::string_view::npos;
}

std::optional<std::string> foreignFile(std::string_view bytes) {
  const std::string_view looked = bytes.substr(0, kLooked);
  if (const std::string_view what = foreignBinary(looked); !what.empty()) return std::string(what);
  const std::string text = firstText(looked);
  const std::string_view what = foreignText(text);
  return what.empty() ? std::nullopt : std::optional<std::string>(what);
}

} // namespace rung
