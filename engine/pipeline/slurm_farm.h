#pragma once
/// A bake as jobs of a Slurm cluster: an array of which each task bakes a share of the cameras into the
/// shared store, and a job that runs when all of them are done, reads every capture to its end and bakes
/// again what is missing or damaged. Scripts as text; nothing is run here.

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace acentric {

/// Slurm's usual limit on the number of an array's tasks (MaxArraySize).
inline constexpr int kMostFarmTasks = 1000;

struct FarmOptions {
  std::filesystem::path program;  ///< acentric, absolute; the nodes have it there too
  std::filesystem::path project;  ///< absolute, in a folder that the nodes share
  std::filesystem::path scenes;   ///< absolute, shared too: holds the imported scene, which tasks map
  std::string storey;             ///< empty = all of them
  std::string partition;          ///< empty = the cluster's own choice
  int nodes = 1;                  ///< tasks that run at once, each on one node
  int threads = 0;                ///< of a task; 0 = all of its node, which it then has for itself
  int cameraTasks = 1;            ///< 0 = only light is missing
  bool light = true;              ///< a task for the light on local geometry

  Status check() const;
};

/// How many tasks bake `cameras` in `seconds` altogether: none is shorter than `leastSeconds`.
int farmTasks(double seconds, int cameras, double leastSeconds);

struct FarmScripts {
  std::string bake;    ///< of the array's tasks
  std::string merge;   ///< of the job after them
  std::string submit;  ///< lies beside the others, which it submits; prints the two jobs' numbers
};
inline constexpr const char* kFarmBakeScript = "bake.sh";
inline constexpr const char* kFarmMergeScript = "merge.sh";
inline constexpr const char* kFarmSubmitScript = "submit.sh";

FarmScripts slurmScripts(const FarmOptions& options);

/// One word for a POSIX shell, whatever the text holds.
std::string shellQuoted(const std::string& text);

}  // namespace acentric
