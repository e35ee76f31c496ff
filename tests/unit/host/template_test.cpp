// First mapping files: they name what a program uses, and have no mistakes.
#include "machine/host/map_template.h"

#include <gtest/gtest.h>

#include "machine/host/binding.h"
#include "rung/runtime.hpp"
#include "tests/support/words.h"
#include "tests/unit/host/test_program.h"

namespace rung::host {
namespace {

std::string templateOf(const rung_program& program, const std::vector<host::UsedName>& used) {
  const Instance instance(Image::adopt(program));
  const std::string text = host::templateMap(instance.handle(), program, used);
  std::vector<std::string> errors;
  const File map = parseMap(text, "t.map", errors);
  const Binding binding = bindMap(map, instance.handle(), program, errors);
  EXPECT_EQ(test::joined(errors), "");
  EXPECT_EQ(test::joined(binding.warnings), "");
  return text;
}

constexpr const char* kHead =
    ": a first list, made of what its rungs use.\n"
    "# Remove what the machine does not connect, and give the pins names of your own. Signals "
    "that a\n# [[send]] table drives are for it alone.\n\n"
    "# What rungctl may change; by default nothing:\n# [rungctl]\n# permissions = [\"set\", \"force\", \"reload\"]\n\n";

TEST(Template, WhatTheMachineAndTheNcHave) {
  const std::string text = templateOf(testing::gskProgram(), {{"X0.0", true, false},
                                                              {"X10", true, false},
                                                              {"SYM", true, true},
                                                              {"X0.0", true, false},
                                                              {"D8:4", false, true},
                                                              {"D12:2", true, false},
                                                              {"D0:2", true, true},
                                                              {"NOWHERE", true, false}});
  const std::string begin =
      "# Pins of " + std::string(testing::gskProgram().name) + kHead +
      "[in]\n"
      "x0-0 = { type = \"bit\", name = \"X0.0\" }\n"
      "x10 = { type = \"bit\", name = \"X10\", bits = 8 }\n"
      "\n# No rung writes these relays and registers of the program; a pin, [param] or [const] may:\n"
      "# d12-2bytes = { type = \"s32\", name = \"D12:2\" }\n"
      "\n[out]\n"
      "sym = { type = \"bit\", name = \"SYM\" } # Y1.2\n"
      "\n# M, S and T functions: an edge of a pin hands one to the program.\n#\n";
  EXPECT_EQ(text.substr(0, begin.size()), begin);
}

TEST(Template, InputsThatAreNarrowerThanAPin) {
  const std::string numbers = "# Numbers of 16 bits; of a greater one the pin's upper bits are lost:\n"
                              "# x12-2bytes = { type = \"s32\", name = \"X12:2\" }\n\n";
  const std::string both = templateOf(testing::gskProgram(), {{"X10", true, false}, {"X12:2", true, false}});
  EXPECT_NE(both.find("[in]\nx10 = { type = \"bit\", name = \"X10\", bits = 8 }\n\n" + numbers), std::string::npos)
      << both;
  const std::string alone = templateOf(testing::gskProgram(), {{"X12:2", true, false}});
  EXPECT_NE(alone.find("[in]\n" + numbers), std::string::npos) << alone;
}

TEST(Template, MarksOfSignalsAreWords) {
  const std::string text =
      templateOf(testing::gskProgram(), {{"+J1", false, true}, {"-J1", false, true}, {"*ESP", false, true}});
  for (const char* row :
       {"\nj1-plus = { type = \"bit\", name = \"+J1\" }", "\nj1-minus = { type = \"bit\", name = \"-J1\" }",
        "\nesp-not = { type = \"bit\", name = \"*ESP\" }"})
    EXPECT_NE(text.find(row), std::string::npos) << row << '\n' << text;
}

TEST(Template, WhatBothSidesShareIsAComment) {
  const std::string text =
      templateOf(testing::nctProgram(),
                 {{"0056.17", true, false}, {"OUT000.00", true, true}, {"2000.00", true, true}, {"2001", false, true}});
  EXPECT_NE(text.find("[in]\n0056-17 = "), std::string::npos) << text;
  EXPECT_NE(text.find("[out]\nout000-00 = "), std::string::npos) << "a signal of the NC's interface\n" << text;
  EXPECT_NE(text.find("\n2001 = "), std::string::npos) << text;
  EXPECT_NE(text.find("\n# 2000-00 = { type = \"bit\", name = \"2000.00\" }\n"), std::string::npos) << text;
}

} // namespace
} // namespace rung::host
