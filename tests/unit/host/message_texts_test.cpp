// The control's own files with the texts of messages: where they are. What is said about mistakes is a golden
// (golden_test.cpp).
#include "machine/host/message_texts.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "rung/runtime.hpp"
#include "tests/support/words.h"
#include "tests/unit/host/test_program.h"

namespace rung::host {
namespace {

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
  const Image image = Image::adopt(program);
  const Instance instance(image);
  std::vector<std::string> errors;
  defineMessages(map, instance.handle(), errors, read);
  return errors;
}

TEST(MessageTexts, PathsAreThoseOfTheFileThatNamesThem) {
  std::vector<std::string> errors;
  const File map = parseMap("include = \"machine/panel.map\"\nPlcErrors = \"../Plc0.PlcErrors\"\n", "maps/m.map",
                            errors, files({{"maps/machine/panel.map", "PlcErrors = [\"a.xml\", \"/etc/b.xml\"]\n"}}));
  EXPECT_EQ(test::joined(errors), "");
  std::vector<std::string> paths;
  for (const MessageFile& file : map.messageFiles) paths.push_back(file.path);
  EXPECT_EQ(test::joined(paths), "maps/machine/a.xml\n/etc/b.xml\nmaps/../Plc0.PlcErrors\n");
  EXPECT_EQ(test::joined(errorsOf(map, testing::technolProgram(),
                                  files({{"maps/machine/a.xml", message("1")},
                                         {"/etc/b.xml", message("2")},
                                         {"maps/../Plc0.PlcErrors", message("3")}}))),
            "");
}

} // namespace
} // namespace rung::host
