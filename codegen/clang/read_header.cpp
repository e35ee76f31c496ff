// Reads a struct through libTooling (see read_header.h).
#include "codegen/clang/read_header.h"

#include <algorithm>
#include <map>
#include <memory>
#include <ranges>

#include <clang/AST/ASTConsumer.h>
#include <clang/AST/ASTContext.h>
#include <clang/AST/DeclCXX.h>
#include <clang/AST/DeclTemplate.h>
#include <clang/AST/RecordLayout.h>
#include <clang/Basic/TargetInfo.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/FrontendAction.h>
#include <clang/Tooling/ArgumentsAdjusters.h>
#include <clang/Tooling/CompilationDatabase.h>
#include <clang/Tooling/Tooling.h>
#include <llvm/Support/FileSystem.h>

#include "rtlib/text/similar.h"

namespace rung::codegen {
namespace {

using namespace clang;

// A struct found by its name.
struct Named {
  const RecordDecl* record = nullptr;
  const NamedDecl* name = nullptr; // its tag or a typedef
};

// Named structs of the whole translation unit; of a tag and a typedef of the same name, the typedef.
class Names {
public:
  explicit Names(const DeclContext& all) { collect(all); }

  const Named* find(const std::string& name) const {
    const auto found = structs_.find(name);
    return found == structs_.end() ? nullptr : &found->second;
  }
  std::string similarTo(const std::string& name) const {
    return std::string(text::mostSimilar(name, structs_ | std::views::keys));
  }

private:
  void collect(const DeclContext& context) {
    for (const Decl* decl : context.decls()) {
      if (const auto* record = dyn_cast<RecordDecl>(decl); record && !record->getName().empty())
        structs_.try_emplace(record->getQualifiedNameAsString(), record, record);
      if (const auto* pattern = dyn_cast<ClassTemplateDecl>(decl))
        structs_.try_emplace(pattern->getQualifiedNameAsString(), pattern->getTemplatedDecl(), pattern);
      if (const auto* alias = dyn_cast<TypedefNameDecl>(decl))
        if (const RecordDecl* record = alias->getUnderlyingType()->getAsRecordDecl())
          structs_[alias->getQualifiedNameAsString()] = {record, alias};
      if (const auto* inner = dyn_cast<DeclContext>(decl); inner && !isa<FunctionDecl>(decl)) collect(*inner);
    }
  }

  std::map<std::string, Named> structs_;
};

// Converts the declarations of a record to its members.
class LayoutReader {
public:
  LayoutReader(ASTContext& context, HostLayout& layout)
      : context_(context), layout_(layout), policy_(context.getPrintingPolicy()) {
    policy_.AnonymousTagLocations = 0;
  }

  uint32_t add(const RecordDecl& record) {
    const auto [known, isNew] = numbers_.try_emplace(&record, static_cast<uint32_t>(layout_.records.size()));
    const uint32_t number = known->second;
    if (!isNew) return number;
    layout_.records.push_back({.isUnion = record.isUnion(), .members = {}});
    std::vector<HostMember> members;
    addMembers(record, 0, members);
    layout_.records[number].members = std::move(members);
    return number;
  }

private:
  void addMembers(const RecordDecl& record, uint64_t begin, std::vector<HostMember>& members) {
    const ASTRecordLayout& places = context_.getASTRecordLayout(&record);
    if (const auto* derived = dyn_cast<CXXRecordDecl>(&record))
      for (const CXXBaseSpecifier& base : derived->bases()) {
        const CXXRecordDecl* of = base.getType()->getAsCXXRecordDecl();
        if (base.isVirtual()) continue; // its offset depends on the object
        addMembers(*of, begin + 8 * static_cast<uint64_t>(places.getBaseClassOffset(of).getQuantity()), members);
      }
    for (const FieldDecl* field : record.fields())
      if (!field->isUnnamedBitField())
        members.push_back(memberOf(*field, begin + places.getFieldOffset(field->getFieldIndex())));
  }

  HostMember memberOf(const FieldDecl& field, uint64_t bit) {
    HostMember member;
    member.name = field.getNameAsString();
    member.bit = bit;
    QualType type = field.getType();
    while (const auto* array = context_.getAsConstantArrayType(type)) {
      member.lengths.push_back(array->getSize().getZExtValue());
      type = array->getElementType();
    }
    member.type = type.getUnqualifiedType().getAsString(policy_);
    if (field.isBitField()) member.bits = field.getBitWidthValue(context_);
    describe(type, member);
    if (field.getAccess() == AS_private || field.getAccess() == AS_protected)
      becomeOther(member, "a member that is not public");
    return member;
  }

  static void becomeOther(HostMember& member, std::string why) {
    member.kind = MemberKind::Other;
    member.why = std::move(why);
  }

  void describe(QualType declared, HostMember& member) {
    QualType type = declared.getCanonicalType();
    if (const auto* atomic = type->getAs<AtomicType>()) type = atomic->getValueType().getCanonicalType();
    if (type->isReferenceType()) return becomeOther(member, "a reference");
    if (type->isIncompleteType()) return becomeOther(member, "an array without a length");
    member.bytes = static_cast<uint64_t>(context_.getTypeSizeInChars(type).getQuantity());
    if (const RecordDecl* record = type->getAsRecordDecl()) {
      member.kind = MemberKind::Record;
      member.record = add(*record->getDefinition());
    } else if (type->isBooleanType()) {
      member.kind = MemberKind::Bool;
    } else if (type->isIntegralOrEnumerationType()) {
      describeInteger(type, member);
    } else if (type->isSpecificBuiltinType(BuiltinType::Float) || type->isSpecificBuiltinType(BuiltinType::Double)) {
      member.kind = MemberKind::Real;
      member.isSigned = true;
    } else {
      becomeOther(member, whatIs(*type));
    }
  }

  void describeInteger(QualType type, HostMember& member) {
    if (member.bytes > 8 || type->isBitIntType()) return becomeOther(member, "an integer of no width that a PLC has");
    member.kind = MemberKind::Integer;
    member.isSigned = type->isSignedIntegerOrEnumerationType();
    if (const auto* enumeration = type->getAs<EnumType>()) member.constants = constantsOf(*enumeration->getDecl());
  }

  std::vector<uint32_t> constantsOf(const EnumDecl& enumeration) {
    const auto [known, isNew] = constants_.try_emplace(&enumeration);
    if (!isNew) return known->second;
    for (const EnumConstantDecl* constant : enumeration.enumerators()) {
      known->second.push_back(static_cast<uint32_t>(layout_.constants.size()));
      layout_.constants.push_back({constant->getQualifiedNameAsString(), constant->getInitVal().getExtValue()});
    }
    return known->second;
  }

  static std::string whatIs(const Type& type) {
    if (type.isAnyPointerType()) return "a pointer";
    if (type.isSpecificBuiltinType(BuiltinType::LongDouble)) return "a long double";
    if (type.isAnyComplexType()) return "a complex number";
    if (type.isVectorType()) return "a vector";
    if (type.isMemberPointerType()) return "a pointer to a member";
    return "neither a number nor a struct";
  }

  ASTContext& context_;
  HostLayout& layout_;
  PrintingPolicy policy_; // for printing types
  std::map<const RecordDecl*, uint32_t> numbers_;
  std::map<const EnumDecl*, std::vector<uint32_t>> constants_;
};

class Consumer final : public ASTConsumer {
public:
  Consumer(const HeaderRequest& request, HeaderOutcome& outcome) : request_(request), outcome_(outcome) {}

  void HandleTranslationUnit(ASTContext& context) override {
    if (context.getDiagnostics().hasErrorOccurred()) return;
    const Names names(*context.getTranslationUnitDecl());
    const Named* found = names.find(request_.name);
    outcome_.problem = found == nullptr ? missing(names.similarTo(request_.name)) : unfit(context, *found);
    if (outcome_.problem.empty()) read(context, *found);
  }

private:
  std::string missing(const std::string& similar) const {
    return "there is no struct " + request_.name + " in " + request_.header +
           (similar.empty() ? "; name the tag or the typedef, with its namespaces" : text::didYouMean(similar));
  }

  std::string unfit(const ASTContext& context, const Named& found) const {
    if (context.getTargetInfo().isBigEndian())
      return "the compile flags are for a big-endian processor, and PLC memory is little-endian";
    const RecordDecl* record = found.record->getDefinition();
    if (record == nullptr)
      return request_.name + " is declared at " +
             found.record->getLocation().printToString(context.getSourceManager()) +
             " and defined nowhere; name the header that defines it";
    if (record->isDependentContext()) return request_.name + " is a template; give one of its types a name by using";
    const auto* object = dyn_cast<CXXRecordDecl>(record);
    if (object != nullptr && (object->isDynamicClass() || object->getNumVBases() != 0))
      return request_.name + " has virtual functions or virtual bases; bind a plain struct";
    return {};
  }

  void read(ASTContext& context, const Named& found) {
    const RecordDecl& record = *found.record->getDefinition();
    HostLayout& layout = outcome_.layout.emplace();
    layout.name = request_.name;
    const bool isTag = isa<RecordDecl>(found.name) && !context.getLangOpts().CPlusPlus;
    layout.type = isTag ? record.getKindName().str() + " " + request_.name : request_.name;
    layout.bytes = static_cast<uint64_t>(context.getASTRecordLayout(&record).getSize().getQuantity());
    LayoutReader(context, layout).add(record);
  }

  const HeaderRequest& request_;
  HeaderOutcome& outcome_;
};

class Action final : public ASTFrontendAction {
public:
  Action(const HeaderRequest& request, HeaderOutcome& outcome) : request_(request), outcome_(outcome) {}
  std::unique_ptr<ASTConsumer> CreateASTConsumer(CompilerInstance&, StringRef) override {
    return std::make_unique<Consumer>(request_, outcome_);
  }

private:
  const HeaderRequest& request_;
  HeaderOutcome& outcome_;
};

class ActionFactory final : public tooling::FrontendActionFactory {
public:
  ActionFactory(const HeaderRequest& request, HeaderOutcome& outcome) : request_(request), outcome_(outcome) {}
  std::unique_ptr<FrontendAction> create() override { return std::make_unique<Action>(request_, outcome_); }

private:
  const HeaderRequest& request_;
  HeaderOutcome& outcome_;
};

std::unique_ptr<tooling::CompilationDatabase> flagsOf(const HeaderRequest& request, std::string& problem) {
  if (request.buildFolder.empty()) return std::make_unique<tooling::FixedCompilationDatabase>(".", request.flags);
  std::string error; // messages of all kinds of databases, over several lines
  auto database = tooling::CompilationDatabase::loadFromDirectory(request.buildFolder, error);
  if (!database)
    problem = "there is no compile_commands.json in " + request.buildFolder +
              " that can be read; CMake writes one with CMAKE_EXPORT_COMPILE_COMMANDS=ON";
  return database;
}

// The headers that belong to clang (stddef.h) are with its library, not with this program. Warnings about a host's
// header are left to its own compiler.
tooling::ArgumentsAdjuster ourFlags() {
  return tooling::getInsertArgumentAdjuster({"-resource-dir=" RUNG_CLANG_HEADERS, "-w"},
                                            tooling::ArgumentInsertPosition::END);
}

} // namespace

HeaderOutcome readHeader(const HeaderRequest& request) {
  HeaderOutcome outcome;
  if (!llvm::sys::fs::exists(request.header)) {
    outcome.problem = "there is no file " + request.header;
    return outcome;
  }
  if (!llvm::sys::fs::exists(RUNG_CLANG_HEADERS "/include/stddef.h")) {
    outcome.problem = "clang's own headers are not in " RUNG_CLANG_HEADERS "; install libclang-common-19-dev";
    return outcome;
  }
  const std::unique_ptr<tooling::CompilationDatabase> flags = flagsOf(request, outcome.problem);
  if (!flags) return outcome;
  tooling::ClangTool tool(*flags, {request.header});
  tool.setPrintErrorMessage(false);
  tool.appendArgumentsAdjuster(ourFlags());
  ActionFactory actions(request, outcome);
  const int status = tool.run(&actions);
  if (status == 0 && (outcome.layout || !outcome.problem.empty())) return outcome;
  outcome.layout.reset();
  outcome.problem = "the header has errors, or needs other compile flags: write them after --, or name the folder of a "
                    "compile_commands.json by -p; for a .h in C++, -- -x c++";
  return outcome;
}

} // namespace rung::codegen
