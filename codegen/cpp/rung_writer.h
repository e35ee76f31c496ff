// Writes the operations of a rung as C++ statements, one per operation.
#pragma once
#include <string>
#include <string_view>
#include <unordered_map>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/core/regions.h"
#include "ir/shape/memory_layout.h"
#include "ir/shape/partition.h"

namespace rung::codegen {

// Names of places for comments: the first symbol of exactly that place.
class PlaceNames {
public:
  explicit PlaceNames(const ir::Module& module);
  // Empty if there is no such symbol. `bitOffset` counts from the beginning of the space.
  std::string_view at(uint32_t space, int64_t bitOffset, bool bit) const;

private:
  std::unordered_map<uint64_t, const std::string*> names_;
};

class RungWriter {
public:
  // `extraWeight`: the chunk accumulates its extra weight in a variable `extra`.
  RungWriter(const ir::MemoryLayout& layout, const PlaceNames& names, bool extraWeight, std::string& out)
      : layout_(layout), module_(layout.module()), names_(names), extraWeight_(extraWeight), out_(out) {}

  // `number` is the rung's number over all routines, `file` its source's name.
  void write(const ir::Rung& rung, uint32_t number, std::string_view file);
  // Writes how control leaves the last rung.
  void writeExit(const ir::Exit& exit);

private:
  void beginLine(uint32_t line, bool force);
  void endLine();
  void endBlock(size_t stretch);
  void statement(std::string_view text, std::string_view comment = {});
  void writeOp(const ir::Op& op);
  void declare(const ir::Op& op, const std::string& expression, std::string_view comment = {});
  std::string pure(const ir::Op& op);
  std::string valueOf(const ir::Op& op);
  std::string callOf(const ir::Op& op);
  std::string load(const ir::Op& op) const;
  void store(const ir::Op& op);
  void storeAt(const ir::Op& op);
  void openIf(const ir::Op& op, size_t index);
  void yield(const ir::Op& op, const ir::Op& end);
  void openLoop(const ir::Op& op);
  void closeLoop(const ir::Op& op, size_t index);
  void host(const ir::Op& op);
  std::string transferTo(const ir::Destination& to) const;
  std::string leaving(const std::string& how) const;

  std::string v(ir::ValueId id) const { return "v" + std::to_string(id.index); }
  std::string a(const ir::Op& op, int i) const { return v(ir::arg(*rung_, op, i)); }
  std::string placeComment(const ir::Op& op) const;

  const ir::MemoryLayout& layout_;
  const ir::Module& module_;
  const PlaceNames& names_;
  const bool extraWeight_;
  std::string& out_;
  const ir::Rung* rung_ = nullptr;
  uint32_t number_ = 0;
  std::string_view file_;
  uint32_t line_ = 0; // of the open RUNG_LINE
  bool open_ = false;
  size_t indent_ = 0;
  std::vector<ir::Region> regions_; // by operation of the current rung
  std::vector<bool> throughMemory_; // by value of the current rung; empty: none
};

std::string_view cppType(ir::Type type);
// The label of a rung, by its number in the routine.
std::string rungLabel(uint32_t rung);

} // namespace rung::codegen
