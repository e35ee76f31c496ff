// Builds networks from commands (P11). Both source forms feed it: the command list line by line, the ladder form rung
// by rung. It tracks the stack register, checks operands and parameters, and passes on each network when it is
// complete. After an error in a network no further errors of the stack are reported for it.
#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::network {

struct Place {
  SourceRange range;
  uint32_t line = 0;
};

class NetworkBuilder {
public:
  using Sink = std::function<void(Network&&)>;
  NetworkBuilder(Context& context, FileId file, Sink sink) : context_(context), file_(file), sink_(std::move(sink)) {}

  // An operand without a position was reported; the command counts all the same. kind: Load, And or Or.
  void contact(Logic kind, Contact type, const Word& operand, Place at);
  // A contact of a language that says where a network begins: the first one of a network, and one that pushes.
  void first(Contact type, const Word& operand, Place at);
  void further(Contact type, const Word& operand, Place at);
  // kind: OrBlock or AndBlock.
  void block(Logic kind, Place at);
  void coil(Coil kind, const Word& operand, Place at);
  // Null: unknown, and reported.
  void function(const Row* row, Place at);
  void parameter(const Word& operand, Place at);
  void tableRow(const Word& operand, Place at);
  // An unreadable command, which was reported.
  void garbage(Place at);
  // The comment on the line of the last command.
  void comment(std::string_view text);
  // The title of the network that begins next.
  void title(std::string_view text) { pendingTitle_ = text; }
  // Completes the current network.
  void finish();
  // The number of values on the stack of the current network, which has neither a function nor a coil yet; otherwise 0.
  uint32_t values() const { return state_ == State::Logic ? depth() : 0; }

private:
  enum class State : uint8_t { Idle, Logic, Function, Outputs };

  void begin(Place at);
  void extend(Place at);
  void step(Place at);
  void write(Command command, std::string_view operand, Place at);
  void stackError(Place at, std::string_view what);
  void contactOutOfPlace(Place at);
  void checkConditions(const Row& row, Place at);
  void openBlocks(Place at);
  void functionIsLost();
  void completeFunction();
  uint32_t depth() const { return static_cast<uint32_t>(open_.size()); }
  bool mayHaveCoils() const;
  std::string beginsWith() const;

  Context& context_;
  FileId file_;
  Sink sink_;
  Network network_;
  State state_ = State::Idle;
  std::vector<SourceRange> open_; // first commands of blocks that are not combined yet
  bool silent_ = false;           // an error of the stack in this network has been reported
  bool strayReported_ = false;    // parameters without a function have been reported for this network
  bool unknown_ = false;          // FUNC of an unknown function
  std::vector<Word> parameters_;
  std::vector<Word> table_;
  std::string_view pendingTitle_;
};

// Fills in parameters, table and length of the network's function according to its row. False if there were mistakes,
// which were all reported.
bool checkFunction(Context& context, const std::vector<Word>& parameters, const std::vector<Word>& table,
                   Network& network);

} // namespace rung::frontend::network
