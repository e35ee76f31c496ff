// The control's own files with the texts of messages: where they are, and what is said about mistakes.
#include "tools/mapping/message_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "rung/runtime.hpp"
#include "tests/support/adopted_image.h"
#include "tests/support/faultless_map.h"
#include "tests/unit/mapping/test_program.h"

namespace rung::mapping {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ReadFile files(const std::map<std::string, std::string>& texts) {
  return [texts](const std::string& path) {
    const auto found = texts.find(path);
    if (found == texts.end()) throw std::runtime_error("cannot read " + path + ": No such file or directory");
    return found->second;
  };
}

std::string message(const std::string& number) {
  return "<PlcErrors>\n<PlcError No=\"" + number +
         "\" Type=\"Err\" Validity=\"Transient\"><Text>t</Text></PlcError></PlcErrors>";
}

std::vector<std::string> errorsOf(const File& map, const rung_program& program, const ReadFile& read) {
  const Image image = test::adopted(program);
  const Instance instance(image);
  std::vector<std::string> errors;
  defineMessages(map, instance.handle(), errors, read);
  return errors;
}

TEST(MessageTexts, PathsAreThoseOfTheFileThatNamesThem) {
  std::vector<std::string> errors;
  const File map = parseMap("include = \"machine/panel.map\"\nPlcErrors = \"../Plc0.PlcErrors\"\n", "maps/m.map",
                            errors, files({{"maps/machine/panel.map", "PlcErrors = [\"a.xml\", \"/etc/b.xml\"]\n"}}));
  EXPECT_THAT(errors, IsEmpty());
  std::vector<std::string> paths;
  for (const MessageFile& file : map.messageFiles) paths.push_back(file.path);
  EXPECT_THAT(paths, ElementsAre("maps/machine/a.xml", "/etc/b.xml", "maps/../Plc0.PlcErrors"));
  EXPECT_THAT(errorsOf(map, testing::technolProgram(),
                       files({{"maps/machine/a.xml", message("1")},
                              {"/etc/b.xml", message("2")},
                              {"maps/../Plc0.PlcErrors", message("3")}})),
              IsEmpty());
}

TEST(MessageTexts, MistakesHaveTheirPlace) {
  std::vector<std::string> errors;
  (void)parseMap("PlcErrors = 5\n", "m.map", errors);
  EXPECT_THAT(errors,
              ElementsAre("m.map:1:13: PlcErrors: found 5, expected the path of a file, or a list of paths; write "
                          "for example PlcErrors = \"Plc0.PlcErrors\""));
  const File map = test::faultlessMap("# texts\nPlcErrors = [\"none.xml\", \"a.xml\", \"b.xml\"]\n");
  EXPECT_THAT(
      errorsOf(map, testing::technolProgram(), files({{"a.xml", message("1")}, {"b.xml", message("1")}})),
      ElementsAre("m.map:2:14: PlcErrors: found none.xml, expected a file (cannot read none.xml: No such file or "
                  "directory); write its path, from the folder of this file",
                  HasSubstr("b.xml:2:1: message 1 is defined again; the first definition is at a.xml:2:1")));
  EXPECT_THAT(
      errorsOf(map, testing::gskProgram(),
               files({{"none.xml", message("3")}, {"a.xml", message("1")}, {"b.xml", message("2")}})),
      ElementsAre("m.map:2:14: PlcErrors: found a file of messages, expected none for this program; the dialect "
                  "has the texts of its messages in the program"));
}

} // namespace
} // namespace rung::mapping
