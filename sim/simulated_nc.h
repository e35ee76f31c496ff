// The simulated NC beside a running program: the control that every host has (rtlib/nc/control), and around it the
// machine: axes, part programs, devices, an operator. One class a dialect; a Machine (machine.h) has it around its
// instance. It knows the program only through its tables.
//
// Errors of the caller (an unknown key, a name that does not exist) come back as a text; "" means done.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtlib/api/environment.h"

namespace rung::sim {

// The value of a cell that lies in the NC itself and not in the program's memory.
struct NcCell {
  bool isReal = false; // `bits` are those of a double
  uint32_t width = 64; // bits of an integer
  uint64_t bits = 0;
  bool untyped = false; // eight bytes are an integer or a double, as they are wanted
  bool isText = false;  // `text`, in UTF-8
  std::string text = {};
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

// Who answers a request within a scan besides the machine.
class Answers {
public:
  virtual ~Answers() = default;
  // Before the machine. False: the machine.
  virtual bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) = 0;
  // Where the machine gives no answer. False: the request waits.
  virtual bool takeUnanswered(runtime::Instance& instance, const core::ServiceRequest& request,
                              core::ServiceReply& reply) = 0;
};

class SimulatedNc : public api::Environment {
public:
  // Files named by `config` without a full path are in this folder; without one, in the working folder.
  void setFolder(std::string folder) { folder_ = std::move(folder); }
  // Before the first power-on.
  virtual std::string config(std::string_view key, std::string_view value);
  virtual std::string connect(std::string_view source, std::string_view destination);
  // After a power-on: the connections whose ends do not exist or do not fit. They are not served.
  virtual std::vector<NcProblem> connectionProblems() const { return {}; }

  // Null: none. They outlive it.
  void setAnswers(Answers* answers) { answers_ = answers; }
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) final {
    return (answers_ != nullptr && answers_->respond(instance, request, reply)) || serve(instance, request, reply) ||
           (answers_ != nullptr && answers_->takeUnanswered(instance, request, reply));
  }
  // A waiting request was answered, between two scans; `bytes` are those of the answer.
  virtual void answered(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes) {
    (void)instance, (void)request, (void)bytes;
  }

  // Switches the control and the machine on.
  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override;

  // What the NC itself keeps through power-off, beside the program's retained memory: an image of a fixed size once it
  // is configured, 0: nothing. `copyKept` allocates nothing. `restoreKept` comes before powerOn, whose kind is then
  // the program's alone; an empty image is that of an NC as it was delivered.
  virtual uint32_t keptSize() { return 0; }
  virtual void copyKept(std::span<uint8_t> image) noexcept { (void)image; }
  virtual void restoreKept(std::span<const uint8_t> image) { (void)image; }
  // Time has passed in which a fault kept the program from running.
  virtual void idle(runtime::Instance& instance) { (void)instance; }
  // From now on the program runs on the machine's clock.
  virtual void setRealTime() {}

  // The machine or a user is going to write there: what the control has put over the real value gives way to it.
  virtual void beforeWrite(runtime::Instance& instance, const runtime::Ref& place) { (void)instance, (void)place; }

  // Cells of the NC itself by the dialect's identifiers; nothing: no such cell. Writing: "" or what is
  // wrong with the value.
  virtual std::optional<NcCell> readCell(std::string_view name) const;
  virtual std::optional<std::string> writeCell(std::string_view name, const NcCell& value);
  // Why the cell does not exist; "": the name is not one of the NC's.
  virtual std::string cellProblem(std::string_view name) const;
  // It may be there later.
  virtual bool cellMayCome(std::string_view name) const;

  // Quantities of the NC itself, "NC.MPOS.1".
  virtual std::string setQuantity(std::string_view name, double value);
  virtual std::optional<double> quantity(std::string_view name) const;

  virtual std::string blockStart(runtime::Instance& instance, const std::vector<NcArgument>& keys);
  virtual std::string blockDone(runtime::Instance& instance);
  // Names of those that it knows.
  virtual std::vector<std::string_view> events() const { return {}; }
  virtual std::string event(runtime::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys);
  virtual std::string plcCommand(runtime::Instance& instance, std::string_view command);
  // What has left a port and has not been checked is as the keys say, or there is nothing (`none`). "" or what is
  // wrong.
  virtual std::string expectSent(std::string_view port, const std::vector<NcArgument>& keys);

  // What is shown is the control's, what is logged is kept here.
  void accept(const runtime::Instance& instance, const rung_message& message) override;
  // Entries of the log since the last call.
  std::vector<std::string> takeLog() { return std::exchange(log_, {}); }

protected:
  // Whether the log gets a line for this message.
  virtual bool isLogged(const rung_message& message) const;
  // True: the machine answers, within the scan. False: the request waits for an answer from elsewhere.
  virtual bool serve(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
    (void)instance, (void)request, (void)reply;
    return false;
  }

  std::string inFolder(std::string_view file) const;

  std::string folder_;
  std::vector<std::string> log_;
  std::map<std::string, double, std::less<>> quantities_;

private:
  Answers* answers_ = nullptr;
};

// By rung_program::dialect; a plain model for a dialect without one.
std::unique_ptr<SimulatedNc> makeSimulatedNc(std::string_view dialect);

std::unique_ptr<SimulatedNc> makeSimulatedPlain(); // of a dialect without a control of its own
std::unique_ptr<SimulatedNc> makeSimulatedGsk();
std::unique_ptr<SimulatedNc> makeSimulatedNct();
std::unique_ptr<SimulatedNc> makeSimulatedTechnol();

} // namespace rung::sim
