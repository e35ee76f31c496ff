// Passes on modules in the text form (see passes_testing.h).
#include "tests/unit/ir_transforms/passes_testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "ir/verify/verify.h"

namespace rung::ir {
namespace {

constexpr std::string_view kHead = R"(module "test" dialect "test"
file "t.lad"
space B unit 1 units 64
space D unit 4 units 64
slot $0 i32 init 0 "kept"
slot $1 i32 init 0 transient "r1"
slot $2 bit init 0 transient "r2"
fault F
service S
)";

} // namespace

Module moduleOf(const std::vector<RoutineText>& routines, const std::vector<std::string>& entries, uint32_t parts) {
  std::string text(kHead);
  for (const RoutineText& routine : routines) {
    text += fmt::format("routine {} {{\n", routine.name);
    for (size_t i = 0; i < routine.rungs.size(); ++i)
      text += fmt::format("rung {} \"\" loc(\"t.lad\":{}:1-{}) key(1) weight 1 {{\n{}\n{}\n", i, i + 1, i + 1,
                          routine.rungs[i].lines, routine.rungs[i].transfer);
    text += "}\n";
  }
  for (size_t i = 0; i < entries.size(); ++i)
    text += fmt::format("task T{} entry {} period 1000 budget 1000 fault F parts {} {{\n}}\n", i, entries[i],
                        i == 0 ? parts : 1);
  text += "schedule main T0 fast -\n";
  ParseOutcome outcome = parse(text);
  if (!outcome.module) {
    ADD_FAILURE() << text << outcome.error.line << ": " << outcome.error.message;
    return {};
  }
  const std::vector<VerifyError> errors = verify(*outcome.module, Mode::Final);
  EXPECT_TRUE(errors.empty()) << render(*outcome.module, errors);
  return std::move(*outcome.module);
}

Module moduleOf(std::string_view lines, std::string_view transfer) {
  // Rungs 1 to 3 and the routine Q are there for transfers to go to.
  const RungText nothing;
  return moduleOf({{"R", {{std::string(lines), std::string(transfer)}, nothing, nothing, nothing}}, {"Q", {nothing}}},
                  {"R"});
}

std::string bodyOf(const Module& module, RoutineId routine, uint32_t rung) {
  const std::string text = printRung(module, routine, rung);
  std::string body;
  for (size_t at = text.find('\n') + 1; at < text.size();) {
    const size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    line.erase(0, line.find_first_not_of(' '));
    if (const size_t remark = line.find(" ; "); remark != std::string::npos) line.resize(remark);
    if (line != "}") body += line + "\n";
    at = end + 1;
  }
  return body;
}

std::string after(PassFunction pass, std::string_view lines, std::string_view transfer) {
  Module module = moduleOf(lines, transfer);
  if (module.routines.empty()) return "no module";
  pass(module);
  const std::vector<VerifyError> errors = verify(module, Mode::Final);
  EXPECT_TRUE(errors.empty()) << render(module, errors);
  return bodyOf(module);
}

} // namespace rung::ir
