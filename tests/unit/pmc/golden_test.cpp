// Programs beside what they become: a list or a ladder NAME.lad with NAME.ir (the module's text) or NAME.diag (what the
// compiler says).
#include <gtest/gtest.h>

#include "frontend/dialects/fanuc/fanuc.h"
#include "frontend/dialects/gsk/gsk.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "tests/support/compiled.h"
#include "tests/support/golden.h"

namespace rung::frontend::network::test {
namespace {

class PmcGolden : public testing::TestWithParam<const Dialect*> {};

TEST_P(PmcGolden, AllPrograms) {
  std::vector<std::string> extensions(GetParam()->extensions.begin(), GetParam()->extensions.end());
  extensions.emplace_back(".lad");
  rung::test::Golden golden("tests/golden/" + std::string(GetParam()->name), extensions);
  for (const std::filesystem::path& program : golden.inputs()) {
    const auto result = frontend::test::compileFiles(*GetParam(), {{program.filename(), golden.read(program)}});
    if (!result->module) {
      golden.expect(program, ".diag", result->text());
      continue;
    }
    ir::orderOperations(*result->module);
    golden.expect(program, ".ir", ir::print(*result->module));
  }
}

INSTANTIATE_TEST_SUITE_P(Dialects, PmcGolden, testing::Values(&fanuc::kFanuc, &gsk::kGsk),
                         [](const auto& tested) { return std::string(tested.param->name); });

} // namespace
} // namespace rung::frontend::network::test
