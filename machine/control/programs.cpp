// Programs of the machine (see programs.h).
#include "machine/control/programs.h"

#include "machine/compile/forced_code_maker.h"

namespace rung::control {
namespace {

class OfMachine final : public Programs {
public:
  ~OfMachine() override { maker_->abandon(); }
  Image open(const std::string& path) override { return Image(path); }
  void serveForces(const Image& image) override { maker_->serve(image); }
  void abandon() override { maker_->abandon(); }

private:
  std::shared_ptr<compile::ForcedCodeMaker> maker_ = compile::ForcedCodeMaker::make();
};

} // namespace

std::unique_ptr<Programs> programsOfMachine() { return std::make_unique<OfMachine>(); }

} // namespace rung::control
