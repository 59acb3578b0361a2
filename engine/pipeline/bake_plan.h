#pragma once
/// What of a project is to be baked, and why. The plan of an unchanged project is remembered, so that asking
/// takes milliseconds: neither is the scene loaded, nor are rays prepared or cameras laid.

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

struct PlannedCapture {
  std::string subject;  ///< as the store's records name it
  double pixels = 0;    ///< 0 of surface light
  ContentKey key;
  KeyParts parts;
};

struct StoreyPlan {
  std::string storey;                   ///< its name
  std::vector<PlannedCapture> cameras;  ///< as in Layout::cameras
  std::vector<int> order;               ///< bakingOrder
  PlannedCapture light;
};

struct BakePlan {
  std::filesystem::path file;
  std::vector<StoreyPlan> storeys;
  std::vector<OpenProject> open;  ///< of the storeys; empty where the plan was remembered
};

StoreyPlan planStorey(const OpenProject& open);
/// One text for all of a storey's captures and its light (SweepPoint::bakeKey): the same where they are.
std::string bakeKeyOf(const OpenProject& open);

/// `storey`: only this one (by its place in the project).
Result<BakePlan> planBake(const std::filesystem::path& file, std::optional<int> storey,
                          const ImportHost& host, const Progress& progress = {}, std::stop_token stop = {});
/// Of a project that differs from its file; it is opened.
Result<BakePlan> planBake(const std::filesystem::path& file, Project project, std::optional<int> storey,
                          const ImportHost& host, const Progress& progress = {}, std::stop_token stop = {});

/// What of the cameras is there, without looking into files.
struct CapturesOnDisk {
  std::vector<bool> baked;           ///< at full quality; as in Layout::cameras
  std::vector<bool> stale;           ///< not baked as the project is now, but as it was before
  std::vector<std::uint64_t> bytes;  ///< of those that are baked
};
CapturesOnDisk capturesOnDisk(const OpenProject& open);

/// Why a capture is baked, or that it need not be.
enum class BakeReason { baked, neverBaked, damaged, changed };
const char* nameOf(BakeReason reason);

struct CaptureState {
  BakeReason reason = BakeReason::baked;
  std::vector<std::string> changed;  ///< parts of the key, of `changed`
  std::vector<std::string> damage;   ///< each names its file
  bool recorded = true;              ///< of `baked`: else it had to be read to its end, until a bake notes it
  bool baked() const { return reason == BakeReason::baked; }
};
/// "bake settings changed, the camera moved": one line for a person.
std::string describe(const CaptureState& state);

struct StoreyState {
  std::vector<CaptureState> cameras;
  CaptureState light;
};
/// Of each of the plan's storeys. Changes nothing.
Result<std::vector<StoreyState>> stateOf(const BakePlan& plan);

}  // namespace acentric
