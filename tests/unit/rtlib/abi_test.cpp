// C and C++ see the same structures; the offsets stand in program_c11.c.
#include <gtest/gtest.h>

#include <type_traits>

#include "rung/program.h"

extern "C" uint32_t rung_test_c11_program_size(void);

namespace {

TEST(Abi, CAndCxxAgree) { EXPECT_EQ(rung_test_c11_program_size(), sizeof(rung_program)); }

TEST(Abi, StructuresArePlain) {
  EXPECT_TRUE(std::is_standard_layout_v<rung_program> && std::is_trivial_v<rung_program>);
  EXPECT_TRUE(std::is_standard_layout_v<rung_ctx> && std::is_trivial_v<rung_ctx>);
  EXPECT_TRUE(std::is_standard_layout_v<rung_host_api> && std::is_trivial_v<rung_host_api>);
}

} // namespace
