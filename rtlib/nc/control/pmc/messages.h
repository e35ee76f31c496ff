// Messages of the PMC family: bits of the A area, with texts of the program, as the dialect's MessageRule says. By a
// text list the number is that of the text, the value of a message is the number of the text in the program's table
// (8·byte + bit + 1, with the shift of the language), and requests without a text are not shown. Scan thread, as
// Control.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "rtlib/core/bits.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/pmc/model.h"

namespace rung::nc {

class PmcMessages {
public:
  static constexpr uint32_t kMostBytes = 752; // of the A area; FANUC's largest has 750

  // Adjacent bytes of the A area, and their place in the memory block.
  struct Piece {
    uint32_t first = 0, count = 0;
    uint32_t offset = 0;
    bool expanded = false; // a byte of the block for each bit

    uint32_t size() const noexcept { return expanded ? 8 * count : count; } // in the block
  };

  // Where a program has its messages. Any thread, but not in real time.
  struct Places {
    Places(const rung_program& of, pmc::MessageRule rule);

    const rung_program* program;
    uint32_t area; // RUNG_NONE: the program has no messages
    uint32_t bytes = 0;
    std::vector<Piece> pieces;
    std::vector<uint8_t> written;  // mask of the bits that rungs write, by byte of the pieces
    std::vector<uint32_t> numbers; // of texts, by the text's number in the program's table - 1; 0: there is none
    core::Place display;           // @DISPB
    core::Place shift;             // the message shift in K, if it has one
    std::vector<Piece> states;     // the bytes of the A area whose state the program reads

  private:
    void readTexts(const rung_program& of);
    void findStates(const rung_space& space);
  };

  explicit PmcMessages(pmc::MessageRule rule) : rule_(rule) {}

  void powerOn();
  // Another program has taken over; messages that none of its rungs can end are ended, and those with another number or
  // text end and begin anew for the host. The places and their program outlive the use.
  void use(uint8_t* block, const Places& places) noexcept;

  template <class Archive>
  void state(Archive& archive) {
    archive(reported_);
    for (uint32_t byte = 0; byte < reported_.size(); ++byte)
      for (uint32_t bits = reported_[byte]; bits != 0; bits &= bits - 1) {
        auto& as = reportedAs_[8 * byte + static_cast<uint32_t>(std::countr_zero(bits))];
        archive(as.number, as.key);
      }
    if constexpr (Archive::kLoads)
      for (Look* look : {&allReported_, &stated_, &states_}) look->forget();
  }

  // By a text list only: the bits of A from byte kFirstState on say which messages are shown.
  void writeStates(const runtime::Instance& instance) noexcept;

  // As in Control.
  bool shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept;
  bool nextChange(const runtime::Instance& instance, rung_message& message) noexcept;
  std::vector<ShownMessage> list(const runtime::Instance& instance) const;
  // By a text list only.
  static size_t describe(const rung_program& program, const rung_message& message, std::span<char> out) noexcept;
  static std::string text(const ShownMessage& message);
  // Whether a message is shown that puts the CNC into the alarm state.
  bool showsAlarm(const runtime::Instance& instance) const noexcept;

private:
  static constexpr uint32_t kFirstState = 9000;
  // Nearly all bits are 0, so eight bytes are tested at once.
  static constexpr uint32_t kWord = sizeof(uint64_t);
  static_assert(kMostBytes % kWord == 0);
  // FANUC: the text in another language lies this many A bits further, as the word K918 says.
  static constexpr uint32_t kShiftAt = 918;
  // FANUC's kinds of messages by number: alarms, operator messages, and from kFirstPlain on those without a number.
  static constexpr uint32_t kFirstAlarm = 1000, kFirstMessage = 2000, kFirstPlain = 2100;
  static bool isAlarm(uint32_t number) { return number >= kFirstAlarm && number < kFirstMessage; }

  bool isListed() const { return rule_ == pmc::MessageRule::ByTextList; }
  // What decides, beside the A area, which messages are shown.
  struct Showing {
    bool display = false; // whether any is (DISPB)
    uint32_t shift = 0;
    bool operator==(const Showing&) const = default;
  };
  Showing showing(const runtime::Instance& instance) const noexcept {
    if (!isListed()) return {.display = true};
    const core::Memory memory = instance.memory();
    return {.display = memory.read(places_->display) != 0, .shift = static_cast<uint32_t>(memory.read(places_->shift))};
  }
  // The number and the key of an A bit's text, from 1; the number is 0 for a bit without a text. `key` is the number of
  // the text in the program's table.
  struct Known {
    uint32_t number = 0, key = 0;
    bool operator==(const Known&) const = default;
  };
  Known known(uint32_t bit, uint32_t shift) const noexcept;

  // What messages and their states depend on, at some time: there is hardly ever something new.
  class Look {
  public:
    void forget() noexcept { has_ = false; }
    // Whether nothing has changed.
    bool isSame(const uint8_t* block, std::span<const Piece> pieces, const Showing& showing) const noexcept {
      if (!has_ || showing != showing_) return false;
      const uint8_t* bytes = bytes_.data();
      for (const Piece& piece : pieces) {
        if (std::memcmp(block + piece.offset, bytes, piece.size()) != 0) return false;
        bytes += piece.size();
      }
      return true;
    }
    void take(const uint8_t* block, std::span<const Piece> pieces, const Showing& showing) noexcept;

  private:
    std::array<uint8_t, size_t{8} * kMostBytes> bytes_{}; // of the pieces
    bool has_ = false;
    Showing showing_;
  };

  // As nextChange, which only looks whether there is something new; the second one only messages that begin, or end.
  bool findChange(const runtime::Instance& instance, const Showing& showing, rung_message& message) noexcept;
  bool findChange(const runtime::Instance& instance, const Showing& showing, bool begins,
                  rung_message& message) noexcept;
  bool isNoneReported(uint32_t byte) const noexcept;
  // A byte of the A area, or 0 if nothing is shown.
  uint8_t bitsOf(const runtime::Instance& instance, const Showing& showing, uint32_t byte) const noexcept;

  // Calls see(number) for each A bit that is 1, from 1, in order, until it returns false; returns whether it never did.
  template <class See>
  bool forRequested(const uint8_t* block, See see) const;
  // Calls see(key, number) for each message that is shown, in the same way.
  template <class See>
  bool forShown(const runtime::Instance& instance, See see) const;

  pmc::MessageRule rule_;
  const Places* places_ = nullptr; // of the program that runs now
  // Bits whose messages have been reported to the host as shown, and as what; a key of 0 is a text that the program no
  // longer has.
  std::array<uint8_t, kMostBytes> reported_{};
  std::array<Known, size_t{8} * kMostBytes> reportedAs_{};
  Look allReported_;     // when all changes had been reported
  Look stated_, states_; // when the states were written: the messages, and the states
};

template <class See>
bool PmcMessages::forRequested(const uint8_t* block, See see) const {
  for (const Piece& piece : places_->pieces) {
    const uint32_t size = piece.size();
    for (uint32_t at = 0; at < size; at += kWord) {
      uint64_t bits = 0;
      std::memcpy(&bits, block + piece.offset + at, std::min(kWord, size - at));
      if (bits == 0) continue;
      if (piece.expanded) bits = core::packBits(block + piece.offset + at);
      for (uint32_t number = 8 * (piece.first + (piece.expanded ? at / 8 : at)) + 1; bits != 0; bits &= bits - 1)
        if (!see(number + static_cast<uint32_t>(std::countr_zero(bits)))) return false;
    }
  }
  return true;
}

template <class See>
bool PmcMessages::forShown(const runtime::Instance& instance, See see) const {
  const Showing now = places_ == nullptr ? Showing() : showing(instance);
  return !now.display || forRequested(instance.block().data(), [&](uint32_t bit) {
    const Known found = known(bit, now.shift);
    return found.number == 0 || see(found.key, found.number);
  });
}

} // namespace rung::nc
