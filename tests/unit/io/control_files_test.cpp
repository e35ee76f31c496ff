// The control's XML files: what they say. What is said about a mistake in them is a golden (golden_test.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "machine/host/control_files.h"
#include "sim/simulated_nc.h"
#include "tests/support/words.h"

namespace rung::host {
namespace {

using testing::HasSubstr;
using Kind = ControlFileKind;

std::string message(std::string_view attributes) {
  return "<PlcErrors>\n<PlcError " + std::string(attributes) + "><Text>t</Text></PlcError></PlcErrors>";
}

// The examples of the manual (l.5300-5330).
TEST(ControlFiles, Messages) {
  ControlFiles files;
  EXPECT_EQ(parseControlFile(Kind::Messages, "Plc0.PlcErrors", R"(<?xml version="1.0" encoding="utf-8"?>
<PlcErrors>
<PlcError No="3" Type="Info" Validity="Persistent">
<Text>
Text pro PLC hlášení číslo 3.
</Text>
</PlcError>
<!-- dvě hodnoty -->
<PlcError No="4" Type="ErrCritical" Validity="Transient">
  <Text>
    Text pro chybu číslo 4.
    (1.hodnota: %d, 2.hodnota %X) 100 % &lt;
  </Text>
</PlcError>
</PlcErrors>
)",
                             files),
            "");
  ASSERT_EQ(files.messages.size(), 2u);
  EXPECT_EQ(files.messages[0].number, 3u);
  EXPECT_EQ(files.messages[0].kind, nc::technol::MessageKind::Info);
  EXPECT_EQ(files.messages[0].validity, nc::technol::Validity::Persistent);
  EXPECT_EQ(files.messages[0].text, "Text pro PLC hlášení číslo 3.");
  EXPECT_EQ(files.messages[0].place, "Plc0.PlcErrors:3:1");
  EXPECT_EQ(files.messages[1].kind, nc::technol::MessageKind::ErrCritical);
  EXPECT_EQ(files.messages[1].validity, nc::technol::Validity::Transient);
  EXPECT_EQ(files.messages[1].text, "Text pro chybu číslo 4. (1.hodnota: %d, 2.hodnota %X) 100 % <");
}

TEST(ControlFiles, EveryKindAndBothValidities) {
  const std::string_view kinds[] = {"ErrCritical", "Err", "Wrn1", "Wrn2", "Wrn3", "Info", "Event"};
  ControlFiles files;
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(parseControlFile(Kind::Messages, "f",
                               message("No='" + std::to_string(i) + "' Type='" + std::string(kinds[i]) +
                                       "' Validity='" + (i % 2 ? "Persistent'" : "Transient'")),
                               files),
              "");
  ASSERT_EQ(files.messages.size(), 7u);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(static_cast<int>(files.messages[static_cast<size_t>(i)].kind), i);
    EXPECT_EQ(static_cast<int>(files.messages[static_cast<size_t>(i)].validity), i % 2);
  }
}

TEST(ControlFiles, TwiceDefinedIsAMistakeAlsoOverFiles) {
  ControlFiles files;
  const std::string one = message("No='7' Type='Err' Validity='Transient'");
  EXPECT_EQ(parseControlFile(Kind::Messages, "a", one, files), "");
  EXPECT_EQ(test::lacking(parseControlFile(Kind::Messages, "b", one, files), {"b:2:1: ", "7", "a:2:1"}), "");
  EXPECT_EQ(files.messages.size(), 1u);
}

// l.16294-16305; the files SAVars and Commands.
TEST(ControlFiles, Constants) {
  ControlFiles files;
  EXPECT_EQ(parseControlFile(Kind::Constants, "f", R"(<PlcConstants>
<Constant ID="OFFS_R_FEED" Value="SA0REAL"></Constant> <!-- Feed -->
<Constant ID="PUMP_START" Value="12"/>
</PlcConstants>)",
                             files),
            "");
  ASSERT_EQ(files.constants.size(), 2u);
  EXPECT_EQ(files.constants[0].id, "OFFS_R_FEED");
  EXPECT_EQ(files.constants[0].value, "SA0REAL");
  EXPECT_EQ(files.constants[1].value, "12");
  EXPECT_EQ(files.constants[1].place, "f:3:1");
}

// The channel's configuration holds much of other parts of the control (l.5575-5757, l.13280-13291, l.16105).
TEST(ControlFiles, Channel) {
  ControlFiles files;
  EXPECT_EQ(parseControlFile(Kind::Channel, "f", R"(<ChannelConfig>
 <Axes Count="3"><Axis Name="X"/>text</Axes>
 <Plc Debug="1">
  <PlcParam ID="TIM_WATER" Type="Int">4</PlcParam>
  <PlcParam ID="NAME" Type="String"> Vrtačka &amp; fréza </PlcParam>
  <Input ID="inLimX" Port="1" Bit="2" Invert="0" Default="0" Connected="1"></Input>
  <Output ID="outXEn" Port="1" Bit="0" Invert="1" Default="1"/>
  <AnalogInput ID="PlasmaVoltage" PhysNo="2" Scale="28.82" Offset="0" Default="120.0" MinVal="20.0" Maxval="250.0" Connected="1"/>
  <AnalogOutput ID="CutFlow"/>
  <Other><PlcParam ID="x"/></Other>
 </Plc>
 <Connections>
  <Connection Source="PLC.Output.flOut1" Destination="PLC.Input.flIn1" Invert="1" Scale="2.5" Offset="-1" Connected="1"></Connection>
  <Connection Source="a" Destination="b"/>
 </Connections>
</ChannelConfig>)",
                             files),
            "");
  ASSERT_EQ(files.parameters.size(), 2u);
  EXPECT_EQ(files.parameters[0].id, "TIM_WATER");
  EXPECT_EQ(files.parameters[0].type, ParameterType::Int);
  EXPECT_EQ(files.parameters[0].value, "4");
  EXPECT_EQ(files.parameters[1].value, "Vrtačka & fréza");
  ASSERT_EQ(files.terminals.size(), 4u);
  EXPECT_EQ(files.terminals[0].kind, TerminalKind::Input);
  EXPECT_EQ(files.terminals[0].port, 1u);
  EXPECT_EQ(files.terminals[0].bit, 2u);
  EXPECT_TRUE(files.terminals[0].connected);
  EXPECT_FALSE(files.terminals[0].invert);
  EXPECT_EQ(files.terminals[1].kind, TerminalKind::Output);
  EXPECT_TRUE(files.terminals[1].invert);
  EXPECT_FALSE(files.terminals[1].connected);
  EXPECT_EQ(files.terminals[1].otherwise, 1.0);
  EXPECT_EQ(files.terminals[2].kind, TerminalKind::AnalogInput);
  EXPECT_EQ(files.terminals[2].physical, 2u);
  EXPECT_EQ(files.terminals[2].scale, 28.82);
  EXPECT_EQ(files.terminals[2].otherwise, 120.0);
  EXPECT_EQ(files.terminals[2].least, 20.0);
  EXPECT_EQ(files.terminals[2].most, 250.0);
  EXPECT_EQ(files.terminals[3].kind, TerminalKind::AnalogOutput);
  EXPECT_EQ(files.terminals[3].scale, 1.0);
  EXPECT_FALSE(files.terminals[3].least.has_value());
  ASSERT_EQ(files.connections.size(), 2u);
  EXPECT_TRUE(files.connections[0].invert);
  EXPECT_EQ(files.connections[0].scale, 2.5);
  EXPECT_EQ(files.connections[0].offset, -1.0);
  EXPECT_TRUE(files.connections[0].connected);
  EXPECT_FALSE(files.connections[1].connected);
  EXPECT_EQ(files.connections[1].place, "f:14:3");
}

TEST(ControlFiles, EncodingsOfOneByte) {
  const std::string body = "'?><PlcErrors><PlcError No='1' Type='Err' Validity='Transient'><Text>";
  for (const auto& [encoding, text] : {std::pair<std::string, std::string>("windows-1250", "P\xF8\xEDli\x9A \x8E"),
                                       {"Windows-1250", "P\xF8\xEDli\x9A \x8E"},
                                       {"cp852", "P\xFD\xA1li\xE7 \xA6"},
                                       {"utf-8", "Příliš Ž"}}) {
    ControlFiles files;
    EXPECT_EQ(parseControlFile(
                  Kind::Messages, "f",
                  "<?xml version='1.0' encoding='" + encoding + body + text + "</Text></PlcError></PlcErrors>", files),
              "")
        << encoding;
    ASSERT_EQ(files.messages.size(), 1u) << encoding;
    EXPECT_EQ(files.messages[0].text, "Příliš Ž") << encoding;
  }
}

TEST(ControlFiles, ManyMistakesAreCounted) {
  std::string text = "<PlcErrors>";
  for (int i = 0; i < 150; ++i) text += "<a/>";
  ControlFiles files;
  const std::string found = parseControlFile(Kind::Messages, "f", text + "</PlcErrors>", files);
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 100);
  EXPECT_THAT(found, HasSubstr("\nf: and 50 more mistakes"));
}

// Each beginning of a good file is a bad file, or one that says less; nothing else happens.
TEST(ControlFiles, CutAnywhere) {
  const std::string whole = "<?xml version='1.0'?><C><Plc><PlcParam ID='A' Type='Int'>4</PlcParam><Input ID='B' "
                            "Port='1'/></Plc><Connections><Connection Source='a' Destination='b'/></Connections></C>";
  for (size_t length = 0; length < whole.size(); ++length) {
    ControlFiles files;
    EXPECT_NE(parseControlFile(Kind::Channel, "f", std::string_view(whole).substr(0, length), files), "") << length;
  }
}

TEST(ControlFiles, ManyMessages) {
  std::string text = "<PlcErrors>\n";
  for (int i = 0; i < 60000; ++i)
    text += "<PlcError No='" + std::to_string(i) + "' Type='Err' Validity='Transient'><Text>t</Text></PlcError>\n";
  ControlFiles files;
  EXPECT_EQ(parseControlFile(Kind::Messages, "f", text + "</PlcErrors>", files), "");
  EXPECT_EQ(files.messages.size(), 60000u);
}

TEST(ControlFiles, FilesThatCannotBeRead) {
  ControlFiles files;
  const std::filesystem::path folder = testing::TempDir();
  EXPECT_THAT(readControlFile(Kind::Messages, (folder / "there-is-no-such-file").string(), files),
              HasSubstr("there-is-no-such-file: cannot be read: No such file"));
  EXPECT_THAT(readControlFile(Kind::Messages, folder.string(), files), HasSubstr("cannot be read: it is a folder"));
  const std::string path = (folder / "technol_control_files_test.PlcConstants").string();
  std::ofstream(path) << "<PlcConstants><Constant ID='A' Value='1'/></PlcConstants>";
  EXPECT_EQ(readControlFile(Kind::Constants, path, files), "");
  EXPECT_EQ(files.constants.size(), 1u);
  std::filesystem::remove(path);
}

TEST(ControlFiles, TheModelReadsThemBesideTheScenario) {
  const std::filesystem::path folder = testing::TempDir();
  const std::string name = "technol_control_files_test.PlcConstants";
  std::ofstream(folder / name) << "<PlcConstants>\n<Constant ID='A' Value='x'/></PlcConstants>";
  const std::unique_ptr<sim::SimulatedNc> model = sim::makeSimulatedTechnol();
  model->setFolder(folder.string());
  EXPECT_EQ(test::lacking(model->config("PlcConstants", name), {(folder / name).string() + ":2:1: ", "'A'", "'x'"}),
            "");
  EXPECT_EQ(test::lacking(model->config("PlcErrors", "there-is-no-such-file"), {"there-is-no-such-file"}), "");
  EXPECT_EQ(model->config("PlcConfig", name), "");
  EXPECT_EQ(test::lacking(model->config("PlcErrors", (folder / name).string()), {":2:1: ", "<Constant>"}), "");
  std::filesystem::remove(folder / name);
}

} // namespace
} // namespace rung::host
