// See program_tables.h.
#include "machine/control/program_tables.h"

#include <algorithm>
#include <span>

#include <nlohmann/json.hpp>

#include "machine/control/values.h"
#include "rtlib/load/program_parts.h"
#include "rtlib/text/hex.h"
#include "rung/types.hpp"

namespace rung::control {

using nlohmann::json;

namespace {

constexpr uint32_t kMostRungs = 2000; // in an answer

std::string hexOf(uint64_t number) { return text::hexOfNumber(number, sizeof number); }

json jsonOf(const runtime::ProgramParts& parts) {
  json out = json::object();
  for (const runtime::ProgramPart& part : runtime::kProgramParts) out[part.name] = hexOf(parts.*part.hash);
  return out;
}

json jsonOf(const rung_program& program, const rung_info& rung) {
  return {{"rung", rung.number},
          {"routine", program.routines[rung.routine]},
          {"key", hexOf(textOfKey(rung.key, rung.copy))},
          {"title", rung.title},
          {"file", rung.file < program.file_count ? program.files[rung.file] : ""},
          {"line", rung.first_line}};
}

} // namespace

ProgramTables::ProgramTables(PlcAccess& plc, const Image& image) : plc_(plc) {
  programs_[plc_.program().number] = &image.program();
}

void ProgramTables::forgetOthers(uint32_t number, uint32_t former) {
  std::erase_if(programs_, [&](const auto& known) { return known.first != number && known.first != former; });
}

const rung_program& ProgramTables::running() const {
  const auto found = programs_.find(plc_.program().number);
  if (found == programs_.end()) throw Refused("the program is being replaced; try again");
  return *found->second;
}

std::string ProgramTables::text() const { return std::string(running().name) + ", code " + hexOf(running().code_hash); }

json ProgramTables::program(const Peer&, const json&) {
  const rung_program& program = running();
  const std::span files(program.files, program.file_count);
  return {{"program", program.name},
          {"dialect", program.dialect},
          {"compiler", program.compiler},
          {"code", hexOf(program.code_hash)},
          {"instrumented", program.instrumented != 0},
          {"files", std::vector<std::string>(files.begin(), files.end())},
          {"parts", jsonOf(runtime::partsOf(program))},
          {"rungs", program.rung_count}};
}

json ProgramTables::rungs(const Peer&, const json& request) {
  const json first = request.value("first", json(0));
  const rung_program& program = running();
  if (!first.is_number_unsigned() || first > program.rung_count)
    throw Refused("found " + first.dump() + " for \"first\", expected a number up to " +
                  std::to_string(program.rung_count));
  json list = json::array();
  const auto all = std::span(program.rungs, program.rung_count).subspan(first.get<uint32_t>());
  for (const rung_info& rung : all.first(std::min<size_t>(all.size(), kMostRungs)))
    list.push_back(jsonOf(program, rung));
  return {{"code", hexOf(program.code_hash)}, {"rungs", list}};
}

} // namespace rung::control
