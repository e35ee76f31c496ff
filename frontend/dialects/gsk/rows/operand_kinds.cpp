// What may be written for each class of operands, with a right and a wrong one for the tests.
#include <algorithm>

#include "frontend/dialects/gsk/rows/instructions.h"

namespace rung::gsk {
namespace {

using frontend::OperandKindInfo;

constexpr OperandKindInfo kKinds[] = {
    {"bit", "bit address or a declared name", "R10.0", "R10", "bit-address-expected"},
    {"coil", "bit address outside X, F and presets, or a declared name", "R10.0", "X10.0", "write-to-input"},
    {"format", "1, 2 or 4, with any leading zeros", "2", "3", "bad-format"},
    {"format-a", "a00n: a 0 constant or 1 address, n 1, 2 or 4 bytes; n alone means 000n", "0002", "0003",
     "bad-format"},
    {"byte", "byte address or a declared name", "R10", "R10.0", "byte-address-expected"},
    {"word", "address of the first of 2 bytes", "R10", "R1099", "address-out-of-range"},
    {"dword", "address of the first of 4 bytes", "R10", "R1097", "address-out-of-range"},
    {"data", "address of the first of as many bytes as the format says", "R10", "R2000", "address-out-of-range"},
    {"block", "address of the first byte of the block", "R10", "R2000", "address-out-of-range"},
    {"constant", "decimal or 0x hexadecimal, signed or unsigned, that fits the format", "100", "0x100000000",
     "constant-out-of-range"},
    {"constant-or-data", "constant or address, as the format says", "100", "0x100000000", "constant-out-of-range"},
    {"number", "decimal number in the range of the instruction", "1", "-1", "parameter-out-of-range"},
    {"mask", "four binary digits", "0011", "0012", "bad-mask"},
    {"label", "L1 to L9999", "L1", "L10000", "parameter-out-of-range"},
    {"subprogram", "P1 to P512", "P1", "P513", "parameter-out-of-range"},
    {"data-table", "address in D", "D10", "R10", "not-a-data-table"},
    {"work-area", "address of the first of 4 bytes in R", "R10", "D10", "work-area-not-in-r"},
    {"record", "address of the first of as many bytes as the instruction's block has", "R10", "R1098",
     "address-out-of-range"},
};
static_assert(std::size(kKinds) == kKindCount);

constexpr bool kindsInOrder() {
  for (int i = 0; i < kKindCount; ++i)
    if (kKinds[i].kind != kKindNames[static_cast<size_t>(i)]) return false;
  return true;
}
static_assert(kindsInOrder(), "one entry for each enumerator of Kind, in its order");

} // namespace

Kind kindOf(const frontend::OperandInfo& operand) {
  const auto at = std::find(kKindNames.begin(), kKindNames.end(), operand.kind);
  return static_cast<Kind>(at - kKindNames.begin());
}

std::span<const OperandKindInfo> operandKindInfos() { return kKinds; }

} // namespace rung::gsk
