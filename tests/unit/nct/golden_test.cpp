// Programs beside what they become: NAME.lad with NAME.ir (the module's text) or NAME.diag (the diagnostics).
// RUNG_UPDATE=1 writes the expected files anew; a review reads the difference.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

#include "frontend/dialects/nct/nct.h"
#include "ir/support/diag_render.h"
#include "ir/text/text.h"

namespace rung::nct {
namespace {

const std::string kFolder = "tests/golden/nct";

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".lad") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(NctGolden, AllPrograms) {
  ASSERT_FALSE(programs().empty()) << "run in the root of the repository";
  for (const std::string& name : programs()) {
    SourceManager sources;
    Diagnostics diagnostics;
    // The text is named as a user would name it, whatever the folder of the repository.
    const FileId file = sources.addBuffer(name + ".lad", readFile(kFolder + "/" + name + ".lad"));
    const std::unique_ptr<ir::Module> module = kNct.compile(sources, {&file, 1}, {}, diagnostics);
    const std::string text = module ? ir::print(*module) : renderText(diagnostics, sources);
    const std::string path = kFolder + "/" + name + (module ? ".ir" : ".diag");
    if (std::getenv("RUNG_UPDATE") != nullptr) std::ofstream(path, std::ios::binary) << text;
    EXPECT_EQ(readFile(path), text) << path;
    if (!module) continue;
    const ir::ParseOutcome again = ir::parse(text);
    ASSERT_TRUE(again.module) << again.error.line << ": " << again.error.message;
    EXPECT_EQ(ir::print(*again.module), text);
  }
}

} // namespace
} // namespace rung::nct
