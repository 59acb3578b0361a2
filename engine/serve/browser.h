#pragma once
/// The user's browser, started by xdg-open.

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

class Browser {
 public:
  /// Shows an address. The error says what is missing, and the address.
  Status open(const std::string& address);
  /// Why the one that was opened last did not show, once xdg-open has said so; told once. To be called now
  /// and then.
  std::optional<Error> takeTrouble();

 private:
  struct Started {
    pid_t process;
    std::string address;
  };
  std::vector<Started> started_;  // some live as long as their browser
};

}  // namespace acentric
