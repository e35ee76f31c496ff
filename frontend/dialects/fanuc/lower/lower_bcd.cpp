// Functions on BCD digits (inventory §6.4-§6.8): BYT says in each run whether a number has two digits in one byte or
// four in two. Digits above 9 count as their value.
#include <optional>
#include <string>

#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::fanuc {
namespace {

using ir::Type;
using ir::ValueId;
using network::Address;

constexpr int64_t kTwoDigits = 100, kFourDigits = 10'000;

// Numbers of two or four digits, by the condition BYT.
class Digits {
public:
  Digits(Lowering& f, size_t byt) : f_(f), b_(f.b), four_(f.condition(byt)), isFour_(f.constantOf(byt)) {}

  // The byte or the two bytes of a parameter as they are, in an i16. A second byte that does not exist is 0.
  ValueId bits(size_t i) {
    const Address& address = f_.param(i).address;
    if (isFour_ == true && !isByte(i)) return f_.load(Type::I16, address);
    const ValueId low = b_.zextOrTrunc(Type::I16, f_.load(Type::I8, address));
    return isByte(i) ? low : b_.select(four_, f_.load(Type::I16, address), low);
  }
  void storeBits(size_t i, ValueId bits) {
    const Address& address = f_.param(i).address;
    const auto low = [&] { f_.store(address, b_.trunc(Type::I8, bits)); };
    if (isByte(i)) return low();
    if (isFour_ == true) return f_.store(address, bits);
    b_.when(four_, [&] { f_.store(address, bits); }, low);
  }
  // As a number, in an i32.
  ValueId number(size_t i) { return b_.zextOrTrunc(Type::I32, b_.bcdDecode(bits(i))); }
  // The low digits of a number.
  void store(size_t i, ValueId number) { storeBits(i, b_.bcdEncode(b_.trunc(Type::I16, b_.remU(number, end())))); }
  // The number that has too many digits: 100 or 10000.
  ValueId end() { return b_.select(four_, b_.i32(kFourDigits), b_.i32(kTwoDigits)); }
  // The length of a number in bytes: 1 or 2.
  ValueId bytes() { return b_.select(four_, b_.i32(2), b_.i32(1)); }
  // A parameter that is a constant or an address.
  ValueId operand(size_t i) { return f_.param(i).isAddress ? number(i) : b_.constant(Type::I32, f_.param(i).value); }

private:
  // Of two digits, or the last one of its area.
  bool isByte(size_t i) const { return isFour_ == false || f_.param(i).bytes == 1; }

  Lowering& f_;
  ir::RungBuilder& b_;
  ValueId four_;
  std::optional<bool> isFour_; // if it never changes
};

// An element of a table, which begins at a parameter; its number must be below `count`.
class Elements {
public:
  Elements(Lowering& f, size_t table, size_t byt)
      : b_(f.b), four_(f.condition(byt)), isFour_(f.constantOf(byt)), bytes_(f.param(table).bytes),
        window_(f.window(f.param(table).address, bytes_, bytes_)), digits_(f, byt) {}

  // As many as there are: of those given, what lies in the area.
  ValueId count(int64_t given) {
    const ValueId there = b_.divU(b_.i32(bytes_), digits_.bytes());
    const ValueId wanted = b_.constant(Type::I32, given);
    return b_.select(b_.ltU(wanted, there), wanted, there);
  }
  ValueId load(ValueId element) {
    const ValueId at = b_.mul(element, digits_.bytes());
    const ValueId low = byte(at);
    if (isFour_ == false) return low;
    const ValueId high = b_.shl(byte(b_.add(at, b_.i32(1))), b_.i32(8));
    return b_.select(four_, b_.or_(low, high), low);
  }
  void store(ValueId element, ValueId bits) {
    const ValueId at = b_.mul(element, digits_.bytes());
    b_.storeAt(window_, at, b_.trunc(Type::I8, bits));
    if (isFour_ == false) return;
    b_.when(four_, [&] { b_.storeAt(window_, b_.add(at, b_.i32(1)), b_.trunc(Type::I8, b_.shrU(bits, b_.i32(8)))); });
  }

private:
  ValueId byte(ValueId at) { return b_.zextOrTrunc(Type::I16, b_.loadAt(Type::I8, window_, at)); }

  ir::RungBuilder& b_;
  ValueId four_;
  std::optional<bool> isFour_; // if it never changes
  uint32_t bytes_;
  ir::Window window_;
  Digits digits_;
};

} // namespace

// NNDD: digits and which of them are compared.
void lowerBcdDecode(Lowering& f) {
  ir::RungBuilder& b = f.b;
  const int64_t digits = f.param(1).value / 100, which = f.param(1).value % 100;
  const int64_t mask = (which / 10 != 0 ? 0xF0 : 0) | (which % 10 != 0 ? 0x0F : 0);
  const int64_t wanted = digits / 10 * 16 + digits % 10;
  const ValueId code = b.and_(f.load(Type::I8, f.param(0).address), b.constant(Type::I8, mask));
  f.setOutput(b.and_(f.act(), b.eq(code, b.constant(Type::I8, wanted))));
}

// Conditions RN0, BYT, DIR, POS, INC, ACT. A position that does not exist changes nothing.
void lowerBcdRotation(Lowering& f) {
  f.latchedOutput(f.act(), {}, [&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 1);
    const ValueId base = b.zextOrTrunc(Type::I64, f.condition(0));
    const auto position = [&](size_t i) { return b.sub(b.zextOrTrunc(Type::I64, digits.number(i)), base); };
    const ValueId count = b.constant(Type::I64, f.param(0).value);
    const network::Rotation rotation{.count = count,
                                     .current = position(1),
                                     .target = position(2),
                                     .base = base,
                                     .shorter = f.condition(2),
                                     .before = f.condition(3),
                                     .asSteps = f.condition(4)};
    return network::rotate(f, rotation, [&](ValueId result) { digits.store(3, b.trunc(Type::I32, result)); });
  });
}

// Conditions BYT, RST, ACT; rows as numbers.
void lowerBcdTable(Lowering& f) {
  std::string bytes;
  for (const int64_t row : f.function.table) {
    const auto value = static_cast<uint64_t>(row);
    const auto digit = [&](uint64_t unit) { return value / unit % 10; };
    bytes += static_cast<char>(digit(10) << 4 | digit(1));
    bytes += static_cast<char>(digit(1000) << 4 | digit(100));
  }
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 0);
    const ValueId index = b.zextOrTrunc(Type::I32, b.bcdDecode(f.load(Type::I8, f.param(1).address)));
    const ValueId legal = b.ltU(index, b.i32(static_cast<uint32_t>(f.function.table.size())));
    b.when(legal, [&] {
      const ir::Window table = f.constants(bytes, static_cast<uint32_t>(bytes.size() - 1));
      digits.storeBits(2, b.loadAt(Type::I16, table, b.mul(index, b.i32(2))));
    });
    return b.not_(legal);
  });
}

// Conditions BYT, CNV, RST, ACT. W1 when the number has too many digits, or a digit is above 9.
void lowerBcdConversion(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 0);
    const ValueId source = digits.bits(0);
    const auto finish = [&](ValueId error, ValueId result) {
      b.when(b.not_(error), [&] { digits.storeBits(1, result); });
      return error;
    };
    const auto fromBcd = [&] {
      const ValueId number = b.bcdDecode(source);
      return finish(b.ne(b.bcdEncode(number), source), number);
    };
    const auto toBcd = [&] {
      const ValueId number = b.zextOrTrunc(Type::I32, source);
      return finish(b.leU(digits.end(), number), b.bcdEncode(source));
    };
    return b.choose(f.condition(1), fromBcd, toBcd);
  });
}

// Conditions BYT, ACT.
void lowerBcdCompare(Lowering& f) {
  f.latchedOutput(f.act(), {}, [&] {
    Digits digits(f, 0);
    return frontend::compare(f.b, f.variant(), digits.operand(1), digits.number(2));
  });
}

// Conditions BYT, RST, ACT. From the last element to the first, so that the lowest remains.
void lowerBcdSearch(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 0);
    Elements elements(f, 1, 0);
    const ValueId count = elements.count(f.param(0).value);
    const ValueId searched = digits.bits(2);
    const auto most = static_cast<uint32_t>(std::min<int64_t>(f.param(0).value, f.param(1).bytes));
    const ValueId none[] = {b.bit(false), b.i32(0)};
    const auto inside = b.loop(most, none);
    const ValueId element = b.sub(b.i32(most - 1), inside[0]);
    const ValueId hit = b.and_(b.ltU(element, count), b.eq(elements.load(element), searched));
    const ValueId next[] = {b.or_(inside[1], hit), b.select(hit, element, inside[2])};
    const auto found = b.endLoop(next);
    b.when(found[0], [&] { digits.store(3, found[1]); });
    return b.not_(found[0]);
  });
}

// Conditions BYT, RW, RST, ACT.
void lowerBcdIndexedMove(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 0);
    Elements elements(f, 1, 0);
    const ValueId index = digits.number(3);
    const ValueId legal = b.ltU(index, elements.count(f.param(0).value));
    const ValueId write = f.condition(1);
    const std::optional<bool> writes = f.constantOf(1);
    const auto isInput = [&](size_t i) {
      return f.language().at(f.param(i).address.area).use == network::AreaUse::Input;
    };
    if (!isInput(1) && writes != false) b.when(b.and_(legal, write), [&] { elements.store(index, digits.bits(2)); });
    if (!isInput(2) && writes != true)
      b.when(b.and_(legal, b.not_(write)), [&] { digits.storeBits(2, elements.load(index)); });
    return b.not_(legal);
  });
}

// Conditions BYT, RST, ACT.
void lowerBcdArithmetic(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    Digits digits(f, 0);
    const ValueId first = digits.number(1), second = digits.operand(2);
    const auto stored = [&](ValueId value) {
      digits.store(3, value);
      return b.leS(digits.end(), value);
    };
    if (f.variant() == kDivide)
      return b.choose(
          b.eq(second, b.i32(0)), [&] { return b.bit(true); }, [&] { return stored(b.divU(first, second)); });
    const ValueId value = frontend::compute(b, f.variant(), first, second);
    const ValueId negative = b.ltS(value, b.i32(0));
    const ValueId complement = b.add(b.remS(value, digits.end()), digits.end());
    return b.or_(negative, stored(b.select(negative, complement, value)));
  });
}

// Conditions BYT, ACT.
void lowerBcdNumber(Lowering& f) {
  f.b.when(f.act(), [&] { Digits(f, 0).store(1, f.b.constant(Type::I32, f.param(0).value)); });
}

} // namespace rung::frontend::fanuc
