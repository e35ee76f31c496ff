// Explains the value of a name in an expectation that failed: the rungs that write it, what decides whether they run,
// and every name that they read with its value and the scan of its last change.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ir/analysis/uses.h"
#include "tools/scenario/changes.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

class Explainer final : public Observer {
public:
  // Made after the session's start and before its first scan; both arguments must outlive the explainer. Without `uses`
  // (the program was not compiled in this process) nothing can be explained.
  Explainer(const Session& session, const ir::Uses* uses) : session_(session) { follow(uses); }

  void scanned(const Session& session) override {
    if (changes_) changes_->scanned(session);
  }
  void replaced(const Session&, const NextProgram& next) override {
    follow(next.uses);
    since_ = "the program took over after ";
  }
  void restored(const Session&) override {
    follow(uses_);
    since_ = "the snapshot was restored after ";
  }

  // The explanation, each line preceded by a line break; "" for a place in the NC and not in the program's memory.
  // `wantReal`: explains the real number that begins there.
  std::string why(std::string_view name, bool wantReal = false) const;

private:
  void follow(const ir::Uses* uses) {
    uses_ = uses;
    changes_.reset();
    if (uses != nullptr) changes_.emplace(session_, *uses);
  }

  const Session& session_;
  const ir::Uses* uses_ = nullptr;
  std::optional<Changes> changes_; // of the running program
  std::string_view since_;         // what begin() of the changes was; empty: the start
};

} // namespace rung::scenario
