// See forced_code_maker.h.
#include "machine/compile/forced_code_maker.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "machine/compile/sources.h"

namespace rung::compile {

namespace {

using Shared = std::shared_ptr<ForcedCodeMaker>;

bool same(const rung_forced_byte& a, const rung_forced_byte& b) {
  return a.space == b.space && a.byte == b.byte && a.mask == b.mask && a.value == b.value;
}

std::string sizeOf(const rung_program& program) {
  return std::to_string(program.chunk_count) + " chunks and " + std::to_string(program.memory_size) +
         " bytes of memory";
}

// Throws if the new code cannot replace that of the program.
void checkSame(const rung_program& made, const rung_program& program) {
  if (made.chunk_count != program.chunk_count || made.memory_size != program.memory_size)
    throw std::runtime_error("the compiler process made code of " + sizeOf(made) + ", expected " + sizeOf(program));
  if (made.layout_hash != program.layout_hash || made.code_hash != program.code_hash)
    throw std::runtime_error("the compiler process made code of another program");
}

// The whole file that was loaded.
std::string loadedFile(const rung_image* image) {
  std::string file = fileOf(image, kMostImage);
  if (file.empty())
    throw std::runtime_error("its file cannot be read, or has more than " + std::to_string(kMostImage) + " bytes");
  return file;
}

} // namespace

// The image must stay loaded while its chunk functions are in use; they need nothing but their arguments.
struct ForcedCodeMaker::Made {
  Image image;
};

void ForcedCodeMaker::serve(const Image& image) {
  auto maker = std::make_unique<Shared>(shared_from_this());
  auto described = sized<rung_code_maker>();
  described.force = [](void* user, const rung_image* of, void*, const rung_forced_byte* forced, uint32_t count,
                       rung_forced_code* code, char* problem, size_t problemBytes) {
    const rung_program& program = *rung_image_program(of);
    try {
      if ((*static_cast<Shared*>(user))->force(of, program, {forced, count}, *code)) return int32_t{RUNG_OK};
      std::snprintf(problem, problemBytes, "%s is being compiled with the forced variables", program.name);
      return int32_t{RUNG_LATER};
    } catch (const std::exception& thrown) {
      std::snprintf(problem, problemBytes, "rungs of %s write a variable that is to be forced: %s", program.name,
                    thrown.what());
      return int32_t{RUNG_REFUSED};
    }
  };
  described.release = [](void* user) { delete static_cast<Shared*>(user); };
  described.user = maker.get();
  const int32_t status = rung_image_serve(image.handle(), &described);
  if (status == RUNG_WRONG_STATE) return; // the image already has a maker
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

void ForcedCodeMaker::begin(const rung_image* image, Wanted wanted) {
  if (wanted.bytes.size() > kMostForcedBytes)
    throw std::runtime_error("found " + std::to_string(wanted.bytes.size()) + " forced bytes, expected at most " +
                             std::to_string(kMostForcedBytes));
  const std::string file = loadedFile(image);
  wanted_ = std::move(wanted);
  compilation_ = std::make_unique<Compilation>(
      packed(Forces{
          .codeHash = wanted_.codeHash, .layoutHash = wanted_.layoutHash, .bytes = wanted_.bytes, .program = file}),
      Compilation::Input::Forces);
}

bool ForcedCodeMaker::force(const rung_image* image, const rung_program& program,
                            std::span<const rung_forced_byte> forced, rung_forced_code& code) {
  Wanted wanted{program.code_hash, program.layout_hash, {forced.begin(), forced.end()}};
  const std::lock_guard lock(mutex_);
  if (compilation_ == nullptr || !isWanted(wanted)) {
    compilation_.reset(); // ends the previous process before the next one begins
    begin(image, std::move(wanted));
  }
  if (compilation_->state() == Compilation::State::Running) return false;
  const std::unique_ptr<Compilation> done = std::exchange(compilation_, nullptr);
  if (done->state() != Compilation::State::Compiled) throw std::runtime_error(done->report());
  auto made = std::make_unique<Made>(Image::ofMemory(done->image(), "the code with the forced variables"));
  checkSame(made->image.program(), program);
  code = {.chunk_fns = made->image.program().chunk_fns,
          .engine = nullptr,
          .release = [](void* owner) { delete static_cast<Made*>(owner); },
          .owner = made.get()};
  [[maybe_unused]] const Made* codes = made.release();
  return true;
}

// A line with the version; the hashes of code and layout (8 bytes each), the number of forced bytes (4), for each of
// them space, byte, mask and value (4 each); the file. Numbers have the low byte first.

namespace {

constexpr std::string_view kHead = "rung-forces 1\n";
constexpr unsigned kHashBytes = 8;
constexpr unsigned kFieldBytes = 4;

std::pair<uint32_t, uint32_t> placeOf(const rung_forced_byte& byte) { return {byte.space, byte.byte}; }

// Checks the conditions that rung_forced_byte documents.
bool isForced(const rung_forced_byte& byte) {
  return byte.mask != 0 && byte.mask <= 0xFF && (byte.value & ~byte.mask) == 0;
}

std::string problemOf(const std::vector<rung_forced_byte>& bytes) {
  if (bytes.empty()) return "found no forced byte, expected one at least";
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (!isForced(bytes[i])) return "found a forced byte without bits, or with others than its own";
    if (i != 0 && placeOf(bytes[i - 1]) >= placeOf(bytes[i])) return "found forced bytes that are not in their order";
  }
  return "";
}

} // namespace

std::string packed(const Forces& forces) {
  std::string out(kHead);
  putNumber(out, forces.codeHash, kHashBytes);
  putNumber(out, forces.layoutHash, kHashBytes);
  putNumber(out, forces.bytes.size(), kFieldBytes);
  for (const rung_forced_byte& byte : forces.bytes)
    for (const uint32_t field : {byte.space, byte.byte, byte.mask, byte.value}) putNumber(out, field, kFieldBytes);
  out += forces.program;
  return out;
}

std::optional<Forces> unpackedForces(std::string_view bytes, std::string& problem) {
  ByteReader reader(bytes);
  const bool known = reader.take(kHead.size()) == kHead;
  Forces forces;
  forces.codeHash = reader.takeNumber(kHashBytes);
  forces.layoutHash = reader.takeNumber(kHashBytes);
  const uint64_t count = reader.takeNumber(kFieldBytes);
  const auto field = [&reader] { return static_cast<uint32_t>(reader.takeNumber(kFieldBytes)); };
  for (uint64_t i = 0; i < count && i < kMostForcedBytes && reader.good(); ++i) {
    const uint32_t space = field(), byte = field(), mask = field(), value = field();
    forces.bytes.push_back({space, byte, mask, value});
  }
  forces.program = reader.rest();
  if (!known || !reader.good())
    problem = "found bytes that are not forces, or not all of them";
  else if (count > kMostForcedBytes)
    problem = "found " + std::to_string(count) + " forced bytes, expected at most " + std::to_string(kMostForcedBytes);
  else
    problem = problemOf(forces.bytes);
  return problem.empty() ? std::optional(std::move(forces)) : std::nullopt;
}

} // namespace rung::compile
