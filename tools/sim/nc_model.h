// The simulated NC beside a running program: what the control's own software does around the PLC. One class a dialect;
// a scenario or `rungc run` drives it. It knows the program only through its tables.
//
// Errors of the caller (an unknown key, a name that does not exist) come back as a text; "" means done.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/host/instance.h"
#include "tools/sim/message_board.h"

namespace rung::nc {

enum class PowerOn : uint8_t { Cold, Warm };

// The value of a cell that lies in the NC itself and not in the program's memory.
struct NcCell {
  bool isReal = false; // `bits` are those of a double
  uint32_t width = 64; // bits of an integer
  uint64_t bits = 0;
};

// What is wrong with a connection, once the program has started.
struct NcProblem {
  uint32_t connection = RUNG_NONE; // in the order of the calls of `connect`; RUNG_NONE: from a file of the control
  std::string text;
};

// The NC's part of a statement such as `event NAME KEY=VALUE`. Numbers and texts as the scenario gives them.
struct NcArgument {
  std::string key;
  bool isText = false;
  bool isReal = false;
  int64_t integer = 0;
  double real = 0;
  std::string text;
};

class NcModel : public host::ScheduleHooks {
public:
  // Files named by `config` without a full path are in this folder; without one, in the working folder.
  void setFolder(std::string folder) { folder_ = std::move(folder); }
  // Before the first power-on.
  virtual std::string config(std::string_view key, std::string_view value);
  virtual std::string connect(std::string_view source, std::string_view destination);
  // After a power-on: the connections whose ends do not exist or do not fit. They are not served.
  virtual std::vector<NcProblem> connectionProblems() const { return {}; }

  // Switches the program on: memory, presets, what the control runs before the first scan. Warm keeps what the dialect
  // keeps.
  virtual void powerOn(host::Instance& instance, PowerOn kind);
  // What the control runs before a regular power-off.
  virtual void powerOff(host::Instance& instance);

  // What the NC itself keeps through power-off, beside the program's retained memory: an image of a fixed size once it
  // is configured, 0: nothing. `copyKept` allocates nothing. `restoreKept` comes before powerOn, whose kind is then
  // the program's alone; an empty image is that of an NC as it was delivered.
  virtual uint32_t keptSize() { return 0; }
  virtual void copyKept(std::span<uint8_t> image) noexcept { (void)image; }
  virtual void restoreKept(std::span<const uint8_t> image) { (void)image; }
  // The program's retained memory was there but could not be restored: called before powerOn.
  virtual void reportRetainedLost() {}

  // TECHNOL saves its retained memory at a power-off and when the program asks, and at no other time: a host that
  // stores it says so before the power-on, looks between two scans whether the program asks, and reports when it is on
  // disk.
  virtual bool savesOnRequest() const { return false; }
  virtual void setStored(bool stored) { (void)stored; }
  virtual bool asksToSave(const host::Instance& instance) const {
    (void)instance;
    return false;
  }
  virtual void saved(host::Instance& instance) { (void)instance; }

  virtual void scan(host::Instance& instance);
  virtual void slot(host::Instance& instance);
  virtual void fast(host::Instance& instance);
  // For a real clock: what the NC does before the first and between two slices.
  virtual void betweenSlices(host::Instance& instance) { (void)instance; }

  // The place that `expect` reads and the one that `set` writes.
  virtual std::optional<host::Ref> readPlace(const host::Instance& instance, std::string_view name) const;
  virtual std::optional<host::Ref> writePlace(const host::Instance& instance, std::string_view name) const;
  // The machine or a user is going to write there: what the control has put over the real value gives way to it.
  virtual void beforeWrite(host::Instance& instance, const host::Ref& place) { (void)instance, (void)place; }

  // Cells of the NC itself by the dialect's identifiers; false and nothing where there is no such cell.
  virtual std::optional<NcCell> readCell(std::string_view name) const;
  virtual bool writeCell(std::string_view name, const NcCell& value);

  // Quantities of the NC itself, "NC.MPOS.1".
  virtual std::string setQuantity(std::string_view name, double value);
  virtual std::optional<double> quantity(std::string_view name) const;

  virtual std::string blockStart(host::Instance& instance, const std::vector<NcArgument>& keys);
  virtual std::string blockDone(host::Instance& instance);
  virtual std::string event(host::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys);
  virtual std::string plcCommand(host::Instance& instance, std::string_view command);

  // Empties the program's message queue.
  virtual void takeMessages(host::Instance& instance) { board_.take(instance); }
  // For a host that empties it itself and cannot allocate: what the program must learn of this message.
  virtual void accept(const rung_message& message) { (void)message; }
  // Messages on the screen now.
  virtual std::vector<ShownMessage> messages(const host::Instance& instance) const;
  MessageBoard& board() { return board_; }

protected:
  // The NC's signals by their predeclared names; asked for what the program's own table does not hold.
  virtual std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const;

  std::string inFolder(std::string_view file) const;

  std::string folder_;
  MessageBoard board_;
  std::map<std::string, double, std::less<>> quantities_;
};

// By rung_program::dialect; a plain model for a dialect that has none of its own.
std::unique_ptr<NcModel> makeNcModel(std::string_view dialect);

std::unique_ptr<NcModel> makeGskModel();
std::unique_ptr<NcModel> makeNctModel();
std::unique_ptr<NcModel> makeTechnolModel();

} // namespace rung::nc
