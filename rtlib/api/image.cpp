// Programs from files and from memory.
#include "rtlib/api/image.h"

#include <algorithm>
#include <utility>

#include "rtlib/api/error.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/service.h"

namespace rung::api {

namespace {

std::vector<uint32_t> authorsSymbols(const rung_program& program) {
  std::vector<uint32_t> symbols;
  for (uint32_t i = 0; i < program.symbol_count; ++i)
    if ((program.symbols[i].flags & RUNG_SYMBOL_HIDDEN) == 0) symbols.push_back(i);
  return symbols;
}

} // namespace

Image::Image(std::unique_ptr<runtime::SoEngine> file)
    : loaded(std::move(file)), program(loaded->program()), symbols(authorsSymbols(program)), footprint(program, true) {}

Image::Image(const rung_program& inMemory, void* context, void (*releases)(void*), void* ownedBy)
    : program(inMemory), engine(context), release(releases), owner(ownedBy), symbols(authorsSymbols(program)),
      footprint(program, false) {}

Image::~Image() {
  const std::unique_ptr<const rung_code_maker> serving(maker.load());
  if (serving != nullptr && serving->release != nullptr) serving->release(serving->user);
  if (release != nullptr) release(owner);
}

// The programs of an instance.

Generation::Generation(Generations& all, uint32_t ofInstance, std::shared_ptr<const Image> of,
                       std::shared_ptr<const runtime::CopyLists> lists)
    : number(ofInstance), image(std::move(of)), copyLists(std::move(lists)), cells(program(), copyLists->views()),
      blockPlan(program(), copyLists->views()), all_(all) {
  if (program().instrumented != 0) clock = runtime::calibratedClock();
}

Generation::~Generation() {
  all_.names.leave(cells);
  all_.blocks.leave(blockPlan);
}

std::shared_ptr<Generation> Generations::add(const Environment& environment, std::shared_ptr<const Image> image,
                                             std::shared_ptr<const runtime::CopyLists> lists) {
  const std::lock_guard lock(mutex_);
  releaseLocked();
  auto made = std::make_shared<Generation>(*this, last_ + 1, std::move(image), std::move(lists));
  names.join(environment, made->cells);
  blocks.join(environment, made->blockPlan);
  all_.push_back(made);
  ++last_;
  return made;
}

std::shared_ptr<Generation> Generations::running() {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(all_, now_.load(std::memory_order_acquire), &std::shared_ptr<Generation>::get);
  assert(found != all_.end()); // the running one is never freed
  return *found;
}

void Generations::release() {
  const std::lock_guard lock(mutex_);
  releaseLocked();
}

// A generation that may run again is held by a replacement.
void Generations::releaseLocked() {
  std::erase_if(all_, [this](const std::shared_ptr<Generation>& one) {
    return one.use_count() == 1 && !one->isReferredTo() && one.get() != now_.load(std::memory_order_acquire);
  });
}

// Lists of names.

const core::ServiceName* ServiceNames::of(const rung_program& program) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> texts(program.services, program.services + program.service_count);
  const auto known = std::ranges::find(lists_, texts, &List::texts);
  if (known != lists_.end()) return known->names.data();
  List& list = lists_.emplace_back();
  list.texts = std::move(texts);
  for (const std::string& text : list.texts)
    list.names.push_back({text.c_str(), nc::serviceKind(program.dialect, text)});
  return list.names.data();
}

} // namespace rung::api

using namespace rung;
using namespace rung::api;

int32_t rung_image_open(const char* path, const rung_image_options* options, rung_image** image) {
  if (path == nullptr || image == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "rung_image_open needs a path and a place for the image");
  return contained([&] {
    rung_image_options given{};
    if (!takeStruct(options, given)) return failSize("rung_image_options");
    if (given.allow_unsealed > 1)
      return fail(RUNG_BAD_ARGUMENT, "`allow_unsealed` is %u, not 0 or 1", given.allow_unsealed);
    runtime::SoOptions how;
    how.mayLackSeal = given.allow_unsealed != 0;
    if (given.keys_folder != nullptr) how.keysFolder = given.keys_folder;
    std::string error;
    std::unique_ptr<runtime::SoEngine> loaded = runtime::SoEngine::open(path, error, how);
    if (loaded == nullptr) return fail(RUNG_REFUSED, "%s", error.c_str());
    *image = new rung_image{.image = std::make_shared<const Image>(std::move(loaded))};
    return int32_t{RUNG_OK};
  });
}

int32_t rung_image_open_memory(int32_t file, const char* name, rung_image** image) {
  if (name == nullptr || image == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "rung_image_open_memory needs a name and a place for the image");
  return contained([&] {
    std::string error;
    std::unique_ptr<runtime::SoEngine> loaded = runtime::SoEngine::openMemory(file, name, error);
    if (loaded == nullptr) return fail(RUNG_REFUSED, "%s", error.c_str());
    *image = new rung_image{.image = std::make_shared<const Image>(std::move(loaded))};
    return int32_t{RUNG_OK};
  });
}

int32_t rung_image_adopt(const rung_program* program, void* engine, void (*release)(void* owner), void* owner,
                         rung_image** image) {
  if (program == nullptr || image == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "rung_image_adopt needs a program and a place for the image");
  return contained([&] {
    if (const std::string wrong = runtime::checkProgram(*program); !wrong.empty())
      return fail(RUNG_REFUSED, "%s", wrong.c_str());
    auto handle = std::make_unique<rung_image>();
    handle->image = std::make_shared<const Image>(*program, engine, release, owner);
    *image = handle.release();
    return int32_t{RUNG_OK};
  });
}

const rung_program* rung_image_program(const rung_image* image) {
  const rung_image* handle = checked(image, kImageMark);
  return handle == nullptr ? nullptr : &handle->image->program;
}

int32_t rung_image_symbol(const rung_image* image, uint32_t index, rung_symbol_info* symbol) {
  const rung_image* handle = checked(image, kImageMark);
  if (handle == nullptr) return failHandle("an image");
  const Image& content = *handle->image;
  if (index >= content.symbols.size()) return RUNG_EMPTY;
  const rung_symbol& s = content.program.symbols[content.symbols[index]];
  const bool constant = (s.flags & RUNG_SYMBOL_CONST) != 0;
  return giveStruct(symbol, rung_symbol_info{.type = s.type,
                                             .count = s.count,
                                             .flags = s.flags,
                                             .space = constant ? RUNG_NONE : s.space,
                                             .byte = s.byte,
                                             .bit = s.bit,
                                             .value = s.value,
                                             .name = s.name,
                                             .comment = s.comment});
}

int32_t rung_image_serve(rung_image* image, const rung_code_maker* maker) {
  const rung_image* handle = checked(image, kImageMark);
  if (handle == nullptr) return failHandle("an image");
  rung_code_maker given{};
  if (maker == nullptr || !takeStruct(maker, given)) return failSize("rung_code_maker");
  if (given.force == nullptr) return fail(RUNG_BAD_ARGUMENT, "the maker has no function `force`");
  return contained([&] {
    auto kept = std::make_unique<const rung_code_maker>(given);
    const rung_code_maker* none = nullptr;
    if (!handle->image->maker.compare_exchange_strong(none, kept.get()))
      return fail(RUNG_WRONG_STATE, "a compiler serves the image already");
    [[maybe_unused]] const rung_code_maker* now = kept.release();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_image_file(const rung_image* image, uint64_t first, void* bytes, size_t* count) {
  const rung_image* handle = checked(image, kImageMark);
  if (handle == nullptr) return failHandle("an image");
  if (bytes == nullptr || count == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "the bytes or the pointer to their number is null");
  if (handle->image->loaded == nullptr) return RUNG_EMPTY;
  const std::optional<size_t> read = handle->image->loaded->readFile(first, {static_cast<char*>(bytes), *count});
  if (!read) return fail(RUNG_FAILED, "the file of the image cannot be read");
  *count = *read;
  return RUNG_OK;
}

int32_t rung_image_close(rung_image* image) { return endHandle(image, kImageMark, "an image"); }
