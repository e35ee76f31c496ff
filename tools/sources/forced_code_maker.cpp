// See forced_code_maker.h.
#include "tools/sources/forced_code_maker.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>

#include "tools/sources/forces.h"
#include "tools/sources/limits.h"

namespace rung::sources {
namespace {

using Shared = std::shared_ptr<ForcedCodeMaker>;

bool same(const rung_forced_byte& a, const rung_forced_byte& b) {
  return a.space == b.space && a.byte == b.byte && a.mask == b.mask && a.value == b.value;
}

std::string sizeOf(const rung_program& program) {
  return std::to_string(program.chunk_count) + " chunks and " + std::to_string(program.memory_size) +
         " bytes of memory";
}

// "" or why this code cannot take the place of the program's.
std::string differenceOf(const rung_program& made, const rung_program& program) {
  if (made.chunk_count != program.chunk_count || made.memory_size != program.memory_size)
    return "the compiler process made code of " + sizeOf(made) + ", expected " + sizeOf(program);
  if (made.layout_hash != program.layout_hash || made.code_hash != program.code_hash)
    return "the compiler process made code of another program";
  return "";
}

} // namespace

// Chunk functions of a compiled program need nothing but their arguments.
struct ForcedCodeMaker::Made {
  Image image;
};

void ForcedCodeMaker::serve(const Image& image) {
  auto maker = std::make_unique<Shared>(shared_from_this());
  auto described = sized<rung_code_maker>();
  described.force = [](void* user, const rung_image* of, void*, const rung_forced_byte* forced, uint32_t count,
                       rung_forced_code* code, char* problem, size_t problemBytes) {
    std::string text;
    int32_t status = RUNG_FAILED;
    try {
      status = (*static_cast<Shared*>(user))->force(of, {forced, count}, *code, text);
    } catch (const std::exception& thrown) {
      text = thrown.what();
    }
    std::snprintf(problem, problemBytes, "%s", text.c_str());
    return status;
  };
  described.release = [](void* user) { delete static_cast<Shared*>(user); };
  described.user = maker.get();
  const int32_t status = rung_image_serve(image.handle(), &described);
  if (status == RUNG_WRONG_STATE) return; // it has been before
  check(status);
  [[maybe_unused]] const Shared* images = maker.release();
}

void ForcedCodeMaker::abandon() {
  const std::lock_guard lock(mutex_);
  compilation_.reset();
}

bool ForcedCodeMaker::isWanted(const Wanted& other) const {
  return wanted_.codeHash == other.codeHash && wanted_.layoutHash == other.layoutHash &&
         std::ranges::equal(wanted_.bytes, other.bytes, same);
}

// "" or why not.
std::string ForcedCodeMaker::begin(const rung_image* image, Wanted wanted) {
  if (wanted.bytes.size() > kMostForcedBytes)
    return "found " + std::to_string(wanted.bytes.size()) + " forced bytes, expected at most " +
           std::to_string(kMostForcedBytes);
  const std::string file = fileOf(image, kMostImage);
  if (file.empty())
    return "the program's file cannot be read, or has more than " + std::to_string(kMostImage) + " bytes";
  wanted_ = std::move(wanted);
  compilation_ = std::make_unique<Compilation>(
      packed(Forces{
          .codeHash = wanted_.codeHash, .layoutHash = wanted_.layoutHash, .bytes = wanted_.bytes, .program = file}),
      Compilation::Input::Forces);
  return "";
}

int32_t ForcedCodeMaker::force(const rung_image* image, std::span<const rung_forced_byte> forced,
                               rung_forced_code& code, std::string& problem) {
  const rung_program& program = *rung_image_program(image);
  Wanted wanted{program.code_hash, program.layout_hash, {forced.begin(), forced.end()}};
  const std::lock_guard lock(mutex_);
  if (compilation_ == nullptr || !isWanted(wanted)) {
    compilation_.reset(); // it ends before the next one begins
    problem = begin(image, std::move(wanted));
  }
  if (problem.empty() && compilation_->state() == Compilation::State::Running) {
    problem = "the code with the forced cells is being made";
    return RUNG_LATER;
  }
  const std::unique_ptr<Compilation> done = std::exchange(compilation_, nullptr);
  if (problem.empty() && done->state() != Compilation::State::Compiled) problem = done->report();
  std::unique_ptr<Made> made;
  if (problem.empty()) {
    made = std::make_unique<Made>(Image::ofMemory(done->image(), "the code with the forced cells"));
    problem = differenceOf(made->image.program(), program);
  }
  if (!problem.empty()) {
    problem = std::string("the program ") + program.name + " writes a cell that is to be forced, and " + problem;
    return RUNG_REFUSED;
  }
  code = {.chunk_fns = made->image.program().chunk_fns,
          .engine = nullptr,
          .release = [](void* owner) { delete static_cast<Made*>(owner); },
          .owner = made.get()};
  [[maybe_unused]] const Made* codes = made.release();
  return RUNG_OK;
}

} // namespace rung::sources
