// The parser of the text form (see text.h and README.md).
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "ir/text/keywords.h"
#include "ir/text/rung_parser.h"
#include "ir/text/text.h"
#include "rtlib/text/letters.h"

namespace rung::ir {
namespace {

class Parser {
public:
  explicit Parser(std::string_view text) : scanner_(text) {}

  ParseOutcome run() {
    if (!scanner_.atEnd())
      parseHead();
    else
      scanner_.fail("'module' expected");
    while (scanner_.ok() && !scanner_.atEnd()) {
      parseDeclaration();
      scanner_.endLine();
    }
    if (scanner_.ok()) resolveCalls();
    if (!scanner_.ok()) return {std::nullopt, scanner_.error()};
    return {std::move(module_), {}};
  }

private:
  struct Call {
    uint32_t routine;
    uint32_t rung;
    std::string callee;
  };

  void parseHead() {
    scanner_.expectWord("module");
    module_.name = scanner_.text();
    scanner_.expectWord("dialect");
    module_.dialect = scanner_.text();
    module_.instrumented = scanner_.acceptWord("instrumented");
    scanner_.endLine();
  }

  void parseDeclaration() {
    const std::string_view word = scanner_.word();
    for (const auto& [keyword, parse] : kDeclarations)
      if (keyword == word) return (this->*parse)();
    scanner_.fail(fmt::format("there is no declaration '{}'", word));
  }

  // Declares a name that later lines may refer to. Of equal names the first one counts; the others are referred to by
  // number.
  template <class Vector>
  std::string declare(NameIndex& names, const Vector& items) {
    std::string name = scanner_.name();
    names.emplace(name, static_cast<uint32_t>(items.size()));
    return name;
  }

  void parseFile() { module_.files.push_back(declare(names_.files, module_.files)); }
  void parseFault() { module_.faults.push_back(declare(names_.faults, module_.faults)); }
  void parseService() { module_.services.push_back(declare(names_.services, module_.services)); }
  void parseMessage() {
    MessageText message;
    message.number = scanner_.u32();
    message.text = scanner_.text();
    module_.messages.push_back(std::move(message));
  }

  // Flags as words in any order, and unnamed ones as #N.
  uint32_t parseFlags(std::span<const Keyword> list) {
    uint32_t flags = 0;
    for (bool found = true; found && scanner_.ok();) {
      found = false;
      for (const Keyword& keyword : list)
        if (scanner_.acceptWord(keyword.word)) {
          flags |= keyword.value;
          found = true;
        }
    }
    if (scanner_.accept('#')) flags |= scanner_.u32();
    return flags;
  }

  uint32_t parseKeyword(std::span<const Keyword> list, std::string_view kind) {
    if (scanner_.accept('#')) return scanner_.u32();
    const std::string_view word = scanner_.word();
    const Keyword* keyword = findKeyword(list, word);
    if (keyword != nullptr) return keyword->value;
    scanner_.fail(fmt::format("there is no {} '{}'", kind, word));
    return 0;
  }

  uint32_t field(std::string_view word) {
    scanner_.expectWord(word);
    return scanner_.u32();
  }

  void parseSpace() {
    Space space;
    space.name = declare(names_.spaces, module_.spaces);
    space.unitBytes = field("unit");
    space.units = field("units");
    space.flags = parseFlags(kSpaceFlags);
    space.packedOnly = scanner_.acceptWord("packed");
    module_.spaces.push_back(std::move(space));
  }

  void parseSlot() {
    Slot slot;
    scanner_.expect('$');
    if (scanner_.u32() != module_.slots.size())
      scanner_.fail(fmt::format("the next slot is ${}", module_.slots.size()));
    slot.type = parseType(scanner_);
    scanner_.expectWord("init");
    slot.init = parseLiteral(scanner_, slot.type);
    slot.transient = scanner_.acceptWord("transient");
    slot.key = scanner_.text();
    module_.slots.push_back(std::move(slot));
  }

  ParsedPlace parsePlaceAs(PlaceForm form) { return parsePlace(scanner_, module_, names_.spaces, form); }
  // Byte offset of a place in a declaration.
  uint32_t byteOf(const ParsedPlace& place) {
    const auto byte = static_cast<uint64_t>(place.bitOffset) / 8;
    if (byte > UINT32_MAX) scanner_.fail("offset too large");
    return static_cast<uint32_t>(byte);
  }

  void parseSymbol() {
    Symbol symbol;
    symbol.name = scanner_.name();
    symbol.type = parseKeyword(kSymbolTypes, "type");
    const bool bit = symbol.type == RUNG_TYPE_BIT;
    const ParsedPlace place = parsePlaceAs(bit ? PlaceForm::Bit : PlaceForm::Byte);
    symbol.space = SpaceId{place.space};
    symbol.byte = byteOf(place);
    symbol.bit = static_cast<uint32_t>(static_cast<uint64_t>(place.bitOffset) % 8);
    symbol.count = field("count");
    symbol.flags = parseFlags(kSymbolFlags);
    scanner_.expectWord("value");
    symbol.value = scanner_.i64();
    symbol.comment = scanner_.text();
    module_.symbols.push_back(std::move(symbol));
  }

  void parseContinuation() {
    Continuation c;
    c.key = scanner_.text();
    if (scanner_.accept('$')) {
      c.slot = SlotId{scanner_.u32()};
    } else {
      const ParsedPlace place = parsePlaceAs(PlaceForm::Byte);
      c.space = SpaceId{place.space};
      c.byte = byteOf(place);
    }
    scanner_.expectWord("points");
    while (scanner_.peekName()) c.points.push_back(scanner_.text());
    module_.continuations.push_back(std::move(c));
  }

  TimerCell parseTimerCell() {
    TimerCell cell{.type = parseType(scanner_)};
    if (scanner_.accept('$')) {
      cell.slot = SlotId{scanner_.u32()};
    } else {
      const ParsedPlace place = parsePlaceAs(PlaceForm::Byte);
      cell.space = SpaceId{place.space};
      cell.byte = byteOf(place);
    }
    return cell;
  }

  void parseTimer() {
    Timer timer;
    timer.name = scanner_.text();
    timer.flags = parseFlags(kTimerFlags);
    scanner_.expectWord("time");
    timer.time = parseTimerCell();
    timer.timeUs = field("by");
    if (scanner_.acceptWord("running")) {
      scanner_.expect('$');
      timer.running = SlotId{scanner_.u32()};
    }
    scanner_.expectWord("preset");
    if (scanner_.acceptWord("const"))
      timer.constant = scanner_.i64();
    else
      timer.preset = parseTimerCell();
    if (scanner_.acceptWord("unit")) timer.unit = parseTimerCell();
    scanner_.expectWord("of");
    timer.unitsUs = {scanner_.u32()};
    while (scanner_.accept(',')) timer.unitsUs.push_back(scanner_.u32());
    module_.timers.push_back(std::move(timer));
  }

  void parseInit() {
    const ParsedPlace place = parsePlaceAs(PlaceForm::Byte);
    Init init{.space = SpaceId{place.space}, .byte = byteOf(place), .data = {}};
    const std::string_view digits = scanner_.hexDigits();
    if (digits.size() % 2 != 0) scanner_.fail("two hexadecimal digits a byte expected");
    for (size_t i = 0; i + 1 < digits.size(); i += 2) {
      init.data.push_back(static_cast<uint8_t>(text::hexDigit(digits[i]) * 16 + text::hexDigit(digits[i + 1])));
    }
    module_.inits.push_back(std::move(init));
  }

  SpaceSpan parseSpan() {
    const ParsedPlace place = parsePlaceAs(PlaceForm::Byte);
    SpaceSpan span{.space = SpaceId{place.space}, .byte = byteOf(place)};
    span.size = field("size");
    return span;
  }
  void parseRetain() { module_.retains.push_back(parseSpan()); }
  void parseSafe() { module_.safeSpans.push_back(parseSpan()); }

  void parseRoutine() {
    Routine routine;
    routine.name = declare(names_.routines, module_.routines);
    scanner_.expect('{');
    scanner_.endLine();
    while (scanner_.ok() && scanner_.acceptWord("rung")) parseRung(routine);
    scanner_.expect('}');
    module_.routines.push_back(std::move(routine));
  }

  void parseRung(Routine& routine) {
    const auto number = static_cast<uint32_t>(routine.rungs.size());
    if (scanner_.u32() != number) scanner_.fail(fmt::format("the next rung is {}", number));
    Rung rung;
    if (scanner_.acceptWord("from")) {
      rung.origin.routine = scanner_.name();
      rung.origin.index = scanner_.u32();
    }
    if (scanner_.acceptWord("drawn")) rung.number = scanner_.u32();
    rung.title = scanner_.text();
    scanner_.expectWord("loc");
    scanner_.expect('(');
    rung.begin.file = FileIndex{parseReference(scanner_, names_.files, "file")};
    scanner_.expect(':');
    rung.begin.line = scanner_.u32();
    scanner_.expect(':');
    rung.begin.column = scanner_.u32();
    scanner_.expect('-');
    rung.lastLine = scanner_.u32();
    scanner_.expect(')');
    scanner_.expectWord("key");
    scanner_.expect('(');
    rung.key = scanner_.u64();
    scanner_.expect(')');
    if (scanner_.acceptWord("copy")) rung.copy = scanner_.u32();
    rung.weight = field("weight");
    scanner_.expect('{');
    scanner_.endLine();
    RungParser parser(scanner_, module_, names_, rung);
    parser.parseBody();
    std::string callee = parser.parseTransfer();
    scanner_.endLine();
    if (!callee.empty()) calls_.push_back({static_cast<uint32_t>(module_.routines.size()), number, std::move(callee)});
    routine.rungs.push_back(std::move(rung));
  }

  void parseTask() {
    Task task;
    task.name = declare(names_.tasks, module_.tasks);
    scanner_.expectWord("entry");
    task.entry = RoutineId{parseReference(scanner_, names_.routines, "routine")};
    task.periodUs = field("period");
    task.budget = field("budget");
    scanner_.expectWord("fault");
    task.budgetFault = FaultId{parseReference(scanner_, names_.faults, "fault")};
    task.parts = field("parts");
    while (scanner_.acceptWord("at")) task.borders.push_back(scanner_.u32());
    scanner_.expect('{');
    scanner_.endLine();
    while (scanner_.ok() && !scanner_.accept('}')) {
      std::vector<Copy>& list = scanner_.acceptWord("begin") ? task.begin : task.end;
      if (&list == &task.end) scanner_.expectWord("end");
      list.push_back(parseCopy());
      scanner_.endLine();
    }
    module_.tasks.push_back(std::move(task));
  }

  Copy parseCopy() {
    Copy copy;
    const ParsedPlace from = parsePlaceAs(PlaceForm::Byte);
    copy.from = {.space = SpaceId{from.space}, .byte = byteOf(from)};
    scanner_.expect('-');
    scanner_.expect('>');
    const ParsedPlace to = parsePlaceAs(PlaceForm::Byte);
    copy.to = SpaceId{to.space};
    copy.toByte = byteOf(to);
    copy.from.size = field("size");
    copy.masked = scanner_.acceptWord("masked");
    if (copy.masked) {
      const ParsedPlace mask = parsePlaceAs(PlaceForm::Byte);
      copy.mask = SpaceId{mask.space};
      copy.maskByte = byteOf(mask);
    }
    return copy;
  }

  void parseSchedule() {
    scanner_.expectWord("main");
    module_.mainTask = TaskId{parseReference(scanner_, names_.tasks, "task")};
    scanner_.expectWord("fast");
    module_.fastTask = TaskId{parseReference(scanner_, names_.tasks, "task")};
  }

  void parseStep() {
    const auto accepted = [&](const StepList& list) { return scanner_.acceptWord(list.keyword); };
    const auto* list = std::ranges::find_if(kStepLists, accepted);
    if (list == std::end(kStepLists)) return scanner_.fail("'scan', 'fast' or 'slice' expected");
    Step step;
    step.op = parseKeyword(kStepOps, "step");
    step.task = TaskId{parseReference(scanner_, names_.tasks, "task")};
    step.arg = scanner_.u32();
    (module_.*list->steps).push_back(step);
  }

  void resolveCalls() {
    for (const Call& call : calls_) {
      auto found = names_.routines.find(call.callee);
      if (found == names_.routines.end()) return scanner_.fail(fmt::format("there is no routine '{}'", call.callee));
      module_.routines[call.routine].rungs[call.rung].transfer.callee = RoutineId{found->second};
    }
  }

  struct Declaration {
    std::string_view keyword;
    void (Parser::*parse)();
  };
  static const Declaration kDeclarations[16];

  Scanner scanner_;
  Module module_;
  ModuleNames names_;
  std::vector<Call> calls_;
};

const Parser::Declaration Parser::kDeclarations[16] = {{"file", &Parser::parseFile},
                                                       {"space", &Parser::parseSpace},
                                                       {"slot", &Parser::parseSlot},
                                                       {"symbol", &Parser::parseSymbol},
                                                       {"init", &Parser::parseInit},
                                                       {"retain", &Parser::parseRetain},
                                                       {"safe", &Parser::parseSafe},
                                                       {"fault", &Parser::parseFault},
                                                       {"service", &Parser::parseService},
                                                       {"message", &Parser::parseMessage},
                                                       {"routine", &Parser::parseRoutine},
                                                       {"task", &Parser::parseTask},
                                                       {"schedule", &Parser::parseSchedule},
                                                       {"step", &Parser::parseStep},
                                                       {"continuation", &Parser::parseContinuation},
                                                       {"timer", &Parser::parseTimer}};

} // namespace

ParseOutcome parse(std::string_view text) { return Parser(text).run(); }

} // namespace rung::ir
