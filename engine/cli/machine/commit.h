#pragma once
/// Which state of the sources a program was built from.

namespace acentric::cli {

/// As `git describe --always --dirty` says when it is built: "unknown" outside a checkout.
const char* commitName();

}  // namespace acentric::cli
