// The GSK form: a command list, all of it in Level 2 (see form.h).
#include <algorithm>

#include "ir/support/put.h"
#include "tools/bench/generated/form.h"

namespace rung::bench {
namespace {

constexpr uint32_t kSteps = 12000; // of a program (man. l.354)
constexpr uint32_t kFirstX = 9, kFirstF = 64;
constexpr uint32_t kRelayBytes = 1000;          // of area R; the control's own are after them
constexpr uint32_t kSignalBytes = 200;          // G, F
constexpr uint32_t kFixedTimers = 200;          // numbers of TMRB
constexpr uint32_t kZero = 8 * kRelayBytes - 1; // a relay that is never written
// Data table D: words, tables, and the cells of indexed transfers and counters.
constexpr uint32_t kDataBytes = 1860;
constexpr uint32_t kTableBytes = 1040;
constexpr uint32_t kCapacity = 1300;
constexpr uint32_t kPresets = 1304;
constexpr uint32_t kRegisters = 1330;
constexpr int kScanMs = 8;

std::string bitOf(char area, uint32_t firstByte, uint32_t bit) {
  return fmt::format("{}{}.{}", area, firstByte + bit / 8, bit % 8);
}
std::string relay(uint32_t bit) { return bitOf('R', 0, bit); }
std::string data(uint32_t byte) { return fmt::format("D{}", byte); }
std::string word(uint32_t number) { return data(4 * number); }

std::vector<std::string> bitsOf(const Work& work) {
  const bool signals = work.kind == Kind::Signals;
  std::vector<std::string> bits;
  for (uint32_t i = 0; i < work.inputs; ++i)
    bits.push_back(signals               ? bitOf('F', 0, i)
                   : i < work.inputs / 2 ? bitOf('X', kFirstX, i)
                                         : bitOf('F', kFirstF, i - work.inputs / 2));
  for (uint32_t i = 0; i < work.coils; ++i)
    bits.push_back(signals && i < 8 * kSignalBytes ? bitOf('G', 0, i) : relay(i));
  return bits;
}

class Writer {
public:
  Writer(const Work& work, Program& program) : program_(program), spare_(work.coils) {}

  void add(const Element& e) {
    const std::string in = program_.bits[e.first.bit];
    switch (e.op) {
    case Op::Logic: return logic(e);
    case Op::Timer: return put("LD {}\nFUNC TMRB\nPRM {}\nPRM {}\nOUT {}\n", 5, in, e.number + 1, e.preset, coil(e));
    case Op::Counter:
      return put("LD {0}\nLD {0}\nLD {1}\nLD {2}\nFUNC CTRC\nPRM {3}\nPRM {4}\nOUT {5}\n", 8, relay(kZero),
                 program_.bits[e.second.bit], in, preset(e.preset), data(kRegisters + 4 * e.number), coil(e));
    case Op::Add: return calculate(e, "ADDB");
    case Op::Subtract: return calculate(e, "SUBB");
    case Op::Multiply: return calculate(e, "MULB");
    case Op::Less: return less(e);
    case Op::TableRead: return transfer(e, "LD");
    case Op::TableWrite: return transfer(e, "LDI");
    default: break; // refused earlier
    }
  }
  uint32_t steps() const { return steps_; }
  uint32_t relays() const { return spare_; }

private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, uint32_t steps, Args&&... args) {
    rung::put(program_.text, format, std::forward<Args>(args)...);
    steps_ += steps;
  }
  const std::string& coil(const Element& e) const { return program_.bits[e.coil]; }
  // Functions have an output that the work does not have: each gets a separate relay.
  std::string spareRelay() { return relay(spare_++); }
  std::string preset(uint32_t value) {
    const std::string place = data(kPresets + 2 * value);
    const std::pair<std::string, uint64_t> constant{place + ":2", value};
    if (std::find(program_.constants.begin(), program_.constants.end(), constant) == program_.constants.end())
      program_.constants.push_back(constant);
    return place;
  }
  void logic(const Element& e) {
    const auto contact = [&](const char* plain, const char* inverted, const Contact& c) {
      put("{} {}\n", 1, c.negated ? inverted : plain, program_.bits[c.bit]);
    };
    contact("LD", "LDI", e.first);
    if (e.parallel)
      contact("OR", "ORI", e.second);
    else
      contact("AND", "ANI", e.second);
    contact("AND", "ANI", e.third);
    put("OUT {}\n", 1, coil(e));
  }
  void calculate(const Element& e, const char* function) {
    put("LD {}\nLD {}\nFUNC {}\nPRM 1004\nPRM {}\nPRM {}\nPRM {}\nOUT {}\n", 8, relay(kZero),
        program_.bits[e.first.bit], function, word(e.a), word(e.b), word(e.to), spareRelay());
  }
  void less(const Element& e) {
    spare_ = (spare_ + 7) / 8 * 8;
    const uint32_t byte = spare_ / 8;
    spare_ += 8;
    put("LD {0}\nFUNC COMPB\nPRM 1004\nPRM {1}\nPRM {2}\nPRM R{3}\nLD {0}\nAND R{3}.2\nOUT {4}\n", 9,
        program_.bits[e.first.bit], word(e.a), word(e.b), byte, coil(e));
  }
  // `direction` is a relay that is always 0.
  void transfer(const Element& e, const char* direction) {
    put("{0} {1}\nLD {1}\nLD {2}\nFUNC XMOVB\nPRM 4\nPRM {3}\nPRM {4}\nPRM {5}\nPRM {6}\nOUT {7}\n", 10, direction,
        relay(kZero), program_.bits[e.first.bit], data(kCapacity), data(kTableBytes + 4 * kEntries * e.b), word(e.to),
        word(e.a), spareRelay());
  }

  Program& program_;
  uint32_t spare_;
  uint32_t steps_ = 0;
};

class Gsk final : public Form {
public:
  Result<Program> write(const Work& work) const override {
    if (work.mechanisms != 0) return failure("GSK has no mechanisms");
    if (work.reals() != 0) return failure("GSK has no floating-point numbers");
    Program program = named();
    program.bits = bitsOf(work);
    for (uint32_t i = 0; i < work.words(); ++i) program.words.push_back(word(i) + ":4");
    if (work.hasTables) {
      for (uint32_t i = 0; i < kTables * kEntries; ++i) program.tables.push_back(data(kTableBytes + 4 * i) + ":4");
      program.constants.emplace_back(data(kCapacity) + ":4", kEntries);
    }
    Writer writer(work, program);
    for (const Element& element : work.elements) writer.add(element);
    program.text += kEnd;
    if (writer.steps() + kEndSteps > kSteps || writer.relays() >= kZero || work.timers > kFixedTimers ||
        kRegisters + 4 * work.counters > kDataBytes)
      return failure("GSK has no room for so many");
    return program;
  }

  std::vector<Instruction> instructions() const override {
    return {{"LD, OUT", "LD {in}\nOUT {out}\n"},
            {"LD, AND, OUT", "LD {in}\nAND {in}\nOUT {out}\n"},
            {"LD, OUTI", "LD {in}\nOUTI {out}\n"},
            {"LD, SET", "LD {in}\nSET {out}\n"},
            {"DIFU", "LD {in}\nFUNC DIFU\nPRM {n}\nOUT {out}\n"},
            {"TMR", "LD {in}\nFUNC TMR\nPRM {n}\nOUT {out}\n"},
            {"TMRB", "LD {in}\nFUNC TMRB\nPRM {n}\nPRM 960000\nOUT {out}\n"},
            {"CTR", "LD {not}\nLD {not}\nLD {not}\nLD {in}\nFUNC CTR\nPRM {n}\nOUT {out}\n"},
            {"CTRC", "LD {not}\nLD {not}\nLD {not}\nLD {in}\nFUNC CTRC\nPRM D1304\nPRM {state}\nOUT {out}\n"},
            {"MOVB", "LD {in}\nFUNC MOVB\nPRM {a}\nPRM {to}\n"},
            {"MOVW", "LD {in}\nFUNC MOVW\nPRM {a}\nPRM {to}\n"},
            {"MOVN, 16 bytes", "LD {in}\nFUNC MOVN\nPRM 16\nPRM {a}\nPRM D1400\n"},
            {"XMOVB",
             "LD {not}\nLD {not}\nLD {in}\nFUNC XMOVB\nPRM 2\nPRM D1304\nPRM D1400\nPRM {to}\nPRM {a}\nOUT {out}\n"},
            {"DECB", "LD {in}\nFUNC DECB\nPRM 2\nPRM {a}\nPRM 3\nPRM {byte}\n"},
            {"COMPB", "LD {in}\nFUNC COMPB\nPRM 1002\nPRM {a}\nPRM {b}\nPRM {byte}\n"},
            {"COIN", "LD {in}\nFUNC COIN\nPRM 1002\nPRM {a}\nPRM {b}\nOUT {out}\n"},
            {"ADDB", "LD {not}\nLD {in}\nFUNC ADDB\nPRM 1002\nPRM {a}\nPRM {b}\nPRM {to}\nOUT {out}\n"},
            {"SUBB", "LD {not}\nLD {in}\nFUNC SUBB\nPRM 1002\nPRM {a}\nPRM {b}\nPRM {to}\nOUT {out}\n"},
            {"MULB", "LD {not}\nLD {in}\nFUNC MULB\nPRM 1002\nPRM {a}\nPRM {b}\nPRM {to}\nOUT {out}\n"},
            {"DIVB", "LD {not}\nLD {in}\nFUNC DIVB\nPRM 0002\nPRM {a}\nPRM 7\nPRM {to}\nOUT {out}\n"},
            {"ANDF", "LD {in}\nFUNC ANDF\nPRM 1002\nPRM {a}\nPRM {b}\nPRM {to}\n"},
            {"NUMEB", "LD {in}\nFUNC NUMEB\nPRM 2\nPRM 100\nPRM {to}\n"},
            {"DCNVB, binary to BCD",
             "LD {not}\nLD {in}\nLD {not}\nLD {in}\nFUNC DCNVB\nPRM 2\nPRM {a}\nPRM {to}\nOUT {out}\n"},
            {"ROTB", "LD {in}\nLD {in}\nLD {not}\nLD {in}\nLD {in}\nFUNC ROTB\nPRM 2\nPRM D1304\nPRM {a}\nPRM {b}\nPRM "
                     "{to}\nOUT {out}\n"}};
  }

  Program repeat(const std::string& text, uint32_t count) const override {
    Program program = named();
    for (uint32_t i = 0; i < count; ++i) program.bits.push_back(bitOf('X', kFirstX, i));
    for (uint32_t i = 0; i < count; ++i)
      program.text += filled(text, {{"in", program.bits[conditionOf(i, count)]},
                                    {"not", relay(kZero)},
                                    {"out", relay(i)},
                                    {"byte", fmt::format("R{}", 100 + i)},
                                    {"a", data(6 * i)},
                                    {"b", data(6 * i + 2)},
                                    {"to", data(6 * i + 4)},
                                    {"state", fmt::format("R{}", 300 + 4 * i)},
                                    {"n", std::to_string(i + 1)}});
    program.text += kEnd;
    return program;
  }

private:
  static constexpr const char* kEnd = "FUNC END2\n";
  static constexpr uint32_t kEndSteps = 2; // including END1
  static Program named() { return {.file = "generated.pmc", .text = "FUNC END1\n", .msAScan = kScanMs}; }
};

} // namespace

std::unique_ptr<Form> gskForm() { return std::make_unique<Gsk>(); }

} // namespace rung::bench
