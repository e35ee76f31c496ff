// Packs and unpacks the IR (see embedded_ir.h). The section contains the size of the text (8 bytes, low byte first),
// and the text compressed by zlib: a line with the passes, then the module as its front end built it.
#include "compiler/embedded_ir.h"

#include <array>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <zlib.h>

#include "codegen/llvm/sections.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"

namespace rung::compiler {
namespace {

constexpr std::string_view kSection = ".rung.ir";
constexpr uint64_t kMostText = uint64_t{1} << 30;

std::string headOf(const ir::PassOptions& passes) {
  return fmt::format("rung-ir 1 optimise {} instrument {}\n", passes.optimise ? 1 : 0, passes.instrument ? 1 : 0);
}

// False: the text does not begin with a head of this version.
bool takeHead(std::string_view& text, ir::PassOptions& passes) {
  for (const bool optimise : {false, true}) {
    for (const bool instrument : {false, true}) {
      passes = {.optimise = optimise, .instrument = instrument};
      const std::string head = headOf(passes);
      if (!text.starts_with(head)) continue;
      text.remove_prefix(head.size());
      return true;
    }
  }
  return false;
}

std::string packed(const std::string& text) {
  const uint64_t size = text.size();
  std::string out(sizeof size + compressBound(size), '\0');
  std::memcpy(out.data(), &size, sizeof size);
  uLongf room = out.size() - sizeof size;
  compress2(reinterpret_cast<Bytef*>(out.data() + sizeof size), &room, reinterpret_cast<const Bytef*>(text.data()),
            size, Z_BEST_SPEED);
  out.resize(sizeof size + room);
  return out;
}

std::optional<std::string> unpacked(std::string_view packed) {
  uint64_t size = 0;
  if (packed.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, packed.data(), sizeof size);
  packed.remove_prefix(sizeof size);
  if (size > kMostText) return std::nullopt;
  std::string text(size, '\0');
  uLongf done = size;
  const int result = uncompress(reinterpret_cast<Bytef*>(text.data()), &done,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (result != Z_OK || done != size) return std::nullopt;
  return text;
}

} // namespace

Result<std::string> withIr(std::string_view object, const Compiled& compiled) {
  return codegen::withSection(object, kSection, packed(headOf(compiled.passes) + ir::print(*compiled.built)));
}

Result<Compiled> irOf(std::string_view object, const Hashes& program) {
  const Result<std::optional<std::string>> found = codegen::sectionOf(object, kSection);
  if (!found.ok()) return found.failure();
  const std::optional<std::string>& section = found.value();
  if (!section) return failure("it carries no IR: it was built with --no-ir, or by another linker");
  const std::optional<std::string> text = unpacked(*section);
  if (!text) return failure("its IR is damaged");
  std::string_view rest = *text;
  Compiled out;
  if (!takeHead(rest, out.passes)) return failure("its IR has another version; compile it again");
  ir::ParseOutcome parsed = ir::parse(rest);
  if (!parsed.module) return failure("its IR cannot be read: " + parsed.error.message);
  if (!ir::verify(*parsed.module, ir::Mode::Built).empty()) return failure("its IR is not valid");
  out.built = std::make_unique<ir::Module>(std::move(*parsed.module));
  out.module = std::make_unique<ir::Module>(*out.built);
  out.shape = std::make_unique<ir::Module>();
  ir::runPasses(*out.module, out.passes, out.shape.get());
  out.layout = std::make_unique<ir::Layout>(ir::Layout(*out.shape, {}).over(*out.module));
  out.codeHash = ir::hashOf(*out.module);
  if (Hashes{out.codeHash, out.layout->memory().hash()} != program)
    return failure("this compiler compiles its IR differently; compile it again");
  return out;
}

} // namespace rung::compiler
