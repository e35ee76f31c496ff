// Sections of the reference page that follow the instructions.
#include "frontend/dialects/nct/reference.h"

#include "frontend/dialects/nct/config.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/dialects/nct/signal_text.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/structure.h"
#include "rtlib/nc/nct/axis_codes.h"
#include "rtlib/nc/nct/messages.h"
#include "rtlib/nc/nct/parameters.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/nct/service_functions.h"
#include "rtlib/nc/nct/windows.h"
#include "rtlib/nc/signals.h"

namespace rung::frontend::nct {
namespace {

using frontend::ReferencePage;

void memory(ReferencePage& page) {
  const Config limits;
  page.section(
      "Memory",
      fmt::format("One array of {} double words, 0000 to {}. A word is written with four digits or as a symbol, "
                  "a bit `0056.17`; `,#3` or `,REG` moves either by words, `:REG` takes the bit's number from "
                  "a word. A double is two words, the lower half first. Manual: l.281-522.",
                  kWords, kWords - 1),
      "words | name | what | through power-off");
  page.row("0000", "`FLAGS`",
           "flags of the instructions: FL_ER, FL_UF, FL_OF, FL_CY, FL_GT, FL_EQ, FL_LT from bit 0 on; read only",
           std::nullopt);
  page.row(fmt::format("{:04} to PLCNVRAM-1", kFirstNcWord), std::nullopt,
           "signals of the NC, twice: synchronised, and for `!` in INT0 the time-slice memory", std::nullopt);
  page.row("PLCNVRAM to PLCRAM-1", fmt::format("`PLCNVRAM` = {}", limits.plcNvram), "user memory", "kept");
  page.row(fmt::format("PLCRAM to {}", kWords - 1), fmt::format("`PLCRAM` = {}", limits.plcRam), "user memory",
           "cleared");
}

void pins(ReferencePage& page) {
  page.section(
      "Pins of boxes",
      "The first line of a box carries mnemonic and operands and is its first pin; each further line names its "
      "pin.",
      "box | pins from top to bottom");
  for (const Row& row : allRows())
    if (row.info.pins.size() > 1) page.row(row.info.mnemonic, frontend::pinNames(row.info));
}

void executionCodes(ReferencePage& page) {
  page.section("Execution codes of MR and MW",
               "Word 0 of the block, written when the NC has answered. Manual: l.6324-6414.",
               "code | meaning | manual");
  for (const nc::nct::ExecutionCode& code : nc::nct::executionCodes())
    page.row(code.code, code.meaning, fmt::format("l.{}", code.line));
}

std::string amountsOf(const nc::nct::ServiceFunction& function) {
  std::string text;
  for (const nc::nct::NumberRange& amount : function.amounts) {
    if (amount.first == 0) continue;
    if (!text.empty()) text += ", ";
    text += amount.first == amount.last ? fmt::format("{}", amount.first)
            : amount.step == 1          ? fmt::format("{} to {}", amount.first, amount.last)
                               : fmt::format("{}, {}, … {}", amount.first, amount.first + amount.step, amount.last);
  }
  return text;
}

std::string_view useText(nc::nct::WordUse use) {
  switch (use) {
  case nc::nct::WordUse::Input: return "set by the program";
  case nc::nct::WordUse::Output: return "written by the NC";
  case nc::nct::WordUse::Optional: return "may be set";
  }
  return "";
}

std::string codesOf(const nc::nct::ServiceFunction& function) {
  std::string text;
  for (const nc::nct::ExecutionCode& code : nc::nct::executionCodes())
    if (function.hasCode(code.code)) text += fmt::format("{}{}", text.empty() ? "" : ", ", code.code);
  return text;
}

void functions(ReferencePage& page) {
  page.section("Functions of MR and MW",
               "The block: word 0 execution code, word 1 amount of data, then the words of data. `rungc explain 'MR "
               "104'` shows one function. Manual: l.3390-6320.");
  for (const nc::nct::ServiceFunction& function : nc::nct::serviceFunctions()) {
    page.part(fmt::format("{} {}", mnemonicOf(function.access), function.code),
              fmt::format("{}. Amount of data: {}. Execution codes: {}. Manual: {}, l.{}.", function.title,
                          amountsOf(function), codesOf(function), function.section, function.line),
              "word | use | meaning");
    for (const nc::nct::BlockWord& word : function.words)
      page.row(word.first == word.last ? fmt::format("{}", word.first) : fmt::format("{} to {}", word.first, word.last),
               useText(word.use), word.meaning);
  }
}

std::string_view speedText(nc::nct::AxisSpeed speed) {
  switch (speed) {
  case nc::nct::AxisSpeed::Unused: return "-";
  case nc::nct::AxisSpeed::PerMinute: return "feed per minute, not 0";
  case nc::nct::AxisSpeed::PerRevolution: return "feed per revolution, not 0";
  case nc::nct::AxisSpeed::Jog: return "feed per minute; 0: parameter N0316";
  }
  return "";
}

std::string_view distanceText(nc::nct::AxisDistance distance) {
  switch (distance) {
  case nc::nct::AxisDistance::Unused: return "-";
  case nc::nct::AxisDistance::Absolute: return "position in the current coordinate system";
  case nc::nct::AxisDistance::Incremental: return "distance";
  case nc::nct::AxisDistance::Machine: return "position in the machine coordinate system";
  case nc::nct::AxisDistance::Seconds: return "seconds";
  case nc::nct::AxisDistance::Revolutions: return "revolutions of the spindle";
  }
  return "";
}

void axisCodes(ReferencePage& page) {
  page.section(
      "Codes of MOVCMND",
      fmt::format("Axis index 0 to {}; units by parameter N0104 bit IND. Manual: l.3126-3145.", nc::nct::kAxes - 1),
      "code | as in a part program | what | speed | distance | manual");
  for (const nc::nct::AxisCode& code : nc::nct::axisCodes())
    page.row(code.code, code.equivalent, code.title, speedText(code.speed), distanceText(code.distance),
             fmt::format("l.{}", code.line));
}

void scopeSymbols(ReferencePage& page) {
  page.section("Quantities of SCP",
               "Axes, spindles and channels are given by their numbers, from 1 on. Manual: l.3323-3388.",
               "name | value | parameter 1 | parameter 2 | manual");
  for (const nc::nct::ScopeSymbol& symbol : nc::nct::scopeSymbols())
    page.row(fmt::format("`{}`", symbol.name), symbol.meaning, parameterText(symbol.param1),
             parameterText(symbol.param2), fmt::format("l.{}", symbol.line));
}

void parameters(ReferencePage& page) {
  page.section(
      "Parameters",
      "The parameters that the manual names; MR 31, 32, MW 34, 35 reach these in the simulated NC. What indexes a "
      "parameter and its format follow from its use where the manual does not say; the values are those of a "
      "new simulated NC (`config axes`, `spindles` set some).",
      "parameter | name | format | of | value | manual");
  for (const nc::nct::ParameterRow& row : nc::nct::parameterRows()) {
    const std::string last = row.numbers > 1 ? fmt::format(" to N{:04}", row.number + row.numbers - 1) : "";
    page.row(fmt::format("N{:04}{}", row.number, last), row.name, nc::nct::formatName(row.format),
             nc::nct::indexName(row.index), row.initial, fmt::format("l.{}", row.line));
  }
}

void messages(ReferencePage& page) {
  page.section(
      "Messages",
      "MSG, MSGF, ALR, ALRF, REM and REMF send a message with the rising edge of their input and delete it from the "
      "screen with the falling edge, whatever their operands are by then; its number is the variable's value at "
      "the rising edge. A number, channel or index out of range at run time sets FL_ER, and nothing is sent until "
      "the next rising edge. Manual: l.2667-2913.",
      "box | screen | log | variable");
  page.row("MSG, MSGF", "yes", "no", "integer, double");
  page.row("ALR, ALRF", "yes", "yes", "integer, double");
  page.row("REM, REMF", "no", "yes", "integer, double");
  page.part(
      "Code and text",
      fmt::format(
          "The code AA0CCCDD has the channel index, the number 1 to {} and the arbitrary index. One code is one "
          "message "
          "on the screen: sent again, by whatever box, it comes to the top with its new number, and each of its boxes "
          "deletes it. `message 20 \"Tool {{#0:F0}} is missing\"` gives the text: `{{#0:F0}}` prints an integer, "
          "`{{*0:Fi}}` a double with i decimals, rounded. The kind must be the box's (`message-format`); a box whose "
          "number is in a register prints what it has. A log entry is the number, channel and index in brackets unless "
          "both are 0, and the text.",
          nc::nct::kMessages));
  page.part(
      "What the program sees",
      "The output is TRUE while the code is on the screen (REM, REMF: since it is in the log), from the cycle after "
      "the one in which it was sent, in INT0 from the next time slice on; FALSE while the input is. The last message "
      "sent is on top: N_ACTMSG holds its code, N_MSGA and N_MSG0 are 1 while there is one. A message that found no "
      "room in the queue of its cycle is neither shown nor logged, and the output stays FALSE.\n\n"
      "CANCEL sets N_CLRMSG for one cycle; at the end of that cycle the message that was on top goes. So the output "
      "is "
      "still TRUE when N_CLRMSG is, FALSE from the next cycle on; the message comes back with the next rising edge "
      "only. In a scenario `set N_CLRMSG 1` does it (one message for each rising edge of N_CLRMSG), or `event "
      "cancel`, "
      "which also takes `all=1` (Clear all) or `number=20 channel=0 index=1` (CLEAR of a selected message).");
}

void windows(ReferencePage& page) {
  page.section("Windows of MW 70", "", "identifier | window | parameter 1 | parameter 2 | manual");
  for (const nc::nct::ScreenWindow& window : nc::nct::screenWindows())
    page.row(window.identifier, window.title, window.parameter1, window.parameter2, fmt::format("l.{}", window.line));
}

void signals(ReferencePage& page) {
  page.section("Signals",
               fmt::format("{} names that need no declaration, in the order of the manual. The name alone is the first "
                           "panel, axis, spindle, channel, …; the others are reached by an index from 0 on, "
                           "`AN_PLCA,#1` or `AN_PLCA,REG`, of a double by an even one. Inputs are written by the NC, "
                           "outputs by the program. Where the manual does not print the bit of a word it follows from "
                           "the order of its table. `rungc explain NAME` shows one entry.",
                           nc::nctSignals().size()));
  std::string_view group;
  for (const nc::Signal& signal : nc::nctSignals()) {
    if (std::exchange(group, signal.group) != signal.group)
      page.part(fmt::format("Group {}", group), "", "signal | type | direction | index | bit of | meaning | manual");
    page.row(fmt::format("`{}`", signal.symbol), typeText(signal),
             signal.direction == nc::Direction::In ? "input" : "output", indexText(signal), placeText(signal),
             nc::meaningWithNote(signal), fmt::format("l.{}", signal.manualLine));
  }
}

} // namespace

void addReference(ReferencePage& page) {
  memory(page);
  pins(page);
  frontend::addWarnings(page, {diag::WriteToInput, diag::SymbolInNcArea, diag::UnknownFunctionCode,
                               diag::Int0OnlySignal, diag::SignalIndex, diag::MixedOutput, diag::BackwardJump,
                               diag::LabelUnused, diag::SubroutineUnused, diag::SharedState});
  functions(page);
  parameters(page);
  messages(page);
  executionCodes(page);
  windows(page);
  scopeSymbols(page);
  axisCodes(page);
  signals(page);
}

} // namespace rung::frontend::nct
