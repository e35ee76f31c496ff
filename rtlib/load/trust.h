// The rules by which a process decides whose machine code to run. They are functions of facts; the functions that query
// the system follow them.
//
// A process is *privileged* if its effective or saved user is root while its real, saved or file-system user is not: it
// has root's rights but acts for another user, as LinuxCNC's rtapi_app does.
//
//   privileged    the file belongs to root, and root alone may write to it; or a key of kKeysFolder has signed it.
//                 It has a seal, names no folders to search, and needs the system's C and C++ libraries at most.
//   any other     the file belongs to root or to the effective user, and others may not write to it (its group may, if
//                 that is the process's own effective group); or a key has signed it.
//
// Only user and group are considered, not the capabilities of a program file.
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
  uint32_t mode = 0; // permission bits only
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
  UnknownKey,     // signed by a key that was not found
  WrongSignature, // the key named in it did not make the signature
  Signed,         // signed by a key that was found
};

bool isPrivileged(const ProcessIds& ids);

// Why a user whom the process does not trust could change a file or a folder; empty: no such user can.
std::string ownerProblem(const FileFacts& file, const ProcessIds& ids);

// Why a program file must not be loaded, and how to fix it; empty: it may be loaded. A seal is assumed to be undamaged.
std::string loadProblem(const FileFacts& file, const ProcessIds& ids, SealState seal, bool mayLackSeal);

// Why a privileged process must not load a file with these contents; empty: it may load it.
std::string dependencyProblem(const ElfObject& object);

// ---- queries of the system ----

// Why a user other than root could change a file, or put another in its place; empty: no other user can. `path` is
// absolute, and none of its parts is a link.
std::string rootsFileProblem(const std::string& path);

// The folder of public keys, NAME.pub. It is the only one for a privileged process, and a constant: neither an option
// nor the environment may choose whose keys are trusted.
inline constexpr const char* kKeysFolder = "/etc/rung/keys.d";

ProcessIds idsOfThisThread();
std::optional<FileFacts> factsOf(int fd); // nothing, with errno; after a failed open() its errno stays

// The key of this identity. Every folder on the path to kKeysFolder, and the keys in it, must belong to root and be
// writable by root only; another `folder`, which an unprivileged process may choose, and its keys must satisfy
// ownerProblem. Nothing: there is no such key; `problem` says why if a folder or a file could not be used.
std::optional<PublicKey> findKey(const KeyId& id, const std::string& folder, const ProcessIds& ids,
                                 std::string& problem);

// A folder of machine code that a process generates and runs again, such as the JIT's cache. Its files are executed, so
// the rules of trust.h apply to the folder and to each file. Several processes of one user may use one folder.

class CodeFolder {
public:
  // Opens the folder, or creates it with access for its owner only. Nothing, and `problem` says why: it cannot be used,
  // or other users could put files there.
  static std::optional<CodeFolder> open(const std::string& path, std::string& problem);

  // Nothing if the file does not exist, or other users could have written it.
  std::optional<std::string> read(const std::string& name) const;
  // Returns "", or the reason of a failure.
  std::string write(const std::string& name, std::string_view bytes) const;

private:
  explicit CodeFolder(File folder) : folder_(std::move(folder)) {}
  File folder_;
};

} // namespace rung::runtime
