// The reference's sections (see reference.h).
#include "frontend/dialects/technol/reference.h"

#include <algorithm>
#include <vector>

#include "frontend/dialects/technol/read/symbols.h"
#include "ir/support/diag/technol.h"
#include "rtlib/nc/signals.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

std::string_view typeText(nc::SignalType type) {
  switch (type) {
  case nc::SignalType::Bit: return "bit";
  case nc::SignalType::Byte: return "BYTE";
  case nc::SignalType::Word: return "WORD";
  case nc::SignalType::Dword: return "DWORD";
  case nc::SignalType::Qword: return "QWORD";
  case nc::SignalType::Real: return "REAL";
  case nc::SignalType::Struct: return "structure";
  case nc::SignalType::String: return "text";
  }
  return "";
}

// How a program may access the signal (§4.1 of the inventory).
std::string_view accessText(const nc::Signal& signal) {
  switch (signal.direction) {
  case nc::Direction::In: return std::string_view(signal.group).starts_with("8.") ? "read only" : "read";
  case nc::Direction::Out: return "write";
  case nc::Direction::InOut: return "read, write";
  }
  return "";
}

// Where a program may use the name.
std::string useText(const nc::Signal& signal) {
  const std::string_view area = signal.area;
  if (area == "I") return "";
  if (area == "W") return "a weight, after an address: `CELL." + std::string(signal.symbol) + "`";
  if (area == "BLK") return "of the queued block n: `BLK[n]" + std::string(signal.symbol).substr(area.size() + 2) + "`";
  if (area.starts_with("RTM.")) return "a logical input or output after `" + std::string(area) + "[x].`";
  if (area.starts_with("SHARE") || area == "RtmVar")
    return "shared with the panel by this name; not a name of a program";
  return "a member of the structure " + std::string(area);
}

std::string typeOf(const nc::Signal& signal) {
  std::string text(typeText(signal.type));
  if (signal.type == nc::SignalType::Struct && *signal.structure != 0) text += " " + std::string(signal.structure);
  if (*signal.address != 0) text += fmt::format(" [{}]", signal.address);
  return text;
}

} // namespace

void addReference(ReferencePage& page) {
  page.section(
      "Control listing",
      "`rungc build main.plc more.plc -o program.so --listing program.ls1` writes the lines of the program with "
      "their numbers, and after it the number of the rung that begins there, as profiles and faults name it. "
      "`name_LINE` of a mechanism holds the number of the line of the state in which it waits, 0 when it is "
      "not active. The numbers count in each file of the program; a statement of a macro counts in the line "
      "of its use. Manual: l.2210-2217.");
  page.section("Predefined constants", "", "name | value");
  for (const Predefined& constant : predefinedConstants()) page.row(fmt::format("`{}`", constant.name), constant.value);
  page.section("Signals",
               "Cells of the CNC-PLC interface, predeclared with their types. A write to one that is `read only` is "
               "`write-to-readonly`; to one that is `read` the same code as a warning. `rungc explain NAME` shows one "
               "entry. Manual: chapter 8 and those of the services.");
  std::string_view group;
  for (const nc::Signal& signal : nc::technolSignals()) {
    if (std::exchange(group, signal.group) != signal.group)
      page.part(group, "", "symbol | type | access | meaning | manual");
    const std::string use = useText(signal);
    page.row(fmt::format("`{}`", signal.symbol), typeOf(signal), accessText(signal),
             nc::meaningWithNote(signal) + (use.empty() ? "" : "; " + use), fmt::format("l.{}", signal.manualLine));
  }
  addWarnings(page, {diag::CntsPrefix, diag::JloAlias, diag::MixedRealInteger, diag::NameTooLong, diag::ReservedWord,
                     diag::SharedName, diag::StringTooLong, diag::TextAfterStop, diag::TmOutsideDftm,
                     diag::UnterminatedEquation, diag::ValueNotPreserved});
}

namespace {

// The name in upper case without bracketed parts: BLK[0].M[3] becomes BLK.M.
std::string plainWord(std::string_view name) {
  std::string word;
  int depth = 0;
  for (const char c : name) {
    if (c == '[') ++depth;
    if (depth == 0) word += text::upper(c);
    if (c == ']') --depth;
  }
  return word;
}

// Replaces a cell by the name of its structure: SYST_TIME_INFO.TIME_SEC becomes TIME_INFOS.TIME_SEC.
std::string ofItsStructure(const std::string& word) {
  const size_t point = word.find('.');
  const nc::Signal* whole =
      point == std::string::npos ? nullptr : nc::findSignal(nc::technolSignals(), word.substr(0, point), "I");
  return whole && *whole->structure ? plainWord(whole->structure) + word.substr(point) : word;
}

// Whether the word is the signal's full name, or its member or block element name alone.
bool names(const std::string& word, const nc::Signal& signal) {
  const std::string symbol = plainWord(signal.symbol);
  if (symbol == word) return true;
  const std::string owner = plainWord(signal.area) + ".";
  return symbol.size() == owner.size() + word.size() && symbol.starts_with(owner) && symbol.ends_with(word);
}

} // namespace

std::string explainWord(std::string_view name) {
  std::string text;
  const std::string word = ofItsStructure(plainWord(name));
  std::vector<std::string> seen; // weights and members repeat in many groups
  for (const nc::Signal& signal : nc::technolSignals()) {
    if (!names(word, signal)) continue;
    std::string entry = fmt::format("[technol] {}: {}, {}\n  {}\n", signal.symbol, typeOf(signal), accessText(signal),
                                    nc::meaningWithNote(signal));
    if (const std::string use = useText(signal); !use.empty()) entry += fmt::format("  Use: {}.\n", use);
    entry += fmt::format("  Group {}. Manual: l.{}.\n", signal.group, signal.manualLine);
    if (std::find(seen.begin(), seen.end(), entry) != seen.end()) continue;
    seen.push_back(entry);
    text += entry;
  }
  for (const Predefined& constant : predefinedConstants())
    if (text::equalsIgnoringCase(constant.name, word))
      text += fmt::format("[technol] {}: constant {}\n", constant.name, constant.value);
  if (!word.empty() && plainWord(" " + std::string(nc::kLicences) + " ").find(" " + word + " ") != std::string::npos)
    text += fmt::format("[technol] {}: a licence of the hardware key, for LDR_LIC. Manual: l.7631.\n", name);
  return text;
}

} // namespace rung::frontend::technol
