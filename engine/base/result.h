#pragma once
/// Errors of the world (files, memory, time), as values. A broken contract of ours is `require` (contract.h).

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace acentric {

enum class ErrorKind {
  notFound,         ///< no such file, cell, camera
  unreadable,       ///< exists, cannot be read or written
  malformed,        ///< read, but not what its format promises
  unsupported,      ///< sound, but we do not play it
  tooLarge,         ///< beyond a stated limit
  timeout,          ///< took longer than its limit
  outOfSpace,       ///< disk or memory
  cancelled,        ///< by the user; nothing half-written is left
  invalidArgument,  ///< an option or parameter out of its range
  internal          ///< a helper process or library failed in a way of its own
};

/// `message` says what is wrong and the way out; `where` names the file (and the thing in it).
struct Error {
  ErrorKind kind = ErrorKind::internal;
  std::string message;
  std::string where;

  /// One line for a person: "where: message".
  std::string describe() const { return where.empty() ? message : where + ": " + message; }
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

inline tl::unexpected<Error> fail(ErrorKind kind, std::string message, std::string where = {}) {
  return tl::unexpected<Error>(Error{kind, std::move(message), std::move(where)});
}

/// What is read is damaged, or no such thing at all.
inline tl::unexpected<Error> malformed(std::string message, std::string where = {}) {
  return fail(ErrorKind::malformed, std::move(message), std::move(where));
}

/// A stable word for each kind, for JSON reports.
const char* nameOf(ErrorKind kind);

}  // namespace acentric
