// Call cycles (see call_graph.h).
#include "frontend/sema/call_graph.h"

#include <algorithm>
#include <utility>

namespace rung::frontend {
namespace {

// Depth-first search with an explicit stack, so that deep call chains cannot overflow the thread's stack.
class Walk {
public:
  Walk(const CallGraph& graph, size_t routines) : graph_(graph), state_(routines, State::Unseen) {}

  CallGraph::Order run() {
    for (uint32_t root = 0; root < state_.size(); ++root) {
      if (state_[root] != State::Unseen) continue;
      open(root);
      while (!path_.empty()) step();
    }
    return std::move(order_);
  }

private:
  enum class State : uint8_t { Unseen, Open, Done };

  void open(uint32_t routine) {
    state_[routine] = State::Open;
    path_.emplace_back(routine, 0);
  }

  // Visits the next call of the innermost routine.
  void step() {
    auto& [routine, next] = path_.back();
    const std::span<const CallGraph::Call> calls = graph_.of(routine);
    if (next == calls.size()) {
      state_[routine] = State::Done;
      order_.calleesFirst.push_back(routine);
      path_.pop_back();
      return;
    }
    const CallGraph::Call& call = calls[next++];
    if (state_[call.callee] == State::Unseen)
      open(call.callee);
    else if (state_[call.callee] == State::Open)
      addCycle(call);
  }

  void addCycle(const CallGraph::Call& call) {
    CallGraph::Cycle& cycle = order_.cycles.emplace_back(CallGraph::Cycle{call, {}});
    auto at = std::ranges::find(path_, call.callee, &std::pair<uint32_t, size_t>::first);
    while (++at != path_.end()) cycle.through.push_back(at->first);
  }

  const CallGraph& graph_;
  std::vector<State> state_;
  std::vector<std::pair<uint32_t, size_t>> path_; // open routines, each with the index of its next call
  CallGraph::Order order_;
};

} // namespace

CallGraph::Order CallGraph::order() const { return Walk(*this, calls_.size()).run(); }

std::string CallGraph::throughText(const Cycle& cycle, const std::function<std::string(uint32_t)>& nameOf) {
  std::string text;
  for (const uint32_t routine : cycle.through) text += (text.empty() ? " through " : ", ") + nameOf(routine);
  return text;
}

} // namespace rung::frontend
