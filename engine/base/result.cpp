#include "engine/base/result.h"

namespace acentric {

const char* nameOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::notFound:
      return "notFound";
    case ErrorKind::unreadable:
      return "unreadable";
    case ErrorKind::malformed:
      return "malformed";
    case ErrorKind::unsupported:
      return "unsupported";
    case ErrorKind::tooLarge:
      return "tooLarge";
    case ErrorKind::timeout:
      return "timeout";
    case ErrorKind::outOfSpace:
      return "outOfSpace";
    case ErrorKind::cancelled:
      return "cancelled";
    case ErrorKind::invalidArgument:
      return "invalidArgument";
    case ErrorKind::internal:
      return "internal";
  }
  return "internal";
}

}  // namespace acentric
