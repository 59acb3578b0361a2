#include "engine/base/contract.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace acentric {
namespace {

void abortWithMessage(const char* what, const std::source_location& where) {
  std::fprintf(stderr, "%s:%u: broken contract in %s: %s\n", where.file_name(), where.line(),
               where.function_name(), what);
  std::abort();
}

std::atomic<ContractHandler> currentHandler{&abortWithMessage};

}  // namespace

ContractHandler setContractHandler(ContractHandler handler) {
  return currentHandler.exchange(handler ? handler : &abortWithMessage);
}

void contractBroken(const char* what, const std::source_location& where) {
  currentHandler.load()(what, where);
}

}  // namespace acentric
