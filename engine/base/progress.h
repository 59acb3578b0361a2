#pragma once
/// How long work tells how far it is. Called from one thread at a time, often: keep it cheap.

#include <functional>
#include <string>

namespace acentric {

struct ProgressState {
  double done = 0;    ///< units finished
  double total = 0;   ///< units in all; 0 while unknown
  std::string stage;  ///< "importing", "baking camera 12"
};

using Progress = std::function<void(const ProgressState&)>;

}  // namespace acentric
