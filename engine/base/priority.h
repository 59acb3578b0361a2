#pragma once
/// How much of the processors a thread claims from others.

namespace acentric {

/// For work in the background: this thread, and those that it starts from now on, give way to all others of
/// the machine. Cannot be taken back.
void lowerThreadPriority();

}  // namespace acentric
