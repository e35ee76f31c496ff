// Loading shared objects; the programs stand in so/*.c, so the ABI is used from plain C too.
#include "rtlib/host/so_engine.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtlib/host/instance.h"

namespace {

using namespace rung::host;
using testing::HasSubstr;

TEST(SoEngine, LoadsAndRunsAProgramMadeInC) {
  std::string error;
  const std::unique_ptr<SoEngine> engine = SoEngine::open(RUNG_TEST_SO_GOOD, error);
  ASSERT_NE(engine, nullptr) << error;
  EXPECT_EQ(engine->name(), "so");
  EXPECT_EQ(engine->path(), RUNG_TEST_SO_GOOD);
  Instance instance(engine->program());
  instance.scan();
  instance.scan();
  EXPECT_EQ(instance.read(*instance.resolve("D0")), 2u);
}

TEST(SoEngine, StaysLoadedOnlyWhenAsked) {
  std::string error;
  const auto isLoaded = [] { return dlopen(RUNG_TEST_SO_GOOD, RTLD_NOW | RTLD_NOLOAD) != nullptr; };
  ASSERT_NE(SoEngine::open(RUNG_TEST_SO_GOOD, error), nullptr) << error;
  EXPECT_FALSE(isLoaded());
  ASSERT_NE(SoEngine::open(RUNG_TEST_SO_GOOD, error, Loaded::WithProcess), nullptr) << error;
  EXPECT_TRUE(isLoaded());
}

TEST(SoEngine, RefusesAnotherVersion) {
  std::string error;
  EXPECT_EQ(SoEngine::open(RUNG_TEST_SO_VERSION, error), nullptr);
  EXPECT_THAT(error, HasSubstr("ABI version 99"));
  EXPECT_THAT(error, HasSubstr("compile it again"));
}

TEST(SoEngine, RefusesALibraryWithoutProgram) {
  std::string error;
  EXPECT_EQ(SoEngine::open(RUNG_TEST_SO_EMPTY, error), nullptr);
  EXPECT_THAT(error, HasSubstr("no symbol rung_program_v1"));
}

TEST(SoEngine, SaysWhyAFileCannotBeLoaded) {
  std::string error;
  EXPECT_EQ(SoEngine::open("no_such_file.so", error), nullptr);
  EXPECT_THAT(error, HasSubstr("cannot load no_such_file.so"));
  EXPECT_EQ(SoEngine::open("tests/unit/rtlib/so_engine_test.cpp", error), nullptr);
  EXPECT_THAT(error, HasSubstr("cannot load"));
}

} // namespace
