// The seeds of map_file that mutations shall find places by: each binds to the program of its dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "machine/host/binding.h"
#include "rung/runtime.hpp"
#include "tests/fuzz/mapped_programs.h"
#include "tests/support/compiled_program.h"

namespace rung::fuzz {
namespace {

TEST(MapFileSeeds, BindWithoutErrors) {
  for (const MappedProgram& source : kMappedPrograms) {
    const std::string path = "tests/fuzz/map_file_seeds/" + std::filesystem::path(source.file).stem().string() + ".map";
    std::ifstream file(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    ASSERT_NE(text, "") << path;
    const testing::CompiledProgram program(source.file, source.text, compiler::EngineKind::Interp);
    const Instance instance(Image::adopt(program.program()));
    std::vector<std::string> errors;
    const host::File map = host::parseMap(text, path, errors);
    host::bindMap(map, instance.handle(), program.program(), errors);
    EXPECT_THAT(errors, ::testing::IsEmpty());
  }
}

} // namespace
} // namespace rung::fuzz
