#pragma once
/// Captures on disk under content keys, format: FORMAT.md. Each capture is one file, `<key>.pack`. As
/// OpenEXR, which other tools read, captures are exported. All writes are atomic; a file that fails its
/// checks is treated as missing and reported, never used.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/image/capture.h"
#include "engine/image/colour_quality.h"
#include "engine/scene/simplify.h"
#include "engine/scene/surface_light.h"
#include "engine/scene/surface_light_part.h"
#include "engine/store/capture_record.h"

namespace acentric {

// What is told to stop while it writes gives `cancelled` soon, and leaves no file of its own.

/// Flat where no pixel has more than one sample, else deep. Silhouettes are not in it.
Status writeCaptureExr(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                       const std::stop_token& stop = {});

/// As stores keep captures. Colours by a quality (colour_quality.h), the rest exactly.
Status writeCodedPack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                      int colourQuality, const std::stop_token& stop = {});
/// The same, but colours as they are shown at an exposure, in 8 bits: what bundles hold. `colourQuality`:
/// 0..99.
Status writeDisplayPack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                        int colourQuality, float exposure, const std::stop_token& stop = {});
/// Either of these.
Result<Capture> readCapturePack(const std::filesystem::path& path);

Status writeSurfaceLight(const SurfaceLight& light, const ContentKey& key, const std::filesystem::path& path,
                         const std::stop_token& stop = {});
Result<SurfaceLight> readSurfaceLight(const std::filesystem::path& path);

Status writeSimplified(const SimplifiedLocal& simplified, const ContentKey& key,
                       const std::filesystem::path& path);
/// Numbers are not checked against the scene: SimplifiedLocal::check does.
Result<SimplifiedLocal> readSimplified(const std::filesystem::path& path);

class CaptureStore {
 public:
  /// Makes the folder, removes temporaries of killed processes.
  static Result<CaptureStore> open(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  /// Is it on disk? (Its content is checked on get.)
  bool has(const ContentKey& key) const;
  /// The whole file or, stopped before that, none. Colours by a quality (colour_quality.h).
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop = {},
             int colourQuality = kLosslessColours) const;
  /// What is damaged is `malformed` and set aside (renamed *.damaged), so that the next bake replaces it.
  Result<Capture> get(const ContentKey& key) const;
  /// Where its pack is, or would be.
  std::filesystem::path packFile(const ContentKey& key) const;
  /// The same of any file under the key, by its extension (".light").
  std::filesystem::path fileOf(const ContentKey& key, const std::string& extension) const;

  /// Takes what another store has under the key, capture or light with its record: as further names of the
  /// same files (no file of a store is ever changed in place) or, across file systems, as copies. What is
  /// there already stays; nothing where the other has none.
  Status adopt(const ContentKey& key, const CaptureStore& from) const;

  bool hasSurfaceLight(const ContentKey& key) const;
  Status putSurfaceLight(const ContentKey& key, const SurfaceLight& light,
                         const std::stop_token& stop = {}) const;
  Result<SurfaceLight> getSurfaceLight(const ContentKey& key) const;

  /// What is finished of a light that is being baked.
  Status putSurfaceLightPart(const ContentKey& key, const SurfaceLightPart& part) const;
  /// Those that are sound; others are as good as missing, and are deleted.
  std::vector<SurfaceLightPart> getSurfaceLightParts(const ContentKey& key) const;
  void forgetSurfaceLightParts(const ContentKey& key) const;

  bool hasSimplified(const ContentKey& key) const;
  Status putSimplified(const ContentKey& key, const SimplifiedLocal& simplified) const;
  Result<SimplifiedLocal> getSimplified(const ContentKey& key) const;

  /// Reads every file that is there under the key (capture, surface light, simplified geometry)
  /// to its end; what is wrong with each, that it was made for another key too. Sets nothing aside.
  std::vector<Error> check(const ContentKey& key, const std::stop_token& stop = {}) const;

  /// Notes what is now on disk under the key. Written last: what has a record was written to the end.
  Status putRecord(const ContentKey& key, std::string subject, KeyParts parts,
                   const std::optional<SampleCounts>& samples = {}) const;
  Result<CaptureRecord> record(const ContentKey& key) const;
  /// Without its record, what is on disk under the key is read to its end the next time it is asked for.
  void forgetRecord(const ContentKey& key) const;
  /// The newest record of each subject, of keys that are not in `known`.
  std::map<std::string, CaptureRecord> formerRecords(const std::vector<ContentKey>& known) const;

  enum class Condition { missing, sound, damaged };
  struct Inspected {
    Condition condition = Condition::missing;
    std::vector<Error> damage;  ///< each names its file
    bool recorded = false;
    std::optional<Error> recordDamage;  ///< there is a record, and it cannot be used
  };
  /// Are the files under the key as they were written? Files that are no newer than their record are believed
  /// by their size, others by their content's hash; those without a record, and with `toTheEnd` all, are
  /// read. A stop while they are gives `cancelled`.
  Result<Inspected> inspect(const ContentKey& key, bool toTheEnd = false,
                            const std::stop_token& stop = {}) const;

  std::uint64_t bytesOf(const ContentKey& key) const;
  /// Deletes captures, surface light and simplified geometry whose key is not in `keep`, what was set aside,
  /// and parts of light that is whole; returns bytes freed.
  std::uint64_t prune(const std::vector<ContentKey>& keep) const;

 private:
  explicit CaptureStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path folder_;
};

}  // namespace acentric
