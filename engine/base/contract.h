#pragma once
/// Contracts of ours. A broken one is a bug in this program, never in its input.

#include <source_location>

namespace acentric {

using ContractHandler = void (*)(const char* what, const std::source_location& where);

/// Replaces what a broken contract does (default: message to stderr, abort). Returns the former handler.
/// A handler that returns lets the caller go on, so tests install one that throws.
ContractHandler setContractHandler(ContractHandler handler);

[[gnu::cold]] void contractBroken(const char* what, const std::source_location& where);

inline void require(bool holds, const char* what,
                    const std::source_location& where = std::source_location::current()) {
  if (!holds) [[unlikely]]
    contractBroken(what, where);
}

}  // namespace acentric
