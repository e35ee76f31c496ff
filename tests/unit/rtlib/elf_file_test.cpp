// The reader of ELF files, on what linkers make and on damage.
#include "rtlib/load/elf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

namespace {

using namespace rung::runtime;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string contentsOf(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(ElfFile, SaysWhatASharedObjectExportsAndLoads) {
  const ElfObject good = readElf(contentsOf(RUNG_TEST_SO_GOOD));
  EXPECT_EQ(good.problem, "");
  EXPECT_THAT(good.exported, Contains("rung_program_table"));
  EXPECT_THAT(good.searched, IsEmpty());
  EXPECT_EQ(good.machine, machineHere());
  EXPECT_THAT(readElf(contentsOf(RUNG_TEST_SO_EMPTY)).exported, Contains("rung_test_nothing"));
  EXPECT_THAT(readElf(contentsOf(RUNG_TEST_SO_SEARCHING)).searched, ElementsAre("/opt/libraries"));
  EXPECT_THAT(readElf(contentsOf(RUNG_TEST_SO_NEEDING)).needed, Contains(StartsWith("libsodium.so")));
}

TEST(ElfFile, SaysWhatIsNotASharedObject) {
  EXPECT_EQ(readElf("").problem, "it is not an ELF file");
  EXPECT_EQ(readElf("#!/bin/sh and more than sixteen bytes").problem, "it is not an ELF file");
  std::string file = contentsOf(RUNG_TEST_SO_GOOD);
  file[5] = 2;
  EXPECT_THAT(readElf(file).problem, HasSubstr("high byte first"));
  file = contentsOf(RUNG_TEST_SO_GOOD);
  file[16] = 1;
  EXPECT_EQ(readElf(file).problem, "it is an ELF file, but not a shared object");
  EXPECT_EQ(readElf(file.substr(0, 40)).problem, "it is cut short");
}

// Under a sanitizer, a byte read outside would show.
TEST(ElfFile, DamageIsSurvived) {
  const std::string file = contentsOf(RUNG_TEST_SO_NEEDING);
  for (size_t size = 0; size < file.size(); size += 1 + size / 50) readElf(std::string(file, 0, size));
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    std::string changed = file;
    changed[4] = static_cast<char>(1 + random() % 2); // its class
    for (int edits = 0; edits < 4; ++edits) {
      const size_t at = random() % (random() % 2 == 0 ? changed.size() : 1000); // tables are at the start
      changed[at] = static_cast<char>(random() % 3 == 0 ? 0xFF : random());
    }
    readElf(changed);
  }
}

} // namespace
