// Whose machine code a process runs. The rules are functions of facts; what asks the system is below them.
//
// A process is *privileged* if its effective or saved user is root while its real, saved or file-system user is not:
// it has root's rights and serves another user, as LinuxCNC's rtapi_app does.
//
//   privileged    the file belongs to root, and root alone may write to it; or a key of kKeysFolder has signed it.
//                 It has a seal, names no folders to search, and needs the system's C and C++ libraries at most.
//   any other     the file belongs to root or to the effective user, and others may not write to it (its group may, if
//                 that is the process's own effective group); or a key has signed it.
//
// Only user and group are looked at: rights that a program file has as capabilities are not seen.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rtlib/load/elf_file.h"
#include "rtlib/load/file.h"
#include "rtlib/load/seal.h"

namespace rung::runtime {

struct FileFacts {
  uint32_t uid = 0;
  uint32_t gid = 0;
  uint32_t mode = 0; // permissions alone
  bool isRegular = true;
};

struct ProcessIds {
  uint32_t ruid = 0;
  uint32_t euid = 0;
  uint32_t suid = 0;
  uint32_t fsuid = 0;
  uint32_t egid = 0;
};

enum class SealState : uint8_t {
  Missing,
  Unsigned,
  UnknownKey,     // signed, by a key that is not here
  WrongSignature, // not what the key named in it made
  Signed,         // by a key that is here
};

bool isPrivileged(const ProcessIds& ids);

// Why others than those the process trusts could change a file or a folder; empty: they cannot.
std::string ownerProblem(const FileFacts& file, const ProcessIds& ids);

// Why a program file must not be loaded, and what to do; empty: it may. An undamaged seal is assumed.
std::string loadProblem(const FileFacts& file, const ProcessIds& ids, SealState seal, bool mayLackSeal);

// Why a privileged process must not load a file with these contents; empty: it may.
std::string dependencyProblem(const ElfObject& object);

// ---- what the system says ----

// Why a user other than root could change a file, or put another in its place; empty: no other user can. `path` is
// absolute, and none of its parts is a link.
std::string rootsFileProblem(const std::string& path);

// Public keys, NAME.pub. In a privileged process the only place, and a constant: neither an option nor the environment
// may choose who is trusted.
inline constexpr const char* kKeysFolder = "/etc/rung/keys.d";

ProcessIds idsOfThisThread();
std::optional<FileFacts> factsOf(int fd); // nothing, with errno; that of a failed open() stays

// The key of this identity. Every folder on the way to kKeysFolder, and the keys in it, belong to root, and root alone
// may write to them; a `folder` of an unprivileged process's own choice, and its keys, satisfy ownerProblem.
// Nothing, and `problem` says why if a folder or a file could not be used.
std::optional<PublicKey> findKey(const KeyId& id, const std::string& folder, const ProcessIds& ids,
                                 std::string& problem);

// A folder of machine code that a process makes and runs again, such as the JIT's cache: what is taken from it is run,
// so the rules of trust.h hold for the folder and for each file. Several processes of one user may use one folder.

class CodeFolder {
public:
  // Made for its owner alone where there is none. Nothing, and `problem` says why, when it cannot be used or others
  // could put files there.
  static std::optional<CodeFolder> open(const std::string& path, std::string& problem);

  // Nothing when the file is not there, or is one that others could have written.
  std::optional<std::string> read(const std::string& name) const;
  // Empty, or what went wrong.
  std::string write(const std::string& name, std::string_view bytes) const;

private:
  explicit CodeFolder(File folder) : folder_(std::move(folder)) {}
  File folder_;
};

} // namespace rung::runtime
