// The simulated NC of a running program: the control that every host has (rtlib/nc/control), and its machine: axes,
// part programs, devices, an operator. Each dialect has its own class; a Machine (machine.h) installs it in its
// instance. It knows the program only through its tables.
//
// Errors of the caller (an unknown key, a name that does not exist) are returned as a text; "" means success.
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

// The value of a cell in the NC itself, outside the program's memory.
struct NcCell {
  bool isReal = false; // `bits` are those of a double
  uint32_t width = 64; // number of bits of an integer
  uint64_t bits = 0;
  bool untyped = false; // the eight bytes may be read as an integer or a double
  bool isText = false;  // `text`, in UTF-8
  std::string text = {};
};

// An error in a connection, detected once the program has started.
struct NcProblem {
  uint32_t connection = RUNG_NONE; // in the order of the calls of `connect`; RUNG_NONE: from a file of the control
  std::string text;
};

// An argument for the NC in a statement such as `event NAME KEY=VALUE`. Numbers and texts as in the scenario.
struct NcArgument {
  std::string key;
  bool isText = false;
  bool isReal = false;
  int64_t integer = 0;
  double real = 0;
  std::string text;
};

// Answers requests within a scan in addition to the machine.
class Answers {
public:
  virtual ~Answers() = default;
  // Called before the machine. Returns false to leave the answer to the machine.
  virtual bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) = 0;
  // Called if the machine does not answer. Returns false if the request has to wait.
  virtual bool takeUnanswered(runtime::Instance& instance, const core::ServiceRequest& request,
                              core::ServiceReply& reply) = 0;
};

class SimulatedNc : public api::Environment {
public:
  // Files that `config` names by a relative path are in this folder; without it, in the working directory.
  void setFolder(std::string folder) { folder_ = std::move(folder); }
  // To be called before the first power-on.
  virtual std::string config(std::string_view key, std::string_view value);
  virtual std::string connect(std::string_view source, std::string_view destination);
  // After a power-on: the connections whose ends do not exist or do not fit, and which are not served.
  virtual std::vector<NcProblem> connectionProblems() const { return {}; }

  // Null: none. They must outlive this object.
  void setAnswers(Answers* answers) { answers_ = answers; }
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) final {
    return (answers_ != nullptr && answers_->respond(instance, request, reply)) || serve(instance, request, reply) ||
           (answers_ != nullptr && answers_->takeUnanswered(instance, request, reply));
  }
  // A waiting request was answered, between two scans; `bytes` are the bytes of the answer.
  virtual void answered(runtime::Instance& instance, const core::ServiceRequest& request, std::string_view bytes) {
    (void)instance, (void)request, (void)bytes;
  }

  // Switches the control and the machine on.
  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override;

  // The state that the NC itself retains through power-off, besides the program's retained memory: an image of a fixed
  // size once it is configured, 0: nothing. `copyRetained` allocates nothing. `restoreRetained` must precede powerOn,
  // whose kind then applies only to the program; an empty image is that of an NC as delivered.
  virtual uint32_t retainedSize() { return 0; }
  virtual void copyRetained(std::span<uint8_t> image) noexcept { (void)image; }
  virtual void restoreRetained(std::span<const uint8_t> image) { (void)image; }
  // The log is not a part of the state: it has been handed over.
  void save(core::Saver& saver) const noexcept override;
  void load(runtime::Instance& instance, core::Loader& loader) override;
  // Time has passed while a fault prevented the program from running.
  virtual void idle(runtime::Instance& instance) { (void)instance; }
  // The program runs on the machine's clock from now on.
  virtual void setRealTime() {}

  // The machine or a user is about to write this place: a value by which the control covers the real one must be
  // removed.
  virtual void beforeWrite(runtime::Instance& instance, const runtime::Ref& place) { (void)instance, (void)place; }

  // Cells of the NC itself by the dialect's identifiers; nothing: no such cell. Writing returns "", or the error in the
  // value.
  virtual std::optional<NcCell> readCell(std::string_view name) const;
  virtual std::optional<std::string> writeCell(std::string_view name, const NcCell& value);
  // Why the cell does not exist; "": the name is not that of an NC cell.
  virtual std::string cellProblem(std::string_view name) const;
  // Whether the cell may exist later.
  virtual bool cellMayCome(std::string_view name) const;

  // Quantities of the NC itself, "NC.MPOS.1".
  virtual std::string setQuantity(std::string_view name, double value);
  virtual std::optional<double> quantity(std::string_view name) const;

  virtual std::string blockStart(runtime::Instance& instance, const std::vector<NcArgument>& keys);
  virtual std::string blockDone(runtime::Instance& instance);
  // Names of the events that it supports.
  virtual std::vector<std::string_view> events() const { return {}; }
  virtual std::string event(runtime::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys);
  virtual std::string plcCommand(runtime::Instance& instance, std::string_view command);
  // Checks the next unchecked data that a port has sent: it must match the keys, or there must be none (`none`).
  // Returns "", or the error.
  virtual std::string expectSent(std::string_view port, const std::vector<NcArgument>& keys);

  // Displayed messages belong to the control; logged messages are stored here.
  void accept(const runtime::Instance& instance, const rung_message& message) override;
  // Entries of the log since the last call.
  std::vector<std::string> takeLog() { return std::exchange(log_, {}); }

protected:
  // Whether the log gets a line for this message.
  virtual bool isLogged(const rung_message& message) const;
  // Returns true if the machine answers within the scan, false if the request waits for another answer.
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

// The model for a rung_program::dialect; a plain model for a dialect without one.
std::unique_ptr<SimulatedNc> makeSimulatedNc(std::string_view dialect);

std::unique_ptr<SimulatedNc> makeSimulatedPlain(); // for a dialect without its own control
std::unique_ptr<SimulatedNc> makeSimulatedFanuc();
std::unique_ptr<SimulatedNc> makeSimulatedGsk();
std::unique_ptr<SimulatedNc> makeSimulatedNct();
std::unique_ptr<SimulatedNc> makeSimulatedTechnol();

} // namespace rung::sim
