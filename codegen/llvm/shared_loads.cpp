// See shared_loads.h.
#include "codegen/llvm/shared_loads.h"

#include <map>
#include <vector>

#include <llvm/ADT/STLExtras.h>
#include <llvm/Analysis/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Module.h>

#include "codegen/llvm/memory_place.h"

namespace rung::codegen {
namespace {

constexpr size_t kMany = 6;         // loads of one number: fewer of them would seldom pay for the one above them
constexpr unsigned kMostPlaces = 2; // as each keeps a register

struct Place {
  int64_t offset = 0;
  llvm::Type* type = nullptr;
  std::vector<llvm::LoadInst*> loads;
};

struct Written {
  const llvm::StoreInst* store = nullptr;
  int64_t offset = 0;
  int64_t end = 0;
};

class Loads {
public:
  explicit Loads(llvm::Function& function)
      : memory_(*function.getArg(0)), data_(function.getParent()->getDataLayout()) {}

  // False: it is not known what the chunk writes.
  bool find(llvm::Function& function) {
    for (llvm::Instruction& instruction : llvm::instructions(function)) {
      if (auto* load = llvm::dyn_cast<llvm::LoadInst>(&instruction)) {
        if (pays(*load)) add(*load);
      } else if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction)) {
        if (!note(*store)) return false;
      } else if (llvm::isa<llvm::CallBase>(instruction) || instruction.mayWriteToMemory()) {
        return false;
      }
    }
    return true;
  }

  // Those that are loaded most often first.
  std::vector<const Place*> places() const {
    std::vector<const Place*> found;
    for (const auto& [key, place] : places_)
      if (place.loads.size() >= kMany) found.push_back(&place);
    std::ranges::stable_sort(found, std::ranges::greater(), [](const Place* place) { return place->loads.size(); });
    return found;
  }

  // Nothing below `here` writes it.
  bool isLasting(const Place& place, const llvm::Instruction& here) const {
    const int64_t end = place.offset + bytesOf(*place.type, data_);
    return llvm::all_of(stores_, [&](const Written& written) {
      if (written.end <= place.offset || end <= written.offset) return true;
      if (written.store->getParent() == here.getParent()) return written.store->comesBefore(&here);
      return !llvm::isPotentiallyReachable(here.getParent(), written.store->getParent());
    });
  }

private:
  // A comparison with a constant takes what it compares from memory.
  static bool pays(const llvm::LoadInst& load) {
    if (!load.isSimple() || !load.getType()->isIntegerTy() || load.getType()->getIntegerBitWidth() < 32) return false;
    return !llvm::all_of(load.users(), [](const llvm::User* user) {
      return llvm::isa<llvm::ICmpInst>(user) && llvm::isa<llvm::Constant>(user->getOperand(1));
    });
  }

  bool note(const llvm::StoreInst& store) {
    const std::optional<int64_t> offset = offsetIn(memory_, *store.getPointerOperand(), data_);
    if (!offset) return isElsewhere(memory_, *store.getPointerOperand());
    stores_.push_back({&store, *offset, *offset + bytesOf(*store.getValueOperand()->getType(), data_)});
    return true;
  }

  void add(llvm::LoadInst& load) {
    const std::optional<int64_t> offset = offsetIn(memory_, *load.getPointerOperand(), data_);
    if (!offset) return;
    Place& place = places_[{*offset, load.getType()->getIntegerBitWidth()}];
    place.offset = *offset;
    place.type = load.getType();
    place.loads.push_back(&load);
  }

  const llvm::Argument& memory_;
  const llvm::DataLayout& data_;
  std::map<std::pair<int64_t, unsigned>, Place> places_;
  std::vector<Written> stores_;
};

// What all of the loads come after.
llvm::Instruction& above(const Place& place, const llvm::DominatorTree& tree) {
  llvm::BasicBlock* block = place.loads.front()->getParent();
  for (const llvm::LoadInst* load : place.loads)
    block = tree.findNearestCommonDominator(block, const_cast<llvm::BasicBlock*>(load->getParent()));
  llvm::Instruction* first = block->getTerminator();
  for (llvm::LoadInst* load : place.loads)
    if (load->getParent() == block && load->comesBefore(first)) first = load;
  return *first;
}

void loadOnce(const Place& place, llvm::Instruction& here) {
  llvm::LoadInst& any = *place.loads.front();
  llvm::Value& address = addressBefore(*any.getPointerOperand(), here);
  auto* shared = new llvm::LoadInst(place.type, &address, "", false, any.getAlign(), here.getIterator());
  for (llvm::LoadInst* load : place.loads) {
    load->replaceAllUsesWith(shared);
    load->eraseFromParent();
  }
}

} // namespace

bool shareLoads(llvm::Function& function) {
  Loads loads(function);
  if (!loads.find(function)) return false;
  const std::vector<const Place*> places = loads.places();
  if (places.empty()) return false;
  const llvm::DominatorTree tree(function);
  unsigned shared = 0;
  for (const Place* place : places) {
    llvm::Instruction& here = above(*place, tree);
    if (shared == kMostPlaces || !loads.isLasting(*place, here)) continue;
    loadOnce(*place, here);
    ++shared;
  }
  return shared != 0;
}

} // namespace rung::codegen
