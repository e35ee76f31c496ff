// Reads and adds sections, with LLVM's object tools (see sections.h).
#include "codegen/llvm/sections.h"

#include <fmt/format.h>
#include <llvm/ADT/SmallString.h>
#include <llvm/ObjCopy/ConfigManager.h>
#include <llvm/ObjCopy/ObjCopy.h>
#include <llvm/Object/ELFObjectFile.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/raw_ostream.h>

namespace rung::codegen {
namespace {

llvm::StringRef refOf(std::string_view text) { return {text.data(), text.size()}; }

llvm::Expected<std::unique_ptr<llvm::object::ObjectFile>> read(std::string_view object) {
  return llvm::object::ObjectFile::createELFObjectFile(llvm::MemoryBufferRef(refOf(object), "object"));
}

} // namespace

Result<std::string> withSection(std::string_view object, std::string_view name, std::string_view contents) {
  llvm::Expected<std::unique_ptr<llvm::object::ObjectFile>> file = read(object);
  if (!file) return failure(fmt::format("the shared object cannot be read: {}", llvm::toString(file.takeError())));
  llvm::objcopy::ConfigManager config;
  config.Common.AddSection.emplace_back(refOf(name),
                                        llvm::MemoryBuffer::getMemBuffer(refOf(contents), "contents", false));
  llvm::SmallString<0> out;
  llvm::raw_svector_ostream stream(out);
  if (llvm::Error error = llvm::objcopy::executeObjcopyOnBinary(config, **file, stream))
    return failure(fmt::format("no section can be added: {}", llvm::toString(std::move(error))));
  return std::string(out.begin(), out.end());
}

Result<std::optional<std::string>> sectionOf(std::string_view object, std::string_view name) {
  llvm::Expected<std::unique_ptr<llvm::object::ObjectFile>> file = read(object);
  if (!file) {
    llvm::consumeError(file.takeError());
    return std::optional<std::string>();
  }
  for (const llvm::object::SectionRef& section : (*file)->sections()) {
    llvm::Expected<llvm::StringRef> found = section.getName();
    llvm::Expected<llvm::StringRef> contents = section.getContents();
    const bool good = static_cast<bool>(found) && static_cast<bool>(contents);
    if (!found) llvm::consumeError(found.takeError());
    if (!contents) llvm::consumeError(contents.takeError());
    if (good && *found == refOf(name)) return std::optional(contents->str());
  }
  return std::optional<std::string>();
}

} // namespace rung::codegen
