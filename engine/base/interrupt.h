#pragma once
/// Ctrl-C and its kin turned into a stop request.

#include <stop_token>

namespace acentric {

/// A token that SIGINT (Ctrl-C), SIGTERM or SIGHUP sets; another one later ends the program at once. To be
/// called once, before there are other threads.
std::stop_token stopOnInterrupt();

}  // namespace acentric
