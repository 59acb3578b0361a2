#include "engine/pipeline/counted_capture.h"

namespace acentric {
namespace {

struct Counted {
  std::shared_ptr<MemoryBudget> budget;
  MemoryBudget::Share share;
  std::shared_ptr<const DisplayCapture> capture;
};

}  // namespace

std::shared_ptr<const DisplayCapture> counted(std::shared_ptr<const DisplayCapture> capture,
                                              std::shared_ptr<MemoryBudget> budget) {
  auto counted = std::make_shared<Counted>();
  counted->budget = std::move(budget);
  counted->share = MemoryBudget::Share(*counted->budget);
  counted->share.set(bytesOf(*capture));
  counted->capture = std::move(capture);
  return {counted, counted->capture.get()};
}

}  // namespace acentric
