// Reading a program's sources: which files go along.
#include "machine/rung-compile/collect.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <unistd.h>

#include "frontend/dialects/dialect.h"

namespace rung::rung_compile {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;

// The project of `rungc new`.
constexpr const char* kTemplate = "tools/rungc/templates/technol";

class Collecting : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rung-collect-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "common");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(Collecting, TakesWhatIsIncludedWhateverItsCase) {
  for (const char* name : {"main.plc", "pump.plc"}) fs::copy_file(fs::path(kTemplate) / name, folder_ / name);
  fs::copy_file(fs::path(kTemplate) / "include/names.inc", folder_ / "NAMES.INC");
  const Collected collected = collect({path("main.plc"), path("pump.plc")});
  ASSERT_TRUE(collected.sources) << collected.report;
  EXPECT_THAT(collected.sources->texts,
              ElementsAre(Key(path("NAMES.INC")), Key(path("main.plc")), Key(path("pump.plc"))));
  // The same from the texts alone.
  SourceManager sent(collected.sources->texts);
  fs::remove(folder_ / "NAMES.INC");
  std::vector<FileId> files;
  for (const std::string& name : collected.sources->files) files.push_back(sent.addFile(name).value());
  Diagnostics diagnostics;
  EXPECT_NE(frontend::findDialect("technol")->compile(sent, files, {}, diagnostics), nullptr);
}

TEST_F(Collecting, SaysWhatIsMissing) {
  EXPECT_EQ(collect({path("none.plc")}).report, "cannot read '" + path("none.plc") + "': No such file or directory");
  for (const char* name : {"main.plc", "pump.plc"}) fs::copy_file(fs::path(kTemplate) / name, folder_ / name);
  const Collected collected = collect({path("main.plc"), path("pump.plc")});
  EXPECT_FALSE(collected.sources);
  EXPECT_THAT(collected.report, HasSubstr(path("main.plc") + ":2:19: error: "));
  EXPECT_THAT(collected.diagnostics, HasSubstr("\"include-not-found\""));
}

TEST_F(Collecting, SaysWhatAFileOfAnotherKindIs) {
  write("mill.LAD", std::string("\1\0\2\0LEVEL1.#LR\0", 16));
  const Collected binary = collect({path("mill.LAD")});
  EXPECT_FALSE(binary.sources);
  EXPECT_THAT(binary.report, HasSubstr("mill.LAD' is a LADDER-III project (.LAD), which is binary"));
  EXPECT_THAT(binary.diagnostics, HasSubstr("\"foreign-file\""));
  write("mill.pmc", "%@3\nRD X8.4\nWRT G8.4\nSUB 1\nSUB 2\nSUB 64\n%\n");
  EXPECT_THAT(collect({path("mill.pmc")}).report,
              HasSubstr("mill.pmc' is a mnemonic file of a FANUC control: name it .mne, or say --dialect fanuc"));
}

TEST_F(Collecting, TakesTheProjectOfAFile) {
  write("main.pmc", "FUNC END1\nLD X0.0\nOUT Y0.0\nFUNC END2\n");
  write("rung.toml", "dialect = \"gsk\"\nfiles = [\"main.pmc\"]\nconfig.slot_steps = 500\n");
  for (const std::string& named : {path("main.pmc"), path("rung.toml"), folder_.string()}) {
    const Collected collected = collect({named});
    ASSERT_TRUE(collected.sources) << collected.report;
    EXPECT_EQ(collected.sources->dialect, "gsk");
    EXPECT_THAT(collected.sources->config, ElementsAre(Pair("slot_steps", "500")));
  }
}

TEST_F(Collecting, RefusesTooMuchWithoutReadingIt) {
  write("main.pmc", "");
  fs::resize_file(path("main.pmc"), uintmax_t{1} << 40); // a file with a hole
  EXPECT_EQ(collect({path("main.pmc")}).report, "the sources have 1099511627776 bytes, expected at most 16777216");
}

} // namespace
} // namespace rung::rung_compile
