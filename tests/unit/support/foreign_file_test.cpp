// Files that are recognised by their contents: those of a FANUC control, and those that are something else.
#include "ir/support/foreign_file.h"

#include <gtest/gtest.h>

#include "ir/support/encoding.h"
#include "ir/support/pmc_address.h"

namespace rung {
namespace {

std::string foreign(std::string_view bytes) { return foreignFile(bytes).value_or("a program"); }

TEST(PmcAddress, Forms) {
  const auto written = [](std::string_view text) {
    const std::optional<PmcAddress> a = pmcAddress(text);
    if (!a) return std::string("none");
    return std::to_string(a->pmc) + ":" + a->area + std::to_string(a->number) +
           (a->bit ? "." + std::to_string(*a->bit) : "");
  };
  EXPECT_EQ(written("X0008.4"), "1:X8.4");
  EXPECT_EQ(written("d100"), "1:D100");
  EXPECT_EQ(written("2:R10.0"), "2:R10.0");
  EXPECT_EQ(written("2R10.0"), "2:R10.0");
  EXPECT_EQ(written("P99999"), "1:P99999");
  for (const char* text :
       {"", "2", "2:", "X", "X8.", "X8.8", "X8.04", "X8.4 ", "B8.4", "X100000", "X0000000", "-X8", "START"})
    EXPECT_EQ(written(text), "none") << text;
}

TEST(ControlFile, Kinds) {
  EXPECT_EQ(controlFileOf("%\n(PMC=0I-F,MSID=1)\nN600000 P6\n"), ControlFile::Parameters);
  EXPECT_EQ(controlFileOf("%\n(PMC = 0I-D, MSID = 1)\n"), ControlFile::Parameters);
  EXPECT_EQ(controlFileOf("\n%\r\nN620000P00000001\r\n"), ControlFile::Parameters);
  EXPECT_EQ(controlFileOf("START,X0010.0,START BUTTON\n"), ControlFile::Symbols);
  EXPECT_EQ(controlFileOf("symbol,address,comment\nMotor,P0005,\n"), ControlFile::Symbols);
  EXPECT_EQ(controlFileOf("Mode,TIME CYCLE\nData,X10.0,Y8.0\n0,1,0\n"), ControlFile::Trace);
  EXPECT_EQ(controlFileOf("PMC SIGNAL DATA\nSET,8,(X10.0,1,BIT)\n"), ControlFile::Signals);
  EXPECT_EQ(controlFileOf("%@2-E(SYM=1 ADR=2)\nSTART,X10.0\n%\n"), std::nullopt);
  EXPECT_EQ(controlFileOf("N\n6\n"), std::nullopt);
  EXPECT_EQ(controlFileOf(""), std::nullopt);
}

TEST(ForeignFile, Programs) {
  EXPECT_EQ(foreign(""), "a program");
  EXPECT_EQ(foreign("; made by a linker\n%@A\n%@3\nRD X8.4\nWRT G8.4\nSUB 1\n%\n%@E\n"), "a program");
  EXPECT_EQ(foreign(encoded("\xEF\xBB\xBF%@3\r\nRD X8.4\r\n", "UTF-16LE").value()), "a program");
  EXPECT_EQ(foreign("N00001:\nRD X8.4\nWRT G8.4\n\x1A\0\0"), "a program");
  EXPECT_EQ(foreign("%@4\nA0.0 1000 T\xFCr offen\n%\n"), "a program");
}

TEST(ForeignFile, MnemonicFilesOfAnyName) {
  EXPECT_TRUE(isMnemonicFile("; made by a linker\n%@3\nRD X8.4\n"));
  EXPECT_FALSE(isMnemonicFile("%\nO1234\n"));
  EXPECT_TRUE(isMnemonicFile("%@A\n"));
  EXPECT_FALSE(isMnemonicFile(""));
  EXPECT_FALSE(isMnemonicFile("%@ prints an address\n%@\n%@-3\necho %@3\n")); // a script
}

TEST(ForeignFile, BinaryFilesAreNamedWithTheWayToAMnemonicFile) {
  const std::string project = foreign(std::string_view("\x01\0\x02\0LEVEL1.#LR\0\0", 16));
  EXPECT_TRUE(project.starts_with("a LADDER-III project (.LAD)")) << project;
  EXPECT_EQ(foreign(std::string_view("\xD0\xCF\x11\xE0\0\0P\0001\0.\0#\0L\0R\0", 18)), project);
  const std::string card = foreign(std::string_view("PMC\0\0\x03\xFF\x10", 8));
  EXPECT_TRUE(card.starts_with("a binary file, such as a memory card file")) << card;
  for (const std::string& text : {project, card}) {
    EXPECT_TRUE(text.find("Tool > Mnemonic Convert") != std::string::npos);
    EXPECT_LE(text.size(), 200u) << "a diagnostic cuts it";
  }
  EXPECT_TRUE(foreign("PK\x03\x04rest").starts_with("a ZIP archive"));
  EXPECT_TRUE(foreign("%PDF-1.4\n").starts_with("a PDF document"));
}

TEST(ForeignFile, TextsOfOtherControls) {
  EXPECT_TRUE(foreign("%\nO1234 (PART)\nG0 X0\n").starts_with("a part program"));
  EXPECT_TRUE(foreign("%@3\rRD X8.4\r\r").starts_with("a text without LF"));
  EXPECT_EQ(foreign("%@3\r"), "a program");
  EXPECT_EQ(foreign("%@3\r\nRD X8.4\r"), "a program");
  EXPECT_TRUE(foreign("%\n<PART>\nG0 X0\n").starts_with("a part program"));
  EXPECT_TRUE(foreign("%\nN00000Q1P00000010\nN00001Q1P0\n").starts_with("parameters of the CNC"));
  EXPECT_TRUE(foreign("LD X0.0\nOUT Y0.0\nFUNC END1\n").starts_with("a command list of a GSK control"));
  EXPECT_TRUE(foreign("dialect nct\n").starts_with("a source of Rung in another dialect"));
  EXPECT_TRUE(foreign("DATA\nMODULE_MAIN\n").starts_with("a TECHNOL source"));
  EXPECT_TRUE(foreign("ORGANIZATION_BLOCK OB1\n").starts_with("a STEP 7 source"));
  EXPECT_TRUE(
      foreign("<?xml version='1.0'?>\n<project xmlns='http://www.plcopen.org/xml/tc6'/>").starts_with("PLCopen"));
  EXPECT_TRUE(foreign("<?xml version='1.0'?>\n<RSLogix5000Content/>").starts_with("a project of a Rockwell"));
  EXPECT_TRUE(foreign("START,X10.0,BUTTON\n").starts_with("a table of symbols"));
  EXPECT_TRUE(foreign("%\nN600000 P6\n").starts_with("a list of PMC parameters"));
}

} // namespace
} // namespace rung
