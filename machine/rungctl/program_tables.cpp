// See program_tables.h.
#include "machine/rungctl/program_tables.h"

#include <span>
#include <string_view>

#include "machine/control/changes.h"
#include "machine/rungctl/words.h"
#include "rtlib/change/rung_alignment.h"
#include "rtlib/text/number.h"
#include "rung/types.hpp"

namespace rung::rungctl {

using nlohmann::json;

namespace {

uint64_t hashOf(const json& text) {
  constexpr int kHex = 16;
  const auto number = text::numberIn<uint64_t>(text.get<std::string>(), kHex);
  if (!number) throw std::runtime_error("the host sent " + text.dump() + ", expected a hash");
  return *number;
}

ProgramTables::Rung rungOf(const json& rung) {
  return {.number = rung.at("rung").get<uint32_t>(),
          .routine = rung.at("routine").get<std::string>(),
          .text = hashOf(rung.at("key")),
          .title = rung.at("title").get<std::string>(),
          .file = rung.at("file").get<std::string>(),
          .line = rung.at("line").get<uint32_t>()};
}

std::vector<runtime::RungMark> marksOf(const ProgramTables& tables) {
  std::vector<runtime::RungMark> marks;
  for (const ProgramTables::Rung& rung : tables.rungs)
    marks.push_back({rung.routine, rung.text, rung.title, rung.number});
  return marks;
}

} // namespace

ProgramTables tablesOf(Client& client) {
  const json answer = asked(client, {{"do", "program"}});
  runtime::ProgramParts parts;
  for (const runtime::ProgramPart& part : runtime::kProgramParts)
    parts.*part.hash = hashOf(answer.at("parts").at(part.name));
  return {.name = answer.at("program").get<std::string>(),
          .dialect = answer.at("dialect").get<std::string>(),
          .compiler = answer.at("compiler").get<std::string>(),
          .code = hashOf(answer.at("code")),
          .instrumented = answer.at("instrumented").get<bool>(),
          .files = answer.at("files").get<std::vector<std::string>>(),
          .parts = parts,
          .rungs = {}};
}

void addRungs(Client& client, ProgramTables& tables) {
  while (true) {
    const json answer = asked(client, {{"do", "rungs"}, {"first", tables.rungs.size()}});
    if (hashOf(answer.at("code")) != tables.code)
      throw std::runtime_error("another program has taken over meanwhile; try again");
    if (answer.at("rungs").empty()) return;
    for (const json& rung : answer.at("rungs")) tables.rungs.push_back(rungOf(rung));
  }
}

ProgramTables tablesOf(const rung_program& program) {
  const std::span files(program.files, program.file_count);
  ProgramTables tables{.name = program.name,
                       .dialect = program.dialect,
                       .compiler = program.compiler,
                       .code = program.code_hash,
                       .instrumented = program.instrumented != 0,
                       .files = {files.begin(), files.end()},
                       .parts = runtime::partsOf(program),
                       .rungs = {}};
  for (const rung_info& rung : std::span(program.rungs, program.rung_count))
    tables.rungs.push_back({.number = rung.number,
                            .routine = program.routines[rung.routine],
                            .text = textOfKey(rung.key, rung.copy),
                            .title = rung.title,
                            .file = rung.file < program.file_count ? program.files[rung.file] : "",
                            .line = rung.first_line});
  return tables;
}

ProgramDifference difference(const ProgramTables& before, const ProgramTables& after) {
  ProgramDifference found;
  const std::vector<runtime::RungMark> marksBefore = marksOf(before), marksAfter = marksOf(after);
  for (const runtime::RungChange& change :
       runtime::changedRungs(marksBefore, marksAfter, runtime::alignRungs(marksBefore, marksAfter))) {
    const bool removed = change.after == RUNG_NONE;
    const ProgramTables::Rung& rung = removed ? before.rungs[change.before] : after.rungs[change.after];
    found.rungs.push_back({{"kind", control::rungChangeName(runtime::changeKind(change))},
                           {"rung", rung.number},
                           {"title", rung.title},
                           {"file", rung.file},
                           {"line", rung.line}});
  }
  for (const runtime::ProgramPart& part : runtime::kProgramParts)
    if (before.parts.*part.hash != after.parts.*part.hash) found.parts.push_back(&part);
  return found;
}

} // namespace rung::rungctl
