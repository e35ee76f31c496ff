// Packs and unpacks the IR (see embedded_ir.h). The section contains the size of the text (8 bytes, low byte first),
// and the text compressed by zlib: a line with the passes, then the module as its front end built it.
#include "compiler/embedded_ir.h"

#include <array>
#include <charconv>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <zlib.h>

#include "codegen/llvm/sections.h"
#include "ir/text/text.h"
#include "ir/verify/verify.h"
#include "rtlib/load/seal.h"

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

// A line for each mark at the end, which is a comment for the parser of the IR.

constexpr std::string_view kMark = "; mark ";

std::string marksText(const ir::Module& module, const ir::Marks& marks) {
  std::string text;
  for (uint32_t r = 0; r < module.routines.size(); ++r)
    for (uint32_t i = 0; i < module.routines[r].rungs.size(); ++i)
      for (const ir::Mark& mark : marks.of(ir::RoutineId{r}, i))
        text += fmt::format("{}{} {} {} {} {} {} {}\n", kMark, r, i, static_cast<int>(mark.kind), mark.value.index,
                            mark.line, mark.column, mark.text);
  return text;
}

bool takeNumber(std::string_view& line, uint32_t& number) {
  const auto read = std::from_chars(line.data(), line.data() + line.size(), number);
  if (read.ec != std::errc() || read.ptr == line.data() + line.size() || *read.ptr != ' ') return false;
  line.remove_prefix(static_cast<size_t>(read.ptr - line.data()) + 1);
  return true;
}

// False: a line is not a mark of this module.
bool takeMark(std::string_view line, const ir::Module& module, ir::Marks& marks) {
  uint32_t routine = 0, rung = 0, kind = 0;
  ir::Mark mark;
  if (!takeNumber(line, routine) || !takeNumber(line, rung) || !takeNumber(line, kind) ||
      !takeNumber(line, mark.value.index) || !takeNumber(line, mark.line) || !takeNumber(line, mark.column))
    return false;
  if (routine >= module.routines.size() || rung >= module.routines[routine].rungs.size()) return false;
  const ir::Rung& of = module.routines[routine].rungs[rung];
  if (mark.value.index >= of.values.size() || kind > static_cast<uint32_t>(ir::MarkKind::Input)) return false;
  mark.kind = static_cast<ir::MarkKind>(kind);
  mark.text = line;
  marks.add(ir::RoutineId{routine}, rung, std::move(mark));
  return true;
}

bool takeMarks(std::string_view text, const ir::Module& module, ir::Marks& marks) {
  for (size_t at = text.find(fmt::format("\n{}", kMark)); at != std::string_view::npos;) {
    const std::string_view line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    if (!takeMark(line.substr(kMark.size()), module, marks)) return false;
    at = text.find(fmt::format("\n{}", kMark), at + 1 + line.size());
  }
  return true;
}

Result<std::string> textIn(std::string_view object) {
  const Result<std::optional<std::string>> found = codegen::sectionOf(object, kSection);
  if (!found.ok()) return found.failure();
  if (!found.value()) return failure("it carries no IR: it was built with --no-ir, or by another linker");
  std::optional<std::string> text = unpacked(*found.value());
  if (!text) return failure("its IR is damaged");
  return *std::move(text);
}

constexpr const char* kOtherCompiler = "this compiler compiles its IR differently; compile it again";

} // namespace

std::string irText(const Compiled& compiled) {
  return headOf(compiled.passes) + ir::print(*compiled.built) + marksText(*compiled.built, compiled.marks);
}

Result<Compiled> compiledOf(std::string_view text) {
  Compiled out;
  if (!takeHead(text, out.passes)) return failure("its IR has another version; compile it again");
  ir::ParseOutcome parsed = ir::parse(text);
  if (!parsed.module) return failure("its IR cannot be read: " + parsed.error.message);
  if (!ir::verify(*parsed.module, ir::Mode::Built).empty()) return failure("its IR is not valid");
  out.built = std::make_unique<ir::Module>(std::move(*parsed.module));
  if (!takeMarks(text, *out.built, out.marks)) return failure("its marks cannot be read");
  out.dialect = frontend::findDialect(out.built->dialect);
  out.uses = std::make_unique<ir::Uses>(*out.built);
  out.module = std::make_unique<ir::Module>(*out.built);
  out.shape = std::make_unique<ir::Module>();
  ir::runPasses(*out.module, out.passes, out.shape.get());
  out.layout = std::make_unique<ir::Layout>(ir::Layout(*out.shape, {}).over(*out.module));
  out.codeHash = ir::hashOf(*out.module);
  return out;
}

Result<Compiled> programOf(std::string_view file, uint64_t codeHash) {
  const bool isObject = file.starts_with("\x7F"
                                         "ELF");
  const Result<std::string> text = isObject ? textIn(runtime::readSealed(file).image) : std::string(file);
  if (!text.ok()) return text.failure();
  Result<Compiled> compiled = compiledOf(text.value());
  if (compiled.ok() && compiled.value().codeHash != codeHash) return failure(kOtherCompiler);
  return compiled;
}

Result<std::string> withIr(std::string_view object, const Compiled& compiled) {
  return codegen::withSection(object, kSection, packed(irText(compiled)));
}

Result<Compiled> irOf(std::string_view object, const Hashes& program) {
  const Result<std::string> text = textIn(object);
  if (!text.ok()) return text.failure();
  Result<Compiled> compiled = compiledOf(text.value());
  if (compiled.ok() && Hashes{compiled.value().codeHash, compiled.value().layout->memory().hash()} != program)
    return failure(kOtherCompiler);
  return compiled;
}

} // namespace rung::compiler
